// What somebody does in the lab, in a real browser. `web/build` makes it.
import assert from "node:assert/strict";
import { readFile } from "node:fs/promises";
import path from "node:path";
import { describe, test } from "node:test";
import { fileURLToPath } from "node:url";
import { edit, folder, lab, settled, then, title } from "./serve.mjs";
import { AXE, THEMES, cutText, out, visit } from "./visit.mjs";

const meshes = fileURLToPath(new URL("../../corpora/meshes/", import.meta.url));
const picture = (page, id) => page.$eval(`#${id}`, (canvas) => canvas.toDataURL());

for (const theme of THEMES) {
  test(`it fits a phone and a desk, cuts no text, and axe finds nothing, ${theme}`, async (t) => {
    for (const width of [390, 1280]) {
      const page = await lab(t, "", { width, theme });
      await page.screenshot({ path: out(`lab-${width}-${theme}.png`), fullPage: true });
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
      assert.deepEqual((await cutText(page, width)).filter((text) => !text.startsWith("cm-")), []);
      await page.evaluate(AXE);
      const result = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
      assert.deepEqual(result.violations.map(({ id, nodes }) => `${id}: ${nodes[0].html.slice(0, 200)} ${nodes[0].failureSummary}`), []);
      assert.ok(result.passes.some((pass) => pass.id === "color-contrast"), "contrast was looked at");
    }
  });
}

