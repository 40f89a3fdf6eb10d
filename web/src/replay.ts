// A kernel that answers later: what is asked is written down, answered elsewhere, and asked again.
import type { Asked } from "./gpu.js";

/** Answers what it knows, and writes down the rest. The same request asks the same, as long as answers are the same. */
export class Replay {
  /** Calls in their order, with their answers. */
  #known: (Asked & { verdicts: Float64Array })[] = [];
  #asked: Asked[] = [];
  #at = 0;

  /** Before a request is asked, for the first time or again. */
  begin(isNew: boolean) {
    if (isNew) this.#known = [];
    this.#asked = [];
    this.#at = 0;
  }

  /** The calls with theirs. */
  get known(): (Asked & { verdicts: Float64Array })[] {
    return this.#known;
  }

  /** The calls without an answer; a miss was taken for theirs. */
  get asked(): Asked[] {
    return this.#asked;
  }

  /** The answers to them. */
  learn(answers: Float64Array[]) {
    this.#known.push(...this.#asked.map((asked, i) => ({ ...asked, verdicts: answers[i] })));
  }

  run = (cases: Float64Array, epsilons: Float64Array, verdicts: Float64Array) => {
    const known = this.#known[this.#at];
    if (this.#asked.length === 0 && known && same(known.cases, cases) && same(known.epsilons, epsilons)) {
      verdicts.set(known.verdicts);
      this.#at++;
      return;
    }
    // From here on other answers were thought of.
    this.#known.length = this.#at;
    this.#asked.push({ cases: cases.slice(), epsilons: epsilons.slice() });
    verdicts.fill(0);
  };
}

const same = (a: Float64Array, b: Float64Array) => a.length === b.length && a.every((x, i) => Object.is(x, b[i]));
