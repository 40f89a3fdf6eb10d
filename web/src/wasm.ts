// The WebAssembly module: requests and answers in JSON, truths of many cases in columns.

/** Verdicts on cases: 17 numbers a case in, 4 a verdict out (see kernel.ts). */
export type Run = (cases: Float64Array, epsilons: Float64Array, verdicts: Float64Array) => void;
/** The same from a kernel elsewhere: the verdicts come later. */
export type RunLater = (cases: Float64Array, epsilons: Float64Array) => Promise<Float64Array>;

interface Exports {
  memory: WebAssembly.Memory;
  reserve(bytes: number): number;
  ask(bytes: number): number;
  keep_file(bytes: number): void;
  truths(count: number, inF32: boolean): number;
  output(): number;
}

/** How a module waits for promises, where the browser has it (WebAssembly JavaScript Promise Integration). */
interface Suspends {
  Suspending: new (of: (...numbers: number[]) => Promise<void>) => () => void;
  promising(of: (bytes: number) => number): (bytes: number) => Promise<number>;
}
export const suspends = "Suspending" in WebAssembly && "promising" in WebAssembly;

/** An instance of the module, with the kernel that its requests may be about. */
export class Instance {
  #exports: Exports;
  #later: ((bytes: number) => Promise<number>) | undefined;

  private constructor(module: WebAssembly.Module, kernel: (...numbers: number[]) => void) {
    this.#exports = new WebAssembly.Instance(module, { hairline: { kernel } }).exports as unknown as Exports;
  }

  /** With a kernel that answers at once. */
  static with(module: WebAssembly.Module, run: Run): Instance {
    const instance = new Instance(module, (...numbers) => {
      const [cases, epsilons, verdicts] = instance.#columns(numbers);
      run(cases, epsilons, verdicts);
    });
    return instance;
  }

  /** With a kernel that is waited for, where the browser can. Then `askLater` alone asks. */
  static waiting(module: WebAssembly.Module, run: RunLater): Instance {
    const { Suspending, promising } = WebAssembly as unknown as Suspends;
    const instance = new Instance(module, new Suspending(async (...numbers) => {
      const [cases, epsilons] = instance.#columns(numbers);
      const verdicts = await run(cases.slice(), epsilons.slice());
      instance.#columns(numbers)[2].set(verdicts);
    }));
    instance.#later = promising(instance.#exports.ask);
    return instance;
  }

  /** The columns of a call: where they are, and how many cases and epsilons. */
  #columns([cases, count, epsilons, gates, verdicts]: number[]): [Float64Array, Float64Array, Float64Array] {
    const { buffer } = this.#exports.memory;
    return [new Float64Array(buffer, cases, 17 * count), new Float64Array(buffer, epsilons, gates), new Float64Array(buffer, verdicts, 4 * count)];
  }

  /** The answer to a request, as JSON. Its field `error` says what is wrong with the request. */
  ask(request: object): string {
    return this.#answer(this.#exports.ask(this.#request(request)));
  }

  /** The same, when the kernel's answers have come. */
  async askLater(request: object): Promise<string> {
    return this.#answer(await this.#later!(this.#request(request)));
  }

  #request(request: object): number {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    this.#put(bytes);
    return bytes.length;
  }

  #answer(length: number): string {
    return new TextDecoder().decode(this.#output(length));
  }

  /** Keeps the bytes of a mesh's file for the requests that follow. */
  keepFile(bytes: Uint8Array) {
    this.#put(bytes);
    this.#exports.keep_file(bytes.length);
  }

  /** The truths of cases of 17 numbers each, as codes (see truth.ts). */
  truths(cases: Float64Array, scalar: "f32" | "f64"): Uint32Array {
    this.#put(new Uint8Array(cases.buffer, cases.byteOffset, cases.byteLength));
    const length = this.#exports.truths(cases.length / 17, scalar === "f32");
    return new Uint32Array(this.#output(length).slice().buffer);
  }

  #put(bytes: Uint8Array) {
    const at = this.#exports.reserve(bytes.length);
    new Uint8Array(this.#exports.memory.buffer, at, bytes.length).set(bytes);
  }

  #output(length: number): Uint8Array {
    return new Uint8Array(this.#exports.memory.buffer, this.#exports.output(), length);
  }
}
