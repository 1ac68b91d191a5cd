// Freedoms gained: where the mechanism is singular, the screws that nothing held resists, and the motion about them.
import { find } from "./elements";
import type { Model } from "./model";
import { type Gained, Refused, type Scene, type Screw } from "./types";

/** How long nothing moves before they are sought, and how long a picture lasts, in ms. */
const [PAUSE, PICTURE] = [150, 70];

const still = matchMedia("(prefers-reduced-motion: reduce)");

export class GainedFreedoms {
  private pause = 0;
  private swing = 0;
  private shown = false;

  constructor(private readonly model: Model, private readonly draw: (screws: Screw[], swung: Scene[]) => void) {
    model.onBlank(() => this.end());
    model.onMoved(() => {
      this.end();
      const figures = model.frame?.figures;
      if (figures && (figures.stopped || figures.condition === null)) this.pause = setTimeout(() => this.find(), PAUSE);
    });
  }

  private find() {
    try {
      const { scene, words, swings } = this.model.ask<Gained>({ do: "gained" });
      if (!scene) return;
      const screws = scene.screws ?? [];
      this.shown = true;
      find("gained").textContent = words.length ? `Freedom gained: ${words.join("; ")}.` : "A freedom is gained.";
      if (still.matches) {
        this.draw(screws, swings.flatMap((phases) => [phases[0]!, phases.at(-1)!]));
        return;
      }
      let time = 0;
      const next = () => {
        this.draw(screws, swings.map((phases) => phases[phase(time, phases.length)]!));
        time++;
        this.swing = setTimeout(next, PICTURE);
      };
      next();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
    }
  }

  private end() {
    clearTimeout(this.pause);
    clearTimeout(this.swing);
    if (!this.shown) return;
    this.shown = false;
    find("gained").textContent = "";
    this.draw([], []);
  }
}

/** To and fro, slower at the ends; begins in the middle. */
function phase(time: number, count: number): number {
  return Math.round(((count - 1) / 2) * (1 + Math.sin(time / 4)));
}
