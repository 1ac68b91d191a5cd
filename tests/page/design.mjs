// Design in the page: places are clicked and dragged, designs follow, and are those of the program; one is kept.
import { execFileSync } from "node:child_process";
import { writeFileSync } from "node:fs";
import { join } from "node:path";
import { root } from "./files.mjs";
import { check, folder, loaded, program, run } from "./harness.mjs";

/** What the program answers to a question of the page. */
function native({ text, vary, path, points, starts, exact }) {
  const [file, table] = ["design.ron", "path.csv"].map((name) => join(folder, name));
  writeFileSync(file, text);
  writeFileSync(table, points.map((at) => at.join(",")).join("\n"));
  const given = [file, "--vary", vary.map(([name, from, to]) => `${name}=${from}..${to}`).join(","), "--path", path, "--points", table, "--starts", String(starts)];
  const how = { cwd: root, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28 };
  try {
    return JSON.parse(execFileSync(program, ["design", ...given, ...(exact ? [] : ["--approximate"]), "--format", "json"], how));
  } catch (error) {
    return JSON.parse(error.stdout);
  }
}

/** Opens the section, and places points where the picture is clicked, as parts of its width and height. */
async function placed(page, places) {
  await page.evaluate(() => (document.getElementById("design").closest("details").open = true));
  await page.evaluate(() => new Promise((done) => setTimeout(done, 50)));
  await page.click("#clear-points");
  await page.evaluate(() => document.getElementById("place-points").getAttribute("aria-pressed") === "true" || document.getElementById("place-points").click());
  const box = await page.$eval("#canvas", (canvas) => canvas.getBoundingClientRect().toJSON());
  for (const [x, y] of places) await page.mouse.click(box.x + x * box.width, box.y + y * box.height);
  await page.click("#place-points");
  return box;
}

const searched = (page) => page.waitForFunction(() => document.querySelector("#designs li") && document.getElementById("stop-design").hidden && globalThis.designer.busy === "", { timeout: 240_000 });

const found = (page) => page.evaluate(() => {
  const { designs, points } = globalThis.designer;
  return { points, designs: designs.map(({ sum_of_squares, verdict, curve, file, values }) => ({ sum_of_squares, verdict, curve, file, values })) };
});

const extent = (curve) => Math.max(...[0, 1].map((axis) => Math.max(...curve.map((at) => at[axis])) - Math.min(...curve.map((at) => at[axis]))));

