#!/usr/bin/env bash
# As a kernel that hairline starts, with and without numpy, and with verdicts from a file. Arguments go to `hairline audit`.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
$hairline audit --kernel-cmd 'python3 moller_trumbore.py' "$@"
# Columns of numpy, over the binary encoding.
if python3 -c 'import numpy' 2>/dev/null; then
    $hairline audit --kernel-cmd 'python3 numpy_kernel.py' "$@"
fi
# As if the kernel ran on a device: cases go there in a file, and verdicts come back in one.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
flags=(--family edge-near,tiny -n 2000 --scalar f64)
$hairline generate "${flags[@]}" -o "$work/cases.txt"
python3 moller_trumbore.py < "$work/cases.txt" > "$work/verdicts.txt"
$hairline audit --kernel-cmd "python3 replay.py $work/cases.txt $work/verdicts.txt" "${flags[@]}"
