#!/usr/bin/env bash
# Builds the kernel, then audits it beside the same algorithm in other arithmetics. Arguments go to
# `hairline audit`. On Debian `apt-get install mesa-vulkan-drivers` has a Vulkan driver in software.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
cargo build --quiet --locked
$hairline audit --kernel-cmd target/debug/hairline-gpu-example --kernel moller-trumbore \
    --arithmetic ieee,fma,ftz,fma-ftz,rearranged,fma-ftz-rearranged --scalar f32 "$@"
