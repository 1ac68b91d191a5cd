// A scene as solids: links as bars and plates, joints by the symbols of the field.
import { Vector3 } from "three";
import { hull } from "./hull";
import { across, type Pick, Shapes } from "./shapes";
import { bodyColour, theme } from "./theme";
import type { BodyShape, JointShape, Scene, Triple } from "./types";

const v = (t: Triple) => new Vector3(t[0], t[1], t[2]);

/** Sides of the polygon that is drawn for a circle. */
const RING = 48;

/** The plane of a planar mechanism as it is seen: to the right, up, towards the viewer. */
export interface Plane {
  right: Vector3;
  up: Vector3;
  towards: Vector3;
}

export function planeOf(scene: Scene): Plane | null {
  if (!scene.normal) return null;
  const towards = v(scene.normal).normalize();
  const up = Math.abs(towards.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(0, 1, 0);
  up.addScaledVector(towards, -up.dot(towards)).normalize();
  let right = up.clone().cross(towards);
  const largest = [right.x, right.y, right.z].reduce((a, b) => (Math.abs(b) > Math.abs(a) + 1e-9 ? b : a));
  if (largest < 0) {
    towards.negate();
    right = right.negate();
  }
  return { right, up, towards };
}

/** Every point from which something is drawn. */
export function points(scene: Scene): Vector3[] {
  const bodies = scene.bodies.flatMap((body) => [...body.lines.flat(), ...body.corners]);
  const joints = scene.joints.map((joint) => joint.at);
  const wheels = (scene.wheels ?? []).flatMap(({ at, axis, radius }) => {
    const right = across(v(axis)).multiplyScalar(radius);
    const up = v(axis).cross(right);
    return [right, up, right.clone().negate(), up.clone().negate()].map((rim) => rim.add(v(at)));
  });
  const acting = [...(scene.springs ?? []).flatMap((of) => of.ends), ...(scene.weights ?? []).map((of) => of.at)];
  return [...[...bodies, ...scene.rods.flatMap((rod) => rod.ends), ...joints, ...acting].map(v), ...wheels];
}

/** Sine of the angle below the horizontal from which on a link hangs from its pin on ground. */
const HANGS = 0.35;

/** Half the length of a guide, in sizes of joints. */
const GUIDE = 3.5;

/** The ends of the guides of slides. */
export function guides(scene: Scene, size: number): Vector3[] {
  const slides = scene.joints.filter((joint) => joint.kind === "prismatic" || joint.kind === "cylindrical");
  return slides.flatMap(({ at, axes }) => [-GUIDE, GUIDE].map((part) => v(at).addScaledVector(v(axes[0]!).normalize(), part * size)));
}

/** How large a joint is drawn: as its neighbours leave room for, within what can be seen and hides no links. */
export function jointSize(scene: Scene, extent: number): number {
  let room = Infinity;
  const places = scene.joints.map((joint) => v(joint.at));
  for (const [i, a] of places.entries()) {
    for (const b of places.slice(i + 1)) {
      const apart = a.distanceTo(b);
      if (apart > 0.008 * extent) room = Math.min(room, apart);
    }
  }
  return Math.min(Math.max(0.3 * room, 0.009 * extent), 0.018 * extent);
}

export class Drawing {
  readonly shapes = new Shapes();
  plane: Plane | null = null;
  size = 1;
  /** Named coordinates whose joints are filled. */
  held = new Set<string>();

  draw(scene: Scene) {
    const { shapes } = this;
    shapes.begin();
    scene.bodies.forEach((body, i) => this.body(scene, body, i));
    scene.rods.forEach((rod, i) => {
      const [from, to] = [v(rod.ends[0]), v(rod.ends[1])];
      if (rod.driven) this.cylinder(from, to, theme().driven, { rod: i });
      else shapes.rod(from, to, 0.25 * this.size, theme().ink, { rod: i });
      [from, to].forEach((end, k) => {
        if (scene.bodies[rod.bodies[k]!]?.ground) this.pinned(end, k ? from : to);
        shapes.ball(this.above(end, 2), 0.6 * this.size, theme().ink, { rod: i });
      });
    });
    scene.joints.forEach((joint, i) => this.joint(scene, joint, i));
    for (const wheel of scene.wheels ?? []) this.ring(v(wheel.at), v(wheel.axis), wheel.radius, bodyColour(wheel.body), { body: wheel.body });
    shapes.end();
  }

  /** In the plane, what is of a higher layer covers what is of a lower one. */
  above(point: Vector3, layer: number): Vector3 {
    return this.plane ? point.clone().addScaledVector(this.plane.towards, 3 * layer * this.size) : point;
  }

  private body(scene: Scene, body: BodyShape, index: number) {
    const { shapes, size } = this;
    const pick = { body: index };
    const colour = body.ground ? theme().ground : bodyColour(index);
    // in space the base is a body too; a plane shows ground where it is
    const corners = body.ground && this.plane ? [] : outline(body.corners.map(v));
    if (corners.length > 2) {
      shapes.plate(corners, colour, body.ground ? 0.16 : 0.4, pick);
      corners.forEach((corner, i) => shapes.rod(corner, corners[(i + 1) % corners.length]!, (body.ground ? 0.1 : 0.18) * size, colour, pick));
    } else if (body.ground && !this.plane && body.lines.length === 0) this.along(body, 0.18 * size, colour, pick);
    const [barrel, piston] = [0, 1].map((end) => !this.plane && scene.joints.some((joint) =>
      joint.kind === "prismatic" && joint.bodies[end] === index && joint.bodies.every((of) => !scene.bodies[of]?.ground)));
    const radius = (body.ground ? 0.18 : barrel ? 0.6 : piston ? 0.26 : 0.36) * size;
    for (const line of body.lines) {
      for (let i = 0; i + 1 < line.length; i++) shapes.rod(v(line[i]!), v(line[i + 1]!), radius, colour, pick);
    }
    // a platform has no lines of a table: its corners are all that is known of it
    if (!body.ground && corners.length <= 2 && body.lines.length === 0) this.along(body, radius, colour, pick);
  }

  /** A bar from corner to corner of a body. */
  private along(body: BodyShape, radius: number, colour: string, pick: Pick) {
    const ends = body.corners.map(v);
    for (let i = 0; i + 1 < ends.length; i++) this.shapes.rod(ends[i]!, ends[i + 1]!, radius, colour, pick);
  }

  private joint(scene: Scene, joint: JointShape, index: number) {
    const { shapes, plane } = this;
    const pick = { joint: index };
    const held = joint.names.some((name) => this.held.has(name));
    // one that is held is seen where another stands in the same place
    const size = (held ? 1.06 : 1) * this.size;
    const fixed = joint.bodies.some((body) => scene.bodies[body]?.ground);
    const free = plane ? theme().joint : theme().solid;
    const colour = held ? theme().driven : free;
    const at = this.above(v(joint.at), 2);
    const moving = fixed ? this.awayFrom(scene, joint) : null;
    const axis = (k: number) => v(joint.axes[k] ?? [0, 0, 1]).normalize();
    const facing = plane && Math.abs(plane.towards.dot(axis(0))) > 1 - 1e-9;
    const rim = (radius: number) => plane && shapes.ball(this.above(v(joint.at), 1), radius, theme().ink, pick);
    switch (joint.kind) {
      case "revolute":
      case "helical":
        if (plane && facing) {
          if (fixed) this.support(v(joint.at), moving);
          rim(0.95 * size);
          shapes.ball(at, 0.72 * size, colour, pick);
        } else {
          if (fixed) this.bearing(at, axis(0), moving);
          shapes.cylinder(at, axis(0), 0.75 * size, 1.1 * size, colour, pick);
        }
        break;
      case "cylindrical":
        this.guide(v(joint.at), axis(0), fixed);
        shapes.cylinder(at, axis(0), 0.75 * size, 1.4 * size, colour, pick);
        break;
      case "prismatic":
        if (!plane && !fixed) {
          shapes.cylinder(at, axis(0), 0.85 * size, 0.5 * size, colour, pick);
          break;
        }
        this.guide(v(joint.at), axis(0), fixed);
        if (plane) shapes.box(this.above(v(joint.at), 1), axis(0), [0.95 * size, 0.95 * size, 1.55 * size], theme().ink, pick, plane.towards);
        shapes.box(at, axis(0), [0.75 * size, 0.75 * size, 1.35 * size], colour, pick, plane?.towards);
        break;
      case "universal":
        if (fixed) this.bearing(at, axis(0), moving);
        for (const k of [0, 1]) shapes.cylinder(at, axis(k), 0.35 * size, 1.2 * size, colour, pick);
        break;
      case "spherical":
        if (fixed) this.pinned(v(joint.at), moving);
        rim(0.95 * size);
        shapes.ball(at, (plane ? 0.72 : 0.9) * size, colour, pick);
        break;
      case "planar":
        shapes.box(at, axis(0), [1.5 * size, 1.5 * size, 0.3 * size], colour, pick);
        break;
      case "rigid":
        break;
    }
  }

  /** A circle about an axis. */
  private ring(at: Vector3, axis: Vector3, radius: number, colour: string, pick: { body: number }) {
    const right = across(axis);
    const up = axis.clone().cross(right);
    const place = (k: number) => {
      const angle = (k / RING) * 2 * Math.PI;
      return at.clone().addScaledVector(right, radius * Math.cos(angle)).addScaledVector(up, radius * Math.sin(angle));
    };
    for (let k = 0; k < RING; k++) this.shapes.rod(place(k), place(k + 1), 0.14 * this.size, colour, pick);
  }

  /** The line along which a slide moves, hatched where it is fixed to ground. */
  private guide(at: Vector3, axis: Vector3, fixed: boolean) {
    const [from, to] = [-GUIDE, GUIDE].map((part) => at.clone().addScaledVector(axis, part * this.size));
    const colour = fixed ? theme().ground : theme().ink;
    this.shapes.rod(from!, to!, 0.12 * this.size, colour);
    if (fixed && this.plane) this.hatch(at, axis, axis.clone().cross(this.plane.towards), GUIDE);
  }

  /** A pin on ground: a triangle on a hatched line, below the pin, or above it where what it carries hangs down. */
  private support(at: Vector3, towards: Vector3 | null) {
    const { plane, size, shapes } = this;
    if (!plane) return;
    const way = towards?.clone().sub(at) ?? plane.up;
    const up = plane.up.clone().multiplyScalar(way.dot(plane.up) < -HANGS * way.length() ? -1 : 1);
    const foot = (x: number) => at.clone().addScaledVector(plane.right, x * size).addScaledVector(up, -2.1 * size);
    shapes.plate([at, foot(-1.2), foot(1.2)].map((p) => p.addScaledVector(plane.towards, 0.8 * size)), theme().plate, 1);
    const corners = [at, foot(-1.2), foot(1.2)];
    corners.forEach((corner, i) => shapes.rod(corner, corners[(i + 1) % 3]!, 0.1 * size, theme().ground));
    shapes.rod(foot(-1.8), foot(1.8), 0.12 * size, theme().ground);
    this.hatch(foot(0), plane.right, up.negate(), 1.8);
  }

  /** Short strokes along a line, on the side of the ground. */
  private hatch(at: Vector3, along: Vector3, into: Vector3, half: number) {
    const { size } = this;
    for (let x = -half; x <= half - 0.3; x += 0.6) {
      const from = at.clone().addScaledVector(along, (x + 0.5) * size);
      const to = at.clone().addScaledVector(along, x * size).addScaledVector(into, 0.6 * size);
      this.shapes.rod(from, to, 0.06 * size, theme().ground);
    }
  }

  /** A cylinder and its piston rod between two places. */
  private cylinder(from: Vector3, to: Vector3, colour: string, pick: Pick) {
    const { shapes, size } = this;
    const end = from.clone().lerp(to, 0.58);
    const way = to.clone().sub(from);
    const length = way.length();
    if (!(length > 1e-9 * size)) return;
    shapes.rod(from, to, 0.24 * size, theme().ink, pick);
    const wall = Math.min(0.62 * size, 0.2 * length);
    const begin = from.clone().lerp(to, Math.min(0.12, (1.2 * size) / length));
    shapes.cylinder(begin.clone().lerp(end, 0.5), way.divideScalar(length), wall, begin.distanceTo(end) / 2, colour, pick);
  }

  /** A ball or a rod's end on ground, seen from where it leads to. */
  private pinned(at: Vector3, towards: Vector3 | null) {
    if (this.plane) return this.support(at, towards);
    const up = towards?.clone().sub(at).z ?? 1;
    this.foot(at, new Vector3(0, 0, up < 0 ? -1 : 1));
  }

  /** The middle of what a joint on ground moves, with others in its place; none if they move nothing that is drawn. */
  private awayFrom(scene: Scene, joint: JointShape): Vector3 | null {
    const here = scene.joints.filter((of) => v(of.at).distanceTo(v(joint.at)) < 0.1 * this.size);
    const moved = new Set(here.flatMap((of) => of.bodies).filter((body) => !scene.bodies[body]?.ground).map((body) => scene.bodies[body]!));
    const all = [...moved].flatMap((body) => [...body.lines.flat(), ...body.corners]).map(v).filter((p) => p.distanceTo(v(joint.at)) > 0.5 * this.size);
    return all.length ? all.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(all.length) : null;
  }

  /** A bearing block: under a level axis, with a cheek at either end, on the side away from the link; round an upright one. */
  private bearing(at: Vector3, axis: Vector3, link: Vector3 | null) {
    const { shapes, size } = this;
    const across = (way: Vector3) => way.clone().addScaledVector(axis, -way.dot(axis));
    const down = across(new Vector3(0, 0, -1));
    const away = link ? across(at.clone().sub(link)).normalize() : new Vector3();
    const side = down.clone().addScaledVector(away, 0.8);
    if (down.length() < 0.4 || side.length() < 0.2) {
      const behind = link ? -Math.sign(link.clone().sub(at).dot(axis)) || -1 : -1;
      const upright = axis.clone().multiplyScalar(-behind);
      return this.foot(at, upright);
    }
    side.normalize();
    const place = at.clone().addScaledVector(side, 1.35 * size);
    shapes.box(place, side, [1.2 * size, 1.75 * size, 0.13 * size], theme().plate, undefined, axis);
    for (const end of [-1, 1]) {
      const cheek = at.clone().addScaledVector(axis, 1.35 * end * size).addScaledVector(side, 0.55 * size);
      shapes.box(cheek, side, [0.7 * size, 0.16 * size, 0.8 * size], theme().plate, undefined, axis);
    }
  }

  /** A square of ground under a spatial joint, which stands on it along a direction. */
  private foot(at: Vector3, up: Vector3) {
    const place = at.clone().addScaledVector(up, -1.3 * this.size);
    this.shapes.box(place, up, [1.5 * this.size, 1.5 * this.size, 0.12 * this.size], theme().plate);
    this.shapes.cylinder(at.clone().addScaledVector(up, -0.7 * this.size), up, 0.4 * this.size, 0.6 * this.size, theme().plate);
  }
}

/** Corners of the convex hull of points near a plane, in order; none if they are on a line. */
function outline(points: Vector3[]): Vector3[] {
  if (points.length < 3) return [];
  const middle = points.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(points.length);
  const first = points.reduce((far, p) => (p.distanceTo(middle) > far.distanceTo(middle) ? p : far)).clone().sub(middle);
  const normals = points.map((p) => first.clone().cross(p.clone().sub(middle)));
  const normal = normals.reduce((far, n) => (n.length() > far.length() ? n : far));
  if (normal.length() < 1e-6 * first.lengthSq()) return [];
  const right = first.normalize();
  const up = normal.normalize().clone().cross(right);
  return hull(points.map((p) => [p.dot(right), p.dot(up)])).map((i) => points[i]!);
}
