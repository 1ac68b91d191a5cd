// The mechanism in the page, what is held of it and where it is; all listeners are notified of changes.
import { Background } from "./background";
import { expression, nearest } from "./sliders";
import type { Point } from "./sketch";
import type { Solver } from "./solver";
import { type Coordinate, type Frame, type Loaded, type Mechanism, type Press, type Problem, Refused, type Request, type Scene, type State } from "./types";

/** A mechanism file with parameters at other values. */
export interface File {
  file: string;
  text: string;
  set: [string, string][];
}

/** Where a mechanism is, and what is held of it. */
export interface Place {
  held: string[] | null;
  at: State | null;
  load?: Press | null;
  quantities?: string;
}

export class Model {
  file: File = { file: "", text: "", set: [] };
  mechanism: Mechanism | null = null;
  frame: Frame | null = null;
  /** What presses on it. */
  pressed: Press | null = null;
  /** The quantities that are read; the usual ones if it is empty. */
  quantities = "";
  /** The assembly that the mechanism was put into, from which it has moved without leaving its branch. */
  branch = "";
  /** Pins of a drawing on ground that nothing turns about yet: the file cannot name them. */
  pins: readonly Point[] = [];
  private readonly pinned: (() => void)[] = [];
  private readonly loaded: (() => void)[] = [];
  private readonly moved: (() => void)[] = [];
  private readonly blanks: (() => void)[] = [];
  private readonly problems: ((problems: Problem[]) => void)[] = [];

  constructor(private readonly solver: Solver, readonly background: Background, readonly say: (words: string) => void) {}

  onLoaded(act: () => void) {
    this.loaded.push(act);
  }

  onMoved(act: () => void) {
    this.moved.push(act);
  }

  onPinned(act: () => void) {
    this.pinned.push(act);
  }

  pin(pins: readonly Point[]) {
    this.pins = pins;
    this.pinned.forEach((act) => act());
  }

  onBlank(act: () => void) {
    this.blanks.push(act);
  }

  /** A file in which nothing is yet. */
  blank(file: File) {
    this.background.stop();
    [this.file, this.mechanism, this.frame, this.pressed, this.quantities] = [file, null, null, null, ""];
    this.say("");
    this.blanks.forEach((act) => act());
  }

  onProblems(act: (problems: Problem[]) => void) {
    this.problems.push(act);
  }

  /** Reads a file; the mechanism stays near where it was if a place is given. Whether it could be read. */
  load(file: File, place?: Place, refused?: (error: Refused) => void): boolean {
    return this.attempt(() => {
      const near = place?.at ?? null;
      const held = place?.held ?? null;
      const [load, quantities] = [place?.load ?? null, place?.quantities ?? ""];
      const loaded = this.solver.ask<Loaded>({ do: "load", text: file.text, set: file.set, held, near, load, quantities });
      [this.pressed, this.quantities] = [load, quantities];
      this.background.stop();
      this.file = file;
      this.mechanism = loaded.mechanism;
      this.problems.forEach((act) => act(loaded.warnings));
      this.frame = loaded;
      if (!near) this.branch = "the branch of the home configuration";
      this.loaded.forEach((act) => act());
      this.show(loaded);
    }, refused);
  }

  /** Gives parameters other values, unless the mechanism does not assemble with them. */
  set(set: [string, string][]) {
    const [before, place] = [this.file, this.place()];
    const wrong = (why: string) => this.say(`${set.map(([name, value]) => `${name} = ${value}`).join(", ")}: ${why}`);
    // the text of the file is not what is wrong
    const refused = (error: Refused) => (error.problems[0] ? wrong(error.problems[0].title) : this.say(error.message));
    if (!this.load({ ...before, set }, place, refused) || this.frame?.assembled !== false) return;
    const why = this.frame.said ?? "";
    this.load(before, place);
    wrong(why);
  }

