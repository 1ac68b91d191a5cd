// Names of joints, rods and platforms beside them, none over another.
import { Vector3 } from "three";
import { element, find } from "./elements";
import type { Stage } from "./stage";
import type { Scene, Triple } from "./types";

interface Named {
  name: string;
  at: Vector3;
}

const v = (t: Triple) => new Vector3(...t);

function names(scene: Scene): Named[] {
  const joints = scene.joints.filter((joint) => joint.kind !== "rigid").map((joint) => ({ name: joint.names.join(", "), at: v(joint.at) }));
  const rods = scene.rods.map((rod) => ({ name: rod.name, at: v(rod.ends[0]).lerp(v(rod.ends[1]), 0.5) }));
  const platforms = scene.bodies.filter((body) => body.platform && body.corners.length > 0).map((body) => {
    const middle = body.corners.reduce((sum, corner) => sum.add(v(corner)), new Vector3());
    return { name: body.name, at: middle.divideScalar(body.corners.length) };
  });
  return [...joints, ...rods, ...platforms];
}

export class Labels {
  shown = false;
  private spans: HTMLSpanElement[] = [];

  place(stage: Stage, scene: Scene | null) {
    const layer = find("labels");
    if (!this.shown || !scene) {
      layer.replaceChildren();
      this.spans = [];
      return;
    }
    const wanted = names(scene);
    if (this.spans.length !== wanted.length) {
      this.spans = wanted.map(() => element("span"));
      layer.replaceChildren(...this.spans);
    }
    const taken: DOMRect[] = [];
    wanted.forEach(({ name, at }, i) => {
      const span = this.spans[i]!;
      if (span.textContent !== name) span.textContent = name;
      const [x, y] = stage.pixel(at);
      const [width, height] = [6.6 * name.length + 2, 15];
      const sides: [number, number][] = [
        [10, -height - 4], [10, 6], [-width - 10, -height - 4], [-width - 10, 6], [-width / 2, -height - 14], [-width / 2, 14],
        [14, -2 * height - 6], [-width - 14, height + 8],
      ];
      const boxes = sides.map(([dx, dy]) => new DOMRect(x + dx, y + dy, width, height));
      const free = boxes.find((box) => taken.every((other) => apart(box, other)));
      span.hidden = !free;
      if (!free) return;
      taken.push(free);
      span.style.transform = `translate(${free.x}px, ${free.y}px)`;
    });
  }
}

const apart = (a: DOMRect, b: DOMRect) =>
  a.right < b.left || b.right < a.left || a.bottom < b.top || b.bottom < a.top;