describe("a kernel in JavaScript", () => {
  test("is wrong where an example is known to be, and right when it is mended", async (t) => {
    const page = await lab(t);
    assert.match(await title(page), /^yours \(parallel=1e-6\)( leaks: \d|: (no leak|visible errors|no visible))/);
    const misses = (page) => page.$eval("#report table", (table) => {
      const row = [...table.tBodies[0].rows].find(({ cells }) => cells[0].textContent === "flat");
      return Number(row.cells[1].dataset.v);
    });
    assert.ok(await misses(page) > 0.5, "its epsilon misses grazing rays");
    await then(page, () => page.getByRole("textbox", { name: "parallel, as a number" }).fill("0").then(() => page.keyboard.press("Tab")));
    assert.match(await title(page), /^yours \(parallel=0\)/);
    assert.ok(await misses(page) < 0.2);
    assert.match(page.url(), /e\.parallel=0/);
  });

  test("is run again when it is edited, and tells its mistakes", async (t) => {
    const page = await lab(t);
    for (const [text, error] of [
      ["export default (", /^The kernel cannot be run\. SyntaxError: /],
      ["export default ({ origin }, { a }) => { origin[0] < a[0] ? 1 : null; };", /^The kernel cannot be run\. Error: the kernel returns undefined for a ray through the middle of a triangle: is a `return` missing/],
      ["export default (point, direction, triangle) => triangle[0][0];", /^The kernel cannot be run\. TypeError: .*\. It is called as kernel\(\{ origin, direction, tMin, tMax \}, \{ a, b, c \}, epsilon\), with vectors \[x, y, z\]$/],
      ["export const epsilons = {};", /^The kernel cannot be run\. Error: the module has no kernel: write `export default function/],
      ["export default () => nobody;", /^The kernel cannot be run\. ReferenceError: nobody is not defined/],
      ["import { Ray } from 'three';\nexport default () => null;", /^The kernel cannot be run\. TypeError: .*The lab loads no other modules: paste here what yours needs$/],
      ["const dot = require('gl-vec3/dot');\nexport default () => null;", /^The kernel cannot be run\. ReferenceError: require is not defined\. The lab loads no other/],
      ["export const contract = 'most';\nexport default () => null;", /^contract: /],
    ]) {
      await then(page, () => edit(page, text));
      assert.match(await page.textContent("#error"), error);
    }
    // A kernel that hits everything is refused.
    await then(page, () => edit(page, "export default ({ origin: [x] }) => Math.abs(x) < 30;"));
    assert.ok(await page.locator("#error").isHidden());
    assert.match(await title(page), /^yours \(own\)/);
    // What leads on names the kernel.
    assert.match(await page.textContent("#report"), /hairline check --kernel-cmd 'node kernel\.mjs' --scalar f64 -n 500 --bless/);
    assert.match(await page.textContent("#hint"), /^It hits what lies behind the ray's start\. If that is meant, say so: export const contract = ".*,extent=line";$/);
    // With nothing to slide there is no slider.
    assert.ok(await page.locator("#epsilons").isHidden());
  });

  test("is ended when it does not end, and the page stays alive meanwhile", { timeout: 120_000 }, async (t) => {
    const page = await lab(t);
    await page.evaluate(() => { window.ticks = 0; setInterval(() => { window.ticks++; }, 100); });
    await then(page, () => edit(page, "export default () => { for (;;); };"));
    assert.ok(await page.evaluate(() => window.ticks) > 100, "20 s are 200 ticks");
    assert.match(await page.textContent("#error"), /gave no answer in \d+ s, and was ended/);
    // What is below is of the kernel before, and says so.
    assert.equal(await page.textContent("#former"), "What is below is of the kernel before this one.");
    assert.ok(await page.locator("#former").isVisible());
    assert.ok(await page.$eval("#verdict", (part) => part.inert && Number(getComputedStyle(part).opacity) < 0.5));
    assert.equal(await page.locator("iframe").count(), 0);
    await then(page, () => edit(page, "export default () => null;"));
    assert.match(await title(page), /^yours/);
    assert.ok(await page.locator("#former").isHidden());
    assert.ok(await page.$eval("#verdict", (part) => !part.inert && getComputedStyle(part).opacity === "1"));
    // One that does not end before it is asked, either.
    await then(page, () => edit(page, "for (;;);"));
    assert.match(await page.textContent("#error"), /gave no answer in \d+ s, and was ended/);
    // Nobody waits for it when something else is asked.
    await edit(page, "export default () => { for (;;) { /* again */ } };");
    await page.waitForFunction(() => document.getElementById("status").textContent === "Running…");
    const start = Date.now();
    await then(page, () => page.locator("#kernel").selectOption("cramer"));
    assert.match(await title(page), /^cramer/);
    t.diagnostic(`another kernel answers ${Date.now() - start} ms after an endless one`);
  });

  test("that throws is told with what it says", async (t) => {
    const page = await lab(t, "#n=20&cases=room");
    assert.ok(await page.locator("#threw").isHidden());
    await then(page, () => edit(page, `export default ({ origin }, { a }) => {
      if (origin[0] > a[0] + 1) throw new RangeError("x is <b>too</b> large");
      return null;
    };`));
    assert.equal(await page.textContent("#threw"), "The kernel gives no verdict on some of the cases. The first time: RangeError: x is <b>too</b> large");
    await then(page, () => edit(page, "export default () => null;"));
    assert.ok(await page.locator("#threw").isHidden());
  });

  test("tells its times: the first answer, and 100,000 rays", async (t) => {
    const page = await visit(t, folder, { folder });
    const first = await page.waitForFunction(() => !document.getElementById("verdict").hidden && performance.now());
    t.diagnostic(`first answer after ${Math.round(await first.jsonValue())} ms`);
    await settled(page);
    await then(page, () => page.getByLabel("Cases of each kind").fill("2800").then(() => page.keyboard.press("Tab")));
    const [, cases, seconds] = /^([\d,]+) cases in f64, ([\d.]+) s/.exec(await page.textContent("#sums"));
    assert.ok(Number(cases.replaceAll(",", "")) > 100_000, cases);
    t.diagnostic(`${cases} cases in ${seconds} s`);
  });
});

test("a built-in kernel in a scene, its epsilons and the contract are chosen, and the link opens the same", async (t) => {
  const page = await lab(t);
  await then(page, () => page.locator("#kernel").selectOption("moller-trumbore"));
  assert.match(await title(page), /^moller-trumbore/);
  await then(page, () => page.locator("#cases").selectOption("room"));
  await then(page, () => page.locator("#scalar").selectOption("f32"));
  await then(page, () => page.locator("#contract").selectOption("closed-ray"));
  await then(page, () => page.locator("#e-parallel").focus().then(() => page.keyboard.press("ArrowRight")));
  const said = await title(page);
  assert.match(said, /parallel=3e-6/);
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#record").click()]);
  const record = JSON.parse(await readFile(await download.path(), "utf8"));
  assert.equal(record.schema, "hairline-record/2");
  assert.equal(record.result.plan.rows[0].epsilons.parallel, "3e-6");
  assert.ok(await page.locator("#editor").isHidden());
  const other = await lab(t, new URL(page.url()).hash);
  assert.equal(await title(other), said);
  assert.equal(await other.textContent("#sums").then((text) => text.split(",")[0]), await page.textContent("#sums").then((text) => text.split(",")[0]));
});

test("a case has its numbers, a drawing, a map and a command, and a link to itself", async (t) => {
  const page = await lab(t, "#kernel=moller-trumbore&scalar=f32");
  await page.locator("#report").getByRole("button", { name: /^Show tiny@/ }).first().click();
  await page.waitForFunction(() => document.getElementById("case-name").textContent.startsWith("tiny@"));
  assert.match(await page.textContent("#case-title"), /^One case: false miss/);
  const command = await page.textContent("#case-command");
  assert.match(command, /^hairline explain 'tiny@\d\/f32\/-\/1\/\d+' --kernel moller-trumbore --epsilon 'parallel=1e-6,edge=0'$/);
  assert.match(await page.textContent("#explained"), /exactly|truth/);
  assert.equal(await page.locator("#drawing svg").count(), 1);
  const svg = page.locator("#space svg");
  const before = await svg.innerHTML();
  await svg.focus();
  await page.keyboard.press("ArrowLeft");
  assert.notEqual(await svg.innerHTML(), before);
  const other = await lab(t, new URL(page.url()).hash);
  assert.equal(await other.textContent("#case-command"), command);
  assert.ok(await picture(other, "computed") === await picture(page, "computed"));
});

test("the map moves, zooms and leads to its pixels' cases", async (t) => {
  const shown = '{"scalar":"f64","origin":[0.625,0.75,0.875],"direction":[-0.125,-0.25,-1],"a":[-12,-12,3],"b":[24,24,-6],"c":[-12,24,1]}';
  const page = await lab(t, `#kernel=moller-trumbore&case=${encodeURIComponent(shown)}`);
  const legend = () => page.textContent("#computed-legend");
  assert.match(await legend(), /false (hit|miss): \d/);
  // The kernel's side differs from the exact one, pixel by pixel as the legend counts them.
  const changed = async (action) => {
    const [picture_before, axes] = [await picture(page, "computed"), await page.textContent("#axes")];
    await action();
    await page.waitForFunction((axes) => document.getElementById("axes").textContent !== axes, axes);
    return [picture_before, await picture(page, "computed")];
  };
  await page.locator("#computed").focus();
  for (const key of ["ArrowLeft", "ArrowUp", "-"]) {
    const [a, b] = await changed(() => page.keyboard.press(key));
    assert.ok(a !== b, key);
  }
  assert.match(page.url(), /x=-16&y=16&zoom=2/);
  const moved = await picture(page, "exact");
  const same = await lab(t, new URL(page.url()).hash);
  assert.ok(await picture(same, "exact") === moved);
  await changed(() => page.getByRole("button", { name: "Centre" }).click());
  // The same case stands in the list.
  await page.locator("#around").selectOption("edge");
  await page.waitForFunction(() => /around=edge/.test(location.hash));
  assert.match(await legend(), /false (hit|miss): \d/);
  const box = await page.locator("#computed").boundingBox();
  await page.mouse.click(box.x + box.width / 4, box.y + box.height / 4);
  await page.waitForFunction(() => /A case from the map/.test(document.getElementById("case-name").textContent));
  assert.match(await page.textContent("#case-command"), /^hairline explain '\{"scalar":"f64","origin":\[0\.62[45]/);
});

describe("a kernel in WGSL", () => {
  const wgsl = async (t, cases) => {
    const page = await lab(t, `#kernel=moller-trumbore&scalar=f32&cases=${cases}`);
    const adapter = await page.evaluate(async () => Boolean(await navigator.gpu?.requestAdapter()));
    if (!adapter) {
      t.skip("this browser has no WebGPU");
      return undefined;
    }
    await then(page, () => page.locator("#kernel").selectOption("wgsl"));
    return page;
  };

  test("runs on the device, with its epsilons, and is judged as the same kernel in JavaScript", async (t) => {
    const page = await wgsl(t, "room");
    if (!page) return;
    assert.match(await title(page), /^yours \(parallel=1e-6\)( leaks: \d|: (no leak|visible errors|no visible))/);
    // What the device answers is looked at, and the case that is shown.
    assert.match(await page.textContent("#rules"), /^WGSL's accuracy rules forbid none of this device's answers, wrong or right, as far as bounds tell: [\d,]+( of [\d,]+)? verdicts were looked at\.$/);
    assert.match(await page.textContent("#case-name"), /WGSL's accuracy rules forbid (a hit|a miss|no answer) here\.$/);
    // Comparisons alone, which every machine does alike.
    await then(page, () => edit(page, `// epsilon edge = 0.5
      fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {
        return Hit(ray.origin.x > triangle.a.y && ray.direction.z < epsilon.edge, ray.origin.y, triangle.b.x, triangle.c.z);
      }`));
    const numbers = () => page.$$eval("#report td", (all) => all.map((cell) => cell.textContent).filter((text) => !text.includes("hairline")));
    const on_device = [await title(page), ...await numbers()];
    assert.match(on_device[0], /^yours \(edge=0\.5\)/);
    assert.ok(on_device.length > 100, `${on_device.length} numbers`);
    await then(page, () => page.locator("#kernel").selectOption("js"));
    await then(page, () => page.locator("#scalar").selectOption("f32"));
    await then(page, () => edit(page, `export const epsilons = { edge: 0.5 };
      export default ({ origin, direction }, { a, b, c }, { edge }) =>
        (origin[0] > a[1] && direction[2] < edge ? { t: origin[1], u: b[0], v: c[2] } : null);`));
    assert.deepEqual([await title(page), ...await numbers()], on_device);
  });

  test("is ended in its loops when it does not end", async (t) => {
    const page = await wgsl(t, "room&n=20");
    if (!page) return;
    // Said in a comment that ends where WGSL's lines end; and in a loop in a loop.
    for (const loop of ["while (x < 1e30 + ray.t_min) { x = x * 0.5 + 1.0; }", "// \u2028 loop { for (;;) { x += ray.t_min * 0.0; if (x > 2.0) { break; } } if (x > 3.0) { break; } }\n"]) {
      await then(page, () => edit(page, `fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {
        var x = 1.0;
        ${loop}
        return Hit(x > 0.0, x, 0.0, 0.0);
      }`));
      assert.equal(await page.textContent("#error"), "");
      assert.equal(await page.textContent("#threw"), "The kernel gives no verdict on some of the cases. The first time: its loops were ended after 16,384 steps");
    }
    await then(page, () => edit(page, "fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {\n  for (;;) { hairline_steps = 9u; }\n}"));
    assert.match(await page.textContent("#error"), /^line 2: names that begin with hairline_ are the lab's/);
    // The device answers the next.
    await then(page, () => page.locator("#kernel").selectOption("cramer"));
    await then(page, () => page.locator("#kernel").selectOption("wgsl"));
    assert.match(await title(page), /^yours \(parallel=1e-6\)/);
  });

  test("tells its mistakes with their lines, and the device's arithmetic as JSON", async (t) => {
    const page = await wgsl(t, "all");
    if (!page) return;
    assert.match(await title(page), /^yours \(parallel=1e-6\)( leaks: \d|: (no leak|visible errors|no visible))/);
    await page.locator("#signature").click();
    await page.waitForFunction(() => !document.getElementById("signature-json").hidden);
    const told = JSON.parse(await page.textContent("#signature-json"));
    assert.equal(told.schema, "hairline-device/1");
    assert.match(told.product_and_sum, /^(fused|rounded twice)$/);
    assert.match(told.dot, /first$/);
    assert.equal(told.division.of, 4096);
    assert.ok(told.division.most_ulps <= 3, "what WGSL demands is 2.5 ulps");
    assert.ok(told.verdicts.looked_at > 1000 && told.verdicts.unexplained === 0, JSON.stringify(told.verdicts));
    await then(page, () => edit(page, "fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {\n  return Hit(sin(ray.origin.x) > 0.5, 1.0, 0.0, 0.0);\n}"));
    assert.equal(await page.textContent("#rules"), "What WGSL's accuracy rules forbid here is not known: the kernel has the function sin, which this page does not evaluate.");
    await then(page, () => edit(page, "fn kernel(ray: Ray, triangle: Triangle, epsilon: Epsilon) -> Hit {\n  return nothing;\n}"));
    assert.match(await page.textContent("#error"), /^Error: line 2: |^line 2: /);
  });
});

test("an epsilon has a curve", async (t) => {
  const page = await lab(t, "#kernel=moller-trumbore&cases=room&scalar=f32");
  const curve = page.locator("#curve svg");
  assert.match(await curve.getAttribute("aria-label"), /^False misses grow from [\d.e-]+ % to \d+(\.\d+)? %, false hits/);
  assert.equal(await curve.locator("circle").count(), 36);
  const before = await curve.innerHTML();
  await page.locator("#gate").selectOption("edge");
  await page.waitForFunction((before) => document.querySelector("#curve svg").innerHTML !== before, before);
});

test("a mesh shows its cracks", async (t) => {
  const page = await lab(t, "#kernel=moller-trumbore&scalar=f32");
  await page.locator("#file").setInputFiles(path.join(meshes, "icosphere.obj"));
  await page.waitForFunction(() => /^Rays slip through icosphere/.test(document.getElementById("mesh-title").textContent));
  await page.locator("#view").scrollIntoViewIfNeeded();
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))));
  const blank = await page.$eval("#view", (canvas) => {
    const other = document.createElement("canvas");
    [other.width, other.height] = [canvas.width, canvas.height];
    return other.toDataURL() === canvas.toDataURL();
  });
  assert.equal(blank, false);
  await page.screenshot({ path: out("lab-mesh.png") });
  // An open corner in STL: three faces around a point.
  const faces = [[[1, 0, 0], [0, 1, 0]], [[0, 1, 0], [0, 0, 1]], [[0, 0, 1], [1, 0, 0]]];
  const stl = faces.map(([p, q]) => `facet normal 0 0 0\nouter loop\n${[[0, 0, 0], p, q].map((v) => `vertex ${v.join(" ")}`).join("\n")}\nendloop\nendfacet`);
  const buffer = Buffer.from(`solid corner\n${stl.join("\n")}\nendsolid corner\n`);
  await page.locator("#file").setInputFiles({ name: "corner.stl", mimeType: "model/stl", buffer });
  await page.waitForFunction(() => /3 triangles, 4 vertices/.test(document.getElementById("mesh").textContent));
  await page.locator("#file").setInputFiles({ name: "bad.obj", mimeType: "text/plain", buffer: Buffer.from("v 1 2\n") });
  await page.waitForFunction(() => /^bad\.obj:1: /.test(document.getElementById("mesh-title").textContent));
});
