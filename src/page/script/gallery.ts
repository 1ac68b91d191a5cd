// Every shipped mechanism by topic, found by a word, with a thumbnail that is drawn when there is time.
import { element, find } from "./elements";
import type { File } from "./model";
import { unpacked } from "./packed";
import { Solver } from "./solver";
import { thumbnail } from "./thumbnail";
import { type Loaded, Refused } from "./types";

const SIZE = 120;

/** Topics in the order in which they are shown; a file is of the first that fits. */
const TOPICS: [string, RegExp][] = [
  ["Straight lines and legs", /jansen|klann|chebyshev|hoeken|peaucellier|watt_linkage|sarrus|scissor/],
  ["Parallel robots", /stewart|rps|delta|rpr|agile|orthoglide|hexaglide|h4|tricept|dietmaier|hand/],
  ["Serial arms", /puma|scara|stanford|elbow|wrist|planar_\d|cylindrical|rpp/],
  ["Overconstrained and spatial loops", /bennett|bricard|goldberg|myard|schatz|spherical|rssr/],
  ["Let go and driven", /^loads\//],
  ["Machines", /axes\/(?!four_bar)/],
  ["Planar linkages", /./],
];

/** The same mechanism cut elsewhere. */
const CUT = /_cut\d+\.ron$/;

interface Item {
  item: HTMLButtonElement;
  canvas: HTMLCanvasElement;
  file: string;
  text: string;
}

export function gallery(module: WebAssembly.Module, open: (file: File) => void) {
  const dialog = find<HTMLDialogElement>("gallery");
  let all: Item[] | null = null;
  let waiting: Item[] = [];
  let solver: Solver;
  const next = () => {
    const { canvas, text } = (dialog.open && waiting.shift()) || {};
    if (!canvas || text === undefined) return;
    try {
      thumbnail(canvas, solver.ask<Loaded>({ do: "load", text }).scene);
    } catch (error) {
      if (!(error instanceof Refused)) throw error;
    }
    setTimeout(next, 0);
  };
  const search = find<HTMLInputElement>("gallery-search");
  search.addEventListener("input", () => {
    const wanted = search.value.trim().toLowerCase();
    for (const { item, file, text } of all ?? []) {
      // names, sources and what stands above the mechanism are searched
      item.hidden = wanted !== "" && !`${file} ${text.slice(0, 3000)}`.toLowerCase().includes(wanted);
      if (!item.hidden && wanted) item.closest("details")?.setAttribute("open", "");
    }
    for (const topic of dialog.querySelectorAll<HTMLElement>(".topic")) topic.hidden = !topic.querySelector("button:not([hidden])");
    const none = all?.every(({ item }) => item.hidden);
    find("gallery-said").textContent = none ? `No mechanism has “${search.value.trim()}” in its name, source or description.` : "";
  });
  return async () => {
    if (!all) {
      const files = (await unpacked("files").json()) as [string, string][];
      all = items(files, (file) => {
        dialog.close();
        open(file);
      });
      waiting = [...all];
      find("gallery-items").replaceChildren(...topics(all));
      solver = await Solver.of(module);
    }
    dialog.showModal();
    setTimeout(next, 0);
  };
}

function topics(all: Item[]): HTMLElement[] {
  const topicOf = (file: string) => TOPICS.find(([, names]) => names.test(file))![0];
  return TOPICS.flatMap(([topic]) => {
    const own = all.filter(({ file }) => topicOf(file) === topic);
    const cuts = own.filter(({ file }) => CUT.test(file)).map(({ item }) => item);
    const others = own.filter(({ file }) => !CUT.test(file)).map(({ item }) => item);
    if (!own.length) return [];
    const folded = cuts.length ? [element("details", {}, element("summary", {}, `The same, cut elsewhere (${cuts.length})`), element("div", { class: "items" }, ...cuts))] : [];
    return [element("section", { class: "topic" }, element("h2", {}, topic), element("div", { class: "items" }, ...others), ...folded)];
  });
}

function items(files: [string, string][], open: (file: File) => void): Item[] {
  return files.map(([file, text]) => {
    const canvas = element("canvas", { width: String(2 * SIZE), height: String(2 * SIZE) });
    const name = text.match(/\bname:\s*"((?:[^"\\]|\\.)*)"/)?.[1] ?? file;
    const item = element("button", { type: "button", "data-file": file }, canvas, element("span", {}, name));
    item.addEventListener("click", () => open({ file, text, set: [] }));
    return { item, canvas, file, text };
  });
}
