// The library in WebAssembly: JSON in, JSON out (src/page/abi.rs).
import { stillClock } from "./clock";
import { Refused, type Request } from "./types";

declare global {
  /** The solver, which loader.ts compiles. */
  var solver: Promise<WebAssembly.Module>;
}

interface Exports {
  memory: WebAssembly.Memory;
  room(bytes: number): number;
  answer(): number;
  reply(): number;
}

export class Solver {
  private readonly exports: Exports;

  constructor(instance: WebAssembly.Instance) {
    this.exports = instance.exports as unknown as Exports;
  }

  static async of(module: WebAssembly.Module): Promise<Solver> {
    return new Solver(await WebAssembly.instantiate(module, stillClock(module)));
  }

  ask<Reply>(request: Request): Reply {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    const { memory, room, answer, reply } = this.exports;
    const at = room(bytes.length);
    new Uint8Array(memory.buffer).set(bytes, at);
    const length = answer();
    const text = new TextDecoder().decode(new Uint8Array(memory.buffer, reply(), length));
    return answered(JSON.parse(text));
  }
}

/** The reply, unless it is a refusal. */
function answered<Reply>(reply: Reply & { error?: string; problems?: Refused["problems"] }): Reply {
  if (reply.problems) throw new Refused("the file has problems", reply.problems);
  if (reply.error !== undefined) throw new Refused(reply.error);
  return reply;
}
