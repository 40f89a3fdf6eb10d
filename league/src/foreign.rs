//! Entrants of other languages, which go through hairline's plug-ins: see examples/.

use crate::Entrant;

pub const ENTRANTS: &[Entrant] = &[
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
