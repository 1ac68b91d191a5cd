// The mechanism in the page, what is held of it and where it is; what changes is told to all who listen.
import { Background } from "./background";
import { nearest } from "./sliders";
import type { Solver } from "./solver";
import { type Frame, type Loaded, type Mechanism, type Problem, Refused, type Request, type Scene, type State } from "./types";

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
}

export class Model {
  file: File = { file: "", text: "", set: [] };
  mechanism: Mechanism | null = null;
  frame: Frame | null = null;
  private readonly loaded: (() => void)[] = [];
  private readonly moved: (() => void)[] = [];
  private readonly problems: ((problems: Problem[]) => void)[] = [];

  constructor(private readonly solver: Solver, readonly background: Background, private readonly say: (words: string) => void) {}

  onLoaded(act: () => void) {
    this.loaded.push(act);
  }

  onMoved(act: () => void) {
    this.moved.push(act);
  }

  onProblems(act: (problems: Problem[]) => void) {
    this.problems.push(act);
  }

  /** Reads a file; the mechanism stays near where it was if a place is given. Whether it could be read. */
  load(file: File, place?: Place): boolean {
    return this.attempt(() => {
      const near = place?.at ?? null;
      const held = place?.held ?? null;
      const loaded = this.solver.ask<Loaded>({ do: "load", text: file.text, set: file.set, held, near });
      this.background.stop();
      this.file = file;
      this.mechanism = loaded.mechanism;
      this.problems.forEach((act) => act(loaded.warnings));
      this.frame = loaded;
      this.loaded.forEach((act) => act());
      this.show(loaded);
    });
  }

  /** Loads what is there with parameters at other values. */
  set(set: [string, string][]) {
    this.load({ ...this.file, set }, this.place());
  }

  place(): Place {
    return { held: this.frame?.held ?? null, at: this.frame?.assembled ? this.frame.at : null };
  }

  move(name: string, to: number) {
    const index = this.mechanism?.coordinates.findIndex((of) => of.name === name) ?? -1;
    const of = this.mechanism?.coordinates[index];
    if (!of || !this.frame) return;
    const from = this.frame.values[index]![0];
    this.change({ do: "move", to: [[name, nearest(of, to, from)]] });
  }

  hold(names: string[]) {
    if (!this.change({ do: "hold", names }) && this.frame) this.moved.forEach((act) => act());
  }

  go(at: State) {
    this.change({ do: "go", at });
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

  /** Long work about the mechanism as it is. */
  async study<Reply>(request: Request): Promise<Reply> {
    const { text, set } = this.file;
    const { held, at } = this.place();
    return this.background.ask<Reply>([{ do: "load", text, set, held, near: at }, request]);
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

  private attempt(act: () => void): boolean {
    try {
      act();
      return true;
    } catch (error) {
      this.refuse(error);
      return false;
    }
  }
}
