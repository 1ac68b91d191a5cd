// What the solver replies, as src/page.rs and src/show/scene.rs write it.

export type Triple = [number, number, number];

export interface BodyShape {
  name: string;
  ground: boolean;
  platform: boolean;
  lines: Triple[][];
  corners: Triple[];
}

export type JointKind =
  | "revolute" | "prismatic" | "helical" | "cylindrical" | "universal" | "spherical" | "planar" | "rigid";

export interface JointShape {
  names: string[];
  kind: JointKind;
  at: Triple;
  axes: Triple[];
  bodies: [number, number];
  driven: boolean;
  closure: boolean;
}

export interface Rod {
  name: string;
  ends: [Triple, Triple];
  bodies: [number, number];
  driven: boolean;
}

/** The pitch circle of a gear. */
export interface Wheel {
  body: number;
  at: Triple;
  axis: Triple;
  radius: number;
}

/** A force in N and a moment in N·m. */
export interface Arrow {
  name: string;
  applied: boolean;
  at: Triple;
  force: Triple;
  moment: Triple;
}

/** The screw about which a body moves; of a translation without pitch. */
export interface Screw {
  name: string;
  at: Triple;
  along: Triple;
  pitch: number | null;
}

/** A spring or a damper; at a hinge both ends are one point, and it has an axis. */
export interface SpringShape {
  name: string;
  ends: [Triple, Triple];
  axis: Triple | null;
  elastic: boolean;
  damping: boolean;
}

export interface Scene {
  mechanism: string;
  normal: Triple | null;
  bodies: BodyShape[];
  joints: JointShape[];
  rods: Rod[];
  wheels?: Wheel[];
  arrows?: Arrow[];
  screws?: Screw[];
  springs?: SpringShape[];
  /** Centres of mass, with the weights there in N. */
  weights?: { name: string; at: Triple; force: Triple }[];
  frames?: { name: string; at: Triple; axes: [Triple, Triple, Triple] }[];
}

/** A configuration: joints in rad and m; platforms as position and unit quaternion, scalar first. */
export interface State {
  joints: number[];
  platforms: [Triple, [number, number, number, number]][];
}

/** A number in rad or m and as it is read, in degrees or m. */
export type Shown = [number, string];

export interface Frame {
  said: string | null;
  assembled: boolean;
  scene: Scene;
  at: State;
  values: Shown[];
  held: string[] | null;
  /** Joints at a limit, with words for it. */
  limits: [string, string][];
  /** Whether it was pulled through a dead point of what is held, on to another branch. */
  crossed: boolean;
  figures: { condition: number | null; shown: string; stopped: boolean } | null;
  forces: Forces | { error: string } | null;
  quantities: Named[] | { error: string } | null;
}

/** A name and a value as it is read. */
export type Named = [string, string];

/** What a load calls for. */
export interface Forces {
  held: Named[];
  /** Beside each arrow of the scene: its force, and its moment. */
  arrows: string[];
  moments: string[];
  /** What nothing balances. */
  unbalanced: string[];
}

/** A load: a force in N, in ground, at a point. */
export interface Press {
  point: string;
  force: Triple;
}

/** A point of a body, and its share in a place that bodies carry together. */
export interface Hold {
  body: number;
  offset: Triple;
  share: number;
}

export interface Grip {
  grip: Hold[];
  /** As a point is named; a rod is no body. */
  name: string | null;
}

/** Freedoms gained, each as pictures from one side to the other. */
export interface Gained {
  scene: Scene | null;
  words: string[];
  swings: Scene[][];
}

export interface Coordinate {
  name: string;
  angle: boolean;
  joint: boolean;
  driven: boolean;
  range: [number, number];
  limits: [number, number] | null;
}

export interface Parameter {
  name: string;
  written: string;
  value: number;
  angle: boolean;
  free: boolean;
}

export interface Mechanism {
  name: string;
  source: string | null;
  length: number;
  coordinates: Coordinate[];
  parameters: Parameter[];
  outputs: string[];
  /** Whether it has masses, springs, forces or friction. */
  loaded: boolean;
}

export interface Problem {
  severity: "error" | "warning";
  line: number;
  column: number;
  from: number;
  to: number;
  title: string;
  label: string;
  help: string | null;
}

export interface Loaded extends Frame {
  mechanism: Mechanism;
  warnings: Problem[];
}

export interface Assembly {
  mode: number;
  certified: boolean;
  within_limits: boolean;
  outside_limits: string[];
  condition: number | null;
}

export interface Modes {
  report: { sentence: string; complete?: string; real: number; assemblies: Assembly[] };
  states: { at: State; scene: Scene }[];
}

export interface Row {
  at: State;
  special: { met: string } | null;
  points: Triple[];
}

/** The range of a quantity; `at_least` if it was not bounded on all of the curve. */
export interface Extremes {
  name: string;
  unit: string;
  constant?: number;
  least?: { value: number; inputs: number[] };
  greatest?: { value: number; inputs: number[] };
  unbounded?: unknown[];
  at_least?: boolean;
}

/** A motion by itself, with the sentences about it. */
export interface LetGo {
  said: string[];
  report: { columns: { name: string; unit: string }[]; rows: number[][] };
  states: Row[];
}

/** A design: its file, and how it is shown. */
export interface Design {
  file: string;
  sum_of_squares: number;
  defects: unknown[];
  scene: Scene | null;
  /** Of its point. */
  curve: Triple[];
  verdict: string;
  /** The largest deviation in words. */
  largest: string;
}

export interface Designs {
  /** How they were found, in sentences. */
  how: string[];
  report: { sentence: string; exact?: unknown; designs: Pick<Design, "file" | "sum_of_squares" | "defects">[] };
  states: Omit<Design, "file" | "sum_of_squares" | "defects">[];
}

export interface Swept {
  report: {
    sentence: string;
    motions: {
      ending: string;
      columns: string[];
      values: (number | null)[][];
      extremes?: Extremes[];
      met: { met: string; part: number | null; inputs: number[]; joints: number[] }[];
    }[];
  };
  states: Row[];
}

export type Request =
  | { do: "load"; text: string; set?: [string, string][]; held?: string[] | null; near?: State | null; load?: Press | null; quantities?: string }
  | { do: "move"; to: [string, number][] }
  | { do: "grab"; body: number; at: Triple }
  | { do: "grab"; rod: number; at: Triple }
  | { do: "pull"; grip: Hold[]; to: Triple; sight?: Triple }
  | { do: "press"; load: Press | null }
  | { do: "watch"; quantities: string }
  | { do: "gained" }
  | { do: "hold"; names: string[] }
  | { do: "go"; at: State }
  | { do: "ways" }
  | { do: "number"; text: string; measure: "angle" | "length" | "force" | "time" }
  | { do: "show"; at: State; frames?: boolean }
  | { do: "picture"; from?: [number, number] | null; labels?: boolean }
  | { do: "ask"; what: "solve" | "assemblies" | "mobility"; as_filed?: boolean }
  | { do: "sweep"; input?: [string, number, number]; steps: number; follow?: boolean; duration?: number; points?: string[]; report?: string[] }
  | { do: "let_go"; duration: number; rows: number; restitution: number | null; through: boolean; points: string[] }
  | { do: "design"; text: string | null; vary: [string, number, number][]; path: string; points: number[][]; any_order: boolean; more: string; starts: number; own: boolean; exact: boolean };

/** Why there is no answer. */
export class Refused extends Error {
  constructor(message: string, readonly problems: Problem[] = []) {
    super(message);
  }
}
