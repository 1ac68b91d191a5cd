// The tools of the drawing board.
import type { Desk } from "./desk";
import type { Snapped } from "./snapping";

export interface Tool {
  name: string;
  key: string;
  hint: string;
  /** At a click. */
  click?(desk: Desk, at: Snapped): void;
  /** From a press to a release, or from one click to the next. */
  line?(desk: Desk, from: Snapped, to: Snapped): void;
  /** Whether it can begin there. */
  begins?(desk: Desk, at: Snapped): boolean;
}

/** On a body, on ground or on a point. */
const held = (end: Snapped) => end.body !== undefined;

export const TOOLS: Tool[] = [
  {
    name: "Move", key: "V", hint: "Drag a pin or a point; a point that is dropped on a pin or a link is joined to it.",
    begins: (desk, at) => {
      const pin = desk.pins.findIndex((of) => of[0] === at.at[0] && of[1] === at.at[1]);
      const found = pin >= 0 || at.tip !== undefined || at.joint !== undefined;
      if (!found) desk.say("Drag a pin or a point.");
      return found;
    },
    line: (desk, from, to) => {
      const pin = desk.pins.findIndex((of) => of[0] === from.at[0] && of[1] === from.at[1]);
      if (pin >= 0 && !from.joint) return void (desk.pins = desk.pins.with(pin, to.at));
      const { tip } = from;
      if (tip && held(to) && to.body !== tip.spot.body) {
        desk.change((draft) => draft.attach(tip, to));
        return desk.used(to);
      }
      desk.change((draft) => draft.move(desk.together(from.at), to.at));
    },
  },
  {
    name: "Ground", key: "G", hint: "Click where a pin is fixed to ground; on a point, that is pinned to ground.",
    click: (desk, at) => {
      if (at.tip) return desk.change((draft) => draft.ground(at.at, at.tip!));
      if (!at.joint && !at.link) desk.pins = [...desk.pins, at.at];
    },
  },
  {
    name: "Link", key: "L", hint: "Draw from a pin, a point or a link to another, or to a free place.",
    line: (desk, from, to) => {
      if (!held(from) && !held(to)) return desk.say("One end of a link is on a pin, a point or another link: place a ground pin first.");
      if (from.at[0] === to.at[0] && from.at[1] === to.at[1]) return;
      desk.change((draft) => draft.link(from, to));
      desk.used(from, to);
    },
  },
  {
    name: "Point", key: "P", hint: "Draw from a link to where the point is that moves with it.",
    begins: (desk, at) => {
      const found = at.body !== undefined && at.body !== "ground";
      if (!found) desk.say("Begin on a link.");
      return found;
    },
    line: (desk, from, to) => desk.change((draft) => draft.point(from.link ?? desk.sketch!.joints.find((of) => of === from.joint)?.spots[1].body ?? from.body!, to.at)),
  },
  {
    name: "Slider", key: "S", hint: "Draw from a point along its guide; the guide is fixed to ground, or to the link on which you end.",
    line: (desk, from, to) => {
      const angle = Math.atan2(to.at[1] - from.at[1], to.at[0] - from.at[0]);
      const on = to.link && to.link !== from.body ? to.link : "ground";
      desk.change((draft) => draft.slider(from, angle, on));
    },
  },
  {
    name: "Rod", key: "R", hint: "Draw a rod, or a cylinder if you drive it, between links, points or pins.",
    line: (desk, from, to) => {
      if (!held(from) || !held(to) || from.body === to.body) return desk.say("A rod joins two different links, or a link and a ground pin.");
      desk.change((draft) => draft.rod(from, to));
      desk.used(from, to);
    },
  },
  {
    name: "Gear", key: "E", hint: "Draw from the pin of one wheel to that of another on the same link or ground.",
    line: (desk, { joint: first }, { joint: second }) => {
      if (!first || !second || first === second || first.spots[0].body !== second.spots[0].body) return desk.say("Gears turn about two pins of one link or of ground.");
      desk.change((draft) => draft.gear(first, second));
    },
  },
  {
    name: "Drive", key: "D", hint: "Click the joint or the rod that is driven.",
    click: (desk, { joint }) => {
      if (!joint) return desk.say("Click a joint or a rod.");
      desk.change((draft) => draft.drive(joint));
    },
  },
  {
    name: "Weld", key: "W", hint: "Click a pin: the two links that it joins become one.",
    click: (desk, { joint }) => {
      if (!joint || joint.kind !== "Revolute" || joint.spots.some(({ body }) => body === "ground")) return desk.say("Click a pin between two links.");
      desk.change((draft) => draft.weld(joint));
    },
  },
  {
    name: "Split", key: "X", hint: "Click a link: it becomes two, with a pin there.",
    click: (desk, { link, at }) => {
      if (!link) return desk.say("Click a link between its pins.");
      desk.change((draft) => draft.split(link, at));
    },
  },
  {
    name: "Delete", key: "Delete", hint: "Click a pin, a point or a link.",
    click: (desk, { tip, joint, link, at }) => {
      const pin = desk.pins.findIndex((of) => of[0] === at[0] && of[1] === at[1]);
      if (tip) desk.change((draft) => draft.removeTip(tip));
      else if (joint) desk.change((draft) => draft.removeJoint(joint));
      else if (pin >= 0) desk.pins = desk.pins.toSpliced(pin, 1);
      else if (link) desk.change((draft) => draft.removeBody(link));
    },
  },
  {
    name: "Trace", key: "T", hint: "Click a point: the mechanism moves and draws its path.",
    click: (desk, { tip }) => {
      if (!tip) return desk.say("Click a point; draw one on a link with the tool Point.");
      desk.trace(tip.name);
    },
  },
];
