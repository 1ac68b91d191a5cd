// The force or moment that moves a held coordinate steadily through its range under all loads, with a mark where it is now.
import { Background } from "./background";
import { element, find } from "./elements";
import type { Model } from "./model";
import { Plot } from "./plot";
import { expression } from "./sliders";
import { onThemeChange } from "./theme";
import { type Coordinate, type Extremes, Refused, type Swept } from "./types";

const TURN = 2 * Math.PI;

/** How long nothing moves before the curve is sought anew, in ms. */
const REST = 250;

export class Drive {
  private readonly input = element("select", { id: "drive-input", "aria-label": "Driven coordinate" });
  private readonly turns = element("input", { type: "number", min: "1", max: "20", value: "1", id: "drive-turns", "aria-label": "Turns" });
  private readonly time = element("input", { type: "text", inputmode: "decimal", class: "force", id: "drive-time", value: "1", "aria-label": "Time for the range, or for a turn, in s" });
  private readonly turning = element("label", {}, "over ", this.turns, " turns, each ");
  private readonly canvas = element("canvas", { id: "drive-plot", width: "640", height: "360", hidden: "", role: "img" });
  private readonly plot = new Plot(this.canvas, (row) => this.go(row));
  private readonly background: Background;
  private rest = 0;
  /** What the curve is of. */
  private asked = "";
  private column = 0;
  /** The mechanism for which the section was opened by itself. */
  private of = "";

  constructor(private readonly model: Model, module: WebAssembly.Module) {
    this.background = new Background(module);
    find("drive").append(
      element("p", {}, this.input, " ", this.turning, "in ", this.time, " s"),
      element("p", { id: "drive-said", role: "status" }),
      this.canvas,
    );
    for (const field of [this.input, this.turns, this.time]) field.addEventListener("change", () => this.later());
    this.part.addEventListener("toggle", () => this.later());
    onThemeChange(() => requestAnimationFrame(() => this.mark()));
    model.onLoaded(() => {
      const { name, loaded } = model.mechanism!;
      if (name !== this.of && loaded) this.part.open = true;
      this.of = name;
      this.forget();
    });
    model.onBlank(() => this.forget());
    model.onMoved(() => {
      this.inputs();
      this.mark();
      this.later();
    });
  }

  private get part(): HTMLDetailsElement {
    return find("drive").closest("details")!;
  }

  private get coordinate(): Coordinate | undefined {
    return this.model.mechanism?.coordinates.find((of) => of.name === this.input.value);
  }

  /** Where it is, in rad or m. */
  private value(of: Coordinate): number {
    const { mechanism, frame } = this.model;
    return frame!.values[mechanism!.coordinates.indexOf(of)]![0];
  }

  private inputs() {
    const held = this.model.frame?.held ?? [];
    if (JSON.stringify(held) === this.input.dataset.names) return;
    this.input.dataset.names = JSON.stringify(held);
    this.input.replaceChildren(...held.map((name) => element("option", { value: name }, name)));
  }

  private later() {
    clearTimeout(this.rest);
    this.rest = setTimeout(() => void this.find(), REST);
  }

  private forget() {
    this.background.stop();
    this.asked = "";
    this.plot.values = [];
    this.canvas.hidden = true;
    find("drive-said").textContent = "";
  }

