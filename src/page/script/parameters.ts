// Sliders and fields for the parameters of the file; those that depend on others follow.
import { button, element, find } from "./elements";
import type { Model } from "./model";
import { expression, fill, onWritten } from "./sliders";
import type { Parameter } from "./types";

const STEPS = 400;

interface Row {
  name: string;
  /** Ends of the slider. */
  ends: [number, number];
  range: HTMLInputElement | null;
  field: HTMLInputElement;
}

export class Parameters {
  private rows: Row[] = [];
  private built = "";
  /** What a slider asks for, until the next picture. */
  private waiting: [Parameter, number] | null = null;
  private readonly back = button("As in the file", () => this.model.set([]));

  constructor(private readonly model: Model) {
    model.onLoaded(() => this.show());
  }

  private show() {
    const { mechanism, file } = this.model;
    if (!mechanism) return;
    const { parameters } = mechanism;
    const built = JSON.stringify([file.text, parameters.map((of) => of.name)]);
    if (built !== this.built) {
      this.built = built;
      this.build(parameters);
    }
    parameters.forEach((of, i) => {
      const { ends: [low, high], range, field } = this.rows[i]!;
      fill(field, of.written);
      if (range && !range.matches(":active")) range.value = String(Math.round(((of.value - low) / (high - low)) * STEPS));
      if (range) range.disabled = !of.free;
    });
    this.back.disabled = file.set.length === 0;
    find("parameters").closest("details")!.hidden = parameters.length === 0;
  }

  private build(parameters: Parameter[]) {
    const rows = parameters.map((of) => {
      const { name, value, free } = of;
      const ends: [number, number] = value === 0 ? [-1, 1] : [Math.min(0, 2 * value), Math.max(0, 2 * value)];
      const field = element("input", { type: "text", class: "value", "aria-label": `${name}, value`, "data-written": name, autocomplete: "off" });
      onWritten(field, () => this.set(name, expression(field.value, of.angle)));
      const range = free ? element("input", { type: "range", min: "0", max: String(STEPS), "aria-label": name, "data-parameter": name }) : null;
      range?.addEventListener("input", () => {
        if (!this.waiting) requestAnimationFrame(() => this.slide());
        this.waiting = [of, ends[0] + (Number(range.value) / STEPS) * (ends[1] - ends[0])];
      });
      const row = element("div", { class: range ? "slider" : "slider wide" }, element("span", {}, name), ...(range ? [range] : []), field);
      return { row, name, ends, range, field };
    });
    this.rows = rows;
    find("parameters").replaceChildren(...rows.map(({ row }) => row), element("p", {}, this.back));
  }

  private slide() {
    if (!this.waiting) return;
    const [{ name, angle }, wanted] = this.waiting;
    this.waiting = null;
    this.set(name, angle ? `${rounded((wanted * 180) / Math.PI)} deg` : rounded(wanted));
  }

  private set(name: string, text: string) {
    const others = this.model.file.set.filter(([other]) => other !== name);
    this.model.set([...others, [name, text]]);
  }
}

function rounded(value: number): string {
  return String(Number(value.toPrecision(6)));
}
