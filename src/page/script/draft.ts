// Changes of a drawing as changes of its file: every one leaves a file that can be read.
import { spotsOf } from "./board";
import type { Model } from "./model";
import { Changes, field, type Node, quoted, read } from "./ron";
import { distance, type Joint, localOf, numberOf, type Place, type Point, type Sketch, type Spot, type Tip, turned } from "./sketch";

/** An end of what is being drawn: on a body, on a point that it takes the place of, on ground, or free. */
export interface End {
  at: Point;
  body?: string;
  tip?: Tip;
  /** Where a joint has a place on the body already. */
  spot?: Spot;
}

export const EMPTY = `Axes(
    version: 1,
    name: "Drawing",
    // every link is drawn along x from its first pin; \`home\` turns it as it was drawn
    parameters: {},
    joints: {},
    points: {},
)
`;

const Z = "direction: (0, 0, 1)";

const degrees = (angle: number) => {
  const turns = angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
  return `${Number(((turns * 180) / Math.PI).toFixed(3))} deg`;
};

/** A length as it is written: in mm where that is shorter. */
export const metres = (length: number): string => (Math.abs(length) < 1e-9 ? "0" : quoted(`${Number((1000 * length).toFixed(3))} mm`));

const triple = (x: string, y: string) => `(${x}, ${y}, 0)`;

export class Draft {
  readonly root: Node;
  readonly changes: Changes;
  private readonly names = new Set<string>();
  /** Entries of sections that the file does not have yet. */
  private readonly missing = new Map<string, string[]>();

  constructor(private readonly model: Model, text: string, readonly sketch: Sketch) {
    this.root = read(text)!;
    this.changes = new Changes(text);
    for (const section of ["parameters", "joints", "points"]) {
      for (const { key, value } of field(this.root, section)?.entries ?? []) {
        this.names.add(key);
        for (const between of field(value, "between")?.entries ?? []) this.names.add(between.value.text);
      }
    }
    this.names.add("ground");
  }

  get text(): string {
    for (const [name, entries] of this.missing) this.changes.append(this.root, `${name}: {\n        ${entries.join(",\n        ")},\n    }`);
    this.missing.clear();
    return this.changes.done();
  }

  /** `link1`, or the first number that is free. */
  name(stem: string): string {
    for (let i = 1; ; i++) if (!this.names.has(`${stem}${i}`)) return this.taken(`${stem}${i}`);
  }

  /** A, B, …, Z, A1, … */
  letter(): string {
    for (let i = 0; ; i++) {
      const name = String.fromCharCode(65 + (i % 26)) + (i < 26 ? "" : String(Math.floor(i / 26)));
      if (!this.names.has(name)) return this.taken(name);
    }
  }

  private taken(name: string): string {
    this.names.add(name);
    return name;
  }

  private insert(section: string, entry: string) {
    const found = field(this.root, section);
    if (found) this.changes.append(found, entry);
    else this.missing.set(section, [...(this.missing.get(section) ?? []), entry]);
  }

  /** A new parameter; zero is written where it stands. */
  private parameter(name: string, value: string): string {
    if (value === "0") return value;
    while (this.names.has(name)) name += "_";
    this.insert("parameters", `${quoted(this.taken(name))}: ${value}`);
    return quoted(name);
  }

  private place(body: string): Place {
    return this.sketch.places.get(body) ?? { angle: 0, shift: [0, 0] };
  }

  /** A place on a body as it is written: that of a point in whose stead a joint stands, or two new parameters. */
  private spot(name: string, { at, tip, spot }: End, body: string): string {
    const there = tip?.spot ?? spot;
    if (there?.body === body) {
      const [x, y] = there.nodes.map((node) => this.changes.text.slice(node.from, node.to));
      return triple(x!, y!);
    }
    const [x, y] = localOf(this.place(body), at);
    const stem = body === "ground" ? name : `${body}_${name}`;
    return triple(this.parameter(`${stem}_x`, metres(x)), this.parameter(`${stem}_y`, metres(y)));
  }

  private bodyOf(end: End): string | null {
    return end.tip?.spot.body ?? end.body ?? null;
  }

  private joint(entry: string) {
    this.insert("joints", entry);
  }

