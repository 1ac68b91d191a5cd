// Colours of the picture, light and dark. Those of bodies are told apart by any colour vision (M. Okabe, K. Ito 2008).
import { Color } from "three";

export const BODIES = ["#0072B2", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#8a7a2a"];

export interface Theme {
  paper: string;
  ink: string;
  ground: string;
  plate: string;
  joint: string;
  /** A joint in space, where white would be lost on paper. */
  solid: string;
  driven: string;
  trace: string;
  ghost: string;
  load: string;
  reaction: string;
  gained: string;
  /** Springs and weights of the file. */
  acts: string;
}

const LIGHT: Theme = {
  paper: "#fdfdfc", ink: "#222222", ground: "#777777", plate: "#cfcfcc", joint: "#ffffff", solid: "#c4c4c0", driven: "#E69F00",
  trace: "#D55E00", ghost: "#b8b8b8", load: "#D55E00", reaction: "#007a58", gained: "#a8437f", acts: "#6a4fb0",
};
const DARK: Theme = {
  paper: "#191a1b", ink: "#e4e4e0", ground: "#9a9a96", plate: "#45474a", joint: "#2a2c2e", solid: "#d9d9d6", driven: "#E69F00",
  trace: "#ff8c42", ghost: "#55585c", load: "#ff8c42", reaction: "#3fc79b", gained: "#e39ac6", acts: "#b7a3f0",
};

const dark = matchMedia("(prefers-color-scheme: dark)");

export const theme = (): Theme => (dark.matches ? DARK : LIGHT);

export const onThemeChange = (act: () => void) => dark.addEventListener("change", act);

/** Bodies are a little lighter on dark paper. */
export function bodyColour(index: number): string {
  const colour = new Color(BODIES[index % BODIES.length]);
  return dark.matches ? `#${colour.lerp(new Color("#ffffff"), 0.25).getHexString()}` : `#${colour.getHexString()}`;
}
