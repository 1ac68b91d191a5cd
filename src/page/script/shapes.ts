// Solids of unit size that are placed, and used again from frame to frame.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CylinderGeometry, DoubleSide, Group, type Material, Matrix4, Mesh,
  MeshBasicMaterial, MeshLambertMaterial, SphereGeometry, Vector3,
} from "three";

export type Pick = { body?: number; joint?: number; rod?: number; arrow?: number };

const bar = new CylinderGeometry(1, 1, 1, 20).rotateX(Math.PI / 2);
const cone = new CylinderGeometry(0, 1, 1, 20).rotateX(Math.PI / 2);
const ball = new SphereGeometry(1, 28, 18);
const box = new BoxGeometry(2, 2, 2);

export class Shapes {
  readonly group = new Group();
  private readonly meshes = new Map<BufferGeometry | "plate", Mesh[]>();
  private readonly used = new Map<BufferGeometry | "plate", number>();
  private readonly materials = new Map<string, Material>();

  /** Flat colours, or shaded ones. */
  flat = false;

  /** Whether what is drawn now is seen through everything else. */
  private over = false;

  begin() {
    this.used.clear();
  }

  /** Hides what this frame does not use. */
  end() {
    for (const [kind, meshes] of this.meshes) {
      const used = this.used.get(kind) ?? 0;
      meshes.forEach((mesh, i) => (mesh.visible = i < used));
    }
  }

  /** A round bar between two points, with round ends. */
  rod(from: Vector3, to: Vector3, radius: number, colour: string, pick?: Pick, opacity = 1) {
    const along = to.clone().sub(from);
    const length = along.length();
    if (length > 1e-9 * radius) {
      const mesh = this.take(bar, colour, opacity, pick);
      place(mesh, from.clone().addScaledVector(along, 0.5), along.divideScalar(length), [radius, radius, length]);
    }
    this.ball(from, radius, colour, pick, opacity);
    this.ball(to, radius, colour, pick, opacity);
  }

  cylinder(at: Vector3, axis: Vector3, radius: number, half: number, colour: string, pick?: Pick) {
    place(this.take(bar, colour, 1, pick), at, axis, [radius, radius, 2 * half]);
  }

  /** A bar with a point, which nothing hides. */
  arrow(from: Vector3, to: Vector3, radius: number, colour: string, pick?: Pick) {
    const along = to.clone().sub(from);
    const length = along.length();
    if (!(length > 0)) return;
    along.divideScalar(length);
    const head = Math.min(7 * radius, 0.6 * length);
    const neck = to.clone().addScaledVector(along, -head);
    this.over = true;
    this.cylinder(from.clone().lerp(neck, 0.5), along, radius, (length - head) / 2, colour, pick);
    place(this.take(cone, colour, 1, pick), neck.addScaledVector(along, head / 2), along, [0.42 * head, 0.42 * head, head]);
    this.over = false;
  }

  /** A strip of shadow on a level plane. */
  shadow(at: Vector3, along: Vector3, half: number, width: number) {
    place(this.take(box, "#000000", 0.07), at, along, [width, 1e-4 * width, half], new Vector3(0, 0, 1));
  }

  ball(at: Vector3, radius: number, colour: string, pick?: Pick, opacity = 1) {
    const mesh = this.take(ball, colour, opacity, pick);
    mesh.matrix.makeScale(radius, radius, radius).setPosition(at);
  }

  /** A box with its third edge along the axis; the second along `side` if it is given. */
  box(at: Vector3, axis: Vector3, halves: [number, number, number], colour: string, pick?: Pick, side?: Vector3) {
    place(this.take(box, colour, 1, pick), at, axis, halves, side);
  }

  /** A convex plate through points in order. */
  plate(points: Vector3[], colour: string, opacity: number, pick?: Pick) {
    const mesh = this.take("plate", colour, opacity, pick);
    const triangles: number[] = [];
    for (let i = 1; i + 1 < points.length; i++) {
      for (const p of [points[0]!, points[i]!, points[i + 1]!]) triangles.push(p.x, p.y, p.z);
    }
    const geometry = mesh.geometry;
    geometry.setAttribute("position", new BufferAttribute(new Float32Array(triangles), 3));
    geometry.computeVertexNormals();
    geometry.computeBoundingSphere();
    mesh.matrix.identity();
  }

  private take(kind: BufferGeometry | "plate", colour: string, opacity: number, pick?: Pick): Mesh {
    const meshes = this.meshes.get(kind) ?? [];
    this.meshes.set(kind, meshes);
    const number = this.used.get(kind) ?? 0;
    this.used.set(kind, number + 1);
    let mesh = meshes[number];
    if (!mesh) {
      mesh = new Mesh(kind === "plate" ? new BufferGeometry() : kind);
      mesh.matrixAutoUpdate = false;
      mesh.frustumCulled = false;
      meshes.push(mesh);
      this.group.add(mesh);
    }
    mesh.material = this.material(colour, opacity);
    mesh.userData = pick ?? {};
    mesh.renderOrder = this.over ? 2 : opacity < 1 ? 1 : 0;
    return mesh;
  }

  private material(colour: string, opacity: number): Material {
    const name = `${colour} ${opacity} ${this.flat} ${this.over}`;
    let material = this.materials.get(name);
    if (!material) {
      const looks = { color: colour, opacity, transparent: opacity < 1, depthWrite: opacity === 1, depthTest: !this.over, side: DoubleSide };
      material = this.flat ? new MeshBasicMaterial(looks) : new MeshLambertMaterial(looks);
      this.materials.set(name, material);
    }
    return material;
  }
}

/** A direction across an axis. */
export function across(axis: Vector3): Vector3 {
  const other = Math.abs(axis.z) < 0.9 ? new Vector3(0, 0, 1) : new Vector3(1, 0, 0);
  return other.cross(axis).normalize();
}

const frame = new Matrix4();

function place(mesh: Mesh, at: Vector3, axis: Vector3, scale: [number, number, number], side?: Vector3) {
  const second = (side ?? across(axis)).clone().normalize();
  const first = second.clone().cross(axis).normalize();
  frame.makeBasis(first, second, axis).scale(new Vector3(...scale));
  mesh.matrix.copy(frame).setPosition(at);
}
