// The WebAssembly module: requests and answers in JSON, truths of many cases in columns.

/** Verdicts on cases: 17 numbers a case in, 4 a verdict out (see kernel.ts). */
export type Run = (cases: Float64Array, epsilons: Float64Array, verdicts: Float64Array) => void;

interface Exports {
  memory: WebAssembly.Memory;
  reserve(bytes: number): number;
  ask(bytes: number): number;
  keep_file(bytes: number): void;
  truths(count: number, inF32: boolean): number;
  output(): number;
}

/** An instance of the module, with the kernel that its requests may be about. */
export class Instance {
  #exports: Exports;

  constructor(module: WebAssembly.Module, run: Run) {
    const kernel = (cases: number, count: number, epsilons: number, gates: number, verdicts: number) => {
      const { buffer } = this.#exports.memory;
      run(
        new Float64Array(buffer, cases, 17 * count),
        new Float64Array(buffer, epsilons, gates),
        new Float64Array(buffer, verdicts, 4 * count),
      );
    };
    const instance = new WebAssembly.Instance(module, { hairline: { kernel } });
    this.#exports = instance.exports as unknown as Exports;
  }

  /** The answer to a request, as JSON. Its field `error` says what is wrong with the request. */
  ask(request: object): string {
    const bytes = new TextEncoder().encode(JSON.stringify(request));
    this.#put(bytes);
    return new TextDecoder().decode(this.#output(this.#exports.ask(bytes.length)));
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
