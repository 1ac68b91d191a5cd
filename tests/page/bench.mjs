// How fast the solver in the page is, beside the program on one thread: `node tests/page/bench.mjs`, with the program,
// built with --release, in LINKWORK. Steps are medians, whole answers means; what is wanted is in brackets.
import { execFileSync } from "node:child_process";
import { readFileSync, statSync } from "node:fs";
import { join } from "node:path";
import { root } from "./files.mjs";
import { solver } from "./solver.mjs";

const page = process.env.PAGE ?? join(root, "src/page/page.html");
const text = (file) => readFileSync(join(root, "mechanisms", file), "utf8");

function median(times) {
  return times.toSorted((a, b) => a - b)[times.length >> 1];
}

/** Milliseconds of each of so many calls, after some that warm the compiler up. */
function timed(count, warm, act) {
  const times = [];
  for (let i = 0; i < warm + count; i++) {
    const begun = performance.now();
    act(i);
    if (i >= warm) times.push(performance.now() - begun);
  }
  return median(times);
}

console.log(`page ${(statSync(page).size / 1e6).toFixed(2)} MB [2.5]`);
const ask = await solver(page);

for (const file of ["four_bar.ron", "three_rps.ron", "stewart_gough_6ups.ron"]) {
  const loaded = ask({ do: "load", text: text(file) });
  const name = loaded.held[0];
  const index = loaded.mechanism.coordinates.findIndex((of) => of.name === name);
  const from = loaded.values[index][0];
  const step = (i) => {
    const reply = ask({ do: "move", to: [[name, from + 0.05 * Math.sin(i / 10)]] });
    if (reply.error) throw new Error(reply.error);
  };
  const moved = timed(200, 100, step);
  const body = loaded.scene.bodies.findIndex((of) => !of.ground && (of.lines.length || of.corners.length));
  const [at] = loaded.scene.bodies[body].corners;
  const { grip } = ask({ do: "grab", body, at });
  const pulled = timed(200, 100, (i) => {
    const to = [at[0] + 0.02 * Math.sin(i / 10), at[1] + 0.02 * Math.cos(i / 10), at[2]];
    const reply = ask({ do: "pull", grip, to });
    if (reply.error) throw new Error(reply.error);
  });
  console.log(`${file}: a step of a slider ${moved.toFixed(2)} ms, of a drag ${pulled.toFixed(2)} ms [4]`);
}

// processor time in ms of this process and of those that it has waited for, where the system tells it; else the time
function spent() {
  try {
    const fields = readFileSync("/proc/self/stat", "utf8").split(") ").at(-1).split(" ").map(Number);
    return [10 * (fields[11] + fields[12]), 10 * (fields[13] + fields[14])];
  } catch {
    return [performance.now(), performance.now()];
  }
}

/** Milliseconds of one of so many calls, of this process or of the programs it starts. */
function cost(which, count, act) {
  const before = spent()[which];
  for (let i = 0; i < count; i++) act();
  return (spent()[which] - before) / count;
}

const RUNS = 5;
const sweep = (steps, input) => ({
  asked: { do: "sweep", steps, input: [input[0], input[1], input[2]] },
  given: ["--input", `${input[0]}=${input[1]}..${input[2]}`, "--steps", String(steps)],
});
const tasks = [
  ...["stewart_gough_6sps", "three_rps", "delta", "stewart_gough_6ups", "jansen_leg", "dietmaier", "bennett"].map((name) => (
    { name, what: "assemblies", asked: { do: "ask", what: "assemblies", as_filed: true }, given: [] })),
  { name: "four_bar", what: "sweep", ...sweep(20000, ["theta1", 1.0472, 7.3304]) },
  { name: "stewart_gough_6ups", what: "sweep", ...sweep(5000, ["l1", 0.953618, 1.1]) },
  { name: "jansen_leg", what: "sweep", ...sweep(10000, ["theta", 1.5708, 7.854]) },
];
for (const { name, what, asked, given } of tasks) {
  const file = `mechanisms/${name}.ron`;
  ask({ do: "load", text: text(`${name}.ron`) });
  const { error } = ask(asked);
  if (error) throw new Error(error);
  // as the program's, the reply is written out and not read again
  const here = cost(0, RUNS, () => ask.written(asked));
  let beside = "";
  if (process.env.LINKWORK) {
    const how = { cwd: root, stdio: "ignore", env: { ...process.env, RAYON_NUM_THREADS: "1" } };
    const there = cost(1, RUNS, () => execFileSync(process.env.LINKWORK, [what, file, ...given, "--format", "json"], how));
    beside = `, the program on one thread ${there.toFixed(0)} ms: ${(here / there).toFixed(2)} times [2]`;
  }
  console.log(`${name}: ${what} ${here.toFixed(0)} ms${name === "stewart_gough_6sps" ? " [2000]" : ""}${beside}`);
}
