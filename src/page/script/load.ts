// A load on the mechanism: a force at a point, put there by a click and dragged at its tip, or written down.
import type { Vector3 } from "three";
import type { Arrows } from "./arrows";
import { button, element, find } from "./elements";
import type { Model } from "./model";
import type { Pick } from "./shapes";
import { expression } from "./sliders";
import type { Named, Triple } from "./types";
import { rounded } from "./values";

/** In N. */
const FIRST = 10;

export class Load {
  private waiting = false;
  private readonly place = button("Put a load on a body", () => this.wait(!this.waiting), { id: "place-load", "aria-pressed": "false" });
  private readonly point = element("input", { type: "text", id: "loaded", placeholder: "point, e.g. left+0.5", "aria-label": "Loaded point" });
  private readonly parts = ["x", "y", "z"].map((axis) =>
    element("input", { type: "text", inputmode: "decimal", class: "force", value: "0", "aria-label": `Force along ${axis} in N` }));

  constructor(private readonly model: Model, private readonly arrows: Arrows, private readonly down: () => Vector3) {
    find("load").append(
      element("p", {}, this.place, " ", button("Remove", () => this.remove(), { id: "remove-load" })),
      element("p", {}, this.point),
      element("p", { class: "force-parts" }, "Force ", ...this.parts, " N"),
      element("p", { id: "load-said", role: "status" }),
      element("table", {}, element("tbody", { id: "forces" })),
    );
    for (const field of [this.point, ...this.parts]) field.addEventListener("change", () => this.written());
    model.onLoaded(() => {
      this.wait(false);
      if (model.pressed) arrows.fit(model.pressed.force);
      else [this.point, ...this.parts].forEach((field) => (field.value = field === this.point ? "" : "0"));
    });
    model.onMoved(() => this.show());
  }

  /** The point of a body that was clicked; whether a load was waiting for it. */
  clicked(point: string): boolean {
    if (!this.waiting) return false;
    this.wait(false);
    const force = this.model.pressed?.force ?? (this.down().multiplyScalar(FIRST).toArray() as Triple);
    this.press(point, force);
    return true;
  }

  /** How the tip of the load is dragged. */
  tip({ arrow: index }: Pick): ((to: Triple) => void) | null {
    const arrow = index === undefined ? null : this.model.frame?.scene.arrows?.[index];
    if (!arrow?.applied) return null;
    const grabbed = this.arrows.tip(arrow);
    let last: Vector3 | null = null;
    return (to) => {
      // the tip goes as far as the pointer does
      const here = grabbed.clone().set(...to);
      grabbed.add(here).sub(last ?? here);
      last = here;
      this.model.press({ point: this.model.pressed!.point, force: this.arrows.force(arrow, grabbed) });
    };
  }

  private wait(on: boolean) {
    this.waiting = on;
    this.place.setAttribute("aria-pressed", String(on));
    find("load-said").textContent = on ? "Click a body where the load is to act." : "";
  }

  private remove() {
    this.wait(false);
    this.model.press(null);
  }

  private written() {
    const point = this.point.value.trim();
    if (!point) return this.remove();
    const force = this.parts.map((part) => this.model.number(expression(part.value, false), "force"));
    if (force.every((part) => part !== null)) this.press(point, force as Triple);
  }

  private press(point: string, force: Triple) {
    this.arrows.fit(force);
    this.model.press({ point, force });
  }

  private show() {
    const { frame, pressed } = this.model;
    if (pressed) this.parts.forEach((part, i) => write(part, Number(pressed.force[i]!.toPrecision(6)).toString()));
    if (pressed) write(this.point, pressed.point);
    const forces = frame?.forces ?? null;
    const rows: Named[] = forces && "held" in forces ? forces.held : [];
    find("forces").replaceChildren(...rows.map(([name, shown]) =>
      element("tr", {}, element("th", { scope: "row" }, name), element("td", { class: "right", title: shown }, rounded(shown)))));
    if (forces && "error" in forces) find("load-said").textContent = forces.error;
    else if (forces) {
      const { unbalanced } = forces;
      find("load-said").textContent = unbalanced.length
        ? `Nothing balances the load: ${unbalanced.join(", ")} would move.`
        : "The held coordinates balance it with:";
    } else if (!this.waiting) find("load-said").textContent = "";
  }
}

/** Into a field where nobody writes. */
function write(field: HTMLInputElement, text: string) {
  if (document.activeElement !== field) field.value = text;
}
