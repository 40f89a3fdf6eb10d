//! The strata of a scene: rays at the inside, edges and vertices of its triangles and beside them, nearly
//! and exactly parallel to them, from a kernel's own hit points on them, and to such points.
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

pub(crate) use draw::{RayAxes, circle, either_sign, in_plane, rounded, unit_vector};
pub use draw::{any_direction, wide};
pub use flat::TRIES;
pub(super) use flat::grazing_sine;
pub use pixel::{Pixel, pixel, pixel_draw};
pub(super) use shadow::hit_point;
pub(super) use triangles::HEXAGON;
pub(crate) use triangles::{Corners, Pair, Parallel, Ring, TriangleSource, along_axis, flat_along};

use super::drawn_interval::draw_interval;
use super::{CaseGroup, Family, Grouping, Promise, Question};
use crate::arith::{Float, scale_by_power_of_two};
use crate::case::{Case, DirectionLength, Draw, Parameters, Scene, SceneInterval};
use crate::kernel::Scalar;
use crate::truth::Truth;
use aimed::{edges, interior, outside, vertices};
use flat::{grazing, grazing_ray, parallel};
use shadow::{segment, shadow};

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
        /// Rays from a point to a kernel's own hit point on a triangle, where their interval ends.
        Segment = "scene-segment",
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
    ) -> CaseGroup<F> {
        self.make_of(Some(triangles), parameters, &mut self.draw(seed, index))
    }

    /// The numbers from which a case is drawn, those of its triangles first.
    pub fn draw(self, seed: u64, index: u64) -> Draw {
        Draw::new(self.name(), seed, index)
    }

    /// The same at triangles drawn from the scene's numbers.
    pub(super) fn make<F: Scalar>(self, parameters: &Parameters, draw: &mut Draw) -> CaseGroup<F> {
        self.make_of(None, parameters, draw)
    }

    /// In the scene that the parameters hold, or in the default one.
    fn make_of<F: Scalar>(
        self,
        triangles: Option<&dyn TriangleSource<F>>,
        parameters: &Parameters,
        draw: &mut Draw,
    ) -> CaseGroup<F> {
        let mut scene = parameters.scene.clone().unwrap_or_default();
        // A stream of its own: the first numbers of the other are those of the triangles.
        let mut lengths = Draw::new("scene-lengths", draw.clone().bits(), 0);
        let doublings = settle_length(&mut lengths, &mut scene);
        let setup = Setup {
            triangles: triangles.unwrap_or(&scene),
            scene: &scene,
            kernel: parameters.kernel.as_deref(),
        };
        let mut made = self.maker()(&setup, draw);
        if doublings != 0 {
            made.cases_mut()
                .iter_mut()
                .for_each(|case| lengthen(case, doublings));
        }
        // A segment ends where its target is: that is its question.
        if scene.interval == SceneInterval::Drawn && self != Stratum::Segment {
            draw_interval(self.family().grouping, draw, made.cases_mut());
        }
        made
    }

    /// About the truth of its cases, in one line.
    const fn promise(self) -> &'static str {
        match self {
            Stratum::Interior => "at a point inside a triangle, from any direction",
            Stratum::Edges => "at a point of an edge that two triangles share, from any direction",
            Stratum::Vertices => "at the vertex that six triangles share, from any direction",
            Stratum::Grazing => {
                "almost parallel to a generic plane: sines from 1/8 down to below the rounding of the direction"
            }
            Stratum::Parallel => "exactly parallel to the plane, off it or in it",
            Stratum::Shadow => {
                "from a kernel's own rounded hit point on the triangle, in every direction"
            }
            Stratum::Outside => "at a point of the plane beside the triangle, from any direction",
            Stratum::Segment => {
                "from a point to a kernel's own rounded hit point on the triangle, where t_max is"
            }
        }
    }

    fn maker<F: Scalar>(self) -> fn(&Setup<'_, F>, &mut Draw) -> CaseGroup<F> {
        match self {
            Stratum::Interior => interior,
            Stratum::Edges => edges,
            Stratum::Vertices => vertices,
            Stratum::Grazing => grazing,
            Stratum::Parallel => parallel,
            Stratum::Shadow => shadow,
            Stratum::Outside => outside,
            Stratum::Segment => segment,
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
    let setup = Setup {
        triangles,
        scene,
        kernel: None,
    };
    grazing_ray(&setup, &mut draw).missed_sine
}

/// Chooses the length of one ray's direction in a scene of all lengths: a unit vector in half of the cases, the way to the
/// target in a quarter, and in a quarter a unit vector that is doubled or halved as often as is returned.
fn settle_length(draw: &mut Draw, scene: &mut Scene) -> i32 {
    if scene.direction != DirectionLength::Mixed {
        return 0;
    }
    let kind = draw.below(4);
    scene.direction = if kind == 0 {
        DirectionLength::Target
    } else {
        DirectionLength::Unit
    };
    match kind {
        1 => draw.pick(&[-6, -3, -1, 1, 3, 6]),
        _ => 0,
    }
}

/// Doubles a direction so many times, and halves the ends of the interval as often; the points that count stay exactly the
/// same.
fn lengthen<F: Float>(case: &mut Case<F>, doublings: i32) {
    let scaled = |x: F, power: i32| F::from_f64(scale_by_power_of_two(x.to_f64(), power));
    let direction: [F; 3] = case.ray.direction.into();
    case.ray.direction = direction.map(|x| scaled(x, doublings)).into();
    *case = case.on(
        scaled(case.ray.t_min, -doublings),
        scaled(case.ray.t_max, -doublings),
    );
}

/// The data from which a stratum's cases are made.
struct Setup<'a, F: Float> {
    triangles: &'a dyn TriangleSource<F>,
    scene: &'a Scene,
    /// The kernel at whose hit points shadow rays start.
    kernel: Option<&'a str>,
}

macro_rules! stratum {
    ($stratum:ident, $version:literal, $question:ident, $grouping:ident, $keeps:expr) => {
        Family {
            name: Stratum::$stratum.name(),
            version: $version,
            promise: Stratum::$stratum.promise(),
            question: Question::$question,
            grouping: Grouping::$grouping,
            size: None,
            keeps: Promise::Truths($keeps),
            make_f32: |parameters, draw, _| Stratum::$stratum.make(parameters, draw),
            make_f64: |parameters, draw, _| Stratum::$stratum.make(parameters, draw),
        }
    };
}

/// The family of each stratum, in the order of [`Stratum::ALL`].
pub static STRATA: &[Family] = &[
    stratum!(Interior, 1, Inside, Single, has_area),
    stratum!(Edges, 2, Edges, SharedEdge, has_area),
    stratum!(Vertices, 2, Vertices, Fan, has_area),
    stratum!(Grazing, 2, Flat, Single, has_area),
    stratum!(Parallel, 3, Flat, Single, is_parallel_or_in_the_plane),
    stratum!(Shadow, 1, Ends, SecondaryRay, has_area),
    stratum!(Outside, 2, Inside, Single, has_area),
    stratum!(Segment, 1, Ends, SecondaryRay, has_area),
];

fn has_area(truth: &Truth) -> bool {
    !matches!(truth, Truth::Degenerate(_) | Truth::Invalid)
}

fn is_parallel_or_in_the_plane(truth: &Truth) -> bool {
    matches!(truth, Truth::Parallel | Truth::Coplanar(_))
}