  /** A joint that turns between what an end is on and a new body with a place on that; nothing if the end is free. */
  private pin(end: End, body: string, angle: number, place: string): string | null {
    const on = this.bodyOf(end);
    if (on === null) return null;
    const name = end.tip ? end.tip.name : this.letter();
    const at = this.spot(name, end, on);
    if (end.tip) this.changes.remove(end.tip.entry);
    const role = on === "ground" && !this.sketch.joints.some((of) => of.driven) && !this.drives ? ", role: Actuated" : "";
    this.drives ||= role !== "";
    const home = degrees(angle - this.place(on).angle);
    this.joint(`${quoted(name)}: Revolute(point: ${at}, ${Z}, second: (point: ${place}, ${Z})${role}, home: ${quoted(home)}, between: (${quoted(on)}, ${quoted(body)}))`);
    return name;
  }

  private drives = false;

  private tip(body: string, place: string, name = this.letter()) {
    this.insert("points", `${quoted(name)}: (body: ${quoted(body)}, at: ${place})`);
  }

  /** A link between two ends, one of which at least is on a body or on ground. */
  link(from: End, to: End) {
    if (this.bodyOf(from) === null) [from, to] = [to, from];
    const body = this.name("link");
    const angle = Math.atan2(to.at[1] - from.at[1], to.at[0] - from.at[0]);
    const length = this.parameter(`${body}_length`, metres(distance(from.at, to.at)));
    this.pin(from, body, angle, triple("0", "0"));
    const end = triple(length, "0");
    if (this.pin(to, body, angle, end) === null) this.tip(body, end);
  }

  /** A link that turns about a place on ground and carries a point. */
  ground(at: Point, tip: Tip) {
    const on = tip.spot.body;
    const name = tip.name;
    const place = this.spot(name, { at, tip }, on);
    this.changes.remove(tip.entry);
    const ground = this.spot(name, { at }, "ground");
    const home = degrees(this.place(on).angle);
    this.joint(`${quoted(name)}: Revolute(point: ${ground}, ${Z}, second: (point: ${place}, ${Z}), home: ${quoted(home)}, between: ("ground", ${quoted(on)}))`);
  }

  point(body: string, at: Point) {
    const name = this.letter();
    this.tip(body, this.spot(name, { at }, body), name);
  }

  /** A block on a straight guide, with a pin for what an end is on, or a point. */
  slider(from: End, angle: number, on = "ground") {
    const block = this.name("block");
    const name = this.name("slide");
    const turn = angle - this.place(on).angle;
    const straight = Math.abs(Math.sin(2 * turn)) < 1e-9;
    const written = straight ? null : this.parameter(`${name}_angle`, quoted(degrees(turn))).slice(1, -1);
    const [x, y] = written === null
      ? [String(Math.round(Math.cos(turn))), String(Math.round(Math.sin(turn)))]
      : [quoted(`cos(${written})`), quoted(`sin(${written})`)];
    const place = this.spot(name, { at: from.at }, on);
    this.joint(`${quoted(name)}: Prismatic(point: ${place}, direction: (${x}, ${y}, 0), second: (point: (0, 0, 0), direction: (1, 0, 0)), between: (${quoted(on)}, ${quoted(block)}))`);
    if (this.bodyOf(from) === null || from.body === "ground") this.tip(block, triple("0", "0"));
    else this.pin(from, block, angle, triple("0", "0"));
  }

  /** A rod with a ball at each end, driven or not. */
  rod(from: End, to: End) {
    const name = this.name("rod");
    const ends = [from, to].map((end, i) => {
      const on = this.bodyOf(end)!;
      return this.spot(`${name}_${"ab"[i]}`, end, on);
    });
    const length = this.parameter(`${name}_length`, metres(distance(from.at, to.at)));
    const bodies = [from, to].map((end) => quoted(this.bodyOf(end)!));
    this.joint(`${quoted(name)}: Distance(through: (${ends.join(", ")}), length: ${length}, between: (${bodies.join(", ")}))`);
  }

  /** The second joint is geared to the first: their wheels touch from outside. */
  gear(first: Joint, second: Joint) {
    const ratio = this.name("ratio");
    this.insert("parameters", `${quoted(ratio)}: 1`);
    const call = second.entry.value;
    this.drop(call, "role");
    this.drop(call, "home");
    this.changes.replace(call.to - 1, call.to - 1, `, value: ${quoted(`-${ratio}*${first.name}`)}`);
  }

