// Who takes part in an answer: the judge in a worker, and the kernel in a sandbox or on the graphics device. What does not
// answer in time is ended, and the next question starts anew.
import { described, Gpu, prelude } from "./gpu.js";
import type { Described } from "./kernel.js";
import type { Answer, Message } from "./judge";
import { Sandbox } from "./sandbox";
import { suspends } from "./wasm.js";
import { scriptAddress } from "./trusted";
import judgeText from "virtual:judge";

/** Milliseconds of a question's that a kernel may take in all, and the judge between two messages. */
export const LIMIT = 20_000;

/** A kernel's text. */
export interface Source { language: "js" | "wgsl"; text: string }

export class Session {
  #module: Promise<WebAssembly.Module>;
  #judge: Worker | undefined;
  #sandbox: Sandbox | undefined;
  /** The kernel that is there. */
  #source: Source | undefined;
  #gpu: Promise<Gpu> | undefined;
  #file: Uint8Array | undefined;
  #described: Described | undefined;
  /** What WGSL's rules say of the last audit's verdicts, or why they say nothing. */
  permitted: Answer["permitted"];
  /** Why the kernel gave no verdict on a case of the last question, in its own words: the first time. */
  threw: string | undefined;
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
    this.#close();
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
      await this.#takeThrown();
      let told = await this.#send({ request });
      let left = LIMIT;
      while (told.asked) {
        const start = performance.now();
        const answers = await this.#inTime(this.#verdicts(told.asked), left);
        left -= performance.now() - start;
        told = await this.#send({ answers });
      }
      if (told.permitted !== undefined) this.permitted = told.permitted;
      this.threw = await this.#takeThrown();
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

  async #verdicts(asked: NonNullable<Answer["asked"]>): Promise<Float64Array[]> {
    return this.#source?.language === "wgsl" ? (await this.gpu).run(asked) : this.#sandbox!.run(asked);
  }

  async #takeThrown(): Promise<string | undefined> {
    return this.#source?.language === "wgsl" ? (await this.gpu).takeUsedUp() : this.#sandbox?.takeThrown();
  }

  /** Has the judge there, and the kernel if there is to be one. */
  async #start(source: Source | undefined) {
    const isSame = source?.text === this.#source?.text && source?.language === this.#source?.language;
    if (this.#judge && (source === undefined || isSame)) return;
    this.#close();
    const message: Message = { module: await this.#module, waits: suspends };
    if (source?.language === "js") {
      this.#described = await this.#inTime(Sandbox.open(source.text, (sandbox) => { this.#sandbox = sandbox; }), LIMIT);
    } else if (source) {
      this.#described = described(source.text);
      const names = Object.keys(this.#described.epsilons);
      message.wgsl = [prelude(names), source.text, names];
      // Before the text is the device's: what does not end there is ended too.
      this.#source = source;
      await this.#inTime(this.gpu.then((gpu) => gpu.compile(source.text, names)), LIMIT);
    }
    this.#source = source;
    const address = URL.createObjectURL(new Blob([judgeText], { type: "text/javascript" }));
    this.#judge = new Worker(scriptAddress(address), { type: "module", name: "hairline" });
    URL.revokeObjectURL(address);
    this.#judge.postMessage(message);
    if (this.#file) await this.#send({ file: this.#file });
  }

  /** Ends whoever is there. The device is left only if it has work that may not end. */
  #close(isDeviceBusy = false) {
    this.#judge?.terminate();
    this.#sandbox?.close();
    if (isDeviceBusy) {
      this.#gpu?.then((gpu) => gpu.destroy(), () => undefined);
      this.#gpu = undefined;
    }
    this.#judge = this.#sandbox = this.#source = undefined;
  }

  /** The judge's next message. */
  #send(message: Message): Promise<Answer> {
    const judge = this.#judge!;
    const answer = new Promise<Answer>((resolve, reject) => {
      judge.onmessage = ({ data }: MessageEvent<Answer>) => (data.error === undefined ? resolve(data) : reject(new Error(data.error)));
      judge.onerror = (event) => {
        event.preventDefault();
        reject(new Error(event.message || "the worker could not start"));
      };
    });
    judge.postMessage(message);
    return this.#inTime(answer, LIMIT);
  }

  /** An answer that comes in time; everything is ended if it does not, or if it is an error. */
  async #inTime<T>(answer: Promise<T>, milliseconds: number): Promise<T> {
    let timer: ReturnType<typeof setTimeout> | undefined;
    let isLate = false;
    const end = new Promise<never>((_, reject) => {
      this.#end = (why) => {
        isLate = true;
        reject(new Error(why));
      };
      timer = setTimeout(this.#end, milliseconds, `it gave no answer in ${LIMIT / 1000} s, and was ended`);
    });
    try {
      return await Promise.race([answer, end]);
    } catch (error) {
      this.#close(isLate && this.#source?.language === "wgsl");
      throw error;
    } finally {
      clearTimeout(timer);
      this.#end = undefined;
    }
  }
}
