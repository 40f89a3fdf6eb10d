// Runs a kernel of anybody's, in a worker of the sandbox. Nothing here is a defence: the kernel shares this realm, and may
// change all of it. What it cannot do is leave: the worker has an origin of its own, and a policy without any address
// (frame.ts). What it says is looked at on the other side (check.ts).
import { describe, runner } from "../kernel.js";

addEventListener("message", async ({ data: text, ports: [port] }: MessageEvent<string>) => {
  const say = (told: object) => port.postMessage(new TextEncoder().encode(JSON.stringify(told)));
  try {
    const { kernel, ...described } = describe(await import(`data:text/javascript;charset=utf-8,${encodeURIComponent(text)}`));
    const run = runner(kernel, Object.keys(described.epsilons), (error) => say({ threw: words(error) }));
    // The number of the call, how many epsilons there are, these, and 17 numbers a case. Back go the call's number, and
    // 4 numbers a verdict.
    port.onmessage = ({ data }: MessageEvent<Float64Array<ArrayBuffer>>) => {
      const cases = data.subarray(2 + data[1]);
      const answer = new Float64Array(1 + (cases.length / 17) * 4);
      answer[0] = data[0];
      run(cases, data.subarray(2, 2 + data[1]), answer.subarray(1));
      port.postMessage(answer, [answer.buffer]);
    };
    say({ described });
  } catch (error) {
    say({ error: words(error) + advice(error, text) });
  }
}, { once: true });

postMessage("started");

/** The start of an error's text. */
function words(error: unknown): string {
  try {
    return (error instanceof Error ? `${error.name}: ${error.message}` : String(error)).slice(0, 2_000);
  } catch {
    return "an exception without a text";
  }
}

/** What an error on the first calls probably means. */
function advice(error: unknown, text: string): string {
  if (/\bimport\b|\brequire\s*\(/.test(text)) return ". The lab loads no other modules: paste here what yours needs";
  if (!(error instanceof TypeError)) return "";
  return ". It is called as kernel({ origin, direction, tMin, tMax }, { a, b, c }, epsilon), with vectors [x, y, z]";
}