  /** As the file has it: what is held and where it is. */
  home() {
    this.load(this.file, { held: null, at: null, load: this.pressed, quantities: this.quantities });
  }

  place(): Place {
    const { frame, pressed, quantities } = this;
    return { held: frame?.held ?? null, at: frame?.assembled ? frame.at : null, load: pressed, quantities };
  }

  move(name: string, to: number) {
    const index = this.mechanism?.coordinates.findIndex((of) => of.name === name) ?? -1;
    const of = this.mechanism?.coordinates[index];
    if (!of || !this.frame) return;
    if (!this.frame.held?.includes(name)) return;
    const from = this.frame.values[index]![0];
    this.change({ do: "move", to: [[name, nearest(of, to, from)]] });
  }

  /** Moves a held coordinate to what an expression says. */
  moveTo(of: Coordinate, text: string) {
    const measure = of.angle ? "angle" : "length";
    const value = this.number(expression(text, of.angle), measure);
    if (value === null) return;
    const said = this.frame?.said;
    this.move(of.name, value);
    if (this.frame?.said === said) this.say(said ?? "");
  }

  /** The number of an expression, in rad, m, N or s; nothing if it is none, which is said. */
  number(text: string, measure: "angle" | "length" | "force" | "time"): number | null {
    try {
      return this.ask<{ value: number }>({ do: "number", text, measure }).value;
    } catch (error) {
      this.refuse(error);
      return null;
    }
  }

  /** How well these decide where the mechanism is if they are held, as a condition number; `before` are held again. */
  could(names: string[], before: string[]): number | null {
    try {
      const { held, figures } = this.ask<Frame>({ do: "hold", names });
      const all = new Set(held ?? []);
      return all.size === names.length && names.every((name) => all.has(name)) ? (figures?.condition ?? null) : null;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return null;
    } finally {
      this.ask<Frame>({ do: "hold", names: before });
    }
  }

  /** Holds these; whether they decide where the mechanism is, so that no others are held. */
  holds(names: string[]): boolean {
    this.change({ do: "hold", names });
    const held = new Set(this.frame?.held ?? []);
    return held.size === names.length && names.every((name) => held.has(name));
  }

  /** Tells all who listen once more. */
  again() {
    this.moved.forEach((act) => act());
  }

  go(at: State, branch: string) {
    this.branch = branch;
    this.change({ do: "go", at });
  }

  /** Presses on a point, or on none any more. */
  press(load: Press | null) {
    this.pressed = load;
    this.change({ do: "press", load });
  }

  /** Reads quantities from now on. */
  watch(quantities: string) {
    this.quantities = quantities;
    this.change({ do: "watch", quantities });
  }

  change(request: Request): boolean {
    return this.attempt(() => this.show(this.solver.ask<Frame>(request)));
  }

  ask<Reply>(request: Request): Reply {
    return this.solver.ask<Reply>(request);
  }

  /** How a configuration looks; the mechanism stays where it is. */
  scene(at: State): Scene {
    return this.solver.ask<{ scene: Scene }>({ do: "show", at }).scene;
  }

  /** Long work about the mechanism as it is, or near another configuration. */
  async study<Reply>(request: Request, background = this.background, near = this.place().at): Promise<Reply> {
    const { text, set } = this.file;
    const { held, load } = this.place();
    return background.ask<Reply>([{ do: "load", text, set, held, near, load }, request]);
  }

  /** Shows why there is no answer. */
  refuse(error: unknown) {
    if (!(error instanceof Refused)) throw error;
    if (error.problems.length) this.problems.forEach((act) => act(error.problems));
    else this.say(error.message);
  }

  private show(frame: Frame) {
    this.frame = frame;
    this.say(frame.said ?? "");
    this.moved.forEach((act) => act());
  }

  private attempt(act: () => void, refused = (error: Refused) => this.refuse(error)): boolean {
    try {
      act();
      return true;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      refused(error);
      return false;
    }
  }
}
