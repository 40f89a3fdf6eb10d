// What the tests of the pages share: a browser, and how a page is opened and looked at.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import path from "node:path";
import { after, before } from "node:test";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

const here = path.dirname(fileURLToPath(import.meta.url));
export const out = (name) => path.join(here, "out", name);
export const AXE = readFileSync(createRequire(import.meta.url).resolve("axe-core/axe.min.js"), "utf8");
export const THEMES = ["light", "dark"];

let browser;
before(async () => {
  browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium",
    args: ["--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
      "--disable-background-networking", "--disable-component-update", "--disable-sync",
      // WebGPU without a graphics device.
      "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader", "--enable-features=Vulkan,WebGPU", "--use-vulkan=swiftshader"],
  });
});
after(() => browser.close());

/** Opens a page; whatever the console, the page or the network says is a failure, but for files of the page's own folder
 * where it has some. A hostile page may say what it likes: its test looks at what came of it. `before` is run in each frame first. */
export async function visit(t, url, { width = 1280, height = 900, theme = "light", scripts = true, folder, isHostile = false, before } = {}) {
  const context = await browser.newContext({
    viewport: { width, height }, colorScheme: theme, javaScriptEnabled: scripts, reducedMotion: "reduce", hasTouch: true,
  });
  if (before) await context.addInitScript(before);
  const page = await context.newPage();
  const trouble = [];
  page.on("console", (message) => trouble.push(`${message.type()}: ${message.text()}`));
  page.on("pageerror", (error) => trouble.push(error.message));
  page.on("request", (request) => {
    const isOwn = folder && (request.url().startsWith(folder) || request.url().startsWith(`blob:${folder}`));
    if (request.url() !== url && !request.url().startsWith("data:") && !isOwn) trouble.push(request.url());
  });
  // What the page's own policy refused has not left it.
  page.on("requestfailed", (request) => {
    if (request.failure().errorText === "csp") trouble.splice(trouble.indexOf(request.url()), 1);
  });
  t.after(async () => {
    await context.close();
    if (!isHostile) assert.deepEqual(trouble, []);
  });
  await page.goto(url);
  return page;
}

/** Text that leaves a page of some width, or that something around it hides. */
export const cutText = (page, width) => page.evaluate((width) => {
  const bad = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (walker.nextNode()) {
    const parent = walker.currentNode.parentElement;
    if (!walker.currentNode.data.trim() || parent.closest("script, .hidden, .skip, option")) continue;
    if (!parent.checkVisibility()) continue;
    const range = document.createRange();
    range.selectNodeContents(walker.currentNode);
    // Inside what scrolls sideways text may be anywhere; otherwise it is on the page.
    const scrolls = parent.closest(".scroll, .drawing, .stage");
    for (const box of range.getClientRects()) {
      if (!scrolls && (box.left < -0.5 || box.right > width + 0.5)) bad.push(walker.currentNode.data);
    }
    // And nothing around it hides a part of it.
    for (let box = parent; box && box !== scrolls; box = box.parentElement) {
      const style = getComputedStyle(box);
      if (style.overflowX !== "visible" && box.scrollWidth > box.clientWidth + 1
        && !(box instanceof SVGElement)) bad.push(`${box.className}: ${walker.currentNode.data}`);
    }
  }
  return [...new Set(bad)].slice(0, 20);
}, width);
