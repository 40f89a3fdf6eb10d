/**
 * Rays and triangles with the exact answer, for tests that run in node.
 *
 * ```js
 * import { compare } from "hairline-audit-vectors";
 * const { wrong } = compare((ray, { a, b, c }) => null, { tolerance: 1e-6 });
 * ```
 */
import { readdirSync, readFileSync } from "node:fs";
import { isHit, type Epsilons, type Kernel, type Ray, type Triangle, type Vector } from "./kernel.js";

export type { Epsilons, Hit, Kernel, Ray, Triangle, Vector } from "./kernel.js";

/** A ray with one triangle, or with several that are counted together. */
export interface Test {
  /** A name and sixteen digits of a hash of the numbers. */
  id: string;
  topic: string;
  comment: string;
  /** What may go wrong; `about` explains them. */
  flags: string[];
  scalar: "f32" | "f64";
  ray: Ray;
  triangles: Triangle[];
  /** True if the hits of its triangles are counted together. */
  isGroup: boolean;
  /** What is right, or `free` where that depends on what a function promises. */
  result: "hit" | "miss" | "free" | "exactly-one" | "at-least-one";
  /** The answer if edges, ends and contacts in the plane are hits, and if they are none; of a group the number of hits. */
  closed: "hit" | "miss" | number;
  open: "hit" | "miss" | number;
  free_because?: string[];
  parity?: "even" | "odd";
  facing?: "front" | "back" | null;
  /** The doubles nearest to the exact values; u is the weight of b, v that of c. */
  t?: number | null;
  u?: number | null;
  v?: number | null;
  /** The smallest exact weight of a, b and c: how far inside the line passes, negative outside. */
  margin?: number | null;
}

export interface Choice {
  /** Both if it is not given. */
  scalar?: "f32" | "f64";
  /** Leaves out what is no farther from an edge than this part of the triangle's height: 0. */
  tolerance?: number;
  /** Leaves out tests with one of these flags, such as `back` for a function that culls back faces. */
  without?: string[];
  /** Passed to the kernel. */
  epsilons?: Epsilons;
}

export interface Comparison {
  /** The tests with a wrong answer, and the answer. */
  wrong: { test: Test; answer: "hit" | "miss" | number }[];
  /** How many tests have one right answer, and were asked. */
  asked: number;
  /** For `hairline verify`: all answers, those to free tests too. */
  results: { vectors: string; product: string; results: Record<string, "hit" | "miss" | number> };
}

const folder = new URL("./data/", import.meta.url);
const text = (name: string) => readFileSync(new URL(name, folder), "utf8");

/** The digest that names this set in results. */
export const sha256 = text("sha256.txt").trim();

/** What each topic is about, and what its flags mean. */
export const about: Record<string, { about: string; flags: Record<string, string> }> = {};

const view = new DataView(new ArrayBuffer(8));
function number(bits: string): number {
  view.setBigUint64(0, BigInt(`0x${bits}`));
  return bits.length === 8 ? view.getFloat32(4) : view.getFloat64(0);
}

interface Line extends Omit<Test, "ray" | "triangles" | "topic" | "isGroup"> { bits: string; triangles?: number[][] }

/** All tests, in the order of the files. */
export const tests: Test[] = readdirSync(folder).filter((name) => name.endsWith(".json")).sort().flatMap((name) => {
  const file = JSON.parse(text(name)) as { topic: string; about: string; flags: Record<string, string>; tests: Line[] };
  about[file.topic] = { about: file.about, flags: file.flags };
  return file.tests.map((line): Test => {
    const n = line.bits.split(" ").map(number);
    const vector = (at: number) => n.slice(at, at + 3) as Vector;
    const ray = { origin: vector(0), direction: vector(3), tMin: n[6], tMax: n[7] };
    const triangles: Triangle[] = [];
    for (let at = 8; at < n.length; at += 9) triangles.push({ a: vector(at), b: vector(at + 3), c: vector(at + 6) });
    return { ...line, topic: file.topic, isGroup: line.triangles !== undefined, ray, triangles };
  });
});

/** Runs a kernel on the tests, and compares its answers with the exact ones. */
export function compare(kernel: Kernel, { scalar, tolerance = 0, without = [], epsilons = {} }: Choice = {}): Comparison {
  const results: Comparison["results"] = { vectors: sha256, product: kernel.name || "kernel", results: {} };
  const wrong: Comparison["wrong"] = [];
  let asked = 0;
  for (const test of tests) {
    if (scalar && test.scalar !== scalar || without.some((flag) => test.flags.includes(flag))) continue;
    const hits = test.triangles.filter((triangle) => isHit(kernel(test.ray, triangle, epsilons))).length;
    const answer = test.isGroup ? hits : hits ? "hit" : "miss";
    results.results[test.id] = answer;
    const nearEdge = typeof test.margin === "number" && Math.abs(test.margin) <= tolerance && tolerance > 0;
    if (test.result === "free" || nearEdge) continue;
    asked++;
    const isRight = test.result === "exactly-one" ? hits === 1 : test.result === "at-least-one" ? hits > 0 : answer === test.result;
    if (!isRight) wrong.push({ test, answer });
  }
  return { wrong, asked, results };
}
