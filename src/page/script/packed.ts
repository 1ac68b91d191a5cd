// Parts of the page that are compressed.

/** What is written as base64 of gzip in an element of the page. */
export async function unpacked(element: string): Promise<ArrayBuffer> {
  const text = document.getElementById(element)?.textContent ?? "";
  const packed = Uint8Array.from(atob(text.trim()), (c) => c.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
