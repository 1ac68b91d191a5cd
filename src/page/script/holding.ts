// What is held: a tick holds a value in place of another; presets for direct and inverse kinematics.
import { button, element, find } from "./elements";
import type { Model } from "./model";

export class Holding {
  /** What somebody has ticked: it gives way last. */
  private chosen: string[] = [];
  private file = "";

  constructor(private readonly model: Model) {
    model.onLoaded(() => {
      if (model.file.text !== this.file) this.chosen = [];
      this.file = model.file.text;
      this.presets();
    });
    model.onMoved(() => find("ask").replaceChildren());
  }

  private get held(): string[] {
    return this.model.frame?.held ?? [];
  }

  private get driven(): string[] {
    return this.model.mechanism?.coordinates.filter((of) => of.driven).map((of) => of.name) ?? [];
  }

  /** Holds a value; the last driven joint that it can replace gives way, or else what somebody says. */
  hold(name: string) {
    const before = this.held;
    const works = (released: string) => this.model.could([...before.filter((held) => held !== released), name], before) !== null;
    const inFile = new Set(this.driven);
    const given = before.filter((held) => !this.chosen.includes(held)).toSorted((a, b) => Number(inFile.has(a)) - Number(inFile.has(b)));
    const released = given.toReversed().find(works);
    if (released !== undefined) return this.replace(released, name);
    const others = this.chosen.filter((held) => before.includes(held) && works(held));
    if (others.length === 1) return this.replace(others[0]!, name);
    this.model.again();
    if (others.length) this.ask(`${name} can be held in place of`, others, (released) => this.replace(released, name));
    else this.model.say(`${name} cannot be held in place of any of these: it depends on them or does not move.`);
  }

  /** Lets go of a value; the driven joint that it stood for is held again, or else what somebody says. */
  release(name: string) {
    const rest = this.held.filter((held) => held !== name);
    const works = (other: string) => this.model.could([...rest, other], [...rest, name]) !== null;
    const free = this.model.mechanism!.coordinates.map((of) => of.name).filter((other) => other !== name && !rest.includes(other));
    const driven = this.driven.filter((other) => free.includes(other)).find(works);
    if (driven !== undefined) return this.replace(name, driven, false);
    const others = free.filter(works);
    this.model.again();
    if (others.length) this.ask(`In place of ${name}, hold`, others, (other) => this.replace(name, other));
    else this.model.say(`${name} is needed: nothing else determines the configuration in its place.`);
  }

  /** The driven joints are held. */
  direct() {
    this.chosen = [];
    if (!this.model.holds(this.driven)) this.model.say("The driven joints do not determine the configuration here.");
    this.presets();
  }

  /** As many coordinates of a platform as there are freedoms are held: those that determine the configuration best. */
  inverse(platform: string) {
    const before = this.held;
    const own = this.model.mechanism!.coordinates.map((of) => of.name).filter((name) => name.startsWith(`${platform}.`));
    const count = Math.min(before.length, own.length);
    const driven = this.driven.slice(0, before.length - count);
    const tried = choices(own, count).map((names) => ({ names: [...driven, ...names], condition: this.model.could([...driven, ...names], before) }));
    const [best] = tried.filter(({ condition }) => condition !== null).toSorted((a, b) => a.condition! - b.condition!);
    if (!best) {
      this.model.again();
      return this.model.say(`The coordinates of ${platform} do not determine the configuration.`);
    }
    this.model.holds(best.names);
    this.chosen = best.names.filter((of) => of.startsWith(`${platform}.`));
    this.model.say("");
    this.presets();
  }

  private replace(released: string, name: string, chosen = true) {
    const names = [...this.held.filter((held) => held !== released), name];
    this.chosen = [...this.chosen.filter((held) => held !== released), ...(chosen ? [name] : [])];
    this.model.holds(names);
    this.model.say(`${name} is held in place of ${released}.`);
    this.presets();
  }

  private ask(words: string, names: string[], act: (name: string) => void) {
    const buttons = names.slice(0, 12).flatMap((name) => [" ", button(name, () => act(name), { "data-choice": name })]);
    this.model.say("");
    find("ask").replaceChildren(words, ...buttons);
    find("ask").querySelector("button")?.focus();
  }

  private presets() {
    const { mechanism } = this.model;
    if (!mechanism) return;
    const platforms = [...new Set(mechanism.coordinates.filter((of) => !of.joint).map((of) => of.name.slice(0, of.name.lastIndexOf("."))))];
    const held = new Set(this.held);
    const direct = this.driven.length === held.size && this.driven.every((name) => held.has(name));
    const buttons = [
      button("Direct", () => this.direct(), { id: "direct", title: "Hold the driven joints", "aria-pressed": String(direct) }),
      ...platforms.map((name) => {
        const inverse = held.size > 0 && [...held].every((of) => of.startsWith(`${name}.`));
        const title = `Hold coordinates of ${name}`;
        return button(platforms.length > 1 ? `Inverse: ${name}` : "Inverse", () => this.inverse(name), { "data-inverse": name, title, "aria-pressed": String(inverse) });
      }),
    ];
    const useful = this.driven.length > 0 && held.size > 0 && (platforms.length > 0 || !direct);
    find("presets").replaceChildren(...(useful ? buttons.flatMap((of) => [of, " "]) : []));
    find("presets").append(element("span", { id: "ask", role: "group", "aria-live": "polite" }));
  }
}

/** All choices of so many. */
function choices(all: string[], count: number): string[][] {
  if (count === 0) return [[]];
  return all.flatMap((first, i) => choices(all.slice(i + 1), count - 1).map((rest) => [first, ...rest]));
}
