// A kernel in WGSL on the visitor's own device, and what the device's answers say of its arithmetic.
import type { Described, Epsilons } from "./kernel.js";
import { bounded, DECLARED, STEPS } from "./wgsl/bounded";

/** The cases of one call, and its epsilons. */
export interface Asked { cases: Float64Array; epsilons: Float64Array }

const STRUCTURES = `
struct Ray { origin: vec3f, direction: vec3f, t_min: f32, t_max: f32 }
struct Triangle { a: vec3f, b: vec3f, c: vec3f }
struct Hit { hit: bool, t: f32, u: f32, v: f32 }
`;

/** The structures that a kernel's text uses, its epsilons among them. */
export function prelude(names: string[]): string {
  const members = names.length ? names.map((name) => `${name}: f32`).join(", ") : "hairline_none: f32";
  return `${STRUCTURES}struct Epsilon { ${members} }\n`;
}

const MAIN = `
${DECLARED}
@group(0) @binding(0) var<storage, read> hairline_cases: array<f32>;
@group(0) @binding(1) var<storage, read> hairline_epsilon: Epsilon;
@group(0) @binding(2) var<storage, read_write> hairline_hits: array<vec4f>;
fn hairline_vector(at: u32) -> vec3f { return vec3f(hairline_cases[at], hairline_cases[at + 1], hairline_cases[at + 2]); }
@compute @workgroup_size(64) fn hairline_main(@builtin(global_invocation_id) id: vec3u) {
  let i = id.x;
  if (i >= arrayLength(&hairline_hits)) { return; }
  let at = 17 * i;
  let ray = Ray(hairline_vector(at), hairline_vector(at + 3), hairline_cases[at + 15], hairline_cases[at + 16]);
  let hit = kernel(ray, Triangle(hairline_vector(at + 6), hairline_vector(at + 9), hairline_vector(at + 12)), hairline_epsilon);
  hairline_hits[i] = vec4f(select(select(0.0, 1.0, hit.hit), 2.0, hairline_steps == 0u), hit.t, hit.u, hit.v);
}
`;

/** The most cases of one dispatch: with loops that use up their steps it ends in a second or two, on a processor too. */
const MOST = 1 << 16;

/** What the comments of a text say: lines `// epsilon NAME = VALUE` and `// contract WORDS`. */
export function described(text: string): Described {
  const found = [...text.matchAll(/^\/\/ epsilon +([A-Za-z]\w*) *= *(\S+) *$/gm)].map(([, name, value]) => [name, Number(value)] as const);
  for (const [name, value] of found) if (!Number.isFinite(value)) throw new Error(`epsilon ${name}: expected a number`);
  const epsilons: Epsilons = Object.fromEntries(found.sort(([a], [b]) => (a < b ? -1 : 1)));
  const contract = /^\/\/ contract +(\S+) *$/m.exec(text)?.[1] ?? "closed-ray,boundary=free,coplanar=free,degenerate=free,invalid=free";
  return { epsilons, contract, gives: [true, true], less: [] };
}

/** A device, and the kernel that it has at the time. */
export class Gpu {
  #device: GPUDevice;
  #pipeline: GPUComputePipeline | undefined;
  readonly info: GPUAdapterInfo;
  #isUsedUp = false;

  private constructor(device: GPUDevice, info: GPUAdapterInfo) {
    [this.#device, this.info] = [device, info];
  }

  static async open(): Promise<Gpu> {
    const adapter = await navigator.gpu?.requestAdapter();
    if (!adapter) throw new Error("this browser has no WebGPU here: a kernel in WGSL needs it");
    return new Gpu(await adapter.requestDevice(), adapter.info);
  }

  /** Leaves the device, whatever it is doing. */
  destroy() {
    this.#device.destroy();
  }

  /** Takes a kernel's text; an error has the line in it. */
  async compile(text: string, names: string[]) {
    this.#pipeline = await this.#built(prelude(names), bounded(text), MAIN, "hairline_main");
  }

  async #built(before: string, text: string, after: string, entryPoint: string) {
    this.#device.pushErrorScope("validation");
    const module = this.#device.createShaderModule({ code: before + text + after });
    const { messages } = await module.getCompilationInfo();
    const error = messages.find(({ type }) => type === "error");
    const above = before.split("\n").length - 1;
    if (error) {
      void this.#device.popErrorScope();
      throw new Error(`line ${error.lineNum - above}: ${error.message}`);
    }
    const pipeline = await this.#device.createComputePipelineAsync({ layout: "auto", compute: { module, entryPoint } });
    const invalid = await this.#device.popErrorScope();
    if (invalid) throw new Error(invalid.message);
    return pipeline;
  }

