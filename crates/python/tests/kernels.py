"""Kernels to test with. The same operations in the same order as examples/python/numpy_kernel.py, on rows."""

import numpy as np

def dot(a, b):
    return a[..., 0] * b[..., 0] + a[..., 1] * b[..., 1] + a[..., 2] * b[..., 2]


def moller_trumbore(origin, direction, a, b, c, t_min, t_max):
    epsilon = a.dtype.type(1e-9)
    ab, ac, start = b - a, c - a, origin - a
    p, q = np.cross(direction, ac), np.cross(start, ab)
    det = dot(ab, p)
    t, u, v = dot(ac, q) / det, dot(start, p) / det, dot(direction, q) / det
    hit = (abs(det) >= epsilon) & (u >= 0) & (v >= 0) & (u + v <= 1) & (t >= 0)
    return np.where(hit, t, np.nan), u, v


def one_by_one(origin, direction, a, b, c, t_min, t_max):
    t, u, v = moller_trumbore(origin, direction, a, b, c, t_min, t_max)
    return None if np.isnan(t) else (t, u, v)
