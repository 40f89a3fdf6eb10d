// Bundles the page: lab.js with the judge's worker inside, lab.css with the styles of the program's pages, and the file
// of the sandbox. And the packages.
import { build } from "esbuild";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";

const common = { bundle: true, minify: true, target: "es2023", logLevel: "warning" };
const texts = { "virtual:mesh-script": `export default () => {${readFileSync("../crates/report/src/mesh/view.js", "utf8")}};` };
const virtual = {
  name: "virtual",
  setup(build) {
    build.onResolve({ filter: /^virtual:/ }, ({ path }) => ({ path, namespace: "virtual" }));
    build.onLoad({ filter: /.*/, namespace: "virtual" }, ({ path }) => ({
      contents: texts[path], loader: path === "virtual:mesh-script" ? "js" : "text",
    }));
  },
};
const bundled = async (entry, format) => {
  const { outputFiles } = await build({ ...common, entryPoints: [entry], format, plugins: [virtual], write: false });
  return outputFiles[0].text;
};

texts["virtual:judge"] = await bundled("src/judge.ts", "esm");
await build({ ...common, entryPoints: ["src/lab.ts"], format: "esm", outfile: "dist/lab.js", plugins: [virtual] });
await build({ ...common, entryPoints: ["lab.css"], outfile: "dist/lab.css" });

// The frame's script is known by its hash. A kernel comes as a `data:` module into a `data:` worker, which is all that a
// `data:` script can be there: nothing else writes into the frame.
texts["virtual:sandbox-worker"] = await bundled("src/sandbox/worker.ts", "esm");
const script = (await bundled("src/sandbox/frame.ts", "iife")).replaceAll("</", "<\\/");
const hash = createHash("sha256").update(script).digest("base64");
const policy = `default-src 'none'; script-src 'sha256-${hash}' data: 'wasm-unsafe-eval'; worker-src data:; base-uri 'none'; form-action 'none'`;
writeFileSync("dist/sandbox.html", `<!doctype html>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<title>A kernel of the lab's</title>
<script>${script}</script>
`);

for (const [source, outfile] of [["package", "package/hairline.js"], ["vectors", "vectors/index.js"]]) {
  await build({ ...common, minify: false, entryPoints: [`src/${source}.ts`], format: "esm", outfile, external: ["node:*"] });
}
