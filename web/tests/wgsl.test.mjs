// Kernels in WGSL evaluated in all ways that WGSL permits: held to evaluations that are drawn at random among the permitted
// ones, by arithmetic that shares nothing with the intervals. HAIRLINE=path is the program, which makes the cases.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { build } from "esbuild";

const PROGRAM = process.env.HAIRLINE ?? path.resolve(import.meta.dirname, "../../target/release/hairline");
const bundled = await build({
  stdin: { contents: 'export * from "./wgsl/kernel"; export * from "./examples"; export * from "./wgsl/verdicts"; export { prelude } from "./gpu"; export { bounded } from "./wgsl/bounded";', resolveDir: path.resolve(import.meta.dirname, "../src") },
  bundle: true, format: "esm", write: false,
});
const folder = mkdtempSync(path.join(tmpdir(), "wgsl-"));
writeFileSync(path.join(folder, "wgsl.mjs"), bundled.outputFiles[0].text);
const { Kernel, WGSL, answers, bounded, permitted, prelude } = await import(path.join(folder, "wgsl.mjs"));

const number = (word) => Number(word.replace("inf", "Infinity"));
const cases = (...args) => execFileSync(PROGRAM, ["generate", "--scalar", "f32", ...args], { encoding: "utf8", maxBuffer: 1 << 28, stdio: ["pipe", "pipe", "ignore"] })
  .split("\n").filter((line) => line.startsWith("case ")).map((line) => line.split(" ").slice(3).map(number))
  .filter((numbers) => numbers.slice(0, 15).every(Number.isFinite));
/** A kernel of a body, with the parts of its input as variables. */
const kernel_of = (body, names = []) => new Kernel(prelude(names), body, names);
const of_value = (expression) => kernel_of(`fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {
  let a = ray.origin.x; let b = ray.origin.y; let c = ray.origin.z; let v = ray.direction; let w = triangle.a;
  return Hit(true, ${expression}, 0.0, 0.0); }`);
const value = (expression, ...numbers) => {
  const [{ t: { lo, hi } }] = of_value(expression).ways([...numbers.map(Math.fround), ...Array(17 - numbers.length).fill(0)], []);
  return [lo, hi];
};

/** Arithmetic on floats that rounds either way, flushes, fuses and adds in any order, as a coin says. */
function machine(seed) {
  let state = seed >>> 0;
  const coin = () => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return state >>> 31 === 1; };
  const bits = new DataView(new ArrayBuffer(4));
  const flushed = (x) => (Math.abs(x) < 2 ** -126 && coin() ? 0 : x);
  /** A neighbour of x + rest, which is x alone if that is a float. */
  const rounded = (x, rest = 0) => {
    const near = Math.fround(x);
    if (near === x && rest === 0) return flushed(near);
    const isBelow = near < x || (near === x && rest > 0);
    if (coin() || near === 0) return flushed(near);
    bits.setFloat32(0, near);
    bits.setInt32(0, bits.getInt32(0) + (isBelow === near > 0 ? 1 : -1));
    return flushed(bits.getFloat32(0));
  };
  // A sum of doubles with what it loses (Knuth).
  const lost = (a, b) => { const s = a + b; const p = s - a; return a - (s - p) + (b - p); };
  const plus = (a, b) => rounded(flushed(a) + flushed(b));
  const minus = (a, b) => plus(a, -b);
  const times = (a, b) => rounded(flushed(a) * flushed(b));
  const sums = (a, b) => { const s = a + b; return rounded(s, lost(a, b)); };
  const fma = (a, b, c) => (coin() ? plus(times(a, b), c) : sums(a * b, c));
  /** Within two and a half ulps. */
  const over = (a, b) => { let q = Math.fround(a / b); for (let i = 0; i < 2; i++) if (coin()) q = rounded(q * (1 + (coin() ? 1 : -1) * 2 ** -25)); return flushed(q); };
  const dot = (p, q) => {
    const order = coin() ? [0, 1, 2] : coin() ? [2, 1, 0] : [1, 2, 0];
    const [i, j, k] = order;
    return fma(p[i], q[i], fma(p[j], q[j], times(p[k], q[k])));
  };
  const cross = (p, q) => [[1, 2], [2, 0], [0, 1]].map(([i, j]) => (coin() ? fma(p[i], q[j], -times(p[j], q[i])) : fma(-p[j], q[i], times(p[i], q[j]))));
  const sub = (p, q) => p.map((x, i) => minus(x, q[i]));
  return { plus, minus, times, over, dot, cross, sub, coin };
}

