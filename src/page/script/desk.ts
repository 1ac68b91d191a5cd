// Edit mode: tools that draw on the board; every change goes through the file, and the file may be written beside it.
import { MOUSE } from "three";
import { Backdrop } from "./backdrop";
import { Board } from "./board";
import { dimensions, together } from "./dimensions";
import { Draft, EMPTY, type End } from "./draft";
import { button, element, find } from "./elements";
import type { File, Model } from "./model";
import { field, read } from "./ron";
import { type Point, type Sketch, sketch } from "./sketch";
import { snapped, type Snapped } from "./snapping";
import type { Stage } from "./stage";
import { TOOLS, type Tool } from "./tools";
import { Refused } from "./types";

/** How long nothing changes before freedoms are counted, in ms. */
const PAUSE = 150;

export class Desk {
  readonly board: Board;
  readonly backdrop: Backdrop;
  on = false;
  sketch: Sketch | null = null;
  private tool: Tool = TOOLS[0]!;
  private from: Snapped | null = null;
  private cursor: Point = [0, 0];
  private shown: Snapped | null = null;
  private pressed: { id: number; x: number; y: number; pan: boolean } | null = null;
  private pause = 0;
  private readonly bar = element("div", { id: "tools", role: "toolbar", "aria-label": "Drawing tools" });
  private readonly said = element("p", { id: "desk-said", role: "status" });
  private readonly counted = element("p", { id: "desk-count", role: "status" });
  private readonly where = element("input", { type: "text", id: "place", placeholder: "x, y in mm", "aria-label": "Place, x and y in mm", autocomplete: "off" });
  private readonly snaps = Object.fromEntries(["grid", "points", "angles"].map((name) => [name, element("input", { type: "checkbox", checked: "", id: `snap-${name}` })])) as Record<"grid" | "points" | "angles", HTMLInputElement>;

  constructor(readonly model: Model, readonly stage: Stage, private readonly acts: { look(): void; hide(hidden: boolean): void; trace(point: string): void }) {
    this.board = new Board(stage);
    this.backdrop = new Backdrop(this);
    this.board.free = (at) => {
      const { words, link } = this.snap(at);
      return words === "" || (link !== undefined && this.tool.name === "Move");
    };
    const tools = TOOLS.map((tool) => button(tool.name, () => this.take(tool), { "data-tool": tool.name, title: `${tool.hint} (${tool.key})`, "aria-keyshortcuts": tool.key }));
    const snaps = Object.entries(this.snaps).map(([name, box]) => element("label", {}, box, ` ${name} `));
    this.bar.append(...tools.flatMap((tool) => [tool, " "]), ...snaps, this.where, " ", ...this.backdrop.buttons, this.said, this.counted);
    const { svg } = this.board;
    find("picture").append(svg, this.bar);
    this.show();
    svg.addEventListener("pointerdown", (event) => this.down(event));
    svg.addEventListener("pointermove", (event) => this.moved(event));
    svg.addEventListener("pointerup", (event) => this.up(event));
    svg.addEventListener("wheel", (event) => {
      event.preventDefault();
      stage.zoom(Math.exp(-event.deltaY / 600));
      this.draw();
    }, { passive: false });
    svg.addEventListener("contextmenu", (event) => event.preventDefault());
    (svg as unknown as HTMLElement).addEventListener("keydown", (event) => this.key(event));
    this.where.addEventListener("keydown", (event) => event.key === "Enter" && this.typed());
    stage.orbit.addEventListener("change", () => this.on && this.draw());
    new ResizeObserver(() => this.on && this.draw()).observe(svg.parentElement!);
    model.onLoaded(() => this.read());
    model.onBlank(() => this.read());
    model.onProblems((problems) => {
      const [first] = problems.filter((of) => of.severity === "error");
      if (!this.on) return;
      if (first) this.said.textContent = `Line ${first.line}: ${first.title}`;
      else if (this.said.textContent?.startsWith("Line ")) this.said.textContent = this.tool.hint;
    });
  }

  /** Pins on ground that nothing turns about yet. */
  get pins(): readonly Point[] {
    return this.model.pins;
  }

  set pins(pins: readonly Point[]) {
    this.model.pin(pins);
  }

  /** Begins with nothing drawn. */
  begin() {
    this.pins = [];
    this.from = null;
    this.model.blank({ file: "drawing.ron", text: EMPTY, set: [] });
    this.open(true);
    this.take(TOOLS.find((tool) => tool.name === "Ground")!);
  }

