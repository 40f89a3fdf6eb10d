// A kernel in JavaScript: what it is called with, what it may return, and how many cases go through it.

export type Vector = [number, number, number];
export interface Ray { origin: Vector; direction: Vector; tMin: number; tMax: number }
export interface Triangle { a: Vector; b: Vector; c: Vector }
export type Epsilons = Record<string, number>;
/** A miss is null, undefined or false. A hit is true, its t, or an object with t, and u and v if it has them. */
export type Hit = boolean | number | null | undefined | { t?: number; u?: number; v?: number };
export type Kernel = (ray: Ray, triangle: Triangle, epsilons: Epsilons) => Hit;

/** What a module says of its kernel. */
export interface Described {
  /** By name; sorted by it. */
  epsilons: Epsilons;
  /** As `hairline --contract` takes it. */
  contract: string;
  /** True if hits have t, and true if they have u and v. */
  gives: [boolean, boolean];
  /** What it promises less than a plain contract asks, if it names no contract: words that may be added to it. */
  less: Less[];
}
export type Less = "sides=front" | "extent=line";

export const isHit = (hit: Hit): hit is Exclude<Hit, false | null | undefined> => hit !== null && hit !== undefined && hit !== false;

/** A kernel over columns of numbers: of a case origin, direction, a, b, c, t_min, t_max; of a verdict what it is (0 a
 * miss, 1 a hit, 2 an exception), t, u, v. `threw` is given the first exception of a call. */
export function runner(kernel: Kernel, names: string[], threw: (error: unknown) => void = () => {}) {
  const ray: Ray = { origin: [0, 0, 0], direction: [0, 0, 0], tMin: 0, tMax: 0 };
  const triangle: Triangle = { a: [0, 0, 0], b: [0, 0, 0], c: [0, 0, 0] };
  const vectors = [ray.origin, ray.direction, triangle.a, triangle.b, triangle.c];
  const held: Epsilons = {};
  return (cases: Float64Array, epsilons: Float64Array, verdicts: Float64Array) => {
    names.forEach((name, i) => { held[name] = epsilons[i]; });
    let isFirst = true;
    for (let i = 0, at = 0, to = 0; to < verdicts.length; i++, at = 17 * i, to = 4 * i) {
      for (const vector of vectors) {
        vector[0] = cases[at++];
        vector[1] = cases[at++];
        vector[2] = cases[at++];
      }
      ray.tMin = cases[at];
      ray.tMax = cases[at + 1];
      let hit: Hit;
      try {
        hit = kernel(ray, triangle, held);
      } catch (error) {
        verdicts[to] = 2;
        if (isFirst) threw(error);
        isFirst = false;
        continue;
      }
      verdicts[to] = isHit(hit) ? 1 : 0;
      if (!isHit(hit)) continue;
      const { t, u, v } = valuesOf(hit);
      verdicts[to + 1] = t;
      verdicts[to + 2] = u;
      verdicts[to + 3] = v;
    }
  };
}

/** What a kernel says of plain rays: which values its hits have, and what it promises less than a contract asks. An error
 * says which of its answers no kernel can mean. */
