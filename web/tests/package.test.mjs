// The npm package under node, held to the program: HAIRLINE=path, or target/release/hairline. See run.sh.
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";
import { load, truthOf } from "../package/hairline.js";

const PROGRAM = process.env.HAIRLINE ?? path.resolve(import.meta.dirname, "../../target/release/hairline");
const program = (args, options = {}) =>
  execFileSync(PROGRAM, args, { encoding: "utf8", maxBuffer: 1 << 30, stdio: ["pipe", "pipe", "ignore"], ...options });
const hairline = await load();

/** The program's cases: their lines as JSON, and 17 numbers each. */
function generated(scalar, args) {
  const number = (word) => Number(word.replace("inf", "Infinity"));
  const lines = program(["generate", "--scalar", scalar, ...args]).split("\n").filter((line) => line.startsWith("case "));
  const words = lines.map((line) => line.split(" ").slice(3));
  const vectors = ["origin", "direction", "a", "b", "c"];
  const json = words.map((numbers) => {
    const text = (word) => (/^-?[0-9]/.test(word) ? word : `"${word}"`);
    const parts = vectors.map((name, i) => `"${name}":[${numbers.slice(3 * i, 3 * i + 3).map(text)}]`);
    return `{"scalar":"${scalar}",${parts},"t_min":${text(numbers[15])},"t_max":${text(numbers[16])}}`;
  });
  return { json, numbers: Float64Array.from(words.flat(), number) };
}

/** A truth as the program writes it. */
function line(code) {
  const truth = truthOf(code);
  const none = { facing: null, t: null, feature: null, contact: null };
  if (truth.class === "transversal") {
    return { class: truth.class, ...none, facing: truth.facing, t: truth.place, feature: truth.feature };
  }
  if (!("contact" in truth)) return { class: truth.class, ...none };
  const isPoint = truth.contact !== "none" && truth.contact !== "segment";
  const contact = { kind: isPoint ? "point" : truth.contact, feature: isPoint ? truth.contact : null };
  return { class: truth.class, ...none, contact };
}

for (const scalar of ["f32", "f64"]) {
  test(`100,000 truths in ${scalar} are those of the program`, () => {
    const { json, numbers } = generated(scalar, ["-n", "3000"]);
    assert.ok(json.length > 100_000, `${json.length} cases`);
    const told = program(["truth", "-"], { input: json.join("\n") }).trim().split("\n").map((text) => JSON.parse(text));
    const codes = hairline.truths(numbers, scalar);
    assert.equal(codes.length, told.length);
    const classes = new Map();
    told.forEach(({ name: _, hits_closed: __, ...truth }, i) => {
      classes.set(truth.class, (classes.get(truth.class) ?? 0) + 1);
      assert.deepEqual(line(codes[i]), truth, json[i]);
    });
    assert.equal(classes.size, 5, "every class occurs");
    assert.ok(Math.min(...classes.values()) > 500, JSON.stringify([...classes]));
  });
}

test("the exact numbers of a case are those of the program", () => {
  const { json } = generated("f64", ["-n", "40", "--seed", "3"]);
  const told = program(["truth", "--exact", "-"], { input: json.join("\n") }).trim().split("\n").map((text) => JSON.parse(text));
  told.forEach((truth, i) => assert.deepEqual(hairline.truth(json[i]), truth, json[i]));
  const truth = hairline.truth({ origin: [1, 1, 1], direction: [0, 0, -1], a: [0, 0, 0], b: [3, 0, 0], c: [0, 3, 0] });
  assert.deepEqual([truth.t_exact, truth.u_exact, truth.feature], ["1/1", "1/3", "interior"]);
});

const audited = (args) => JSON.parse(program(["audit", "--quiet", "--format", "json", ...args])).result;
/** Both as JSON, which tells a number from another by every bit. */
const same = (record, told) => assert.deepEqual(record.result, told);

for (const scalar of ["f32", "f64"]) {
  test(`an audit of a built-in kernel in ${scalar} is the program's, number by number`, () => {
    const told = audited(["--kernel", "moller-trumbore", "--epsilon", "parallel=1e-5", "--scalar", scalar, "-n", "300"]);
    const { record } = hairline.audit("moller-trumbore", { scalar, count: 300, epsilons: { parallel: "1e-5" } });
    same(record, told);
    assert.ok(told.results.some(({ findings }) => findings.length > 0));
  });
}

test("so is one in a scene", () => {
  const told = audited(["--kernel", "woop-watertight", "--scene", "room", "--scalar", "f32", "-n", "200"]);
  same(hairline.audit("woop-watertight", { scalar: "f32", scene: "room", count: 200 }).record, told);
});

const sub = (p, q) => p.map((x, i) => x - q[i]);
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];

