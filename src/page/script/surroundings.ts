// What stands about a mechanism in space: the plane of ground with its grid and shadows, the axes of ground.
import { BufferAttribute, BufferGeometry, Group, LineBasicMaterial, LineSegments, Vector3 } from "three";
import { Shapes } from "./shapes";
import type { Note } from "./arrows";
import { theme } from "./theme";
import type { Scene, Triple } from "./types";

const v = (t: Triple) => new Vector3(...t);

/** Colours of x, y and z. */
const AXES = ["#c63a3a", "#2f8f3f", "#3567c9"];

export class Surroundings {
  readonly group = new Group();
  private readonly shapes = new Shapes();
  private readonly lines = new LineSegments(new BufferGeometry(), new LineBasicMaterial({ transparent: true, opacity: 0.45 }));
  /** x, y and z beside their axes. */
  notes: Note[] = [];
  /** Of the plane, so that it does not jump as the mechanism moves. */
  private level: { z: number; step: number; middle: [number, number]; half: number } | null = null;

  constructor() {
    this.shapes.flat = true;
    this.lines.frustumCulled = false;
    this.group.add(this.lines, this.shapes.group);
  }

  /** Another mechanism has another plane. */
  forget() {
    this.level = null;
  }

  /** About a scene of so large an extent; nothing where a plane is seen from its front. */
  draw(scene: Scene, extent: number, size: number, inPlane: boolean) {
    this.group.visible = !inPlane;
    this.notes = [];
    if (inPlane) return;
    const level = (this.level ??= this.levelOf(scene, extent));
    this.grid(level);
    const { shapes } = this;
    shapes.begin();
    this.shadows(scene, level.z, size);
    // at the origin, or at a corner of the grid if that is elsewhere
    const off = Math.max(...level.middle.map(Math.abs));
    const corner = off <= level.half && Math.abs(level.z) < extent ? new Vector3() : new Vector3(level.middle[0] - level.half, level.middle[1] - level.half, level.z);
    [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)].forEach((axis, i) => {
      const tip = corner.clone().addScaledVector(axis, 0.13 * extent);
      shapes.arrow(corner, tip, 0.12 * size, AXES[i]!);
      this.notes.push({ words: "xyz"[i]!, at: tip });
    });
    shapes.end();
  }

  private levelOf(scene: Scene, extent: number) {
    const ground = scene.bodies.filter((body) => body.ground).flatMap((body) => [...body.lines.flat(), ...body.corners]);
    const all = scene.bodies.flatMap((body) => [...body.lines.flat(), ...body.corners]);
    const z = Math.min(...(ground.length ? ground : all).map((p) => p[2])) - 0.02 * extent;
    const step = [1, 2, 5, 10].map((part) => part * 10 ** Math.floor(Math.log10(extent / 10))).find((step) => step >= extent / 12)!;
    const range = (axis: 0 | 1): [number, number] => [Math.min(...all.map((p) => p[axis])), Math.max(...all.map((p) => p[axis]))];
    const [x, y] = [range(0), range(1)];
    const half = step * Math.ceil((0.5 * Math.max(x[1] - x[0], y[1] - y[0], 0.3 * extent)) / step + 0.6);
    const middle: [number, number] = [step * Math.round((x[0] + x[1]) / 2 / step), step * Math.round((y[0] + y[1]) / 2 / step)];
    return { z, step, middle, half };
  }

  private grid({ z, step, middle: [x, y], half }: NonNullable<Surroundings["level"]>) {
    const ends: number[] = [];
    for (let s = -half; s <= half + 1e-9 * half; s += step) {
      ends.push(x + s, y - half, z, x + s, y + half, z, x - half, y + s, z, x + half, y + s, z);
    }
    this.lines.geometry.setAttribute("position", new BufferAttribute(new Float32Array(ends), 3));
    (this.lines.material as LineBasicMaterial).color.set(theme().plate);
  }

  /** Of what is above the plane, as if lit from straight above. */
  private shadows(scene: Scene, z: number, size: number) {
    const lines = [
      ...scene.bodies.filter((body) => !body.ground).flatMap((body) => (body.lines.length ? body.lines : [[...body.corners, ...body.corners.slice(0, 1)]])),
      ...scene.rods.map((rod) => rod.ends as Triple[]),
    ];
    for (const line of lines) {
      for (let i = 0; i + 1 < line.length; i++) {
        const [a, b] = [v(line[i]!), v(line[i + 1]!)];
        if (Math.min(a.z, b.z) < z - 0.5 * size) continue;
        a.z = b.z = z;
        const along = b.clone().sub(a);
        const length = along.length();
        if (length < 0.1 * size) continue;
        this.shapes.shadow(a.lerp(b, 0.5), along.divideScalar(length), length / 2, 0.5 * size);
      }
    }
  }
}
