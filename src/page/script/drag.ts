// Bodies follow the pointer as far as what is held lets them.
import { Vector3 } from "three";
import type { Model } from "./model";
import type { Stage } from "./stage";
import { Refused, type Scene, type Triple } from "./types";

interface Grabbed {
  pointer: number;
  body: number;
  offset: Triple;
  at: Vector3;
}

/** The body that a pointer meets; of a joint the one that moves. */
function bodyOf(scene: Scene, pick: { body?: number; joint?: number }): number | null {
  if (pick.joint !== undefined) {
    const [first, second] = scene.joints[pick.joint]!.bodies;
    return scene.bodies[second]?.ground ? first : second;
  }
  return pick.body ?? null;
}

export function dragging(stage: Stage, model: Model, point: (name: string) => void) {
  let grabbed: Grabbed | null = null;
  let waiting: { clientX: number; clientY: number } | null = null;
  const canvas = stage.canvas;

  const pull = () => {
    if (!grabbed || !waiting) return;
    const to = stage.place(waiting, grabbed.at);
    waiting = null;
    const sight = stage.camera.getWorldDirection(new Vector3()).toArray() as Triple;
    const { body, offset } = grabbed;
    // two steps of least squares for each picture: the second corrects what the first bends away
    for (let i = 0; i < 2; i++) model.change({ do: "pull", body, offset, to: to.toArray() as Triple, sight });
  };

  /** The body under a pointer, if it can be moved. */
  const held = (event: PointerEvent) => {
    const { frame } = model;
    if (!frame?.assembled || !frame.held?.length) return null;
    const hit = stage.hit(event);
    const body = hit && bodyOf(frame.scene, hit.pick);
    return hit && body !== null && !frame.scene.bodies[body]?.ground ? { hit, body } : null;
  };

  canvas.addEventListener("pointerdown", (event) => {
    const found = event.button === 0 ? held(event) : null;
    if (!found) return;
    const { body, hit } = found;
    try {
      const at = hit.at.toArray() as Triple;
      const { offset, name } = model.ask<{ offset: Triple; name: string }>({ do: "grab", body, at });
      grabbed = { pointer: event.pointerId, body, offset, at: hit.at };
      point(name);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      return;
    }
    canvas.classList.add("dragging");
    canvas.setPointerCapture(event.pointerId);
    stage.orbit.enabled = false;
    event.stopImmediatePropagation();
  }, { capture: true });

  canvas.addEventListener("pointermove", (event) => {
    if (!grabbed && event.buttons === 0) canvas.classList.toggle("over", held(event) !== null);
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
