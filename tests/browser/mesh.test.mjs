// What a reader does with a mesh's drawing, in a real browser. run.sh makes the pages.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { describe, test } from "node:test";
import { out, visit } from "./visit.mjs";

const url = (name) => `file://${out(name)}.html`;
const SPHERE = url("icosphere");
const record = JSON.parse(readFileSync(out("icosphere.json"), "utf8"));

/** What the canvas shows, once it is drawn. */
const picture = async (page) => {
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  return page.$eval("#view", (canvas) => canvas.toDataURL());
};
const centre = (page) => page.$eval("#view", (canvas) => {
  canvas.scrollIntoView({ block: "center" });
  const box = canvas.getBoundingClientRect();
  return [box.left + box.width / 2, box.top + box.height / 2];
});

describe("the drawing", () => {
  test("turns by pointer and keys, zooms, and goes back", async (t) => {
    const page = await visit(t, SPHERE);
    const start = await picture(page);
    const back = async () => {
      await page.getByRole("button", { name: "Reset" }).click();
      assert.equal(await picture(page), start);
    };
    const [x, y] = await centre(page);
    await page.mouse.move(x, y);
    await page.mouse.wheel(0, 40);
    assert.equal(await picture(page), start, "who scrolls past scrolls the page");
    await centre(page);
    await page.mouse.down();
    await page.mouse.move(x + 60, y + 20, { steps: 4 });
    await page.mouse.up();
    assert.notEqual(await picture(page), start);
    await page.mouse.wheel(0, -200);
    await back();
    await page.locator("#view").focus();
    for (const key of ["ArrowLeft", "ArrowUp", "+", "-", "ArrowRight", "ArrowDown"]) {
      const before = await picture(page);
      await page.keyboard.press(key);
      assert.notEqual(await picture(page), before, key);
    }
    await page.keyboard.press("0");
    assert.equal(await picture(page), start);
    for (const name of ["Zoom in", "Zoom out"]) {
      await page.getByRole("button", { name }).click();
      assert.notEqual(await picture(page), start, name);
      await back();
    }
    await page.getByLabel("see through").check();
    assert.notEqual(await picture(page), start);
  });

  test("pinches", async (t) => {
    const page = await visit(t, SPHERE, { width: 390 });
    const start = await picture(page);
    await centre(page);
    const session = await page.context().newCDPSession(page);
    const touch = (type, points) => session.send("Input.dispatchTouchEvent", {
      type, touchPoints: points.map(([x, y], id) => ({ x, y, id })),
    });
    const [x, y] = await centre(page);
    await touch("touchStart", [[x - 30, y], [x + 30, y]]);
    await touch("touchMove", [[x - 90, y], [x + 90, y]]);
    await touch("touchEnd", []);
    assert.notEqual(await picture(page), start);
    assert.equal(await page.evaluate(() => visualViewport.scale), 1, "the page stays");
    await page.locator("#reset").click();
    await touch("touchStart", [[x, y]]);
    await touch("touchMove", [[x + 50, y + 10]]);
    await touch("touchEnd", []);
    assert.notEqual(await picture(page), start);
  });

  test("shows each row's places, and each place's faces and command", async (t) => {
    const page = await visit(t, SPHERE);
    const at = (part) => record.result.results.filter((it) => it.scalar === "f32" && it.family.startsWith(`mesh-${part}:`));
    const leaking = at("edges").map((edges, i) => [edges, at("vertices")[i]].map((it) => it.across.leaking.count));
    assert.match(await page.locator("#row option:checked").textContent(), /^plucker /, "its promise is broken");
    for (const [i, [edges, vertices]] of leaking.entries()) {
      await page.selectOption("#row", String(i));
      const said = await page.textContent("#sum");
      const number = (n) => n.toLocaleString("en");
      assert.ok(said.startsWith(`${number(edges)} edge`) && said.includes(`, ${number(vertices)} vert`), said);
    }
    assert.match(await page.textContent("#what"), /^No place of this row/);
    await page.selectOption("#row", "0");
    await page.getByRole("button", { name: "Next place" }).click();
    const what = await page.textContent("#what");
    assert.match(what, /^crack at (edge \d+–\d+|vertex \d+) of .*icosphere\.obj, faces at lines [\d, ]+: \d of 8 rays aimed at this/);
    const command = await page.textContent("#command");
    assert.match(command, /^hairline explain 'mesh-(edges|vertices)@\d+\/f32\/mesh=\w+\/1\/\d+' --mesh '.*' --kernel moller-trumbore/);
    // The place stands in the middle, and a click there finds it.
    await page.keyboard.press("Tab");
    await page.locator("#view").focus();
    await page.keyboard.press("n");
    assert.notEqual(await page.textContent("#command"), command);
    await page.keyboard.press("p");
    assert.equal(await page.textContent("#command"), command);
    const [x, y] = await centre(page);
    await page.mouse.click(x + 300, y - 200);
    assert.match(await page.textContent("#what"), /^Click a mark/);
    await page.mouse.click(x, y);
    assert.equal(await page.textContent("#command"), command);
    // So does the table.
    await page.locator("#r0 > summary").click();
    const line = page.locator("#r0 tbody tr").nth(3);
    await line.getByRole("button").click();
    assert.equal(await page.textContent("#command"), await line.locator("code").textContent());
    assert.equal(await page.evaluate(() => document.activeElement.id), "view");
  });

  test("follows the theme", async (t) => {
    const page = await visit(t, SPHERE);
    const light = await picture(page);
    await page.emulateMedia({ colorScheme: "dark" });
    assert.notEqual(await picture(page), light);
  });
});

test("without scripts the first places stand there", async (t) => {
  const page = await visit(t, SPHERE, { scripts: false });
  assert.ok(await page.locator("noscript p").isVisible());
  for (const hidden of ["#view", "#stage-controls", "#place"]) assert.equal(await page.locator(hidden).isVisible(), false);
  await page.locator("#r0 > summary").click();
  assert.equal(await page.locator("#r0 tbody tr").count(), 20);
  assert.ok(await page.locator("#r0").getByText(/^hairline explain '/).first().isVisible());
  await page.screenshot({ path: out("mesh-still.png"), fullPage: true });
});
