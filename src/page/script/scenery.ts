// What stands beside the mechanism: ghosts of other assemblies, the paths of points, forces, freedoms gained.
import { Vector3 } from "three";
import type { Drawn } from "./designer";
import { Arrows, type Note, screw, type Words } from "./arrows";
import type { Trace } from "./motion";
import { Shapes } from "./shapes";
import { loads } from "./springs";
import { theme } from "./theme";
import type { Scene, Screw, Triple } from "./types";

const v = (t: Triple) => new Vector3(...t);

export class Scenery {
  readonly shapes = new Shapes();
  ghosts: Scene[] = [];
  traces: Trace[] = [];
  screws: Screw[] = [];
  /** The mechanism moved about the screws. */
  swung: Scene[] = [];
  /** A design beside the mechanism. */
  design: Drawn = { points: [], curve: [], ghost: null };
  readonly arrows = new Arrows();
  /** The arrow that shows which way things fall. */
  falling: [Vector3, Vector3] | null = null;
  notes: Note[] = [];

  /** Beside a scene, of which the arrows are drawn with these words. */
  draw(scene: Scene, words: Words, size: number, flat: boolean, raised: (point: Vector3) => Vector3) {
    const { shapes } = this;
    shapes.flat = flat;
    shapes.begin();
    for (const scene of this.ghosts) this.ghost(scene, size, theme().ghost);
    for (const scene of this.swung) this.ghost(scene, size, theme().gained);
    for (const moved of this.screws) screw(shapes, moved, size);
    this.notes = this.arrows.draw(shapes, scene, words, size, raised);
    this.notes.push(...loads(shapes, scene, this.arrows.extent, size, raised));
    if (this.falling) {
      shapes.arrow(...(this.falling.map(raised) as [Vector3, Vector3]), 0.2 * size, theme().acts);
      this.notes.push({ words: "g", at: this.falling[1] });
    }
    const { points, curve, ghost } = this.design;
    if (ghost) this.ghost(ghost, size, theme().ghost);
    this.curve(curve, size);
    points.forEach((at, i) => {
      shapes.ball(raised(v(at)), 0.6 * size, theme().trace);
      this.notes.push({ words: String(i + 1), at: v(at) });
    });
    for (const trace of this.traces) {
      this.curve(trace.points, size);
      for (const { at, words } of trace.marks) {
        shapes.ball(v(at), 0.5 * size, theme().trace);
        this.notes.push({ words, at: v(at) });
      }
    }
    shapes.end();
  }

  private curve(places: Triple[], size: number) {
    const points = places.map(v);
    points.slice(1).forEach((to, i) => this.shapes.cylinder(...between(points[i]!, to, 0.13 * size), theme().trace));
  }

  private ghost(scene: Scene, size: number, colour: string) {
    const lines = [
      ...scene.bodies.filter((body) => !body.ground).flatMap((body) => (body.lines.length ? body.lines : [body.corners])),
      ...scene.rods.map((rod) => rod.ends),
    ];
    for (const line of lines) {
      for (let i = 0; i + 1 < line.length; i++) {
        this.shapes.rod(v(line[i]!), v(line[i + 1]!), 0.2 * size, colour, undefined, 0.55);
      }
    }
  }
}

function between(from: Vector3, to: Vector3, radius: number): [Vector3, Vector3, number, number] {
  const along = to.clone().sub(from);
  const length = along.length();
  const axis = length > 0 ? along.divideScalar(length) : new Vector3(0, 0, 1);
  return [from.clone().addScaledVector(axis, length / 2), axis, radius, length / 2];
}
