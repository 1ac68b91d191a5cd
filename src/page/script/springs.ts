// Springs, dampers and weights of the file beside the mechanism, and which way things fall.
import { Vector3 } from "three";
import type { Note } from "./arrows";
import { across, type Shapes } from "./shapes";
import { theme } from "./theme";
import type { Scene, SpringShape, Triple } from "./types";

const v = (t: Triple) => new Vector3(...t);

/** Turns of a coil and pieces of each, and of its length what is straight at either end. */
const [TURNS, PIECES, STRAIGHT] = [7, 12, 0.12];

/** Of the extent of a mechanism: the arrow of the largest weight. */
const LARGEST = 0.12;

/** Draws them raised towards the viewer; a weight as an arrow at its centre of mass. */
export function loads(shapes: Shapes, scene: Scene, extent: number, size: number, raised: (point: Vector3) => Vector3): Note[] {
  for (const of of scene.springs ?? []) spring(shapes, of, size, raised);
  const weights = (scene.weights ?? []).map(({ at, force }) => ({ at: v(at), force: v(force) }));
  const largest = Math.max(0, ...weights.map(({ force }) => force.length()));
  return weights.flatMap(({ at, force }) => {
    shapes.ball(raised(at), 0.5 * size, theme().acts);
    if (!(force.length() > 1e-6 * largest)) return [];
    const tip = at.clone().addScaledVector(force, (LARGEST * extent) / largest);
    shapes.arrow(raised(at), raised(tip), 0.13 * size, theme().acts);
    return [{ words: `${Number(force.length().toPrecision(4))} N`, at: tip }];
  });
}

/** Where the arrow stands that shows which way things fall: beside and above the mechanism; none without weights. */
export function falling(scene: Scene, points: Vector3[], extent: number): [Vector3, Vector3] | null {
  const weights = (scene.weights ?? []).map(({ force }) => v(force));
  const down = weights.find((force) => force.length() > 0)?.normalize();
  if (!down) return null;
  const middle = points.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(Math.max(points.length, 1));
  const beside = scene.normal ? down.clone().cross(v(scene.normal)).normalize() : across(down);
  const far = (way: Vector3) => Math.max(...points.map((p) => p.clone().sub(middle).dot(way)));
  const from = middle.clone().addScaledVector(beside, far(beside) + 0.08 * extent).addScaledVector(down, -far(down.clone().negate()));
  return [from, from.clone().addScaledVector(down, LARGEST * extent)];
}

/** A coil between its ends, round a cylinder with its piston if it damps; a spiral at a hinge. */
function spring(shapes: Shapes, { ends, axis, elastic, damping }: SpringShape, size: number, raised: (point: Vector3) => Vector3) {
  const [from, to] = [raised(v(ends[0])), raised(v(ends[1]))];
  const colour = theme().acts;
  const line = (places: Vector3[]) => places.slice(1).forEach((place, i) => shapes.rod(places[i]!, place, 0.12 * size, colour));
  const way = axis ? v(axis) : to.clone().sub(from);
  const length = way.length();
  if (!(length > 1e-9 * size)) return;
  const along = way.clone().divideScalar(length);
  const right = across(along);
  const up = along.clone().cross(right);
  const round = (middle: Vector3, radius: number, turns: number) => {
    const angle = 2 * Math.PI * turns;
    return middle.clone().addScaledVector(right, radius * Math.cos(angle)).addScaledVector(up, radius * Math.sin(angle));
  };
  if (axis) return line(Array.from({ length: 37 }, (_, k) => round(from, (1.2 + k / 24) * size, k / 16)));
  const at = (part: number) => from.clone().lerp(to, part);
  if (damping || !elastic) {
    shapes.rod(from, to, 0.12 * size, colour);
    shapes.cylinder(at(0.35), along, 0.45 * size, 0.15 * length, colour);
  }
  if (!elastic) return;
  const coil = Array.from({ length: TURNS * PIECES + 1 }, (_, k) => round(at(STRAIGHT + (1 - 2 * STRAIGHT) * (k / TURNS / PIECES)), 0.9 * size, k / PIECES));
  line([from, at(STRAIGHT), ...coil, at(1 - STRAIGHT), to]);
}
