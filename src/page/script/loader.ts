// The only script that the page's policy names: it unpacks the script that does all the rest, and the solver beside it.
import { unpacked, unpackedSolver } from "./packed";

const failed = (error: unknown) => {
  const said = document.getElementById("said");
  if (said) said.textContent = `The page cannot start: ${error instanceof Error ? error.message : String(error)}`;
};

async function begin() {
  const script = await unpacked("script").blob();
  const made = document.createElement("script");
  made.src = URL.createObjectURL(new Blob([script], { type: "text/javascript" }));
  made.onerror = () => failed("its script was not let in");
  document.body.append(made);
  globalThis.solver = WebAssembly.compile(unpackedSolver());
}

begin().catch(failed);
