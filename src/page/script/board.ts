// The drawing board: what is drawn as lines over the picture, with grid, dimensions and what is being drawn.
import { Vector3 } from "three";
import { hull } from "./hull";
import { apart } from "./labels";
import { distance, type Point, type Sketch, type Spot } from "./sketch";
import type { Stage } from "./stage";
import { bodyColour, theme } from "./theme";

const SVG = "http://www.w3.org/2000/svg";

/** A dimension that can be changed. */
export interface Dimension {
  from: Point;
  to: Point;
  name: string;
  set(length: number): void;
}

export interface Drawn {
  sketch: Sketch | null;
  /** Pins on ground that nothing turns about yet. */
  pins: readonly Point[];
  dimensions: Dimension[];
  rubber: [Point, Point] | null;
  /** Where the pointer is, and what it snaps to. */
  cursor: { at: Point; words: string } | null;
  grid: number | null;
}

function shape(kind: string, attributes: Record<string, string | number>, ...inside: (Node | string)[]): SVGElement {
  const made = document.createElementNS(SVG, kind);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.append(...inside);
  return made;
}

export class Board {
  readonly svg = shape("svg", { id: "board", tabindex: 0, role: "application", "aria-label": "Drawing board" });
  readonly back = shape("g", {});
  private readonly front = shape("g", {});

  /** Whether a click at a place is for nothing that is drawn there. */
  free: (at: Point) => boolean = () => true;

  constructor(private readonly stage: Stage) {
    this.svg.append(this.back, this.front);
  }

  pixel([x, y]: Point): Point {
    return this.stage.pixel(new Vector3(x, y, 0));
  }

  place(event: { clientX: number; clientY: number }): Point {
    const { x, y } = this.stage.place(event, new Vector3());
    return [x, y];
  }

  get perPixel(): number {
    return 1 / this.stage.pixelsPerMetre();
  }

  /** Metres between lines of the grid: 1, 2 or 5 of a decade, at least 12 pixels apart. */
  get step(): number {
    const least = 12 * this.perPixel;
    const decade = 10 ** Math.floor(Math.log10(least));
    return [1, 2, 5, 10].map((part) => part * decade).find((step) => step >= least * (1 - 1e-9))!;
  }

  draw({ sketch, pins, dimensions, rubber, cursor, grid }: Drawn) {
    const { front } = this;
    front.replaceChildren();
    if (grid) this.grid(grid);
    if (sketch) this.sketch(sketch);
    for (const pin of pins) this.support(this.pixel(pin), true);
    const taken: DOMRect[] = [];
    for (const dimension of dimensions) this.dimension(dimension, taken);
    if (rubber) {
      this.line(rubber[0], rubber[1], theme().driven, 4);
      const [x, y] = this.pixel([(rubber[0][0] + rubber[1][0]) / 2, (rubber[0][1] + rubber[1][1]) / 2]);
      const angle = (Math.atan2(rubber[1][1] - rubber[0][1], rubber[1][0] - rubber[0][0]) * 180) / Math.PI;
      front.append(shape("text", { x: x + 10, y: y - 8, class: "rubber" }, `${millimetres(distance(...rubber))} ∠ ${angle.toFixed(1)}°`));
    }
    if (!cursor) return;
    const [x, y] = this.pixel(cursor.at);
    front.append(
      shape("path", { d: `M${x - 9} ${y}h18M${x} ${y - 9}v18`, class: "cursor" }),
      ...(cursor.words ? [shape("circle", { cx: x, cy: y, r: 9, class: "snap" }), shape("text", { x: x + 12, y: y + 18, class: "rubber" }, cursor.words)] : []),
    );
  }

