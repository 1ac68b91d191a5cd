// The page: everything is put together here.
import { Vector3 } from "three";
import { Background } from "./background";
import { Designer } from "./designer";
import { Desk } from "./desk";
import { dragging } from "./drag";
import { Drive } from "./drive";
import { Drawing, guides, jointSize, type Plane, planeOf, points } from "./drawing";
import { Editor } from "./editor";
import { button, find } from "./elements";
import { exporting } from "./exporting";
import { GainedFreedoms } from "./gained";
import { gallery } from "./gallery";
import { keyboard } from "./keyboard";
import { Labels } from "./labels";
import * as link from "./link";
import { Load } from "./load";
import { Model, type File } from "./model";
import { ModeList } from "./modes";
import { Motion } from "./motion";
import { Parameters } from "./parameters";
import { Scenery } from "./scenery";
import { Sliders } from "./sliders";
import { Undo } from "./undo";
import { Holding } from "./holding";
import { newFile } from "./newfile";
import { Quantities } from "./quantities";
import { Solver } from "./solver";
import { falling } from "./springs";
import { Stage, type View } from "./stage";
import { Surroundings } from "./surroundings";
import { onThemeChange } from "./theme";
import type { Scene, Triple } from "./types";
import { Values } from "./values";
import { watching } from "./watching";
import { WaysOn } from "./wayson";

const VIEWS: [string, View][] = [["Plane", "plane"], ["Iso", "iso"], ["Front", "front"], ["Side", "side"], ["Top", "top"]];

/** How long nothing moves before the picture follows, in ms. */
const REST = 400;

function say(words: string) {
  find("said").textContent = words;
}

/** The picture of a model, with what is shown beside it. */
class Picture {
  readonly stage = new Stage(find<HTMLCanvasElement>("canvas"));
  readonly drawing = new Drawing();
  readonly scenery = new Scenery();
  readonly surroundings = new Surroundings();
  readonly labels = new Labels();
  /** The plane of a planar mechanism. */
  private plane: Plane | null = null;
  /** What is shown in place of where the mechanism is. */
  private other: Scene | null = null;
  private shown = "";
  private rest = 0;
  /** Places of a motion. */
  motion: Scene[] = [];
  /** Whether a drawing board is over it. */
  private drawn = false;

  constructor(private readonly model: Model) {
    this.stage.world.add(this.drawing.shapes.group, this.scenery.shapes.group, this.surroundings.group);
    this.stage.orbit.addEventListener("change", () => {
      // symbols of the plane stand before their links only where that is seen from the front
      if ((this.drawing.plane !== null) !== this.inPlane) this.draw();
      else this.label();
    });
    model.onLoaded(() => this.begin());
    model.onMoved(() => {
      this.other = null;
      this.draw();
      clearTimeout(this.rest);
      this.rest = setTimeout(() => this.follow(), REST);
    });
    onThemeChange(() => (this.scene ? this.draw() : this.stage.draw()));
    const perspective = button("Perspective", () => {
      const on = !this.stage.camera.perspective;
      perspective.setAttribute("aria-pressed", String(on));
      this.stage.view(on);
      this.label();
    }, { "aria-pressed": "false", "data-solid": "" });
    const names = button("Names", () => {
      this.labels.shown = !this.labels.shown;
      names.setAttribute("aria-pressed", String(this.labels.shown));
      this.label();
    }, { "aria-pressed": "false", "data-solid": "" });
    find("views").append(
      ...VIEWS.map(([words, view]) => button(words, () => this.look(view), { "data-view": view })),
      button("Fit", () => this.fit(), { title: "All of the mechanism and its motion" }),
      perspective,
      button("+", () => this.stage.zoom(1.25), { "aria-label": "nearer" }),
      button("−", () => this.stage.zoom(0.8), { "aria-label": "farther" }),
      names,
    );
  }

  /** What has moved out of the picture is brought back, unless somebody has chosen what to see. */
  private follow() {
    const { stage, scene } = this;
    if (scene && !this.drawn && stage.camera.zoom === 1 && !stage.canvas.classList.contains("dragging")) stage.include([...points(scene), ...this.tips]);
  }

  instead(scene: Scene | null) {
    this.other = scene;
    this.draw();
  }

