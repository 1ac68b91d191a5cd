// Forces and screws beside the mechanism, and the figures that stand at them.
import { Vector3 } from "three";
import { across, type Shapes } from "./shapes";
import { theme } from "./theme";
import type { Arrow, Scene, Screw, Triple } from "./types";

const v = (t: Triple) => new Vector3(...t);

/** Of the extent of a mechanism, no arrow is longer. */
const LONGEST = 0.45;

/** Parts of the largest force that are not seen. */
const SMALL = 1e-6;

/** Words that stand at a place of the picture. */
export interface Note {
  words: string;
  at: Vector3;
}

/** Beside each arrow of a scene: its force, and its moment. */
export interface Words {
  arrows: string[];
  moments: string[];
}

export class Arrows {
  /** Metres for a newton. */
  scale = 1;
  /** Of the mechanism, in m. */
  extent = 1;

  /** Makes a force a fifth as long as the mechanism is large. */
  fit(force: Triple) {
    const size = v(force).length();
    if (size > 0) this.scale = (0.2 * this.extent) / size;
  }

  /** The tip of an arrow; of what is too long the direction is right. */
  tip(arrow: Arrow): Vector3 {
    const force = v(arrow.force);
    const longest = LONGEST * this.extent;
    return v(arrow.at).addScaledVector(force, Math.min(this.scale, longest / Math.max(force.length(), 1e-300)));
  }

  /** The force whose tip is there. */
  force(arrow: Arrow, tip: Vector3): Triple {
    return tip.clone().sub(v(arrow.at)).divideScalar(this.scale).toArray() as Triple;
  }

  /** Draws the forces of a scene, raised towards the viewer; what they are is in `words`. */
  draw(shapes: Shapes, scene: Scene, words: Words, size: number, raised: (point: Vector3) => Vector3): Note[] {
    const arrows = scene.arrows ?? [];
    const most = (of: (arrow: Arrow) => Triple) => Math.max(0, ...arrows.map((arrow) => v(of(arrow)).length()));
    const [largest, turning] = [most((arrow) => arrow.force), most((arrow) => arrow.moment)];
    return arrows.flatMap((arrow, i) => {
      const moments = moment(shapes, arrow, turning, words.moments[i] ?? "", size, raised);
      if (!(v(arrow.force).length() > SMALL * largest)) return moments;
      const tip = this.tip(arrow);
      const colour = arrow.applied ? theme().load : theme().reaction;
      shapes.arrow(raised(v(arrow.at)), raised(tip), 0.2 * size, colour, arrow.applied ? { arrow: i } : undefined);
      // to be taken hold of
      if (arrow.applied) shapes.ball(raised(tip), 0.6 * size, colour, { arrow: i });
      return [{ words: words.arrows[i] ?? "", at: tip }, ...moments];
    });
  }
}

/** A moment as an arc about its axis, the larger the larger it is; nothing where it is small beside the `largest`. */
function moment(shapes: Shapes, arrow: Arrow, largest: number, words: string, size: number, raised: (point: Vector3) => Vector3): Note[] {
  const axis = v(arrow.moment);
  const part = axis.length() / largest;
  if (!(part > SMALL)) return [];
  const colour = arrow.applied ? theme().load : theme().reaction;
  return [{ words, at: arc(shapes, raised(v(arrow.at)), axis.normalize(), (2 + 1.4 * part) * size, 0.16 * size, colour) }];
}

/** Three quarters of a circle about an axis with a head at its end; returns a place of it. */
function arc(shapes: Shapes, middle: Vector3, axis: Vector3, radius: number, thick: number, colour: string): Vector3 {
  const right = across(axis);
  const up = axis.clone().cross(right);
  const place = (k: number) => {
    const angle = (1.5 * Math.PI * k) / 24;
    return middle.clone().addScaledVector(right, radius * Math.cos(angle)).addScaledVector(up, radius * Math.sin(angle));
  };
  for (let k = 0; k < 22; k++) shapes.rod(place(k), place(k + 1), 0.8 * thick, colour);
  shapes.arrow(place(22), place(24), thick, colour);
  return place(8);
}

/** A screw as its axis with an arrow for the sense and a ring for the turn. */
export function screw(shapes: Shapes, { at, along, pitch }: Screw, size: number) {
  const [axis, middle] = [v(along), v(at)];
  const half = axis.clone().multiplyScalar(8 * size);
  shapes.arrow(middle.clone().sub(half), middle.clone().add(half), 0.13 * size, theme().gained);
  if (pitch !== null) arc(shapes, middle, axis, 2.4 * size, 0.16 * size, theme().gained);
}
