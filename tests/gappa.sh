#!/usr/bin/env bash
# Gappa proves the scripts of `prove --format gappa` for gates on a box.
set -euo pipefail
cd "$(dirname "$0")/.."
if ! command -v gappa > /dev/null; then
    echo "skipped: there is no gappa here (apt-get install gappa)"
    exit 0
fi
cargo test --locked -p hairline-prove tests::gappa -- --nocapture
