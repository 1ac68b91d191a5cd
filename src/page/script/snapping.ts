// What a place on the drawing board snaps to: points, links, directions, the grid.
import type { End } from "./draft";
import { distance, type Joint, type Point, type Sketch } from "./sketch";
import { spotsOf } from "./board";

export interface Snaps {
  points: boolean;
  angles: boolean;
  /** The step of the grid, if it counts. */
  grid: number | null;
}

export interface Snapped extends End {
  words: string;
  joint?: Joint;
  /** Of the link under it. */
  link?: string;
}

/** As near as this, in pixels, a point or a link is meant. */
const [POINT, LINK] = [13, 8];

/** Directions are multiples of this, in rad, within so much. */
const [DIRECTION, CLOSE] = [Math.PI / 12, 0.05];

export function snapped(sketch: Sketch | null, pins: readonly Point[], at: Point, perPixel: number, snaps: Snaps, from: Point | null): Snapped {
  const near = (to: Point) => distance(at, to) / perPixel;
  const found: { far: number; end: Snapped }[] = [];
  if (snaps.points && sketch) {
    for (const tip of sketch.tips) found.push({ far: near(tip.spot.at), end: { at: tip.spot.at, tip, body: tip.spot.body, words: `point ${tip.name}` } });
    for (const joint of sketch.joints.filter((of) => of.kind === "Revolute")) {
      const [spot] = joint.spots;
      found.push({ far: near(spot.at), end: { at: spot.at, body: spot.body, spot, joint, words: `pin ${joint.name}` } });
    }
    for (const joint of sketch.joints.filter((of) => of.kind === "Prismatic")) {
      const spot = joint.spots[1];
      found.push({ far: near(spot.at) + 3, end: { at: spot.at, body: spot.body, spot, joint, words: `block of ${joint.name}` } });
    }
  }
  if (snaps.points) for (const pin of pins) found.push({ far: near(pin), end: { at: pin, body: "ground", words: "ground pin" } });
  const nearest = found.filter(({ far }) => far < POINT).toSorted((a, b) => a.far - b.far)[0];
  if (nearest) return nearest.end;
  const link = sketch && snaps.points ? linkAt(sketch, at, perPixel) : null;
  if (link) return link;
  const free = directed(at, snaps, from);
  return { at: free.at, words: free.words };
}

/** The link or rod on which a place is. */
export function linkAt(sketch: Sketch, at: Point, perPixel: number): Snapped | null {
  for (const body of [...sketch.places.keys()].filter((name) => name !== "ground")) {
    const spots = spotsOf(sketch, body).map((spot) => spot.at);
    for (const [i, a] of spots.entries()) {
      for (const b of spots.slice(i + 1)) {
        const foot = onLine(a, b, at);
        if (foot && distance(foot, at) / perPixel < LINK) return { at: foot, body, link: body, words: `link ${body}` };
      }
    }
  }
  const rod = sketch.joints.find((joint) => {
    const foot = joint.kind === "Distance" ? onLine(joint.spots[0].at, joint.spots[1].at, at) : null;
    return foot !== null && distance(foot, at) / perPixel < LINK;
  });
  return rod ? { at, joint: rod, words: `rod ${rod.name}` } : null;
}

function onLine(a: Point, b: Point, at: Point): Point | null {
  const way = [b[0] - a[0], b[1] - a[1]] as const;
  const length = way[0] ** 2 + way[1] ** 2;
  if (length < 1e-18) return null;
  const part = ((at[0] - a[0]) * way[0] + (at[1] - a[1]) * way[1]) / length;
  return part < 0 || part > 1 ? null : [a[0] + part * way[0], a[1] + part * way[1]];
}

/** In a direction from where it began, or on the grid. */
function directed(at: Point, { angles, grid }: Snaps, from: Point | null): { at: Point; words: string } {
  if (angles && from) {
    const way = Math.atan2(at[1] - from[1], at[0] - from[0]);
    const straight = DIRECTION * Math.round(way / DIRECTION);
    const length = distance(at, from);
    if (Math.abs(way - straight) < CLOSE && length > 0) {
      const long = grid ? grid * Math.round(length / grid) : length;
      return { at: [from[0] + long * Math.cos(straight), from[1] + long * Math.sin(straight)], words: "" };
    }
  }
  if (!grid) return { at, words: "" };
  return { at: [grid * Math.round(at[0] / grid), grid * Math.round(at[1] / grid)], words: "" };
}
