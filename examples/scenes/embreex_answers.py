#!/usr/bin/env python3
"""Embree's nearest hits (PyPI embreex, numpy, trimesh) for `hairline rays`; with a third word, robust or fast.

    python3 embreex_answers.py model.obj rays.csv > answers.csv
"""

import sys

import numpy
import trimesh
from embreex.mesh_construction import TriangleMesh
from embreex.rtcore_scene import EmbreeScene

mesh = trimesh.load_mesh(sys.argv[1], process=False)  # as the file has it: no vertex merged, no face left out
rays = numpy.loadtxt(sys.argv[2], delimiter=",", skiprows=1, dtype=numpy.float32, ndmin=2)
scene = EmbreeScene(robust=sys.argv[3:] != ["fast"])
TriangleMesh(scene, mesh.triangles.astype(numpy.float32))
hits = scene.run(rays[:, 0:3].copy(), rays[:, 3:6].copy(), output=True)
for face, t in zip(hits["primID"], hits["tfar"]):  # primID is -1 for a miss
    print(f"{face},{t}")