/** The example of the page on such a machine. */
function drawn({ plus, times, over, dot, cross, sub, coin }, n, parallel) {
  const [o, d, a, b, c] = [0, 3, 6, 9, 12].map((i) => n.slice(i, i + 3));
  const [ab, ac, s] = [sub(b, a), sub(c, a), sub(o, a)];
  const p = cross(d, ac);
  const det = dot(ab, p);
  if (Math.abs(det) < parallel) return undefined;
  // x / y may be x times 1 / y.
  const by = coin() ? (x) => over(x, det) : (x) => times(x, over(1, det));
  const u = by(dot(s, p));
  if (u < 0 || u > 1) return undefined;
  const q = cross(s, ab);
  const v = by(dot(d, q));
  if (v < 0 || plus(u, v) > 1) return undefined;
  const t = by(dot(ac, q));
  return t >= 0 ? [t, u, v] : undefined;
}

const EXAMPLE = kernel_of(WGSL, ["parallel"]);
const PARALLEL = Math.fround(1e-6);
const within = (x, { lo, hi }) => lo <= x && x <= hi || Number.isNaN(x) && lo === -Infinity;
const permits = (ways, values) => ways === undefined || ways.some(({ hit, t, u, v }) =>
  (values ? hit !== false && within(values[0], t) && within(values[1], u) && within(values[2], v) : hit !== true));

test("evaluations that are drawn among the permitted ones are permitted", () => {
  const all = [...cases("-n", "300"), ...cases("--scene", "room", "-n", "300"), ...cases("-n", "100", "--scale", "2^-60"), ...cases("-n", "100", "--scale", "2^60")];
  let [hits, differing] = [0, 0];
  all.forEach((numbers, i) => {
    const ways = EXAMPLE.ways(numbers, [1e-6]);
    const found = Array.from({ length: 6 }, (_, k) => drawn(machine(6 * i + k), numbers, PARALLEL));
    for (const values of found) {
      // What overflows is anything's.
      if (values?.some((x) => !Number.isFinite(x))) continue;
      assert.ok(permits(ways, values), `${numbers} ${values} ${JSON.stringify(ways)}`);
      hits += Number(values !== undefined);
    }
    differing += Number(new Set(found.map((values) => values === undefined)).size > 1);
  });
  assert.ok(all.length > 15_000 && hits > 20_000 && differing > 100, `${all.length} cases, ${hits} hits, ${differing} that differ`);
});

test("the other answer is not permitted where the case is plain", () => {
  for (const [family, least] of [["interior", 0.95], ["outside", 0.95]]) {
    const all = cases("--family", family, "-n", "1000");
    const refused = all.filter((numbers) => {
      const ways = EXAMPLE.ways(numbers, [1e-6]);
      const other = family === "interior" ? undefined : [1, 0.25, 0.25];
      return !permits(ways, other);
    });
    assert.ok(refused.length >= least * all.length, `${family}: ${refused.length} of ${all.length}`);
  }
  // And of a hit with a wrong t: by a thousandth of it.
  const [numbers] = cases("--family", "interior", "-n", "1");
  const values = drawn(machine(1), numbers, PARALLEL);
  assert.ok(permits(EXAMPLE.ways(numbers, [1e-6]), values));
  assert.ok(!permits(EXAMPLE.ways(numbers, [1e-6]), [values[0] * 1.001, values[1], values[2]]));
});

test("verdicts that no permitted evaluation gives are counted, and those of a case named", () => {
  const all = cases("--scene", "room", "-n", "50");
  const verdicts = all.flatMap((numbers, i) => {
    const values = drawn(machine(i), numbers, PARALLEL);
    return values ? [1, ...values] : [0, 0, 0, 0];
  });
  const calls = [100, all.length - 100].map((count, k) => ({
    cases: Float64Array.from(all.slice(100 * k, 100 * k + count).flat()), epsilons: Float64Array.of(1e-6),
    verdicts: Float64Array.from(verdicts.slice(400 * k, 400 * k + 4 * count)),
  }));
  assert.deepEqual(permitted(EXAMPLE, calls, 60_000), { looked_at: all.length, of: all.length, unexplained: 0, undecided: 0 });
  // A device that hits where every evaluation misses.
  const certain = all.findIndex((numbers, i) => 100 < i && answers(EXAMPLE, numbers, [1e-6]) === "miss");
  calls[1].verdicts.set([1, 1, 0.25, 0.25], 4 * (certain - 100));
  const { unexplained, first } = permitted(EXAMPLE, calls, 60_000);
  assert.deepEqual([unexplained, first], [1, all[certain]]);
  assert.ok(permitted(EXAMPLE, calls, 0).looked_at === 0);
  const named = new Set(all.map((numbers) => answers(EXAMPLE, numbers, [1e-6])));
  assert.deepEqual([...named].sort(), ["both", "hit", "miss"]);
});

