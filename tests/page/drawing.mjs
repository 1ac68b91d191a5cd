// Mechanisms are drawn with the mouse and with the keyboard alone, from the empty page; the file beside follows both ways.
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { check, drawn, folder, opened, run } from "./harness.mjs";

const rest = (ms) => new Promise((done) => setTimeout(done, ms));

/** An empty page with a new drawing. */
async function begun() {
  const page = await opened("");
  await page.setViewport({ width: 1200, height: 800 });
  await page.waitForSelector("#gallery[open]");
  await page.keyboard.press("Escape");
  await page.click("#new");
  await page.click("#new-drawing");
  await drawn(page);
  return page;
}

/** Where a place in mm is on the screen. */
const pixel = (page, [x, y]) => page.evaluate((at) => {
  const box = document.getElementById("board").getBoundingClientRect();
  const [px, py] = globalThis.desk.board.pixel(at);
  return [box.x + px, box.y + py];
}, [x / 1000, y / 1000]);

const tool = (page, name) => page.click(`[data-tool=${name}]`);

/** After a change of the text the board has no sketch until the solver has answered. */
const sketched = (page) => page.waitForFunction(() => globalThis.desk.sketch);

async function clicked(page, at) {
  await page.mouse.click(...(await pixel(page, at)));
  await drawn(page);
}

async function dragged(page, from, to) {
  const [a, b] = [await pixel(page, from), await pixel(page, to)];
  await page.mouse.move(...a);
  await page.mouse.down();
  for (let i = 1; i <= 4; i++) await page.mouse.move(a[0] + ((b[0] - a[0]) * i) / 4, a[1] + ((b[1] - a[1]) * i) / 4);
  await page.mouse.up();
  await drawn(page);
}

const text = (page) => page.evaluate(() => globalThis.linkwork.file.text);

/** Undoes a change, and waits until the solver has answered about the text as it was. */
async function undone(page) {
  const before = await text(page);
  await page.click("#undo");
  await page.waitForFunction((before) => globalThis.linkwork.file.text !== before && globalThis.desk.sketch, {}, before);
}
const status = async (page) => {
  await rest(400);
  return page.$eval("#desk-count", (element) => element.textContent);
};

/** The places of joints and points in mm, as the board has them. */
const places = (page) => page.evaluate(() => {
  const { joints, tips } = globalThis.desk.sketch;
  const all = [...joints.map(({ name, spots }) => [name, spots[0].at]), ...tips.map(({ name, spot }) => [name, spot.at])];
  return Object.fromEntries(all.map(([name, at]) => [name, at.map((x) => 1000 * x)]));
});

const apart = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1]);

/** Changes a dimension by a click on it. */
async function measured(page, name, length) {
  await page.evaluate((name) => document.querySelector(`[data-dimension="${name}"]`).dispatchEvent(new PointerEvent("pointerdown", { bubbles: true })), name);
  await page.waitForSelector(".dimension-field");
  await page.keyboard.type(String(length));
  await page.keyboard.press("Enter");
  await drawn(page);
}

async function fourBar(page) {
  await clicked(page, [0, 0]);
  await clicked(page, [100, 0]);
  await tool(page, "Link");
  await dragged(page, [0, 0], [20, 30]);
  await dragged(page, [20, 30], [110, 70]);
  await dragged(page, [110, 70], [100, 0]);
  await tool(page, "Point");
  await dragged(page, [65, 50], [60, 90]);
  // changes that follow at once are undone as one
  await rest(400);
}

