#!/usr/bin/env python3
"""trimesh's own nearest hits, without Embree (PyPI trimesh, rtree, scipy), for `hairline rays`.

    python3 trimesh_answers.py model.obj rays.csv > answers.csv
"""

import sys

import numpy
import trimesh
from trimesh.ray.ray_triangle import RayMeshIntersector

mesh = trimesh.load_mesh(sys.argv[1], process=False)  # as the file has it: no vertex merged, no face left out
rays = numpy.loadtxt(sys.argv[2], delimiter=",", skiprows=1, ndmin=2)
origins, directions = rays[:, 0:3], rays[:, 3:6]
hits = RayMeshIntersector(mesh).intersects_id(origins, directions, multiple_hits=False, return_locations=True)
answers = [(-1, 0.0)] * len(rays)
for face, ray, point in zip(*hits):
    d = directions[ray]
    answers[ray] = (face, (point - origins[ray]) @ d / (d @ d))
for face, t in answers:
    print(f"{face},{t}")
