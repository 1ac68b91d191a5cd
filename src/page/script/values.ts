// The live values of all coordinates, each of which can be chosen to be held.
import { element, find } from "./elements";
import type { Frame, Mechanism } from "./types";

export class Values {
  private names = "";
  private cells: HTMLElement[] = [];
  private boxes: HTMLInputElement[] = [];

  constructor(private readonly hold: (names: string[]) => void) {}

  show(mechanism: Mechanism, frame: Frame) {
    const names = JSON.stringify(mechanism.coordinates);
    if (names !== this.names) {
      this.names = names;
      this.build(mechanism);
    }
    const held = new Set(frame.held ?? []);
    mechanism.coordinates.forEach((of, i) => {
      this.cells[i]!.textContent = frame.values[i]![1];
      this.boxes[i]!.checked = held.has(of.name);
      this.boxes[i]!.disabled = frame.held === null;
    });
    find("condition").textContent = frame.figures ? `condition number ${frame.figures.shown}` : "";
  }

  private build(mechanism: Mechanism) {
    this.cells = [];
    this.boxes = [];
    const rows = mechanism.coordinates.map((of) => {
      const box = element("input", { type: "checkbox", "aria-label": `hold ${of.name}`, "data-name": of.name });
      box.addEventListener("change", () => {
        this.hold(mechanism.coordinates.filter((_, i) => this.boxes[i]!.checked).map(({ name }) => name));
      });
      const cell = element("td", { class: "right" });
      this.boxes.push(box);
      this.cells.push(cell);
      return element("tr", {}, element("td", {}, box), element("th", { scope: "row" }, of.name), cell);
    });
    find("values").replaceChildren(...rows);
  }
}