/** Möller and Trumbore's test, in doubles. */
function mollerTrumbore({ origin, direction }, { a, b, c }, { parallel }) {
  const [ab, ac, from] = [sub(b, a), sub(c, a), sub(origin, a)];
  const p = cross(direction, ac);
  const det = dot(ab, p);
  if (det > -parallel && det < parallel) return null;
  const u = dot(from, p) * (1 / det);
  if (u < 0 || u > 1) return null;
  const q = cross(from, ab);
  const v = dot(direction, q) * (1 / det);
  if (v < 0 || u + v > 1) return null;
  return { t: dot(ac, q) * (1 / det), u, v };
}

test("a kernel in JavaScript is judged as the same kernel in Rust", () => {
  // Its contract has no words of its own but these, and no gate is known.
  const { kernel: _, ...options } = { kernel: 0, count: 500, epsilons: { parallel: 1e-6 } };
  const contract = "extent=line,sides=both,boundary=closed,coplanar=miss,degenerate=miss,invalid=free";
  const mine = hairline.audit(mollerTrumbore, { ...options, contract }).record.result.results;
  const told = audited(["--kernel", "moller-trumbore", "--scalar", "f64", "-n", "500", "--contract", contract]).results;
  const counts = ({ family, total }) => ({ family, ...total });
  assert.deepEqual(mine.map(counts), told.map(counts));
  assert.ok(told.some(({ total }) => total.false_hits.count > 0));
});

test("the kernel that the lab saves gives the program the same verdicts", async () => {
  const { build } = await import("esbuild");
  const source = new URL("../src/", import.meta.url);
  const bundled = await build({
    stdin: { contents: 'export * from "./take-home"; export * from "./examples"; export * from "./kernel";', resolveDir: source.pathname },
    bundle: true, format: "esm", write: false,
  });
  const folder = mkdtempSync(path.join(tmpdir(), "lab-"));
  writeFileSync(path.join(folder, "lab.mjs"), bundled.outputFiles[0].text);
  const { takeHome, EXAMPLES, describe } = await import(path.join(folder, "lab.mjs"));
  for (const [name, text] of Object.entries(EXAMPLES)) {
    const plain = path.join(folder, `${name.length}.mjs`);
    writeFileSync(plain, text);
    const described = describe(await import(plain));
    assert.deepEqual(described.gives, name.startsWith("plane") ? [true, false] : [true, true], name);
    writeFileSync(path.join(folder, "kernel.mjs"), takeHome(text, described));
    const args = ["audit", "--quiet", "--format", "json", "--kernel-cmd", "node kernel.mjs", "--scalar", "f64", "-n", "60"];
    const told = JSON.parse(program(args, { cwd: folder })).result.results;
    const { kernel, epsilons, contract } = described;
    const mine = hairline.audit(kernel, { epsilons, contract, count: 60 }).record.result.results;
    assert.deepEqual(mine.map(({ family, total }) => [family, total]), told.map(({ family, total }) => [family, total]), name);
  }
});

test("what is wrong with a request is said in a line", () => {
  const never = () => null;
  for (const [options, message] of [
    [{ count: 0 }, /^count: 0 is not 1 to/],
    [{ families: ["edge"] }, /no family 'edge'/],
    [{ scene: "moon" }, /^scene: 'moon' is no scene/],
    [{ contract: "closed" }, /^contract: /],
    [{ epsilons: { "a b": 1 } }, /^epsilon a b: a name has letters/],
    [{ epsilons: { edge: Infinity } }, /^epsilon edge: expected a finite number, found Infinity/],
    [{ scalar: "f16" }, /unknown scalar 'f16'/],
  ]) assert.throws(() => hairline.audit(never, options), { message }, JSON.stringify(options));
  assert.throws(() => hairline.audit(() => {}), /^Error: the kernel returns undefined for a ray through the middle of a triangle: is a `return` missing/);
  // Misses may be undefined.
  assert.match(hairline.audit(({ origin: [, , z] }) => { if (z > 0) return 1; }, { count: 5 }).title, /^yours \(own\) leaks: /);
  assert.throws(() => hairline.audit("moller"), /no kernel 'moller'/);
  assert.throws(() => hairline.truths(new Float64Array(16)), /17 numbers a case, found 16/);
  for (const [id, message] of [
    ["nothing", /not a case id/], ["edge-near@2/f16/-/1/2", /its scalar is 'f16', expected f32 or f64/], ["edge@1/f32/-/1/2", /makes no cases of/],
    ["edge-near@2/f32/-/1/2.7", /has 1 triangle, counted from 0/], ["scene-shadow@1/f32/kernel=none/1/2", /no kernel 'none'/],
    ['{"scalar":"f32"}', /origin/],
  ]) assert.throws(() => hairline.truth(id), message, id);
  // And the next request is answered.
  assert.equal(hairline.truth("edge-near@2/f64/-/1/2").class, "transversal");
});

test("what a hit does not report is not judged, from whichever side it comes", () => {
  const kinds = (kernel) => new Set(hairline.audit(kernel, { count: 50 }).record.result.results
    .flatMap(({ findings }) => findings.map(({ finding }) => finding)));
  const isFront = ({ origin: [, , z] }) => z > 0;
  // A kernel that hits everything is refused.
  const isNear = ({ origin: [x] }) => Math.abs(x) < 30;
  for (const [hit, expected] of [[() => true, false], [() => ({ t: 1 }), true], [() => 1, true],
    [(ray) => (isFront(ray) ? null : { t: 1 }), true], [(ray) => (isFront(ray) ? null : true), false]]) {
    const found = kinds((ray) => (isNear(ray) ? hit(ray) : null));
    assert.ok(found.has("false-hit"), String(hit));
    assert.equal(found.has("wrong-value"), expected, String(hit));
  }
});

