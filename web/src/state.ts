// What the page shows, as the part of its address after `#`: a link opens the same view.

export interface State {
  /** A kernel of the program, or `js`, or `wgsl`. */
  kernel: string;
  /** The text of the kernel in the editor. */
  text: string;
  scalar: "f32" | "f64";
  /** `all` for the families of hard cases, or the words of a scene. */
  cases: string;
  count: number;
  seed: number;
  /** As `--contract` takes it; the kernel's own if empty. */
  contract: string;
  /** By gate, what differs from the kernel's own. */
  epsilons: Record<string, string>;
  /** An id, or a case as JSON; none if the worst is to be shown. */
  shown?: string;
  /** What the map is around: the case that is shown, if empty, or a standard case. */
  around: string;
  vary: string;
  shift: [number, number];
  zoom: number;
}

export const START: Omit<State, "text"> = {
  kernel: "js", scalar: "f64", cases: "all", count: 500, seed: 1, contract: "", epsilons: {},
  around: "edge", vary: "origin", shift: [0, 0], zoom: 1,
};

/** The state of an address; what it does not say is as at the start. */
export async function read(hash: string, text: string): Promise<State> {
  const words = new URLSearchParams(hash.replace(/^#/, ""));
  const whole = (name: string, least: number, most: number, otherwise: number) => {
    const value = Number(words.get(name) ?? otherwise);
    return Number.isInteger(value) && least <= value && value <= most ? value : otherwise;
  };
  const pairs = [...words].filter(([key]) => key.startsWith("e.")).map(([key, value]) => [key.slice(2), value]);
  const packed = words.get("text");
  return {
    kernel: words.get("kernel") ?? START.kernel,
    text: packed ? await unpacked(packed).catch(() => text) : text,
    scalar: words.get("scalar") === "f32" ? "f32" : "f64",
    cases: words.get("cases") ?? START.cases,
    count: whole("n", 1, 100_000, START.count),
    seed: whole("seed", 0, Number.MAX_SAFE_INTEGER, START.seed),
    contract: words.get("contract") ?? "",
    epsilons: Object.fromEntries(pairs),
    shown: words.get("case") ?? undefined,
    around: words.get("around") ?? (words.has("case") ? "" : START.around),
    vary: words.get("vary") ?? START.vary,
    shift: [whole("x", -(2 ** 29), 2 ** 29, 0), whole("y", -(2 ** 29), 2 ** 29, 0)],
    zoom: whole("zoom", 1, 2 ** 24, 1),
  };
}

/** The address of a state; the text is in it if it is not the one at the start. */
export async function written(state: State, text: string): Promise<string> {
  const words = new URLSearchParams();
  const set = (name: string, value: string | number, usual: string | number) => {
    if (value !== usual) words.set(name, String(value));
  };
  set("kernel", state.kernel, START.kernel);
  set("scalar", state.scalar, START.scalar);
  set("cases", state.cases, START.cases);
  set("n", state.count, START.count);
  set("seed", state.seed, START.seed);
  set("contract", state.contract, "");
  for (const [gate, value] of Object.entries(state.epsilons)) words.set(`e.${gate}`, value);
  if (state.shown) words.set("case", state.shown);
  set("around", state.around, state.shown ? "" : START.around);
  set("vary", state.vary, START.vary);
  set("x", state.shift[0], 0);
  set("y", state.shift[1], 0);
  set("zoom", state.zoom, 1);
  if ((state.kernel === "js" || state.kernel === "wgsl") && state.text !== text) words.set("text", await packed(state.text));
  return `#${words}`;
}

async function through(bytes: Uint8Array, stream: ReadableWritablePair): Promise<Uint8Array> {
  const piped = new Blob([bytes as BlobPart]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

async function packed(text: string): Promise<string> {
  const bytes = await through(new TextEncoder().encode(text), new CompressionStream("deflate-raw"));
  return btoa(String.fromCharCode(...bytes)).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The most characters of a kernel's text in a link: a short link can unpack to a thousand times its length. */
const LONGEST = 1 << 20;

async function unpacked(text: string): Promise<string> {
  const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
  const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
  const pieces = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate-raw")).pipeThrough(new TextDecoderStream());
  const reader = pieces.getReader();
  let all = "";
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    all += next.value;
    if (all.length > LONGEST) {
      await reader.cancel();
      throw new RangeError("the link's kernel is longer than any");
    }
  }
  return all;
}
