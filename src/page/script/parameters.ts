// Sliders for the parameters of the file; those that depend on others follow.
import { button, element, find } from "./elements";
import type { Model } from "./model";

export class Parameters {
  /** The values of the file, around which sliders go. */
  private given = new Map<string, number>();
  private text = "";

  constructor(private readonly model: Model) {
    model.onLoaded(() => this.show());
  }

  private show() {
    const { mechanism, file } = this.model;
    if (!mechanism) return;
    if (file.text !== this.text) {
      this.text = file.text;
      this.given.clear();
    }
    const rows = mechanism.parameters.filter((parameter) => parameter.free).map(({ name, written, value, angle }) => {
      if (!this.given.has(name)) this.given.set(name, value);
      const middle = this.given.get(name)!;
      const [low, high] = middle === 0 ? [-1, 1] : [Math.min(0, 2 * middle), Math.max(0, 2 * middle)];
      const range = element("input", { type: "range", min: "0", max: "400", "aria-label": name, "data-parameter": name });
      range.value = String(Math.round(((value - low) / (high - low)) * 400));
      range.addEventListener("change", () => {
        const wanted = low + (Number(range.value) / 400) * (high - low);
        const others = this.model.file.set.filter(([other]) => other !== name);
        const text = angle ? `${rounded((wanted * 180) / Math.PI)} deg` : rounded(wanted);
        this.model.set([...others, [name, text]]);
      });
      return element("label", { class: "slider" }, element("span", {}, name), range, element("output", {}, written));
    });
    const back = button("As in the file", () => this.model.set([]));
    back.disabled = file.set.length === 0;
    find("parameters").replaceChildren(...rows, element("p", {}, back));
    find("parameters").closest("details")!.hidden = rows.length === 0;
  }
}

function rounded(value: number): string {
  return String(Number(value.toPrecision(6)));
}