export function given(kernel: Kernel, epsilons: Epsilons): { gives: [boolean, boolean]; less: Less[] } {
  const plain = (from: number, along: number, aside = 1) =>
    kernel({ origin: [aside, aside, from], direction: [0, 0, along], tMin: 0, tMax: Infinity }, { a: [0, 0, 0], b: [4, 0, 0], c: [0, 4, 0] }, epsilons);
  const [front, back, ...behind] = [plain(4, -4), plain(-4, 4), plain(4, 4), plain(-4, -4)];
  if (isPromise(front)) throw new Error("the kernel returns a Promise: it must answer at once, without async and await");
  if (front === undefined && back === undefined) {
    throw new Error("the kernel returns undefined for a ray through the middle of a triangle: is a `return` missing, or does it read origin.x of the array origin? A miss is null");
  }
  if ([front, back].filter(isHit).some((hit) => Number.isNaN(typeof hit === "object" ? hit.t : hit))) {
    throw new Error("the kernel returns t = NaN for a ray through the middle of a triangle: does it read origin.x of the array origin? Vectors are [x, y, z]");
  }
  // A kernel that throws far away can be run: the cases on which it throws are counted.
  const far = (from: number, along: number, aside: number) => {
    try {
      return plain(from, along, aside);
    } catch {
      return null;
    }
  };
  const beside = [far(4, -4, 40), far(-4, 4, 40), far(4, -4, -40), far(-4, 4, -40)].filter(isHit);
  if (beside.length === 4) {
    const told = beside.map((hit) => (typeof hit === "object" ? hit.t : hit));
    throw new Error(`the kernel reports a hit (${told[0]}) for rays that pass far beside a triangle: if that stands for a miss, return null instead`);
  }
  const { t, u, v } = valuesOf([front, back].find(isHit) ?? true);
  const less: Less[] = [...(isHit(front) && !isHit(back) ? ["sides=front" as const] : []), ...(behind.some(isHit) ? ["extent=line" as const] : [])];
  return { gives: [!Number.isNaN(t), !Number.isNaN(u) && !Number.isNaN(v)], less };
}

const isPromise = (hit: unknown): boolean => typeof (hit as { then?: unknown } | null)?.then === "function";

/** The values of a hit; NaN for those that it has not. */
function valuesOf(hit: Exclude<Hit, false | null | undefined>) {
  const { t, u, v }: { t?: number; u?: number; v?: number } = typeof hit === "object" ? hit : typeof hit === "number" ? { t: hit } : {};
  return { t: Number(t ?? NaN), u: Number(u ?? NaN), v: Number(v ?? NaN) };
}

const PLAIN_CONTRACT = "closed-ray,boundary=free,coplanar=free,degenerate=free,invalid=free";

/** The description of a module's kernel; an error says what the module should have. */
export function describe(module: Record<string, unknown>): Described & { kernel: Kernel } {
  const kernel = module.default as Kernel;
  if (typeof kernel !== "function") {
    throw new Error("the module has no kernel: write `export default function kernel(ray, triangle, epsilon) { … }`");
  }
  const named = Object.entries(module.epsilons ?? {}).sort(([a], [b]) => (a < b ? -1 : 1));
  for (const [name, value] of named) {
    if (typeof value !== "number" || !Number.isFinite(value)) throw new Error(`epsilon ${name}: expected a finite number, found ${value}`);
    if (!/^[A-Za-z][\w-]*$/.test(name)) throw new Error(`epsilon ${name}: a name has letters, digits, - and _ only`);
  }
  const epsilons = Object.fromEntries(named) as Epsilons;
  const contract = String(module.contract ?? PLAIN_CONTRACT);
  const { gives, less } = given(kernel, epsilons);
  return { kernel, epsilons, contract, gives, less: module.contract ? [] : less };
}

/** What a kernel does that the contract forbids, and that may be meant: a sentence, with the contract that would say so. */
export function hint({ less }: Described): string {
  if (less.length === 0) return "";
  const does = less.map((words) => (words === "sides=front" ? "misses a plain triangle from the back" : "hits what lies behind the ray's start"));
  return `It ${does.join(", and ")}. If that is meant, say so: export const contract = "${[PLAIN_CONTRACT, ...less].join(",")}";`;
}

/** The kernel of a request, as the module takes it. */
export function asChosen({ epsilons, contract, gives }: Described, selector: string) {
  const words = Object.fromEntries(Object.entries(epsilons).map(([name, value]) => [name, decimal(value)]));
  return { own: { contract, gives, epsilons: words, selector } };
}

/** A number as `--epsilon` takes it. */
export const decimal = (value: number) => (value !== 0 && Math.abs(value) < 1e-3 ? value.toExponential() : String(value)).replace("e+", "e");
