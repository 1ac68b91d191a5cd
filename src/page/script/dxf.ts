// The lines, circles, arcs and polylines of a DXF file, in m.
import type { Point } from "./sketch";

export interface Outline {
  lines: Point[][];
}

/** Metres of the units that $INSUNITS counts; mm where nothing is said. */
const UNITS: Record<number, number> = { 1: 0.0254, 2: 0.3048, 4: 1e-3, 5: 1e-2, 6: 1, 8: 2.54e-8, 9: 2.54e-5, 10: 0.9144, 13: 1e-6, 14: 0.1 };

export function outline(text: string): Outline {
  const rows = text.split(/\r?\n/);
  const pairs: [number, string][] = [];
  for (let i = 0; i + 1 < rows.length; i += 2) pairs.push([Number(rows[i]), rows[i + 1]!.trim()]);
  const units = pairs.findIndex(([code, value]) => code === 9 && value === "$INSUNITS");
  const scale = UNITS[Number(pairs[units + 1]?.[1])] ?? 1e-3;
  const begin = pairs.findIndex(([code, value]) => code === 2 && value === "ENTITIES");
  const lines: Point[][] = [];
  let polyline: { points: Point[]; closed: boolean } | null = null;
  for (let i = begin + 1; i < pairs.length;) {
    const [code, kind] = pairs[i]!;
    let end = i + 1;
    while (end < pairs.length && pairs[end]![0] !== 0) end++;
    const part = pairs.slice(i + 1, end);
    i = end;
    if (code !== 0) continue;
    if (kind === "ENDSEC") break;
    const number = (wanted: number) => Number(part.find(([code]) => code === wanted)?.[1] ?? 0);
    const at = (x: number): Point => [number(x) * scale, number(x + 10) * scale];
    const round = (from: number, to: number) => {
      const [x, y] = at(10);
      const radius = number(40) * scale;
      return Array.from({ length: 49 }, (_, k): Point => {
        const angle = from + ((to - from) * k) / 48;
        return [x + radius * Math.cos(angle), y + radius * Math.sin(angle)];
      });
    };
    if (kind === "LINE") lines.push([at(10), at(11)]);
    else if (kind === "CIRCLE") lines.push(round(0, 2 * Math.PI));
    else if (kind === "ARC") {
      const [from, to] = [number(50), number(51)].map((angle) => (angle * Math.PI) / 180) as [number, number];
      lines.push(round(from, to <= from ? to + 2 * Math.PI : to));
    } else if (kind === "LWPOLYLINE") {
      const xs = part.filter(([code]) => code === 10).map(([, x]) => Number(x) * scale);
      const ys = part.filter(([code]) => code === 20).map(([, y]) => Number(y) * scale);
      const points = xs.map((x, k): Point => [x, ys[k] ?? 0]);
      lines.push(number(70) & 1 ? [...points, points[0]!] : points);
    } else if (kind === "POLYLINE") polyline = { points: [], closed: (number(70) & 1) === 1 };
    else if (kind === "VERTEX") polyline?.points.push(at(10));
    else if (kind === "SEQEND" && polyline) {
      lines.push(polyline.closed ? [...polyline.points, polyline.points[0]!] : polyline.points);
      polyline = null;
    }
  }
  return { lines: lines.filter((line) => line.length > 1 && line.flat().every(Number.isFinite)) };
}
