//! Entrants that are built elsewhere: crates whose dependencies are many, in heavy/, and those of other
//! languages, each in a process of its own.

use crate::{ENTRANT, Entrant, Run};

/// A kernel of javascript/kernel.mjs, with its package.
macro_rules! node {
    ($kernel:literal, $package:literal) => {
        Run::Process {
            arguments: &[
                "--kernel-cmd",
                concat!("node league/javascript/kernel.mjs ", $kernel),
            ],
            needs: concat!("league/javascript/node_modules/", $package),
        }
    };
}

/// A program in Python with its arguments, and its package.
macro_rules! python {
    ($program:literal, $package:literal) => {
        Run::Process {
            arguments: &[
                "--kernel-timeout",
                "300",
                "--kernel-cmd",
                concat!("league/python/venv/bin/python ", $program),
            ],
            needs: concat!("league/python/venv/installed/", $package),
        }
    };
}

/// A plug-in of examples/embree: 0 without scene flags, 1 robust.
macro_rules! embree {
    ($robust:literal) => {
        Run::Process {
            arguments: &[
                "--kernel-lib",
                concat!("examples/embree/libembree", $robust, ".so"),
            ],
            needs: concat!("examples/embree/libembree", $robust, ".so"),
        }
    };
}

pub const ENTRANTS: &[Entrant] = &[
    Entrant {
        name: "bevy_picking",
        package: "bevy_picking",
        version: "0.20.1",
        function: "bevy_picking::mesh_picking::ray_cast::ray_mesh_intersection, Backfaces::Include",
        claim: &[
            "Checks if a ray intersects a mesh, and returns the nearest intersection if one exists.",
        ],
        page: "https://docs.rs/bevy_picking/0.20.1/bevy_picking/mesh_picking/ray_cast/fn.ray_mesh_intersection.html",
        note: "A mesh of one triangle. Ray3d's direction is a Dir3, \"a normalized vector pointing in a \
            direction\"; the function normalizes it again, which is charged to it.",
        unit: true,
        findings: &["bevy_picking.md"],
        ..ENTRANT
    },
    Entrant {
        name: "truck-meshalgo",
        package: "truck-meshalgo",
        version: "0.4.0",
        function: "truck_meshalgo::analyzers::IncludingPointInDomain::signed_crossing_faces, not 0",
        claim: &[
            "Count signed number of faces crossing ray with origin `point` and direction `ray_direction`.",
        ],
        page: "https://docs.rs/truck-meshalgo/0.4.0/truck_meshalgo/analyzers/trait.IncludingPointInDomain.html",
        note: "A mesh of one triangle.",
        findings: &["truck-meshalgo.md"],
        ..ENTRANT
    },
    Entrant {
        name: "oxiphysics-geometry",
        package: "oxiphysics-geometry",
        version: "0.1.2",
        function: "oxiphysics_geometry::boolean_ops::ray_triangle_intersect",
        claim: &[
            "Returns the parametric distance `t` along the ray if the ray intersects the triangle from \
                the front, or `None` otherwise.",
        ],
        page: "https://docs.rs/oxiphysics-geometry/0.1.2/oxiphysics_geometry/boolean_ops/functions/fn.ray_triangle_intersect.html",
        findings: &["oxiphysics-geometry.md"],
        ..ENTRANT
    },
    Entrant {
        name: "embree-fast",
        package: "libembree3",
        version: "3.13.5",
        function: "rtcIntersect1, no scene flags",
        page: "https://github.com/RenderKit/embree/blob/v3.13.5/doc/src/api.md",
        note: "A scene of one triangle (examples/embree). Nothing is promised about edges or numbers.",
        run: embree!("0"),
        skip: EMBREE,
        ..ENTRANT
    },
    Entrant {
        name: "embree-robust",
        package: "libembree3",
        version: "3.13.5",
        function: "rtcIntersect1, RTC_SCENE_FLAG_ROBUST",
        claim: &[
            "avoids optimizations that reduce arithmetic accuracy",
            "This mode is typically used for avoiding artifacts caused by rays shooting through edges of \
                neighboring primitives.",
        ],
        only_shared: true,
        page: "https://github.com/RenderKit/embree/blob/v3.13.5/doc/src/api.md",
        note: "A scene of one triangle (examples/embree). Taken to mean that of triangles that share an \
            edge at least one is hit.",
        run: embree!("1"),
        skip: EMBREE,
        ..ENTRANT
    },
    Entrant {
        name: "three-js",
        package: "three",
        version: "0.187.0",
        function: "Ray.intersectTriangle(a, b, c, false, target)",
        claim: &[
            "Intersects this ray with the given triangle, returning the intersection point or \
        `null` if there is no intersection.",
            "the shear makes a shared edge evaluate identically for both adjacent triangles, so \
        the ray can never fall between them",
        ],
        page: "https://threejs.org/docs/#Ray.intersectTriangle",
        note: "The second sentence is a comment in the source. The direction is documented as \
        normalized.",
        run: node!("three-js", "three"),
        unit: true,
        ..ENTRANT
    },
    Entrant {
        name: "three-mesh-bvh",
        package: "three-mesh-bvh",
        version: "0.9.17",
        function: "MeshBVH.raycastFirst(ray, DoubleSide)",
        claim: &["Returns the first raycast hit in the model."],
        page: "https://github.com/gkjohnson/three-mesh-bvh/blob/v0.9.17/API.md",
        note: "A mesh of one triangle, in a Float32Array. The ray is three.js' own, whose direction \
        is normalized.",
        run: node!("three-mesh-bvh", "three-mesh-bvh"),
        unit: true,
        ..ENTRANT
    },
    Entrant {
        name: "babylon",
        package: "@babylonjs/core",
        version: "9.34.0",
        function: "Ray.intersectsTriangle",
        claim: &[
            "If the ray hits a triange",
            "The epsilon value to use when calculating the ray/triangle intersection (default: Epsilon \
                from math constants)",
            "export let Epsilon = 0.001;",
        ],
        page: "https://doc.babylonjs.com/typedoc/classes/BABYLON.Ray#intersectstriangle",
        note: "The first as it stands there, with \"@returns intersection information if hit\"; the \
            second is of the constructor. The epsilon is a tolerance in weights: at a corner of the \
            triangle it reaches two thousandths of an edge, and so far nothing is promised.",
        run: node!("babylon", "@babylonjs/core"),
        ..ENTRANT
    },
    Entrant {
        name: "cesium",
        package: "@cesium/engine",
        version: "26.3.0",
        function: "IntersectionTests.rayTriangle(ray, p0, p1, p2)",
        claim: &[
            "Computes the intersection of a ray and a triangle as a Cartesian3 coordinate.",
            "The intersection point or undefined if there is no intersections.",
        ],
        page: "https://cesium.com/learn/cesiumjs/ref-doc/IntersectionTests.html#.rayTriangle",
        note: "It gets unit directions, because `Ray`'s constructor normalizes. No tolerance is documented.",
        run: node!("cesium", "@cesium/engine"),
        unit: true,
        findings: &["cesium.md"],
        ..ENTRANT
    },
    Entrant {
        name: "playcanvas",
        package: "playcanvas",
        version: "2.23.3",
        function: "Tri.intersectsRay(ray)",
        claim: &["Test if a ray intersects with the triangle."],
        page: "https://api.playcanvas.com/engine/classes/Tri.html#intersectsray",
        note: "The direction has to be normalized.",
        run: node!("playcanvas", "playcanvas"),
        unit: true,
        ..ENTRANT
    },
    Entrant {
        name: "ray-triangle-intersection",
        package: "ray-triangle-intersection",
        version: "1.0.3",
        function: "intersectTriangle(out, pt, dir, tri)",
        claim: &["intersect a ray and triangle in 3 dimensions"],
        page: "https://www.npmjs.com/package/ray-triangle-intersection/v/1.0.3",
        note: "In the source back faces are a miss.",
        run: node!("ray-triangle-intersection", "ray-triangle-intersection"),
        findings: &["ray-triangle-intersection.md"],
        ..ENTRANT
    },
    Entrant {
        name: "claygl",
        package: "claygl",
        version: "1.3.0",
        function: "Ray.intersectTriangle(a, b, c, false)",
        claim: &["Calculate intersection point between ray and three triangle vertices"],
        page: "https://www.npmjs.com/package/claygl/v/1.3.0",
        note: "Its vectors are Float32Arrays.",
        run: node!("claygl", "claygl"),
        ..ENTRANT
    },
    Entrant {
        name: "yuka",
        package: "yuka",
        version: "0.7.8",
        function: "Ray.intersectTriangle(triangle, false, result)",
        claim: &[
            "Performs a ray/triangle intersection test and stores the intersection point to the \
        given 3D vector. If no intersection is detected, *null* is returned.",
        ],
        page: "https://mugen87.github.io/yuka/docs/Ray.html#intersectTriangle",
        run: node!("yuka", "yuka"),
        ..ENTRANT
    },
    Entrant {
        name: "ogl",
        package: "ogl",
        version: "1.0.11",
        function: "Raycast.intersectTriangle(a, b, c, false, origin, direction), not 0",
        page: "https://www.npmjs.com/package/ogl/v/1.0.11",
        note: "Not documented.",
        run: node!("ogl", "ogl"),
        ..ENTRANT
    },
    Entrant {
        name: "trimesh",
        package: "trimesh",
        version: "5.2.0",
        function: "trimesh.ray.ray_triangle.ray_triangle_id",
        claim: &[
            "Find the intersections between a group of triangles and rays",
            "tol.zero : float Floating point numbers smaller than this are considered zero",
            "the resolution of float64 which works out to 1e-13",
        ],
        page: "https://trimesh.org/trimesh.ray.ray_triangle.html",
        note: "With a tree that proposes one triangle for each ray \
            (examples/python/trimesh_kernel.py). tol.zero is documented in trimesh.constants and is, by \
            https://github.com/mikedh/trimesh/issues/331, its tolerance in weights: 1e-13, twice that at \
            a corner. Its tolerances of t and of the angle are not documented.",
        run: python!("examples/python/trimesh_kernel.py", "trimesh"),
        findings: &["trimesh.md"],
        ..ENTRANT
    },
    Entrant {
        name: "embreex",
        package: "embreex",
        version: "4.4.0.post1",
        function: "EmbreeScene.run, a binding of Embree 4.4",
        page: "https://github.com/trimesh/embreex",
        note: "A scene of one triangle, no flags. Nothing is promised about edges or numbers.",
        run: python!("league/python/kernel.py embreex", "embreex"),
        ..ENTRANT
    },
    Entrant {
        name: "libigl",
        package: "libigl",
        version: "2.6.3",
        function: "igl.ray_mesh_intersect",
        claim: &["Shoot a ray against a mesh (V, F) and collect hits."],
        page: "https://libigl.github.io/libigl-python-bindings/",
        note: "A mesh of one triangle.",
        run: python!("league/python/kernel.py libigl", "libigl"),
        ..ENTRANT
    },
    Entrant {
        name: "cgal",
        package: "cgal",
        version: "6.0.1",
        function: "CGAL_Kernel.do_intersect(Ray_3, Triangle_3), EPICK",
        claim: &[
            "Two objects obj1 and obj2 intersect if there is a point p that is part of both obj1 \
        and obj2.",
            "Note that for objects like triangles and polygons that enclose a bounded region, \
        this region is part of the object.",
        ],
        page: "https://doc.cgal.org/6.0.1/Kernel_23/group__do__intersect__linear__grp.html",
        note: "So edges, vertices and t = 0 are hits. The binding's Ray_3(point, vector) keeps a \
        second point, point + vector, which is rounded: what that moves is charged to it.",
        run: python!("league/python/kernel.py cgal", "cgal"),
        skip: &["direction-length"],
        ..ENTRANT
    },
    Entrant {
        name: "gpytoolbox",
        package: "gpytoolbox",
        version: "0.3.8",
        function: "gpytoolbox.ray_triangle_intersect",
        claim: &[
            "Find if and where a straight line intersects a triangle in 3D",
            "Whether the ray ever hits the triangle",
            "Uses the Möller–Trumbore ray-triangle intersection algorithm.",
        ],
        page: "https://gpytoolbox.org/0.3.0/ray_triangle_intersect/",
        note: "With return_negative=False, as it is by default. No tolerance is documented.",
        run: python!("league/python/kernel.py gpytoolbox", "gpytoolbox"),
        findings: &["gpytoolbox.md"],
        ..ENTRANT
    },
    Entrant {
        name: "compas",
        package: "compas",
        version: "2.15.1",
        function: "compas.geometry.intersection_line_triangle",
        claim: &[
            "Computes the intersection point of a line (ray) and a triangle based on the Moeller Trumbore \
                intersection algorithm",
            "The intersection point between the line and the triangle, or None if the line and the plane \
                are parallel.",
            "Tolerance for evaluating that the dot product of the line direction and the plane normal is \
                zero.",
            "ABSOLUTE = 1e-9",
        ],
        page: "https://compas.dev/compas/latest/api/generated/compas.geometry.intersection_line_triangle.html",
        note: "A line: any t. It takes two points, the second of which is origin + direction, rounded: \
            what that moves is charged to it. The third sentence is of intersection_line_plane, to which \
            it hands its tolerance: below 1e-9, of the normal as it is, no hit is owed.",
        run: python!("league/python/kernel.py compas", "compas"),
        skip: &["direction-length"],
        findings: &["compas.md"],
        ..ENTRANT
    },
    Entrant {
        name: "panda3d",
        package: "panda3d",
        version: "1.10.16",
        function: "CollisionTraverser.traverse, a CollisionRay into a CollisionPolygon",
        claim: &[
            "An infinite ray, with a specific origin and direction. It begins at its origin and continues \
                in one direction to infinity, and it has no radius.",
        ],
        page: "https://docs.panda3d.org/1.10/python/reference/panda3d.core.CollisionRay",
        note: "A node with one polygon. No tolerance is documented.",
        run: python!("league/python/kernel.py panda3d", "panda3d"),
        findings: &["panda3d.md"],
        ..ENTRANT
    },
    Entrant {
        name: "pyraymesh",
        package: "pyraymesh",
        version: "0.2.6",
        function: "Mesh.occlusion, a binding of madmann91/bvh",
        claim: &[
            "Checks for occlusion along the rays with the BVH (Bounding Volume Hierarchy) of the \
        mesh.",
        ],
        page: "https://pypi.org/project/pyraymesh/0.2.6/",
        note: "A mesh of one triangle.",
        run: python!("league/python/kernel.py pyraymesh", "pyraymesh"),
        ..ENTRANT
    },
    Entrant {
        name: "meshlib",
        package: "meshlib",
        version: "3.1.4",
        function: "mrmeshpy.rayMeshIntersect with a Line3f",
        claim: &["Finds ray and mesh intersection in float-precision."],
        page: "https://meshlib.io/documentation/group__AABBTreeGroup.html",
        note: "A mesh of one triangle.",
        run: python!("league/python/kernel.py meshlib", "meshlib"),
        ..ENTRANT
    },
    Entrant {
        name: "mitsuba",
        package: "mitsuba",
        version: "3.9.1",
        function: "Mesh.ray_intersect_triangle, scalar_rgb",
        page: "https://mitsuba.readthedocs.io/en/v3.9.1/src/api_reference.html#mitsuba.Mesh.ray_intersect_triangle",
        note: "Its signature is all that the reference has.",
        run: python!("league/python/kernel.py mitsuba", "mitsuba"),
        ..ENTRANT
    },
    Entrant {
        name: "warp",
        package: "warp-lang",
        version: "1.19.0",
        function: "warp.mesh_query_ray on the processor",
        claim: &[
            "Compute the closest ray hit on the :class:`warp.Mesh` with identifier ``id``.",
            "``dir`` need not be normalized",
        ],
        page: "https://nvidia.github.io/warp/",
        note: "A mesh of one triangle.",
        run: python!("league/python/kernel.py warp", "warp-lang"),
        ..ENTRANT
    },
];

/// Debian's build ends the process (assert) on coordinates beyond 1.8e18.
const EMBREE: &[&str] = &["range-ends"];
