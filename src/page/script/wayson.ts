// Where a motion stops at a dead point, or branches meet: the ways to go on, each shown before it is taken.
import { button, find } from "./elements";
import type { Model } from "./model";
import { Refused, type Scene, type State } from "./types";

/** How long nothing moves before they are sought, in ms. */
const PAUSE = 120;

export class WaysOn {
  private pause = 0;

  constructor(private readonly model: Model, private readonly ghost: (scenes: Scene[]) => void) {
    model.onBlank(() => this.clear());
    model.onMoved(() => {
      this.clear();
      const figures = model.frame?.figures;
      if (figures && (figures.stopped || figures.condition === null)) this.pause = setTimeout(() => this.find(), PAUSE);
    });
  }

  private clear() {
    clearTimeout(this.pause);
    if (!find("ways").hasChildNodes()) return;
    find("ways").replaceChildren();
    this.ghost([]);
  }

  private find() {
    try {
      const { states } = this.model.ask<{ states: { at: State; scene: Scene }[] }>({ do: "ways" });
      if (states.length < 2) return;
      const stopped = this.model.frame?.figures?.stopped;
      const words = (i: number) => {
        if (!stopped) return `branch ${i + 1}`;
        if (i === 0) return "the way it came";
        return states.length === 2 ? "across" : `across, branch ${i}`;
      };
      const buttons = states.slice(0, 8).map(({ at, scene }, i) => {
        const way = button(words(i), () => this.model.go(at, i || !stopped ? "a branch across a dead point" : this.model.branch), { "data-way": String(i) });
        for (const event of ["pointerenter", "focus"]) way.addEventListener(event, () => this.ghost([scene]));
        for (const event of ["pointerleave", "blur"]) way.addEventListener(event, () => this.ghost([]));
        return way;
      });
      find("ways").replaceChildren("Ways on: ", ...buttons.flatMap((of) => [of, " "]));
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
    }
  }
}