test("numbers have the values that WGSL's rules give", () => {
  const ulp = 2 ** -23;
  assert.deepEqual(value("a + b", 1, 2 ** -30), [1, 1 + ulp]);
  assert.deepEqual(value("a + b", 1, 2), [3, 3]);
  assert.deepEqual(value("a * b", 3, 5), [15, 15]);
  assert.deepEqual(value("a - b", 1, 2 ** -30), [1 - ulp / 2, 1]);
  // Of three terms the rounding of every order.
  const [lo, hi] = value("a + b - c", 2 ** 30, 1, 2 ** 30);
  assert.ok(lo <= 0 && hi >= 1 && hi < 1000, `${lo} ${hi}`);
  // A fused product keeps what is lost: (1 + e)(1 - e) - 1 is 0 or -e².
  const e = 2 ** -13;
  const [least, most] = value("a * b - c", 1 + e, 1 - e, 1);
  assert.ok(least <= -(e ** 2) && most >= 0);
  // Two and a half ulps of a quotient; nothing where the divisor may be flushed.
  const [below, above] = value("a / b", 1, 3);
  assert.ok(Math.abs((above - below) / (5 * 2 ** -25) - 1) < 0.7, `${below} ${above}`);
  assert.deepEqual(value("a / b", 1, 2 ** -127), [-Infinity, Infinity]);
  assert.deepEqual(value("a / b", 1, 0), [-Infinity, Infinity]);
  assert.deepEqual(value("a * b", 2 ** 100, 2 ** 100), [-Infinity, Infinity]);
  // A subnormal is kept or flushed.
  assert.deepEqual(value("a * 1.0", 2 ** -130), [0, 2 ** -130]);
  // A literal that is no float is either beside it.
  assert.deepEqual(value("0.1"), [Math.fround(0.1) - 2 ** -27, Math.fround(0.1)]);
  assert.deepEqual(value("-0.25 + 0x1.8p1f"), [2.75, 2.75]);
  // Nothing is folded before it is looked at.
  for (const text of ["1.0 / 3.0", "0.1 * 0.1", "0.1 + 0.2", "-(1.0 / 3.0)", "2 * 0.1"]) assert.ok(value(text)[0] < value(text)[1], text);
  // Operators bind as in WGSL.
  for (const [text, exact] of [["a - b - c", 3], ["a - b * c", 2], ["-a * b + c", -22], ["(a - b) * -c", -10], ["a - (b - c)", 7], ["a / b / c", 4 / 3]]) {
    const [least, most] = value(text, 8, 3, 2);
    assert.ok(least <= exact && exact <= most && most - least < 1e-4, `${text}: ${least} ${most}`);
  }
  assert.deepEqual(value("select(a, b, a < b)", 3, 2), [3, 3]);
  assert.deepEqual(value("select(a, b, a + 0x1p-30 > 1.0)", 1, 2), [1, 2]);
  assert.deepEqual(value("max(abs(a), b) + dot(v, w)", -3, 2, 0, 1, 2, 3, 1, 0, 0).map(Math.round), [4, 4]);
  assert.deepEqual(value("vec3f(a, b, c).zy.x", 1, 2, 3), [3, 3]);
});

