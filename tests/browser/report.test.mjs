// What a reader does with the report, in a real browser. run.sh makes the reports.
import assert from "node:assert/strict";
import { describe, test } from "node:test";
import { AXE as axe, THEMES, cutText, out, visit } from "./visit.mjs";

const [AUDIT, CHECK] = ["audit.html", "check.html"].map((name) => `file://${out(name)}`);

const openAll = (page) => page.evaluate(() => {
  for (const part of document.querySelectorAll("details")) part.open = true;
});

/** The shown rows: kernel, scalar, finding and the value in a column. */
const rows = (page, column = 1) => page.$$eval("#heat-table tbody tr", (all, column) =>
  all.filter((row) => row.checkVisibility()).map((row) => {
    const text = row.cells[column].dataset.v;
    return { ...row.dataset, share: text === undefined ? null : Number(text) };
  }), column);

const columnOf = (page, name) => page.$$eval("#heat-table thead th", (heads, name) =>
  heads.findIndex((head) => head.textContent.trim() === name), name);

describe("the table", () => {
  test("sorts by a column, down and up, by keyboard, and back", async (t) => {
    const page = await visit(t, AUDIT);
    const column = await columnOf(page, "tiny");
    const before = await rows(page, column);
    assert.equal(before.length, 4 * 2 * 2, "four rows, two scalars, two findings");
    const head = page.locator("#heat-table thead th").nth(column);
    assert.equal(await head.getAttribute("aria-sort"), null);

    await head.getByRole("button").focus();
    await page.keyboard.press("Enter");
    assert.equal(await head.getAttribute("aria-sort"), "descending");
    const down = (await rows(page, column)).map((row) => row.share ?? -1);
    assert.deepEqual(down, [...down].sort((a, b) => b - a));
    assert.notDeepEqual(await rows(page, column), before);
    assert.match(await page.textContent("#filter-count"), /^16 of 16 rows, by tiny, largest first$/);

    await page.keyboard.press("Space");
    assert.equal(await head.getAttribute("aria-sort"), "ascending");
    const up = (await rows(page, column)).map((row) => row.share);
    const numbers = up.filter((share) => share !== null);
    assert.deepEqual(numbers, [...numbers].sort((a, b) => a - b));
    assert.ok(up.indexOf(null) === -1 || up.indexOf(null) === numbers.length, "dashes stand last");

    const other = page.locator("#heat-table thead th").nth(1);
    await other.getByRole("button").click();
    assert.equal(await head.getAttribute("aria-sort"), null, "one column at a time");
    await other.getByRole("button").click();
    await other.getByRole("button").click();
    assert.deepEqual(await rows(page, column), before);
  });

  test("filters by kernel, scalar and finding, and resets", async (t) => {
    const page = await visit(t, AUDIT);
    await page.fill("#filter-kernel", "WOOP");
    assert.deepEqual(new Set((await rows(page)).map((row) => row.kernel)), new Set(["woop-watertight (source)"]));
    await page.selectOption("#filter-scalar", "f64");
    await page.selectOption("#filter-finding", "false-hit");
    const left = await rows(page);
    assert.equal(left.length, 1);
    assert.deepEqual([left[0].scalar, left[0].finding], ["f64", "false-hit"]);
    assert.match(await page.textContent("#filter-count"), /^1 of 16 rows/);
    await page.fill("#filter-kernel", "no such kernel");
    assert.equal((await rows(page)).length, 0);
    await page.click("#filter-reset");
    await page.waitForFunction(() => document.getElementById("filter-count").textContent === "16 of 16 rows");
    assert.equal((await rows(page)).length, 16);
  });

  test("keeps its first column and its head in view", async (t) => {
    const page = await visit(t, AUDIT, { width: 360, height: 640 });
    const moved = await page.$eval(".tall", (scroll) => {
      const place = (cell) => cell.getBoundingClientRect();
      const row = scroll.querySelector("tbody tr");
      const [head, value] = [row.cells[0], row.cells[3]];
      const before = [place(head).left, place(value).left];
      scroll.scrollLeft = 200;
      return [before[0] - place(head).left, before[1] - place(value).left];
    });
    assert.deepEqual(moved, [0, 200]);
  });
});

describe("the first table", () => {
  const values = (page, column) => page.$$eval("#questions-table tbody tr", (all, column) =>
    all.map((row) => Number(row.cells[column].dataset.v ?? -1)), column);

  test("sorts by every column, by keyboard, and back", async (t) => {
    const page = await visit(t, AUDIT);
    const heads = page.locator("#questions-table thead th");
    const columns = await heads.count();
    assert.ok(6 < columns);
    assert.equal(await page.locator("#questions-table thead button").count(), columns - 1);
    const names = () => page.$$eval("#questions-table tbody th", (all) => all.map((head) => head.textContent));
    const before = await names();
    for (let column = 1; column < columns; column++) {
      const head = heads.nth(column);
      await head.getByRole("button").focus();
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), "descending");
      const down = await values(page, column);
      assert.deepEqual(down, [...down].sort((a, b) => b - a));
      assert.equal(await page.locator("#questions-table [aria-sort]").count(), 1);
      await page.keyboard.press("Space");
      assert.equal(await head.getAttribute("aria-sort"), "ascending");
      const up = (await values(page, column)).filter((share) => share !== -1);
      assert.deepEqual(up, [...up].sort((a, b) => a - b));
      await page.keyboard.press("Enter");
      assert.equal(await head.getAttribute("aria-sort"), null);
      assert.deepEqual(await names(), before);
    }
    // The other table keeps its own order.
    assert.equal(await page.locator("#heat-table [aria-sort]").count(), 0);
  });
});