  private async find() {
    const { mechanism, frame, file, pressed, branch } = this.model;
    const of = this.coordinate;
    if (!of || !frame?.assembled || !this.part.open) return;
    this.turning.hidden = !of.angle || of.limits !== null;
    const full = !this.turning.hidden;
    const turns = Math.min(Math.max(Math.round(Number(this.turns.value)), 1), 20) || 1;
    const time = this.model.number(expression(this.time.value, false), "time");
    if (time === null) return;
    const from = this.value(of);
    const low = full ? TURN * Math.floor(from / TURN + 1e-9) : of.range[0];
    const high = full ? low + turns * TURN : of.range[1];
    const others = mechanism!.coordinates.filter((other) => other !== of && frame.held!.includes(other.name)).map((other) => this.value(other));
    const asked = JSON.stringify([file.text, file.set, frame.held, others, of.name, frame.crossed, branch, pressed, low, high, time]);
    if (asked === this.asked) return;
    this.forget();
    this.asked = asked;
    const said = find("drive-said");
    if (!mechanism!.loaded && !pressed) {
      said.textContent = "The file has no masses, springs or forces, and no load is on a body.";
      return;
    }
    if (!(time > 0 && time < 1e9)) {
      said.textContent = "The time is a number of seconds above 0.";
      return;
    }
    const study = (from: number, to: number, more: { steps: number; duration?: number; report?: string[] }, near = this.model.place().at) =>
      this.model.study<Swept>({ do: "sweep", input: [of.name, from, to], ...more }, this.background, near);
    said.textContent = "Computing …";
    try {
      // dampers and friction ask for the sense of the motion: first back to where the range begins
      let start = { at: this.model.place().at, value: from };
      if (from - low > 1e-9 * (high - low)) {
        const back = await study(from, low, { steps: 60 });
        const [{ columns, values, ending }] = back.report.motions as [Swept["report"]["motions"][0]];
        const row = ending === "complete" ? values.length - 1 : Math.max(values.length - 2, 0);
        start = { at: back.states[row]!.at, value: values[row]![columns.findIndex((name) => name.startsWith(`${of.name} (`))]! };
      }
      const range = full ? TURN : high - low;
      const name = `force:${of.name}`;
      const found = await study(start.value, high, { steps: 180, duration: (time * (high - start.value)) / range, report: [name] }, start.at);
      const [{ columns, values, extremes }] = found.report.motions as [Swept["report"]["motions"][0]];
      this.column = columns.findIndex((column) => column.startsWith(`${name} (`));
      Object.assign(this.plot, { columns, values, unbounded: new Set((extremes ?? []).filter((of) => of.unbounded?.length).map((of) => of.name)) });
      const of_force = extremes?.find((of) => of.name === name);
      said.textContent = [found.report.sentence, of_force ? words(of_force, of) : ""].join(" ");
      this.canvas.setAttribute("aria-label", said.textContent);
      this.canvas.hidden = false;
      this.mark();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      if (asked === this.asked) said.textContent = error.message;
    }
  }

  /** The row nearest to where the coordinate is. */
  private mark() {
    const of = this.coordinate;
    const { columns, values } = this.plot;
    if (!of || !values.length || this.canvas.hidden) return;
    const across = columns.findIndex((name) => name.startsWith(`${of.name} (`));
    const from = this.value(of);
    const off = (row: (number | null)[]) => Math.abs(row[across]! - from);
    const row = values.reduce((best, row, i) => (off(row) < off(values[best]!) ? i : best), 0);
    this.plot.draw(across, this.column, row);
    this.canvas.dataset.row = String(row);
  }

  /** The mechanism follows where the plot is pressed. */
  private go(row: number) {
    const of = this.coordinate;
    const to = this.plot.values[row]?.[this.plot.columns.findIndex((name) => name.startsWith(`${of?.name} (`))];
    if (of && to != null) this.model.move(of.name, to);
  }
}

/** `force:theta1 from −2.6 N·m at 158.12° to 1.8 N·m at 304.89°.` */
function words({ name, unit, constant, least, greatest, unbounded, at_least }: Extremes, of: Coordinate): string {
  const number = (value: number) => `${Number(value.toPrecision(5))} ${unit}`;
  if (constant !== undefined) return `${name} is ${number(constant)} all the time.`;
  const end = ({ value, inputs }: { value: number; inputs: number[] }, word: string) => {
    const at = of.angle ? `${Number((((inputs[0] ?? 0) * 180) / Math.PI).toFixed(3))}°` : `${Number((inputs[0] ?? 0).toPrecision(5))} m`;
    return `${at_least ? word : ""}${number(value)} at ${at}`;
  };
  const without = unbounded?.length ? `${name} grows without bound. ` : "";
  return least && greatest ? `${without}${name} from ${end(least, "at most ")} to ${end(greatest, "at least ")}.` : without;
}
