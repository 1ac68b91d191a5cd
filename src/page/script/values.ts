// The live values of all coordinates, each of which can be chosen to be held in place of another.
import { element, find } from "./elements";
import type { Frame, Mechanism } from "./types";

/** Beyond this four digits are lost: a singularity is near. */
const POOR = 1e4;

/** A value to be read: five digits of its number, its unit after it. */
export function rounded(value: string): string {
  return value.replace(/^[-+]?\d*\.?\d+(e[-+]?\d+)?/, (number) => String(Number(Number(number).toPrecision(5))));
}

export class Values {
  private names = "";
  private cells: HTMLElement[] = [];
  private boxes: HTMLInputElement[] = [];

  constructor(private readonly hold: (name: string) => void, private readonly release: (name: string) => void) {}

  show(mechanism: Mechanism, frame: Frame) {
    const names = JSON.stringify(mechanism.coordinates);
    if (names !== this.names) {
      this.names = names;
      this.build(mechanism);
    }
    const held = new Set(frame.held ?? []);
    const limits = new Map(frame.limits);
    mechanism.coordinates.forEach((of, i) => {
      const [cell, whole] = [this.cells[i]!, frame.values[i]![1]];
      cell.textContent = rounded(whole);
      cell.dataset.whole = whole;
      cell.parentElement!.classList.toggle("limit", limits.has(of.name));
      cell.title = [whole, limits.get(of.name)].filter(Boolean).join(": ");
      this.boxes[i]!.checked = held.has(of.name);
      this.boxes[i]!.disabled = frame.held === null;
    });
    const { figures } = frame;
    find("condition").textContent = figures ? `condition number ${rounded(figures.shown)}` : "";
    find("condition").title = figures?.shown ?? "";
    find("condition").classList.toggle("poor", figures !== null && !((figures.condition ?? Infinity) < POOR));
  }

  private build(mechanism: Mechanism) {
    this.cells = [];
    this.boxes = [];
    const rows = mechanism.coordinates.map((of) => {
      const box = element("input", { type: "checkbox", "aria-label": `hold ${of.name}`, "data-name": of.name });
      box.addEventListener("change", () => {
        if (box.checked) this.hold(of.name);
        else this.release(of.name);
      });
      const cell = element("td", { class: "right" });
      this.boxes.push(box);
      this.cells.push(cell);
      return element("tr", {}, element("td", {}, box), element("th", { scope: "row" }, of.name), cell);
    });
    const table = find("values");
    table.replaceChildren(...rows);
    // what is copied has all digits
    table.oncopy = (event) => {
      const cells = this.cells.filter((cell) => getSelection()?.containsNode(cell, true));
      if (!cells.length || !event.clipboardData) return;
      event.clipboardData.setData("text/plain", cells.map((cell) => cell.dataset.whole ?? "").join("\n"));
      event.preventDefault();
    };
  }
}
