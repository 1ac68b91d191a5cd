// The camera before the drawing: orbit, pan, zoom; orthographic, so that lengths compare.
import {
  AmbientLight, Box3, DirectionalLight, MOUSE, OrthographicCamera, Plane, Raycaster, Scene as World, Sphere, TOUCH,
  Vector2, Vector3, WebGLRenderer,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { Plane as SeenPlane } from "./drawing";
import type { Pick } from "./shapes";
import { theme } from "./theme";

export type View = "plane" | "iso" | "front" | "top" | "side";

export interface Hit {
  at: Vector3;
  pick: Pick;
}

/** Looks along parallel lines, so that lengths compare, or from a point; at its target both show as much. */
class Camera extends OrthographicCamera {
  perspective = false;
  /** From its target. */
  distance = 1;

  override updateProjectionMatrix() {
    super.updateProjectionMatrix();
    if (!this.perspective) return;
    const part = this.near / this.distance / this.zoom;
    this.projectionMatrix.makePerspective(this.left * part, this.right * part, this.top * part, this.bottom * part, this.near, this.far, this.coordinateSystem, this.reversedDepth);
    this.projectionMatrixInverse.copy(this.projectionMatrix).invert();
  }
}

/** How far away the camera is, in radii of what is seen: along parallel lines, from a point. */
const [FAR, NEAR] = [20, 4.5];

export class Stage {
  readonly world = new World();
  readonly camera = new Camera();
  readonly renderer: WebGLRenderer;
  readonly orbit: OrbitControls;
  private readonly sun = new DirectionalLight(0xffffff, 2.2);
  private sphere = new Sphere(new Vector3(), 1);
  private half = 1;
  private waiting = false;
  private size = "";

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true });
    this.world.add(new AmbientLight(0xffffff, 1.6), this.sun);
    this.camera.up.set(0, 0, 1);
    this.orbit = new OrbitControls(this.camera, canvas);
    this.orbit.addEventListener("change", () => this.draw());
    new ResizeObserver(() => this.resize()).observe(canvas.parentElement!);
    this.resize();
  }

  /** Draws once before the screen shows anything next. */
  draw() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => this.drawNow());
  }

  drawNow() {
    this.waiting = false;
    this.renderer.setClearColor(theme().paper);
    const towards = this.camera.position.clone().sub(this.orbit.target);
    this.sun.position.copy(towards).add(this.camera.up.clone().multiplyScalar(0.6 * towards.length()));
    this.renderer.render(this.world, this.camera);
  }

  /** Shows all of these points, seen from a view. */
  look(view: View, points: Vector3[], plane: SeenPlane | null) {
    const box = new Box3().setFromPoints(points.length ? points : [new Vector3()]);
    box.getBoundingSphere(this.sphere);
    this.sphere.radius = Math.max(this.sphere.radius, 1e-6);
    const directions: Record<View, [Vector3, Vector3]> = {
      plane: plane ? [plane.towards, plane.up] : [new Vector3(0, 0, 1), new Vector3(0, 1, 0)],
      iso: [new Vector3(1.3, -1.05, 0.85), new Vector3(0, 0, 1)],
      front: [new Vector3(0, -1, 0), new Vector3(0, 0, 1)],
      side: [new Vector3(1, 0, 0), new Vector3(0, 0, 1)],
      top: [new Vector3(0, 0, 1), new Vector3(0, 1, 0)],
    };
    const [from, up] = directions[view];
    const flat = view === "plane";
    this.orbit.mouseButtons.LEFT = flat ? MOUSE.PAN : MOUSE.ROTATE;
    this.orbit.mouseButtons.RIGHT = flat ? MOUSE.ROTATE : MOUSE.PAN;
    this.orbit.touches.ONE = flat ? TOUCH.PAN : TOUCH.ROTATE;
    const { center, radius } = this.sphere;
    this.camera.up.copy(up);
    this.camera.position.copy(center).addScaledVector(from.clone().normalize(), this.away);
    this.camera.near = this.camera.perspective ? 0.2 * radius : radius;
    this.camera.far = 60 * radius;
    this.camera.zoom = 1;
    this.orbit.target.copy(center);
    this.orbit.update();
    this.frame(points);
  }

  private get away(): number {
    return (this.camera.perspective ? NEAR : FAR) * this.sphere.radius;
  }

  /** From a point, or along parallel lines, as it is seen now. */
  view(perspective: boolean) {
    const { camera, orbit } = this;
    camera.perspective = perspective;
    const way = camera.position.clone().sub(orbit.target).normalize();
    camera.position.copy(orbit.target).addScaledVector(way, this.away);
    camera.near = (perspective ? 0.2 : 1) * this.sphere.radius;
    orbit.update();
    this.project();
    this.draw();
  }

  /** Shows all of these points from where they are seen. */
  fit(points: Vector3[]) {
    if (points.length) this.frame(points);
  }

  /** Makes room for points that are not in the picture, seen from where it is seen. */
  include(points: Vector3[]) {
    this.camera.updateMatrixWorld();
    const [, below] = this.covered();
    const lowest = (2 * below) / Math.max(this.canvas.clientHeight, 1) - 1;
    const outside = points.some((point) => {
      const { x, y } = point.clone().project(this.camera);
      return Math.max(Math.abs(x), Math.abs(y)) > 0.96 || y < lowest;
    });
    if (outside) this.frame(points);
  }

  /** As much as is seen from here, with room for symbols. */
  private frame(points: Vector3[]) {
    this.camera.updateMatrixWorld();
    this.camera.zoom = 1;
    const { radius } = this.sphere;
    const seen = points.map((point) => point.clone().applyMatrix4(this.camera.matrixWorldInverse));
    const frame = new Box3().setFromPoints(seen.length ? seen : [new Vector3()]);
    const size = frame.getSize(new Vector3());
    const aspect = this.aspect();
    // the buttons above and the lines below are over the picture
    const height = Math.max(this.canvas.parentElement!.clientHeight, 1);
    const [above, below] = this.covered();
    const room = Math.max(1 - (above + below) / height, 0.5);
    const deep = this.camera.perspective ? 1.15 : 1;
    this.half = deep * 0.5 * Math.max(size.y / room, size.x / aspect, 0.1 * radius) * 1.12 + 0.06 * radius;
    const middle = frame.getCenter(new Vector3());
    middle.y -= ((below - above) * this.half) / height;
    middle.applyMatrix4(this.camera.matrixWorld);
    const sight = this.camera.getWorldDirection(new Vector3());
    const shift = middle.sub(this.orbit.target);
    shift.addScaledVector(sight, -shift.dot(sight));
    this.orbit.target.add(shift);
    this.camera.position.add(shift);
    this.orbit.update();
    this.project();
    this.draw();
  }

  /** Pixels that buttons cover above, and words below. */
  covered(): [number, number] {
    const [above, below] = ["#views", "#under"].map((part) => (this.canvas.parentElement!.querySelector<HTMLElement>(part)?.offsetHeight ?? 0) + 14);
    return [above!, below!];
  }

  /** Moves the camera by so much along x and y. */
  pan(x: number, y: number) {
    for (const moved of [this.camera.position, this.orbit.target]) {
      moved.x += x;
      moved.y += y;
    }
    this.camera.updateMatrixWorld();
    this.orbit.update();
    this.draw();
  }

  /** Turns the view about its middle by so much to the right and upwards, in rad; a plane is moved instead. */
  turn(right: number, up: number) {
    const { camera, orbit } = this;
    if (orbit.mouseButtons.LEFT === MOUSE.PAN) return this.shift(right, up);
    const arm = camera.position.clone().sub(orbit.target).applyAxisAngle(camera.up, -right);
    const from = arm.angleTo(camera.up);
    const to = Math.min(Math.max(from - up, 0.01), Math.PI - 0.01);
    arm.applyAxisAngle(camera.up.clone().cross(arm).normalize(), to - from);
    camera.position.copy(orbit.target).add(arm);
    orbit.update();
    this.draw();
  }

  /** Moves the view by parts of its height. */
  private shift(right: number, up: number) {
    const { camera, orbit, half } = this;
    const way = new Vector3(right, up, 0).multiplyScalar((2 * half) / camera.zoom).applyQuaternion(camera.quaternion);
    for (const moved of [camera.position, orbit.target]) moved.add(way);
    orbit.update();
    this.draw();
  }

  zoom(factor: number) {
    this.camera.zoom *= factor;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** What is under a pointer, the nearest first. */
  hits(event: { clientX: number; clientY: number }): Hit[] {
    const found = this.ray(event).intersectObject(this.world, true);
    const shown = found.filter(({ object }) => object.visible && Object.keys(object.userData).length > 0);
    return shown.map(({ point, object }) => ({ at: point, pick: object.userData as Pick }));
  }

  /** Where a pointer is in the plane through a point that faces the viewer. */
  place(event: { clientX: number; clientY: number }, through: Vector3): Vector3 {
    const normal = this.camera.getWorldDirection(new Vector3());
    const plane = new Plane().setFromNormalAndCoplanarPoint(normal, through);
    return this.ray(event).ray.intersectPlane(plane, new Vector3()) ?? through.clone();
  }

  /** Where a point is on the canvas, in its pixels. */
  pixel(point: Vector3): [number, number] {
    const seen = point.clone().project(this.camera);
    return [(0.5 + 0.5 * seen.x) * this.canvas.clientWidth, (0.5 - 0.5 * seen.y) * this.canvas.clientHeight];
  }

  pixelsPerMetre(): number {
    return (this.canvas.clientHeight * this.camera.zoom) / (2 * this.half);
  }

  private ray(event: { clientX: number; clientY: number }): Raycaster {
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector2(
      ((event.clientX - box.left) / box.width) * 2 - 1,
      1 - ((event.clientY - box.top) / box.height) * 2,
    );
    const ray = new Raycaster();
    this.camera.updateMatrixWorld();
    ray.setFromCamera(at, this.camera);
    if (this.camera.perspective) {
      const origin = this.camera.getWorldPosition(new Vector3());
      ray.set(origin, new Vector3(at.x, at.y, 0.5).unproject(this.camera).sub(origin).normalize());
    }
    return ray;
  }

  private aspect(): number {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    return clientWidth / Math.max(clientHeight, 1) || 1;
  }

  private resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement!;
    const ratio = Math.min(devicePixelRatio, 2);
    const size = `${clientWidth} ${clientHeight} ${ratio}`;
    if (!clientWidth || !clientHeight || size === this.size) return;
    this.size = size;
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(clientWidth, clientHeight);
    this.project();
    // what was drawn is gone
    this.drawNow();
  }

  /** As much of the world as `half` says, above and below the middle. */
  private project() {
    const aspect = this.aspect();
    this.camera.distance = this.camera.position.distanceTo(this.orbit.target);
    Object.assign(this.camera, { left: -this.half * aspect, right: this.half * aspect, top: this.half, bottom: -this.half });
    this.camera.updateProjectionMatrix();
  }
}
