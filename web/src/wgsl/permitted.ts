// Numbers in WGSL: for each the interval of all values that some evaluation gives which WGSL's accuracy rules permit
// (https://www.w3.org/TR/WGSL/#floating-point-evaluation).
//
// - A sum, a difference or a product is either of the floats around the exact result, that itself if it is a float; a quotient is
//   within 2.5 ulps where the divisor is from 2^-126 to 2^126, and anything elsewhere.
// - Sums are added, products and quotients multiplied and divided, in any order, and fused: a value keeps the exact interval
//   of its terms or factors, from which the bound of every order is made. Products are not distributed over sums.
// - Subnormals are kept or flushed. An overflow, an infinity or a NaN may become anything.

const EPSILON = 2 ** -23;
/** The least normal float: nothing that is flushed is larger. */
const TINY = 2 ** -126;
const MOST = 2 ** 128 - 2 ** 104;

/** All values of a number. */
export interface Value {
  lo: number;
  hi: number;
  /** The exact sum of its terms, the sum of their sizes, and how many roundings there are. */
  sum?: { lo: number; hi: number; size: number; roundings: number };
  /** The exact product of its factors; of those with size above 1, or below, the product of the sizes; and how many
   * roundings there are, in those of a product. */
  product?: { lo: number; hi: number; most: number; least: number; roundings: number };
}

/** A NaN too. */
export const ANYTHING: Value = { lo: -Infinity, hi: Infinity };
const isAny = ({ lo }: Value) => lo === -Infinity;

const bits = new DataView(new ArrayBuffer(4));
/** The next float above, or below. */
function beside(x: number, up: boolean): number {
  if (x === 0) return up ? 2 ** -149 : -(2 ** -149);
  bits.setFloat32(0, x);
  bits.setInt32(0, bits.getInt32(0) + (up === x > 0 ? 1 : -1));
  return bits.getFloat32(0);
}
/** The largest float that is at most x + rest, where the rest is less than an ulp of a double. */
function down(x: number, rest = 0): number {
  const float = Math.fround(x);
  return float > x || (float === x && rest < 0) ? beside(float, false) : float;
}
const up = (x: number, rest = 0) => -down(-x, -rest);
/** Outwards by more than the rounding of a double. */
const below = (x: number) => x - Math.abs(x) * 2 ** -51;
const above = (x: number) => x + Math.abs(x) * 2 ** -51;
/** What a sum of doubles has lost. */
function rest(a: number, b: number): number {
  const sum = a + b;
  const part = sum - a;
  return a - (sum - part) + (b - part);
}

/** An interval of results: what is subnormal may be 0, and what overflows anything. */
function made(lo: number, hi: number, parts: Pick<Value, "sum" | "product"> = {}): Value {
  if (!(-MOST <= lo && hi <= MOST)) return ANYTHING;
  return { lo: 0 < lo && lo < TINY ? 0 : lo, hi: -TINY < hi && hi < 0 ? 0 : hi, ...parts };
}

/** A number that is read. */
export const given = (x: number) => made(x, x);
/** A literal: if it is no float, either that is beside it. */
export const literal = (x: number) => made(down(x), up(x));
export const hull = (a: Value, b: Value) => made(Math.min(a.lo, b.lo), Math.max(a.hi, b.hi));

export function negative({ lo, hi, sum, product }: Value): Value {
  const turned = <T extends { lo: number; hi: number }>(part: T | undefined) => part && { ...part, lo: -part.hi, hi: -part.lo };
  return { lo: -hi, hi: -lo, sum: turned(sum), product: turned(product) };
}

export function plus(a: Value, b: Value): Value {
  if (isAny(a) || isAny(b)) return ANYTHING;
  const [p, q] = [a, b].map(({ lo, hi, sum }) => sum ?? { lo, hi, size: Math.max(-lo, hi), roundings: 0 });
  const size = above(p.size + q.size);
  if (size > MOST) return ANYTHING;
  const roundings = p.roundings + q.roundings + 1;
  const sum = { lo: below(p.lo + q.lo), hi: above(p.hi + q.hi), size, roundings };
  if (roundings === 1) return made(down(p.lo + q.lo, rest(p.lo, q.lo)), up(p.hi + q.hi, rest(p.hi, q.hi)), { sum });
  const off = roundings * (EPSILON * 1.001 * size + TINY);
  return made(sum.lo - off, sum.hi + off, { sum });
}
export const minus = (a: Value, b: Value) => plus(a, negative(b));

