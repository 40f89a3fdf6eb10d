#!/usr/bin/env bash
# Gets three from npm, then audits it. Arguments go to `hairline audit`.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
npm ci --no-audit --no-fund
# three.js promises something for unit directions only.
$hairline audit --kernel-cmd 'node three.mjs' --direction unit "$@"
