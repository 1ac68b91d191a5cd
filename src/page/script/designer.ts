// Design: a point shall pass through places that are clicked and dragged. The best design follows; all that are found stand in a
// gallery with their curves and defects, and one of them can be kept as the mechanism of the page.
import { Vector3 } from "three";
import { Background } from "./background";
import { button, element, find } from "./elements";
import type { Model } from "./model";
import type { Stage } from "./stage";
import { FOUR_BAR } from "./templates";
import { thumbnail } from "./thumbnail";
import { type Design, type Designs, Refused, type Request, type Scene, type Triple } from "./types";

/** How long nothing moves before designs are sought from random starts, in ms. */
const REST = 500;

/** Random starts, a few first so that there is something to see. */
const STARTS = [8, 64];

/** Of a place, within so many pixels it is taken hold of. */
const NEAR = 12;

/** What is drawn beside the mechanism. */
export interface Drawn {
  points: Triple[];
  curve: Triple[];
  ghost: Scene | null;
}

/** What the picture is asked. */
interface Picture {
  draw(of: Drawn): void;
  /** Shows the plane, if there is one. */
  look(): unknown;
  room(scenes: Scene[]): void;
}

export class Designer {
  private points: Triple[] = [];
  private designs: Design[] = [];
  /** The first design, which is drawn. */
  private best: Design | null = null;
  /** The last first design without defects, from which others are sought as places move. */
  private from: Design | null = null;
  /** The one that is the mechanism of the page. */
  private kept: Design | null = null;
  private keeping = false;
  private placing = false;
  private moved = -1;
  private busy: "" | "follow" | "search" = "";
  private again = false;
  private rest = 0;
  private of = "";
  private names = "";
  private readonly background: Background;
  private readonly place = button("Place points", () => this.wait(!this.placing), { id: "place-points", "aria-pressed": "false", title: "Click places in the picture; drag them" });
  private readonly stop = button("Stop", () => this.halt(), { id: "stop-design", hidden: "" });
  private readonly list = element("textarea", { id: "path-points", rows: "5", "aria-label": "Places in m, a line each: x, y", placeholder: "x, y in m, a line each" });
  private readonly which = element("select", { id: "design-of", "aria-label": "Mechanism" },
    element("option", { value: "four-bar" }, "The best four-bar"), element("option", { value: "own" }, "This mechanism"));
  private readonly point = element("input", { type: "text", id: "design-point", "aria-label": "Point that passes through the places", placeholder: "point, e.g. coupler+u,v" });
  private readonly numbers = element("div", { id: "design-vary", role: "group", "aria-label": "Numbers that vary" });
  private readonly more = element("textarea", { id: "design-more", rows: "3", "aria-label": "Tolerances, bounds and goals, as a design file has them",
    placeholder: 'more, as in a design file: at_least: { "transmission": "40 deg" }, tolerances: { "coupler+u,v": "1 mm" }, vary: { "l1": (0.1, 0.3) }, maximise: "min(transmission)"' });
  private readonly anyOrder = element("input", { type: "checkbox", id: "any-order" });

  constructor(private readonly model: Model, module: WebAssembly.Module, private readonly stage: Stage, private readonly picture: Picture) {
    this.background = new Background(module);
    find("design").append(
      element("p", {}, this.place, " ", button("Clear", () => this.set([]), { id: "clear-points" }), " ", this.stop),
      this.list,
      element("p", {}, this.which, " ", this.point),
      this.numbers,
      this.more,
      element("p", {}, element("label", {}, this.anyOrder, " in any order")),
      element("p", { id: "design-said", role: "status" }),
      element("ul", { id: "designs" }),
      element("p", { id: "design-how", class: "soft" }),
    );
    this.list.addEventListener("input", () => this.set(read(this.list.value), false));
    this.which.addEventListener("change", () => this.chosen());
    this.point.addEventListener("change", () => this.asked());
    this.more.addEventListener("change", () => this.later());
    this.anyOrder.addEventListener("change", () => this.later());
    this.part.addEventListener("toggle", () => (this.part.open ? this.chosen() : this.wait(false)));
    model.onLoaded(() => {
      const { name } = model.mechanism!;
      if (name !== this.of && !this.keeping) this.set([]);
      this.of = name;
      if (this.part.open) this.chosen();
    });
    model.onBlank(() => this.set([]));
    this.pointer();
  }

