// The package of test vectors under node: as npm unpacks it, answered by a kernel, and judged by the program (HAIRLINE=path).
import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import path from "node:path";
import { test } from "node:test";

const PROGRAM = process.env.HAIRLINE ?? path.resolve(import.meta.dirname, "../../target/release/hairline");
const parent = mkdtempSync(path.join(tmpdir(), "vectors-"));
const packed = execFileSync("npm", ["pack", "--json", "--pack-destination", parent, path.resolve(import.meta.dirname, "../vectors")], { encoding: "utf8" });
execFileSync("tar", ["-xzf", JSON.parse(packed)[0].filename], { cwd: parent });
const { about, compare, sha256, tests } = await import(path.join(parent, "package/index.js"));

const sub = (p, q) => p.map((x, i) => x - q[i]);
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];

/** Möller and Trumbore's test, in doubles. */
function mollerTrumbore({ origin, direction, tMin, tMax }, { a, b, c }) {
  const [ab, ac, from] = [sub(b, a), sub(c, a), sub(origin, a)];
  const [p, q] = [cross(direction, ac), cross(from, ab)];
  const det = dot(ab, p);
  const [u, v, t] = [dot(from, p) / det, dot(direction, q) / det, dot(ac, q) / det];
  return u >= 0 && v >= 0 && u + v <= 1 && tMin <= t && t <= tMax ? { t, u, v } : null;
}

test("it has every test of the folder, number by number", () => {
  const rows = readFileSync(path.resolve(import.meta.dirname, "../../vectors/core.csv"), "utf8").trim().split("\n").slice(1).map((row) => row.split(","));
  assert.deepEqual(tests.flatMap(({ id, triangles }) => triangles.map((_, i) => `${id} ${i}`)).sort(), rows.map(([id, i]) => `${id} ${i}`).sort());
  const hex = (x, scalar) => {
    const view = new DataView(new ArrayBuffer(8));
    if (scalar === "f32") view.setFloat32(0, x); else view.setFloat64(0, x);
    return Array.from({ length: scalar === "f32" ? 4 : 8 }, (_, i) => view.getUint8(i).toString(16).padStart(2, "0")).join("");
  };
  const by_id = new Map(tests.map((test) => [test.id, test]));
  let numbers = 0;
  for (const row of rows) {
    const { scalar, ray, triangles, result } = by_id.get(row[0]);
    const { a, b, c } = triangles[Number(row[1])];
    const mine = [...ray.origin, ...ray.direction, ray.tMin, ray.tMax, ...a, ...b, ...c];
    mine.forEach((x, i) => {
      const theirs = row[18 + i];
      // JavaScript has one NaN.
      if (!Number.isNaN(x)) assert.equal(hex(x, scalar), theirs, row[0]);
      numbers += 1;
    });
    assert.equal(result, row[4] || row[6]);
  }
  assert.ok(numbers > 10_000);
  for (const { topic, flags } of tests) for (const flag of flags) assert.ok(about[topic].flags[flag], flag);
});

test("what it finds wrong is what the program finds wrong", () => {
  const { wrong, results, asked } = compare(mollerTrumbore);
  assert.ok(wrong.length === 17 && asked > 600, `${wrong.length} of ${asked}`);
  assert.equal(results.vectors, sha256);
  writeFileSync(path.join(parent, "results.json"), JSON.stringify(results));
  const told = spawnSync(PROGRAM, ["verify", path.join(parent, "results.json"), "--format", "json"], { encoding: "utf8" });
  assert.equal(told.status, 1, told.stderr);
  assert.deepEqual(wrong.map(({ test }) => test.id).sort(), JSON.parse(told.stdout).result.wrong.map(({ id }) => id).sort());
});

test("a tolerance, flags and a scalar leave out what they name", () => {
  const all = compare(mollerTrumbore);
  const near = compare(mollerTrumbore, { tolerance: 1e-6 });
  assert.ok(near.asked < all.asked && near.wrong.length < all.wrong.length);
  assert.ok(near.wrong.every(({ test }) => test.isGroup || !(Math.abs(test.margin) <= 1e-6)));
  assert.ok(compare(mollerTrumbore, { without: ["back"] }).wrong.every(({ test }) => !test.flags.includes("back")));
  const single = compare(mollerTrumbore, { scalar: "f32" });
  assert.ok(single.asked < all.asked && single.wrong.every(({ test }) => test.scalar === "f32"));
  // Misses everywhere: wrong where something must be hit.
  assert.ok(compare(() => null).wrong.every(({ test }) => test.result !== "miss"));
});

test("a TypeScript program can use it", () => {
  writeFileSync(path.join(parent, "package.json"), '{ "type": "module" }');
  writeFileSync(path.join(parent, "program.ts"), `import { compare, tests, type Test } from "./package/types/vectors.js";
    const wrong: Test[] = compare(({ origin: [x] }, { a }) => x < a[0], { scalar: "f64" }).wrong.map(({ test }) => test);
    console.log(wrong.length, tests[0].ray.tMax);`);
  const tsc = path.resolve(import.meta.dirname, "../node_modules/.bin/tsc");
  const args = ["--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "program.ts"];
  assert.equal(spawnSync(tsc, args, { cwd: parent, encoding: "utf8" }).stdout, "");
});
