// Quantities that are read as the mechanism moves: those of the file and the transmission angle, or a list of one's own.
import { element, find } from "./elements";
import type { Model } from "./model";
import { rounded } from "./values";

export class Quantities {
  private readonly list = element("input", {
    type: "text", id: "watched", placeholder: "other quantities, e.g. condition", "aria-label": "Quantities to read",
  });

  constructor(private readonly model: Model) {
    find("quantities").append(element("table", {}, element("tbody", { id: "readings" })), this.list, element("p", { id: "readings-said", class: "poor" }));
    this.list.addEventListener("change", () => model.watch(this.list.value.trim()));
    model.onLoaded(() => (this.list.value = model.quantities));
    model.onMoved(() => this.show());
  }

  private show() {
    const read = this.model.frame?.quantities ?? [];
    const rows = "error" in read ? [] : read;
    find("readings-said").textContent = "error" in read ? read.error : "";
    find("readings").replaceChildren(...rows.map(([name, shown]) =>
      element("tr", {}, element("th", { scope: "row" }, name), element("td", { class: "right", title: shown }, rounded(shown)))));
  }
}
