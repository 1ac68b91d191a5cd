// A sweep of one coordinate that is held, the whole curve, or the motion by itself: played, with traced points and a plot.
import { button, element, find } from "./elements";
import type { Model } from "./model";
import { Plot } from "./plot";
import { expression } from "./sliders";
import { onThemeChange } from "./theme";
import { type LetGo, Refused, type Row, type Scene, type Swept, type Triple } from "./types";

export interface Trace {
  points: Triple[];
  marks: { at: Triple; words: string }[];
}

const WORDS: Record<string, string> = {
  fold: "dead point", turning: "turning point", crossing: "crossing", limit: "limit", cusp: "cusp",
};

const still = matchMedia("(prefers-reduced-motion: reduce)");

export class Motion {
  private rows: Row[] = [];
  private swept: Swept | null = null;
  private playing = 0;
  /** The mechanism that points and quantities are of. */
  private of = "";
  /** Whether the end is the beginning. */
  private round = false;
  /** Whether it is the motion by itself, which has no way back. */
  private alone = false;
  /** Rows in a second. */
  private pace = 60;
  /** The column that the plot is over. */
  private over = "";
  private readonly cursor = element("input", { type: "range", min: "0", max: "0", value: "0", id: "cursor", "aria-label": "Place in the motion" });
  private readonly point = element("input", { type: "text", id: "traced", placeholder: "click a body, or e.g. left+0.5", "aria-label": "Traced point" });
  private readonly report = element("input", { type: "text", id: "reported", placeholder: "quantities, e.g. transmission", "aria-label": "Quantities" });
  private readonly quantity = element("select", { id: "quantity", "aria-label": "Quantity of the plot" });
  private readonly input = element("select", { id: "input", "aria-label": "Input" });
  private readonly speed = element("select", { id: "speed", "aria-label": "Speed" },
    ...[0.01, 0.1, 0.25, 0.5, 1, 2, 5].map((times) => element("option", { value: String(times), ...(times === 1 ? { selected: "" } : {}) }, `× ${times}`)));
  private readonly time = element("input", { type: "text", inputmode: "decimal", class: "force", id: "let-go-time", value: "1", "aria-label": "Time in s" });
  private readonly back = element("input", { type: "text", inputmode: "decimal", class: "force", id: "restitution", "aria-label": "Part of its speed with which a joint comes back from a limit" });
  private readonly through = element("input", { type: "checkbox", id: "through" });
  private readonly plot: Plot;

  constructor(
    private readonly model: Model,
    private readonly trace: (traces: Trace[]) => void,
    private readonly picture: (scene: Scene | null) => void,
    private readonly room: (scenes: Scene[]) => void,
  ) {
    const sweep = button("Sweep", () => this.sweep(), { id: "sweep" });
    const play = button("Play", () => this.play(), { id: "play", disabled: "" });
    const again = button("Again", () => this.again(), { id: "again", disabled: "" });
    const letGo = button("Let go", () => void this.letGo(), { id: "let-go", title: "It moves by itself under its loads, from rest" });
    const leave = button("Clear", () => this.clear(), { id: "clear-motion" });
    const canvas = element("canvas", { id: "plot", width: "640", height: "360", hidden: "" });
    this.plot = new Plot(canvas, (row) => this.to(row));
    find("motion").append(
      element("p", {}, "Move ", this.input, " trace ", this.point, this.report),
      element("p", {}, sweep, " ", letGo, " for ", this.time, " s"),
      element("p", {}, "At a limit it ends, or comes back with ", this.back, " of its speed. Where branches meet it ends, or goes ", element("label", {}, this.through, " straight on")),
      element("p", {}, play, " ", again, " ", this.speed, " ", leave),
      element("div", { id: "motion-said", role: "status" }),
      this.cursor,
      element("p", { id: "plotted", hidden: "" }, "Plot ", this.quantity),
      canvas,
    );
    this.cursor.hidden = true;
    this.cursor.addEventListener("input", () => this.to(Number(this.cursor.value)));
    this.quantity.addEventListener("change", () => this.draw());
    // the colours of the page are the new ones with the next picture
    onThemeChange(() => requestAnimationFrame(() => this.draw()));
    model.onLoaded(() => {
      this.clear();
      const name = model.mechanism!.name;
      if (name !== this.of) this.point.value = this.report.value = "";
      this.of = name;
    });
    model.onMoved(() => this.inputs());
  }

