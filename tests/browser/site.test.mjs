// The pages of league/site, in a real browser: one of each kind.
import assert from "node:assert/strict";
import { readdirSync } from "node:fs";
import path from "node:path";
import { test } from "node:test";
import { AXE, THEMES, cutText, out, visit } from "./visit.mjs";

const site = path.resolve(process.env.SITE);
const first = (folder) => `${folder}/${readdirSync(path.join(site, folder)).sort()[0]}`;
const pages = ["index.html", "kernel/parry3d.html", "epsilon/1e-minus-6.html", first("case"), first("finding")];

for (const name of pages) {
  for (const theme of THEMES) {
    test(`${name} fits a phone, and axe finds nothing, ${theme}`, async (t) => {
      for (const width of [390, 1280]) {
        const page = await visit(t, `file://${path.join(site, name)}`, { width, theme });
        await page.screenshot({ path: out(`site-${name.split("/")[0]}-${width}-${theme}.png`), fullPage: true });
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
        assert.deepEqual(await cutText(page, width), []);
        await page.evaluate(AXE);
        const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
        assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`), []);
      }
    });
  }
}