  private grid(step: number) {
    const { clientWidth, clientHeight } = this.stage.canvas;
    const box = this.stage.canvas.getBoundingClientRect();
    const [left, top] = this.place({ clientX: box.left, clientY: box.top });
    const [right, bottom] = this.place({ clientX: box.left + clientWidth, clientY: box.top + clientHeight });
    let [fine, bold] = ["", ""];
    for (let i = Math.ceil(left / step); i * step < right; i++) {
      const [x] = this.pixel([i * step, 0]);
      if (i % 5) fine += `M${x} 0V${clientHeight}`;
      else bold += `M${x} 0V${clientHeight}`;
    }
    for (let i = Math.ceil(bottom / step); i * step < top; i++) {
      const [, y] = this.pixel([0, i * step]);
      if (i % 5) fine += `M0 ${y}H${clientWidth}`;
      else bold += `M0 ${y}H${clientWidth}`;
    }
    this.front.append(shape("path", { d: fine, class: "grid" }), shape("path", { d: bold, class: "grid bold" }));
  }

  private line(from: Point, to: Point, colour: string, width: number, more: Record<string, string> = {}) {
    const [[x1, y1], [x2, y2]] = [this.pixel(from), this.pixel(to)];
    this.front.append(shape("line", { x1, y1, x2, y2, stroke: colour, "stroke-width": width, "stroke-linecap": "round", ...more }));
  }

  private sketch(sketch: Sketch) {
    const bodies = [...sketch.places.keys()].filter((body) => body !== "ground");
    const colour = (body: string) => bodyColour(Math.max(bodies.indexOf(body), 0) + 1);
    for (const body of bodies) {
      const spots = spotsOf(sketch, body);
      if (spots.length > 2) {
        const all = spots.map(({ at }) => this.pixel(at));
        const points = hull(all).map((i) => all[i]!.join(",")).join(" ");
        this.front.append(shape("polygon", { points, fill: colour(body), "fill-opacity": 0.25, stroke: colour(body), "stroke-width": 5, "stroke-linejoin": "round", "data-body": body }));
      } else if (spots.length === 2) this.line(spots[0]!.at, spots[1]!.at, colour(body), 7, { "data-body": body });
    }
    for (const joint of sketch.joints) {
      const [first, second] = joint.spots;
      const fixed = joint.spots.some(({ body }) => body === "ground");
      if (joint.kind === "Distance") this.line(first.at, second.at, joint.driven ? theme().driven : theme().ink, joint.driven ? 6 : 3, { "data-rod": joint.name });
      else if (joint.kind === "Prismatic") this.slide(first.at, second.at, joint.along, fixed, joint.driven);
      else {
        if (distance(first.at, second.at) > 2 * this.perPixel) this.line(first.at, second.at, theme().load, 2, { "stroke-dasharray": "4 4" });
        const [x, y] = this.pixel(first.at);
        if (fixed) this.support([x, y], false);
        this.front.append(shape("circle", { cx: x, cy: y, r: 6, fill: joint.driven ? theme().driven : theme().joint, stroke: theme().ink, "stroke-width": 2, "data-joint": joint.name }));
        this.name(joint.name, x, y);
      }
    }
    for (const tip of sketch.tips) {
      const [x, y] = this.pixel(tip.spot.at);
      this.front.append(shape("path", { d: `M${x - 5} ${y}l5 -5l5 5l-5 5z`, fill: theme().paper, stroke: theme().ink, "stroke-width": 2, "data-tip": tip.name }));
      this.name(tip.name, x, y);
    }
  }

  private name(words: string, x: number, y: number) {
    this.front.append(shape("text", { x: x + 9, y: y - 9, class: "name" }, words));
  }

  private support([x, y]: Point, open: boolean) {
    this.front.append(shape("path", {
      d: `M${x} ${y}l-9 15h18zM${x - 13} ${y + 15}h26m-24 0l-4 5m10 -5l-4 5m10 -5l-4 5m10 -5l-4 5`,
      fill: theme().plate, stroke: theme().ground, "stroke-width": 1.5,
    }));
    if (open) this.front.append(shape("circle", { cx: x, cy: y, r: 6, fill: theme().joint, stroke: theme().ink, "stroke-width": 2, class: "ground-pin" }));
  }

