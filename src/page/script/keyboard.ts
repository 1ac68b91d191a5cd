// The picture by keyboard: a held coordinate is chosen and moved, the view is changed.
import type { Model } from "./model";

/** Parts of a range that one press moves, alone and with Shift. */
const [FINE, COARSE] = [1 / 360, 1 / 36];

export function keyboard(
  canvas: HTMLCanvasElement, model: Model, say: (words: string) => void, zoom: (factor: number) => void, look: (view: number) => void,
) {
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
    if (!held.length) return;
    chosen = (chosen + step + held.length) % held.length;
    canvas.setAttribute("aria-label", `Picture; the arrow keys move ${held[chosen]}`);
    if (step) say(`The arrow keys move ${held[chosen]}.`);
  };
  canvas.addEventListener("keydown", (event) => {
    const part = event.shiftKey ? COARSE : FINE;
    const acts: Record<string, () => void> = {
      ArrowRight: () => move(1, part),
      ArrowLeft: () => move(-1, part),
      ArrowUp: () => choose(-1),
      ArrowDown: () => choose(1),
      "+": () => zoom(1.25),
      "-": () => zoom(0.8),
      Home: () => model.home(),
    };
    const act = acts[event.key] ?? (/^[1-5]$/.test(event.key) ? () => look(Number(event.key) - 1) : null);
    if (!act || event.ctrlKey || event.altKey || event.metaKey) return;
    act();
    event.preventDefault();
  });
  model.onLoaded(() => {
    chosen = 0;
    choose(0);
  });
}