  private drop(call: Node, key: string) {
    const entry = call.entries.find((of) => of.key === key);
    if (entry) this.changes.remove(entry);
  }

  /** Only this joint is driven, or no longer. */
  drive(joint: Joint) {
    for (const other of this.sketch.joints) {
      if (other !== joint && other.driven && !joint.driven) this.drop(other.entry.value, "role");
    }
    const call = joint.entry.value;
    if (joint.driven) return this.drop(call, "role");
    this.changes.replace(call.to - 1, call.to - 1, ", role: Actuated");
    if (joint.kind !== "Distance") return;
    // the length becomes its variable
    const length = call.entries.find((of) => of.key === "length");
    if (length) this.changes.replace(length.from, length.from + "length".length, "home");
  }

  /** Two bodies become one: all that the second carries is on the first. */
  weld(joint: Joint) {
    let [kept, gone] = joint.spots.map(({ body }) => body) as [string, string];
    if (gone === "ground") [kept, gone] = [gone, kept];
    this.changes.remove(joint.entry);
    this.rehang(gone, kept, () => true, joint);
  }

  /** A link becomes two, with a pin between them: what lies beyond that place goes to the second. */
  split(body: string, at: Point) {
    const spots = spotsOf(this.sketch, body);
    const [first] = spots;
    if (!first) return;
    const beyond = (spot: Spot) => distance(spot.at, at) < distance(spot.at, first.at) && spot !== first;
    const other = this.name("link");
    const place = this.place(body);
    this.sketch.places.set(other, { angle: place.angle, shift: at });
    this.pin({ at, body }, other, place.angle, triple("0", "0"));
    this.rehang(body, other, beyond);
    if (!spots.some(beyond)) this.tip(other, this.spot("end", { at: [at[0] + 0.5 * (at[0] - first.at[0]), at[1] + 0.5 * (at[1] - first.at[1])] }, other));
  }

  /** Hangs what stands on a body on another one instead, where it is. */
  private rehang(from: string, to: string, which: (spot: Spot) => boolean, but?: Joint) {
    const { joints, tips } = this.sketch;
    for (const joint of joints.filter((of) => of !== but)) {
      joint.spots.forEach((spot, i) => {
        if (spot.body !== from || !which(spot)) return;
        const between = field(joint.entry.value, "between")!.entries[i]!.value;
        this.changes.replace(between.from, between.to, quoted(to));
        this.rewrite(spot, to, `${to}_${joint.name}`);
        if (joint.kind === "Revolute") this.home(joint, i, this.place(to).angle);
      });
    }
    for (const { name, entry, spot } of tips) {
      if (spot.body !== from || !which(spot)) continue;
      const body = field(entry.value, "body")!;
      this.changes.replace(body.from, body.to, quoted(to));
      this.rewrite(spot, to, `${to}_${name}`);
    }
  }

  /** The angle at which a joint stands if one of its bodies is turned so. */
  private home(joint: Joint, end: number, angle: number) {
    const angles = joint.spots.map(({ body }) => this.place(body).angle);
    angles[end] = angle;
    this.setHome(joint, degrees(angles[1]! - angles[0]!));
  }

  setHome(joint: Joint, written: string) {
    const home = field(joint.entry.value, "home");
    const angle = joint.kind === "Revolute";
    const [before, now] = [home?.text ?? "0", written].map((text) => numberOf(this.model, { kind: "string", text, from: 0, to: 0, entries: [] }, angle ? "angle" : "length"));
    const apart = before! - now!;
    if (Math.abs(angle ? apart - 2 * Math.PI * Math.round(apart / (2 * Math.PI)) : apart) < 1e-5) return;
    if (home) this.changes.replace(home.from, home.to, quoted(written));
    else if (!joint.follows) this.changes.replace(joint.entry.value.to - 1, joint.entry.value.to - 1, `, home: ${quoted(written)}`);
  }

  private rewrite(spot: Spot, body: string, stem: string) {
    const local = localOf(this.place(body), spot.at);
    spot.nodes.forEach((node, i) => {
      this.changes.replace(node.from, node.to, this.parameter(`${stem}_${"xy"[i]}`, metres(local[i]!)));
    });
  }

