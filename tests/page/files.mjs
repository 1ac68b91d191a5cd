// Every shipped mechanism file.
import { readdirSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

export const root = join(dirname(fileURLToPath(import.meta.url)), "../..");

const within = (folder) => readdirSync(join(root, folder)).filter((name) => name.endsWith(".ron")).sort().map((name) => join(folder, name));

export const files = ["mechanisms", "mechanisms/axes"].flatMap(within);

/** Those in which something acts. */
export const loads = within("mechanisms/loads");