  /** The verdicts on each call's cases. Calls with the same epsilons go together. */
  async run(asked: Asked[]): Promise<Float64Array[]> {
    const answers: Float64Array[] = asked.map(({ cases }) => new Float64Array((cases.length / 17) * 4));
    const groups = new Map<string, number[]>();
    asked.forEach(({ epsilons }, i) => {
      const key = epsilons.join();
      groups.set(key, [...(groups.get(key) ?? []), i]);
    });
    for (const group of groups.values()) {
      const all = new Float32Array(group.reduce((sum, i) => sum + asked[i].cases.length, 0));
      let at = 0;
      for (const i of group) {
        all.set(asked[i].cases, at);
        at += asked[i].cases.length;
      }
      const epsilons = Float32Array.from(asked[group[0]].epsilons.length ? asked[group[0]].epsilons : [0]);
      const hits = new Float32Array((all.length / 17) * 4);
      for (let from = 0; from < all.length / 17; from += MOST) {
        const part = all.subarray(17 * from, 17 * (from + MOST));
        hits.set(await this.#dispatched(this.#pipeline!, [part, epsilons], (part.length / 17) * 16, part.length / 17), 4 * from);
      }
      at = 0;
      for (const i of group) {
        answers[i].set(hits.subarray(at, at + answers[i].length));
        for (let k = 0; k < answers[i].length; k += 4) this.#isUsedUp ||= answers[i][k] === 2;
        at += answers[i].length;
      }
    }
    return answers;
  }

  /** A sentence if loops have used up their steps since this was asked before. */
  takeUsedUp(): string | undefined {
    const isUsedUp = this.#isUsedUp;
    this.#isUsedUp = false;
    return isUsedUp ? `its loops were ended after ${STEPS.toLocaleString("en")} steps` : undefined;
  }

  /** What a pipeline writes into its last binding, from what is in the others. */
  async #dispatched(pipeline: GPUComputePipeline, inputs: Float32Array[], bytes: number, count: number): Promise<Float32Array> {
    const device = this.#device;
    const buffer = (size: number, usage: number) => device.createBuffer({ size: Math.max(16, size), usage });
    const buffers = inputs.map((input) => {
      const made = buffer(input.byteLength, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST);
      device.queue.writeBuffer(made, 0, input as Float32Array<ArrayBuffer>);
      return made;
    });
    const out = buffer(bytes, GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_SRC);
    const read = buffer(bytes, GPUBufferUsage.MAP_READ | GPUBufferUsage.COPY_DST);
    const entries = [...buffers, out].map((buffer, binding) => ({ binding, resource: { buffer } }));
    const encoder = device.createCommandEncoder();
    const pass = encoder.beginComputePass();
    pass.setPipeline(pipeline);
    pass.setBindGroup(0, device.createBindGroup({ layout: pipeline.getBindGroupLayout(0), entries }));
    pass.dispatchWorkgroups(Math.ceil(count / 64));
    pass.end();
    encoder.copyBufferToBuffer(out, 0, read, 0, Math.max(16, bytes));
    device.queue.submit([encoder.finish()]);
    const lost = device.lost.then(({ message }) => { throw new Error(`the device was lost: ${message}`); });
    await Promise.race([read.mapAsync(GPUMapMode.READ), lost]);
    const answer = new Float32Array(read.getMappedRange().slice(0, bytes));
    [...buffers, out, read].forEach((one) => one.destroy());
    return answer;
  }