  private get part(): HTMLDetailsElement {
    return find("design").closest("details")!;
  }

  /** Whether the mechanism moves in the plane of x and y, so that two coordinates are enough. */
  private get flat(): boolean {
    const normal = this.model.frame?.scene.normal;
    return normal != null && Math.abs(normal[2]) > 1 - 1e-9;
  }

  private get own(): boolean {
    return this.which.value === "own" || !this.flat;
  }

  /** Another mechanism, or another point: what may vary is another. */
  private chosen() {
    const [fourBar] = this.which.options;
    fourBar!.disabled = !this.flat;
    if (!this.flat) this.which.value = "own";
    if (!this.own) this.point.value = "coupler+u,v";
    else if (!this.knows(this.point.value)) this.point.value = `${carried(this.model.frame?.scene)}+u,v`;
    this.point.disabled = !this.own;
    this.asked();
  }

  private knows(point: string): boolean {
    const [body] = point.split("+");
    return this.model.frame?.scene.bodies.some((of) => of.name === body?.trim()) ?? false;
  }

  private asked() {
    const all = this.ranges(false);
    const names = JSON.stringify([this.own, this.of, all.map(([name]) => name)]);
    if (names !== this.names) {
      this.names = names;
      this.numbers.replaceChildren(...all.map(([name]) => {
        const box = element("input", { type: "checkbox", checked: "", "data-name": name });
        box.addEventListener("change", () => this.later());
        return element("label", {}, box, ` ${name}`);
      }));
    }
    this.from = null;
    this.later();
  }

  /** The numbers that may vary, or do, with their ranges: about their values, or about the places. */
  private ranges(ticked = true): [string, number, number][] {
    const middle = this.points.reduce((sum, at) => sum.add(new Vector3(...at)), new Vector3()).divideScalar(Math.max(this.points.length, 1));
    const far = 4 * Math.max(1e-9, ...this.points.map((at) => 2 * new Vector3(...at).distanceTo(middle)));
    const [x, y] = middle.toArray();
    const placed = { ax: x, bx: x, ay: y, by: y, u: 0, v: 0, w: 0 } as Record<string, number>;
    const parameters = this.own ? this.model.mechanism?.parameters.filter((of) => of.free) ?? [] : [];
    const length = this.own ? 3 * (this.model.mechanism?.length ?? 1) : far;
    const about = (value: number, angle: boolean): [number, number] =>
      angle ? [-Math.PI, Math.PI] : value > 0 ? [0.1 * value, 10 * value] : value < 0 ? [10 * value, 0.1 * value] : [-length, length];
    const offsets = (this.point.value.split("+")[1] ?? "").split(",").map((name) => name.trim());
    const known = new Map<string, [number, number]>(parameters.map(({ name, value, angle }) => [name, offsets.includes(name) ? [-length, length] : about(value, angle)]));
    if (!this.own) {
      for (const name of ["ax", "ay", "bx", "by"]) known.set(name, [placed[name]! - far, placed[name]! + far]);
      for (const name of ["l1", "l2", "l3"]) known.set(name, [0.01 * far, 2 * far]);
    }
    for (const name of offsets) if (/^[a-z]\w*$/i.test(name) && !known.has(name)) known.set(name, [-length, length]);
    const boxes = [...this.numbers.querySelectorAll<HTMLInputElement>("input")];
    const off = new Set(ticked ? boxes.filter((box) => !box.checked).map((box) => box.dataset.name) : []);
    return [...known].filter(([name]) => !off.has(name)).map(([name, [from, to]]) => [name, from, to]);
  }

