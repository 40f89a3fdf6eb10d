// The page: what is chosen, what is asked, and where the answers go.
import { afterwards, digits, element, made } from "./dom";
import { editor } from "./editor";
import { EXAMPLES, WGSL } from "./examples";
import { asChosen, decimal, hint, type Described } from "./kernel.js";
import { markup } from "./markup";
import { Session, type Source } from "./session";
import { quoted } from "./shell";
import { read, START, written, type State } from "./state";
import { takeHome } from "./take-home";
import { curve, POINTS, type Point } from "./views/curve";
import { control, draw, SIDE, type MapAnswer } from "./views/map";
import { meshes } from "./views/mesh";
import { forbidden, ofRules } from "./views/rules";
import { drawSliders, type Gate } from "./views/sliders";
import { space } from "./views/space";

interface About {
  kernels: { name: string; source: string; gates: Gate[]; contract: string }[];
  families: [string, string][];
  scenes: string[];
  contracts: [string, string][];
  inks: string[];
  /** By scalar: standard cases of maps, name and JSON. */
  spots: Record<string, [string, string][]>;
}
interface Record_ { result: { sources: { cases: number }[]; results: Result[] } }
interface Result { findings: { worst: { case: string } }[] }
interface Explained {
  title: string; html: string; scalar: string;
  triangles: { numbers: (number | null)[]; case: object; truth: { t_exact?: string | null }; finding: string | null; said: string; drawing: string | null }[];
}

const session = new Session("hairline.wasm");
const FIRST = Object.keys(EXAMPLES)[0];
const SELECTOR = "--kernel-cmd 'node kernel.mjs'";
let state = await read(location.hash, EXAMPLES[FIRST]);
const isOwn = () => state.kernel === "js" || state.kernel === "wgsl";
const source = (): Source | undefined => (isOwn() ? { language: state.kernel as Source["language"], text: state.text } : undefined);
// Without the kernel: the page is there whatever it does.
const about = await session.ask<About>({ do: "about" })
  .catch((error: Error) => { fail(error); throw error; });
let described: Described | undefined;

const code = editor(element("editor"), afterwards(700, () => void edited(false)), () => void edited(true));
const builtIn = () => about.kernels.find(({ name }) => name === state.kernel);

/** The epsilons of the kernel as it has them: name, comparison, value. */
function gates(): Gate[] {
  if (!isOwn()) return builtIn()?.gates ?? [];
  return Object.entries(described?.epsilons ?? {}).map(([name, value]) => [name, "", decimal(value), true]);
}
const epsilonOf = (gate: string, own: string) => (Object.hasOwn(state.epsilons, gate) ? state.epsilons[gate] : own);

/** The kernel of a request, with some epsilons instead of those that are set. */
function chosen(epsilons?: Record<string, string>) {
  const all = gates().map(([gate, , own]) => `${gate}=${epsilons && Object.hasOwn(epsilons, gate) ? epsilons[gate] : epsilonOf(gate, own)}`);
  const contract = state.contract || undefined;
  const choice = { epsilons: all.join(","), contract };
  return isOwn() ? { ...choice, ...asChosen(described!, state.kernel === "js" ? SELECTOR : "") } : { ...choice, name: state.kernel };
}

const cases = () => ({
  scalar: state.scalar, count: state.count, seed: state.seed,
  ...(state.cases === "all" ? {} : { scene: state.cases }),
});

const ask = <T>(request: object) => session.ask<T>(request, source());

/** Puts the state into the address. */
const remember = async () => history.replaceState(null, "", await written(state, EXAMPLES[FIRST]));

// What is asked and not yet answered is forgotten when something else is asked.
let asked = 0;

/** Asks everything again. */
async function run() {
  const mine = ++asked;
  const isLate = () => mine !== asked;
  session.stop();
  element("error").hidden = true;
  element("status").textContent = "Running…";
  document.body.classList.add("running");
  const start = performance.now();
  let isTold = false;
  try {
    if (isOwn()) described = await session.describe(source()!);
    if (isLate()) return;
    sliders();
    const answer = await ask<{ title: string; html: string; record: Record_ }>({ do: "audit", kernel: chosen(), cases: cases() });
    if (isLate()) return;
    const seconds = (performance.now() - start) / 1000;
    report(answer.title, answer.html, answer.record, seconds);
    isTold = true;
    former(false);
    line("threw", session.threw === undefined ? "" : `The kernel gives no verdict on some of the cases. The first time: ${session.threw}`);
    line("hint", isOwn() && described ? hint(described) : "");
    ofRules(state.kernel === "wgsl" ? session.permitted : undefined, (name) => void go(name));
    await remember();
    if (!state.shown) await show(worst(answer.record));
    else await show(state.shown);
    if (!isLate()) await ofEpsilon();
  } catch (error) {
    if (isLate()) return;
    fail(error as Error);
    if (!isTold) former(true);
  } finally {
    if (!isLate()) document.body.classList.remove("running");
  }
}

