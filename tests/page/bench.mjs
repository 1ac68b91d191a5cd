// How fast the solver in the page is, beside the program on one thread: `node tests/page/bench.mjs`, with the program
// in LINKWORK. Times are medians; what is wanted is in brackets.
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
  const { offset } = ask({ do: "grab", body, at });
  const pulled = timed(200, 100, (i) => {
    const to = [at[0] + 0.02 * Math.sin(i / 10), at[1] + 0.02 * Math.cos(i / 10), at[2]];
    ask({ do: "pull", body, offset, to });
  });
  console.log(`${file}: a step of a slider ${moved.toFixed(2)} ms, of a drag ${pulled.toFixed(2)} ms [4]`);
}

for (const [file, wanted] of [["stewart_gough_6sps.ron", "2000"], ["three_rps.ron", ""], ["delta.ron", ""]]) {
  const times = [1, 2, 3].map(() => {
    ask({ do: "load", text: text(file) });
    const begun = performance.now();
    ask({ do: "ask", what: "assemblies", as_filed: true });
    return performance.now() - begun;
  });
  let beside = "";
  if (process.env.LINKWORK) {
    const native = [1, 2, 3].map(() => {
      const begun = performance.now();
      const arguments_ = ["assemblies", join("mechanisms", file)];
      execFileSync(process.env.LINKWORK, arguments_, { cwd: root, stdio: "ignore", env: { ...process.env, RAYON_NUM_THREADS: "1" } });
      return performance.now() - begun;
    });
    beside = `, the program on one thread ${median(native).toFixed(0)} ms`;
  }
  console.log(`${file}: all assemblies ${median(times).toFixed(0)} ms${wanted && ` [${wanted}]`}${beside}`);
}
