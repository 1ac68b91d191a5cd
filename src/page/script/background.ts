// Hands long work to a worker; one piece at a time, a new one ends the old.
import { Refused, type Request } from "./types";

/** The script of the worker, put here by bundle.mjs. */
declare const WORKER: string;

export class Background {
  private worker: Worker | null = null;
  private drop: (() => void) | null = null;
  private readonly address = URL.createObjectURL(new Blob([WORKER], { type: "text/javascript" }));

  constructor(private readonly module: WebAssembly.Module) {}

  /** The reply to the last of the requests. */
  ask<Reply>(requests: Request[]): Promise<Reply> {
    this.stop();
    const worker = new Worker(this.address);
    this.worker = worker;
    return new Promise((resolve, reject) => {
      this.drop = () => reject(new Refused("stopped"));
      worker.onmessage = ({ data }) => {
        this.end();
        if (data.error !== undefined) reject(new Refused(data.error, data.problems));
        else resolve(data.reply as Reply);
      };
      worker.onerror = (event) => {
        this.end();
        reject(new Refused(event.message || "the solver stopped"));
      };
      worker.postMessage({ module: this.module, requests });
    });
  }

  stop() {
    const drop = this.drop;
    this.end();
    drop?.();
  }

  private end() {
    this.worker?.terminate();
    this.worker = null;
    this.drop = null;
  }
}
