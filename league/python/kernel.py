"""Ray-triangle tests of PyPI as kernels for hairline (docs/protocol.md): `python kernel.py NAME`.

Each is a function of a batch, an array of 17 numbers a case, that gives one truth value a case. A library that takes
meshes gets a mesh of one triangle for each case.
"""

import os
import sys

import numpy

PROMISE = "extent=ray,sides=both,boundary=free,ends=free,coplanar=free,degenerate=free"
FACE = [[0, 1, 2]]


def embreex():
    from embreex.mesh_construction import TriangleMesh
    from embreex.rtcore_scene import EmbreeScene

    def hits(cases):
        cases = cases.astype(numpy.float32)
        for case in cases:
            scene = EmbreeScene()
            TriangleMesh(scene, case[6:15].reshape(1, 3, 3).copy())
            yield scene.run(case[None, 0:3].copy(), case[None, 3:6].copy())[0] == 0

    return hits, "f32", PROMISE


def libigl():
    import igl

    faces = numpy.array(FACE)

    def hits(cases):
        for case in cases:
            yield len(igl.ray_mesh_intersect(case[0:3], case[3:6], case[6:15].reshape(3, 3), faces)) > 0

    return hits, "f64", PROMISE


def cgal():
    from CGAL.CGAL_Kernel import Point_3, Ray_3, Triangle_3, Vector_3, do_intersect

    def hits(cases):
        for case in cases.tolist():
            points = [Point_3(*case[i : i + 3]) for i in (0, 6, 9, 12)]
            yield do_intersect(Ray_3(points[0], Vector_3(*case[3:6])), Triangle_3(*points[1:]))

    return hits, "f64", PROMISE.replace("boundary=free,ends=free", "boundary=closed,ends=closed")


def pyraymesh():
    from pyraymesh import Mesh

    def hits(cases):
        for case in cases:
            mesh = Mesh(case[6:15].reshape(3, 3), numpy.array(FACE))
            mesh.build("medium")
            yield mesh.occlusion(case[None, 0:3], case[None, 3:6])[0]

    return hits, "f32", PROMISE


def meshlib():
    from meshlib import mrmeshnumpy, mrmeshpy

    faces = numpy.array(FACE, dtype=numpy.int32)

    def hits(cases):
        for case in cases:
            mesh = mrmeshnumpy.meshFromFacesVerts(faces, case[6:15].reshape(3, 3))
            [o, d] = [mrmeshpy.Vector3f(*case[i : i + 3].tolist()) for i in (0, 3)]
            yield bool(mrmeshpy.rayMeshIntersect(mrmeshpy.MeshPart(mesh), mrmeshpy.Line3f(o, d)))

    return hits, "f32", PROMISE


def mitsuba():
    import mitsuba as mi

    mi.set_variant("scalar_rgb")
    import drjit

    def hits(cases):
        # One mesh: its triangles are tested one by one, without an acceleration structure.
        mesh = mi.Mesh("cases", 3 * len(cases), len(cases))
        parameters = mi.traverse(mesh)
        parameters["vertex_positions"] = cases[:, 6:15].astype(numpy.float32).ravel()
        parameters["faces"] = numpy.arange(3 * len(cases), dtype=numpy.uint32)
        parameters.update()
        for i, case in enumerate(cases.tolist()):
            ray = mi.Ray3f(mi.Point3f(case[0:3]), mi.Vector3f(case[3:6]))
            yield mesh.ray_intersect_triangle(i, ray).t < drjit.inf

    return hits, "f32", PROMISE


