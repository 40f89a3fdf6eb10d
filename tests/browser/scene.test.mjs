// The page of `hairline epsilon --scene`, in a real browser. run.sh makes it.
import assert from "node:assert/strict";
import { test } from "node:test";
import { AXE, THEMES, cutText, out, visit } from "./visit.mjs";

const SCENE = `file://${out("scene.html")}`;

for (const theme of THEMES) {
  test(`a scene's page fits a phone, and axe finds nothing, ${theme}`, async (t) => {
    for (const width of [360, 1280]) {
      const page = await visit(t, SCENE, { width, theme });
      await page.screenshot({ path: out(`scene-${width}-${theme}.png`), fullPage: true });
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
      assert.deepEqual(await cutText(page, width), []);
      await page.evaluate(AXE);
      const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
      assert.deepEqual(violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`), []);
    }
  });
}

test("a scene's plots keep their texts apart, inside, and explain themselves", async (t) => {
  const page = await visit(t, SCENE, { scripts: false });
  const plots = page.locator("svg.chart");
  assert.equal(await plots.count(), 3);
  for (let i = 0; i < 3; i++) {
    const { outside, overlaps, text } = await plots.nth(i).evaluate((plot) => {
      const frame = plot.getBoundingClientRect();
      const boxes = [...plot.querySelectorAll("text")].map((text) => ({ text: text.textContent, box: text.getBoundingClientRect() }));
      const outside = boxes.filter(({ box }) => box.left < frame.left - 1 || frame.right + 1 < box.right || frame.bottom + 1 < box.bottom);
      const meet = (a, b) => a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 2 && b.top < a.bottom - 2;
      const overlaps = boxes.flatMap((a, k) => boxes.slice(k + 1).filter((b) => meet(a.box, b.box)).map((b) => [a.text, b.text]));
      return { outside: outside.map(({ text }) => text), overlaps, text: plot.textContent };
    });
    assert.deepEqual({ outside, overlaps }, { outside: [], overlaps: [] });
    assert.match(text, /around a line: its 95 % interval/);
  }
});
