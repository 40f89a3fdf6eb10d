//! The strata of a scene: rays at the inside, edges and vertices of its triangles and beside them, nearly
//! and exactly parallel to them, and from a kernel's own hit points on them.
//!
//! Triangles lie on generic planes, of uniform positions and orientations, or on planes of a kind that the scene
//! names ([`PlaneKind`](crate::case::PlaneKind)). Points are computed in `f64` and rounded, so the oracle, not the
//! construction, says what is a hit.

mod aimed;
mod draw;
mod flat;
mod pixel;
mod planes;
mod shadow;
mod triangles;

pub(crate) use draw::{RayAxes, any_direction, circle, in_plane, rounded, wide};
pub use flat::TRIES;
pub(super) use flat::grazing_sine;
pub use pixel::{Pixel, pixel};
pub(super) use shadow::hit_point;
pub(crate) use triangles::{Corners, Pair, Parallel, Ring, TriangleSource, along_axis, flat_along};

use super::{Family, Grouping, Made, Question};
use crate::arith::Float;
use crate::case::{Draw, Parameters, Scene};
use crate::kernel::Scalar;
use crate::truth::Truth;
use aimed::{edges, interior, outside, vertices};
use flat::{grazing, grazing_ray, parallel};
use shadow::shadow;

named! {
    pub names
    /// A part of a scene whose rates are reported by themselves, with the name of its family.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Stratum {
        /// Rays at a point inside a triangle.
        Interior = "scene-interior",
        /// Rays at a point of an edge that two triangles share.
        Edges = "scene-edges",
        /// Rays at the vertex that six triangles share.
        Vertices = "scene-vertices",
        /// Rays almost parallel to a triangle on a generic plane.
        Grazing = "scene-grazing",
        /// Rays exactly parallel to the plane of a triangle.
        Parallel = "scene-parallel",
        /// Rays from a kernel's own hit point on a triangle, in every direction.
        Shadow = "scene-shadow",
        /// Rays at a point of the plane beside a triangle.
        Outside = "scene-outside",
    }
}

impl Stratum {
    /// The family of its cases.
    pub fn family(self) -> &'static Family {
        &STRATA[self as usize]
    }

    /// Case `index` of the set of a seed, at other triangles than those of the scene's numbers.
    pub fn make_at<F: Scalar>(
        self,
        triangles: &dyn TriangleSource<F>,
        parameters: &Parameters,
        seed: u64,
        index: u64,
    ) -> Made<F> {
        let mut draw = Draw::new(self.name(), seed, index);
        with_scene(parameters, |scene| {
            let kernel = parameters.kernel.as_deref();
            self.maker()(&Setup { triangles, scene, kernel }, &mut draw)
        })
    }

    /// The same at triangles drawn from the scene's numbers.
    pub(super) fn make<F: Scalar>(self, parameters: &Parameters, draw: &mut Draw) -> Made<F> {
        with_scene(parameters, |scene| {
            let kernel = parameters.kernel.as_deref();
            self.maker()(&Setup { triangles: scene, scene, kernel }, draw)
        })
    }

    fn maker<F: Scalar>(self) -> fn(&Setup<'_, F>, &mut Draw) -> Made<F> {
        match self {
            Stratum::Interior => interior,
            Stratum::Edges => edges,
            Stratum::Vertices => vertices,
            Stratum::Grazing => grazing,
            Stratum::Parallel => parallel,
            Stratum::Shadow => shadow,
            Stratum::Outside => outside,
        }
    }
}

/// The sine of the angle that an almost parallel ray has because none of [`TRIES`] has the one that was drawn; none if
/// it has that.
pub fn missed_sine<F: Float>(
    triangles: &dyn TriangleSource<F>,
    scene: &Scene,
    seed: u64,
    index: u64,
) -> Option<f64> {
    let mut draw = Draw::new(Stratum::Grazing.family().name, seed, index);
    grazing_ray(&Setup { triangles, scene, kernel: None }, &mut draw).1
}

/// The data from which a stratum's cases are made.
struct Setup<'a, F: Float> {
    triangles: &'a dyn TriangleSource<F>,
    scene: &'a Scene,
    /// The kernel at whose hit points shadow rays start.
    kernel: Option<&'a str>,
}

/// Makes something of the scene that the parameters hold, or of the default one.
fn with_scene<T>(parameters: &Parameters, make: impl FnOnce(&Scene) -> T) -> T {
    match &parameters.scene {
        Some(scene) => make(scene),
        None => make(&Scene::default()),
    }
}

macro_rules! stratum {
    ($name:literal, $version:literal, $question:ident, $grouping:ident, $stratum:ident, $keeps:expr, $promise:literal) => {
        Family {
            name: $name,
            version: $version,
            promise: $promise,
            question: Question::$question,
            grouping: Grouping::$grouping,
            size: None,
            keeps: $keeps,
            make_f32: |parameters, draw, _| Stratum::$stratum.make(parameters, draw),
            make_f64: |parameters, draw, _| Stratum::$stratum.make(parameters, draw),
        }
    };
}

/// The family of each stratum, in the order of [`Stratum::ALL`].
pub static STRATA: &[Family] = &[
    stratum!(
        "scene-interior",
        1,
        Inside,
        Single,
        Interior,
        with_area,
        "at a point inside a triangle, from any direction"
    ),
    stratum!(
        "scene-edges",
        2,
        Edges,
        SharedEdge,
        Edges,
        with_area,
        "at a point of an edge that two triangles share, from any direction"
    ),
    stratum!(
        "scene-vertices",
        2,
        Vertices,
        Fan,
        Vertices,
        with_area,
        "at the vertex that six triangles share, from any direction"
    ),
    stratum!(
        "scene-grazing",
        2,
        Flat,
        Single,
        Grazing,
        with_area,
        "almost parallel to a generic plane: sines from 1/8 down to below the rounding of the direction"
    ),
    stratum!(
        "scene-parallel",
        3,
        Flat,
        Single,
        Parallel,
        parallel_or_in_the_plane,
        "exactly parallel to the plane, off it or in it"
    ),
    stratum!(
        "scene-shadow",
        1,
        Ends,
        SecondaryRay,
        Shadow,
        with_area,
        "from a kernel's own rounded hit point on the triangle, in every direction"
    ),
    stratum!(
        "scene-outside",
        2,
        Inside,
        Single,
        Outside,
        with_area,
        "at a point of the plane beside the triangle, from any direction"
    ),
];

fn with_area(truths: &[Truth]) -> bool {
    truths.iter().all(|truth| !matches!(truth, Truth::Degenerate(_) | Truth::Invalid))
}

fn parallel_or_in_the_plane(truths: &[Truth]) -> bool {
    truths.iter().all(|truth| matches!(truth, Truth::Parallel | Truth::Coplanar(_)))
}
