// What comes out of the sandbox, before anybody believes it. A message is numbers: verdicts, or the bytes of a text. It has
// been copied into this realm, so its prototypes are the page's; which type it has, how long it is, and each value in it
// are the kernel's choice.
import { type Described, type Less } from "../kernel.js";

/** The most bytes of a text. */
const LONGEST = 1 << 16;
/** The most epsilons, and characters of a name, of a contract, and of what is shown of an error. */
const [EPSILONS, NAME, CONTRACT, SHOWN] = [32, 40, 400, 300];

/** What a kernel says of itself, once; or an error, or an exception's text. */
export type Told = { described: Described } | { error: string } | { threw: string };

/** The kernel's own words as one short line without characters that are not seen. */
export function shortened(words: string): string {
  const seen = [...words.slice(0, 4 * SHOWN).replace(/[\p{C}\p{Z}]+/gu, " ").trim()];
  return seen.length > SHOWN ? `${seen.slice(0, SHOWN).join("")}…` : seen.join("");
}

/** The answer to a call for so many verdicts, as a copy; nothing if it is none. */
export function verdictsOf(message: unknown, call: number, count: number): Float64Array | undefined {
  if (!(message instanceof Float64Array) || message.length !== 1 + 4 * count || message[0] !== call) return undefined;
  const verdicts = new Float64Array(4 * count);
  for (let i = 0; i < verdicts.length; i++) verdicts[i] = message[1 + i];
  for (let i = 0; i < verdicts.length; i += 4) {
    if (verdicts[i] !== 0 && verdicts[i] !== 1 && verdicts[i] !== 2) return undefined;
  }
  return verdicts;
}

/** The text of a message; nothing if it is none. An error says what is wrong with a description. */
export function toldOf(message: unknown): Told | undefined {
  if (!(message instanceof Uint8Array) || message.length > LONGEST) return undefined;
  let told: unknown;
  try {
    told = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(message.slice()));
  } catch {
    return undefined;
  }
  const [error, threw, described] = ["error", "threw", "described"].map((name) => field(told, name));
  if (typeof error === "string") return { error: shortened(error) };
  if (typeof threw === "string") return { threw: shortened(threw) };
  return described === undefined ? undefined : { described: describedOf(described) };
}

/** A field of what JSON has given; nothing if it has none. */
const field = (of: unknown, name: string): unknown =>
  (typeof of === "object" && of !== null && Object.hasOwn(of, name) ? (of as Record<string, unknown>)[name] : undefined);

function describedOf(told: unknown): Described {
  const named = Object.entries(field(told, "epsilons") ?? {});
  if (named.length > EPSILONS) throw new Error(`the kernel has ${named.length} epsilons; the lab takes ${EPSILONS}`);
  for (const [name, value] of named) {
    if (!/^[A-Za-z][\w-]*$/.test(name) || name.length > NAME) throw new Error(`epsilon ${shortened(name)}: a name has letters, digits, - and _ only, and at most ${NAME}`);
    if (typeof value !== "number" || !Number.isFinite(value)) throw new Error(`epsilon ${name}: expected a finite number`);
  }
  const contract = field(told, "contract");
  if (typeof contract !== "string" || !/^[\x20-\x7e]*$/.test(contract) || contract.length > CONTRACT) {
    throw new Error(`contract: expected at most ${CONTRACT} plain characters in one line`);
  }
  const [t, uv] = [0, 1].map((i) => field(field(told, "gives"), String(i)) === true);
  const said = field(told, "less");
  const less = (["sides=front", "extent=line"] as Less[]).filter((words) => Array.isArray(said) && said.includes(words));
  return { epsilons: Object.fromEntries(named) as Described["epsilons"], contract, gives: [t, uv], less };
}
