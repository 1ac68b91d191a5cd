// The dimensions of a drawing: lengths of links and rods, places on them and on ground.
import { type Dimension, spotsOf } from "./board";
import type { Draft } from "./draft";
import { field } from "./ron";
import { distance, type Point, type Sketch, type Spot } from "./sketch";

export function dimensions(sketch: Sketch, change: (act: (draft: Draft) => void) => void): Dimension[] {
  const links = [...sketch.places.keys()].filter((body) => body !== "ground").flatMap((body) => ofLink(sketch, body, change));
  const rods = sketch.joints.filter((joint) => joint.kind === "Distance").map((joint): Dimension => ({
    from: joint.spots[0].at, to: joint.spots[1].at, name: joint.name,
    set: (length) => change((draft) => {
      const node = field(joint.entry.value, "length") ?? field(joint.entry.value, "home");
      if (node) draft.write(node, length);
    }),
  }));
  return [...links, ...rods, ...ofGround(sketch, change)];
}

function ofLink(sketch: Sketch, body: string, change: (act: (draft: Draft) => void) => void): Dimension[] {
  const spots = distinct(spotsOf(sketch, body));
  const first = spots.find(({ local: [x, y] }) => x === 0 && y === 0) ?? spots[0];
  const second = spots.find((spot) => spot !== first && spot.local[0] > 0 && spot.nodes[1].text === "0");
  if (!first) return [];
  const length: Dimension[] = second ? [{ from: first.at, to: second.at, name: body, set: (to) => change((draft) => draft.write(second.nodes[0], to)) }] : [];
  const others = spots.filter((spot) => spot !== first && spot !== second).flatMap((spot, i) => {
    const ends = [first, ...(second ? [second] : [])];
    return ends.map((end, k): Dimension => ({
      from: end.at, to: spot.at, name: `${body}, place ${i + 1} from ${k ? "the second" : "the first"} pin`,
      set: (to) => change((draft) => {
        const other = ends.find((of) => of !== end);
        const local = other ? crossing(end.local, to, other.local, distance(other.local, spot.local), spot.local) : along(end.local, spot.local, to);
        spot.nodes.forEach((node, axis) => draft.write(node, local[axis]!));
      }),
    }));
  });
  return [...length, ...others];
}

function ofGround(sketch: Sketch, change: (act: (draft: Draft) => void) => void): Dimension[] {
  const [first, ...others] = distinct(spotsOf(sketch, "ground").filter((spot) => !sketch.joints.some((joint) => joint.kind === "Prismatic" && joint.spots.includes(spot))));
  if (!first) return [];
  return others.map((spot, i): Dimension => ({
    from: first.at, to: spot.at, name: `ground, pin ${i + 2} from the first`,
    set: (to) => change((draft) => draft.move(together(sketch, spot), along(first.at, spot.at, to))),
  }));
}

/** All that stands where a place is. */
export function together(sketch: Sketch, { at }: { at: Point }): Spot[] {
  const spots = [...sketch.joints.flatMap((joint) => joint.spots), ...sketch.tips.map(({ spot }) => spot)];
  return spots.filter((spot) => distance(spot.at, at) < 1e-7);
}

function distinct(spots: Spot[]): Spot[] {
  return spots.filter((spot, i) => spots.findIndex((other) => distance(other.at, spot.at) < 1e-7) === i);
}

function along(from: Point, to: Point, length: number): Point {
  const part = length / Math.max(distance(from, to), 1e-12);
  return [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])];
}

/** Where two circles meet, on the side of a place; as near as they come if they do not. */
function crossing(a: Point, ra: number, b: Point, rb: number, side: Point): Point {
  const apart = distance(a, b);
  const x = (apart ** 2 + ra ** 2 - rb ** 2) / (2 * apart);
  const y = Math.sqrt(Math.max(ra ** 2 - x ** 2, 0));
  const way: Point = [(b[0] - a[0]) / apart, (b[1] - a[1]) / apart];
  const left = way[0] * (side[1] - a[1]) - way[1] * (side[0] - a[0]) >= 0 ? 1 : -1;
  return [a[0] + x * way[0] - left * y * way[1], a[1] + x * way[1] + left * y * way[0]];
}
