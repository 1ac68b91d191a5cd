// Files of spatial mechanisms by their kind: a platform on legs, a closed loop of joints. Dimensions are parameters.
import { quoted } from "./ron";

/** Kinds of legs from the base to the platform, the driven joint underlined in the literature. */
export const LEGS = ["UPS", "SPS", "RPS", "PRS", "RRS", "RUS", "PUS", "RSS", "PSS", "RRR", "RPR", "PRR"];

/** Legs in space with five freedoms. */
export const FIVE = /^(RPS|PRS|RRS)$/;

const file = (name: string, parameters: string[], joints: string[], more = "") => `Axes(
    version: 1,
    name: ${quoted(name)},
    parameters: {
        ${parameters.join("\n        ")}
    },
    joints: {
        ${joints.join("\n        ")}
    },${more}
)
`;

const triple = (...of: (string | number)[]) => `(${of.map((x) => (typeof x === "number" || x === "0" ? x : quoted(x))).join(", ")})`;

/** A platform on legs of one kind; three-letter kinds whose axes are parallel make a planar one. */
export function platform(legs: number, kind: string): string {
  const planar = /^[RP]+$/.test(kind);
  const z = (part: number) => (planar ? "0" : part === 1 ? "height" : `${part}*height`);
  const joints = Array.from({ length: legs }, (_, k) => {
    const pairs = !planar && legs > 4;
    // pairs of legs that stand near one another on the base go to different corners of the platform; four legs that met in
    // one point would hold no more than three
    const corner = Math.floor((k + 1) / 2) * 120;
    const turn = pairs ? `${Math.floor(k / 2) * 120} deg ${k % 2 ? "+" : "-"} spread` : `${Math.round((360 * k) / legs)} deg`;
    const far = pairs ? `${corner - 60} deg ${k % 2 ? "-" : "+"} spread` : planar ? `${turn} + 25 deg` : legs === 4 ? `${turn} ${k < 2 ? "-" : "+"} spread` : turn;
    const on = (radius: string, angle: string) => [`${radius}*cos(${angle})`, `${radius}*sin(${angle})`] as const;
    const base = on("base", turn);
    const top = on("top", far);
    const knee = on("(base + top)*0.7", turn);
    const places = [[...base, "0"], [...knee, z(0.5)], [...top, z(1)]];
    const tangent = planar ? ["0", "0", 1] : [`-sin(${turn})`, `cos(${turn})`, "0"];
    const along = [`${top[0]} - ${base[0]}`, `${top[1]} - ${base[1]}`, z(1)];
    const telescopes = kind[1] === "P";
    const driven = Math.max(kind.indexOf("P"), 0);
    const rod = kind.endsWith("SS");
    return [...kind].flatMap((letter, i) => {
      const last = i === 2;
      if (rod && i === 2) return [];
      const between = `between: (${quoted(i === 0 ? "ground" : `leg ${k + 1}${"abc"[i - 1]}`)}, ${quoted(last || (rod && i === 1) || kind === "SPS" ? "platform" : `leg ${k + 1}${"abc"[i]}`)})`;
      const role = i === driven ? "role: Actuated, " : "";
      const name = quoted(`${letter.toLowerCase()}${k + 1}${kind.indexOf(letter) === kind.lastIndexOf(letter) ? "" : "abc"[i]}`);
      if (kind === "SPS") {
        return i === 1 ? [`"l${k + 1}": Distance(through: (${triple(...places[0]!)}, ${triple(...places[2]!)}), role: Actuated, between: ("ground", "platform")),`] : [];
      }
      // a joint that slides at the base carries the next one where it stands; a leg that telescopes has no knee
      const place = telescopes || kind[0] === "P" ? places[last ? 2 : 0]! : places[i]!;
      if (rod && i === 1) return [`"rod${k + 1}": Distance(through: (${triple(...place)}, ${triple(...places[2]!)}), between: (${quoted(`leg ${k + 1}a`)}, "platform")),`];
      if (letter === "P") {
        const way = telescopes ? triple(...along) : planar ? triple(...tangent.map((_, axis) => [`-sin(${turn})`, `cos(${turn})`, "0"][axis]!)) : "(0, 0, 1)";
        return [`${name}: Prismatic(point: ${triple(...place)}, direction: ${way}, ${role}${between}),`];
      }
      if (letter === "S") return [`${name}: Spherical(point: ${triple(...place)}, ${between}),`];
      if (letter === "U") return [`${name}: Universal(point: ${triple(...place)}, directions: (${triple(...tangent)}, ${triple(`cos(${turn})`, `sin(${turn})`, "0")}), ${between}),`];
      return [`${name}: Revolute(point: ${triple(...place)}, direction: ${triple(...tangent)}, ${role}${between}),`];
    });
  });
  const parameters = [`"base": "300 mm",`, `"top": "150 mm",`, ...(planar ? [] : [`"height": "350 mm",`]), ...(legs < 4 || planar ? [] : [`"spread": "12 deg",`])];
  const point = `\n    points: { "tool": (body: "platform", at: (0, 0, ${planar ? 0 : quoted("height")})) },`;
  return file(`${legs}-${kind}`, parameters, joints.flat(), `\n    bodies: { "platform": (origin: (0, 0, ${planar ? 0 : quoted("height")})) },${point}`);
}