const tests = {
  async "a four-bar with the path of a coupler point is drawn from the empty page"() {
    const page = await begun();
    const begin = Date.now();
    await fourBar(page);
    check(/^1 freedom, no redundant constraints in the plane; driven: A/.test(await status(page)), `it says: ${await status(page)}`);
    await tool(page, "Trace");
    const drawnAt = await places(page);
    const point = drawnAt[Object.keys(drawnAt).at(-1)];
    await clicked(page, point);
    await page.waitForSelector("#play:not([disabled])", { timeout: 60_000 });
    console.log(`    drawn and traced in ${Date.now() - begin} ms`);
    const states = await page.evaluate(() => globalThis.picture.scenery.traces[0].points);
    check(states.length > 100, `the path has ${states.length} places`);
    const written = await text(page);
    check(written.startsWith("Axes(") && written.includes("// every link is drawn along x"), "the comment is lost");
    for (const name of ["link1_length", "link2_length", "link3_length"]) check(written.includes(`"${name}": "`), `${name} is no parameter: ${written}`);
    // by the circles of crank and rocker: where the point is at any angle of the crank
    const [A, B, C, D] = ["A", "B", "C", "D"].map((name) => drawnAt[name]);
    const [r, l, s2] = [apart(A, B), apart(B, C), apart(C, D)];
    const along = [(C[0] - B[0]) / l, (C[1] - B[1]) / l];
    const [u, v] = [(point[0] - B[0]) * along[0] + (point[1] - B[1]) * along[1], (point[1] - B[1]) * along[0] - (point[0] - B[0]) * along[1]];
    const expected = Array.from({ length: 720 }, (_, i) => {
      const angle = (i * Math.PI) / 360;
      const pin = [A[0] + r * Math.cos(angle), A[1] + r * Math.sin(angle)];
      const far = apart(pin, D);
      const turn = Math.atan2(D[1] - pin[1], D[0] - pin[0]) + Math.acos((l * l + far * far - s2 * s2) / (2 * l * far));
      return [pin[0] + u * Math.cos(turn) - v * Math.sin(turn), pin[1] + u * Math.sin(turn) + v * Math.cos(turn)];
    });
    const missed = states.map(([x, y]) => Math.min(...expected.map((at) => apart(at, [1000 * x, 1000 * y]))));
    check(Math.max(...missed) < 0.5, `the path is up to ${Math.max(...missed)} mm off`);
    // the crank turns once round: the sum of the shortest and the longest link is less than that of the others (Grashof)
    const motion = await page.$eval("#motion-said", (element) => element.textContent);
    check(/complete/.test(motion), motion);
    check(page.complaints.length === 0, page.complaints.join("; "));
    await page.close();
  },

  async "lengths are as drawn, change by a click on them, and from the file beside"() {
    const page = await begun();
    await fourBar(page);
    const before = await places(page);
    check(Math.abs(apart(before.A, before.B) - Math.hypot(20, 30)) < 0.6, JSON.stringify(before));
    await measured(page, "link1", 25);
    check((await text(page)).includes('"link1_length": "25 mm"'), await text(page));
    const after = await places(page);
    const joints = await page.evaluate(() => globalThis.desk.sketch.joints.map(({ name, spots }) => [name, spots.map(({ body }) => body)]));
    const between = (a, b) => joints.find(([, bodies]) => bodies.includes(a) && bodies.includes(b))[0];
    check(Math.abs(apart(after[between("ground", "link1")], after[between("link1", "link2")]) - 25) < 1e-3, JSON.stringify(after));
    // the file is written by hand: the board follows, and a comment stays through the next change with the mouse
    await page.evaluate(() => {
      const area = document.getElementById("editor");
      area.value = area.value.replace('"link3_length": "', '"link3_length": /* the rocker */ "').replace(/("link1_length": )"25 mm"/, '$1"22 mm"');
      area.dispatchEvent(new Event("input"));
    });
    await rest(500);
    const written = await places(page);
    check(Math.abs(apart(written[between("ground", "link1")], written[between("link1", "link2")]) - 22) < 1e-3, "the board does not follow the file");
    await tool(page, "Move");
    await dragged(page, written[between("link2", "link3")], [120, 80]);
    check((await text(page)).includes("/* the rocker */"), "a comment is lost");
    const moved = (await places(page))[between("link2", "link3")];
    check(apart(moved, [120, 80]) < 3, `the pin is at ${moved}`);
    // and all of it is undone
    for (let i = 0; i < 6 && (await text(page)).includes("rocker"); i++) await undone(page);
    check(!(await text(page)).includes("rocker"), "undo does not reach the drawing");
    await page.close();
  },

  async "pins on ground are undone and redone one by one, and are not of another drawing"() {
    const page = await begun();
    const pins = () => page.evaluate(() => globalThis.desk.pins.length);
    await rest(400);
    for (const at of [[0, 0], [50, 0]]) {
      await clicked(page, at);
      await rest(400);
    }
    const seen = [await pins()];
    for (const way of ["undo", "undo", "redo", "redo", "undo"]) {
      await page.click(`#${way}`);
      seen.push(await pins());
    }
    check(JSON.stringify(seen) === "[2,1,0,1,2,1]", `pins after each: ${seen}`);
    await page.click("#new");
    await page.select("#leg-kind", "RRR");
    await page.click("#new-platform");
    await drawn(page);
    check((await pins()) === 0, "a pin of the drawing is left");
    await page.close();
  },

  async "a slider crank, its freedoms and what cannot be assembled are said while it is drawn"() {
    const page = await begun();
    await clicked(page, [0, 0]);
    await tool(page, "Link");
    await dragged(page, [0, 0], [0, 40]);
    await dragged(page, [0, 40], [100, 0]);
    check(/^2 freedoms/.test(await status(page)), `an open chain of two links has ${await status(page)}`);
    await tool(page, "Slider");
    await dragged(page, [100, 0], [150, 0]);
    check(/^1 freedom,/.test(await status(page)), `a slider crank has ${await status(page)}`);
    check((await text(page)).includes("Prismatic("), await text(page));
    await measured(page, "link2", 30);
    check(/Cannot be assembled/.test(await status(page)), `a rod that is too short: ${await status(page)}`);
    await undone(page);
    check(/^1 freedom,/.test(await status(page)), `after undo: ${await status(page)}`);
    await page.close();
  },

  async "links are welded, split, geared, driven, attached and deleted, and rods are drawn"() {
    const page = await begun();
    await fourBar(page);
    const names = async () => (await sketched(page), page.evaluate(() => [...globalThis.desk.sketch.places.keys()].length));
    const joints = async () => (await sketched(page), page.evaluate(() => globalThis.desk.sketch.joints.map(({ name, spots }) => [name, spots[0].at.map((x) => 1000 * x), spots.map(({ body }) => body)])));
    const pin = async (a, b) => (await joints()).find(([, , bodies]) => bodies.includes(a) && bodies.includes(b))[1];
    check((await names()) === 4, `${await names()} bodies`);
    await tool(page, "Weld");
    await clicked(page, await pin("link2", "link3"));
    check((await names()) === 3 && /^0 freedoms/.test(await status(page)), `welded: ${await status(page)}`);
    await undone(page);
    await tool(page, "Split");
    const [a, b] = [await pin("ground", "link3"), await pin("link2", "link3")];
    await clicked(page, [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
    check((await names()) === 5 && /^2 freedoms/.test(await status(page)), `split: ${await status(page)}`);
    await undone(page);
    await tool(page, "Drive");
    await clicked(page, await pin("ground", "link3"));
    check(new RegExp(`driven: ${(await joints()).find(([, , bodies]) => bodies.includes("ground") && bodies.includes("link3"))[0]}\\.`).test(await status(page)), `driven: ${await status(page)}`);
    await undone(page);
    // a second wheel beside, geared to the crank, with a rod to the coupler point would bind: first the gear alone
    await tool(page, "Ground");
    await clicked(page, [-60, 0]);
    await tool(page, "Link");
    await dragged(page, [-60, 0], [-60, 30]);
    check(/^2 freedoms/.test(await status(page)), `with a loose link: ${await status(page)}`);
    await tool(page, "Gear");
    await dragged(page, [0, 0], [-60, 0]);
    check(/^1 freedom,/.test(await status(page)) && /value: "-ratio1\*A"/.test(await text(page)), `geared: ${await status(page)}`);
    check(await page.evaluate(() => globalThis.linkwork.frame.scene.wheels?.length === 2), "no wheels are shown");
    await undone(page);
    await sketched(page);
    await tool(page, "Rod");
    const free = await page.evaluate(() => globalThis.desk.sketch.tips.at(-1).spot.at.map((x) => 1000 * x));
    await dragged(page, free, await pin("link1", "link2"));
    check(/^1 freedom,/.test(await status(page)) && (await text(page)).includes("Distance("), `with a rod: ${await status(page)}`);
    await tool(page, "Delete");
    const [p, q] = [await pin("ground", "link3"), await pin("link2", "link3")];
    await clicked(page, [(p[0] + q[0]) / 2, (p[1] + q[1]) / 2]);
    check(/^2 freedoms/.test(await status(page)), `without the rocker: ${await status(page)}`);
    await page.close();
  },

  async "a Jansen leg is drawn, and its foot goes as it should"() {
    const page = await begun();
    await page.$eval("#snap-grid", (box) => box.click());
    await page.$eval("#snap-angles", (box) => box.click());
    const begin = Date.now();
    // in mm, drawn by eye and then measured: m = 15, a = 38, l = 7.8, j = 50, k = 61.9, b = 41.5, c = 39.3, d = 40.1, e = 55.8,
    // f = 39.4, g = 36.7, h = 65.7, i = 49 (T. Jansen)
    await page.evaluate(() => globalThis.picture.stage.zoom(1.1));
    await drawn(page);
    await clicked(page, [0, 0]);
    await clicked(page, [-38, -7.8]);
    await tool(page, "Link");
    const M = [13, 7.5];
    const [J, E, K, F, T] = [[-20, 29], [-75, 8], [-26, -45], [-63, -32], [-49, -95]];
    await dragged(page, [0, 0], M);
    await dragged(page, M, J);
    await dragged(page, J, [-38, -7.8]);
    await dragged(page, M, K);
    await dragged(page, K, [-38, -7.8]);
    await tool(page, "Point");
    const at = (a, b, part) => [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])];
    await dragged(page, at(J, [-38, -7.8], 0.5), E);
    await tool(page, "Link");
    await dragged(page, E, F);
    await dragged(page, F, K);
    await tool(page, "Point");
    await dragged(page, at(F, K, 0.5), T);
    if (process.env.SHOT) await page.screenshot({ path: process.env.SHOT });
    check(/^1 freedom,/.test(await status(page)), `it says: ${await status(page)}`);
    const dims = await page.$$eval("[data-dimension]", (all) => all.map((of) => of.dataset.dimension));
    console.log(`    dimensions: ${dims.join("; ")}`);
    const lengths = {
      link1: 15, link2: 50, link3: 41.5, link4: 61.9, link5: 39.3, link6: 39.4, link7: 36.7,
      "link3, place 1 from the first pin": 55.8, "link3, place 1 from the second pin": 40.1,
      "link7, place 1 from the first pin": 65.7, "link7, place 1 from the second pin": 49,
    };
    for (const [name, length] of Object.entries(lengths)) await measured(page, name, length);
    // as each change of a length of a triangle keeps the others, once is enough; the ground is typed into the file
    const all = await page.evaluate(() => globalThis.desk.sketch.joints.map(({ name, spots }) => ({ name, bodies: spots.map(({ body }) => body), at: spots[0].at.map((x) => 1000 * x) })));
    const pin = (a, b) => all.find(({ bodies }) => bodies.includes(a) && bodies.includes(b)).at;
    const foot = await page.evaluate(() => globalThis.desk.sketch.tips.at(-1).spot.at.map((x) => 1000 * x));
    const expected = [
      [pin("ground", "link1"), pin("link1", "link2"), 15], [pin("link1", "link2"), pin("link2", "link3"), 50],
      [pin("link2", "link3"), pin("link3", "link6"), 55.8], [pin("link3", "link6"), pin("ground", "link3"), 40.1],
      [pin("link6", "link7"), foot, 65.7], [pin("link4", "link7"), foot, 49],
    ];
    for (const [a, b, length] of expected) check(Math.abs(apart(a, b) - length) < 0.01, `${apart(a, b)} is not ${length}`);
    await tool(page, "Trace");
    await clicked(page, foot);
    await page.waitForSelector("#play:not([disabled])", { timeout: 60_000 });
    console.log(`    drawn and traced in ${Date.now() - begin} ms`);
    check(/complete/.test(await page.$eval("#motion-said", (element) => element.textContent)), "the crank does not turn round");
    // the foot steps about 70 mm far, nearly straight, and lifts
    const path = await page.evaluate(() => globalThis.picture.scenery.traces[0].points.map(([x, y]) => [1000 * x, 1000 * y]));
    const low = Math.min(...path.map(([, y]) => y));
    const ground = path.filter(([, y]) => y < low + 5).map(([x]) => x);
    const stride = Math.max(...ground) - Math.min(...ground);
    check(stride > 40 && stride < 90, `the stride is ${stride} mm`);
    writeFileSync(join(folder, "jansen.ron"), await text(page));
    await page.close();
  },

  async "the keyboard alone draws a four-bar, measures it, drives it and traces a point of it"() {
    const page = await opened("");
    await page.setViewport({ width: 1200, height: 800 });
    await page.waitForSelector("#gallery[open]");
    const key = async (name, times = 1) => {
      for (let i = 0; i < times; i++) await page.keyboard.press(name);
    };
    /** So many steps of the grid, then Enter. */
    const go = async (right, up) => {
      for (const [steps, way] of [[right, ["ArrowRight", "ArrowLeft"]], [up, ["ArrowUp", "ArrowDown"]]]) {
        const arrow = way[Number(steps < 0)];
        await page.keyboard.down("Shift");
        await key(arrow, Math.floor(Math.abs(steps) / 5));
        await page.keyboard.up("Shift");
        await key(arrow, Math.abs(steps) % 5);
      }
      await key("Enter");
    };
    const active = () => page.evaluate(() => document.activeElement.id || document.activeElement.className || document.activeElement.dataset.dimension);
    await key("Escape");
    for (let i = 0; i < 10 && (await active()) !== "new"; i++) await key("Tab");
    await key("Enter", 2);
    await drawn(page);
    check((await active()) === "board", `the focus is on ${await active()}`);
    // Ground is chosen: two pins, then from one to the other
    await go(0, 0);
    await go(20, 0);
    await key("l");
    await go(-20, 0);
    await go(0, 7);
    await go(0, 0);
    await go(20, 5);
    await go(0, 0);
    await go(0, -12);
    check(/^1 freedom,/.test(await status(page)), `it says: ${await status(page)}`);
    // a point from the middle of the coupler upwards, the rocker driven, the point traced
    await key("p");
    await go(-8, 10);
    await go(0, 5);
    const tip = await page.evaluate(() => globalThis.desk.sketch.tips.length);
    check(tip === 1, `${tip} points are drawn`);
    await key("d");
    await go(8, -15);
    check(/driven: D\./.test(await status(page)), `it says: ${await status(page)}`);
    // Tab comes to the dimensions
    await key("Tab");
    await key("Enter");
    check(/dimension-field/.test(await active()), `the focus is on ${await active()}`);
    await page.keyboard.type("71");
    await key("Enter");
    await drawn(page);
    check((await text(page)).includes('"link1_length": "71 mm"'), await text(page));
    await key("t");
    await go(-8, 15);
    await page.waitForSelector("#play:not([disabled])", { timeout: 60_000 });
    // the rocker swings between its dead points, and the path with it
    const [places, words] = await page.evaluate(() => [globalThis.picture.scenery.traces[0].points.length, document.getElementById("motion-said").textContent]);
    check(places > 10 && /dead point/.test(words), `${places} places: ${words}`);
    await page.close();
  },

  async "a picture and a DXF outline stand behind the drawing, to scale"() {
    const page = await begun();
    const dxf = ["0", "SECTION", "2", "HEADER", "9", "$INSUNITS", "70", "4", "0", "ENDSEC", "0", "SECTION", "2", "ENTITIES",
      "0", "LINE", "10", "0", "20", "0", "11", "80", "21", "0", "0", "CIRCLE", "10", "40", "20", "20", "40", "10",
      // half a circle below its chord; a parabola; a text
      "0", "LWPOLYLINE", "70", "0", "10", "0", "20", "0", "42", "1", "10", "40", "20", "0",
      "0", "SPLINE", "71", "2", ...[0, 0, 0, 1, 1, 1].flatMap((knot) => ["40", String(knot)]), "10", "0", "20", "0", "10", "10", "20", "20", "10", "20", "20", "0",
      "0", "TEXT", "1", "M8", "0", "ENDSEC", "0", "EOF"].join("\n");
    const path = join(folder, "outline.dxf");
    writeFileSync(path, dxf);
    await (await page.$("#background-file")).uploadFile(path);
    await page.waitForSelector("#board path.background");
    const middles = await page.evaluate(() => globalThis.desk.backdrop.outline.lines.slice(2).map((line) => line[line.length >> 1].map((x) => 1000 * x)));
    for (const [k, at] of [[20, -20], [10, 10]].entries()) check(apart(middles[k], at) < 1e-9, `the middle of curve ${k + 1} is at ${middles[k]}`);
    check(/Not drawn: TEXT\./.test(await page.$eval("#desk-said", (of) => of.textContent)), "what is not drawn is not said");
    const d = await page.$eval("#board path.background", (outline) => outline.getAttribute("d"));
    const [x1, y1, x2] = d.match(/[\d.-]+/g).map(Number);
    const wanted = [await pixel(page, [0, 0]), await pixel(page, [80, 0])];
    const box = await page.$eval("#board", (board) => board.getBoundingClientRect().toJSON());
    check(Math.abs(x1 + box.x - wanted[0][0]) < 1 && Math.abs(y1 + box.y - wanted[0][1]) < 1 && Math.abs(x2 + box.x - wanted[1][0]) < 1, `the line goes from ${x1}, ${y1} to ${x2}`);
    const picture = join(folder, "machine.png");
    writeFileSync(picture, Buffer.from("iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAYAAAD0In+KAAAAD0lEQVR4nGNgYGD4D8YAAAoAAf/n0wcAAAAASUVORK5CYII=", "base64"));
    await (await page.$("#background-file")).uploadFile(picture);
    await page.waitForSelector("#board image.background", { timeout: 5000 }).catch(() => undefined);
    const shown = await page.evaluate(() => document.querySelector("#board image.background") !== null);
    check(shown, await page.$eval("#desk-said", (element) => element.textContent));
    if (shown) {
      await page.click("#background-scale");
      await clicked(page, [0, 0]);
      await clicked(page, [50, 0]);
      await page.waitForSelector(".dimension-field");
      const before = await page.evaluate(() => globalThis.desk.backdrop.image.size[0]);
      await rest(50);
      await page.keyboard.type("100");
      await page.keyboard.press("Enter");
      const after = await page.evaluate(() => globalThis.desk.backdrop.image.size[0]);
      check(Math.abs(after / before - 2) < 0.02, `it became ${after / before} times as large`);
    }
    check(page.complaints.length === 0, page.complaints.join("; "));
    await page.close();
  },

  async "a file that was written by hand is drawn on, and one of tables says that it is not"() {
    const page = await opened("mechanisms/axes/four_bar.ron");
    await page.setViewport({ width: 1200, height: 800 });
    await page.click("#edit");
    await drawn(page);
    check(/^1 freedom,/.test(await status(page)), `it says: ${await status(page)}`);
    const before = await text(page);
    await tool(page, "Point");
    const { phi2, phi3 } = await places(page);
    await dragged(page, phi2.map((x, i) => (x + phi3[i]) / 2), [1500, 3200]);
    const after = await text(page);
    const comments = (of) => of.match(/\/\/.*/g).join("\n");
    check(comments(after) === comments(before) && after.includes('(body: "coupler"'), after);
    check(after.includes('"l0": 5, "l1": 1, "l2": 3, "l3": 4,'), "parameters are lost");
    const point = Object.entries(await places(page)).at(-1)[1];
    check(apart(point, [1500, 3200]) < 150, `the point is at ${point}`);
    await page.close();
    const tables = await opened("mechanisms/four_bar.ron");
    await tables.click("#edit");
    check(/edited as text/.test(await tables.$eval("#said", (e) => e.textContent)) && (await tables.$eval("#edit", (e) => e.getAttribute("aria-pressed"))) === "false", "tables are drawn on");
    await tables.close();
  },

  async "platforms and loops are made by their kinds"() {
    const page = await begun();
    for (const [legs, kind, held] of [["3", "RPS", 3], ["6", "UPS", 6], ["4", "RUS", 6], ["6", "PSS", 6], ["3", "RRR", 3]]) {
      await page.click("#new");
      await page.select("#legs", legs);
      await page.select("#leg-kind", kind);
      await page.click("#new-platform");
      await drawn(page);
      const found = await page.evaluate(() => [globalThis.linkwork.frame.assembled, globalThis.linkwork.frame.held.length, globalThis.linkwork.frame.figures.condition]);
      check(found[0] && found[1] === held && found[2] !== null && found[2] < 1000, `${legs}-${kind}: ${found}`);
      // a point in the middle of a platform is no corner of it
      const corners = await page.evaluate(() => {
        const { drawing } = globalThis.picture;
        const platform = globalThis.linkwork.frame.scene.bodies.findIndex((body) => body.platform);
        const plate = drawing.shapes.group.children.find((mesh) => mesh.visible && mesh.material.transparent && mesh.userData.body === platform);
        return plate && plate.geometry.getAttribute("position").count / 3 + 2;
      });
      check(corners === undefined || corners === Number(legs), `the platform on ${legs} legs has ${corners} corners`);
      // it is looked at, not drawn on
      check((await page.$eval("#edit", (of) => of.getAttribute("aria-pressed"))) === "false", `${legs}-${kind} is on the drawing board`);
    }
    await page.click("#new");
    await page.select("#legs", "6");
    await page.select("#leg-kind", "PRS");
    await page.click("#new-platform");
    check(/choose 2 or 3 legs/.test(await page.$eval("#new-said", (of) => of.textContent)), "six PRS legs are made");
    await page.keyboard.press("Escape");
    for (const [kinds, axes] of [["RRRR", "through one point"], ["RRRRRRR", "skew"], ["RSSR", "skew"], ["RRRP", "parallel"]]) {
      await page.click("#new");
      await page.$eval("#loop-kinds", (field, kinds) => (field.value = kinds), kinds);
      await page.select("#loop-axes", axes);
      await page.click("#new-loop");
      await drawn(page);
      const found = await page.evaluate(() => [globalThis.linkwork.frame.assembled, globalThis.linkwork.frame.held.length]);
      check(found[0] && found[1] === 1, `${kinds}: ${found}`);
    }
    await page.close();
  },
};

await run(tests);
