// What acts in a mechanism: weights and springs are drawn, it is let go, and the force of its drive is plotted, as the program
// computes them.
import { execFileSync } from "node:child_process";
import { loads, root } from "./files.mjs";
import { check, drawn, loaded, program, run, said, values } from "./harness.mjs";

/** Rows of the program as numbers, with their heads. */
function rows(...given) {
  const how = { cwd: root, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28 };
  const [head, ...lines] = execFileSync(program, [...given, "--format", "csv"], how).trim().split("\n");
  return { head: head.split(","), rows: lines.map((line) => line.split(",").map(Number)) };
}

const LET_GO = "mechanisms/loads/four_bar_let_go.ron";
const shown = (page, id) => page.$eval(id, (of) => of.textContent);

/** Lets a mechanism go by the button, and waits for what is said. */
async function letGo(page, time) {
  await page.evaluate((time) => {
    document.getElementById("let-go-time").value = time;
    document.getElementById("motion-said").textContent = "";
    document.getElementById("let-go").click();
  }, String(time));
  await page.waitForFunction(() => !/^(Moving …)?$/.test(document.getElementById("motion-said").textContent), { timeout: 120_000 });
  return shown(page, "#motion-said");
}

/** Where rows of the page and of the program differ by more than rounding; columns in the order of the program's heads. */
function difference(here, there, order) {
  for (const [i, row] of there.entries()) {
    for (const [k, column] of order.entries()) {
      const [a, b] = [here[i]?.[column], row[k]];
      if (!(Math.abs(a - b) <= 1e-7 * Math.max(1, Math.abs(b)))) return `row ${i}, column ${k}: ${a} and ${b}`;
    }
  }
  return here.length === there.length ? null : `${here.length} and ${there.length} rows`;
}

const tests = {
  async "a four-bar that is let go moves as the program simulates it, and keeps its energy"() {
    const page = await loaded(LET_GO);
    const before = await values(page);
    const said = await letGo(page, 1);
    check(said.startsWith("Moves for 1 s with 1 freedom."), `it is said: ${said}`);
    const here = await page.evaluate(() => {
      const { rows, plot } = globalThis.motion;
      return { columns: plot.columns, values: plot.values, states: rows.map(({ at }) => at.joints) };
    });
    const there = rows("simulate", LET_GO, "--time", "1", "--rows", "300");
    const order = there.head.map((head) => here.columns.indexOf(head));
    check(!order.includes(-1), `columns are ${here.columns} and ${there.head}`);
    const differs = difference(here.values, there.rows, order);
    check(!differs, `the page and the program differ: ${differs}`);
    const energy = here.values.map((row) => row.at(-3) + row.at(-2) - row.at(-1));
    check(energy.every((of) => Math.abs(of - energy[0]) < 1e-8), "energy is not kept");
    // pictures are of the rows
    const joints = [1, 3, 5].map((column) => here.values.map((row) => row[column]));
    check(here.states.every((state, i) => joints.every((of, k) => state[k] === of[i])), "pictures are not of the rows");
    await page.evaluate(() => globalThis.motion.stop());
    check(JSON.stringify(await values(page)) === JSON.stringify(before), "the mechanism itself has moved");
  },

  async "playing stops at the end, is paused, slowed down and begun again"() {
    const page = await loaded(LET_GO);
    await page.emulateMediaFeatures([{ name: "prefers-reduced-motion", value: "no-preference" }]);
    await letGo(page, 0.2);
    const place = () => page.$eval("#cursor", (of) => Number(of.value));
    await page.waitForFunction(() => document.getElementById("cursor").value === "300", { timeout: 20_000 });
    await page.waitForFunction(() => document.getElementById("play").textContent === "Play");
    await page.select("#speed", "0.01");
    await page.click("#again");
    await drawn(page);
    await page.click("#play");
    check((await place()) < 150, `at a hundredth of the speed it is at ${await place()}`);
    check((await shown(page, "#play")) === "Play", "it was not paused");
    await page.select("#speed", "1");
  },

  async "what stops a motion is said, and limits send joints back if that is asked for"() {
    const page = await loaded("mechanisms/four_bar.ron");
    check(/mass/.test(await letGo(page, 1)), "without masses it is let go");
    const file = "mechanisms/loads/stewart_payload.ron";
    await loaded(file);
    const ended = await letGo(page, 1);
    check(/ is at its limit of .*, and the simulation ends\./.test(ended), `the limit is said as: ${ended}`);
    await page.evaluate(() => (document.getElementById("restitution").value = "0.5"));
    const back = await letGo(page, 0.4);
    await page.evaluate(() => (document.getElementById("restitution").value = ""));
    check(/comes back from its limit/.test(back), `it does not come back: ${back}`);
    const here = await page.evaluate(() => globalThis.motion.plot.values.at(-1));
    const there = rows("simulate", file, "--time", "0.4", "--rows", "300", "--restitution", "0.5").rows.at(-1);
    check(!difference([here], [there], here.map((_, i) => i)), `after impacts: ${here} and ${there}`);
    await page.evaluate(() => (document.getElementById("let-go-time").value = "soon"));
    await page.click("#let-go");
    check(/soon/.test(await said(page)), `a wrong time is taken: ${await said(page)}`);
  },

  async "the torque over the cycle is that of the program, and its mark follows the mechanism"() {
    const file = "mechanisms/loads/four_bar_flywheel.ron";
    const page = await loaded(file);
    await page.waitForSelector("#drive-plot:not([hidden])", { timeout: 60_000 });
    const { columns, values } = await page.evaluate(() => ({ columns: globalThis.drive.plot.columns, values: globalThis.drive.plot.values }));
    const there = rows("sweep", file, "--input", "theta1=0..2*pi", "--duration", "1", "--steps", "180", "--report", "force:theta1");
    const pick = ["theta1 (rad)", "force:theta1 (N·m)"].map((head) => [columns.indexOf(head), there.head.indexOf(head)]);
    check(pick.every(([a, b]) => a >= 0 && b >= 0), `columns are ${columns} and ${there.head}`);
    const differs = difference(values.map((row) => pick.map(([a]) => row[a])), there.rows.map((row) => pick.map(([, b]) => row[b])), [0, 1]);
    check(!differs, `torques differ: ${differs}`);
    check(/force:theta1 from -?[\d.]+ N·m at [\d.]+°/.test(await shown(page, "#drive-said")), `it is said: ${await shown(page, "#drive-said")}`);
    for (const to of [2, 3, 5.5]) {
      await page.evaluate((to) => globalThis.linkwork.move("theta1", to), to);
      const row = await page.$eval("#drive-plot", (of) => Number(of.dataset.row));
      check(row === Math.round((to / (2 * Math.PI)) * 180), `at ${to} rad the mark is at row ${row}`);
    }
    await loaded("mechanisms/four_bar.ron");
    await page.waitForFunction(() => /no masses, springs or forces/.test(document.getElementById("drive-said").textContent));
  },

  async "every mechanism with loads opens, its weights and springs are seen, and it is let go or says why not"() {
    for (const name of loads) {
      const page = await loaded(name);
      const scene = await page.evaluate(() => globalThis.linkwork.frame.scene);
      check(scene.weights?.length || scene.springs?.length || name.endsWith("toggle_press.ron"), `${name} shows nothing that acts`);
      const said = await letGo(page, name.includes("andrews") ? 0.03 : 0.1);
      check(/^(Moves for|After) |mass/.test(said), `${name} says: ${said}`);
      check(page.complaints.length === 0, `${name}: ${page.complaints.join("; ")}`);
    }
  },
};

await run(tests);
