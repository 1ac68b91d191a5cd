// A mechanism file as a tree with places in its text, so that a change of one value leaves all else as it is written.

export interface Node {
  kind: "call" | "map" | "list" | "string" | "atom";
  from: number;
  to: number;
  /** The name of a call, the content of a string, an atom as it is written. */
  text: string;
  /** With the names of fields or keys; of a list and of positions the names are empty. */
  entries: Entry[];
}

export interface Entry {
  key: string;
  from: number;
  to: number;
  value: Node;
}

class Reader {
  private at = 0;

  constructor(private readonly text: string) {}

  whole(): Node | null {
    const node = this.node();
    this.skip();
    return node;
  }

  private skip() {
    const blank = /(?:\s+|\/\/[^\n]*|\/\*[^]*?\*\/)*/y;
    blank.lastIndex = this.at;
    blank.exec(this.text);
    this.at = blank.lastIndex;
  }

  private take(pattern: RegExp): string | null {
    pattern.lastIndex = this.at;
    const found = pattern.exec(this.text);
    if (!found) return null;
    this.at = pattern.lastIndex;
    return found[0];
  }

  private node(): Node | null {
    this.skip();
    const from = this.at;
    const quoted = this.take(/"(?:[^"\\]|\\.)*"/y);
    if (quoted !== null) return { kind: "string", from, to: this.at, text: unquoted(quoted), entries: [] };
    const open = this.text[this.at];
    if (open === "{" || open === "[") return this.inside(open === "{" ? "map" : "list", "", from);
    const word = this.take(/[^\s,:(){}[\]"/]+/y) ?? "";
    this.skip();
    if (this.text[this.at] === "(") return this.inside("call", word, from);
    return word ? { kind: "atom", from, to: from + word.length, text: word, entries: [] } : null;
  }

  private inside(kind: "call" | "map" | "list", text: string, from: number): Node | null {
    const close = { call: ")", map: "}", list: "]" }[kind];
    this.at++;
    const entries: Entry[] = [];
    for (;;) {
      this.skip();
      if (this.text[this.at] === close) {
        this.at++;
        return { kind, from, to: this.at, text, entries };
      }
      const begin = this.at;
      let value = this.node();
      if (!value) return null;
      let key = "";
      this.skip();
      if (this.text[this.at] === ":") {
        key = value.text;
        this.at++;
        value = this.node();
        if (!value) return null;
      }
      entries.push({ key, from: begin, to: value.to, value });
      this.at = value.to;
      this.skip();
      if (this.text[this.at] === ",") this.at++;
      else if (this.text[this.at] !== close) return null;
    }
  }
}

/** The tree of a file; nothing if it is not one. */
export function read(text: string): Node | null {
  return new Reader(text).whole();
}

export function field(node: Node | undefined | null, key: string): Node | undefined {
  return node?.entries.find((entry) => entry.key === key)?.value;
}

export function quoted(text: string): string {
  return `"${text.replaceAll("\\", "\\\\").replaceAll('"', '\\"')}"`;
}

function unquoted(text: string): string {
  return text.slice(1, -1).replace(/\\(.)/g, "$1");
}

/** Changes of a text, made together. */
export class Changes {
  private readonly made: { from: number; to: number; by: string; order: number }[] = [];

  constructor(readonly text: string) {}

  replace(from: number, to: number, by: string) {
    this.made.push({ from, to, by, order: this.made.length });
  }

  /** Puts an entry last into a map or a call. */
  append(into: Node, entry: string) {
    const { text } = this;
    const line = text.lastIndexOf("\n", into.from) + 1;
    const outer = /^\s*/.exec(text.slice(line))![0];
    const indent = `${outer}    `;
    const last = into.entries.at(-1);
    if (!last) {
      const begin = text.indexOf(into.kind === "map" ? "{" : "(", into.from) + 1;
      const blank = text.slice(begin, into.to - 1).trim() === "";
      this.replace(begin, blank ? into.to - 1 : begin, `\n${indent}${entry},\n${outer}`);
      return;
    }
    const after = /^(?:\s|\/\/[^\n]*|\/\*[^]*?\*\/)*,/.exec(text.slice(last.to, into.to));
    let place = last.to + (after?.[0].length ?? 0);
    // past a comment that stands behind the last entry
    place += /^[ \t]*(?:\/\/[^\n]*)?(?=\n)/.exec(text.slice(place))?.[0].length ?? 0;
    if (!after) this.replace(last.to, last.to, ",");
    const ends = text.slice(place, into.to - 1).includes("\n");
    this.replace(place, place, `\n${indent}${entry},${ends ? "" : `\n${outer}`}`);
  }

  remove(entry: Entry) {
    const { text } = this;
    let { from, to } = entry;
    to += /^\s*,?/.exec(text.slice(to))![0].length;
    const begin = text.lastIndexOf("\n", from);
    const alone = begin >= 0 && text.slice(begin, from).trim() === "";
    const rest = /^[ \t]*(?:\/\/[^\n]*)?(?=\n)/.exec(text.slice(to))?.[0].length;
    if (alone && rest !== undefined) [from, to] = [begin, to + rest];
    else to += /^[ \t]*/.exec(text.slice(to))![0].length;
    this.replace(from, to, "");
  }

  get any(): boolean {
    return this.made.length > 0;
  }

  done(): string {
    // what lies inside of what is replaced goes with it; of two changes of one place the later counts
    const { made } = this;
    const lost = (a: (typeof made)[0]) => made.some((b) => {
      if (b === a) return false;
      if (a.from === a.to) return b.from < a.from && a.from < b.to;
      if (b.from === a.from && b.to === a.to) return b.order > a.order;
      return b.from <= a.from && a.to <= b.to;
    });
    const left = made.filter((a) => !lost(a));
    let text = this.text;
    for (const { from, to, by } of left.toSorted((a, b) => b.from - a.from || b.to - a.to || b.order - a.order)) {
      text = text.slice(0, from) + by + text.slice(to);
    }
    return text;
  }
}
