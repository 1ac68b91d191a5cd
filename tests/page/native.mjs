// The solver in the page answers as the program does: solve, assemblies and mobility of every shipped file.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { files, root } from "./files.mjs";
import { solver } from "./solver.mjs";

const page = process.env.PAGE ?? join(root, "src/page/page.html");
const program = process.env.LINKWORK;
/** Of numbers, over the larger of them and one. */
const TOLERANCE = 1e-12;
/** What tells how an answer was found: last digits decide it. */
const WORK = new Set(["steps", "evaluations", "retried", "paths", "seeds", "quiet_seeds", "loops", "quiet_loops", "complete"]);
const asked = process.argv.slice(2).length ? process.argv.slice(2) : files;

/** Rounding that a condition number magnifies: where it is some thousands, the last of twelve digits are lost. */
const ROUNDING = 16 * Number.EPSILON;

/** Where two answers differ first; nothing if they are the same. */
function difference(a, b, at, condition = 1) {
  if (typeof a === "number" && typeof b === "number") {
    let size = Math.max(1, Math.abs(a), Math.abs(b));
    // the rounding of a condition number grows with itself
    if (at.endsWith("/condition")) size *= size;
    const same = Math.abs(a - b) <= Math.max(TOLERANCE, ROUNDING * condition) * size;
    return same ? null : `${at}: ${a} and ${b}`;
  }
  if (a === null || b === null || typeof a !== "object" || typeof b !== "object") {
    return a === b ? null : `${at}: ${JSON.stringify(a)} and ${JSON.stringify(b)}`;
  }
  const own = typeof b.condition === "number" ? b.condition : condition;
  for (const key of new Set([...Object.keys(a), ...Object.keys(b)])) {
    if (WORK.has(key)) continue;
    const found = difference(a[key], b[key], `${at}/${key}`, own);
    if (found) return found;
  }
  return null;
}

/** Assemblies that the program needs so long for, in ms, are left out: the page has one thread. */
const PATIENCE = 20_000;

/** What the program answers; null if it has no answer, nothing if it needs too long. */
function native(what, file) {
  const how = { cwd: root, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28, timeout: PATIENCE, killSignal: "SIGKILL" };
  try {
    return JSON.parse(execFileSync(program, [what, file, "--format", "json"], how));
  } catch (error) {
    if (error.signal || error.code === "ETIMEDOUT") return undefined;
    // exit 1 is an answer, 2 is none
    return error.status === 1 ? JSON.parse(error.stdout) : null;
  }
}

let wrong = 0;
for (const file of asked) {
  // one solver for each file, as a page has
  const ask = await solver(page);
  const loaded = ask({ do: "load", text: readFileSync(join(root, file), "utf8") });
  if (loaded.error || loaded.problems) {
    console.log(`${file}: cannot be loaded: ${JSON.stringify(loaded).slice(0, 200)}`);
    wrong++;
    continue;
  }
  for (const what of ["solve", "assemblies", "mobility"]) {
    const then = performance.now();
    const there = native(what, file);
    const program = performance.now() - then;
    if (there === undefined) {
      console.log(`${file} ${what}: left out, it takes the program more than ${PATIENCE / 1000} s`);
      continue;
    }
    const begun = performance.now();
    const here = ask({ do: "ask", what, as_filed: true });
    const spent = performance.now() - begun;
    const found = there === null ? (here.error ? null : "the page answers, the program does not") : difference(here.report ?? null, there, "");
    if (found) wrong++;
    if (found || process.env.TIMES) {
      console.log(`${file} ${what}: ${found ?? "same"} (page ${spent.toFixed(0)} ms, program ${program.toFixed(0)} ms)`);
    }
  }
}
console.log(`${asked.length} files, ${wrong} differences`);
process.exit(wrong ? 1 : 0);
