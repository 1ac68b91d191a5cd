// The page in a real browser: every shipped file is shown, dead points hold, nothing hostile runs, nothing is loaded.
import { spawn } from "node:child_process";
import { once } from "node:events";
import { existsSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { files, loads, root } from "./files.mjs";
import { browser, check, dragged, drawn, folder, inked, loaded, opened, program, run, said, shown, values } from "./harness.mjs";

/** Files that are opened in pages of their own: planar, spatial, from joint coordinates. */
const FRESH = ["four_bar", "stewart_gough_6ups", "axes/agile_eye"].map((name) => `mechanisms/${name}.ron`);

const tests = {
  async "every shipped file opens, without a complaint, and shows its mechanism"() {
    for (const file of files) {
      const fresh = FRESH.includes(file);
      const page = await (fresh ? opened(file) : loaded(file));
      check(page.complaints.length === 0, `${file}: ${page.complaints.join("; ")}`);
      check(await page.evaluate(() => globalThis.linkwork.frame?.assembled), `${file} is not assembled: ${await said(page)}`);
      const ink = await inked(page);
      check(ink > 1500, `${file}: only ${ink} pixels are drawn`);
      if (fresh) await page.close();
    }
  },

  async "a picture without a mechanism is empty"() {
    const page = await opened("mechanisms/four_bar.ron");
    await page.evaluate(() => {
      const { frame } = globalThis.linkwork;
      frame.scene = { ...frame.scene, bodies: [], joints: [], rods: [] };
      globalThis.linkwork.onMoved(() => {});
      document.querySelector("[data-view=plane]").click();
    });
    await drawn(page);
    check((await inked(page)) < 100, "an empty scene is not empty");
    await page.close();
  },

  async "a slider moves the mechanism on its branch and stops at a dead point"() {
    // the rocker of a crank-rocker, driven: it locks where crank and coupler are in line
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => globalThis.holding.hold("phi1"));
    const turns = ([, phi2]) => Math.sign(Math.sin(phi2));
    const before = await values(page);
    for (const way of [1, -1]) {
      for (let i = 1; i <= 40; i++) {
        await page.evaluate((to) => globalThis.linkwork.move("phi1", to), before[2] + way * 0.05 * i);
      }
      check(/dead point/.test(await said(page)), `no dead point is said: ${await said(page)}`);
      const there = await values(page);
      check(turns(there) === turns(before), "the mechanism flipped");
      await page.evaluate((to) => globalThis.linkwork.move("phi1", to), before[2]);
      const after = await values(page);
      check(after.every((value, i) => Math.abs(value - before[i]) < 1e-7), `the way back ends at ${after}, not at ${before}`);
    }
  },

  async "a body follows the pointer and never flips"() {
    const page = await loaded("mechanisms/four_bar.ron");
    const at = await page.evaluate(() => globalThis.picture.pixelOf("left.1"));
    const before = await values(page);
    await dragged(page, at, [72, 24]);
    const after = await values(page);
    check(Math.abs(after[0] - before[0]) > 0.05, `the crank was not moved: ${after[0]}`);
    // the angle between coupler and rocker keeps its sign all the way round
    const side = ([theta1, phi2, phi1]) => Math.sign(Math.sin(phi1 - theta1 - phi2));
    check(side(after) === side(before), "the mechanism flipped");
  },

  async "a rod follows the pointer, and takes the mechanism with it"() {
    const page = await loaded("mechanisms/delta.ron");
    const before = await values(page);
    const middle = await page.evaluate(() => {
      const [a, b] = globalThis.linkwork.frame.scene.rods[0].ends;
      return globalThis.picture.pixel(a.map((x, i) => (x + b[i]) / 2));
    });
    await dragged(page, middle, [20, 15]);
    const after = await values(page);
    check(after.some((value, i) => Math.abs(value - before[i]) > 1e-3), "nothing was moved");
    check(await page.evaluate(() => globalThis.linkwork.frame.assembled), "it came apart");
  },

  async "the transmission angle is read as the crank moves"() {
    const page = await loaded("mechanisms/four_bar.ron");
    for (const crank of [1.1, 2, 3]) {
      await page.evaluate((to) => globalThis.linkwork.move("theta1", to), crank);
      const [name, shown, read] = await page.$eval("#readings", (all) => [all.querySelector("th").textContent, all.querySelector("td").title, all.querySelector("td").textContent]);
      // law of cosines on l0 = 5, l1 = 1, l2 = 3, l3 = 4
      const cosine = (9 + 16 - (26 - 10 * Math.cos(crank))) / 24;
      const angle = (Math.acos(Math.abs(cosine)) * 180) / Math.PI;
      check(name === "transmission" && Math.abs(parseFloat(shown) - angle) < 1e-5, `${name} is ${shown}, not ${angle}°`);
      // five digits are read, the others when the pointer is over them
      check(Math.abs(parseFloat(read) - angle) < 5e-3 && read.length < shown.length, `${shown} is shown as ${read}`);
    }
    await page.evaluate(() => globalThis.linkwork.watch("transmision"));
    const said = await page.$eval("#readings-said", (element) => element.textContent);
    check(said.includes("transmision"), `a wrong name is answered by: ${said}`);
  },

  async "a load is put on a body and dragged, and the forces follow"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.click("#place-load");
    const at = await page.evaluate(() => globalThis.picture.pixelOf("left.1"));
    await dragged(page, at, [0, 0]);
    // virtual work: what holds the crank does the opposite of the moment of the load about its pivot
    const state = () => page.evaluate(() => {
      const { scene, forces } = globalThis.linkwork.frame;
      const arrow = scene.arrows.find((of) => of.applied);
      const [x, y] = arrow.at;
      return { force: arrow.force, moment: x * arrow.force[1] - y * arrow.force[0], held: parseFloat(forces.held[0][1]), tip: globalThis.picture.pixel(globalThis.picture.scenery.arrows.tip(arrow).toArray()) };
    });
    const first = await state();
    check(Math.hypot(...first.force) === 10, `the load is ${first.force} N`);
    check(Math.abs(first.held + first.moment) < 1e-4, `${first.held} N·m balance ${first.moment} N·m`);
    await dragged(page, first.tip, [45, 10]);
    const second = await state();
    check(Math.abs(second.force[0]) > 1, `the load is ${second.force} N after it was dragged`);
    check(Math.abs(second.held + second.moment) < 1e-4, `${second.held} N·m balance ${second.moment} N·m`);
    await page.evaluate(() => globalThis.linkwork.move("theta1", 2));
    const third = await state();
    check(Math.abs(third.held + third.moment) < 1e-4 && third.held !== second.held, "the forces do not follow the crank");
    await page.click("#remove-load");
    check(await page.evaluate(() => !globalThis.linkwork.frame.scene.arrows), "the load stays");
  },

  async "a freedom gained at a dead point is shown moving"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => globalThis.holding.hold("phi1"));
    const home = (await values(page))[2];
    check((await page.$eval("#gained", (of) => of.textContent)) === "", "a freedom is gained at home");
    await page.evaluate((to) => globalThis.linkwork.move("phi1", to), home + 2);
    await page.waitForFunction(() => document.getElementById("gained").textContent !== "");
    const picture = () => page.evaluate(() => document.getElementById("canvas").toDataURL());
    const before = await picture();
    await new Promise((done) => setTimeout(done, 400));
    check((await picture()) !== before, "it does not move");
    await page.evaluate((to) => globalThis.linkwork.move("phi1", to), home);
    check((await page.$eval("#gained", (of) => of.textContent)) === "", "it is shown where there is none");
  },

  async "assemblies are listed, and a click goes to one"() {
    const page = await loaded("mechanisms/three_rps.ron");
    await page.click("#list-modes");
    await page.waitForSelector("#mode-list button", { timeout: 120_000 });
    const modes = await page.$$("#mode-list button");
    check(modes.length === 8, `${modes.length} assemblies are listed`);
    await modes[5].click();
    const pressed = await page.$$eval("#mode-list button", (all) => all.map((b) => b.getAttribute("aria-pressed")));
    check(pressed.indexOf("true") === 5, `marked are ${pressed}`);
  },

  async "what is held is chosen by a click, whole platforms too"() {
    const page = await loaded("mechanisms/four_bar.ron");
    const held = () => page.evaluate(() => globalThis.linkwork.frame.held.join(" "));
    await page.click("[data-name=phi1][type=checkbox]");
    check((await held()) === "phi1", `held is ${await held()}`);
    const platform = await loaded("mechanisms/stewart_gough_6ups.ron");
    const all = ["x", "y", "z", "roll", "pitch", "yaw"].map((c) => `top.${c}`);
    check(await platform.evaluate((names) => globalThis.linkwork.holds(names), all), "a platform cannot be held whole");
    await platform.evaluate(() => globalThis.linkwork.move("top.z", 0.95));
    await platform.evaluate(() => globalThis.linkwork.move("top.x", 0.05));
    const at = (await values(platform)).slice(-6);
    check(Math.abs(at[2] - 0.95) < 1e-9 && Math.abs(at[0] - 0.05) < 1e-9, `the platform is at ${at}`);
    check((await said(platform)) === "", await said(platform));
  },

  async "a sweep marks dead points, and its cursor moves the picture"() {
    const page = await loaded("mechanisms/chebyshev.ron");
    await page.evaluate(() => document.querySelectorAll("details").forEach((part) => (part.open = true)));
    await page.click("#sweep");
    await page.waitForSelector("#play:not([disabled])", { timeout: 60_000 });
    const words = await page.$eval("#motion-said", (element) => element.textContent);
    check((words.match(/dead point/g) ?? []).length === 2, words);
    const picture = () => page.evaluate(() => document.getElementById("canvas").toDataURL());
    const before = await picture();
    await page.$eval("#cursor", (cursor) => {
      cursor.value = "30";
      cursor.dispatchEvent(new Event("input"));
    });
    await drawn(page);
    check((await picture()) !== before, "the cursor does not move the picture");
  },

  async "keys move what is held"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.focus("#canvas");
    for (let i = 0; i < 3; i++) await page.keyboard.press("ArrowRight");
    const [theta1] = await values(page);
    check(Math.abs((theta1 * 180) / Math.PI - 63) < 1e-9, `theta1 is ${theta1}`);
  },

  async "a parameter that leaves no assembly is refused"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => globalThis.linkwork.set([["l2", "3.2"]]));
    check((await page.evaluate(() => globalThis.linkwork.file.set.length)) === 1, "l2 is not set");
    await page.evaluate(() => globalThis.linkwork.set([["l2", "0.2"]]));
    check((await page.evaluate(() => globalThis.linkwork.file.set[0][1])) === "3.2", "the old value is not kept");
    check((await said(page)).includes("l2 = 0.2"), await said(page));
  },

  async "a page without a mechanism is a gallery of all that are shipped"() {
    const page = await opened("");
    await page.waitForSelector("#gallery[open]");
    const names = await page.$$eval("#gallery-items button", (all) => all.map((item) => item.dataset.file));
    const shipped = [...files, ...loads].map((file) => file.replace("mechanisms/", ""));
    check(JSON.stringify(names.toSorted()) === JSON.stringify(shipped.toSorted()), `shown are ${names}`);
    await page.click('#gallery-items button[data-file="delta.ron"]');
    check((await page.$eval("#name", (element) => element.textContent)) === "Delta robot", "another is opened");
    check(page.complaints.length === 0, page.complaints.join("; "));
    await page.close();
  },

  async "a watched page shows its file anew when it is saved"() {
    if (!program) return;
    const path = join(folder, "watched.ron");
    const text = readFileSync(join(root, "mechanisms/four_bar.ron"), "utf8");
    writeFileSync(path, text);
    const server = spawn(program, ["view", "--watch", path], { stdio: ["ignore", "pipe", "inherit"] });
    try {
      const [line] = await once(server.stdout, "data");
      const page = await browser.newPage();
      await page.goto(String(line).split(" ")[0]);
      await page.waitForSelector("html[data-ready]");
      await page.evaluate(() => globalThis.linkwork.move("theta1", 1.2));
      writeFileSync(path, text.replace("4-bar, broken", "Changed, broken"));
      await page.waitForFunction(() => document.getElementById("name").textContent.startsWith("Changed"));
      check(Math.abs((await values(page))[0] - 1.2) < 1e-9, "the mechanism does not stay where it was");
      await page.close();
    } finally {
      server.kill();
    }
  },

  async "problems of the editor stand at their line and column"() {
    const page = await loaded("mechanisms/four_bar.ron");
    const text = readFileSync(join(root, "mechanisms/four_bar.ron"), "utf8");
    const wrongText = text.replace(/theta: "theta1"/, 'theta: "tehta1"');
    check(wrongText !== text, "the file names theta1");
    const before = wrongText.slice(0, wrongText.indexOf("tehta1")).split("\n");
    await page.evaluate(() => (document.getElementById("file-part").open = true));
    await page.$eval("#editor", (area, content) => {
      area.value = content;
      area.dispatchEvent(new Event("input"));
    }, wrongText);
    await page.waitForSelector("#problems .error");
    const place = await page.$eval("#problems .error", (item) => [item.dataset.line, item.dataset.column, item.textContent]);
    check(Number(place[0]) === before.length, `line ${place[0]}, not ${before.length}`);
    check(Number(place[1]) === before.at(-1).length + 1, `column ${place[1]}, not ${before.at(-1).length + 1}`);
    check(place[2].includes("tehta1"), place[2]);
    await page.$eval("#editor", (area, content) => {
      area.value = content;
      area.dispatchEvent(new Event("input"));
    }, text);
    await page.waitForFunction(() => !document.querySelector("#problems .error"));
  },

  async "what is shown is taken away as SVG, PNG, GLB and as the file"() {
    const page = await loaded("mechanisms/axes/hexaglide.ron");
    const session = await page.createCDPSession();
    await session.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: folder });
    await page.evaluate(() => globalThis.linkwork.press({ point: "platform", force: [0, 0, -50] }));
    const taken = async (words, ending) => {
      const path = join(folder, `mechanisms_axes_hexaglide.${ending}`);
      await page.evaluate((words) => [...document.querySelectorAll("#panel button")].find((b) => b.textContent === words).click(), words);
      for (let i = 0; i < 600 && !existsSync(path); i++) await new Promise((done) => setTimeout(done, 50));
      return readFileSync(path);
    };
    const svg = (await taken("SVG", "svg")).toString();
    check(svg.startsWith("<svg") && svg.includes("50 N"), `the SVG begins ${svg.slice(0, 60)}`);
    const png = await taken("PNG", "png");
    check(png.subarray(1, 4).toString() === "PNG" && png.length > 5000, `the PNG has ${png.length} bytes`);
    const glb = await taken("GLB", "glb");
    const length = glb.readUInt32LE(12);
    const meshes = JSON.parse(glb.subarray(20, 20 + length).toString()).meshes.length;
    check(glb.subarray(0, 4).toString() === "glTF" && meshes > 20, `the GLB has ${meshes} meshes`);
    check((await taken("Save file", "ron")).equals(readFileSync(join(root, "mechanisms/axes/hexaglide.ron"))), "the file is another");
  },

  async "keys alone choose a file, a view and what is held"() {
    const page = await opened("");
    await page.waitForSelector("#gallery[open]");
    await page.focus('#gallery-items button[data-file="five_bar.ron"]');
    await page.keyboard.press("Enter");
    await page.waitForFunction(() => globalThis.linkwork.mechanism);
    await page.focus("#canvas");
    const before = await values(page);
    await page.keyboard.press("ArrowDown");
    const second = await page.evaluate(() => globalThis.linkwork.frame.held[1]);
    check((await said(page)).includes(second), `said is ${await said(page)}`);
    await page.keyboard.press("ArrowRight");
    const after = await values(page);
    const names = await page.evaluate(() => globalThis.linkwork.mechanism.coordinates.map((of) => of.name));
    const held = await page.evaluate(() => globalThis.linkwork.frame.held);
    check(held.every((name) => (after[names.indexOf(name)] !== before[names.indexOf(name)]) === (name === second)), "another is moved");
    // the view is turned, and in its plane moved
    for (const view of ["2", "1"]) {
      await page.focus("#canvas");
      await page.keyboard.press(view);
      const seen = () => page.evaluate(() => globalThis.picture.stage.camera.position.toArray());
      for (const key of ["a", "w"]) {
        const from = await seen();
        await page.keyboard.press(key);
        check((await seen()).some((x, i) => Math.abs(x - from[i]) > 1e-3), `${key} does not change the view ${view}`);
      }
    }
    await page.focus(`[type=range][data-name="${held[0]}"]`);
    await page.keyboard.press("ArrowRight");
    check((await values(page))[names.indexOf(held[0])] !== after[names.indexOf(held[0])], "a slider does not move by keys");
    await page.close();
  },

  async "a link holds the mechanism and where it is"() {
    const page = await opened("mechanisms/five_bar.ron");
    const name = await page.evaluate(() => globalThis.linkwork.frame.held[0]);
    await page.evaluate((of) => {
      const { linkwork } = globalThis;
      const index = linkwork.mechanism.coordinates.findIndex((c) => c.name === of);
      linkwork.move(of, linkwork.frame.values[index][0] + 0.1);
    }, name);
    const before = await values(page);
    const pressed = await page.evaluate(() => {
      const { linkwork } = globalThis;
      linkwork.press({ point: linkwork.frame.scene.bodies[1].name, force: [3, -4, 0] });
      return linkwork.pressed;
    });
    await page.evaluate(() => document.getElementById("share").click());
    await page.waitForFunction(() => location.hash.length > 10);
    const fragment = await page.evaluate(() => location.hash);
    await page.close();
    const other = await opened("mechanisms/four_bar.ron", fragment);
    const after = await values(other);
    check((await other.$eval("#name", (e) => e.textContent)).includes("5-bar") || after.length === before.length, "another mechanism is shown");
    check(after.every((value, i) => Math.abs(value - before[i]) < 1e-9), `${after} is not ${before}`);
    check(JSON.stringify(await other.evaluate(() => globalThis.linkwork.pressed)) === JSON.stringify(pressed), "the load is not linked");
    await other.close();
    const broken = await opened("mechanisms/four_bar.ron", "#m=AAAA");
    check(await broken.evaluate(() => globalThis.linkwork.frame?.assembled), "a broken link breaks the page");
    await broken.close();
  },

  async "hostile names are text and run nothing"() {
    const name = "</script><script>globalThis.bad=1</script><img src=x onerror='globalThis.bad=1'>\u202e\\\"'&";
    const text = readFileSync(join(root, "mechanisms/four_bar.ron"), "utf8");
    const quoted = name.replaceAll("\\", "\\\\").replaceAll('"', '\\"');
    const hostile = `${text.replace(/name: "[^"]*"/, () => `name: "${quoted}"`)}\n// ${"<script>bad()</script> ".repeat(4500)}\n`;
    const path = join(folder, "hostile.ron");
    writeFileSync(path, hostile);
    check(hostile.length > 100_000, "the file is not long");
    const page = await opened(path);
    check((await page.$eval("#name", (e) => e.textContent)) === name, "the name is not shown as it is");
    check(await page.evaluate(() => globalThis.bad === undefined), "a name ran");
    check((await page.$$eval("script", (all) => all.length)) === 6, "there are more scripts than the page's own");
    const inline = await page.evaluate(() => {
      const script = document.createElement("script");
      script.textContent = "globalThis.bad = 1";
      document.body.append(script);
      return globalThis.bad === undefined;
    });
    check(inline, "the policy lets a script run that is not the page's own");
    await page.close();
  },
};

await run(tests);