/** A line of its own, if there is something to say. */
function line(id: string, text: string) {
  element(id).textContent = text;
  element(id).hidden = text === "";
}

/** Says that what is shown is of another kernel, or that it is not. */
function former(isFormer: boolean) {
  document.body.classList.toggle("former", isFormer);
  element("former").hidden = !isFormer || element("verdict").hidden;
  for (const id of ["verdict", "curve-part", "case-part", "map-part"]) element(id).inert = isFormer;
}

function fail({ message }: Error) {
  element("error").textContent = message;
  element("error").hidden = false;
  element("status").textContent = "";
}

/** The record of the last audit. */
let record: Record_ | undefined;

function save(name: string, type: string, text: string) {
  const link = made("a", { href: URL.createObjectURL(new Blob([text], { type })), download: name });
  link.click();
  URL.revokeObjectURL(link.href);
}

function report(title: string, html: string, found: Record_, seconds: number) {
  record = found;
  element("verdict").hidden = false;
  element("mesh-part").hidden = false;
  element("title").textContent = title;
  const count = found.result.sources.reduce((sum, source) => sum + source.cases, 0);
  element("sums").textContent = `${digits(count)} cases in ${state.scalar}, ${seconds.toFixed(1)} s.`;
  element("status").textContent = "";
  fill(element("report"), html);
}

/** Puts what the program wrote into an element, and makes each of its cases a button. */
function fill(parent: HTMLElement, html: string) {
  parent.replaceChildren(markup(html));
  for (const line of parent.querySelectorAll("code")) {
    const name = /^hairline explain '([^']+)'/.exec(line.textContent ?? "")?.[1];
    if (!name || name.includes("mesh=")) continue;
    const button = made("button", { type: "button", class: "open", "data-name": name }, "Show");
    button.setAttribute("aria-label", `Show ${name.startsWith("{") ? "this case" : name}`);
    button.addEventListener("click", () => void go(name));
    line.before(button, " ");
  }
  for (const link of parent.querySelectorAll<HTMLAnchorElement>("a[href^='#']")) {
    link.addEventListener("click", (event) => {
      event.preventDefault();
      const part = document.getElementById(link.hash.slice(1));
      if (part instanceof HTMLDetailsElement) part.open = true;
      part?.scrollIntoView();
    });
  }
}

/** The first case of the report, which is the worst in ordinary sizes, or else of any finding; none if there are none. */
function worst(record: Record_): string | undefined {
  const first = element("report").querySelector<HTMLElement>("button.open")?.dataset.name;
  return first ?? record.result.results.flatMap(({ findings }) => findings)[0]?.worst.case;
}

/** Goes to a case, which the address then names. */
async function go(name: string) {
  state = { ...state, shown: name, around: "", shift: [0, 0], zoom: 1 };
  element<HTMLSelectElement>("around").value = "";
  await remember();
  await show(name);
  element("case-part").scrollIntoView();
  element("case-title").focus({ preventScroll: true });
}

/** A sentence on what WGSL's rules forbid for a case. */
async function forbids(numbers: (number | null)[]): Promise<string> {
  if (state.kernel !== "wgsl") return "";
  const epsilons = gates().map(([gate, , own]) => Number(epsilonOf(gate, own)));
  return forbidden(await session.permits(numbers.map((x, i) => x ?? (i === 16 ? Infinity : NaN)), epsilons));
}

let shown: string | undefined;

