// What to begin with: an empty drawing, or a spatial mechanism by its kind.
import { button, element, find } from "./elements";
import type { Model } from "./model";
import { AXES, FIVE, LEGS, loop, platform } from "./templates";

export function newFile(model: Model, draw: () => void, leave: () => void) {
  const choice = (id: string, label: string, options: string[]) =>
    element("select", { id, "aria-label": label }, ...options.map((option) => element("option", {}, option)));
  const dialog = element("dialog", { id: "new-dialog", "aria-label": "New mechanism" });
  const legs = choice("legs", "Number of legs", ["3", "6", "4", "5", "2"]);
  const kind = choice("leg-kind", "Kind of leg", LEGS);
  const kinds = element("input", { type: "text", id: "loop-kinds", value: "RRRR", "aria-label": "Joints of the loop, letters R P C U S", autocomplete: "off" });
  const axes = choice("loop-axes", "Axes of the loop", AXES);
  const said = element("p", { id: "new-said", role: "status" });
  const open = (text: string, file: string) => {
    dialog.close();
    leave();
    model.load({ file, text, set: [] });
    find<HTMLDetailsElement>("file-part").open = true;
  };
  dialog.append(
    element("p", {}, button("Draw in the plane", () => {
      dialog.close();
      draw();
    }, { id: "new-drawing", autofocus: "" })),
    element("p", {}, "Platform on ", legs, " legs ", kind, " ", button("Make", () => {
      if (Number(legs.value) > 3 && FIVE.test(kind.value)) return void (said.textContent = `Each ${kind.value} leg takes a freedom from the platform: choose 2 or 3 legs.`);
      open(platform(Number(legs.value), kind.value), "platform.ron");
    }, { id: "new-platform" })),
    element("p", {}, "Loop of joints ", kinds, " with axes ", axes, " ", button("Make", () => {
      const letters = kinds.value.trim().toUpperCase();
      if (!/^[RPCUS]{3,8}$/.test(letters)) return void (said.textContent = "Three to eight letters: R turns, P slides, C does both, U and S are universal and ball joints.");
      open(loop(letters, axes.value), "loop.ron");
    }, { id: "new-loop" })),
    said,
    element("form", { method: "dialog" }, element("button", {}, "Close")),
  );
  document.body.append(dialog);
  find("new").addEventListener("click", () => {
    said.textContent = "";
    dialog.showModal();
  });
}
