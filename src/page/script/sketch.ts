// A planar mechanism as it is drawn: pins, slides, rods and points with their places in the file and in the picture.
import type { Model } from "./model";
import { type Entry, field, type Node, read } from "./ron";
import type { Scene } from "./types";

export type Point = [number, number];

/** Where a body is: its drawing is turned by an angle about the origin, then shifted. */
export interface Place {
  angle: number;
  shift: Point;
}

/** A place on a body: as written, in the drawing of the body, and in the picture. */
export interface Spot {
  body: string;
  /** The nodes of its two coordinates. */
  nodes: [Node, Node];
  local: Point;
  at: Point;
}

export interface Joint {
  name: string;
  kind: string;
  entry: Entry;
  /** On the first body and on the second. */
  spots: [Spot, Spot];
  /** Of a slide its angle in the picture. */
  along: number;
  driven: boolean;
  follows: boolean;
  /** Whether it has a place of its own on each body. */
  apart: boolean;
}

export interface Tip {
  name: string;
  entry: Entry;
  spot: Spot;
}

export interface Sketch {
  root: Node;
  joints: Joint[];
  tips: Tip[];
  places: Map<string, Place>;
}

export const turned = ([x, y]: Point, angle: number): Point => {
  const [sin, cos] = [Math.sin(angle), Math.cos(angle)];
  return [cos * x - sin * y, sin * x + cos * y];
};

export const placed = (place: Place, local: Point): Point => {
  const [x, y] = turned(local, place.angle);
  return [x + place.shift[0], y + place.shift[1]];
};

export const localOf = (place: Place, at: Point): Point => turned([at[0] - place.shift[0], at[1] - place.shift[1]], -place.angle);

export const distance = (a: Point, b: Point): number => Math.hypot(a[0] - b[0], a[1] - b[1]);

const STILL: Place = { angle: 0, shift: [0, 0] };

/** The number of a coordinate in m, or of an angle in rad. */
export function numberOf(model: Model, node: Node | undefined, measure: "length" | "angle" = "length"): number {
  if (!node) return 0;
  if (node.kind === "atom") return Number(node.text);
  try {
    return model.ask<{ value: number }>({ do: "number", text: node.text, measure }).value;
  } catch {
    return Number.NaN;
  }
}

/** What is drawn in the plane of x and y; nothing if the file is something else. */
export function sketch(model: Model): Sketch | null {
  const root = read(model.file.text);
  const { frame } = model;
  if (!root || root.text !== "Axes" || !frame) return null;
  const scene = model.ask<{ scene: Scene }>({ do: "show", at: frame.at, frames: true }).scene;
  if (scene.normal && Math.abs(Math.abs(scene.normal[2]) - 1) > 1e-9) return null;
  const names = new Map<string, Place>([["ground", STILL]]);
  const joints: Joint[] = [];
  for (const entry of field(root, "joints")?.entries ?? []) {
    const joint = jointOf(model, entry);
    if (!joint) return null;
    joints.push(joint);
  }
  const tips = (field(root, "points")?.entries ?? []).flatMap((entry): Tip[] => {
    const spot = spotOf(model, field(entry.value, "body")?.text ?? "", field(entry.value, "at"));
    return spot ? [{ name: entry.key, entry, spot }] : [];
  });
  // how a body is turned says its frame; where it is, a joint that carries it
  const pair = (names: string[]) => names.toSorted().join("\n");
  const carrying = (joint: Joint) => {
    const bodies = pair(joint.spots.map(({ body }) => body));
    const shapes = scene.joints.filter((shape) => !shape.closure && pair(shape.bodies.map((body) => scene.bodies[body]!.name)) === bodies);
    return (shapes.find((shape) => shape.names.includes(joint.name)) ?? shapes[0])?.at;
  };
  const waiting = [...joints];
  for (let before = -1; waiting.length && before !== waiting.length;) {
    before = waiting.length;
    for (const joint of [...waiting]) {
      const at = carrying(joint);
      for (const [i, k] of [[0, 1], [1, 0]] as const) {
        const [from, to] = [joint.spots[i], joint.spots[k]];
        const base = names.get(from.body);
        const triad = scene.frames?.find((frame) => frame.name === to.body);
        if (!base || names.has(to.body) || !at) continue;
        const angle = triad ? Math.atan2(triad.axes[0][1], triad.axes[0][0]) : base.angle;
        const [x, y] = turned(to.local, angle);
        names.set(to.body, { angle, shift: [at[0] - x, at[1] - y] });
      }
      if (joint.spots.every(({ body }) => names.has(body))) waiting.splice(waiting.indexOf(joint), 1);
    }
  }
  if (joints.some((joint) => joint.spots.some(({ body }) => !names.has(body)))) return null;
  const place = (spot: Spot) => (spot.at = placed(names.get(spot.body) ?? STILL, spot.local));
  for (const joint of joints) {
    joint.spots.forEach(place);
    joint.along += names.get(joint.spots[0].body)!.angle;
  }
  tips.forEach(({ spot }) => place(spot));
  return { root, joints, tips, places: names };
}

function spotOf(model: Model, body: string, at: Node | undefined): Spot | null {
  const [x, y] = at?.entries ?? [];
  if (!x || !y) return null;
  const local: Point = [numberOf(model, x.value), numberOf(model, y.value)];
  return local.every(Number.isFinite) ? { body, nodes: [x.value, y.value], local, at: local } : null;
}

/** A joint of the plane; nothing if it is another. */
function jointOf(model: Model, entry: Entry): Joint | null {
  const node = entry.value;
  const [first, second] = (field(node, "between")?.entries ?? []).map(({ value }) => value.text);
  if (first === undefined || second === undefined) return null;
  const other = field(node, "second");
  const through = field(node, "through")?.entries.map(({ value }) => value);
  if (node.text !== "Distance" && node.text !== "Revolute" && node.text !== "Prismatic") return null;
  const ends = node.text === "Distance" ? through : [field(node, "point"), field(other, "point") ?? field(node, "point")];
  const spots = [spotOf(model, first, ends?.[0]), spotOf(model, second, ends?.[1])];
  if (!spots[0] || !spots[1]) return null;
  const [x, y] = (field(node, "direction")?.entries ?? []).map(({ value }) => directionOf(model, value));
  return {
    name: entry.key, kind: node.text, entry, spots: spots as [Spot, Spot],
    along: node.text === "Prismatic" ? Math.atan2(y ?? 0, x ?? 1) : 0,
    driven: field(node, "role")?.text === "Actuated", follows: field(node, "value") !== undefined, apart: other !== undefined,
  };
}

/** A component of a direction, which has no unit: it is taken as a length. */
function directionOf(model: Model, node: Node): number {
  if (node.kind === "atom") return Number(node.text);
  return numberOf(model, { ...node, text: `(${node.text})*1 m` });
}