test("what a kernel promises less is told with the contract that says so", async () => {
  const { build } = await import("esbuild");
  const source = new URL("../src/kernel.ts", import.meta.url).pathname;
  const folder = mkdtempSync(path.join(tmpdir(), "lab-"));
  await build({ entryPoints: [source], bundle: true, format: "esm", outfile: path.join(folder, "kernel.mjs") });
  const { describe, hint } = await import(path.join(folder, "kernel.mjs"));
  const culling = (ray, { a, b, c }) =>
    (dot(ray.direction, cross(sub(b, a), sub(c, a))) < 0 ? mollerTrumbore(ray, { a, b, c }, { parallel: 0 }) : null);
  const described = describe({ default: culling });
  const { contract, gives } = described;
  assert.match(hint(described), /^It misses a plain triangle from the back, and hits what lies behind the ray's start\. If that is meant, say so: export const contract = "([^"]+)"/);
  assert.deepEqual(gives, [true, true]);
  const said = /contract = "([^"]+)"/.exec(hint(described))[1];
  const wrong = (contract) => hairline.audit(culling, { count: 50, contract }).record.result.results
    .filter(({ family }) => family === "behind").flatMap(({ findings }) => findings).length;
  assert.ok(wrong(contract) > 0);
  assert.equal(wrong(said), 0);
  assert.equal(hint(describe({ default: culling, contract: said })), "");
  assert.equal(hint(describe({ default: (ray, triangle) => ((h) => (h && h.t >= 0 ? h : null))(mollerTrumbore(ray, triangle, { parallel: 0 })) })), "");
});

test("answers that no kernel can mean are told before the audit", () => {
  const inside = (ray, triangle) => mollerTrumbore(ray, triangle, { parallel: 0 });
  const plain = { count: 10 };
  const told = (kernel, message) => assert.throws(() => hairline.audit(kernel, plain), { message });
  for (const miss of [-1, Infinity, NaN]) {
    told((ray, triangle) => inside(ray, triangle)?.t ?? miss, new RegExp(`reports a hit \\(${miss}\\) for rays that pass far beside .* return null instead`));
  }
  told(async (ray, triangle) => inside(ray, triangle), /returns a Promise: it must answer at once/);
  told(({ origin }, triangle) => (triangle.a ? { t: origin.x } : null), /./);
  told(({ origin }) => ({ t: origin.x * 2 }), /returns t = NaN for a ray through the middle .* Vectors are \[x, y, z\]/);
});

test("an exception is a finding, and does not end the audit", () => {
  const { record } = hairline.audit(({ direction }) => {
    if (direction[0] > 0.5) throw new Error("no");
    return null;
  }, { count: 100 });
  const kinds = new Set(record.result.results.flatMap(({ findings }) => findings.map(({ finding }) => finding)));
  assert.ok(kinds.has("panic") && kinds.has("false-miss"), [...kinds].join());
});

test("an exception on a plain ray is the user's to see", () => {
  assert.throws(() => hairline.audit(() => { throw new TypeError("no"); }), { name: "TypeError", message: "no" });
});

test("a TypeScript program can use it, and is told what it cannot do", () => {
  const folder = mkdtempSync(path.join(tmpdir(), "types-"));
  mkdirSync(path.join(folder, "node_modules"));
  symlinkSync(path.resolve(import.meta.dirname, "../package"), path.join(folder, "node_modules/hairline-audit"));
  writeFileSync(path.join(folder, "package.json"), '{ "type": "module" }');
  const start = 'import { load, truthOf, type Kernel, type Truth } from "hairline-audit";\nconst hairline = await load();\n';
  const check = (text) => {
    writeFileSync(path.join(folder, "program.ts"), start + text);
    const tsc = path.resolve(import.meta.dirname, "../node_modules/.bin/tsc");
    const args = ["--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "program.ts"];
    return spawnSync(tsc, args, { cwd: folder, encoding: "utf8" }).stdout;
  };
  assert.equal(check(`
    const kernel: Kernel = ({ origin: [x] }, { a }, { edge }) => (x - a[0] < edge ? null : { t: 1 });
    const title: string = hairline.audit(kernel, { scene: "room", epsilons: { edge: 0 } }).title;
    const truth: Truth = truthOf(hairline.truths(new Float64Array(17))[0]);
    console.log(title, truth.class === "transversal" ? truth.feature : truth.class);
  `), "");
  assert.match(check("hairline.audit(() => 'hit');"), /error TS2345[^]*'string' is not assignable to type 'Hit'/);
  assert.match(check("hairline.truths([1, 2]);"), /error TS2345/);
});