/** How the axes of a loop lie. */
export const AXES = ["parallel", "through one point", "skew"];

/** A closed loop of joints by their axes, its first link on ground. */
export function loop(kinds: string, axes: string): string {
  const count = kinds.length;
  const joints = [...kinds].map((letter, i) => {
    const angle = `${Math.round((360 * i) / count)} deg`;
    const uneven = ["", "*1.15", "*0.9", "*1.05", "*0.85", "*1.1", "*0.95"][i % 7]!;
    const place = triple(`r${uneven}*cos(${angle})`, `r${uneven}*sin(${angle})`, "0");
    const skew = triple(`sin(twist)*cos(${97 * i} deg)`, `sin(twist)*sin(${97 * i} deg)`, "cos(twist)");
    const way = axes === "parallel" ? "(0, 0, 1)" : axes === "skew" ? skew : triple(`-r${uneven}*cos(${angle})`, `-r${uneven}*sin(${angle})`, "apex");
    const across = axes === "skew" ? triple(`-sin(${97 * i} deg)`, `cos(${97 * i} deg)`, "0") : triple(`-sin(${angle})`, `cos(${angle})`, "0");
    const name = quoted(`${letter.toLowerCase()}${i + 1}`);
    const bodies = [i, (i + 1) % count].map((body) => quoted(body ? `link ${body}` : "ground"));
    // the first joint turns its link against ground, the last one too
    const between = `between: (${bodies.join(", ")})`;
    const role = i === 0 && "RP".includes(letter) ? "role: Actuated, " : "";
    if (letter === "S") return `${name}: Spherical(point: ${place}, ${between}),`;
    if (letter === "U") return `${name}: Universal(point: ${place}, directions: (${way}, ${across}), ${between}),`;
    if (letter === "P") return `${name}: Prismatic(point: ${place}, direction: ${triple(`-sin(${angle})`, `cos(${angle})`, "0")}, ${role}${between}),`;
    return `${name}: ${letter === "C" ? "Cylindrical" : "Revolute"}(point: ${place}, direction: ${way}, ${role}${between}),`;
  });
  const more = { parallel: [], "through one point": [`"apex": "150 mm",`], skew: [`"twist": "50 deg",`] }[axes] ?? [];
  return file(`Loop ${kinds}`, [`"r": "100 mm",`, ...more], joints);
}

/** A four-bar anywhere in the plane, for a path of its coupler. */
export const FOUR_BAR = `Mechanism(
    version: 1,
    name: "Four-bar for a path",
    convention: Modified,
    parameters: { "ax": 0, "ay": 0, "bx": 0.3, "by": 0, "l1": 0.1, "l2": 0.3, "l3": 0.2 },
    joints: { "theta1": Actuated(home: "60 deg"), "phi2": Passive(home: "-39 deg"), "phi1": Passive(home: "104 deg") },
    chains: {
        "left": Chain(
            base: [Tx("ax"), Ty("ay")],
            rows: [(theta: "theta1", link: "crank"), (a: "l1", theta: "phi2", link: "coupler")],
            tip: [Tx("l2")],
        ),
        "right": Chain(base: [Tx("bx"), Ty("by")], rows: [(theta: "phi1", link: "rocker")], tip: [Tx("l3")]),
    },
    closures: { "B": Revolute("left", "right") },
)
`;
