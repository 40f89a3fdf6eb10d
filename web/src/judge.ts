// The judge's worker: the module that makes cases, knows their truths, and writes what is found. No kernel runs here: it is
// asked for verdicts through the page, and answers in numbers.
import type { Asked } from "./gpu.js";
import { Replay } from "./replay.js";
import { Instance } from "./wasm.js";
import { Kernel } from "./wgsl/kernel";
import { answers, permitted, type Permitted } from "./wgsl/verdicts";

/** The page's messages. Each but the first gets one answer. */
export type Message =
  /** First. If the module waits for a kernel's answers, or else is asked again with them. A kernel in WGSL, if there is one. */
  | { module: WebAssembly.Module; waits: boolean; wgsl?: ConstructorParameters<typeof Kernel> }
  | { file: Uint8Array }
  | { request: object }
  /** To the calls that a request asked for. */
  | { answers: Float64Array[] }
  /** Which answers does WGSL permit? */
  | { numbers: number[]; epsilons: number[] };
/** Calls of the kernel are asked for until there is an answer in JSON. */
export type Answer = {
  json?: string; asked?: Asked[]; error?: string;
  /** What WGSL's rules say of an audit's verdicts, or of a case; or why that is not known. */
  permitted?: Permitted | string;
};

let instance: Instance | undefined;
/** Calls with their answers, where the module does not wait. */
let replay: Replay | undefined;
/** Takes the answers to the call that the module waits for. */
let learn: ((verdicts: Float64Array) => void) | undefined;
/** What is asked at the time. */
let request: object = {};
/** The kernel in WGSL in all ways, or why there is none. */
let rules: Kernel | string = "";

/** The answer to a message; none if it comes when the module has gone on. */
async function answer(message: Message): Promise<Answer | undefined> {
  if ("module" in message) {
    rules = message.wgsl ? known(() => new Kernel(...message.wgsl!)) : "";
    // What WGSL's rules say is looked up in the calls of a replay.
    replay = message.waits && !message.wgsl ? undefined : new Replay();
    instance = replay ? Instance.with(message.module, replay.run) : Instance.waiting(message.module, later);
    return undefined;
  }
  if (!instance) return { error: "the module is not there yet" };
  if ("numbers" in message) return { permitted: told((kernel) => answers(kernel, message.numbers, message.epsilons)) };
  if ("file" in message) {
    instance.keepFile(message.file);
    return {};
  }
  if ("request" in message) request = message.request;
  if (!replay) {
    if ("request" in message) return { json: await instance.askLater(request) };
    learn?.(message.answers[0]);
    return undefined;
  }
  if ("answers" in message) replay.learn(message.answers);
  replay.begin("request" in message);
  const json = instance.ask(request);
  if (replay.asked.length) return { asked: replay.asked };
  const isAudit = (request as { do: string }).do === "audit" && rules !== "";
  return { json, permitted: isAudit ? told((kernel) => permitted(kernel, replay!.known, LOOKING)) : undefined };
}

/** A call of the kernel, while the module waits. */
function later(cases: Float64Array, epsilons: Float64Array): Promise<Float64Array> {
  return new Promise((resolve) => {
    learn = resolve;
    postMessage({ asked: [{ cases, epsilons }] } satisfies Answer);
  });
}

/** Milliseconds in which verdicts are compared with WGSL's rules. */
const LOOKING = 1000;

/** What a function finds, or why it cannot. */
function known<T>(of: () => T): T | string {
  try {
    return of();
  } catch (error) {
    return (error as Error).message;
  }
}
const told = <T>(of: (kernel: Kernel) => T): T | string => (typeof rules === "string" ? rules : known(() => of(rules as Kernel)));

addEventListener("message", async ({ data }: MessageEvent<Message>) => {
  try {
    const answered = await answer(data);
    if (answered) postMessage(answered);
  } catch (error) {
    postMessage({ error: error instanceof Error ? `${error.name}: ${error.message}` : String(error) } satisfies Answer);
  }
});
