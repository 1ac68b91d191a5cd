// A small picture of a scene: links as lines and filled shapes.
import { Vector3 } from "three";
import { planeOf } from "./drawing";
import { hull } from "./hull";
import { bodyColour, theme } from "./theme";
import type { Scene, Triple } from "./types";

/** Links as lines, in the plane of the mechanism or isometric, with the curve of a point and the places that it shall pass. */
export function thumbnail(canvas: HTMLCanvasElement, scene: Scene, curve: Triple[] = [], places: Triple[] = []) {
  const pen = canvas.getContext("2d");
  if (!pen) return;
  const plane = planeOf(scene);
  const right = plane?.right ?? new Vector3(1.4, 1, 0).normalize();
  const up = plane?.up ?? new Vector3(1, -1.4, 0).normalize().multiplyScalar(-0.46).add(new Vector3(0, 0, 0.89));
  const seen = (t: Triple): [number, number] => {
    const at = new Vector3(...t);
    return [at.dot(right), at.dot(up)];
  };
  const lines: { line: [number, number][]; colour: string }[] = [
    ...scene.bodies.flatMap((body, i) => {
      const colour = body.ground ? theme().ground : bodyColour(i);
      const corners = body.ground && plane ? [] : body.corners.map(seen);
      const round = hull(corners).map((k) => corners[k]!);
      const outline = round.length > 2 || !body.lines.length ? [[...round, ...round.slice(0, 1)]] : [];
      return [...body.lines.map((line) => line.map(seen)), ...outline].map((line) => ({ line, colour }));
    }),
    ...scene.rods.map((rod) => ({ line: rod.ends.map(seen), colour: theme().ink })),
    ...(curve.length ? [{ line: curve.map(seen), colour: theme().trace }] : []),
  ];
  const joints = scene.joints.map((joint) => seen(joint.at));
  const passed = places.map(seen);
  const all = [...lines.flatMap(({ line }) => line), ...joints, ...passed];
  if (!all.length) return;
  const [xs, ys] = [all.map(([x]) => x), all.map(([, y]) => y)];
  const [left, bottom] = [Math.min(...xs), Math.min(...ys)];
  const [width, height] = [Math.max(...xs) - left, Math.max(...ys) - bottom];
  const scale = (canvas.width - 40) / Math.max(width, height, 1e-9);
  const place = ([x, y]: [number, number]): [number, number] => [
    canvas.width / 2 + (x - left - width / 2) * scale, canvas.height / 2 - (y - bottom - height / 2) * scale,
  ];
  pen.clearRect(0, 0, canvas.width, canvas.height);
  pen.lineCap = pen.lineJoin = "round";
  pen.lineWidth = 6;
  for (const { line, colour } of lines) {
    pen.strokeStyle = pen.fillStyle = colour;
    pen.beginPath();
    line.forEach((point, i) => (i ? pen.lineTo(...place(point)) : pen.moveTo(...place(point))));
    pen.globalAlpha = 0.25;
    if (line.length > 3 && colour !== theme().trace && line[0] === line.at(-1)) pen.fill();
    pen.globalAlpha = 1;
    pen.stroke();
  }
  pen.fillStyle = theme().joint;
  pen.strokeStyle = theme().ink;
  pen.lineWidth = 2;
  const dots = (of: [number, number][], radius: number) => of.forEach((at) => {
    pen.beginPath();
    pen.arc(...place(at), radius, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
  });
  dots(joints, 6);
  pen.fillStyle = theme().trace;
  dots(passed, 3);
}
