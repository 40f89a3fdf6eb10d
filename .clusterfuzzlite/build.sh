#!/bin/bash
# Builds every fuzz target into $OUT, each with its seeds and its dictionary beside it.
#
# The base image calls it in the repository with SRC, OUT and SANITIZER set. `pinned` is left out: without
# an environment of its own it asks what `kernels` asks.
set -euo pipefail

sanitizer=${SANITIZER:-address}
cargo fuzz build --release --sanitizer "$sanitizer"
built=${CARGO_TARGET_DIR:-fuzz/target}/x86_64-unknown-linux-gnu/release

for target in $(cargo fuzz list); do
    [ "$target" != pinned ] || continue
    cp "$built/$target" "$OUT/"
    # Targets over text have seeds and a dictionary of their own, the others share those of cases.
    name=$target
    [ -d "fuzz/seeds/$target" ] || name=cases
    rm -f "$OUT/${target}_seed_corpus.zip"
    zip --quiet --junk-paths --recurse-paths "$OUT/${target}_seed_corpus.zip" "fuzz/seeds/$name"
    cp "fuzz/dictionaries/$name.dict" "$OUT/$target.dict"
    # Nothing that a target does takes a second; numbers of 2,000 bits need no gigabytes.
    printf '[libfuzzer]\nmax_len = 4096\ntimeout = 25\n' > "$OUT/$target.options"
done
