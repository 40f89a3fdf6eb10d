// Kernels to start from, written for this page after their sources.

export const EXAMPLES: Record<string, string> = {
  "Möller–Trumbore": `// Möller and Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
// Vectors are [x, y, z]. A miss is null; a hit is { t, u, v }, or t alone, or true.

export const epsilons = { parallel: 1e-6 };
// What it promises: hits of the triangle at t >= 0. On its edges, in its plane, for a
// triangle without area and for NaN both answers are right.
export const contract = "closed-ray,boundary=free,coplanar=free,degenerate=free,invalid=free";

const sub = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [
  p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0],
];

export default function kernel({ origin, direction }, { a, b, c }, epsilon) {
  const ab = sub(b, a);
  const ac = sub(c, a);
  const p = cross(direction, ac);
  const det = dot(ab, p);
  if (Math.abs(det) < epsilon.parallel) return null;
  const from = sub(origin, a);
  const u = dot(from, p) / det;
  if (u < 0 || u > 1) return null;
  const q = cross(from, ab);
  const v = dot(direction, q) / det;
  if (v < 0 || u + v > 1) return null;
  const t = dot(ac, q) / det;
  return t >= 0 ? { t, u, v } : null;
}
`,
  "after Eberly": `// Eberly's test (Geometric Tools), which older releases of three.js had: both sides of the line
// are scaled by |d·n|, and divided once. Without culling.

export const epsilons = {};
export const contract = "closed-ray,boundary=free,coplanar=free,degenerate=free,invalid=free";

const sub = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [
  p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0],
];

export default function kernel({ origin, direction }, { a, b, c }) {
  const ab = sub(b, a);
  const ac = sub(c, a);
  const n = cross(ab, ac);
  const along = dot(direction, n);
  if (!(along > 0 || along < 0)) return null;
  const sign = along > 0 ? 1 : -1;
  const scale = Math.abs(along);
  const from = sub(origin, a);
  const u = sign * dot(direction, cross(from, ac));
  if (u < 0) return null;
  const v = sign * dot(direction, cross(ab, from));
  if (v < 0 || u + v > scale) return null;
  const t = -sign * dot(from, n);
  return t < 0 ? null : { t: t / scale, u: u / scale, v: v / scale };
}
`,
  "plane, then sides": `// The plane's t first, then on which side of each edge the point lies.

export const epsilons = { parallel: 1e-9, edge: 0 };
export const contract = "closed-ray,boundary=free,coplanar=free,degenerate=free,invalid=free";

const sub = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) => [
  p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0],
];

export default function kernel({ origin, direction }, { a, b, c }, epsilon) {
  const n = cross(sub(b, a), sub(c, a));
  const along = dot(direction, n);
  if (Math.abs(along) <= epsilon.parallel) return null;
  const t = dot(sub(a, origin), n) / along;
  if (t < 0) return null;
  const p = origin.map((x, i) => x + t * direction[i]);
  const side = (from, to) => dot(cross(sub(to, from), sub(p, from)), n);
  const inside = side(a, b) >= epsilon.edge && side(b, c) >= epsilon.edge && side(c, a) >= epsilon.edge;
  return inside ? t : null;
}
`,
  "Woop, watertight": `// Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection", in doubles and
// without the fallback to more digits: the triangle is sheared so that the ray is an axis.

export const epsilons = {};
export const contract = "closed-ray,coplanar=free,degenerate=free,invalid=free,across=at-least-one";

export default function kernel({ origin, direction }, { a, b, c }) {
  const lengths = direction.map(Math.abs);
  const z = lengths.indexOf(Math.max(...lengths));
  let x = (z + 1) % 3;
  let y = (x + 1) % 3;
  if (direction[z] < 0) [x, y] = [y, x];
  const shear = [direction[x] / direction[z], direction[y] / direction[z], 1 / direction[z]];
  const [ax, ay, az, bx, by, bz, cx, cy, cz] = [a, b, c].flatMap((p) => {
    const depth = p[z] - origin[z];
    return [p[x] - origin[x] - shear[0] * depth, p[y] - origin[y] - shear[1] * depth, shear[2] * depth];
  });
  const u = cx * by - cy * bx;
  const v = ax * cy - ay * cx;
  const w = bx * ay - by * ax;
  if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) return null;
  const det = u + v + w;
  if (det === 0) return null;
  const t = (u * az + v * bz + w * cz) / det;
  return t >= 0 ? { t, u: v / det, v: w / det } : null;
}
`,
};

/** One to start from in WGSL. */
export const WGSL = `// Möller and Trumbore's test on your own graphics device, in single precision.
// A comment "epsilon NAME = VALUE" makes a slider and a member of Epsilon.
// epsilon parallel = 1e-6
// contract closed-ray,boundary=free,coplanar=free,degenerate=free,invalid=free

fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {
  let miss = Hit(false, 0.0, 0.0, 0.0);
  let ab = triangle.b - triangle.a;
  let ac = triangle.c - triangle.a;
  let p = cross(ray.direction, ac);
  let det = dot(ab, p);
  if (abs(det) < epsilon.parallel) { return miss; }
  let s = ray.origin - triangle.a;
  let u = dot(s, p) / det;
  if (u < 0.0 || u > 1.0) { return miss; }
  let q = cross(s, ab);
  let v = dot(ray.direction, q) / det;
  if (v < 0.0 || u + v > 1.0) { return miss; }
  let t = dot(ac, q) / det;
  return Hit(t >= 0.0, t, u, v);
}
`;
