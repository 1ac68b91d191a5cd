// Assemblies in groups: those that only differ in their legs share a pose of the platforms.
import type { Modes, State } from "./types";

/** Closer than this poses are one, in m and parts of a quaternion. */
const SAME = 1e-6;

export interface Pose {
  /** Numbers in the list of assemblies. */
  modes: number[];
}

export function poses({ states, report }: Modes): Pose[] {
  const found: { at: State; pose: Pose }[] = [];
  states.forEach(({ at }, i) => {
    const known = at.platforms.length ? found.find((of) => samePose(of.at, at)) : undefined;
    if (known) known.pose.modes.push(i);
    else found.push({ at, pose: { modes: [i] } });
  });
  // what is shown of a pose is the variant that is best conditioned
  const condition = (i: number) => report.assemblies[i]?.condition ?? Infinity;
  return found.map(({ pose }) => ({ modes: pose.modes.toSorted((a, b) => condition(a) - condition(b) || a - b) }));
}

function samePose(a: State, b: State): boolean {
  return a.platforms.every(([position, turn], k) => {
    const [other, otherTurn] = b.platforms[k]!;
    const apart = Math.max(...position.map((x, i) => Math.abs(x - other[i]!)));
    // a quaternion and its negative are one orientation
    const along = Math.abs(turn.reduce((sum, x, i) => sum + x * otherTurn[i]!, 0));
    return apart < SAME && 1 - along < SAME;
  });
}
