#!/usr/bin/env python3
"""libigl's nearest hits (PyPI libigl, numpy) for `hairline rays`; with a third word, aabb (its tree) or all (every face).

    python3 libigl_answers.py model.obj rays.csv > answers.csv
"""

import sys

import igl
import numpy

vertices, faces = igl.readOBJ(sys.argv[1])[0:4:3]
rays = numpy.loadtxt(sys.argv[2], delimiter=",", skiprows=1, ndmin=2)
if sys.argv[3:] == ["all"]:
    for ray in rays:
        hits = igl.ray_mesh_intersect(ray[0:3].copy(), ray[3:6].copy(), vertices, faces)
        print(f"{hits[0][0]},{hits[0][1]}" if hits else -1)
else:
    tree = igl.AABB()
    tree.init(vertices, faces)
    hits = tree.intersect_ray_first(vertices, faces, rays[:, 0:3].copy(), rays[:, 3:6].copy())
    for face, t in zip(*hits[0:2]):
        print(f"{face},{t}")