/** How far a place is from a curve, by its pieces. */
function off(curve, [x, y]) {
  return Math.min(...curve.slice(1).map(([bx, by], i) => {
    const [ax, ay] = curve[i];
    const [dx, dy] = [bx - ax, by - ay];
    const t = Math.min(Math.max(((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy || 1), 0), 1);
    return Math.hypot(x - ax - t * dx, y - ay - t * dy);
  }));
}

const FIVE = [[0.35, 0.55], [0.42, 0.45], [0.5, 0.42], [0.58, 0.46], [0.64, 0.55]];

const tests = {
  async "five clicked places are met by a four-bar, as the program meets them, and it follows when one is dragged"() {
    const page = await loaded("mechanisms/four_bar.ron");
    const box = await placed(page, FIVE);
    check((await page.evaluate(() => globalThis.designer.points.length)) === 5, "not five places were placed");
    const question = await page.evaluate(() => globalThis.designer.question(8));
    await searched(page);
    const here = await found(page);
    const there = native(question);
    const size = Math.hypot(here.points[4][0] - here.points[0][0], here.points[4][1] - here.points[0][1]);
    const met = (sum) => sum < 1e-16 * size * size;
    check(met(there.designs[0].sum_of_squares) && met(here.designs[0].sum_of_squares), `${here.designs[0].sum_of_squares} and ${there.designs[0].sum_of_squares}`);
    check(here.designs[0].verdict.startsWith("good"), `the best is ${here.designs[0].verdict}`);
    for (const { verdict, curve, sum_of_squares } of here.designs) {
      check(/^good|defect|limit|branches|misses|judged/.test(verdict), `a design is said to be ${verdict}`);
      // a point on another circuit is not on the curve of the first
      if (/circuit|judged/.test(verdict)) continue;
      const far = Math.max(...here.points.map((at) => off(curve, at)));
      check(far < 5e-3 * extent(curve) + Math.sqrt(sum_of_squares), `the curve of a design (${verdict}) passes ${far} m beside a place`);
    }
    // dragged: the best follows from where it was
    const [x, y] = await page.evaluate(() => globalThis.picture.pixel(globalThis.designer.points[2]));
    const [left, top] = [box.x + x, box.y + y];
    await page.mouse.move(left, top);
    await page.mouse.down();
    await page.mouse.move(left, top - 6, { steps: 3 });
    await page.mouse.up();
    check((await found(page)).points[2][1] > here.points[2][1], "the place was not dragged");
    await page.waitForFunction((file) => {
      const { best } = globalThis.designer;
      return best && best.file !== file && best.sum_of_squares < 1e-12;
    }, { timeout: 60_000 }, here.designs[0].file);
    await page.waitForFunction(() => globalThis.designer.designs.length > 1 && globalThis.designer.busy === "", { timeout: 240_000 });
    const after = await found(page);
    const { curve } = after.designs[0];
    const far = Math.max(...after.points.map((at) => off(curve, at)));
    check(far < 5e-3 * extent(curve), `the design has not followed: ${far} m from ${JSON.stringify(after.points)}, ${after.designs[0].verdict}`);
  },

  async "more places than its own numbers can meet are missed as little as the program misses them"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => (document.getElementById("design").closest("details").open = true));
    await page.select("#design-of", "own");
    await page.evaluate(() => {
      for (const box of document.querySelectorAll("#design-vary input")) if (/^l/.test(box.dataset.name)) box.click();
    });
    await placed(page, [[0.3, 0.4], [0.36, 0.3], [0.45, 0.25], [0.52, 0.3], [0.5, 0.4], [0.4, 0.47]]);
    const question = await page.evaluate(() => ({ ...globalThis.designer.question(8), text: globalThis.linkwork.file.text }));
    check(question.points.length === 6 && question.vary.length === 2, `${question.points.length} places, ${question.vary.map(([name]) => name)} vary`);
    await page.waitForSelector("#designs li", { timeout: 240_000 });
    const [here, there] = [(await found(page)).designs[0], native(question).designs[0]];
    check(there.sum_of_squares > 1e-6, "the places are met");
    check(Math.abs(here.sum_of_squares - there.sum_of_squares) < 1e-6 * there.sum_of_squares, `errors are ${here.sum_of_squares} and ${there.sum_of_squares}`);
    await page.click("#clear-points");
    await page.select("#design-of", "four-bar");
  },

  async "as many numbers as places: all exact designs, written by keyboard, and one is kept"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => (document.getElementById("design").closest("details").open = true));
    await page.click("#clear-points");
    await page.evaluate(() => new Promise((done) => setTimeout(done, 50)));
    for (const name of ["ax", "ay", "bx", "by"]) await page.evaluate((name) => {
      const box = document.querySelector(`#design-vary [data-name=${name}]`);
      box.focus();
      box.click();
    }, name);
    await page.focus("#path-points");
    await page.keyboard.type("0.1, 0.1\n0.12, 0.13\n0.15, 0.15\n0.19, 0.15\n0.21, 0.12");
    const question = await page.evaluate(() => globalThis.designer.question(8));
    check(question.exact && question.vary.length === 5, `exact: ${question.exact}, ${question.vary.map(([name]) => name)}`);
    await page.waitForFunction(() => /linkages|complex|outside|No design|design/.test(document.getElementById("design-how").textContent), { timeout: 240_000 });
    const there = native(question);
    const said = await page.$eval("#design-said", (of) => of.textContent);
    check(there.exact?.classes === 36, `the program finds ${there.exact?.classes} linkages for generic places`);
    const { designs } = await found(page);
    check(designs.length === there.designs.length, `${designs.length} designs and ${there.designs.length}: ${said}`);
    for (const [i, design] of there.designs.entries()) {
      const same = designs.some(({ values }) => values.every((value, k) => Math.abs(value - design.values[k]) < 1e-6 * (1 + Math.abs(value))));
      check(same, `design ${i + 1} of the program is not in the page`);
    }
    if (designs.length) {
      await page.focus("[data-design='0']");
      await page.keyboard.press("Enter");
      const kept = await page.evaluate(() => ({ text: globalThis.linkwork.file.text, editor: document.getElementById("editor").value, assembled: globalThis.linkwork.frame.assembled }));
      check(kept.text === designs[0].file && kept.editor === kept.text && kept.assembled, "the design was not kept");
    }
  },

  async "what cannot be asked is refused with a remedy"() {
    const page = await loaded("mechanisms/four_bar.ron");
    await page.evaluate(() => {
      document.getElementById("design").closest("details").open = true;
      document.getElementById("design-of").value = "own";
      document.getElementById("design-of").dispatchEvent(new Event("change"));
    });
    await page.$eval("#design-point", (field) => {
      field.value = "nowhere+u,v";
      field.dispatchEvent(new Event("change"));
    });
    await page.$eval("#path-points", (area) => {
      area.value = "1, 1\n2, 2\n3, 1";
      area.dispatchEvent(new Event("input"));
    });
    await page.waitForFunction(() => /nowhere/.test(document.getElementById("design-said").textContent), { timeout: 60_000 });
    check((await page.$$("#designs li")).length === 0, "designs for a point that is nowhere");
    await page.evaluate(() => {
      document.getElementById("design-of").value = "four-bar";
      document.getElementById("design-of").dispatchEvent(new Event("change"));
    });
    const more = (text) => page.$eval("#design-more", (area, text) => {
      area.value = text;
      area.dispatchEvent(new Event("change"));
    }, text);
    await more('at_least: { "transmision": "40 deg" }');
    await page.waitForFunction(() => /transmision/.test(document.getElementById("design-said").textContent), { timeout: 60_000 });
    await more('vary: { "l1": (0.5, 0.6) }, at_least: { "l2/l1": 1 }');
    await searched(page);
    const kept = (await found(page)).designs.filter(({ verdict }) => verdict.startsWith("good"));
    check(kept.length > 0, "no design keeps the bounds");
    for (const { file } of kept) {
      const [l1, l2] = ["l1", "l2"].map((name) => Number(new RegExp(`"${name}": ([0-9.e-]+)`).exec(file)[1]));
      check(l1 >= 0.5 && l1 <= 0.6 && l2 >= l1, `links of ${l1} and ${l2} m`);
    }
    await more("");
  },
};

await run(tests);
