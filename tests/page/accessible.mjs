// Nothing in the page is hard to read or to reach: no rule of axe is broken, light or dark, whatever is open, and Tab
// comes to everything that can be pressed or written in.
import { readFileSync } from "node:fs";
import { check, opened, run } from "./harness.mjs";

const axe = readFileSync(new URL("node_modules/axe-core/axe.min.js", import.meta.url), "utf8");
const rest = (ms) => new Promise((done) => setTimeout(done, ms));

/** A page with every section open and something in each. */
async function full(file) {
  const page = await opened(file);
  await page.setViewport({ width: 1280, height: 800 });
  await page.evaluate(() => document.querySelectorAll("#panel details").forEach((part) => (part.open = true)));
  await page.click("#list-modes");
  await page.waitForSelector("#mode-list li", { timeout: 120_000 });
  await page.click("#sweep");
  await page.waitForSelector("#play:not([disabled])", { timeout: 60_000 });
  return page;
}

async function read(page, state) {
  for (const scheme of ["light", "dark"]) {
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: scheme }]);
    await rest(100);
    await page.evaluate(axe);
    const { violations } = await page.evaluate(() => globalThis.axe.run(document, { resultTypes: ["violations"] }));
    for (const { id, nodes } of violations) check(false, `${state}, ${scheme}: ${id} at ${nodes.map((of) => of.html.slice(0, 90)).join("; ")}`);
  }
}

const tests = {
  async "no rule of axe is broken, light or dark, whatever is open"() {
    const page = await full("mechanisms/four_bar.ron");
    await page.evaluate(() => globalThis.linkwork.press({ point: "left+0.5", force: [0, -5, 0] }));
    await page.evaluate(() => globalThis.designer.set([[1, 1, 0], [2, 1.5, 0], [3, 1, 0]]));
    await page.waitForSelector("#designs li", { timeout: 120_000 });
    await page.waitForSelector("#drive-plot:not([hidden])", { timeout: 60_000 });
    await read(page, "every section open");
    await page.evaluate(() => globalThis.holding.hold("phi1"));
    for (let i = 0; i < 40; i++) await page.evaluate(() => globalThis.linkwork.move("phi1", globalThis.linkwork.frame.values[2][0] + 0.05));
    await page.waitForSelector("[data-way='1']");
    await read(page, "at a dead point");
    await page.$eval("#editor", (area) => {
      area.value = area.value.replace('theta: "theta1"', 'theta: "tehta1"');
      area.dispatchEvent(new Event("input"));
    });
    await page.waitForSelector("#problems .error");
    await read(page, "with a problem in the file");
    await page.click("#browse");
    await page.waitForSelector("#gallery[open]");
    await read(page, "the gallery");
    await page.keyboard.press("Escape");
    await page.click("#new");
    await read(page, "a new mechanism");
    await page.click("#new-drawing");
    await read(page, "the drawing board");
    await page.close();
  },

  async "Tab comes to everything"() {
    const page = await full("mechanisms/three_rps.ron");
    const wanted = await page.evaluate(() => {
      const all = [...document.querySelectorAll("button, input, select, textarea, summary, [tabindex='0']")];
      const there = all.filter((of) => !of.disabled && of.checkVisibility());
      there.forEach((of, i) => (of.dataset.reach = String(i)));
      return there.length;
    });
    const reached = new Set();
    for (let i = 0; i < wanted + 10; i++) {
      await page.keyboard.press("Tab");
      reached.add(await page.evaluate(() => document.activeElement?.dataset.reach));
    }
    const missed = await page.evaluate((reached) => [...document.querySelectorAll("[data-reach]")]
      .filter((of) => !reached.includes(of.dataset.reach)).map((of) => of.outerHTML.slice(0, 80)), [...reached].filter(Boolean));
    check(missed.length === 0, `not reached are ${missed.join("; ")}`);
    await page.close();
  },
};

await run(tests);
