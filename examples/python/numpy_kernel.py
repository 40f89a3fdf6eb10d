#!/usr/bin/env python3
"""Moller and Trumbore's test on numpy's columns, over hairline's binary encoding (docs/protocol.md): some thirty
times as fast as the text of moller_trumbore.py.

    hairline audit --kernel-cmd 'python3 numpy_kernel.py'
"""

import struct
import sys
import time

import numpy

HELLO = f"""hairline-kernel 1
name numpy-moller-trumbore
source Moller and Trumbore (1997) on columns of numpy {numpy.__version__}
scalars f32 f64
contract extent=ray,sides=both,boundary=closed
gives t uv
epsilon parallel 1e-9 2 1 non-negative abs(det) < e
encoding binary
ready
"""


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def test(columns, epsilon):
    """Which cases are hits, and t, u, v of all. Columns: origin, direction, a, b, c, t_min, t_max."""
    o, d, a, b, c = (columns[i : i + 3] for i in range(0, 15, 3))
    edge1, edge2 = b - a, c - a
    p = cross(d, edge2)
    det = dot(edge1, p)
    s = o - a
    q = cross(s, edge1)
    u, v, t = dot(s, p) / det, dot(d, q) / det, dot(edge2, q) / det
    return (abs(det) >= epsilon) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0), t, u, v


def read(source, size):
    """Exactly so many bytes; none at the end of the input."""
    data = source.read(size)
    if 0 < len(data) < size:
        sys.exit("the input ends within a batch")
    return data


def main():
    source, sink = sys.stdin.buffer, sys.stdout.buffer
    sink.write(HELLO.encode())
    sink.flush()
    while head := read(source, 16):
        _, bits, count, epsilons = struct.unpack("<4s3I", head)
        number = numpy.dtype(f"<f{bits // 8}")
        epsilon = numpy.frombuffer(read(source, epsilons * number.itemsize), number)[0]
        cases = numpy.frombuffer(read(source, count * 17 * number.itemsize), number)
        columns = numpy.ascontiguousarray(cases.reshape(count, 17).T)
        start = time.perf_counter_ns()
        with numpy.errstate(all="ignore"):
            hit, t, u, v = test(columns, epsilon)
        took = min(time.perf_counter_ns() - start, 2**32 - 1)
        fields = [("hit", "<i4"), ("facing", "<i4"), ("t", number), ("u", number), ("v", number)]
        answer = numpy.zeros(count, fields)
        answer["hit"], answer["t"], answer["u"], answer["v"] = hit, t, u, v
        sink.write(struct.pack("<4sI4sI", b"HLT1", took, b"HLA1", count) + answer.tobytes())
        sink.flush()


if __name__ == "__main__":
    main()