  /** Names a point that is to be traced. */
  take(point: string) {
    this.point.value = point;
  }

  /** Moves what is held and shows the path of a point. */
  tracePoint(point: string) {
    this.point.value = point;
    find("motion").closest("details")!.open = true;
    this.inputs();
    void this.sweep().then(() => this.rows.length && !this.playing && this.play());
  }

  private inputs() {
    const held = this.model.frame?.held ?? [];
    const names = [...held, "the whole curve"];
    if (JSON.stringify(names) === this.input.dataset.names) return;
    this.input.dataset.names = JSON.stringify(names);
    const whole = held.length === 1 ? [element("option", { value: "" }, "along the whole curve")] : [];
    this.input.replaceChildren(...held.map((name) => element("option", { value: name }, name)), ...whole);
  }

  private async sweep() {
    const { mechanism, frame } = this.model;
    if (!mechanism || !frame) return;
    const name = this.input.value;
    const index = mechanism.coordinates.findIndex((of) => of.name === name);
    const of = mechanism.coordinates[index];
    const said = find("motion-said");
    said.textContent = "Moving …";
    const given = (field: HTMLInputElement) => (field.value.trim() ? [field.value.trim()] : []);
    const [points, report] = [given(this.point), given(this.report)];
    // forwards from where it is to the end of the range, and backwards likewise
    const from = index < 0 ? 0 : frame.values[index]![0];
    const ends = !of ? [] : of.angle && !of.limits ? [from + 2 * Math.PI] : [of.range[0], of.range[1]];
    try {
      const parts: Swept[] = [];
      if (!of) parts.push(await this.model.study<Swept>({ do: "sweep", steps: 180, follow: true, points, report }));
      for (const to of ends.filter((to) => Math.abs(to - from) > 1e-9)) {
        parts.push(await this.model.study<Swept>({ do: "sweep", input: [name, from, to], steps: 180, points, report }));
      }
      // a turn that is not completed forwards is made backwards too
      if (of && ends.length === 1 && parts[0]!.report.motions[0]!.ending !== "complete") {
        parts.unshift(await this.model.study<Swept>({ do: "sweep", input: [name, from, from - 2 * Math.PI], steps: 180, points, report }));
      }
      this.take_parts(parts);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      said.textContent = error.message;
    }
  }

  /** From where it is, at rest. */
  private async letGo() {
    const number = (field: HTMLInputElement) => Number(field.value.trim().replace(",", "."));
    const duration = this.model.number(expression(this.time.value, false), "time");
    if (duration === null) return;
    if (!(duration > 0 && duration < 1e6)) return say("The time is a number of seconds above 0.");
    const restitution = this.back.value.trim() ? number(this.back) : null;
    if (restitution !== null && !(restitution >= 0 && restitution <= 1)) return say("The part of its speed is a number from 0 to 1; without one the motion ends at a limit.");
    say("Moving …");
    const rows = Math.min(Math.max(Math.ceil(60 * duration), 300), 3000);
    const points = this.point.value.trim() ? [this.point.value.trim()] : [];
    try {
      const found = await this.model.study<LetGo>({ do: "let_go", duration, rows, restitution, through: this.through.checked, points });
      const { columns, rows: values } = found.report;
      this.stop();
      [this.alone, this.round, this.pace, this.over, this.swept] = [true, false, rows / duration, "t (s)", null];
      this.shown(found.states, columns.map(({ name, unit }) => `${name} (${unit})`), values, found.said);
      if (!still.matches) this.again();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      say(error.message);
    }
  }

  private take_parts(parts: Swept[]) {
    const [first, second] = parts;
    if (!first) return;
    const rows = second ? [...first.states.toReversed(), ...second.states.slice(1)] : first.states;
    const motions = parts.map((part) => part.report.motions[0]!);
    const values = second
      ? [...motions[0]!.values.toReversed(), ...motions[1]!.values.slice(1)]
      : motions[0]!.values;
    this.swept = first;
    const unbounded = new Set(motions.flatMap((motion) => motion.extremes ?? []).filter((of) => of.unbounded?.length).map((of) => of.name));
    const sentences = [...parts.map((part) => part.report.sentence), ...[...unbounded].map((name) => `${name} grows without bound.`)];
    const columns = motions[0]!.columns;
    const angle = this.model.mechanism?.coordinates.find((of) => of.name === this.input.value)?.angle ?? false;
    this.stop();
    const round = motions.length === 1 && (motions[0]!.ending === "closed" || (motions[0]!.ending === "complete" && angle));
    [this.alone, this.round, this.pace, this.over] = [false, round, 60, columns.find((name) => name.startsWith(`${this.input.value} `)) ?? ""];
    this.shown(rows, columns, values, [sentences.join(" ")], unbounded);
  }