  draw() {
    const { scene } = this;
    if (!scene) return;
    this.drawing.plane = this.inPlane ? this.plane : null;
    this.drawing.shapes.flat = this.drawing.plane !== null;
    this.drawing.held = new Set(this.model.frame?.held ?? []);
    this.drawing.draw(scene);
    this.surroundings.draw(scene, this.scenery.arrows.extent, this.drawing.size, this.inPlane || this.drawn);
    const forces = this.other ? null : this.model.frame?.forces;
    const words = forces && "arrows" in forces ? forces : { arrows: [], moments: [] };
    this.scenery.draw(scene, words, this.drawing.size, this.drawing.plane !== null, (point) => this.drawing.above(point, 3));
    this.label();
    this.stage.draw();
  }

  private label() {
    this.labels.place(this.stage, this.scene, [...this.scenery.notes, ...this.surroundings.notes], this.drawing.size);
  }

  private get scene(): Scene | null {
    return this.other ?? this.model.frame?.scene ?? null;
  }

  /** Another mechanism is looked at from where it is seen best; one that was changed from where it was. */
  private begin() {
    const { frame, mechanism } = this.model;
    if (!frame || !mechanism) return;
    const { scene } = frame;
    this.other = null;
    this.motion = [];
    this.plane = planeOf(scene);
    if (mechanism.name !== this.shown) this.surroundings.forget();
    const all = points(scene);
    const middle = all.reduce((sum, p) => sum.add(p), new Vector3()).divideScalar(Math.max(all.length, 1));
    const extent = 2 * Math.max(...all.map((p) => p.distanceTo(middle)), 1e-9);
    this.drawing.size = jointSize(scene, extent);
    this.scenery.arrows.extent = extent;
    this.scenery.falling = falling(scene, all, extent);
    find("views").querySelector<HTMLElement>("[data-view=plane]")!.hidden = this.plane === null;
    if (this.drawn) return;
    if (mechanism.name !== this.shown) this.look(this.plane ? "plane" : "iso");
    this.shown = mechanism.name;
  }

  /** Makes room for a drawing in the plane of x and y. */
  board() {
    const all = this.scene ? [...points(this.scene), ...guides(this.scene, this.drawing.size)] : [-1, 1].map((side) => new Vector3(0.16 * side, 0.09 * side, 0));
    const towards = new Vector3(0, 0, 1);
    this.stage.look("plane", all, { right: new Vector3(1, 0, 0), up: new Vector3(0, 1, 0), towards });
    this.stage.zoom(0.75);
  }

  /** Makes room for other configurations beside the one that is shown. */
  room(scenes: Scene[]) {
    this.stage.include([...(this.scene ? points(this.scene) : []), ...scenes.flatMap(points)]);
  }

  /** Of the forces that are shown. */
  private get tips(): Vector3[] {
    const { arrows } = this.scenery;
    return (this.scene?.arrows ?? []).map((arrow) => arrows.tip(arrow));
  }

  /** Shows all of the mechanism, of its motion and of what stands beside it. */
  fit() {
    if (!this.scene) return;
    const beside = [...this.scenery.ghosts, ...this.motion].flatMap(points);
    this.stage.fit([...points(this.scene), ...guides(this.scene, this.drawing.size), ...(this.scenery.falling ?? []), ...beside, ...traced(this), ...this.tips]);
    this.draw();
  }

  /** Hides the solids behind a drawing board. */
  hide(hidden: boolean) {
    this.drawing.shapes.group.visible = this.scenery.shapes.group.visible = !hidden;
    find("labels").hidden = hidden;
    this.drawn = hidden;
    this.shown = "";
    if (!hidden) this.begin();
    this.stage.draw();
  }

  /** Whether a planar mechanism is seen along its normal. */
  get inPlane(): boolean {
    const { plane } = this;
    const sight = this.stage.camera.getWorldDirection(new Vector3());
    return plane !== null && Math.abs(sight.dot(plane.towards)) > 0.9999;
  }

  /** Downwards, in the plane of what is planar. */
  get down(): Vector3 {
    return this.plane ? this.plane.up.clone().negate() : new Vector3(0, 0, -1);
  }

  /** Where a body is on the canvas. */
  pixelOf(name: string): [number, number] | null {
    const body = this.scene?.bodies.find((body) => body.name === name);
    const [from, to] = body?.lines[0] ?? body?.corners ?? [];
    return from && to ? this.stage.pixel(new Vector3(...from).lerp(new Vector3(...to), 0.4)) : null;
  }

  /** Where a place is on the canvas. */
  pixel(at: Triple): [number, number] {
    return this.stage.pixel(new Vector3(...at));
  }

  look(view: View) {
    if (this.scene) this.stage.look(view, [...points(this.scene), ...guides(this.scene, this.drawing.size), ...(this.scenery.falling ?? [])], this.plane);
    this.draw();
  }
}

const traced = (picture: Picture) =>
  picture.scenery.traces.flatMap((trace) => trace.points.map((point) => new Vector3(...point)));

