#!/usr/bin/env bash
# Builds both of Embree's scene modes (libembree-dev of Debian 12) and audits them. Arguments go to
# `hairline audit`. Debian's build checks its rays with assert: NaN and infinite ones are crashes.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
for robust in 0 1; do
    c++ -O2 -ffp-contract=off -shared -fPIC -DROBUST=$robust -I../../include \
        -o libembree$robust.so embree.cpp -lembree3
done
$hairline audit --kernel-lib ./libembree0.so --kernel-lib ./libembree1.so "$@"
