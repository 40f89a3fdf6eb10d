#!/usr/bin/env bash
# The HTML pages in headless Chromium. Needs Node.js 20, Debian's chromium (or CHROMIUM=path), poppler-utils
# for the printed page as a picture, and the program (HAIRLINE=path, target/release/hairline if not said).
# Screenshots go to tests/browser/out. With SITE=folder the pages of league/site in it are looked at too.
set -euo pipefail
hairline=$(realpath "${HAIRLINE:-$(dirname "$0")/../../target/release/hairline}")
cd "$(dirname "$0")"
rm -rf out && mkdir out
"$hairline" audit --quiet --kernel moller-trumbore,plane-unit-normal,woop-watertight \
    --family interior,outside,edge-near,edge-exact,parallel-off,tiny,fan,secondary-ray,invalid,direction-length \
    -n 600 --examples 2 --format html,json -o out/audit.html -o out/audit.json
# Where nothing is expected, everything is a deviation.
(cd out && "$hairline" check --quiet --kernel moller-trumbore --family edge-near -n 300 \
    --format html -o check.html) || test $? = 1
for mesh in icosphere torus; do
    "$hairline" mesh "../../corpora/meshes/$mesh.obj" --quiet --kernel moller-trumbore,plucker,woop-watertight \
        --format html,json -o "out/$mesh.html" -o "out/$mesh.json"
done
"$hairline" epsilon --quiet --kernel moller-trumbore --scene room --scalar f32 -n 10000 --format html -o out/scene.html
"$hairline" offset --quiet --scene room --scalar f32 -n 2000 --format html -o out/offset.html
"$hairline" prove --quiet --kernel moller-trumbore,plane-unit-normal --format html -o out/prove.html
test -d node_modules || npm ci
node --test --test-reporter=spec page.test.mjs mesh.test.mjs
if [[ -n ${SITE-} ]]; then
    node --test --test-reporter=spec site.test.mjs
fi
if command -v pdftoppm > /dev/null; then
    pdftoppm -r 70 -png out/audit.pdf out/printed
fi
