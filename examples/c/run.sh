#!/usr/bin/env bash
# Builds the kernel with cc, then audits it. Arguments go to `hairline audit`.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
cc -O2 -ffp-contract=off -shared -fPIC -I../../include -o libmoller_trumbore.so moller_trumbore.c -lm
$hairline audit --kernel-lib ./libmoller_trumbore.so --kernel moller-trumbore "$@"
