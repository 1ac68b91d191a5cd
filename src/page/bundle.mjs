// Puts style, script and solver into page.html; {mechanism} is left for `linkwork view` to fill in.
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { gzipSync } from "node:zlib";
import { build } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const [wasm, out] = process.argv.slice(2);

const bundled = async (entry, define) => {
  const result = await build({
    entryPoints: [join(here, "script", entry)],
    bundle: true, minify: true, write: false, format: "iife", target: "es2022", define, legalComments: "none",
    nodePaths: [join(here, "node_modules")],
  });
  return result.outputFiles[0].text.trim();
};
const hash = (text) => `'sha256-${createHash("sha256").update(text).digest("base64")}'`;

const worker = await bundled("worker.ts");
const script = await bundled("main.ts", { WORKER: JSON.stringify(worker) });
const loader = await bundled("loader.ts");
const style = readFileSync(join(here, "style.css"), "utf8").trim();
const csp = [
  "default-src 'none'", `script-src ${hash(loader)} blob: 'wasm-unsafe-eval'`, `style-src ${hash(style)}`,
  "worker-src blob:", "img-src data: blob:", "base-uri 'none'", "form-action 'none'",
].join("; ");
const packed = (content) => gzipSync(content, { level: 9 }).toString("base64");
// as script/lzma.js unpacks it
const lzma = ["--format=raw", "--lzma1=preset=9e,lc=3,lp=0,pb=0", "--stdout", wasm];
const solver = execFileSync("xz", lzma, { maxBuffer: 2 ** 24 }).toString("base64");
const shipped = ["", "axes", "loads"].flatMap((folder) => {
  const path = join(here, "../../mechanisms", folder);
  const names = readdirSync(path).filter((name) => name.endsWith(".ron")).sort();
  return names.map((name) => [join(folder, name), readFileSync(join(path, name), "utf8")]);
});
const notices = readFileSync(join(here, "LICENSES.txt"), "utf8").replace(/&/g, "&amp;").replace(/</g, "&lt;");
const parts = {
  csp, style, loader, script: packed(script), notices, files: packed(JSON.stringify(shipped)), wasm: solver, size: statSync(wasm).size,
};
const page = readFileSync(join(here, "page.html.in"), "utf8")
  .replace(/\{(csp|style|loader|script|notices|files|wasm|size)\}/g, (_, part) => parts[part]);
writeFileSync(out, page);
console.log(`page.html: ${page.length} bytes, of which script ${parts.script.length} and solver ${parts.wasm.length}`);
