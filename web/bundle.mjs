// Bundles the page: lab.js with the worker inside, lab.css with the styles of the program's pages. And the packages.
import { build } from "esbuild";
import { readFileSync } from "node:fs";

const common = { bundle: true, minify: true, target: "es2023", logLevel: "warning" };
const worker = await build({ ...common, entryPoints: ["src/worker.ts"], format: "esm", write: false });
const texts = {
  "virtual:worker": worker.outputFiles[0].text,
  "virtual:mesh-script": readFileSync("../src/report/mesh/view.js", "utf8"),
};
const virtual = {
  name: "virtual",
  setup(build) {
    build.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: "virtual" }));
    build.onLoad({ filter: /.*/, namespace: "virtual" }, ({ path }) => ({ contents: texts[path], loader: "text" }));
  },
};
await build({ ...common, entryPoints: ["src/lab.ts"], format: "esm", outfile: "dist/lab.js", plugins: [virtual] });
await build({ ...common, entryPoints: ["lab.css"], outfile: "dist/lab.css" });
for (const [source, outfile] of [["package", "package/hairline.js"], ["vectors", "vectors/index.js"]]) {
  await build({ ...common, minify: false, entryPoints: [`src/${source}.ts`], format: "esm", outfile, external: ["node:*"] });
}
