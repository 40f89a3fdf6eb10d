#!/usr/bin/env python3
"""Microseconds a ray of Embree (PyPI embreex), robust, the least of three runs: `python embree_time.py MESH.obj RAYS.csv`."""

import sys
import time

import numpy
import trimesh
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

mesh = trimesh.load_mesh(sys.argv[1], process=False)
rays = numpy.loadtxt(sys.argv[2], delimiter=",", skiprows=1, dtype=numpy.float32)
origins, directions = rays[:, 0:3].copy(), rays[:, 3:6].copy()
scene = EmbreeScene(robust=True)
TriangleMesh(scene, mesh.triangles.astype(numpy.float32))
scene.run(origins[:1], directions[:1])  # builds the tree
took = []
for _ in range(3):
    start = time.perf_counter()
    scene.run(origins, directions, output=True)
    took.append(time.perf_counter() - start)
print(f"{min(took) * 1e6 / len(rays):.3f}")