  private slide(guide: Point, block: Point, along: number, fixed: boolean, driven: boolean) {
    const half = 40 * this.perPixel;
    const way: Point = [Math.cos(along), Math.sin(along)];
    const t = (block[0] - guide[0]) * way[0] + (block[1] - guide[1]) * way[1];
    const [low, high] = [Math.min(0, t) - half, Math.max(0, t) + half];
    const at = (s: number): Point => [guide[0] + s * way[0], guide[1] + s * way[1]];
    this.line(at(low), at(high), fixed ? theme().ground : theme().ink, 2);
    const [x, y] = this.pixel(block);
    const turn = (-along * 180) / Math.PI;
    this.front.append(shape("rect", {
      x: x - 13, y: y - 8, width: 26, height: 16, transform: `rotate(${turn} ${x} ${y})`,
      fill: driven ? theme().driven : theme().joint, stroke: theme().ink, "stroke-width": 2,
    }));
  }

  /** A length beside its line, clear of those that stand there. */
  private dimension({ from, to, name, set }: Dimension, taken: DOMRect[]) {
    const [a, b] = [this.pixel(from), this.pixel(to)];
    const length = Math.max(distance(a, b), 1e-9);
    if (length < 20) return;
    const words = millimetres(distance(from, to));
    const across: Point = [-(b[1] - a[1]) / length, (b[0] - a[0]) / length];
    // clear of the line, on which one clicks for something else
    const half = 3.4 * words.length;
    const off = 9 + half * Math.abs(across[0]) + 6 * Math.abs(across[1]);
    const places = [0.5, 0.35, 0.65].flatMap((part) => [1, -1].map((side): Point => [
      a[0] + part * (b[0] - a[0]) + side * off * across[0], a[1] + part * (b[1] - a[1]) + side * off * across[1],
    ]));
    const boxes = places.map(([x, y]) => new DOMRect(x - half, y - 8, 2 * half, 16));
    const clear = boxes.findIndex((box) => taken.every((other) => apart(box, other)));
    const [x, y] = places[Math.max(clear, 0)]!;
    taken.push(boxes[Math.max(clear, 0)]!);
    const label = shape("text", {
      x, y: y + 4, class: "dimension", tabindex: 0, role: "button", "text-anchor": "middle", "data-dimension": name, "aria-label": `${name}: ${words}, change`,
    }, words);
    const open = (event: Event) => {
      if (event instanceof PointerEvent && event.isTrusted && !this.free(this.place(event))) return;
      event.stopPropagation();
      event.preventDefault();
      this.field(x, y, words, name, set);
    };
    label.addEventListener("pointerdown", open);
    label.addEventListener("keydown", (event) => {
      if (event.key === "Enter" || event.key === " ") open(event);
    });
    this.front.append(label);
  }

  /** A field over a dimension. */
  private field(x: number, y: number, words: string, name: string, set: (length: number) => void) {
    const field = document.createElement("input");
    Object.assign(field, { type: "text", value: words, className: "dimension-field", ariaLabel: `${name}, length` });
    Object.assign(field.style, { left: `${x - 45}px`, top: `${y - 13}px` });
    const parent = this.svg.parentElement!;
    // it loses the focus as it goes
    const close = () => (this.svg as unknown as HTMLElement).focus();
    field.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Escape") close();
      if (event.key !== "Enter") return;
      close();
      const [, number, unit] = /^\s*([\d.,]+)\s*(mm|cm|m)?\s*$/.exec(field.value) ?? [];
      const length = Number(number?.replace(",", ".")) * { mm: 1e-3, cm: 1e-2, m: 1 }[(unit ?? "mm") as "mm"];
      if (length > 0) set(length);
    });
    field.addEventListener("blur", () => field.remove());
    parent.append(field);
    field.focus();
    field.select();
  }
}

export const millimetres = (length: number): string => `${Number((1000 * length).toFixed(2))} mm`;

/** All places on a body, those of joints first. */
export function spotsOf({ joints, tips }: Sketch, body: string): Spot[] {
  return [...joints.flatMap((joint) => joint.spots), ...tips.map(({ spot }) => spot)].filter((spot) => spot.body === body);
}