  /** Places other points. */
  private set(points: Triple[], written = true) {
    this.points = points;
    if (written) this.list.value = points.map((at) => (this.flat ? at.slice(0, 2) : at).join(", ")).join("\n");
    if (points.length < 2) {
      this.halt();
      [this.designs, this.best, this.from] = [[], null, null];
      this.show();
      find("design-said").textContent = find("design-how").textContent = "";
    }
    this.draw();
    this.later();
  }

  /** Follows at once, and searches when nothing moves any more. */
  private later() {
    clearTimeout(this.rest);
    if (this.points.length < 2 || !this.part.open) return;
    if (this.from) void this.follow();
    this.rest = setTimeout(() => void this.search(), REST);
  }

  private halt() {
    clearTimeout(this.rest);
    this.background.stop();
    [this.busy, this.again, this.stop.hidden] = ["", false, true];
  }

  /** What is asked: where there are as many numbers as places, for all exact designs. */
  question(starts: number, exact = this.ranges().length === this.points.length): Extract<Request, { do: "design" }> {
    return {
      do: "design", vary: this.ranges(), path: this.point.value.trim(), any_order: this.anyOrder.checked, starts, own: this.from !== null, exact,
      text: this.from?.file ?? (this.own ? null : FOUR_BAR),
      points: this.points.map((at) => (this.flat ? at.slice(0, 2) : at)),
      // what follows a place that is dragged comes near at once, and keeps bounds when it rests
      more: starts > 1 ? this.more.value : "",
    };
  }

  private ask(question: Request): Promise<Designs> {
    const { text, set } = this.model.file;
    return this.background.ask<Designs>([{ do: "load", text, set }, question]);
  }

  /** From the last design to one for the places as they are now. */
  private async follow() {
    if (this.busy === "follow") {
      this.again = true;
      return;
    }
    this.busy = "follow";
    try {
      do {
        this.again = false;
        this.take(await this.ask(this.question(1, false)));
      } while (this.again);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
    }
    if (this.busy === "follow") this.busy = "";
  }

  private async search() {
    const said = find("design-said");
    this.halt();
    this.busy = "search";
    this.stop.hidden = false;
    said.textContent = "Searching …";
    try {
      for (const [stage, starts] of STARTS.entries()) {
        const found = await this.ask(this.question(starts));
        this.take(found);
        this.picture.room(this.best?.scene ? [this.best.scene] : []);
        if (found.report.exact || !this.ranges().length) break;
        if (stage + 1 < STARTS.length) said.textContent += " Searching further …";
      }
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (this.busy === "search" || error.message !== "stopped") said.textContent = error.message;
    }
    if (this.busy !== "search") return;
    [this.busy, this.stop.hidden] = ["", true];
  }

  private take({ report, states, how }: Designs) {
    this.kept = null;
    // names stand in the text as they are
    const plain = (words: string) => words.replaceAll("`", "");
    this.designs = report.designs.map((of, i) => ({ ...of, ...states[i]!, verdict: plain(states[i]!.verdict), largest: plain(states[i]!.largest) }));
    this.best = this.designs[0] ?? null;
    if (!this.from || this.best?.defects.length === 0) this.from = this.best;
    find("design-said").textContent = plain(report.sentence);
    find("design-how").textContent = plain(how.join(" "));
    this.show();
    this.draw();
  }

  /** The gallery: the curve of each design, its defects, and a button that keeps it. */
  private show() {
    find("designs").replaceChildren(...this.designs.map((design, i) => {
      const canvas = element("canvas", { width: "120", height: "120", "aria-hidden": "true" });
      if (design.scene) thumbnail(canvas, design.scene, design.curve, this.points);
      const keep = button(`Keep ${i + 1}`, () => this.keep(design), { "data-design": String(i) });
      keep.prepend(canvas);
      for (const event of ["pointerenter", "focus"]) keep.addEventListener(event, () => this.draw(design));
      for (const event of ["pointerleave", "blur"]) keep.addEventListener(event, () => this.draw());
      return element("li", {}, keep, element("div", {}, design.verdict, element("p", { class: "soft" }, `largest deviation ${design.largest}`)));
    }));
  }