def warp():
    import warp as wp

    wp.config.quiet = True
    wp.init()

    @wp.kernel
    def test(
        meshes: wp.array(dtype=wp.uint64),
        origins: wp.array(dtype=wp.vec3),
        directions: wp.array(dtype=wp.vec3),
        results: wp.array(dtype=wp.int32),
    ):
        i = wp.tid()
        query = wp.mesh_query_ray(meshes[i], origins[i], directions[i], wp.inf)
        if query.result:
            results[i] = 1

    def array(values, dtype):
        return wp.array(numpy.ascontiguousarray(values), dtype=dtype, device="cpu")

    def hits(cases):
        cases = cases.astype(numpy.float32)
        indices = array(numpy.arange(3, dtype=numpy.int32), wp.int32)
        meshes = [wp.Mesh(array(case[6:15].reshape(3, 3), wp.vec3), indices) for case in cases]
        ids = array(numpy.array([mesh.id for mesh in meshes], dtype=numpy.uint64), wp.uint64)
        results = wp.zeros(len(cases), dtype=wp.int32, device="cpu")
        inputs = [ids, array(cases[:, 0:3], wp.vec3), array(cases[:, 3:6], wp.vec3), results]
        wp.launch(test, dim=len(cases), inputs=inputs, device="cpu")
        return results.numpy() == 1

    return hits, "f32", PROMISE


def gpytoolbox():
    from gpytoolbox import ray_triangle_intersect

    def hits(cases):
        for case in cases:
            origin, direction, *triangle = case[0:15].reshape(5, 3)
            yield ray_triangle_intersect(origin, direction, *triangle)[1]

    return hits, "f64", PROMISE


def compas():
    from compas.geometry import intersection_line_triangle

    def hits(cases):
        for case in cases.tolist():
            origin, *triangle = [case[i : i + 3] for i in (0, 6, 9, 12)]
            beyond = [x + y for x, y in zip(origin, case[3:6])]
            # A division by a rounded 0, or a square that overflows, gives no point.
            try:
                yield intersection_line_triangle([origin, beyond], triangle) is not None
            except ArithmeticError:
                yield False

    # A line, and a documented tolerance about the product of direction and normal.
    return hits, "f64", PROMISE.replace("extent=ray", "extent=line") + ",determinant=1e-9"


def panda3d():
    from panda3d.core import (
        CollisionHandlerQueue,
        CollisionNode,
        CollisionPolygon,
        CollisionRay,
        CollisionTraverser,
        NodePath,
        Point3,
    )

    root, ray, from_node, into_node = NodePath(""), CollisionRay(), CollisionNode(""), CollisionNode("")
    from_node.setIntoCollideMask(0)
    from_node.addSolid(ray)
    root.attachNewNode(into_node)
    traverser, queue = CollisionTraverser(), CollisionHandlerQueue()
    traverser.addCollider(root.attachNewNode(from_node), queue)

    def hits(cases):
        for case in cases.tolist():
            triangle = [Point3(*case[i : i + 3]) for i in (6, 9, 12)]
            ray.setOrigin(*case[0:3])
            ray.setDirection(*case[3:6])
            into_node.clearSolids()
            into_node.addSolid(CollisionPolygon(*triangle))
            traverser.traverse(root)
            yield queue.getNumEntries() > 0

    return hits, "f32", PROMISE


KERNELS = [embreex, libigl, cgal, pyraymesh, meshlib, mitsuba, warp, gpytoolbox, compas, panda3d]


def main():
    known = {kernel.__name__: kernel for kernel in KERNELS}
    if len(sys.argv) != 2 or sys.argv[1] not in known:
        sys.exit(f"usage: kernel.py {'|'.join(known)}")
    name = sys.argv[1]
    # What libraries print belongs to people: it goes to standard error.
    verdicts = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    hits, scalar, contract = known[name]()
    print(f"hairline-kernel 1\nname {name}\nscalars {scalar}\ncontract {contract}\nready", file=verdicts, flush=True)
    ids, cases = [], []

    def flush():
        if cases:
            for case, hit in zip(ids, hits(numpy.array(cases)), strict=True):
                print(case, "hit" if hit else "miss", file=verdicts)
        ids.clear()
        cases.clear()

    for line in sys.stdin:
        words = line.split()
        if words[0] == "case":
            ids.append(words[1])
            cases.append([float(word) for word in words[3:]])
            if len(ids) == 4096:  # a filter gets everything before the end
                flush()
        elif words[0] == "end":
            flush()
            print(line, end="", file=verdicts, flush=True)


if __name__ == "__main__":
    main()
