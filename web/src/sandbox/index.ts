// A kernel in JavaScript, in a sandbox of its own. Its text goes in once, then numbers go in and numbers come out.
import type { Asked } from "../gpu.js";
import type { Described } from "../kernel.js";
import { toldOf, verdictsOf } from "./check";

const OTHER = "The kernel answered with something other than its verdicts, and was ended";

export class Sandbox {
  #frame: HTMLIFrameElement;
  #port: MessagePort;
  /** The number of the last call. */
  #call = 0;
  #end: (error: Error) => void = () => {};
  /** Takes each message; nothing is to come if it is missing. */
  #heard: ((message: unknown) => void) | undefined;
  /** Why it was ended, once it is. */
  #ended: Error | undefined;
  /** The text of the first exception since it was last taken. */
  #threw: string | undefined;

  private constructor(frame: HTMLIFrameElement, port: MessagePort) {
    [this.#frame, this.#port] = [frame, port];
    port.onmessage = ({ data }: MessageEvent<unknown>) => {
      if (this.#heard) this.#heard(data);
      else this.close(new Error(OTHER));
    };
    port.onmessageerror = () => this.close(new Error(OTHER));
    addEventListener("message", this.#failed);
  }

  /** A sandbox with a kernel's text in it; `opened` has it before the kernel runs, so that it can be closed. */
  static async open(text: string, opened: (sandbox: Sandbox) => void): Promise<Described> {
    const frame = document.createElement("iframe");
    frame.setAttribute("sandbox", "allow-scripts");
    frame.referrerPolicy = "no-referrer";
    frame.hidden = true;
    frame.src = "sandbox.html";
    const { port1, port2 } = new MessageChannel();
    const sandbox = new Sandbox(frame, port1);
    opened(sandbox);
    return sandbox.#answer((done) => {
      sandbox.#heard = (message) => {
        const told = toldOf(message);
        if (told === undefined || "threw" in told) throw new Error(OTHER);
        if ("error" in told) throw new Error(`The kernel cannot be run. ${told.error}`);
        done(told.described);
      };
      // An opaque origin has no name: whoever is in this frame gets it, which is the page's own file.
      frame.addEventListener("load", () => frame.contentWindow?.postMessage(text, "*", [port2]), { once: true });
      document.body.append(frame);
    });
  }

  /** The verdicts on each call's cases. */
  async run(asked: Asked[]): Promise<Float64Array[]> {
    const answers: Float64Array[] = [];
    for (const { cases, epsilons } of asked) answers.push(await this.#verdicts(cases, epsilons));
    return answers;
  }

  /** The text of the first exception since this was asked before; none if there was none. */
  takeThrown(): string | undefined {
    const threw = this.#threw;
    this.#threw = undefined;
    return threw;
  }

  /** Ends the kernel, whatever it does. Without the frame its worker ends too. */
  close(error = new Error("the kernel was ended")) {
    this.#ended ??= error;
    this.#heard = undefined;
    this.#port.onmessage = null;
    this.#port.close();
    removeEventListener("message", this.#failed);
    this.#frame.remove();
    this.#end(error);
  }

  #verdicts(cases: Float64Array, epsilons: Float64Array): Promise<Float64Array> {
    const before = [++this.#call, epsilons.length, ...epsilons];
    const all = new Float64Array(before.length + cases.length);
    all.set(before);
    all.set(cases, before.length);
    // One exception's text a call, so that nobody is kept busy with more.
    let hasThrown = false;
    return this.#answer((done) => {
      this.#heard = (message) => {
        const verdicts = verdictsOf(message, this.#call, cases.length / 17);
        if (verdicts) return done(verdicts);
        const told = toldOf(message);
        if (told === undefined || !("threw" in told) || hasThrown) throw new Error(OTHER);
        hasThrown = true;
        this.#threw ??= told.threw;
      };
      this.#port.postMessage(all, [all.buffer]);
    });
  }

  /** What comes of a question; whatever goes wrong ends the kernel. */
  #answer<T>(begin: (done: (answer: T) => void) => void): Promise<T> {
    return new Promise((resolve, reject) => {
      if (this.#ended) return reject(this.#ended);
      this.#end = reject;
      begin((answer) => {
        this.#heard = undefined;
        resolve(answer);
      });
      const heard = this.#heard;
      this.#heard = heard && ((message) => {
        try {
          heard(message);
        } catch (error) {
          this.close(error as Error);
        }
      });
    });
  }

  #failed = ({ source }: MessageEvent) => {
    if (source === this.#frame.contentWindow) this.close(new Error("this browser does not start the kernel's worker"));
  };
}
