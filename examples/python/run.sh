#!/usr/bin/env bash
# As a kernel that hairline starts, with and without numpy, and as a filter. Arguments go to `hairline audit`.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
$hairline audit --kernel-cmd 'python3 moller_trumbore.py' "$@"
# Columns of numpy, over the binary encoding.
if python3 -c 'import numpy' 2>/dev/null; then
    $hairline audit --kernel-cmd 'python3 numpy_kernel.py' "$@"
fi
# judge says 1 where verdicts break the contract, as some of this kernel's do.
$hairline generate --family edge-near,tiny -n 2000 --scalar f64 |
    python3 moller_trumbore.py | $hairline judge || [ $? = 1 ]
