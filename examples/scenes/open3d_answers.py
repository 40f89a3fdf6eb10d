#!/usr/bin/env python3
"""Open3D's nearest hits (PyPI open3d; RaycastingScene, which is Embree inside) for `hairline rays`.

    python3 open3d_answers.py model.obj rays.csv > answers.csv
"""

import sys

import numpy
import open3d
import trimesh

mesh = trimesh.load_mesh(sys.argv[1], process=False)  # as the file has it: no vertex merged, no face left out
rays = numpy.loadtxt(sys.argv[2], delimiter=",", skiprows=1, dtype=numpy.float32, ndmin=2)
scene = open3d.t.geometry.RaycastingScene()
scene.add_triangles(mesh.vertices.astype(numpy.float32), mesh.faces.astype(numpy.uint32))
hits = scene.cast_rays(open3d.core.Tensor(rays[:, 0:6].copy()))
faces = hits["primitive_ids"].numpy()
for face, t in zip(faces, hits["t_hit"].numpy()):
    print(f"{face},{t}" if face != scene.INVALID_ID else -1)
