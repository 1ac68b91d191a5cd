// One quantity over the input, with a cursor that is the place in the motion.

export class Plot {
  columns: string[] = [];
  values: (number | null)[][] = [];
  /** Rows in which something special was met. */
  marks: number[] = [];
  /** Names of quantities that have no bound. */
  unbounded = new Set<string>();
  private x = 0;

  constructor(private readonly canvas: HTMLCanvasElement, to: (row: number) => void) {
    const pick = (event: PointerEvent) => {
      if (event.buttons !== 1) return;
      const box = canvas.getBoundingClientRect();
      const across = ((event.clientX - box.left) / box.width) * canvas.width;
      const places = this.values.map((row, i) => this.across(this.at(row, i)));
      to(places.reduce((best, place, i) => (Math.abs(place - across) < Math.abs(places[best]! - across) ? i : best), 0));
    };
    canvas.addEventListener("pointerdown", pick);
    canvas.addEventListener("pointermove", pick);
  }

  private low = 0;
  private high = 1;

  /** The abscissa: a column, or the number of the row. */
  private at(row: (number | null)[], i: number): number {
    return this.x >= 0 ? (row[this.x] ?? 0) * this.factor(this.x) : i;
  }

  private factor(column: number): number {
    return this.columns[column]!.endsWith("(rad)") ? 180 / Math.PI : 1;
  }

  title(column: number): string {
    return column >= 0 ? this.columns[column]!.replace("(rad)", "(°)") : "row";
  }

  private across(x: number): number {
    return 70 + ((x - this.low) / (this.high - this.low || 1)) * (this.canvas.width - 90);
  }

  draw(x: number, y: number, cursor: number) {
    this.x = x;
    const { canvas, values } = this;
    const pen = canvas.getContext("2d")!;
    const style = getComputedStyle(document.documentElement);
    const colour = (name: string) => style.getPropertyValue(name).trim();
    pen.clearRect(0, 0, canvas.width, canvas.height);
    pen.font = "20px system-ui, sans-serif";
    pen.lineWidth = 1.5;
    const xs = values.map((row, i) => this.at(row, i));
    const ys = values.map((row) => (row[y] == null ? null : row[y] * this.factor(y)));
    const known = ys.filter((value): value is number => value !== null);
    if (!known.length) return;
    [this.low, this.high] = [Math.min(...xs), Math.max(...xs)];
    const free = [...this.unbounded].some((name) => this.columns[y] === name || this.columns[y]!.startsWith(`${name} (`));
    let [bottom, top] = free ? most(known) : [Math.min(...known), Math.max(...known)];
    if (top - bottom < 1e-9 * Math.max(Math.abs(top), 1e-3)) [bottom, top] = [bottom - 0.5, top + 0.5];
    const up = (value: number) => canvas.height - 52 - ((value - bottom) / (top - bottom)) * (canvas.height - 92);
    pen.strokeStyle = colour("--line");
    pen.fillStyle = colour("--soft");
    for (const value of ticks(bottom, top)) {
      pen.beginPath();
      pen.moveTo(70, up(value));
      pen.lineTo(canvas.width - 20, up(value));
      pen.stroke();
      pen.textAlign = "right";
      pen.fillText(short(value), 64, up(value) + 7);
    }
    for (const value of ticks(this.low, this.high)) {
      pen.textAlign = "center";
      pen.fillText(short(value), this.across(value), canvas.height - 28);
    }
    pen.textAlign = "right";
    pen.fillText(this.title(x), canvas.width - 20, canvas.height - 4);
    pen.textAlign = "left";
    pen.fillText(this.title(y), 8, 22);
    pen.strokeStyle = colour("--mark");
    pen.lineWidth = 3;
    pen.save();
    pen.beginPath();
    pen.rect(70, 40, canvas.width - 90, canvas.height - 92);
    if (free) pen.clip();
    pen.beginPath();
    let open = false;
    ys.forEach((value, i) => {
      if (value === null) {
        open = false;
        return;
      }
      // a pole is not crossed
      const before = ys[i - 1];
      if (free && before != null && before * value < 0 && Math.abs(value - before) > 0.5 * (top - bottom)) open = false;
      if (open) pen.lineTo(this.across(xs[i]!), up(value));
      else pen.moveTo(this.across(xs[i]!), up(value));
      open = true;
    });
    pen.stroke();
    pen.restore();
    pen.fillStyle = colour("--warn");
    const dot = (i: number, size: number) => {
      const value = ys[i];
      if (value == null || value < bottom || value > top) return;
      pen.beginPath();
      pen.arc(this.across(xs[i]!), up(value), size, 0, 2 * Math.PI);
      pen.fill();
    };
    this.marks.forEach((i) => dot(i, 6));
    pen.strokeStyle = colour("--warn");
    pen.lineWidth = 1.5;
    pen.beginPath();
    pen.moveTo(this.across(xs[cursor]!), 30);
    pen.lineTo(this.across(xs[cursor]!), canvas.height - 52);
    pen.stroke();
    pen.fillStyle = colour("--ink");
    dot(cursor, 5);
  }
}

/** The range of four values of five, and as much again above and below: what is beyond belongs to a pole. */
function most(values: number[]): [number, number] {
  const sorted = [...values].sort((a, b) => a - b);
  const at = (part: number) => sorted[Math.floor(part * (sorted.length - 1))]!;
  const room = at(0.9) - at(0.1);
  return [at(0.1) - room, at(0.9) + room];
}

function ticks(low: number, high: number): number[] {
  const rough = (high - low) / 5 || 1;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((part) => part * power).find((size) => size >= rough) ?? 10 * power;
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: last - first + 1 }, (_, i) => (first + i) * step);
}

const short = (value: number): string => String(Number(value.toPrecision(4)));
