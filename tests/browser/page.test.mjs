// What a reader does with any page, in a real browser. run.sh makes the pages.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { AXE, THEMES, cutText, out, visit } from "./visit.mjs";

const url = (name) => `file://${out(name)}.html`;
const PAGES = ["audit", "check", "scene", "offset", "prove", "icosphere", "torus"];

const openAll = (page) => page.evaluate(() => {
  for (const part of document.querySelectorAll("details")) part.open = true;
});

for (const name of PAGES) {
  for (const theme of THEMES) {
    test(`${name} fits a phone and a desk, cuts no text, and axe finds nothing, ${theme}`, async (t) => {
      for (const width of [390, 1280]) {
        const page = await visit(t, url(name), { width, theme });
        await page.screenshot({ path: out(`${name}-${width}-${theme}.png`) });
        await openAll(page);
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
        assert.deepEqual(await cutText(page, width), []);
        // What scrolls sideways is within the page and reached by keyboard.
        const regions = await page.$$eval(".scroll, .drawing", (all, width) => all.filter((region) => {
          const box = region.getBoundingClientRect();
          return box.left < 0 || width < box.right || region.tabIndex !== 0 || !region.hasAttribute("aria-label");
        }).map((region) => region.outerHTML.slice(0, 200)), width);
        assert.deepEqual(regions, []);
        await page.evaluate(AXE);
        const result = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
        const found = result.violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`);
        assert.deepEqual(found, []);
        assert.ok(result.passes.some((pass) => pass.id === "color-contrast"), "contrast was looked at");
      }
    });
  }

  test(`${name} sorts its first table by every column, by keyboard, and back`, async (t) => {
    const page = await visit(t, url(name));
    await openAll(page);
    const table = page.locator("table.heat").first();
    const names = () => table.locator("tbody th").allTextContents();
    const values = (column) => table.locator("tbody tr").evaluateAll((all, column) =>
      all.map((row) => Number(row.cells[column].dataset.v ?? NaN)), column);
    const before = await names();
    const columns = await table.locator("thead th").count();
    for (let column = 1; column < columns; column++) {
      const head = table.locator("thead th").nth(column);
      // Words are not sorted.
      if (await head.evaluate((head) => head.classList.contains("text"))) continue;
      await head.getByRole("button").focus();
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), "descending");
      const sorted = (all, order) => {
        const numbers = all.filter((value) => !Number.isNaN(value));
        return [...numbers.sort(order), ...all.filter((value) => Number.isNaN(value))];
      };
      const down = await values(column);
      assert.deepEqual(down, sorted(down, (a, b) => b - a), "dashes stand last");
      assert.equal(await table.locator("[aria-sort]").count(), 1);
      await page.keyboard.press("Space");
      assert.equal(await head.getAttribute("aria-sort"), "ascending");
      const up = await values(column);
      assert.deepEqual(up, sorted(up, (a, b) => a - b), "dashes stand last");
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), null);
      assert.deepEqual(await names(), before);
    }
  });

  test(`${name} is whole without scripts, and on paper`, async (t) => {
    const plain = await visit(t, url(name), { scripts: false });
    assert.equal(await plain.locator("table.heat button").count(), 0);
    for (const folded of await plain.locator("section > details.kernel").all()) {
      await folded.locator("> summary").click();
      assert.ok(await folded.locator("> .body").isVisible());
    }
    assert.ok(await plain.locator("table.heat").first().isVisible());
    const page = await visit(t, url(name), { theme: "dark" });
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
    const pdf = await page.pdf({ path: out(`${name}.pdf`), preferCSSPageSize: true, printBackground: true });
    assert.ok(10_000 < pdf.length);
  });
}

describe("an audit", () => {
  test("leads from a row to all that is known of it, by keyboard too", async (t) => {
    const page = await visit(t, url("audit"));
    const link = page.locator("table.heat tbody a").first();
    await page.keyboard.press("Tab");
    await link.focus();
    assert.notEqual(await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle), "none", "the focus is seen");
    await page.keyboard.press("Enter");
    const id = new URL(page.url()).hash.slice(1);
    await page.waitForFunction((id) => document.getElementById(id).open, id);
    assert.match(await page.locator(`[id="${id}"] > summary`).textContent(), new RegExp(`^${await link.textContent()}`));
  });

  test("keeps the first column and the head of a wide table in view", async (t) => {
    const page = await visit(t, url("audit"), { width: 390, height: 640 });
    const moved = await page.$eval(".scroll", (scroll) => {
      const row = scroll.querySelector("tbody tr");
      const places = () => [row.cells[0], row.cells[3]].map((cell) => cell.getBoundingClientRect().left);
      const before = places();
      scroll.scrollLeft = 50;
      return places().map((place, i) => before[i] - place);
    });
    assert.deepEqual(moved, [0, 50]);
  });
});

test("a scene's plots keep their texts apart, inside, and explain themselves", async (t) => {
  const page = await visit(t, url("scene"), { scripts: false });
  await page.locator("details.kernel").evaluateAll((all) => all.forEach((part) => part.setAttribute("open", "")));
  const plots = page.locator("svg.chart");
  assert.equal(await plots.count(), 3);
  for (const plot of await plots.all()) {
    const { outside, overlaps, text } = await plot.evaluate((plot) => {
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
