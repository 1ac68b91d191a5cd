// Parts of the page that are compressed.
import { unpackedLzma } from "./lzma";

/** Of a browser that is new enough. */
const { fromBase64 } = Uint8Array as unknown as { fromBase64?: (text: string) => Uint8Array<ArrayBuffer> };

function bytes(element: HTMLElement | null): Uint8Array<ArrayBuffer> {
  const base64 = element?.textContent?.trim() ?? "";
  if (fromBase64) return fromBase64.call(Uint8Array, base64);
  const text = atob(base64);
  const found = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++) found[i] = text.charCodeAt(i);
  return found;
}

/** What is written as base64 of gzip in an element of the page. */
export function unpacked(element: string): Response {
  const packed = bytes(document.getElementById(element));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream);
}

/** The solver, which is written as base64 of LZMA. */
export function unpackedSolver(): Uint8Array<ArrayBuffer> {
  const element = document.getElementById("wasm");
  return unpackedLzma(bytes(element), Number(element?.dataset.size));
}
