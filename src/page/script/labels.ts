// Names of joints, rods and platforms beside them, none over another.
import { Vector3 } from "three";
import { element, find } from "./elements";
import type { Note } from "./arrows";
import type { Stage } from "./stage";
import type { JointShape, Scene, Triple } from "./types";

const v = (t: Triple) => new Vector3(...t);

function names(scene: Scene): Note[] {
  // a hinge on two bearings has one label
  const same = (a: JointShape, b: JointShape) => `${a.names}|${a.bodies}` === `${b.names}|${b.bodies}`;
  const first = scene.joints.filter((joint, i) => !scene.joints.slice(0, i).some((of) => same(of, joint)));
  const joints = first.filter((joint) => joint.kind !== "rigid").map((joint) => ({ words: joint.names.join(", "), at: v(joint.at) }));
  const rods = scene.rods.map((rod) => ({ words: rod.name, at: v(rod.ends[0]).lerp(v(rod.ends[1]), 0.5) }));
  const platforms = scene.bodies.filter((body) => body.platform && body.corners.length > 0).map((body) => {
    const middle = body.corners.reduce((sum, corner) => sum.add(v(corner)), new Vector3());
    return { words: body.name, at: middle.divideScalar(body.corners.length) };
  });
  return [...joints, ...rods, ...platforms];
}

export class Labels {
  shown = false;
  private spans: HTMLSpanElement[] = [];

  /** Notes first, then names if they are shown. */
  place(stage: Stage, scene: Scene | null, notes: Note[], size: number) {
    const layer = find("labels");
    const wanted = [...notes, ...(this.shown && scene ? names(scene) : [])];
    if (this.spans.length !== wanted.length) {
      this.spans = wanted.map(() => element("span"));
      layer.replaceChildren(...this.spans);
    }
    const taken: DOMRect[] = [];
    // below the buttons
    const [above] = stage.covered();
    const picture = new DOMRect(0, above, stage.canvas.clientWidth, stage.canvas.clientHeight - above);
    // beside the symbols of joints, not over them
    const things = this.shown && scene ? seen(stage, scene) : { pins: [], lines: [] };
    const off = Math.max(8, 1.3 * size * stage.pixelsPerMetre());
    wanted.forEach(({ words, at }, i) => {
      const span = this.spans[i]!;
      if (span.textContent !== words) span.textContent = words;
      const [x, y] = stage.pixel(at);
      const [width, height] = [6.6 * words.length + 2, 15];
      const sides: [number, number][] = [
        [off, -height - 3], [off, 3], [-width - off, -height - 3], [-width - off, 3], [-width / 2, -height - off - 4],
        [-width / 2, off + 4], [off + 4, -2 * height - 6], [-width - off - 4, height + 8], [off + 4, height + 8],
      ];
      const boxes = sides.map(([dx, dy]) => new DOMRect(x + dx, y + dy, width, height));
      const fits = boxes.filter((box) => within(box, picture) && taken.every((other) => apart(box, other)));
      const clear = fits.map((box) => ({ box, hidden: covered(box, things) }));
      const free = clear.reduce<{ box: DOMRect; hidden: number } | null>((best, of) => (best && best.hidden <= of.hidden ? best : of), null)?.box;
      span.hidden = !free;
      if (!free) return;
      taken.push(free);
      span.style.transform = `translate(${free.x}px, ${free.y}px)`;
    });
  }
}

/** Pins and lines of a scene in pixels. */
interface Things {
  pins: [number, number][];
  lines: [[number, number], [number, number]][];
}

function seen(stage: Stage, scene: Scene): Things {
  const pixel = (t: Triple) => stage.pixel(v(t));
  const lines = [...scene.bodies.filter((body) => !body.ground).flatMap((body) => body.lines), ...scene.rods.map((rod) => rod.ends)];
  return {
    pins: scene.joints.map((joint) => pixel(joint.at)),
    lines: lines.flatMap((line) => line.slice(1).map((to, i): [[number, number], [number, number]] => [pixel(line[i]!), pixel(to)])),
  };
}

/** How many pins and lines a box would hide; a pin counts more. */
function covered(box: DOMRect, { pins, lines }: Things): number {
  const near = new DOMRect(box.x - 5, box.y - 5, box.width + 10, box.height + 10);
  const inside = ([x, y]: [number, number], of: DOMRect) => x > of.left && x < of.right && y > of.top && y < of.bottom;
  const crossed = lines.filter(([a, b]) => Array.from({ length: 17 }, (_, i) => i / 16).some((t) => inside([a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])], box)));
  return 3 * pins.filter((pin) => inside(pin, near)).length + crossed.length;
}

const within = (a: DOMRect, b: DOMRect) => a.left >= b.left && a.right <= b.right && a.top >= b.top && a.bottom <= b.bottom;

export const apart = (a: DOMRect, b: DOMRect) =>
  a.right < b.left || b.right < a.left || a.bottom < b.top || b.bottom < a.top;