describe("without scripts", () => {
  test("everything stands there", async (t) => {
    const page = await visit(t, AUDIT, { scripts: false });
    assert.equal(await page.locator("#heat-table tbody tr").count(), 16);
    assert.equal(await page.locator("#filters").isVisible(), false);
    assert.equal(await page.locator("#heat-table button").count(), 0);
    const kernel = page.locator("details.kernel").first();
    await kernel.locator("> summary").click();
    assert.ok(await kernel.getByText("Gates, in the order of the test").isVisible());
    await kernel.locator("details.source > summary").first().click();
    assert.ok(await kernel.getByText(/^hairline explain '/).first().isVisible());
  });
});

describe("on a phone", () => {
  for (const theme of THEMES) {
    test(`nothing overflows and no text is cut, ${theme}`, async (t) => {
      for (const [name, url] of [["audit", AUDIT], ["check", CHECK]]) {
        const page = await visit(t, url, { width: 360, height: 780, theme });
        await page.screenshot({ path: out(`${name}-360-${theme}.png`) });
        await openAll(page);
        await page.screenshot({ path: out(`${name}-360-open-${theme}.png`) });
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), 360);
        const cut = await cutText(page, 360);
        assert.deepEqual(cut, []);
        // What scrolls sideways is within the page and reached by keyboard.
        const regions = await page.$$eval(".scroll, .drawing", (all) => all.map((region) => {
          const box = region.getBoundingClientRect();
          return [box.left >= 0, box.right <= 360, region.tabIndex, region.hasAttribute("aria-label") || region.hasAttribute("aria-labelledby")];
        }));
        assert.ok(regions.every((region) => JSON.stringify(region) === "[true,true,0,true]"), JSON.stringify(regions));
      }
    });
  }
});

describe("for everybody", () => {
  for (const theme of THEMES) {
    test(`axe finds nothing, contrast included, ${theme}`, async (t) => {
      for (const [name, url] of [["audit", AUDIT], ["check", CHECK]]) {
        const page = await visit(t, url, { theme });
        await page.screenshot({ path: out(`${name}-1280-${theme}.png`) });
        await openAll(page);
        await page.evaluate(axe);
        const result = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
        const found = result.violations.map((violation) =>
          `${violation.id}: ${violation.nodes.slice(0, 3).map((node) => `${node.html.slice(0, 200)} ${node.failureSummary}`).join("\n")}`);
        assert.deepEqual(found, []);
        assert.ok(result.passes.some((pass) => pass.id === "color-contrast"), "contrast was looked at");
      }
    });
  }

  test("the table and every kernel are reached and opened by keyboard", async (t) => {
    const page = await visit(t, AUDIT);
    const reached = [];
    for (let i = 0; i < 90; i++) {
      await page.keyboard.press("Tab");
      reached.push(await page.evaluate(() => {
        const at = document.activeElement;
        return at.closest("thead") ? `sort ${at.textContent}` : at.tagName === "SUMMARY" ? `open ${at.parentElement.id}` : at.id || at.className || at.textContent;
      }));
    }
    for (const wanted of ["skip", "filter-kernel", "filter-scalar", "filter-finding", "sort all", "sort tiny", "open k0", "open k3"]) {
      assert.ok(reached.includes(wanted), `${wanted}: ${reached.join(", ")}`);
    }
    const seen = await page.evaluate(() => getComputedStyle(document.activeElement).outlineStyle);
    assert.notEqual(seen, "none", "the focus is seen");
    await page.locator("#k2 > summary").focus();
    await page.keyboard.press("Enter");
    assert.equal(await page.locator("#k2").getAttribute("open"), "");
  });

  test("a link leads into its kernel and opens it", async (t) => {
    const page = await visit(t, AUDIT);
    await page.locator("#heat-table tbody a").nth(6).click();
    const id = new URL(page.url()).hash;
    await page.waitForFunction((id) => document.querySelector(id).open, id);
  });

  test("pictures are there, with what they show in words", async (t) => {
    const page = await visit(t, AUDIT);
    await openAll(page);
    const images = page.locator(".maps img");
    assert.equal(await images.count(), 4 * 2 * 3, "three spots of each row in each scalar");
    for (const image of await images.all()) {
      await image.scrollIntoViewIfNeeded();
      assert.match(await image.getAttribute("alt"), /Left, computed: \d.*Right, exact: \d/);
      await image.evaluate((image) => image.decode());
      assert.equal(await image.evaluate((image) => image.naturalWidth), 136);
      assert.equal(await image.evaluate((image) => getComputedStyle(image).imageRendering), "pixelated");
    }
    for (const kind of ["svg.plot", ".drawing svg"]) {
      assert.ok((await page.locator(kind).count()) > 4, kind);
    }
    await page.locator("#k0 .maps").scrollIntoViewIfNeeded();
    await page.screenshot({ path: out("maps.png") });
    await page.locator("#k0 .plots").scrollIntoViewIfNeeded();
    await page.screenshot({ path: out("plots.png") });
  });

  test("on paper the kernels stand open and controls are gone", async (t) => {
    const page = await visit(t, AUDIT, { theme: "dark" });
    await page.emulateMedia({ media: "print", colorScheme: "dark" });
    assert.equal(await page.locator("#filters").isVisible(), false);
    assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), "rgb(255, 255, 255)");
    await page.evaluate(() => dispatchEvent(new Event("beforeprint")));
    assert.equal(await page.locator("details.kernel:not([open])").count(), 0);
    await page.evaluate(() => dispatchEvent(new Event("afterprint")));
    assert.equal(await page.locator("details.kernel[open]").count(), 0);
    const pdf = await page.pdf({ path: out("audit.pdf"), preferCSSPageSize: true, printBackground: true });
    assert.ok(10_000 < pdf.length);
  });
});