/** Shows a case, and the map around it. */
async function show(name: string | undefined) {
  shown = name;
  const none = name === undefined;
  element("case-part").hidden = none;
  element("map-part").hidden = none;
  if (name === undefined) return;
  const mine = asked;
  let told: Explained;
  let rules: string;
  let which: number;
  try {
    told = await ask<Explained>({ do: "explain", kernel: chosen(), case: name });
    which = Math.max(0, told.triangles.findIndex(({ finding }) => finding !== null));
    rules = await forbids(told.triangles[which].numbers);
  } catch (error) {
    if (mine !== asked) return;
    element("map-part").hidden = true;
    element("case-name").textContent = `${name}: ${(error as Error).message}`;
    element("case-command").textContent = "";
    for (const id of ["drawing", "space", "explained"]) element(id).replaceChildren();
    return;
  }
  const { numbers, truth, finding, said, drawing } = told.triangles[which];
  const of = told.triangles.length > 1 ? `, triangle ${which} of ${told.triangles.length}` : "";
  element("case-title").textContent = finding ? `One case: ${finding.replace("-", " ")}` : "One case";
  element("case-name").textContent = `${name.startsWith("{") ? "A case from the map" : name}${of}: ${said}.${rules}`;
  const contract = state.contract ? ` --contract ${/^[\w=,.-]+$/.test(state.contract) ? state.contract : quoted(state.contract)}` : "";
  const epsilons = gates().map(([gate, , own]) => `${gate}=${epsilonOf(gate, own)}`).join(",");
  // A kernel in WGSL is here alone: the program shows the case with its own.
  const kernel = state.kernel === "js" ? SELECTOR : isOwn() ? "" : `--kernel ${state.kernel}`;
  element("case-command").textContent = kernel
    ? `hairline explain ${quoted(name)} ${kernel}${epsilons ? ` --epsilon ${quoted(epsilons)}` : ""}${contract}`
    : `hairline explain ${quoted(name)}`;
  element("drawing").replaceChildren(markup(drawing ?? ""));
  space(element("space"), numbers, truth.t_exact ?? null);
  fill(element("explained"), told.html);
  await around();
}

/** The case that the map is around. */
const middle = () => about.spots[state.scalar].find(([name]) => name === state.around)?.[1] ?? shown!;

const mapRequest = () => ({
  do: "map", kernel: chosen(), case: middle(), vary: state.vary, shift: state.shift, zoom: state.zoom, size: [SIDE, SIDE],
});

async function around() {
  const mine = asked;
  try {
    draw(await ask<MapAnswer>(mapRequest()), about.inks);
  } catch (error) {
    if (mine === asked) element("axes").textContent = (error as Error).message;
  }
}

async function ofMap(change: Partial<State>) {
  state = { ...state, ...change };
  if (shown === undefined) return;
  await remember();
  await around();
}

/** The curve of the epsilon that is chosen, on fewer cases. */
async function ofEpsilon() {
  const all = gates();
  element("curve-part").hidden = all.length === 0;
  if (all.length === 0) return;
  const select = element<HTMLSelectElement>("gate");
  const before = select.value;
  select.replaceChildren(...all.map(([gate]) => made("option", {}, gate)));
  if (all.some(([gate]) => gate === before)) select.value = before;
  element("gate-label").hidden = all.length === 1;
  const [gate, , own] = all.find(([name]) => name === select.value)!;
  const set = (value: number) => chosen({ [gate]: decimal(value) }).epsilons;
  const count = Math.min(state.count, 200);
  const points = await ask<Point[]>({ do: "curve", kernel: chosen(), cases: { ...cases(), count }, epsilons: POINTS.map(set) });
  element("curve").replaceChildren(curve(points, gate, Number(epsilonOf(gate, own))));
  element("curve-note").textContent = `${digits(count)} cases of each kind.`;
}

/** A slider for each epsilon. */
function sliders() {
  drawSliders(state.kernel, gates(), epsilonOf, (gate, own, value) => {
    state.epsilons = { ...state.epsilons, [gate]: value };
    if (value === own) delete state.epsilons[gate];
    void run();
  });
}

/** Puts the state into the controls. */
function controls() {
  const kernel = element<HTMLSelectElement>("kernel");
  kernel.value = state.kernel;
  if (kernel.value === "") {
    state.kernel = START.kernel;
    kernel.value = START.kernel;
  }
  element<HTMLSelectElement>("cases").value = state.cases;
  element<HTMLInputElement>("count").value = String(state.count);
  element<HTMLSelectElement>("contract").value = state.contract;
  element<HTMLSelectElement>("vary").value = state.vary;
  element<HTMLSelectElement>("around").value = state.around;
  element("editor").hidden = !isOwn();
  element("editing").hidden = !isOwn();
  element("take").hidden = state.kernel !== "js";
  element("device").hidden = state.kernel !== "wgsl";
  if (state.kernel === "wgsl") state.scalar = "f32";
  element<HTMLSelectElement>("scalar").value = state.scalar;
  element<HTMLSelectElement>("scalar").disabled = state.kernel === "wgsl";
  element("source").textContent = isOwn() ? "" : `${builtIn()!.source}. Its contract: ${builtIn()!.contract}.`;
  if (isOwn() && code.text !== state.text) code.text = state.text;
  if (!isOwn()) sliders();
}

