// What the page bundles, with the licences of all of it: LICENSES.txt, which bundle.mjs puts into the page too.
import { execFileSync } from "node:child_process";
import { readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const here = dirname(fileURLToPath(import.meta.url));
const tree = execFileSync("cargo", [
  "tree", "--locked", "--no-default-features", "--features", "page", "--target", "wasm32-unknown-unknown",
  "--edges", "normal", "--prefix", "none", "--format", "{p} | {l}",
], { cwd: join(here, "../.."), encoding: "utf8" });
const crates = [...new Set(tree.split("\n").map((line) => line.replace(/ \(.*?\)(?= )/g, "").replace(" (*)", "").trim()))]
  .filter((line) => line && !line.startsWith("linkwork ") && !line.includes("(proc-macro)")).sort();
const three = readFileSync(join(here, "node_modules/three/LICENSE"), "utf8").trim();
const version = JSON.parse(readFileSync(join(here, "node_modules/three/package.json"), "utf8")).version;
const own = readFileSync(join(here, "../../LICENSE-APACHE"), "utf8").trim();
writeFileSync(join(here, "LICENSES.txt"), `What page.html bundles beside linkwork itself.

The script has three.js ${version}:

${three}

The solver has these Rust crates and the Rust standard library (MIT OR Apache-2.0), each under the licences named. Where
there is a choice the Apache License 2.0 is chosen; its text follows.

${crates.join("\n")}

${own}
`);
