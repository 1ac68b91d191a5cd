// A page that `linkwork view --watch` serves asks for its file again and again, and shows it when it has changed.
import type { File, Model } from "./model";

const EVERY = 700;

export function watching(model: Model) {
  let last = model.file.text;
  const look = async () => {
    try {
      const file = (await (await fetch("file", { cache: "no-store" })).json()) as File;
      if (file.text !== last) {
        last = file.text;
        model.load(file, model.place());
      }
    } catch {
      // the program has ended, or the file is just being written
    }
    setTimeout(() => void look(), EVERY);
  };
  setTimeout(() => void look(), EVERY);
}
