// Where a pasted kernel runs, with the module that asks it: no page, no network, and an end when its time is over.
import { describe, runner, type Described } from "./kernel.js";
import type { Asked } from "./gpu.js";
import { Replay } from "./replay.js";
import { Instance } from "./wasm.js";

/** The page's messages, one answer each. */
export type Message =
  /** A kernel in JavaScript, one that answers later, or none. */
  | { module: WebAssembly.Module; text?: string; later?: boolean }
  | { file: Uint8Array }
  /** With answers it is asked again. */
  | { request: object; answers?: Float64Array[] };
/** Calls without answers make the rest of no worth. */
export type Answer = { described?: Described; json?: string; asked?: Asked[]; error?: string };

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
const post = globalThis.postMessage.bind(globalThis) as (answer: Answer) => void;

async function answer(message: Message): Promise<Answer> {
  if ("module" in message) {
    let described: Described | undefined;
    let run = (_: Float64Array, __: Float64Array, verdicts: Float64Array) => verdicts.fill(0);
    if (message.text !== undefined) {
      const address = URL.createObjectURL(new Blob([message.text], { type: "text/javascript" }));
      try {
        const { kernel, ...rest } = describe(await import(address).catch((error: Error) => {
          const asksForMore = /\bimport\b|\brequire\s*\(/.test(message.text!);
          if (asksForMore) error.message += ". The lab loads no other modules: paste here what yours needs";
          throw error;
        }));
        described = rest;
        const run_of = runner(kernel, Object.keys(rest.epsilons));
        run = (cases, epsilons, verdicts) => (run_of(cases, epsilons, verdicts), verdicts);
      } finally {
        URL.revokeObjectURL(address);
      }
    }
    replay = message.later ? new Replay() : undefined;
    instance = new Instance(message.module, replay?.run ?? run);
    return { described };
  }
  if (!instance) return { error: "the module is not there yet" };
  if ("file" in message) {
    instance.keepFile(message.file);
    return {};
  }
  if (message.answers) replay?.learn(message.answers);
  replay?.begin(!message.answers);
  const json = instance.ask(message.request);
  return replay?.asked.length ? { asked: replay.asked } : { json };
}

globalThis.addEventListener("message", async ({ data }: MessageEvent<Message>) => {
  try {
    post(await answer(data));
  } catch (error) {
    post({ error: error instanceof Error ? `${error.name}: ${error.message}` : String(error) });
  }
});


