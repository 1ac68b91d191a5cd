// All assemblies for what is held, those of one pose together: pictures and certificates, a ghost under the pointer, a click goes there.
import { button, element, find } from "./elements";
import type { Model } from "./model";
import { poses } from "./poses";
import { thumbnail } from "./thumbnail";
import { type Modes, Refused, type Scene } from "./types";

export class ModeList {
  found: Modes | null = null;
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
      element("p", { id: "pose-count" }),
      element("ul", { id: "mode-list" }),
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
    const { found } = this;
    if (!found) return;
    const groups = poses(found);
    const several = groups.length < found.states.length;
    find("pose-count").textContent = several ? "Each pose is listed once; its variants differ in the legs only." : "";
    const waiting: [HTMLCanvasElement, Scene][] = [];
    find("mode-list").replaceChildren(...groups.map(({ modes }, k) => {
      const [first, ...others] = modes as [number, ...number[]];
      const canvas = element("canvas", { width: "120", height: "120", "aria-hidden": "true" });
      waiting.push([canvas, found.states[first]!.scene]);
      const words = several ? `pose ${k + 1}` : `mode ${found.report.assemblies[first]!.mode}`;
      const folded = others.length ? [this.variants(found, modes)] : [];
      return element("li", {}, this.button(found, first, words, canvas), element("div", {}, element("span", { class: "soft", title: "certified: proved to exist, and to be the only one near by" }, notes(found, first)), ...folded));
    }));
    // a picture at a time, so that the list is there at once
    const next = () => {
      const [canvas, scene] = waiting.shift() ?? [];
      if (!canvas?.isConnected || !scene) return;
      thumbnail(canvas, scene);
      setTimeout(next, 0);
    };
    next();
    this.mark();
    this.showGhosts();
  }

  private button(found: Modes, index: number, words: string, ...inside: Node[]): HTMLButtonElement {
    const go = button(words, () => this.go(index), { "data-mode": String(found.report.assemblies[index]!.mode), "data-index": String(index) });
    go.prepend(...inside);
    const over = (on: boolean) => () => this.inputs === this.held() && (on ? this.ghosts([found.states[index]!.scene]) : this.showGhosts());
    for (const event of ["pointerenter", "focus"]) go.addEventListener(event, over(true));
    for (const event of ["pointerleave", "blur"]) go.addEventListener(event, over(false));
    return go;
  }

  /** The assemblies of a pose, which are made when they are looked at. */
  private variants(found: Modes, modes: number[]): HTMLElement {
    const inside = element("p", { class: "variants" });
    const fold = element("details", {}, element("summary", {}, `${modes.length} variants of the legs`), inside);
    fold.addEventListener("toggle", () => {
      if (!fold.open || inside.children.length) return;
      inside.replaceChildren(...modes.flatMap((index) => [this.button(found, index, String(found.report.assemblies[index]!.mode)), " "]));
      this.mark();
    });
    return fold;
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
    const here = this.found.states.map((state) => same && at !== undefined && distance(state.at.joints, at.joints) < 1e-6);
    for (const of of find("mode-list").querySelectorAll<HTMLElement>("[data-index]")) of.setAttribute("aria-pressed", String(here[Number(of.dataset.index)]));
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
    find("pose-count").textContent = "";
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

/** Whether it is certain, how it is conditioned, and limits that it does not keep. */
function notes({ report }: Modes, index: number): string {
  const { certified, condition, within_limits, outside_limits } = report.assemblies[index]!;
  const parts = [
    certified ? "certified" : "not certified",
    condition === null || condition === undefined ? "" : `condition ${Number(condition.toPrecision(3))}`,
    within_limits ? "" : `${outside_limits.join(", ")} outside limits`,
  ];
  return parts.filter(Boolean).join("; ");
}

function distance(a: number[], b: number[]): number {
  const turn = (x: number) => Math.abs(x - 2 * Math.PI * Math.round(x / (2 * Math.PI)));
  return Math.max(0, ...a.map((x, i) => Math.min(Math.abs(x - b[i]!), turn(x - b[i]!))));
}
