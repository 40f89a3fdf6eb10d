// Verdicts of a device, told apart: those that some evaluation gives which WGSL permits, and those that none gives.
import type { Kernel, Way } from "./kernel";
import type { Value } from "./permitted";

/** What WGSL's rules say of verdicts. */
export interface Permitted {
  looked_at: number;
  of: number;
  /** What no permitted evaluation gives. */
  unexplained: number;
  /** Looked at, with more ways through the kernel than are followed. */
  undecided: number;
  /** The first unexplained case, 17 numbers. */
  first?: number[];
}
interface Call { cases: Float64Array; epsilons: Float64Array; verdicts: Float64Array }

const within = (x: number, { lo, hi }: Value) => (lo <= x && x <= hi) || lo === -Infinity;
const gives = ({ hit, t, u, v }: Way, [is_hit, ...values]: ArrayLike<number> & Iterable<number>) =>
  (is_hit === 1 ? hit !== false && [t, u, v].every((value, i) => within(values[i], value)) : hit !== true);

/** Looks at as many verdicts as it can in some milliseconds, spread over all. */
export function permitted(kernel: Kernel, calls: Call[], milliseconds: number): Permitted {
  const starts = [0];
  for (const { verdicts } of calls) starts.push(starts.at(-1)! + verdicts.length / 4);
  const of = starts.pop()!;
  const found: Permitted = { looked_at: 0, of, unexplained: 0, undecided: 0 };
  const end = performance.now() + milliseconds;
  // A step without a common divisor comes to each once.
  let step = Math.max(1, Math.floor(of * 0.618));
  const divisor = (a: number, b: number): number => (b === 0 ? a : divisor(b, a % b));
  while (of > 0 && divisor(of, step) !== 1) step += 1;
  for (let k = 0, at = 0; k < of && performance.now() < end; k++, at = (at + step) % of) {
    const call = starts.findLastIndex((start) => start <= at);
    const i = at - starts[call];
    const { cases, epsilons, verdicts } = calls[call];
    const numbers = cases.subarray(17 * i, 17 * i + 17);
    const ways = kernel.ways(numbers, epsilons);
    found.looked_at += 1;
    if (!ways) found.undecided += 1;
    else if (!ways.some((way) => gives(way, verdicts.subarray(4 * i, 4 * i + 4)))) {
      found.unexplained += 1;
      found.first ??= Array.from(numbers);
    }
  }
  return found;
}

/** Which answers permitted evaluations give for a case. */
export function answers(kernel: Kernel, numbers: ArrayLike<number>, epsilons: ArrayLike<number>): "hit" | "miss" | "both" {
  const ways = kernel.ways(numbers, epsilons);
  const [hit, miss] = [true, false].map((is_hit) => !ways || ways.some((way) => way.hit === null || way.hit === is_hit));
  return hit && miss ? "both" : hit ? "hit" : "miss";
}
