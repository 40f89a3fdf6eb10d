// The worker in which everything is computed. What does not answer in time is ended, and the next question starts anew.
import { described, Gpu, prelude } from "./gpu.js";
import type { Described } from "./kernel.js";
import type { Answer, Message } from "./worker";
import workerText from "virtual:worker";

/** Milliseconds after which a kernel is ended. */
export const LIMIT = 20_000;

/** A kernel's text. */
export interface Source { language: "js" | "wgsl"; text: string }

export class Session {
  #module: Promise<WebAssembly.Module>;
  #worker: Worker | undefined;
  /** The kernel that the worker has. */
  #source: Source | undefined;
  #gpu: Promise<Gpu> | undefined;
  #file: Uint8Array | undefined;
  #described: Described | undefined;
  /** What WGSL's rules say of the last audit's verdicts, or why they say nothing. */
  permitted: Answer["permitted"];
  /** Ends the question that waits for its answer. */
  #end: ((why: string) => void) | undefined;
  /** One question at a time. */
  #last: Promise<unknown> = Promise.resolve();

  constructor(address: string) {
    this.#module = WebAssembly.compileStreaming(fetch(address));
  }

  /** Ends what is running, since something else is asked. */
  stop() {
    this.#end?.("something else was asked");
  }

  /** Keeps a mesh's file for the requests that follow. */
  keepFile(file: Uint8Array) {
    this.#file = file;
    this.#worker?.terminate();
    this.#worker = undefined;
  }

  /** The visitor's device. */
  get gpu(): Promise<Gpu> {
    this.#gpu ??= Gpu.open();
    this.#gpu.catch(() => { this.#gpu = undefined; });
    return this.#gpu;
  }

  /** Takes a kernel, if it is another than before, and says what its text says of it. */
  async describe(source: Source): Promise<Described> {
    await this.#inTurn(() => this.#start(source));
    return this.#described!;
  }

  /** The answer to a request about a kernel, or about one of the program's. */
  ask<T>(request: object, source?: Source): Promise<T> {
    return this.#inTurn(async () => {
      await this.#start(source);
      let told = await this.#send({ request });
      while (told.asked) {
        const answers = await (await this.gpu).run(told.asked);
        told = await this.#send({ request, answers });
      }
      if (told.permitted !== undefined) this.permitted = told.permitted;
      const answer = JSON.parse(told.json!) as T & { error?: string };
      if (answer.error !== undefined) throw new Error(answer.error);
      return answer;
    });
  }

  /** Which answers WGSL permits for a case of the kernel that is there: `hit`, `miss`, `both`, or a sentence why that is not known. */
  permits(numbers: number[], epsilons: number[]): Promise<string> {
    return this.#inTurn(async () => (await this.#send({ numbers, epsilons })).permitted as string);
  }

  #inTurn<T>(task: () => Promise<T>): Promise<T> {
    const next = this.#last.then(task, task);
    this.#last = next.catch(() => undefined);
    return next;
  }

  async #start(source: Source | undefined) {
    const isSame = source?.text === this.#source?.text && source?.language === this.#source?.language;
    if (this.#worker && (source === undefined || isSame)) return;
    this.#worker?.terminate();
    const address = URL.createObjectURL(new Blob([workerText], { type: "text/javascript" }));
    this.#worker = new Worker(address, { type: "module", name: "hairline" });
    URL.revokeObjectURL(address);
    this.#source = undefined;
    const module = await this.#module;
    if (source?.language === "wgsl") {
      this.#described = described(source.text);
      await (await this.gpu).compile(source.text, Object.keys(this.#described.epsilons));
      const names = Object.keys(this.#described.epsilons);
      await this.#send({ module, wgsl: [prelude(names), source.text, names] });
    } else {
      this.#described = (await this.#send({ module, text: source?.text })).described;
    }
    this.#source = source;
    if (this.#file) await this.#send({ file: this.#file });
  }

  #send(message: Message): Promise<Answer> {
    const worker = this.#worker!;
    return new Promise((resolve, reject) => {
      const fail = (text: string) => {
        clearTimeout(timer);
        this.#end = undefined;
        worker.terminate();
        if (this.#worker === worker) this.#worker = undefined;
        reject(new Error(text));
      };
      const timer = setTimeout(() => fail(`it gave no answer in ${LIMIT / 1000} s, and was ended`), LIMIT);
      worker.onmessage = ({ data }: MessageEvent<Answer>) => {
        clearTimeout(timer);
        this.#end = undefined;
        if (data.error === undefined) resolve(data);
        else fail(data.error);
      };
      this.#end = fail;
      worker.postMessage(message);
      worker.onerror = (event) => {
        event.preventDefault();
        fail(event.message || "the worker could not start");
      };
    });
  }
}
