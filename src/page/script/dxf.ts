// The lines and curves of a DXF file, in m (Autodesk, DXF reference 2012).
import type { Point } from "./sketch";

export interface Outline {
  lines: Point[][];
  /** Kinds of entities that are not drawn. */
  others: string[];
}

type Pair = [code: number, value: string];

/** Metres of the units that $INSUNITS counts; mm where nothing is said. */
const UNITS: Record<number, number> = { 1: 0.0254, 2: 0.3048, 4: 1e-3, 5: 1e-2, 6: 1, 8: 2.54e-8, 9: 2.54e-5, 10: 0.9144, 13: 1e-6, 14: 0.1 };

const DEGREE = Math.PI / 180;

/** Pieces of a curve. */
const PIECES = 48;

export function outline(text: string): Outline {
  const rows = text.split(/\r?\n/);
  const pairs: Pair[] = [];
  for (let i = 0; i + 1 < rows.length; i += 2) pairs.push([Number(rows[i]), rows[i + 1]!.trim()]);
  const units = pairs.findIndex(([code, value]) => code === 9 && value === "$INSUNITS");
  const scale = (units >= 0 && UNITS[Number(pairs[units + 1]?.[1])]) || 1e-3;
  const lines: Point[][] = [];
  const others = new Set<string>();
  let polyline: { vertices: Vertex[]; closed: boolean } | null = null;
  for (const { kind, part } of entities(pairs)) {
    if (kind === "POLYLINE") polyline = { vertices: [], closed: (number(part, 70) & 1) === 1 };
    else if (kind === "VERTEX") polyline?.vertices.push({ at: place(part, 10), bulge: number(part, 42) });
    else if (kind === "SEQEND") {
      if (polyline) lines.push(bulged(polyline.vertices, polyline.closed));
      polyline = null;
    } else {
      const line = curve(kind, part);
      if (line) lines.push(line);
      else others.add(kind);
    }
  }
  const scaled = lines.map((line) => line.map(([x, y]): Point => [x * scale, y * scale]));
  return { lines: scaled.filter((line) => line.length > 1 && line.flat().every(Number.isFinite)), others: [...others] };
}

function* entities(pairs: Pair[]): Generator<{ kind: string; part: Pair[] }> {
  let i = pairs.findIndex(([code, value]) => code === 2 && value === "ENTITIES") + 1;
  while (i > 0 && i < pairs.length) {
    const [code, kind] = pairs[i]!;
    let end = i + 1;
    while (end < pairs.length && pairs[end]![0] !== 0) end++;
    if (code === 0 && kind === "ENDSEC") return;
    if (code === 0) yield { kind, part: pairs.slice(i + 1, end) };
    i = end;
  }
}

const number = (part: Pair[], wanted: number): number => Number(part.find(([code]) => code === wanted)?.[1] ?? 0);
const numbers = (part: Pair[], wanted: number): number[] => part.filter(([code]) => code === wanted).map(([, value]) => Number(value));
const place = (part: Pair[], x: number): Point => [number(part, x), number(part, x + 10)];

/** Places of all vertices: the second coordinate may be absent where it is zero. */
const places = (part: Pair[]): Point[] => {
  const ys = numbers(part, 20);
  return numbers(part, 10).map((x, k) => [x, ys[k] ?? 0]);
};

function curve(kind: string, part: Pair[]): Point[] | null {
  switch (kind) {
    case "LINE":
      return [place(part, 10), place(part, 11)];
    case "CIRCLE":
      return round(place(part, 10), [number(part, 40), 0], 1, 0, 2 * Math.PI);
    case "ARC":
      return round(place(part, 10), [number(part, 40), 0], 1, number(part, 50) * DEGREE, number(part, 51) * DEGREE);
    case "ELLIPSE":
      return round(place(part, 10), place(part, 11), number(part, 40), number(part, 41), number(part, 42));
    case "LWPOLYLINE":
      return bulged(polylineVertices(part), (number(part, 70) & 1) === 1);
    case "SPLINE":
      return spline(number(part, 71), numbers(part, 40), places(part));
    default:
      return null;
  }
}

/** Part of an ellipse with a half axis and the ratio of the other one, between two of its parameters. */
function round([x, y]: Point, [u, v]: Point, ratio: number, from: number, end: number): Point[] {
  const to = end <= from ? end + 2 * Math.PI : end;
  return Array.from({ length: PIECES + 1 }, (_, k): Point => {
    const angle = from + ((to - from) * k) / PIECES;
    const [along, across] = [Math.cos(angle), ratio * Math.sin(angle)];
    return [x + along * u - across * v, y + along * v + across * u];
  });
}

/** A place of a polyline, and the tangent of a quarter of the angle of the arc that follows it. */
interface Vertex {
  at: Point;
  bulge: number;
}

function polylineVertices(part: Pair[]): Vertex[] {
  const vertices: Vertex[] = [];
  for (const [code, value] of part) {
    if (code === 10) vertices.push({ at: [Number(value), 0], bulge: 0 });
    else if (code === 20) vertices.at(-1)!.at[1] = Number(value);
    else if (code === 42) vertices.at(-1)!.bulge = Number(value);
  }
  return vertices;
}

function bulged(vertices: Vertex[], closed: boolean): Point[] {
  const ends = closed ? [...vertices, vertices[0]!] : vertices;
  return ends.flatMap(({ at: [x, y] }, k) => {
    const before = ends[k - 1];
    if (!before?.bulge) return [[x, y] as Point];
    const { at: [a, b], bulge } = before;
    // the middle of the arc is off that of the chord
    const off = (1 / bulge - bulge) / 4;
    const middle: Point = [(a + x) / 2 - off * (y - b), (b + y) / 2 + off * (x - a)];
    const turn = 4 * Math.atan(bulge);
    return Array.from({ length: PIECES }, (_, i): Point => {
      const angle = (turn * (i + 1)) / PIECES;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      return [middle[0] + c * (a - middle[0]) - s * (b - middle[1]), middle[1] + s * (a - middle[0]) + c * (b - middle[1])];
    });
  });
}

/** A B-spline without weights (C. de Boor 1972). */
function spline(degree: number, knots: number[], points: Point[]): Point[] {
  const [first, last] = [knots[degree], knots[points.length]];
  if (first === undefined || last === undefined) return [];
  return Array.from({ length: 4 * PIECES + 1 }, (_, i) => {
    const t = first + ((last - first) * i) / (4 * PIECES);
    let span = degree;
    while (span + 1 < points.length && knots[span + 1]! <= t) span++;
    const near = points.slice(span - degree, span + 1);
    for (let level = 1; level <= degree; level++) {
      for (let k = degree; k >= level; k--) {
        const low = knots[span - degree + k]!;
        const part = (t - low) / (knots[span + 1 + k - level]! - low);
        const [a, b] = [near[k - 1]!, near[k]!];
        near[k] = [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])];
      }
    }
    return near[degree]!;
  });
}
