// Runs Möller and Trumbore's test, in doubles, on the core set: node reader.mjs ../../vectors results.json
import { readFileSync, readdirSync, writeFileSync } from "node:fs";

const [folder = "vectors", output = "results.json"] = process.argv.slice(2);
const product = "Moller-Trumbore in JavaScript";
const minus = (p, q) => p.map((x, i) => x - q[i]);
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];

// n holds origin, direction, t_min, t_max, a, b and c.
function hits(n) {
  const [o, d, a, b, c] = [0, 3, 8, 11, 14].map((i) => n.slice(i, i + 3));
  const [e, f, s] = [minus(b, a), minus(c, a), minus(o, a)];
  const [p, q] = [cross(d, f), cross(s, e)];
  const det = dot(e, p);
  if (det === 0) return false;
  const [u, v, t] = [dot(s, p) / det, dot(d, q) / det, dot(f, q) / det];
  return u >= 0 && v >= 0 && u + v <= 1 && n[6] <= t && t <= n[7];
}

// JavaScript reads no hexadecimal floats, so the bit patterns it is.
const view = new DataView(new ArrayBuffer(8));
function number(bits) {
  view.setBigUint64(0, BigInt("0x" + bits));
  return bits.length === 8 ? view.getFloat32(4) : view.getFloat64(0);
}

const results = {};
let failed = 0;
for (const file of readdirSync(folder).filter((name) => name.endsWith(".json")).sort()) {
  for (const test of JSON.parse(readFileSync(`${folder}/${file}`, "utf8")).tests) {
    const n = test.bits.split(" ").map(number);
    let count = 0;
    for (let i = 8; i < n.length; i += 9) count += hits([...n.slice(0, 8), ...n.slice(i, i + 9)]);
    const answer = test.triangles ? count : count ? "hit" : "miss";
    const right = { "exactly-one": count === 1, "at-least-one": count > 0, free: true };
    if (!(right[test.result] ?? answer === test.result)) failed++;
    results[test.id] = answer;
  }
}
console.log(`${product}: ${Object.keys(results).length - failed} passed, ${failed} failed`);
const vectors = readFileSync(`${folder}/sha256.txt`, "utf8").trim();
writeFileSync(output, JSON.stringify({ vectors, product, results }, null, 0) + "\n");
