//! Entrants that are built elsewhere: crates whose dependencies are many, in heavy/, and those of other
//! languages, which go through hairline's plug-ins, in examples/.

use crate::Entrant;

pub const ENTRANTS: &[Entrant] = &[
    Entrant {
        name: "bevy_picking",
        package: "bevy_picking 0.20.1",
        function: "bevy_picking::mesh_picking::ray_cast::ray_mesh_intersection, Backfaces::Include",
        promise: "\"Checks if a ray intersects a mesh, and returns the nearest intersection if one \
            exists.\" Ray3d's direction is a Dir3, \"a normalized vector pointing in a direction\". The \
            function normalises it again, which is charged to it.",
        kernel: None,
    },
    Entrant {
        name: "truck-meshalgo",
        package: "truck-meshalgo 0.4.0",
        function: "truck_meshalgo::analyzers::IncludingPointInDomain::signed_crossing_faces, not 0",
        promise: "\"Count signed number of faces crossing ray with origin point and direction \
            ray_direction. Counter increase if the dot product of the ray and the normal of a face is \
            positive, and decrease if it is negative.\"",
        kernel: None,
    },
    Entrant {
        name: "embree-fast",
        package: "Embree 3.13.5",
        function: "rtcIntersect1 on a scene of one triangle, no flags (examples/embree)",
        promise: "No promise about edges or numbers.",
        kernel: None,
    },
    Entrant {
        name: "embree-robust",
        package: "Embree 3.13.5",
        function: "rtcIntersect1 on a scene of one triangle, RTC_SCENE_FLAG_ROBUST (examples/embree)",
        promise: "The manual on the flag: it \"avoids optimizations that reduce arithmetic accuracy\", \
            against \"artifacts caused by rays shooting through edges of neighboring primitives\".",
        kernel: None,
    },
    Entrant {
        name: "three-js",
        package: "three 0.187.0",
        function: "Ray.intersectTriangle(a, b, c, false, target) (examples/javascript)",
        promise: "The direction is documented as normalized; a comment in its source says that a ray can \
            \"never fall between\" two triangles that share an edge.",
        kernel: None,
    },
    Entrant {
        name: "trimesh",
        package: "trimesh 5.2.0",
        function: "trimesh.ray.ray_triangle.ray_triangle_id (examples/python/trimesh_kernel.py)",
        promise: "\"Find the intersections between a group of triangles and rays\"; directions are \"ray \
            direction vectors\".",
        kernel: None,
    },
];
