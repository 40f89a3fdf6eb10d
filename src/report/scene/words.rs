//! What people call the strata and kinds of a scene.

use crate::epsilon::scene::{Count, Kind};
use crate::family::Stratum;
use crate::kernel::Role;

/// What is counted, by its stratum's family and its kind.
pub(super) fn label(stratum: &str, kind: &str) -> &'static str {
    match (stratum, kind) {
        ("scene-interior", "miss") => "at a triangle: hits lost",
        ("scene-interior", _) => "at its back: false hits",
        ("scene-edges", _) => "at a shared edge: cracks",
        ("scene-vertices", _) => "at a shared vertex: cracks",
        ("scene-grazing", "miss") => "almost parallel: hits lost",
        ("scene-grazing", _) => "almost parallel: false hits",
        ("scene-parallel", _) => "exactly parallel: false hits",
        ("scene-shadow", _) => "shadow rays: self-hits",
        _ => "beside a triangle: false hits",
    }
}

/// What in the scene, not in the kernel, sets a limit.
pub(super) fn set_by(role: Role, count: Count) -> Option<&'static str> {
    match (role, count.stratum, count.kind) {
        (Role::T, Stratum::Interior, Kind::Miss) => Some("the scene's distances"),
        (Role::Parallel, Stratum::Interior, Kind::Miss) => Some("the scene's smallest triangles"),
        (Role::Parallel, Stratum::Grazing, _) => Some("how flat the almost parallel rays are"),
        _ => None,
    }
}