  private shown(rows: Row[], columns: string[], values: (number | null)[][], sentences: string[], unbounded = new Set<string>()) {
    this.rows = rows;
    say(...sentences);
    this.plot.columns = columns;
    this.plot.values = values;
    this.plot.unbounded = unbounded;
    this.plot.marks = this.rows.flatMap((row, i) => (row.special ? [i] : []));
    const chosen = this.quantity.selectedOptions[0]?.textContent;
    this.quantity.replaceChildren(...columns.slice(1).map((_, i) => element("option", { value: String(i + 1) }, this.plot.title(i + 1))));
    const again = [...this.quantity.options].find((option) => option.textContent === chosen);
    const wanted = this.report.value.trim() && !this.alone ? columns.length - 1 : -1;
    const free = columns.findIndex((name, i) => i > 0 && name !== this.over);
    this.quantity.value = wanted > 0 ? String(wanted) : (again?.value ?? String(Math.max(free, 1)));
    this.cursor.max = String(this.rows.length - 1);
    for (const shown of [this.cursor, find("plotted"), find("plot")]) shown.hidden = false;
    for (const id of ["play", "again"]) find(id).removeAttribute("disabled");
    const marks = (point: number) => this.rows.flatMap((row) =>
      row.special && row.points[point] ? [{ at: row.points[point], words: WORDS[row.special.met] ?? row.special.met }] : []);
    this.trace((this.rows[0]?.points ?? []).map((_, k) => ({ points: this.rows.map((row) => row.points[k]!), marks: marks(k) })));
    const few = this.rows.filter((_, i) => i % Math.ceil(this.rows.length / 24) === 0);
    this.room(few.map((row) => this.model.scene(row.at)));
    this.to(0);
  }

  private draw() {
    this.plot.draw(this.plot.columns.indexOf(this.over), Number(this.quantity.value), Number(this.cursor.value));
  }

  /** Shows a row; the mechanism itself goes there too where it can. */
  private to(row: number) {
    const there = this.rows[row];
    if (!there) return;
    this.cursor.value = String(row);
    this.picture(this.model.scene(there.at));
    this.draw();
  }

  private play() {
    if (this.playing) return this.stop();
    find("play").textContent = "Pause";
    const last = this.rows.length - 1;
    let row = Number(this.cursor.value);
    if (this.alone && row >= last) row = 0;
    let way = 1;
    let before = performance.now();
    const step = (now: number) => {
      row += (way * Math.max(now - before, 0) * this.pace * Number(this.speed.value)) / 1000;
      before = now;
      if (row >= last && this.round) row %= Math.max(last, 1);
      else if (row >= last || row <= 0) {
        way = row <= 0 ? 1 : -1;
        row = Math.min(Math.max(row, 0), last);
      }
      this.to(Math.round(row));
      if (this.alone && way < 0) return this.stop();
      this.playing = requestAnimationFrame(step);
    };
    this.playing = requestAnimationFrame(step);
  }

  private stop() {
    cancelAnimationFrame(this.playing);
    this.playing = 0;
    find("play").textContent = "Play";
  }

  private again() {
    this.stop();
    this.to(0);
    this.play();
  }

  clear() {
    this.stop();
    this.rows = [];
    this.swept = null;
    for (const shown of [this.cursor, find("plotted"), find("plot")]) shown.hidden = true;
    for (const id of ["play", "again"]) find(id).setAttribute("disabled", "");
    say();
    this.trace([]);
    this.picture(null);
  }

  get done(): Swept | null {
    return this.swept;
  }
}

/** A paragraph each. */
function say(...sentences: string[]) {
  find("motion-said").replaceChildren(...sentences.map((words) => element("p", {}, words)));
}