  open(on: boolean) {
    this.on = on;
    if (on && this.model.mechanism) {
      this.model.home();
      if (!this.sketch) {
        this.on = false;
        find<HTMLDetailsElement>("file-part").open = true;
        this.show();
        return this.model.say("Only a file of joint axes with pins, slides and rods in the plane of x and y can be drawn on. This one is edited as text.");
      }
    }
    this.acts.hide(on);
    this.stage.orbit.mouseButtons.LEFT = MOUSE.PAN;
    find<HTMLDetailsElement>("file-part").open ||= on;
    if (on) this.acts.look();
    this.show();
    this.read();
    if (on) (this.board.svg as unknown as HTMLElement).focus();
  }

  take(tool: Tool) {
    this.tool = tool;
    this.from = null;
    this.show();
    this.said.textContent = tool.hint;
    this.draw();
  }

  /** Changes the drawing through its file; what the solver refuses is taken back. */
  change(act: (draft: Draft) => void) {
    const { model } = this;
    const before = model.file;
    const drawn = this.sketch ?? blank(model);
    const draft = new Draft(model, before.text, drawn);
    if (this.sketch) draft.homes(drawn.places);
    act(draft);
    const text = draft.text;
    if (text === before.text) return;
    // parameters at other values would not show in the file
    const file = { ...before, text, set: [] };
    const empty = !field(read(text), "joints")?.entries.length;
    if (empty) model.blank(file);
    else if (!model.load(file)) this.mend(before);
    this.count();
  }

  private mend(before: File) {
    const why = this.said.textContent;
    if (this.sketch) this.model.load(before);
    else this.model.blank(before);
    this.said.textContent = why;
    clearTimeout(this.pause);
  }

  /** The pins on ground that something turns about now. */
  used(...ends: End[]) {
    this.pins = this.pins.filter((pin) => !ends.some(({ at, body }) => body === "ground" && at[0] === pin[0] && at[1] === pin[1]));
  }

  say(words: string) {
    this.said.textContent = words;
  }

  trace(point: string) {
    this.open(false);
    this.acts.trace(point);
  }

  private read() {
    this.bar.hidden = !this.on;
    if (!this.on) return;
    try {
      this.sketch = this.model.mechanism ? sketch(this.model) : null;
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      this.sketch = null;
    }
    this.draw();
    this.count();
  }

  /** Freedoms, redundant constraints, and whether it can be assembled. */
  private count() {
    clearTimeout(this.pause);
    this.pause = setTimeout(() => {
      const { frame, mechanism } = this.model;
      const tell = (words: string) => (this.counted.textContent = words);
      if (!this.on || !mechanism || !frame) return void tell("");
      if (!frame.assembled) return void tell("Cannot be assembled: the dashed gaps do not close with these lengths.");
      try {
        const { report } = this.model.ask<{ report: { mobility: number; redundant: number; redundant_constraints: string[] } }>({ do: "ask", what: "mobility", as_filed: true });
        const freedoms = `${report.mobility} ${report.mobility === 1 ? "freedom" : "freedoms"}`;
        // three constraints of every loop of hinges hold it in its plane, as it is drawn anyway
        const loops = frame.scene.joints.filter((joint) => joint.closure).length;
        const redundant = Math.max(report.redundant - 3 * loops, 0);
        const driven = mechanism.coordinates.filter((of) => of.driven).map((of) => of.name);
        tell(`${freedoms}, ${redundant || "no"} redundant ${redundant === 1 ? "constraint" : "constraints"} in the plane; driven: ${driven.join(", ") || "nothing"}.`);
      } catch (error) {
        if (!(error instanceof Refused)) throw error;
      }
    }, PAUSE);
  }

  private show() {
    const svg = this.board.svg as unknown as HTMLElement;
    svg.style.display = this.on ? "" : "none";
    this.bar.hidden = !this.on;
    find("edit").setAttribute("aria-pressed", String(this.on));
    find("picture").classList.toggle("editing", this.on);
    for (const tool of this.bar.querySelectorAll("[data-tool]")) tool.setAttribute("aria-pressed", String(tool.getAttribute("data-tool") === this.tool.name));
  }

  private snap(at: Point, from = this.from?.at ?? null): Snapped {
    const grid = this.snaps.grid.checked ? this.board.step : null;
    const snaps = { points: this.snaps.points.checked, angles: this.snaps.angles.checked, grid };
    return snapped(this.sketch, this.pins, at, this.board.perPixel, snaps, from);
  }

