// Every shipped mechanism with a thumbnail, which is drawn when there is time.
import { Vector3 } from "three";
import { planeOf } from "./drawing";
import { element, find } from "./elements";
import type { File } from "./model";
import { unpacked } from "./packed";
import { Solver } from "./solver";
import { bodyColour, theme } from "./theme";
import { type Loaded, Refused, type Scene, type Triple } from "./types";

const SIZE = 120;

interface Item {
  item: HTMLButtonElement;
  canvas: HTMLCanvasElement;
  text: string;
}

export function gallery(module: WebAssembly.Module, open: (file: File) => void) {
  const dialog = find<HTMLDialogElement>("gallery");
  let waiting: Item[] | null = null;
  let solver: Solver;
  const next = () => {
    const { canvas, text } = (dialog.open && waiting?.shift()) || {};
    if (!canvas || text === undefined) return;
    try {
      thumbnail(canvas, solver.ask<Loaded>({ do: "load", text }).scene);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
    }
    setTimeout(next, 0);
  };
  return async () => {
    if (!waiting) {
      const files = (await unpacked("files").json()) as [string, string][];
      waiting = items(files, (file) => {
        dialog.close();
        open(file);
      });
      find("gallery-items").replaceChildren(...waiting.map(({ item }) => item));
      solver = await Solver.of(module);
    }
    dialog.showModal();
    setTimeout(next, 0);
  };
}

function items(files: [string, string][], open: (file: File) => void): Item[] {
  return files.map(([file, text]) => {
    const canvas = element("canvas", { width: String(2 * SIZE), height: String(2 * SIZE) });
    const name = text.match(/\bname:\s*"((?:[^"\\]|\\.)*)"/)?.[1] ?? file;
    const item = element("button", { type: "button", "data-file": file }, canvas, element("span", {}, name));
    item.addEventListener("click", () => open({ file, text, set: [] }));
    return { item, canvas, text };
  });
}

/** Links as lines, in the plane of the mechanism or isometric. */
function thumbnail(canvas: HTMLCanvasElement, scene: Scene) {
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
      const outline = body.lines.length || body.ground ? [] : [[...body.corners, ...body.corners.slice(0, 1)]];
      const colour = body.ground ? theme().ground : bodyColour(i);
      return [...body.lines, ...outline].map((line) => ({ line: line.map(seen), colour }));
    }),
    ...scene.rods.map((rod) => ({ line: rod.ends.map(seen), colour: theme().ink })),
  ];
  const joints = scene.joints.map((joint) => seen(joint.at));
  const all = [...lines.flatMap(({ line }) => line), ...joints];
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
    pen.strokeStyle = colour;
    pen.beginPath();
    line.forEach((point, i) => (i ? pen.lineTo(...place(point)) : pen.moveTo(...place(point))));
    pen.stroke();
  }
  pen.fillStyle = theme().joint;
  pen.strokeStyle = theme().ink;
  pen.lineWidth = 2;
  for (const joint of joints) {
    pen.beginPath();
    pen.arc(...place(joint), 6, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
  }
}