/** Runs what is in the editor, if it is another text than before or if it is to run again. */
function edited(again: boolean) {
  if (!isOwn()) return;
  if (code.text === state.text) return again ? run() : undefined;
  state = { ...state, text: code.text, epsilons: {} };
  element("sliders").dataset.key = "";
  return run();
}

/** Fills the choices that depend on the program. */
function choices() {
  const option = (value: string, text: string) => made("option", { value }, text);
  const group = (label: string, ...options: HTMLElement[]) => made("optgroup", { label }, ...options);
  element("kernel").append(
    group("In the editor", option("js", "JavaScript"), option("wgsl", "WGSL, on your graphics device")),
    group("Start from", ...Object.keys(EXAMPLES).map((name) => option(`example:${name}`, name))),
    group("Built in", ...about.kernels.map(({ name }) => option(name, name))),
  );
  element("cases").append(
    option("all", "hard cases of every kind"),
    group("Rays in a scene", ...about.scenes.map((name) => option(name, name))),
  );
  element("contract").append(
    option("", "its own contract"),
    ...about.contracts.map(([name, what]) => option(name, `${name}: ${what}`)),
  );
}

function listen() {
  const changed = (id: string, take: (value: string) => Partial<State>) => {
    element(id).addEventListener("change", (event) => {
      state = { ...state, ...take((event.target as HTMLInputElement).value), shown: undefined, shift: [0, 0], zoom: 1 };
      controls();
      void run();
    });
  };
  changed("kernel", (value) => {
    const other = (value === "js" || value === "wgsl") && value !== state.kernel;
    const example = value.startsWith("example:") ? EXAMPLES[value.slice(8)]
      : other ? (value === "js" ? EXAMPLES[FIRST] : WGSL) : undefined;
    return { kernel: value.startsWith("example:") ? "js" : value, epsilons: {}, contract: "", ...(example ? { text: example } : {}) };
  });
  changed("cases", (value) => ({ cases: value }));
  changed("scalar", (value) => ({ scalar: value as State["scalar"] }));
  changed("count", (value) => ({ count: Math.max(1, Math.min(100_000, Math.round(Number(value)) || START.count)) }));
  changed("contract", (value) => ({ contract: value }));
  element("controls").addEventListener("submit", (event) => event.preventDefault());
  element("run").addEventListener("click", () => void edited(true));
  element("take").addEventListener("click", () => {
    if (described) save("kernel.mjs", "text/javascript", takeHome(state.text, described));
  });
  element("record").addEventListener("click", () => save("record.json", "application/json", JSON.stringify(record, null, 2)));
  element("signature").addEventListener("click", async () => {
    const text = await session.gpu.then((gpu) => gpu.signature())
      .then((found) => JSON.stringify({ ...found, verdicts: session.permitted }, null, 2), (error: Error) => error.message);
    element("signature-json").textContent = text;
    element("signature-json").hidden = false;
  });
  element("gate").addEventListener("change", () => void ofEpsilon());
  element("vary").addEventListener("change", (event) => void ofMap({ vary: (event.target as HTMLSelectElement).value, shift: [0, 0] }));
  element("around").addEventListener("change", (event) => void ofMap({ around: (event.target as HTMLSelectElement).value, shift: [0, 0], zoom: 1 }));
  element("centre").addEventListener("click", () => void ofMap({ shift: [0, 0], zoom: 1 }));
  control({
    move: (x, y) => void ofMap({ shift: [state.shift[0] + x * state.zoom, state.shift[1] + y * state.zoom] }),
    zoom: (factor) => void ofMap({ zoom: Math.max(1, Math.min(2 ** 24, state.zoom * factor)) }),
    pick: async (x, y) => {
      const { case: name } = await ask<{ case: string }>({ ...mapRequest(), pixel: [x, y] });
      await go(name);
    },
  });
  element("copy-link").addEventListener("click", async () => {
    state = { ...state, shown };
    await remember();
    await navigator.clipboard.writeText(location.href).then(() => "Copied.", () => "It is in the address bar.")
      .then((said) => { element("copied").textContent = said; });
  });
  addEventListener("hashchange", async () => {
    state = await read(location.hash, EXAMPLES[FIRST]);
    controls();
    await run();
  });
}

choices();
controls();
listen();
meshes(async (file) => {
  session.keepFile(new Uint8Array(await file.arrayBuffer()));
  const request = { do: "mesh", kernel: chosen(), file: file.name, scalar: state.scalar, directions: 8 };
  return ask<{ title: string; html: string }>(request);
}, fill);
await run();
