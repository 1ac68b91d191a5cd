// Undo and redo over everything: file, parameters, what is held, where the mechanism is, load and quantities.
import { button } from "./elements";
import type { File, Model, Place } from "./model";

/** How long nothing moves before a state counts, in ms. */
const REST = 300;

/** States that are kept. */
const MOST = 200;

interface Moment {
  file: File;
  place: Place;
  branch: string;
  blank: boolean;
  pins: Model["pins"];
}

export class Undo {
  private past: Moment[] = [];
  private future: Moment[] = [];
  private rest = 0;
  private restoring = false;
  private readonly back = button("↶", () => this.undo(), { id: "undo", "aria-label": "Undo", title: "Undo (Ctrl+Z)" });
  private readonly forth = button("↷", () => this.redo(), { id: "redo", "aria-label": "Redo", title: "Redo (Ctrl+Shift+Z)" });

  constructor(private readonly model: Model) {
    const later = () => {
      if (this.restoring) return;
      clearTimeout(this.rest);
      this.rest = setTimeout(() => this.settle(), REST);
    };
    model.onLoaded(later);
    model.onMoved(later);
    model.onBlank(later);
    model.onPinned(later);
    document.addEventListener("keydown", (event) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const key = event.key.toLowerCase();
      if (key !== "z" && key !== "y") return;
      // what is being written in a line is the browser's to undo
      const { target } = event;
      if (target instanceof HTMLInputElement && target.type === "text" && target.value !== target.defaultValue) return;
      event.preventDefault();
      if (key === "y" || event.shiftKey) this.redo();
      else this.undo();
    });
    this.mark();
  }

  get buttons(): HTMLButtonElement[] {
    return [this.back, this.forth];
  }

  undo() {
    this.settle();
    if (this.past.length < 2) return;
    this.future.push(this.past.pop()!);
    this.restore(this.past.at(-1)!);
  }

  redo() {
    this.settle();
    const next = this.future.pop();
    if (!next) return;
    this.past.push(next);
    this.restore(next);
  }

  /** Keeps what there is now, if it is something else than what was kept last. */
  private settle() {
    clearTimeout(this.rest);
    const { model } = this;
    if (!model.file.text) return;
    const now = this.now();
    if (same(now, this.past.at(-1))) return;
    this.past.push(now);
    this.past.splice(0, this.past.length - MOST);
    this.future = [];
    this.mark();
  }

  private now(): Moment {
    const { file, branch, mechanism, pins } = this.model;
    return { file, place: this.model.place(), branch, blank: mechanism === null, pins };
  }

  private restore({ file, place, branch, blank, pins }: Moment) {
    this.restoring = true;
    this.model.pin(pins);
    if (blank) this.model.blank(file);
    else {
      this.model.load(file, place);
      this.model.branch = branch;
      this.model.again();
    }
    this.restoring = false;
    // solved anew, the last digits may be others
    this.past[this.past.length - 1] = this.now();
    this.mark();
  }

  private mark() {
    this.back.disabled = this.past.length < 2;
    this.forth.disabled = this.future.length === 0;
  }
}

function same(a: Moment, b: Moment | undefined): boolean {
  return b !== undefined && a.file.text === b.file.text && JSON.stringify([a.file.set, a.place, a.pins]) === JSON.stringify([b.file.set, b.place, b.pins]);
}
