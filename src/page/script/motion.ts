// A sweep of one coordinate that is held, or the whole curve: played, with traced points and a plot beside it.
import { button, element, find } from "./elements";
import type { Model } from "./model";
import { Plot } from "./plot";
import { onThemeChange } from "./theme";
import { Refused, type Row, type Scene, type Swept, type Triple } from "./types";

export interface Trace {
  points: Triple[];
  marks: { at: Triple; words: string }[];
}

const WORDS: Record<string, string> = {
  fold: "dead point", turning: "turning point", crossing: "crossing", limit: "limit", cusp: "cusp",
};

export class Motion {
  private rows: Row[] = [];
  private swept: Swept | null = null;
  private playing = 0;
  /** The mechanism that points and quantities are of. */
  private of = "";
  /** Whether the end is the beginning. */
  private round = false;
  private readonly cursor = element("input", { type: "range", min: "0", max: "0", value: "0", id: "cursor", "aria-label": "Place in the motion" });
  private readonly point = element("input", { type: "text", id: "traced", placeholder: "click a body, or e.g. left+0.5", "aria-label": "Traced point" });
  private readonly report = element("input", { type: "text", id: "reported", placeholder: "quantities, e.g. transmission", "aria-label": "Quantities" });
  private readonly quantity = element("select", { id: "quantity", "aria-label": "Quantity of the plot" });
  private readonly input = element("select", { id: "input", "aria-label": "Input" });
  private readonly plot: Plot;

  constructor(
    private readonly model: Model,
    private readonly trace: (traces: Trace[]) => void,
    private readonly picture: (scene: Scene | null) => void,
    private readonly room: (scenes: Scene[]) => void,
  ) {
    const sweep = button("Sweep", () => this.sweep(), { id: "sweep" });
    const play = button("Play", () => this.play(), { id: "play", disabled: "" });
    const leave = button("Clear", () => this.clear(), { id: "clear-motion" });
    const canvas = element("canvas", { id: "plot", width: "640", height: "360", hidden: "" });
    this.plot = new Plot(canvas, (row) => this.to(row));
    find("motion").append(
      element("p", {}, "Move ", this.input, " trace ", this.point, this.report),
      element("p", {}, sweep, " ", play, " ", leave),
      element("p", { id: "motion-said", role: "status" }),
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

  private take_parts(parts: Swept[]) {
    const [first, second] = parts;
    if (!first) return;
    this.rows = second ? [...first.states.toReversed(), ...second.states.slice(1)] : first.states;
    const motions = parts.map((part) => part.report.motions[0]!);
    const values = second
      ? [...motions[0]!.values.toReversed(), ...motions[1]!.values.slice(1)]
      : motions[0]!.values;
    this.swept = first;
    const unbounded = new Set(motions.flatMap((motion) => motion.extremes ?? []).filter((of) => of.unbounded?.length).map((of) => of.name));
    const sentences = [...parts.map((part) => part.report.sentence), ...[...unbounded].map((name) => `${name} grows without bound.`)];
    find("motion-said").textContent = sentences.join(" ");
    const columns = motions[0]!.columns;
    const angle = this.model.mechanism?.coordinates.find((of) => of.name === this.input.value)?.angle ?? false;
    this.plot.columns = columns;
    this.plot.values = values;
    this.plot.unbounded = unbounded;
    this.plot.marks = this.rows.flatMap((row, i) => (row.special ? [i] : []));
    const chosen = this.quantity.selectedOptions[0]?.textContent;
    this.quantity.replaceChildren(...columns.slice(1).map((_, i) => element("option", { value: String(i + 1) }, this.plot.title(i + 1))));
    const again = [...this.quantity.options].find((option) => option.textContent === chosen);
    const wanted = this.report.value.trim() ? columns.length - 1 : -1;
    const free = columns.findIndex((name, i) => i > 0 && !name.startsWith(`${this.input.value} `));
    this.quantity.value = wanted > 0 ? String(wanted) : (again?.value ?? String(Math.max(free, 1)));
    this.cursor.max = String(this.rows.length - 1);
    for (const shown of [this.cursor, find("plotted"), find("plot")]) shown.hidden = false;
    find("play").removeAttribute("disabled");
    const marks = (point: number) => this.rows.flatMap((row) =>
      row.special && row.points[point] ? [{ at: row.points[point], words: WORDS[row.special.met] ?? row.special.met }] : []);
    this.trace((this.rows[0]?.points ?? []).map((_, k) => ({ points: this.rows.map((row) => row.points[k]!), marks: marks(k) })));
    const few = this.rows.filter((_, i) => i % Math.ceil(this.rows.length / 24) === 0);
    this.room(few.map((row) => this.model.scene(row.at)));
    this.round = motions.length === 1 && (motions[0]!.ending === "closed" || (motions[0]!.ending === "complete" && angle));
    this.to(0);
  }

  private draw() {
    const x = this.plot.columns.findIndex((name) => name.startsWith(`${this.input.value} `));
    this.plot.draw(x, Number(this.quantity.value), Number(this.cursor.value));
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
    if (this.playing) {
      cancelAnimationFrame(this.playing);
      this.playing = 0;
      find("play").textContent = "Play";
      return;
    }
    find("play").textContent = "Pause";
    let row = Number(this.cursor.value);
    let forwards = true;
    const step = () => {
      if (row >= this.rows.length - 1) {
        if (this.round) row = 0;
        else forwards = false;
      }
      if (row <= 0) forwards = true;
      row += forwards ? 1 : -1;
      this.to(row);
      this.playing = requestAnimationFrame(step);
    };
    this.playing = requestAnimationFrame(step);
  }

  clear() {
    if (this.playing) this.play();
    this.rows = [];
    this.swept = null;
    for (const shown of [this.cursor, find("plotted"), find("plot")]) shown.hidden = true;
    find("play").setAttribute("disabled", "");
    find("motion-said").textContent = "";
    this.trace([]);
    this.picture(null);
  }

  get done(): Swept | null {
    return this.swept;
  }
}
