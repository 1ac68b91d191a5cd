// Long work beside the picture: the same solver in a worker, which is ended where nobody waits any more.
import { Solver } from "./solver";
import { Refused, type Request } from "./types";

interface Work {
  module: WebAssembly.Module;
  requests: Request[];
}

onmessage = async (event: MessageEvent<Work>) => {
  const solver = await Solver.of(event.data.module);
  try {
    let reply: unknown;
    for (const request of event.data.requests) reply = solver.ask(request);
    postMessage({ reply });
  } catch (error) {
    const problems = error instanceof Refused ? error.problems : [];
    postMessage({ error: error instanceof Error ? error.message : String(error), problems });
  }
};
