// The solver in the page answers as the program does: solve, assemblies and mobility of every shipped file.
import { execFileSync } from "node:child_process";
import { readFileSync, statSync } from "node:fs";
import { availableParallelism } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { isMainThread, parentPort, Worker, workerData } from "node:worker_threads";
import { files, root } from "./files.mjs";
import { compiled, instance } from "./solver.mjs";

const page = process.env.PAGE ?? join(root, "src/page/page.html");
const program = process.env.LINKWORK;
/** Of numbers, over the larger of them and one. */
const TOLERANCE = 1e-12;
/** What tells how an answer was found: last digits decide it. */
const WORK = new Set(["steps", "retried", "paths", "seeds", "quiet_seeds", "loops", "quiet_loops", "complete"]);

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

/** What the program answers; null if it has no answer. */
function native(what, file) {
  const how = { cwd: root, encoding: "utf8", stdio: ["ignore", "pipe", "ignore"], maxBuffer: 1 << 28 };
  try {
    return JSON.parse(execFileSync(program, [what, file, "--format", "json"], how));
  } catch (error) {
    // exit 1 is an answer, 2 is none
    return error.status === 1 ? JSON.parse(error.stdout) : null;
  }
}

/** What differs in the answers about a file. */
async function differences(module, file) {
  // one solver for each file, as a page has
  const ask = await instance(module);
  const loaded = ask({ do: "load", text: readFileSync(join(root, file), "utf8") });
  if (loaded.error || loaded.problems) return [`cannot be loaded: ${JSON.stringify(loaded).slice(0, 200)}`];
  return ["solve", "assemblies", "mobility"].flatMap((what) => {
    const there = native(what, file);
    const here = ask({ do: "ask", what, as_filed: true });
    const found = there === null ? (here.error ? null : "the page answers, the program does not") : difference(here.report ?? null, there, "");
    return found ? [`${what}: ${found}`] : [];
  });
}

if (isMainThread) {
  const asked = process.argv.slice(2).length ? process.argv.slice(2) : files;
  const module = await compiled(page);
  // what takes longest first, so that no core waits at the end
  const size = (file) => statSync(join(root, file)).size;
  const waiting = asked.toSorted((a, b) => size(b) - size(a));
  let wrong = 0;
  const worker = () => new Promise((done, fail) => {
    const worker = new Worker(fileURLToPath(import.meta.url), { workerData: module });
    const next = () => {
      const file = waiting.shift();
      if (file) worker.postMessage(file);
      else worker.terminate().then(done, fail);
    };
    worker.on("error", fail);
    worker.on("message", ({ file, found, spent }) => {
      wrong += found.length;
      found.forEach((words) => console.log(`${file} ${words}`));
      if (process.env.TIMES) console.log(`${file}: ${spent.toFixed(0)} ms`);
      next();
    });
    next();
  });
  await Promise.all(Array.from({ length: Math.min(availableParallelism(), asked.length) }, worker));
  console.log(`${asked.length} files, ${wrong} differences`);
  process.exit(wrong ? 1 : 0);
} else {
  parentPort.on("message", async (file) => {
    const begun = performance.now();
    parentPort.postMessage({ file, found: await differences(workerData, file), spent: performance.now() - begun });
  });
}