  /** What is deleted leaves points where it was joined. */
  removeJoint(joint: Joint) {
    this.changes.remove(joint.entry);
    let name: string | undefined = joint.name;
    for (const spot of joint.spots) {
      if (spot.body === "ground" || joint.kind === "Prismatic") continue;
      const [x, y] = spot.nodes.map((node) => this.changes.text.slice(node.from, node.to));
      if (spotsOf(this.sketch, spot.body).length > 1) this.tip(spot.body, triple(x!, y!), name ?? this.letter());
      name = undefined;
    }
  }

  removeBody(body: string) {
    for (const joint of this.sketch.joints.filter((of) => of.spots.some((spot) => spot.body === body))) {
      this.changes.remove(joint.entry);
      for (const spot of joint.spots) {
        if (spot.body === body || spot.body === "ground") continue;
        const [x, y] = spot.nodes.map((node) => this.changes.text.slice(node.from, node.to));
        this.tip(spot.body, triple(x!, y!));
      }
    }
    for (const { entry, spot } of this.sketch.tips) if (spot.body === body) this.changes.remove(entry);
  }

  removeTip(tip: Tip) {
    this.changes.remove(tip.entry);
  }

  /** Two points, or a point and a joint's place on a body, become one joint. */
  attach(tip: Tip, to: End) {
    const on = this.bodyOf(to);
    if (on === null || on === tip.spot.body) return;
    if (on === "ground") return this.ground(to.at, tip);
    const name = tip.name;
    const [x, y] = tip.spot.nodes.map((node) => this.changes.text.slice(node.from, node.to));
    const at = this.spot(name, to, on);
    this.changes.remove(tip.entry);
    if (to.tip) this.changes.remove(to.tip.entry);
    const home = degrees(this.place(tip.spot.body).angle - this.place(on).angle);
    this.joint(`${quoted(name)}: Revolute(point: ${at}, ${Z}, second: (point: ${triple(x!, y!)}, ${Z}), home: ${quoted(home)}, between: (${quoted(on)}, ${quoted(tip.spot.body)}))`);
  }

  /** Writes a coordinate: where one parameter alone stands there, into that. */
  write(node: Node, value: number) {
    if (Math.abs(numberOf(this.model, node) - value) < 1e-9) return;
    const parameter = node.kind === "string" ? field(this.root, "parameters")?.entries.find(({ key }) => key === node.text) : undefined;
    const into = parameter && !Number.isNaN(numberOf(this.model, parameter.value)) ? parameter.value : node;
    this.changes.replace(into.from, into.to, metres(value));
  }

  /** A pin or a point at another place: the links it joins change their lengths and turn. */
  move(spots: Spot[], to: Point) {
    const moved = (spot: Spot) => (spots.includes(spot) ? to : spot.at);
    const places = new Map(this.sketch.places);
    for (const body of new Set(spots.map((spot) => spot.body))) {
      const all = spotsOf(this.sketch, body);
      const first = all.find(({ local }) => local[0] === 0 && local[1] === 0);
      const second = all.find(({ local, nodes }) => local[0] > 0 && nodes[1].text === "0");
      if (body !== "ground" && first) {
        const [a, b] = [moved(first), second ? moved(second) : null];
        const angle = b && distance(a, b) > 1e-9 ? Math.atan2(b[1] - a[1], b[0] - a[0]) : this.place(body).angle;
        places.set(body, { angle, shift: a });
      }
      const place = places.get(body)!;
      for (const spot of all) {
        const local = localOf(place, moved(spot));
        spot.nodes.forEach((node, i) => this.write(node, local[i]!));
      }
    }
    this.homes(places);
  }

  /** The joints as they stand where the bodies are. */
  homes(places: Map<string, Place>) {
    for (const joint of this.sketch.joints) {
      if (!joint.apart || joint.follows) continue;
      const [first, second] = joint.spots.map(({ body }) => places.get(body)!) as [Place, Place];
      if (joint.kind === "Revolute") this.setHome(joint, degrees(second.angle - first.angle));
      else {
        const [guide, block] = joint.spots;
        const [from, to] = [placedBy(first, guide.local), placedBy(second, block.local)];
        const along = (to[0] - from[0]) * Math.cos(joint.along) + (to[1] - from[1]) * Math.sin(joint.along);
        this.setHome(joint, `${Number((1000 * along).toFixed(3))} mm`);
      }
    }
  }
}

function placedBy(place: Place, local: Point): Point {
  const [x, y] = turned(local, place.angle);
  return [x + place.shift[0], y + place.shift[1]];
}
