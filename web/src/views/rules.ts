// What WGSL's accuracy rules say of a device's verdicts, in words.
import { digits, element, made } from "../dom";
import type { Permitted } from "../wgsl/verdicts";

/** The line below the verdict; none of a kernel that is not in WGSL. A case that no permitted evaluation explains can be
 * gone to. */
export function ofRules(found: Permitted | string | undefined, go: (name: string) => void) {
  const line = element("rules");
  line.hidden = found === undefined;
  if (found === undefined) return;
  if (typeof found === "string") {
    line.textContent = `What WGSL's accuracy rules forbid here is not known: ${found}.`;
    return;
  }
  const { looked_at, of, unexplained, undecided, first } = found;
  const which = looked_at < of ? `${digits(looked_at)} of ${digits(of)} verdicts` : `${digits(of)} verdicts`;
  line.textContent = unexplained === 0
    ? `WGSL's accuracy rules forbid none of this device's answers, wrong or right, as far as bounds tell: ${which} were looked at.`
    : `Of ${which} that were looked at ${digits(unexplained)} are forbidden by WGSL's accuracy rules: this device or its compiler computes otherwise. `;
  if (undecided) line.append(` ${digits(undecided)} have too many ways to follow, and count as permitted.`);
  if (!first) return;
  const vectors = Object.fromEntries(["origin", "direction", "a", "b", "c"].map((name, i) => [name, first.slice(3 * i, 3 * i + 3)]));
  const ends = { t_min: first[15], ...(Number.isFinite(first[16]) ? { t_max: first[16] } : {}) };
  const button = made("button", { type: "button" }, "Show one");
  button.addEventListener("click", () => go(JSON.stringify({ scalar: "f32", ...vectors, ...ends })));
  line.append(button);
}

/** A sentence on the answer that is forbidden for a case; none if that is not known. */
export function forbidden(answers: string): string {
  const words: Record<string, string> = { hit: "a miss", miss: "a hit", both: "no answer" };
  return words[answers] ? ` WGSL's accuracy rules forbid ${words[answers]} here.` : "";
}