async function begin() {
  const module = await globalThis.solver;
  const model = new Model(await Solver.of(module), new Background(module), say);
  const sliders = new Sliders((name, to) => model.move(name, to), (of, text) => model.moveTo(of, text));
  const holding = new Holding(model);
  const values = new Values((name) => holding.hold(name), (name) => holding.release(name));
  const picture = new Picture(model);
  model.onLoaded(() => {
    const { mechanism } = model;
    document.title = `${mechanism!.name} – linkwork`;
    find("name").textContent = mechanism!.name;
    find("source").textContent = find("source").title = mechanism!.source ?? "";
  });
  model.onMoved(() => {
    sliders.show(model.mechanism!, model.frame!);
    values.show(model.mechanism!, model.frame!);
    const { assembled, crossed, said, limits } = model.frame!;
    const branch = crossed ? `another branch than ${model.branch}, across a dead point` : model.branch;
    find("branch").textContent = assembled ? `On ${branch}.` : "";
    if (!said && limits.length) say(limits.map(([, words]) => words).join(" "));
  });
  new WaysOn(model, (scenes) => {
    picture.scenery.ghosts = scenes;
    picture.draw();
  });
  const modes = new ModeList(model, (scenes) => {
    picture.scenery.ghosts = scenes;
    if (scenes.length) picture.room(scenes);
    picture.draw();
  });
  const motion = new Motion(
    model,
    (traces) => {
      picture.scenery.traces = traces;
      picture.draw();
    },
    (scene) => picture.instead(scene),
    (scenes) => {
      picture.motion = scenes;
      picture.stage.include([...scenes.flatMap(points), ...traced(picture)]);
    },
  );
  const load = new Load(model, picture.scenery.arrows, () => picture.down);
  const drive = new Drive(model, module);
  new GainedFreedoms(model, (screws, swung) => {
    Object.assign(picture.scenery, { screws, swung });
    picture.draw();
  });
  const undo = new Undo(model);
  find("views").append(...undo.buttons, button("Home", () => model.home(), { id: "home", title: "As in the file (Home key)" }));
  new Quantities(model);
  new Parameters(model);
  const desk = new Desk(model, picture.stage, {
    look: () => picture.board(),
    hide: (hidden) => picture.hide(hidden),
    trace: (point) => motion.tracePoint(point),
  });
  find("edit").addEventListener("click", () => desk.open(!desk.on));
  const leave = () => {
    desk.open(false);
    desk.pins = [];
  };
  newFile(model, () => desk.begin(), leave);
  model.onBlank(() => {
    document.body.classList.add("blank");
    find("name").textContent = "New drawing";
    find("source").textContent = "";
  });
  model.onLoaded(() => document.body.classList.remove("blank"));
  new Editor(model);
  exporting(model, picture.stage, () => picture.drawing.shapes.group, () => picture.inPlane, () => picture.labels.shown);
  const designer = new Designer(model, module, picture.stage, {
    draw: (of) => {
      picture.scenery.design = of;
      picture.draw();
    },
    look: () => model.frame?.scene.normal && !picture.inPlane && picture.look("plane"),
    room: (scenes) => picture.room(scenes),
  });
  dragging(picture.stage, model, load, (point) => motion.take(point));
  const share = button("Copy link", async () => {
    location.hash = await link.written(model.file, model.place());
    await navigator.clipboard?.writeText(location.href).catch(() => undefined);
    say("The address of this page now contains the mechanism and its configuration.");
  }, { id: "share" });
  find("export").append(" ", share);

  keyboard(picture.stage, model, say, (view) => picture.look(VIEWS[view]![1]));
  const browse = gallery(module, (file) => {
    history.replaceState(null, "", " ");
    leave();
    model.load(file);
  });
  find("browse").addEventListener("click", () => void browse());

  const given = JSON.parse(find("mechanism").textContent ?? "{}") as File & { watch: boolean };
  const open = async () => {
    const linked = await link.read(location.hash);
    if (linked) model.load(linked, linked);
    return linked !== null;
  };
  addEventListener("hashchange", () => void open());
  if (!(await open())) {
    if (given.text) model.load(given);
    else void browse();
  }
  if (given.watch) watching(model);
  requestAnimationFrame(() => performance.mark("picture"));
  // for whoever tests or scripts the page
  Object.assign(globalThis, { linkwork: model, picture, holding, desk, modes, motion, drive, designer });
  document.documentElement.dataset.ready = "true";
}

begin().catch((error: unknown) => say(`The page cannot start: ${error instanceof Error ? error.message : String(error)}`));