  private keep(design: Design) {
    this.halt();
    const point = this.point.value;
    [this.kept, this.keeping] = [design, true];
    this.model.load({ file: "design.ron", text: design.file, set: [] });
    this.keeping = false;
    this.which.value = "own";
    this.point.value = point;
    this.chosen();
    clearTimeout(this.rest);
    this.best = this.from = design;
    this.wait(false);
    this.draw();
    this.model.say("The design is the mechanism of this page now; File saves it.");
  }

  private draw(design = this.best) {
    this.picture.draw({ points: this.points, curve: design?.curve ?? [], ghost: design && design !== this.kept ? design.scene : null });
  }

  private wait(on: boolean) {
    this.placing = on;
    this.place.setAttribute("aria-pressed", String(on));
    this.stage.canvas.classList.toggle("placing", on);
    if (on) this.picture.look();
  }

  /** Where a pointer is in the plane of the mechanism, to a pixel. */
  private at(event: PointerEvent): Triple {
    const through = new Vector3(...(this.points[0] ?? this.model.frame?.scene.joints[0]?.at ?? [0, 0, 0]));
    const step = 10 ** Math.floor(Math.log10(1 / this.stage.pixelsPerMetre()));
    const digits = Math.max(0, -Math.log10(step));
    return this.stage.place(event, through).toArray().map((x) => Number(x.toFixed(Math.min(digits, 12)))) as Triple;
  }

  private near({ clientX, clientY }: PointerEvent): number {
    const box = this.stage.canvas.getBoundingClientRect();
    return this.points.findIndex((at) => {
      const [x, y] = this.stage.pixel(new Vector3(...at));
      return Math.hypot(x + box.left - clientX, y + box.top - clientY) < NEAR;
    });
  }

  /** Places are taken hold of before anything else that is under the pointer. */
  private pointer() {
    const { canvas, orbit } = this.stage;
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0 || !this.part.open) return;
      const near = this.near(event);
      if (near < 0 && !this.placing) return;
      event.stopImmediatePropagation();
      this.moved = near < 0 ? this.points.length : near;
      if (near < 0) this.set([...this.points, this.at(event)]);
      canvas.setPointerCapture(event.pointerId);
      orbit.enabled = false;
    }, { capture: true });
    canvas.addEventListener("pointermove", (event) => {
      if (this.moved < 0) return;
      event.stopImmediatePropagation();
      this.set(this.points.map((at, i) => (i === this.moved ? this.at(event) : at)));
    }, { capture: true });
    for (const end of ["pointerup", "pointercancel"] as const) {
      canvas.addEventListener(end, () => {
        if (this.moved < 0) return;
        this.moved = -1;
        orbit.enabled = true;
      });
    }
  }
}

/** Lines of two or three numbers; what is none is not taken. */
function read(text: string): Triple[] {
  const lines = text.split("\n").map((line) => line.trim().split(/[,;\s]+/).map(Number));
  return lines.filter((of) => of.length > 1 && of.every(Number.isFinite)).map(([x, y, z]) => [x!, y!, z ?? 0]);
}

/** A body that is carried, as a coupler is: it has no joint on ground; otherwise the last one. */
function carried(scene: Scene | undefined): string {
  const moving = (scene?.bodies ?? []).map((of, i) => ({ ...of, i })).filter((of) => !of.ground);
  const grounded = new Set((scene?.joints ?? []).filter((of) => of.bodies.some((body) => scene!.bodies[body]?.ground)).flatMap((of) => of.bodies));
  return (moving.find(({ i }) => !grounded.has(i)) ?? moving.at(-1))?.name ?? "";
}
