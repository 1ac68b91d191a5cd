// All assemblies for what is held: their numbers and certificates, ghosts in the picture, a click goes there.
import { button, element, find } from "./elements";
import type { Model } from "./model";
import { type Modes, Refused, type Scene } from "./types";

export class ModeList {
  private found: Modes | null = null;
  /** Where the inputs were when they were listed. */
  private inputs = "";

  constructor(private readonly model: Model, private readonly ghosts: (scenes: Scene[]) => void) {
    const list = button("List all assemblies", () => this.list(), { id: "list-modes" });
    const stop = button("Stop", () => model.background.stop(), { id: "stop-modes", hidden: "" });
    const ghost = element("input", { type: "checkbox", id: "ghosts" });
    ghost.addEventListener("change", () => this.showGhosts());
    find("modes").append(
      element("p", {}, list, " ", stop, " ", element("label", {}, ghost, " show as ghosts")),
      element("p", { id: "modes-said", role: "status" }),
      element("ol", { id: "mode-list" }),
    );
    model.onLoaded(() => this.clear());
    model.onMoved(() => this.mark());
  }

  private async list() {
    const [said, list, stop] = [find("modes-said"), find("list-modes"), find("stop-modes")];
    said.textContent = "Searching …";
    stop.hidden = false;
    list.setAttribute("disabled", "");
    const inputs = this.held();
    try {
      const found = await this.model.study<Modes>({ do: "ask", what: "assemblies" });
      this.found = found;
      this.inputs = inputs;
      said.textContent = found.report.sentence;
      this.show();
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
      said.textContent = error.message;
    } finally {
      stop.hidden = true;
      list.removeAttribute("disabled");
    }
  }

  private show() {
    const modes = this.found?.report.assemblies ?? [];
    find("mode-list").replaceChildren(
      ...modes.map((mode, i) => {
        const words = `mode ${mode.mode}`;
        const go = button(words, () => this.go(i), { "data-mode": String(mode.mode) });
        const notes = [
          mode.certified ? "certified" : "not certified",
          mode.within_limits ? "" : `${mode.outside_limits.join(", ")} outside limits`,
        ];
        return element("li", {}, go, " ", element("span", { class: "soft" }, notes.filter(Boolean).join("; ")));
      }),
    );
    this.mark();
    this.showGhosts();
  }

  private go(index: number) {
    const state = this.found?.states[index];
    const mode = this.found?.report.assemblies[index]?.mode;
    if (state) this.model.go(state.at, `the branch of mode ${mode} at ${this.where()}`);
  }

  /** Marks the mode the mechanism is in; once what is held has moved, the list is of another question. */
  private mark() {
    if (!this.found) return;
    const same = this.inputs === this.held();
    find("mode-list").classList.toggle("old", !same);
    const at = this.model.frame?.at;
    this.found.states.forEach((state, i) => {
      const here = same && at !== undefined && distance(state.at.joints, at.joints) < 1e-6;
      find("mode-list").children[i]?.querySelector("button")?.setAttribute("aria-pressed", String(here));
    });
    const said = find("modes-said");
    said.textContent = same ? this.found.report.sentence : "Listed for other held values.";
    if (!same) this.ghosts([]);
    else this.showGhosts();
  }

  private showGhosts() {
    const wanted = find<HTMLInputElement>("ghosts").checked && this.inputs === this.held();
    this.ghosts(wanted ? (this.found?.states.map((state) => state.scene) ?? []) : []);
  }

  private clear() {
    this.found = null;
    find("mode-list").replaceChildren();
    find("modes-said").textContent = "";
    this.ghosts([]);
  }

  /** `theta1 = 60°`, as far as there is room. */
  private where(): string {
    const { frame, mechanism } = this.model;
    const values = (frame?.held ?? []).slice(0, 3).map((name) => {
      const index = mechanism!.coordinates.findIndex((of) => of.name === name);
      return `${name} = ${frame!.values[index]![1]}`;
    });
    return values.join(", ") + ((frame?.held?.length ?? 0) > 3 ? ", …" : "");
  }

  private held(): string {
    const { frame, mechanism, file } = this.model;
    const held = frame?.held ?? [];
    const values = held.map((name) => frame!.values[mechanism!.coordinates.findIndex((of) => of.name === name)]![1]);
    return JSON.stringify([held, values, file.set, file.text.length]);
  }
}

function distance(a: number[], b: number[]): number {
  const turn = (x: number) => Math.abs(x - 2 * Math.PI * Math.round(x / (2 * Math.PI)));
  return Math.max(0, ...a.map((x, i) => Math.min(Math.abs(x - b[i]!), turn(x - b[i]!))));
}
