// A slider for each coordinate that is held.
import { element, find } from "./elements";
import type { Coordinate, Frame, Mechanism } from "./types";

const STEPS = 2000;
const TURN = 2 * Math.PI;

interface Slider {
  of: Coordinate;
  index: number;
  range: HTMLInputElement;
  value: HTMLElement;
}

export class Sliders {
  private sliders: Slider[] = [];
  private names = "";

  constructor(private readonly move: (name: string, to: number) => void) {}

  show(mechanism: Mechanism, frame: Frame) {
    const held = frame.held ?? [];
    const names = JSON.stringify([mechanism.name, held, mechanism.coordinates]);
    if (names !== this.names) {
      this.names = names;
      this.build(mechanism, held);
    }
    for (const slider of this.sliders) {
      const [value, shown] = frame.values[slider.index]!;
      slider.value.textContent = shown;
      slider.range.setAttribute("aria-valuetext", shown);
      if (document.activeElement !== slider.range || !slider.range.matches(":active")) {
        slider.range.value = String(this.position(slider.of, value));
      }
    }
  }

  private build(mechanism: Mechanism, held: string[]) {
    this.sliders = held.flatMap((name) => {
      const index = mechanism.coordinates.findIndex((of) => of.name === name);
      const of = mechanism.coordinates[index];
      if (!of) return [];
      const range = element("input", {
        type: "range", min: "0", max: String(STEPS), step: "1", "aria-label": name, "data-name": name,
      });
      const value = element("output");
      const slider = { of, index, range, value };
      range.addEventListener("input", () => this.move(name, this.target(slider)));
      return [slider];
    });
    const rows = this.sliders.map(({ of, range, value }) =>
      element("label", { class: "slider" }, element("span", {}, of.name), range, value),
    );
    const none = element("p", { class: "soft" }, "Nothing is held: the mechanism has no freedom.");
    find("sliders").replaceChildren(...(rows.length ? rows : [none]));
  }

  private position({ range: [low, high], angle, limits }: Coordinate, value: number): number {
    const shown = angle && !limits ? value - TURN * Math.round(value / TURN) : value;
    return Math.round(((shown - low) / (high - low)) * STEPS);
  }

  /** What a slider asks for; of an angle without limits the turn that is nearest to `from`. */
  private target({ of, range }: Slider): number {
    const [low, high] = of.range;
    return low + (Number(range.value) / STEPS) * (high - low);
  }
}

/** Of an angle without limits the turn nearest to where it is. */
export function nearest(of: Coordinate, to: number, from: number): number {
  return of.angle && !of.limits ? to + TURN * Math.round((from - to) / TURN) : to;
}
