// The worker in which everything is computed. What does not answer in time is ended, and the next question starts anew.
import type { Described } from "./kernel.js";
import type { Answer, Message } from "./worker";
import workerText from "virtual:worker";

/** Milliseconds after which a kernel is ended. */
export const LIMIT = 20_000;

export class Session {
  #module: Promise<WebAssembly.Module>;
  #worker: Worker | undefined;
  /** The text of the kernel that the worker has. */
  #text: string | undefined;
  #file: Uint8Array | undefined;
  #described: Described | undefined;
  /** One question at a time. */
  #last: Promise<unknown> = Promise.resolve();

  constructor(address: string) {
    this.#module = WebAssembly.compileStreaming(fetch(address));
  }

  /** Keeps a mesh's file for the requests that follow. */
  keepFile(file: Uint8Array) {
    this.#file = file;
    this.#worker?.terminate();
    this.#worker = undefined;
  }

  /** Takes a kernel's text, if it is another than before, and says what its module says of it. */
  async describe(text: string): Promise<Described> {
    await this.#inTurn(() => this.#start(text));
    return this.#described!;
  }

  /** The answer to a request about the kernel of a text, or about one of the program's. */
  ask<T>(request: object, text?: string): Promise<T> {
    return this.#inTurn(async () => {
      await this.#start(text);
      const { json } = await this.#send({ request });
      const answer = JSON.parse(json!) as T & { error?: string };
      if (answer.error !== undefined) throw new Error(answer.error);
      return answer;
    });
  }

  #inTurn<T>(task: () => Promise<T>): Promise<T> {
    const next = this.#last.then(task, task);
    this.#last = next.catch(() => undefined);
    return next;
  }

  async #start(text: string | undefined) {
    if (this.#worker && (text === undefined || text === this.#text)) return;
    this.#worker?.terminate();
    const address = URL.createObjectURL(new Blob([workerText], { type: "text/javascript" }));
    this.#worker = new Worker(address, { type: "module", name: "hairline" });
    URL.revokeObjectURL(address);
    this.#text = text;
    const module = await this.#module;
    const answer = await this.#send({ module, text });
    this.#described = answer.described;
    if (this.#file) await this.#send({ file: this.#file });
  }

  #send(message: Message): Promise<Answer> {
    const worker = this.#worker!;
    return new Promise((resolve, reject) => {
      const fail = (text: string) => {
        worker.terminate();
        if (this.#worker === worker) this.#worker = undefined;
        reject(new Error(text));
      };
      const timer = setTimeout(() => fail(`it gave no answer in ${LIMIT / 1000} s, and was ended`), LIMIT);
      worker.onmessage = ({ data }: MessageEvent<Answer>) => {
        clearTimeout(timer);
        if (data.error === undefined) resolve(data);
        else fail(data.error);
      };
      worker.postMessage(message);
      worker.onerror = (event) => {
        event.preventDefault();
        clearTimeout(timer);
        fail(event.message || "the worker could not start");
      };
    });
  }
}
