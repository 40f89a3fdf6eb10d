import { chromium } from "playwright-core";
const [,, url, out, theme, width, ...acts] = process.argv;
const b = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"] });
const c = await b.newContext({ viewport: { width: +width, height: 900 }, colorScheme: theme, reducedMotion: "reduce", hasTouch: true, javaScriptEnabled: !acts.includes("noscript") });
const page = await c.newPage();
page.on("console", m => console.log("console", m.text())); page.on("pageerror", e => console.log("error", e.message));
page.on("request", r => { if (r.url() !== url) console.log("request", r.url()); });
const t = Date.now(); await page.goto(url); console.log("load ms", Date.now() - t);
for (const a of acts) { if (!["noscript","full"].includes(a)) await page.evaluate(a); }
await page.waitForTimeout(400);
await page.screenshot({ path: out, fullPage: acts.includes("full") });
await b.close();
