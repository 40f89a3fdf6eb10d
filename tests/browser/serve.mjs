// The lab for tests in a browser: a server of web/dist, and how the page is opened and waited for.
import { readFile } from "node:fs/promises";
import { createServer } from "node:http";
import path from "node:path";
import { after, before } from "node:test";
import { fileURLToPath } from "node:url";
import { deflateRawSync } from "node:zlib";
import { visit } from "./visit.mjs";

const dist = fileURLToPath(new URL("../../web/dist/", import.meta.url));
const TYPES = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };

let server;
/** Where the lab is. */
export let folder;
/** What was asked of the server and is no file of the lab. */
export const stray = [];
before(async () => {
  server = createServer(async ({ url }, response) => {
    const name = new URL(url, "http://lab").pathname.slice(1) || "index.html";
    const bytes = await readFile(path.join(dist, name)).catch(() => undefined);
    if (!bytes) stray.push(url);
    response.writeHead(bytes ? 200 : 404, { "Content-Type": TYPES[path.extname(name)] ?? "text/plain" }).end(bytes);
  });
  await new Promise((done) => server.listen(0, "127.0.0.1", done));
  folder = `http://127.0.0.1:${server.address().port}/`;
});
after(() => server.close());

/** Waits until the page has answered. */
export const settled = (page) => page.waitForFunction(() => !document.body.classList.contains("running")
  && (!document.getElementById("verdict").hidden || !document.getElementById("error").hidden));

/** The lab with an address's end, when it has answered. */
export async function lab(t, hash = "", options = {}) {
  const page = await visit(t, folder + hash, { folder, ...options });
  await settled(page);
  return page;
}

/** Does something, and waits for the answer to it. */
export async function then(page, action) {
  await page.evaluate(() => document.body.classList.add("running"));
  await action();
  await settled(page);
}

export const title = (page) => page.textContent("#title");

/** Puts a text into the editor. */
export async function edit(page, text) {
  await page.locator(".cm-content").click();
  await page.keyboard.press("Control+A");
  await page.keyboard.insertText(text);
}

/** The end of the address of a link that carries a kernel. */
export const link = (text, rest = "") => `#${rest}text=${deflateRawSync(text, { level: 9 }).toString("base64url")}`;
