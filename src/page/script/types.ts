// What the solver replies, as src/page.rs and src/scene.rs write it.

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
  driven: boolean;
}

/** The pitch circle of a gear. */
export interface Wheel {
  body: number;
  at: Triple;
  axis: Triple;
  radius: number;
}

export interface Scene {
  mechanism: string;
  normal: Triple | null;
  bodies: BodyShape[];
  joints: JointShape[];
  rods: Rod[];
  wheels?: Wheel[];
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
  figures: { condition: number | null; shown: string } | null;
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
  text: string;
  states: { at: State; scene: Scene }[];
}

export interface Row {
  at: State;
  special: { met: string } | null;
  points: Triple[];
}

export interface Swept {
  report: {
    motions: {
      sentence: string;
      ending: string;
      columns: string[];
      values: (number | null)[][];
      extremes?: { name: string; unbounded?: unknown[] }[];
      met: { met: string; part: number | null; inputs: number[]; joints: number[] }[];
    }[];
  };
  text: string;
  states: Row[];
}

export type Request =
  | { do: "load"; text: string; set?: [string, string][]; held?: string[] | null; near?: State | null }
  | { do: "move"; to: [string, number][] }
  | { do: "grab"; body: number; at: Triple }
  | { do: "pull"; body: number; offset: Triple; to: Triple; sight?: Triple }
  | { do: "hold"; names: string[] }
  | { do: "go"; at: State }
  | { do: "show"; at: State }
  | { do: "picture"; from?: [number, number] | null; labels?: boolean }
  | { do: "ask"; what: "solve" | "assemblies" | "mobility"; as_filed?: boolean }
  | { do: "sweep"; input?: [string, number, number]; steps: number; follow?: boolean; points?: string[]; report?: string[] };

/** Why there is no answer. */
export class Refused extends Error {
  constructor(message: string, readonly problems: Problem[] = []) {
    super(message);
  }
}
