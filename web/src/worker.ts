// Where a pasted kernel runs, with the module that asks it: no page, no network, and an end when its time is over.
import { describe, runner, type Described } from "./kernel.js";
import type { Asked } from "./gpu.js";
import { Replay } from "./replay.js";
import { Instance } from "./wasm.js";
import { Kernel } from "./wgsl/kernel";
import { answers, permitted, type Permitted } from "./wgsl/verdicts";

/** The page's messages, one answer each. */
export type Message =
  /** A kernel in JavaScript, one in WGSL, which answers later, or none. */
  | { module: WebAssembly.Module; text?: string; wgsl?: ConstructorParameters<typeof Kernel> }
  | { file: Uint8Array }
  /** With answers it is asked again. */
  | { request: object; answers?: Float64Array[] }
  /** Which answers does WGSL permit? */
  | { numbers: number[]; epsilons: number[] };
/** Calls without answers make the rest of no worth. */
export type Answer = {
  described?: Described; json?: string; asked?: Asked[]; error?: string;
  /** What WGSL's rules say of an audit's verdicts, or of a case; or why that is not known. */
  permitted?: Permitted | string;
};

// What could carry something out. Imports of other addresses and connections are refused by the page's policy too.
for (const name of ["fetch", "XMLHttpRequest", "WebSocket", "WebSocketStream", "WebTransport", "EventSource", "Worker",
  "SharedWorker", "BroadcastChannel", "indexedDB", "caches", "importScripts", "navigator", "Notification"]) {
  for (let of: object | null = globalThis; of; of = Object.getPrototypeOf(of)) {
    if (Object.hasOwn(of, name)) Reflect.deleteProperty(of, name);
  }
  Object.defineProperty(globalThis, name, { value: undefined });
}

let instance: Instance | undefined;
let replay: Replay | undefined;
/** The kernel in WGSL in all ways, or why there is none. */
let rules: Kernel | string = "";
const post = globalThis.postMessage.bind(globalThis) as (answer: Answer) => void;

async function answer(message: Message): Promise<Answer> {
  if ("module" in message) {
    let described: Described | undefined;
    let run = (_: Float64Array, __: Float64Array, verdicts: Float64Array) => verdicts.fill(0);
    if (message.text !== undefined) {
      const address = URL.createObjectURL(new Blob([message.text], { type: "text/javascript" }));
      try {
        const { kernel, ...rest } = await import(address).then(describe).catch((error: Error) => {
          const asksForMore = /\bimport\b|\brequire\s*\(/.test(message.text!);
          if (asksForMore) error.message += ". The lab loads no other modules: paste here what yours needs";
          else if (error.name === "TypeError") error.message += ". It is called as kernel({ origin, direction, tMin, tMax }, { a, b, c }, epsilon), with vectors [x, y, z]";
          throw error;
        });
        described = rest;
        const run_of = runner(kernel, Object.keys(rest.epsilons));
        run = (cases, epsilons, verdicts) => (run_of(cases, epsilons, verdicts), verdicts);
      } finally {
        URL.revokeObjectURL(address);
      }
    }
    replay = message.wgsl && new Replay();
    rules = message.wgsl ? known(() => new Kernel(...message.wgsl!)) : "";
    instance = new Instance(message.module, replay?.run ?? run);
    return { described };
  }
  if (!instance) return { error: "the module is not there yet" };
  if ("numbers" in message) return { permitted: told((kernel) => answers(kernel, message.numbers, message.epsilons)) };
  if ("file" in message) {
    instance.keepFile(message.file);
    return {};
  }
  if (message.answers) replay?.learn(message.answers);
  replay?.begin(!message.answers);
  const json = instance.ask(message.request);
  if (replay?.asked.length) return { asked: replay.asked };
  const isAudit = (message.request as { do: string }).do === "audit";
  return { json, permitted: replay && isAudit ? told((kernel) => permitted(kernel, replay!.known, LOOKING)) : undefined };
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

globalThis.addEventListener("message", async ({ data }: MessageEvent<Message>) => {
  try {
    post(await answer(data));
  } catch (error) {
    post({ error: error instanceof Error ? `${error.name}: ${error.message}` : String(error) });
  }
});