  /** What its answers say of its arithmetic. */
  async signature(): Promise<Signature> {
    const pairs = quotients();
    // First what single operations give, then the quotients.
    const x = 1 + 2 ** -12;
    const big = 2 ** 30;
    const probes = [x, x, -(1 + 2 ** -11), 2 ** -130, 2 ** -70, 2 ** -70, big];
    const input = Float32Array.from([...probes, ...pairs]);
    const count = pairs.length / 2;
    const pipeline = await this.#built("", PROBE.replaceAll("PROBES", String(probes.length)), "", "probe");
    const out = await this.#dispatched(pipeline, [input], 4 * (8 + 2 * count), count);
    const [plain, fused, read, product, xy, xz, yz] = out;
    const [first] = [["x and y", xy], ["x and z", xz], ["y and z", yz]].filter(([, sum]) => sum === 1);
    const off = (at: number, exact: (a: number, b: number) => number) => {
      let wrong = 0;
      let most = 0;
      for (let i = 0; i < count; i++) {
        const ulps = Math.abs(place(out[8 + at * count + i]) - place(Math.fround(exact(pairs[2 * i], pairs[2 * i + 1]))));
        wrong += Number(ulps > 0);
        most = Math.max(most, ulps);
      }
      return { of: count, wrong, most_ulps: most };
    };
    const { vendor, architecture, device, description } = this.info;
    return {
      schema: "hairline-device/1",
      adapter: { vendor, architecture, device, description },
      browser: navigator.userAgent,
      product_and_sum: plain === 0 ? "rounded twice" : "fused",
      fma: fused === 2 ** -24 ? "fused" : "rounded twice",
      dot: first ? `${first[0]} first` : "neither pair first",
      subnormals: { read: read === 0 ? "flushed" : "kept", computed: product === 0 ? "flushed" : "kept" },
      division: off(0, (a, b) => a / b),
      square_root: off(1, (a) => Math.sqrt(a)),
    };
  }
}

/** A device's arithmetic, as it shows in its answers. */
export interface Signature {
  schema: string;
  adapter: Record<string, string>;
  browser: string;
  /** `a * b + c`: the compiler may fuse it. */
  product_and_sum: "fused" | "rounded twice";
  fma: "fused" | "rounded twice";
  /** Which two products of a `dot` of three are added first. */
  dot: string;
  subnormals: { read: "kept" | "flushed"; computed: "kept" | "flushed" };
  /** Against the nearest float, on operands at random. */
  division: Rounded;
  square_root: Rounded;
}
interface Rounded { of: number; wrong: number; most_ulps: number }

const PROBE = `
@group(0) @binding(0) var<storage, read> given: array<f32>;
@group(0) @binding(1) var<storage, read_write> told: array<f32>;
@compute @workgroup_size(64) fn probe(@builtin(global_invocation_id) id: vec3u) {
  let count = (arrayLength(&given) - PROBES) / 2;
  let i = id.x;
  if (i == 0) {
    told[0] = given[0] * given[1] + given[2];
    told[1] = fma(given[0], given[1], given[2]);
    told[2] = given[3] * 1048576.0;
    told[3] = given[4] * given[5] * 0x1p40;
    let big = given[6];
    let ones = vec3f(given[0] / given[1]);
    told[4] = dot(vec3f(big, -big, 1.0), ones);
    told[5] = dot(vec3f(big, 1.0, -big), ones);
    told[6] = dot(vec3f(1.0, big, -big), ones);
  }
  if (i < count) {
    let a = given[PROBES + 2 * i];
    let b = given[PROBES + 2 * i + 1];
    told[8 + i] = a / b;
    told[8 + count + i] = sqrt(a);
  }
}
`;

/** Pairs of floats between 1 and 4, always the same. */
function quotients(): number[] {
  let state = 1;
  const next = () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.fround((1 + (state >>> 9) / 2 ** 23) * (state & 256 ? 2 : 1));
  };
  return Array.from({ length: 8192 }, next);
}

/** The place of a float among floats, so that neighbours differ by one. */
function place(x: number): number {
  const bits = new Int32Array(Float32Array.of(x).buffer)[0];
  return bits < 0 ? -(bits & 0x7fffffff) : bits;
}
