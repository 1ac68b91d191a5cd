// A slider and a field for each coordinate that is held.
import { element, find } from "./elements";
import type { Coordinate, Frame, Mechanism } from "./types";
import { rounded } from "./values";

const STEPS = 2000;
const TURN = 2 * Math.PI;

interface Slider {
  of: Coordinate;
  index: number;
  row: HTMLElement;
  range: HTMLInputElement;
  value: HTMLInputElement;
}

export class Sliders {
  private sliders: Slider[] = [];
  private names = "";

  constructor(
    private readonly move: (name: string, to: number) => void,
    private readonly write: (of: Coordinate, text: string) => void,
  ) {}

  show(mechanism: Mechanism, frame: Frame) {
    const held = frame.held ?? [];
    const names = JSON.stringify([mechanism.name, held, mechanism.coordinates]);
    if (names !== this.names) {
      this.names = names;
      this.build(mechanism, held);
    }
    const limits = new Map(frame.limits);
    for (const slider of this.sliders) {
      const [value, shown] = frame.values[slider.index]!;
      const limit = limits.get(slider.of.name);
      fill(slider.value, rounded(shown));
      slider.value.title = shown;
      slider.range.setAttribute("aria-valuetext", limit ?? shown);
      slider.row.classList.toggle("limit", limit !== undefined);
      slider.row.title = limit ?? "";
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
      const value = element("input", { type: "text", class: "value", "aria-label": `${name}, value`, "data-value": name, autocomplete: "off" });
      const row = element("div", { class: "slider" }, element("span", {}, of.name), range, value);
      const slider = { of, index, row, range, value };
      range.addEventListener("input", () => this.move(name, this.target(slider)));
      onWritten(value, () => this.write(of, value.value));
      return [slider];
    });
    const rows = this.sliders.map(({ row }) => row);
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

/** Text into a field in which nobody is writing; as it is now it is not yet changed. */
export function fill(field: HTMLInputElement, text: string) {
  if (document.activeElement === field && field.value !== field.defaultValue) return;
  if (field.defaultValue !== text) field.defaultValue = text;
  if (field.value !== text) field.value = text;
}

/** What is written in a field counts once it is done. */
export function onWritten(field: HTMLInputElement, act: () => void) {
  field.addEventListener("change", () => {
    field.defaultValue = field.value;
    act();
  });
}

/** Numbers alone are in degrees where an angle is meant; the sign of degrees is their unit. */
export function expression(text: string, angle: boolean): string {
  const written = text.trim().replaceAll("°", " deg").replace(/(\d),(\d)/g, "$1.$2").replaceAll("−", "-");
  const named = /[a-z]/i.test(written.replace(/\d\.?e(?=[-+\d])|sqrt|abs/gi, ""));
  return angle && written && !named ? `(${written})*1 deg` : written;
}
