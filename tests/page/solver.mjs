// The solver out of the page, for node.
import { readFileSync } from "node:fs";
import { unpackedLzma } from "../../src/page/script/lzma.js";

export async function solver(page) {
  return instance(await compiled(page));
}

/** The module in a page. */
export async function compiled(page) {
  const html = readFileSync(page, "utf8");
  const [, size, packed] = html.match(/id="wasm" data-size="(\d+)">([^<]*)</);
  return WebAssembly.compile(unpackedLzma(Buffer.from(packed, "base64"), Number(size)));
}

/** What answers requests. */
export async function instance(module) {
  // no time passes, as in the page (src/page/script/clock.ts)
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) {
    (imports[from] ??= {})[name] = () => (/_now_|is_undefined/.test(name) ? 0 : 1);
  }
  const { exports } = await WebAssembly.instantiate(module, imports);
  const { memory, room, answer, reply } = exports;
  /** The reply as text in the solver's memory. */
  const written = (request) => {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    const at = room(bytes.length);
    new Uint8Array(memory.buffer).set(bytes, at);
    const length = answer();
    return new Uint8Array(memory.buffer, reply(), length);
  };
  const ask = (request) => JSON.parse(new TextDecoder().decode(written(request)));
  return Object.assign(ask, { written });
}
