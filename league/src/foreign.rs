//! Entrants that are built elsewhere: crates whose dependencies are many, in heavy/, and those of other
//! languages, each in a process of its own.

use crate::{ENTRANT, Entrant, Run};

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
        ..ENTRANT
    },
    Entrant {
        name: "embree-fast",
        package: "libembree3",
        version: "3.13.5",
        function: "rtcIntersect1, no scene flags",
        page: "https://github.com/RenderKit/embree/blob/v3.13.5/doc/src/api.md",
        note: "A scene of one triangle (examples/embree). Nothing is promised about edges or numbers.",
        run: Run::Process {
            arguments: &["--kernel-lib", "examples/embree/libembree0.so"],
            needs: "examples/embree/libembree0.so",
        },
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
        page: "https://github.com/RenderKit/embree/blob/v3.13.5/doc/src/api.md",
        note: "A scene of one triangle (examples/embree). Taken to mean that of triangles that share an \
            edge at least one is hit.",
        run: Run::Process {
            arguments: &["--kernel-lib", "examples/embree/libembree1.so"],
            needs: "examples/embree/libembree1.so",
        },
        skip: EMBREE,
        ..ENTRANT
    },
];

/// Debian's build ends the process (assert) on coordinates beyond 1.8e18.
const EMBREE: &[&str] = &["range-ends"];