  draw() {
    if (!this.on) return;
    const { sketch, pins, from, shown } = this;
    this.backdrop.draw();
    this.board.draw({
      sketch, pins, grid: this.snaps.grid.checked ? this.board.step : null,
      dimensions: sketch ? dimensions(sketch, (act) => this.change(act)) : [],
      rubber: from && shown && this.tool.line ? [from.at, shown.at] : null,
      cursor: shown && { at: shown.at, words: shown.words },
    });
  }

  private down(event: PointerEvent) {
    const pan = event.button !== 0;
    this.pressed = { id: event.pointerId, x: event.clientX, y: event.clientY, pan };
    this.board.svg.setPointerCapture(event.pointerId);
    (this.board.svg as unknown as HTMLElement).focus();
    if (!pan) this.press(this.board.place(event));
  }

  private moved(event: PointerEvent) {
    if (this.pressed?.pan) {
      const [a, b] = [this.board.place({ clientX: this.pressed.x, clientY: this.pressed.y }), this.board.place(event)];
      Object.assign(this.pressed, { x: event.clientX, y: event.clientY });
      this.stage.pan(a[0] - b[0], a[1] - b[1]);
      return this.draw();
    }
    this.hover(this.board.place(event));
  }

  private up(event: PointerEvent) {
    const { pressed } = this;
    this.pressed = null;
    if (!pressed || pressed.pan) return;
    const far = Math.hypot(event.clientX - pressed.x, event.clientY - pressed.y) > 5;
    // a click begins, the next one ends; or press, drag, release
    if (far && this.from) this.end(this.board.place(event));
  }

  private hover(at: Point) {
    this.cursor = at;
    this.shown = this.snap(at);
    this.draw();
  }

  /** Something is begun or, if it was begun by a click, ended. */
  private press(at: Point) {
    if (this.backdrop.take(at)) return;
    if (this.from) return this.end(at);
    const begun = this.snap(at, null);
    if (this.tool.click) {
      this.tool.click(this, begun);
      return this.hover(at);
    }
    if (this.tool.begins && !this.tool.begins(this, begun)) return;
    this.from = begun;
    this.hover(at);
  }

  private end(at: Point) {
    const from = this.from;
    this.from = null;
    if (from) this.tool.line?.(this, from, this.snap(at, from.at));
    this.hover(at);
  }

  private key(event: KeyboardEvent) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = this.board.step * (event.shiftKey ? 5 : 1);
    const [x, y] = this.cursor;
    const moves: Record<string, Point> = { ArrowLeft: [x - step, y], ArrowRight: [x + step, y], ArrowUp: [x, y + step], ArrowDown: [x, y - step] };
    const to = moves[event.key];
    const tool = TOOLS.find((of) => of.key === event.key.toUpperCase() || of.key === event.key);
    if (to) {
      this.hover(to);
      const { at, words } = this.shown!;
      this.say(`${Math.round(at[0] * 1e4) / 10}, ${Math.round(at[1] * 1e4) / 10} mm ${words}`);
    } else if (event.key === "Enter" || event.key === " ") this.press(this.cursor);
    else if (event.key === "Escape") this.take(this.from ? this.tool : TOOLS[0]!);
    else if (event.key === "+" || event.key === "-") this.stage.zoom(event.key === "+" ? 1.25 : 0.8);
    else if (tool) this.take(tool);
    else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** A place by its numbers, as a click there. */
  private typed() {
    const numbers = this.where.value.split(/[,;\s]+/).filter(Boolean).map(Number);
    if (numbers.length !== 2 || !numbers.every(Number.isFinite)) return this.say("Write x and y in mm, e.g. 60, 25.");
    const at: Point = [numbers[0]! / 1000, numbers[1]! / 1000];
    const grid = this.snaps.grid.checked;
    this.snaps.grid.checked = false;
    this.press(at);
    this.snaps.grid.checked = grid;
    this.where.value = "";
  }

  /** All that stands at a place. */
  together(at: Point) {
    return this.sketch ? together(this.sketch, { at }) : [];
  }
}

function blank(model: Model): Sketch {
  return { root: new Draft(model, model.file.text, { joints: [], tips: [], places: new Map() } as unknown as Sketch).root, joints: [], tips: [], places: new Map() };
}
