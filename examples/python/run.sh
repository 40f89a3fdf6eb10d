#!/usr/bin/env bash
# Once as a kernel that hairline starts, once as a filter. Arguments go to `hairline audit`.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
$hairline audit --kernel-cmd 'python3 moller_trumbore.py' "$@"
# judge says 1 where verdicts break the contract, as some of this kernel's do.
$hairline generate --family edge-near,tiny -n 2000 --scalar f64 |
    python3 moller_trumbore.py | $hairline judge || [ $? = 1 ]
