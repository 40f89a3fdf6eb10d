#!/usr/bin/env python3
"""Moller and Trumbore's test as a kernel for hairline (docs/protocol.md), with numpy if it is there.

    hairline audit --kernel-cmd 'python3 moller_trumbore.py'
"""

import sys
import time

try:
    import numpy
except ImportError:
    numpy = None

EPSILON = 1e-9

HELLO = f"""hairline-kernel 1
name python-moller-trumbore
source Moller and Trumbore (1997) in Python, {"numpy " + numpy.__version__ if numpy else "without numpy"}
scalars f64
contract extent=ray,sides=both,boundary=closed
gives t uv
epsilon parallel {EPSILON} 2 1 non-negative abs(det) < e
ready"""


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def answer(numbers, epsilon):
    """The verdict on one case, without numpy."""
    o, d, a, b, c = (numbers[i : i + 3] for i in range(0, 15, 3))
    edge1 = [b[i] - a[i] for i in range(3)]
    edge2 = [c[i] - a[i] for i in range(3)]
    p = cross(d, edge2)
    det = dot(edge1, p)
    if abs(det) < epsilon or det == 0:
        return "miss"
    s = [o[i] - a[i] for i in range(3)]
    u = dot(s, p) / det
    q = cross(s, edge1)
    v = dot(d, q) / det
    t = dot(edge2, q) / det
    if u < 0 or v < 0 or u + v > 1 or t < 0:
        return "miss"
    return f"hit t={t!r} u={u!r} v={v!r}"


def answer_all(cases, epsilon):
    """The verdicts on a batch, as columns if there is numpy."""
    if numpy is None:
        return [answer(numbers, epsilon) for numbers in cases]
    with numpy.errstate(all="ignore"):
        table = numpy.array(cases)
        o, d, a, b, c = (table[:, i : i + 3] for i in range(0, 15, 3))
        edge1, edge2 = b - a, c - a
        p = numpy.cross(d, edge2)
        det = (edge1 * p).sum(axis=1)
        s = o - a
        u = (s * p).sum(axis=1) / det
        q = numpy.cross(s, edge1)
        v = (d * q).sum(axis=1) / det
        t = (edge2 * q).sum(axis=1) / det
        refused = (abs(det) < epsilon) | (det == 0) | (u < 0) | (v < 0) | (u + v > 1) | (t < 0)
    rows = zip(refused.tolist(), t.tolist(), u.tolist(), v.tolist())
    return ["miss" if no else f"hit t={t!r} u={u!r} v={v!r}" for no, t, u, v in rows]


def main():
    print(HELLO, flush=True)
    epsilon, ids, cases, took = EPSILON, [], [], 0

    def flush():
        nonlocal took
        start = time.perf_counter_ns()
        verdicts = answer_all(cases, epsilon) if cases else []
        took += time.perf_counter_ns() - start
        for name, verdict in zip(ids, verdicts):
            print(name, verdict)
        ids.clear()
        cases.clear()

    for line in sys.stdin:
        words = line.split()
        if words[0] == "case":
            ids.append(words[1])
            cases.append([float(word) for word in words[3:]])
            if len(ids) == 4096:  # a file has everything before the end
                flush()
        elif words[0] == "epsilons":
            epsilon = float(words[2])
        elif words[0] == "end":
            flush()
            print(line.rstrip(), f"took={took}", flush=True)
            took = 0


if __name__ == "__main__":
    main()
