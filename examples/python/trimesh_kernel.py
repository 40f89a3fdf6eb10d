#!/usr/bin/env python3
"""trimesh's ray_triangle_id (PyPI trimesh, numpy) as a kernel for hairline (docs/protocol.md).

    hairline audit --kernel-cmd 'python3 trimesh_kernel.py'

ray_triangle_id tests many triangles against many rays, those that an r-tree proposes. Here the tree is
one that proposes triangle i for ray i, so that each ray meets its own triangle and nothing is lost on
the way. The normals are trimesh.triangles.normals', as ray_triangle_id itself takes them if it is given
none; triangles for which there are none ("not ok") are missed. Weights have a documented tolerance, tol.zero = 1e-13:
at a corner twice that of an edge.
"""

import sys

import numpy
import trimesh
from trimesh.ray.ray_triangle import ray_triangle_id

HELLO = f"""hairline-kernel 1
name trimesh
source trimesh {trimesh.__version__}, ray.ray_triangle.ray_triangle_id
scalars f64
contract extent=ray,sides=both,boundary=free,ends=free,coplanar=free,degenerate=free,invalid=free,band=2e-13
ready"""


class Pairs:
    """In place of an r-tree: proposes triangle 0 when first asked, then 1, and so on."""

    def __init__(self, triangles):
        corners = triangles.reshape((-1, 3))
        self.bounds = numpy.concatenate((corners.min(axis=0), corners.max(axis=0)))
        self.asked = 0

    def intersection(self, _bounds):
        self.asked += 1
        return [self.asked - 1]


def answer_all(cases):
    """Whether each ray hits its triangle."""
    with numpy.errstate(all="ignore"):
        table = numpy.array(cases, dtype=numpy.float64)
        origins, directions = table[:, 0:3], table[:, 3:6]
        triangles = table[:, 6:15].reshape((-1, 3, 3))
        hit = numpy.zeros(len(table), dtype=bool)
        # Numbers that are not finite, about which nothing is promised, stay away from the others.
        normals, valid = trimesh.triangles.normals(triangles)
        chosen = numpy.flatnonzero(valid)
        if len(chosen) == 0:
            return hit.tolist()
        of_valid = triangles[chosen]
        _, ray, _ = ray_triangle_id(
            triangles=of_valid,
            ray_origins=origins[chosen],
            ray_directions=directions[chosen],
            triangles_normal=normals,
            tree=Pairs(of_valid),
        )
        hit[chosen[ray]] = True
        return hit.tolist()


def main():
    print(HELLO, flush=True)
    ids, cases = [], []

    def flush():
        for name, hit in zip(ids, answer_all(cases) if cases else []):
            print(name, "hit" if hit else "miss")
        ids.clear()
        cases.clear()

    for line in sys.stdin:
        words = line.split()
        if words[0] == "case":
            ids.append(words[1])
            cases.append([float(word) for word in words[3:]])
            if len(ids) == 4096:  # a file has everything before the end
                flush()
        elif words[0] == "end":
            flush()
            print(line, end="", flush=True)


if __name__ == "__main__":
    main()