test("branches, loops, variables and functions are followed", () => {
  const loop = kernel_of(`
    const LAST: i32 = 2;
    struct Pair { x: f32, y: f32 }
    fn swapped(p: Pair) -> Pair { return Pair(p.y, p.x); }
    fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {
      var sum = vec3f(); var most: f32;
      let corners = array<vec3f, 3>(triangle.a, triangle.b, triangle.c);
      for (var i = 0; i < LAST; i++) { if (i == 1) { continue; } sum += corners[i]; sum.y = 7.0; }
      if (sum.x > ray.origin.x) { most = sum.x; } else if (sum.x == ray.origin.x) { most = 1.0; } else { most = 2.0; }
      let p = swapped(Pair(most, sum.y));
      return Hit(p.x >= 7.0 && !(p.y < 0.0), p.y, p.x, 0x1p-3);
    }`);
  const numbers = (x) => [x, 0, 0, 0, 0, 0, 4, 0, 0, 9, 9, 9, 3, 0, 0, 0, Infinity];
  for (const [x, t] of [[2, 4], [4, 1], [5, 2]]) {
    const [way, ...others] = loop.ways(numbers(x), []);
    assert.deepEqual([others.length, way.hit, way.t.lo, way.t.hi, way.u.lo, way.v.lo], [0, true, t, t, 7, 0.125], `x = ${x}`);
  }
  // A whole number where a float is declared is one.
  const declared = kernel_of(`
    struct Pair { x: f32, y: f32 }
    fn half(x: f32) -> f32 { return x / 2; }
    fn one() -> f32 { return 1; }
    fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {
      var x: f32; x = 3; let p = Pair(5, 1); let a = array<f32, 2>(7, 1);
      return Hit(one() / 2 > 0.4 && select(9, 2.0, false) / 2 > 4.4 && 1 / 2 == 0, half(3) + x / 2, p.x / 2, a[0] / 2);
    }`);
  const [{ hit, t, u, v }] = declared.ways(numbers(0), []);
  assert.deepEqual([hit, t.lo, t.hi, u.lo, v.hi].map((x) => (x === true ? x : Math.round(1e5 * x) / 1e5)), [true, 3, 3, 2.5, 3.5]);
  // A result that is filled in, as libraries write it.
  const filled = kernel_of(`
    struct Found { at: vec3f, ok: bool, side: f32 }
    fn found(ray: Ray, t: f32) -> Found {
      var result: Found;
      result.ok = false;
      if (t < 0.0) { return result; }
      result.ok = true; result.at = ray.origin + t * ray.direction; result.side = sign(-t) * length(normalize(vec3f(3.0, 4.0, 0.0)));
      return result;
    }
    fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit { let f = found(ray, ray.origin.x); return Hit(f.ok, f.at.x, f.side, f.at.y); }`);
  const [hits] = filled.ways(numbers(2), []);
  assert.deepEqual([hits.hit, hits.t.lo, hits.t.hi, Math.round(hits.u.hi)], [true, 2, 2, -1]);
  assert.equal(filled.ways(numbers(-2), [])[0].hit, false);
  assert.throws(() => of_value("sin(a)").ways(Array(17).fill(1), []), /^Error: the kernel has the function sin, which this page does not evaluate/);
  assert.throws(() => kernel_of("fn test() -> f32 { return 1.0; }"), /no function named kernel/);
  // Without an end it is given up.
  assert.equal(kernel_of("fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit { loop { } return Hit(true, 1.0, 1.0, 1.0); }").ways(Array(17).fill(1), []), undefined);
});

test("each loop of a kernel is counted, and nothing else is changed", () => {
  const counted = " if (hairline_steps == 0u) { break; } hairline_steps -= 1u; ";
  // `#` stands for what is put in.
  for (const text of [
    "for (var i = 0; i < 9; i++) {#x(); }",
    "while a(b, (c)) {#for (;;) {#if (d) { e(); } } }",
    "loop {#continuing { break if (x); } } if (y) { z(); }",
    "loop @diagnostic(off, derivative_uniformity) {#}",
    "while /* { */ (x) // {\n {#}",
    "// for (;;) {\nlet loops = before.while_ + fore;",
    "/* loop { /* for { */ while { */ loop {#}",
    "/*/ loop { */ loop {#}",
    ...["\n", "\v", "\f", "\r", "\u0085", "\u2028", "\u2029"].map((end) => `// x${end} loop {#}`),
    "let löop = 1; let xwhile = 2; let for1 = 3; { x(); }",
    WGSL,
  ]) assert.equal(bounded(text.replaceAll("#", "")), text.replaceAll("#", counted));
  assert.throws(() => bounded("fn f() {\n hairline_steps = 1u; }"), /^Error: line 2: names that begin with hairline_/);
});