function factors({ lo, hi, product }: Value) {
  const [small, large] = [lo <= 0 && 0 <= hi ? 0 : Math.min(Math.abs(lo), Math.abs(hi)), Math.max(-lo, hi)];
  return product ?? { lo, hi, most: Math.max(1, large), least: Math.min(1, small), roundings: 0 };
}

function multiplied(p: NonNullable<Value["product"]>, q: NonNullable<Value["product"]>, more: number): Value {
  const corners = [p.lo * q.lo, p.lo * q.hi, p.hi * q.lo, p.hi * q.hi];
  const [lo, hi] = [Math.min(...corners), Math.max(...corners)];
  const roundings = p.roundings + q.roundings + more;
  const product = { lo: below(lo), hi: above(hi), most: above(p.most * q.most), least: below(p.least * q.least), roundings };
  // The product of two floats is a double.
  if (roundings === 1) return made(down(lo), up(hi), { product });
  if (!(product.most <= MOST)) return ANYTHING;
  const relative = roundings * EPSILON * 1.001;
  const off = roundings * TINY * product.most;
  return made(product.lo - Math.abs(product.lo) * relative - off, product.hi + Math.abs(product.hi) * relative + off, { product });
}

export const times = (a: Value, b: Value) => (isAny(a) || isAny(b) ? ANYTHING : multiplied(factors(a), factors(b), 1));

export function over(a: Value, b: Value): Value {
  const [small, large] = [Math.min(Math.abs(b.lo), Math.abs(b.hi)), Math.max(-b.lo, b.hi)];
  if (isAny(a) || (b.lo <= 0 && 0 <= b.hi) || small < TINY || large > 2 ** 126) return ANYTHING;
  const { lo, hi, most, least, roundings } = factors(b);
  if (lo <= 0 && 0 <= hi) return ANYTHING;
  return multiplied(factors(a), { lo: below(1 / hi), hi: above(1 / lo), most: above(1 / least), least: below(1 / most), roundings }, 2.5);
}

/** A function that grows, of results off by so many ulps. */
function grown(a: Value, of: (x: number) => number, ulps: number): Value {
  const relative = ulps * EPSILON * 1.001;
  return made(below(of(a.lo)) * (1 - relative), above(of(a.hi)) * (1 + relative));
}
export const inverse_root = ({ lo, hi }: Value) => (lo < TINY ? ANYTHING : grown({ lo: hi, hi: lo }, (x) => 1 / Math.sqrt(x), 2));
/** 1 over the inverse root, which is of 2 ulps. */
export const root = (a: Value) => (a.lo < TINY ? ANYTHING : grown(a, Math.sqrt, 4.6));
/** Whole numbers: exact. */
export const whole = (a: Value, of: (x: number) => number) => (isAny(a) ? ANYTHING : made(of(a.lo), of(a.hi)));

export function size(a: Value): Value {
  if (a.lo >= 0 || isAny(a)) return made(a.lo, a.hi);
  return a.hi <= 0 ? negative(made(a.lo, a.hi)) : made(0, Math.max(-a.lo, a.hi));
}
export function smaller(a: Value, b: Value): Value {
  if (isAny(a) || isAny(b)) return ANYTHING;
  // Of two subnormals it may be either.
  if ([a.lo, a.hi, b.lo, b.hi].every((x) => Math.abs(x) < TINY)) return hull(a, b);
  return made(Math.min(a.lo, b.lo), Math.min(a.hi, b.hi));
}
export const larger = (a: Value, b: Value) => negative(smaller(negative(a), negative(b)));

/** True, false, or null where evaluations differ. */
export type Truth = boolean | null;
export function less(a: Value, b: Value): Truth {
  if (isAny(a) || isAny(b)) return null;
  return a.hi < b.lo ? true : a.lo >= b.hi ? false : null;
}
export function equal(a: Value, b: Value): Truth {
  if (isAny(a) || isAny(b)) return null;
  if (a.hi < b.lo || b.hi < a.lo) return false;
  return a.lo === a.hi && b.lo === b.hi ? true : null;
}
export const not = (truth: Truth) => (truth === null ? null : !truth);
export const both = (a: Truth, b: Truth): Truth => (a === false || b === false ? false : a && b);
