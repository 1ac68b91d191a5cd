// The whole mechanism and where it is, compressed in the fragment of the address, which is never sent anywhere.
import type { File, Place } from "./model";

interface Linked extends File, Place {}

async function through(bytes: Uint8Array<ArrayBuffer>, stream: CompressionStream | DecompressionStream): Promise<Uint8Array<ArrayBuffer>> {
  const out = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(out).arrayBuffer());
}

export async function written(file: File, place: Place): Promise<string> {
  const text = new TextEncoder().encode(JSON.stringify({ ...file, ...place } satisfies Linked));
  const packed = await through(text, new CompressionStream("deflate-raw"));
  const base = btoa(Array.from(packed, (byte) => String.fromCharCode(byte)).join(""));
  return `m=${base.replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "")}`;
}

/** What a fragment holds; nothing if it holds no mechanism. */
export async function read(fragment: string): Promise<Linked | null> {
  const base = fragment.match(/^#?m=([\w-]+)$/)?.[1];
  if (!base) return null;
  try {
    const bytes = Uint8Array.from(atob(base.replaceAll("-", "+").replaceAll("_", "/")), (c) => c.charCodeAt(0));
    const text = new TextDecoder().decode(await through(bytes, new DecompressionStream("deflate-raw")));
    const { file, text: content, set, held, at, load, quantities } = JSON.parse(text) as Linked;
    return { file, text: content, set, held, at, load, quantities };
  } catch {
    return null;
  }
}
