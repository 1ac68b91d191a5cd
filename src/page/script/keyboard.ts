// The picture by keyboard: a held coordinate is chosen and moved, the view is changed.
import type { Model } from "./model";
import type { Stage } from "./stage";

/** How far one press turns the view, in rad. */
const TURN = Math.PI / 24;

/** Parts of a range that one press moves, alone and with Shift. */
const [FINE, COARSE] = [1 / 360, 1 / 36];

export function keyboard(
  stage: Stage, model: Model, say: (words: string) => void, look: (view: number) => void,
) {
  const { canvas } = stage;
  let chosen = 0;
  const move = (sign: number, part: number) => {
    const { frame, mechanism } = model;
    const name = frame?.held?.[chosen];
    const index = mechanism?.coordinates.findIndex((of) => of.name === name) ?? -1;
    if (!frame || !mechanism || name === undefined || index < 0) return;
    const [low, high] = mechanism.coordinates[index]!.range;
    model.move(name, frame.values[index]![0] + sign * part * (high - low));
  };
  const choose = (step: number) => {
    const held = model.frame?.held ?? [];
    if (held.length) chosen = (chosen + step + held.length) % held.length;
    const moved = held.length ? `the arrow keys move ${held[chosen]}, ` : "";
    canvas.setAttribute("aria-label", `Picture; ${moved}A, D, W and S turn the view, 1 to 5 choose it`);
    if (step && held.length) say(`The arrow keys move ${held[chosen]}.`);
  };
  canvas.addEventListener("keydown", (event) => {
    const part = event.shiftKey ? COARSE : FINE;
    const acts: Record<string, () => void> = {
      ArrowRight: () => move(1, part),
      ArrowLeft: () => move(-1, part),
      ArrowUp: () => choose(-1),
      ArrowDown: () => choose(1),
      "+": () => stage.zoom(1.25),
      "-": () => stage.zoom(0.8),
      a: () => stage.turn(-TURN, 0),
      d: () => stage.turn(TURN, 0),
      w: () => stage.turn(0, TURN),
      s: () => stage.turn(0, -TURN),
      Home: () => model.home(),
    };
    const act = acts[event.key] ?? acts[event.key.toLowerCase()] ?? (/^[1-5]$/.test(event.key) ? () => look(Number(event.key) - 1) : null);
    if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
    act();
    event.preventDefault();
  });
  model.onLoaded(() => {
    chosen = 0;
    choose(0);
  });
}
