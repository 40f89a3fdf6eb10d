//! The kinds of planes and of rays that a scene can have.

use std::fmt;

named! {
    pub names
    /// Where the direction of a ray comes from. It decides where rays far from 0 pass, because there the origin is
    /// rounded by much.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum RayKind {
        /// From the rounded origin to the target: the stored ray still passes the target, but for the rounding of the
        /// direction.
        Stored = "stored",
        /// From the origin before it is rounded, as a camera or a light generates it: the rounding moves the ray.
        Generated = "generated",
    }
}

named! {
    pub names
    /// How the planes of triangles lie. Their rates differ, so they are never pooled.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum PlaneKind {
        /// Turned at random.
        Generic = "generic",
        /// Parallel to two axes, at any place: floors and walls.
        Axis = "axis",
        /// Parallel to two axes, at a coordinate from a millionth to a thousandth of the extent.
        AxisNearZero = "axis-near-0",
        /// Holding two axes: one coordinate of all vertices is exactly 0.
        AxisAtZero = "axis-0",
        /// At an angle of up to 6 degrees to two axes, at heights up to a thousandth of the extent: level ground.
        Terrain = "terrain",
        /// Parallel to two axes, with edges along axes; neighbours stand at right angles.
        Box = "box",
    }
}

named! {
    pub names
    /// Where the rays of a scene go, but for those that are almost or exactly parallel to a triangle.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Toward {
        /// Anywhere.
        Any = "any",
        /// In a plane of two axes: one coordinate of the direction is 0.
        AxisPlane = "axis-plane",
        /// Along an axis, as rays of parallel projections and voxelizers do: two coordinates of the direction are 0.
        Axis = "axis",
    }
}

/// The kinds of planes and of rays of a scene. Their rates differ, so they are never pooled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SceneKind {
    /// How the planes of triangles lie.
    pub plane: PlaneKind,
    /// Where rays go.
    pub toward: Toward,
}

impl SceneKind {
    /// The kinds that are tried if a scene names none: all planes, and rays along axes at those that are turned at random
    /// and at floors.
    pub const ALL: [SceneKind; 9] = {
        const fn kind(plane: PlaneKind, toward: Toward) -> SceneKind {
            SceneKind { plane, toward }
        }
        [
            kind(PlaneKind::Generic, Toward::Any),
            kind(PlaneKind::Axis, Toward::Any),
            kind(PlaneKind::AxisNearZero, Toward::Any),
            kind(PlaneKind::AxisAtZero, Toward::Any),
            kind(PlaneKind::Terrain, Toward::Any),
            kind(PlaneKind::Box, Toward::Any),
            kind(PlaneKind::Generic, Toward::AxisPlane),
            kind(PlaneKind::Generic, Toward::Axis),
            kind(PlaneKind::Axis, Toward::Axis),
        ]
    };

    /// The kind of a name, also one that is not tried by itself.
    pub fn named(name: &str) -> Option<SceneKind> {
        let with = |plane| Toward::ALL.map(|toward| SceneKind { plane, toward });
        PlaneKind::ALL
            .into_iter()
            .flat_map(with)
            .find(|kind| kind.to_string() == name)
    }

    /// The planes and the rays in a few words.
    pub fn in_words(self) -> &'static str {
        match (self.plane, self.toward) {
            (PlaneKind::Generic, Toward::Any) => "turned at random",
            (PlaneKind::Axis, Toward::Any) => "floors and walls at any place",
            (PlaneKind::AxisNearZero, _) => "floors and walls near coordinate 0",
            (PlaneKind::AxisAtZero, _) => "floors and walls at coordinate 0",
            (PlaneKind::Terrain, _) => "level ground",
            (PlaneKind::Box, _) => "boxes along the axes",
            (PlaneKind::Axis, _) => "floors and walls, rays along axes",
            (_, Toward::AxisPlane) => "any plane, rays in planes of two axes",
            (_, Toward::Axis) => "any plane, rays along axes",
        }
    }
}

impl fmt::Display for SceneKind {
    /// The name of the planes; then where rays go, if not anywhere.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plane = self.plane.name();
        match (self.plane, self.toward) {
            (_, Toward::Any) => f.write_str(plane),
            (PlaneKind::Generic, toward) => write!(f, "{}-rays", toward.name()),
            (_, toward) => write!(f, "{plane}+{}-rays", toward.name()),
        }
    }
}

impl PlaneKind {
    /// True if the plane is at or near coordinate 0, so that the scene's center has to be 0.
    pub(super) fn is_near_zero(self) -> bool {
        matches!(self, PlaneKind::AxisNearZero | PlaneKind::AxisAtZero)
    }
}
