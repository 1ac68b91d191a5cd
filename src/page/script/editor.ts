// The file beside the picture; its problems stand at line and column while it is written.
import { button, element, find } from "./elements";
import type { Model } from "./model";
import type { Problem } from "./types";

/** How long nobody types before the text is read. */
const PAUSE = 250;

export class Editor {
  private readonly area = element("textarea", {
    id: "editor", spellcheck: "false", autocapitalize: "off", autocomplete: "off", "aria-label": "Mechanism file", rows: "18",
  });
  private timer = 0;
  private own = false;

  constructor(private readonly model: Model) {
    const save = button("Save file", () => download(model.file.file || "mechanism.ron", this.area.value, "text/plain"));
    find("file").append(this.area, element("ul", { id: "problems" }), element("p", {}, save));
    this.area.addEventListener("input", () => {
      clearTimeout(this.timer);
      this.timer = setTimeout(() => this.read(), PAUSE);
    });
    model.onLoaded(() => {
      if (!this.own) this.area.value = model.file.text;
    });
    model.onBlank(() => {
      this.area.value = model.file.text;
      this.problems([]);
    });
    model.onProblems((problems) => this.problems(problems));
  }

  private read() {
    this.own = true;
    const { file, set } = this.model.file;
    this.model.load({ file, text: this.area.value, set }, this.model.place());
    this.own = false;
  }

  private problems(problems: Problem[]) {
    const shown = problems.map((problem) => {
      const place = button(`${problem.line}:${problem.column}`, () => {
        this.area.focus();
        this.area.setSelectionRange(problem.from, problem.to);
        const line = this.area.scrollHeight / this.area.value.split("\n").length;
        this.area.scrollTop = (problem.line - 4) * line;
      });
      const help = problem.help ? element("span", { class: "soft" }, ` (${problem.help})`) : "";
      return element("li", { class: problem.severity, "data-line": String(problem.line), "data-column": String(problem.column) },
        place, ` ${problem.severity}: ${problem.title}`, help);
    });
    find("problems").replaceChildren(...shown);
    find("file").closest("details")!.classList.toggle("wrong", problems.some((p) => p.severity === "error"));
  }
}

/** Gives a file to the user. */
export function download(name: string, content: BlobPart, type: string) {
  const address = URL.createObjectURL(new Blob([content], { type }));
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}
