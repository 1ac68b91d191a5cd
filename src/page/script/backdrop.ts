// A picture or a DXF outline under the drawing, to true scale; it never leaves the page.
import type { Desk } from "./desk";
import { type Outline, outline } from "./dxf";
import { button, element } from "./elements";
import { distance, type Point } from "./sketch";
import { theme } from "./theme";

const SVG = "http://www.w3.org/2000/svg";

interface Image {
  href: string;
  /** Lower left corner, width and height in m. */
  at: Point;
  size: Point;
}

export class Backdrop {
  image: Image | null = null;
  outline: Outline | null = null;
  private scaling: Point[] | null = null;
  private readonly file = element("input", { type: "file", id: "background-file", accept: "image/*,.dxf", hidden: "" });
  private readonly scale = button("Scale", () => this.rescale(), { id: "background-scale", hidden: "", title: "Two places on the background and their true distance" });
  private readonly clear = button("No background", () => this.remove(), { id: "background-clear", hidden: "" });

  constructor(private readonly desk: Desk) {
    this.file.addEventListener("change", () => void this.open());
  }

  get buttons(): HTMLElement[] {
    return [button("Background", () => this.file.click(), { id: "background", title: "A picture or a DXF file to draw over" }), this.scale, this.clear, this.file];
  }

  private async open() {
    const [file] = this.file.files ?? [];
    this.file.value = "";
    if (!file) return;
    this.remove();
    const { board } = this.desk;
    const middle = board.place(centre(board.svg));
    if (/\.dxf$/i.test(file.name)) {
      const found = outline(await file.text());
      const left = found.others.length ? ` Not drawn: ${found.others.join(", ")}.` : "";
      if (!found.lines.length) return this.desk.say(`The DXF file has no lines or curves.${left}`);
      this.outline = found;
      this.desk.say(`The outline is to scale; Scale changes it.${left}`);
    } else {
      const href = URL.createObjectURL(file);
      const shown = new Image();
      shown.src = href;
      try {
        await shown.decode();
      } catch {
        return this.desk.say("This picture cannot be read.");
      }
      const width = 0.7 * board.svg.clientWidth * board.perPixel;
      const size: Point = [width, (width * shown.naturalHeight) / shown.naturalWidth];
      this.image = { href, size, at: [middle[0] - size[0] / 2, middle[1] - size[1] / 2] };
      this.desk.say("Press Scale and click two places of the picture whose distance you know.");
    }
    this.shown();
  }

  private remove() {
    if (this.image) URL.revokeObjectURL(this.image.href);
    [this.image, this.outline, this.scaling] = [null, null, null];
    this.shown();
  }

  private shown() {
    for (const of of [this.scale, this.clear]) of.hidden = !this.image && !this.outline;
    this.desk.draw();
  }

  private rescale() {
    this.scaling = [];
    this.desk.say("Click the first place.");
  }

  /** A click that is for the scale. */
  take(at: Point): boolean {
    const { scaling } = this;
    if (!scaling) return false;
    scaling.push(at);
    if (scaling.length < 2) {
      this.desk.say("Click the second place.");
      return true;
    }
    this.scaling = null;
    const [a, b] = scaling as [Point, Point];
    const field = element("input", { type: "text", class: "dimension-field", "aria-label": "True distance in mm", placeholder: "true distance, mm" });
    const [x, y] = this.desk.board.pixel([(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
    Object.assign(field.style, { left: `${x - 60}px`, top: `${y - 13}px`, width: "120px" });
    field.addEventListener("keydown", (event) => {
      event.stopPropagation();
      if (event.key === "Enter") {
        const factor = Number(field.value.replace(",", ".")) / 1000 / distance(a, b);
        if (factor > 0 && Number.isFinite(factor)) this.scaleBy(factor, a);
      }
      if (event.key === "Enter" || event.key === "Escape") field.remove();
    });
    this.desk.board.svg.parentElement!.append(field);
    setTimeout(() => field.focus(), 0);
    this.desk.say("Write their true distance in mm.");
    return true;
  }

  /** The first place that was clicked stays. */
  private scaleBy(factor: number, about: Point) {
    const scaled = ([x, y]: Point): Point => [about[0] + factor * (x - about[0]), about[1] + factor * (y - about[1])];
    if (this.image) this.image = { ...this.image, at: scaled(this.image.at), size: [factor * this.image.size[0], factor * this.image.size[1]] };
    if (this.outline) this.outline = { ...this.outline, lines: this.outline.lines.map((line) => line.map(scaled)) };
    this.desk.say("The background is to scale.");
    this.desk.draw();
  }

  draw() {
    const { board } = this.desk;
    board.back.replaceChildren();
    const make = (kind: string, attributes: Record<string, string | number>) => {
      const made = document.createElementNS(SVG, kind);
      for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
      board.back.append(made);
    };
    if (this.image) {
      const { href, at, size } = this.image;
      const [[x, bottom], [right, y]] = [board.pixel(at), board.pixel([at[0] + size[0], at[1] + size[1]])];
      make("image", { href, x, y, width: right - x, height: bottom - y, preserveAspectRatio: "none", opacity: 0.6, class: "background" });
    }
    if (this.outline) {
      const d = this.outline.lines.map((line) => line.map((at, i) => `${i ? "L" : "M"}${board.pixel(at).map((x) => x.toFixed(1)).join(" ")}`).join("")).join("");
      make("path", { d, fill: "none", stroke: theme().ground, "stroke-width": 1.2, class: "background" });
    }
  }
}

function centre(svg: Element): { clientX: number; clientY: number } {
  const box = svg.getBoundingClientRect();
  return { clientX: box.left + box.width / 2, clientY: box.top + box.height / 2 };
}
