#!/usr/bin/env python3
"""The verdicts of a kernel that ran elsewhere (on a device, in a game), as a kernel for hairline (docs/protocol.md).

    hairline generate --family edge-near,tiny --scalar f64 -o cases.txt
    python3 moller_trumbore.py < cases.txt > verdicts.txt        # your kernel, wherever it runs
    hairline audit --kernel-cmd 'python3 replay.py cases.txt verdicts.txt' --family edge-near,tiny --scalar f64
"""

import sys

with open(sys.argv[1]) as file:
    cases = file.read().splitlines()
with open(sys.argv[2]) as file:
    verdicts = file.read().splitlines()
start = verdicts.index("ready") + 1
hello, verdicts = verdicts[:start], verdicts[start:]
known = {}
for case, verdict in zip(cases, verdicts, strict=True):
    kind, name, *numbers = case.split(" ", 2)
    answered, answer = verdict.split(" ", 1)
    if answered != (name if kind == "case" else "end"):
        sys.exit(f"replay.py: found the verdict on {answered}, expected that on {name}")
    if kind == "case":
        known[numbers[0]] = answer
# The verdicts are there already: no epsilon changes them.
print(*(line for line in hello if not line.startswith("epsilon ")), sep="\n", flush=True)
for line in sys.stdin:
    kind, name, *numbers = line.rstrip().split(" ", 2)
    if kind == "case":
        print(name, known.get(numbers[0], "has no verdict"))
    elif kind == "end":
        print(line, end="", flush=True)
