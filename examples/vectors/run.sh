#!/usr/bin/env bash
# Runs every reader whose language is installed on the core set, and verifies its results. Möller and Trumbore's
# test is wrong on some of them, so `hairline verify` may end with 1; with anything else this script fails.
set -euo pipefail
cd "$(dirname "$0")"
hairline=${HAIRLINE:-cargo run --quiet --release --manifest-path ../../Cargo.toml --}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

run() { # name, needed command, then the reader's command
    local name=$1 needs=$2
    shift 2
    if ! command -v "$needs" > /dev/null; then
        echo "no $needs: the reader in $name was not run"
        return
    fi
    "$@" ../../vectors "$work/$name.json"
    $hairline verify "$work/$name.json" > "$work/report" || [ $? -eq 1 ]
    head -n 1 "$work/report"
}

build() { # needed command, then the compiler's command
    if command -v "$1" > /dev/null; then "$@"; fi
}

build cc -O2 -ffp-contract=off -o "$work/c" reader.c
build c++ -x c++ -O2 -ffp-contract=off -o "$work/cpp" reader.c
build rustc -O -o "$work/rust" reader.rs
run c cc "$work/c"
run cpp c++ "$work/cpp"
run rust rustc "$work/rust"
run python python3 python3 reader.py
run javascript node node reader.mjs
run java java java Reader.java
run go go go run reader.go
build mcs -nologo -out:"$work/reader.exe" Reader.cs
run csharp mono mono "$work/reader.exe"

# The same arithmetic gives the same answers in every language.
same() {
    local first
    for name in "$@"; do
        [ -e "$work/$name.json" ] || continue
        tr -d ' \n' < "$work/$name.json" | sed 's/.*"results"://' > "$work/$name.answers"
        first=${first:-$name}
        cmp "$work/$first.answers" "$work/$name.answers"
    done
}
same c cpp rust
same python javascript java go csharp
