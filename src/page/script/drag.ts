// Bodies and rods follow the pointer as far as what is held lets them; a load follows it at its tip.
import { Vector3 } from "three";
import type { Model } from "./model";
import type { Pick } from "./shapes";
import type { Stage } from "./stage";
import { Refused, type Grip, type Hold, type Scene, type Triple } from "./types";

interface Grabbed {
  pointer: number;
  at: Vector3;
  /** Takes it to a place, as seen along a direction. */
  take(to: Triple, sight: Triple): void;
}

/** What a click on a body is for, if not to move it. */
export interface Aim {
  /** Whether it was of use. */
  clicked(point: string): boolean;
  /** Takes the tip of the load to a place; nothing if no tip is there. */
  tip(pick: Pick): ((to: Triple) => void) | null;
}

/** The body or rod that a pointer meets; of a joint the body that moves. */
function partOf(scene: Scene, { body, joint, rod }: Pick): { body: number } | { rod: number } | null {
  if (rod !== undefined) return { rod };
  if (joint !== undefined) {
    const [first, second] = scene.joints[joint]!.bodies;
    body = scene.bodies[second]?.ground ? first : second;
  }
  return body === undefined || scene.bodies[body]?.ground ? null : { body };
}

export function dragging(stage: Stage, model: Model, aim: Aim, point: (name: string) => void) {
  let grabbed: Grabbed | null = null;
  let waiting: { clientX: number; clientY: number } | null = null;
  const canvas = stage.canvas;

  const pull = () => {
    if (!grabbed || !waiting) return;
    const to = stage.place(waiting, grabbed.at);
    waiting = null;
    const sight = stage.camera.getWorldDirection(new Vector3()).toArray() as Triple;
    grabbed.take(to.toArray() as Triple, sight);
  };

  /** A part takes two steps of least squares for each picture: the second corrects what the first bends away. */
  const pulled = (grip: Hold[]) => (to: Triple, sight: Triple) => {
    for (let i = 0; i < 2; i++) model.change({ do: "pull", grip, to, sight });
  };

  /** What is under a pointer, if it can be moved. */
  const under = (event: PointerEvent) => {
    const { frame } = model;
    if (!frame?.assembled) return null;
    // the base can be seen through
    for (const { at, pick } of stage.hits(event)) {
      const tip = aim.tip(pick);
      const part = partOf(frame.scene, pick);
      if (tip || part) return { at, tip, part };
    }
    return null;
  };

  /** Takes hold of a part, unless the click was for something else; nothing if the part cannot be moved. */
  const grab = (part: { body: number } | { rod: number }, at: Vector3): Grabbed["take"] | "clicked" | null => {
    const { grip, name } = model.ask<Grip>({ do: "grab", ...part, at: at.toArray() as Triple });
    if (name !== null) {
      if (aim.clicked(name)) return "clicked";
      point(name);
    }
    return model.frame?.held?.length ? pulled(grip) : null;
  };

  canvas.addEventListener("pointerdown", (event) => {
    const found = event.button === 0 ? under(event) : null;
    if (!found) return;
    try {
      const take = found.tip ?? (found.part && grab(found.part, found.at));
      if (!take) return;
      event.stopImmediatePropagation();
      if (take === "clicked") return;
      grabbed = { pointer: event.pointerId, at: found.at, take };
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return;
    }
    canvas.classList.add("dragging");
    canvas.setPointerCapture(event.pointerId);
    stage.orbit.enabled = false;
  }, { capture: true });

  canvas.addEventListener("pointermove", (event) => {
    if (!grabbed && event.buttons === 0) canvas.classList.toggle("over", under(event) !== null);
    if (grabbed?.pointer !== event.pointerId) return;
    if (!waiting) requestAnimationFrame(pull);
    waiting = { clientX: event.clientX, clientY: event.clientY };
  });

  const drop = (event: PointerEvent) => {
    if (grabbed?.pointer !== event.pointerId) return;
    pull();
    grabbed = null;
    canvas.classList.remove("dragging");
    stage.orbit.enabled = true;
  };
  canvas.addEventListener("pointerup", drop);
  canvas.addEventListener("pointercancel", drop);
}
