/**
 * Ray–triangle tests held to the exact answer: the same Rust code as the program `hairline`, as WebAssembly.
 *
 * ```js
 * import { load } from "hairline-audit";
 * const hairline = await load();
 * const { title, record } = hairline.audit((ray, { a, b, c }) => null);
 * ```
 */
import { asChosen, describe, runner, type Epsilons, type Kernel, type Vector } from "./kernel.js";
import { truthOf } from "./truth.js";
import { Instance } from "./wasm.js";

export { truthOf };
export type { Epsilons, Hit, Kernel, Ray, Triangle, Vector } from "./kernel.js";
export type { Feature, Truth } from "./truth.js";

/** A ray and a triangle. */
export interface Case {
  origin: Vector;
  direction: Vector;
  a: Vector;
  b: Vector;
  c: Vector;
  /** 0 if it is not given. */
  t_min?: number;
  /** Infinity if it is not given. */
  t_max?: number;
}

/** The exact answer for one case; numbers are fractions `p/q`, null where they do not apply. */
export interface ExactTruth {
  class: "transversal" | "parallel" | "coplanar" | "degenerate" | "invalid";
  facing: string | null;
  t: string | null;
  feature: string | null;
  contact: { kind: string; feature: string | null; t: [string, string] | null } | null;
  hits_closed: boolean | null;
  t_exact: string | null;
  u_exact: string | null;
  v_exact: string | null;
}

export interface AuditOptions {
  /** `f64` if it is not given: the coordinates that the kernel gets. It computes as it likes. */
  scalar?: "f32" | "f64";
  /** Families of hard cases, by name; all if they are not given. */
  families?: string[];
  /** Rays in a scene instead, as `hairline --scene` takes it: `room`. */
  scene?: string;
  /** Cases of each family: 500. */
  count?: number;
  seed?: number;
  /** The kernel's promise, as `hairline --contract` takes it. */
  contract?: string;
  /** Passed to the kernel. */
  epsilons?: Epsilons;
}

/** What an audit found. */
export interface Audit {
  /** The verdict in a sentence. */
  title: string;
  /** As `hairline audit --format json` writes it (docs/schema/record.json). */
  record: { result: { results: { family: string; findings: Finding[] }[] } } & Record<string, unknown>;
  /** The report as elements of HTML. */
  html: string;
}

/** How often a kernel is wrong in one way. */
export interface Finding {
  finding: string;
  class: string;
  rate: { count: number; of: number };
  worst: { case: string; command: string };
}

export class Hairline {
  #instance: Instance;
  #run = (_cases: Float64Array, _epsilons: Float64Array, _verdicts: Float64Array) => {};

  constructor(module: WebAssembly.Module) {
    this.#instance = Instance.with(module, (...columns) => this.#run(...columns));
  }

  /** The exact answer for a case, or for the first triangle of an id such as `edge-near@2/f64/-/1/7`. */
  truth(of: Case | string, scalar: "f32" | "f64" = "f64"): ExactTruth {
    const word = (x: number) => (Number.isFinite(x) ? x : String(x).replace("Infinity", "inf").toLowerCase());
    const json = () => JSON.stringify({ scalar, ...(of as Case) }, (_, value) => (typeof value === "number" ? word(value) : value));
    return this.#ask<ExactTruth[]>({ do: "truth", case: typeof of === "string" ? of : json() })[0];
  }

  /** The truths of many cases: of each origin, direction, a, b, c, t_min, t_max, 17 numbers in a row. `truthOf` reads
   * the codes. */
  truths(cases: Float64Array, scalar: "f32" | "f64" = "f64"): Uint32Array {
    if (cases.length % 17 !== 0) throw new RangeError(`expected 17 numbers a case, found ${cases.length} in all`);
    return this.#instance.truths(cases, scalar);
  }

  /** Runs a kernel, or a built-in one by its name, and compares each answer with the exact one. */
  audit(kernel: Kernel | string, options: AuditOptions = {}): Audit {
    const { scalar = "f64", families = [], scene, count = 500, seed = 1, contract, epsilons = {} } = options;
    const cases = { scalar, families, scene, count, seed };
    if (typeof kernel === "string") {
      const words = Object.entries(epsilons).map(([name, value]) => `${name}=${value}`).join(",");
      return this.#ask({ do: "audit", kernel: { name: kernel, epsilons: words, contract }, cases });
    }
    const { kernel: test, ...described } = describe({ default: kernel, epsilons, contract });
    this.#run = runner(test, Object.keys(described.epsilons));
    return this.#ask({ do: "audit", kernel: asChosen(described, "--kernel-cmd 'node kernel.mjs'"), cases });
  }

  #ask<T>(request: object): T {
    const answer = JSON.parse(this.#instance.ask(request)) as T & { error?: string };
    if (answer.error !== undefined) throw new Error(answer.error);
    return answer;
  }
}

/** Loads the module: from beside this file, or from bytes that are there already. */
export async function load(bytes?: BufferSource): Promise<Hairline> {
  const beside = new URL("./hairline.wasm", import.meta.url);
  if (!bytes && beside.protocol === "file:") {
    const { readFile } = await import("node:fs/promises");
    bytes = await readFile(beside);
  }
  return new Hairline(bytes ? await WebAssembly.compile(bytes) : await WebAssembly.compileStreaming(fetch(beside)));
}
