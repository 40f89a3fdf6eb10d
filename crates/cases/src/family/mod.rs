//! Floor 2: where cases come from. One family a file, each with its promise, which the oracle checks
//! on every case.
//!
//! To add a family: write its file with a `Recipe`, and give it a row in [`FAMILIES`].

#![forbid(unsafe_code)]

mod batch;
mod boundary;
mod control;
mod directions;
mod drawn_interval;
mod exact_ray;
mod flat;
pub mod integer;
mod interval;
mod lattice;
#[cfg(feature = "studies")]
pub mod manifest;
mod mesh;
mod neighbours;
mod noise;
mod origin;
mod polygon;
mod question;
mod range;
mod ring;
mod scene;
mod shape;
mod sizes;
mod vertex_fan;

pub(crate) use boundary::{nudged, toward};
pub use control::combination;
pub(crate) use drawn_interval::draw_interval;
pub(crate) use exact_ray::exact_ray;
pub use lattice::LATTICE_SIZE;
pub use mesh::MeshFamily;
pub use question::Question;
pub use ring::{add_ring, around};
pub(crate) use scene::{
    Corners, Pair, Parallel, RayAxes, Ring, TriangleSource, along_axis, circle, either_sign,
    flat_along, in_plane, rounded, unit_vector,
};
pub use scene::{
    Pixel, STRATA, Stratum, TRIES, any_direction, missed_sine, pixel, pixel_draw, wide,
};

use crate::arith::Float;
use crate::arith::scale_by_power_of_two;
use crate::case::{Case, CaseId, Draw, Parameters};
use crate::kernel::{self, Scalar};
use crate::truth::{Crossing, Truth};
use std::any::Any;

/// The triangles that one index of a family makes: one, or a group that shares a ray.
#[derive(Clone, Debug)]
pub enum CaseGroup<F: Float> {
    /// One case.
    One(Case<F>),
    /// One ray, several triangles.
    Group(Vec<Case<F>>),
}

impl<F: Float> CaseGroup<F> {
    /// The cases, in order.
    pub fn cases(&self) -> &[Case<F>] {
        match self {
            CaseGroup::One(case) => std::slice::from_ref(case),
            CaseGroup::Group(cases) => cases,
        }
    }

    /// The cases, in order, to be changed.
    pub fn cases_mut(&mut self) -> &mut [Case<F>] {
        match self {
            CaseGroup::One(case) => std::slice::from_mut(case),
            CaseGroup::Group(cases) => cases,
        }
    }
}

/// How the triangles of one index belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// One triangle.
    Single,
    /// One triangle; the ray starts at a kernel's own hit point on it.
    SecondaryRay,
    /// Two triangles on one edge.
    SharedEdge,
    /// A closed fan around a vertex.
    Fan,
    /// The fan of a planar convex polygon: vertices are the first triangle's, then each last one.
    Polygon,
}

impl Grouping {
    /// True if the triangles of one index share a ray.
    pub fn shares_a_ray(self) -> bool {
        !matches!(self, Grouping::Single | Grouping::SecondaryRay)
    }
}

/// How a family makes its cases.
trait Recipe {
    const NAME: &'static str;
    /// Raised whenever the cases change.
    const VERSION: u32 = 1;
    /// About the truth of its cases, in one line.
    const PROMISE: &'static str;
    const GROUPING: Grouping = Grouping::Single;
    /// The promise: crossings, unless a family says otherwise.
    const KEEPS: Promise = Promise::Crossings(|_| true);
    /// Case `index` of the set; `draw` is its own stream.
    fn make<F: Scalar>(draw: &mut Draw, index: u64) -> CaseGroup<F>;
    /// True if the interval is part of the question; otherwise it is drawn ([`drawn_interval`]).
    const HAS_OWN_INTERVAL: bool = false;
    /// Finishes a case after the parameters are applied.
    fn finish<F: Scalar>(_draw: &mut Draw, _parameters: &Parameters, _made: &mut CaseGroup<F>) {}
}

/// The promise about the truths of one index.
#[derive(Clone, Copy)]
enum Promise {
    /// Each is a crossing of this sort.
    Crossings(fn(&Crossing) -> bool),
    /// Each is of this sort.
    Truths(fn(&Truth) -> bool),
    /// All together.
    Together(fn(&[Truth]) -> bool),
}

/// A row of the table of families.
pub struct Family {
    /// The name on the command line and in case ids.
    pub name: &'static str,
    /// Part of the case ids.
    pub version: u32,
    /// About the truth of its cases, in one line.
    pub promise: &'static str,
    /// The question that it belongs to.
    pub question: Question,
    /// How the triangles of one index belong together.
    pub grouping: Grouping,
    /// The number of its cases, if there are finitely many.
    pub size: Option<u64>,
    keeps: Promise,
    make_f32: Generator<f32>,
    make_f64: Generator<f64>,
}

/// Makes the case of an index in one scalar.
type Generator<F> = fn(&Parameters, &mut Draw, u64) -> CaseGroup<F>;

const fn row<R: Recipe>(question: Question) -> Family {
    Family {
        name: R::NAME,
        version: R::VERSION,
        promise: R::PROMISE,
        question,
        grouping: R::GROUPING,
        size: None,
        keeps: R::KEEPS,
        make_f32: made::<R, f32>,
        make_f64: made::<R, f64>,
    }
}

/// A recipe's cases, put through the parameters.
fn made<R: Recipe, F: Scalar>(
    parameters: &Parameters,
    draw: &mut Draw,
    index: u64,
) -> CaseGroup<F> {
    let mut made = R::make::<F>(draw, index);
    for case in made.cases_mut() {
        apply(parameters, case);
    }
    R::finish(draw, parameters, &mut made);
    if !R::HAS_OWN_INTERVAL {
        draw_interval(R::GROUPING, draw, made.cases_mut());
    }
    made
}

/// Every family but the mesh, in the order of reports.
pub static FAMILIES: &[Family] = &[
    row::<control::Interior>(Question::Inside),
    row::<control::Outside>(Question::Inside),
    row::<boundary::EdgeExact>(Question::Edges),
    row::<boundary::EdgeNear>(Question::Edges),
    row::<boundary::VertexExact>(Question::Vertices),
    row::<boundary::VertexNear>(Question::Vertices),
    row::<flat::ParallelOff>(Question::Flat),
    row::<flat::Coplanar>(Question::Flat),
    row::<flat::Grazing>(Question::Flat),
    row::<origin::OriginOn>(Question::Ends),
    row::<origin::OriginNear>(Question::Ends),
    row::<origin::SecondaryRay>(Question::Ends),
    row::<interval::Behind>(Question::Ends),
    row::<interval::IntervalEnds>(Question::Ends),
    row::<shape::Sliver>(Question::Sizes),
    row::<sizes::Tiny>(Question::Sizes),
    row::<sizes::Huge>(Question::Sizes),
    row::<sizes::Far>(Question::Sizes),
    row::<directions::DirectionLengthFamily>(Question::Sizes),
    row::<directions::AxisAligned>(Question::Grid),
    row::<range::MixedScale>(Question::Range),
    row::<range::RangeEnds>(Question::Range),
    row::<shape::Degenerate>(Question::Flat),
    row::<range::Invalid>(Question::Invalid),
    row::<batch::MixedBatch>(Question::Inside),
    row::<neighbours::SharedEdgeFamily>(Question::Edges),
    row::<neighbours::Fan>(Question::Vertices),
    row::<vertex_fan::VertexFan>(Question::Vertices),
    row::<noise::Noise>(Question::Range),
    row::<polygon::Polygon>(Question::Edges),
    Family {
        size: Some(LATTICE_SIZE),
        ..row::<lattice::Lattice>(Question::Grid)
    },
];

/// The family of a name, be it a stratum of a scene.
pub fn find(name: &str) -> Option<&'static Family> {
    FAMILIES
        .iter()
        .chain(STRATA)
        .find(|family| family.name == name)
}

/// The cases that an id makes without a mesh, in the scalar that it names, and how they belong together. An error says
/// what is wrong with it.
pub fn cases_of<F: Scalar>(id: &CaseId) -> Result<(Vec<Case<F>>, Grouping), String> {
    let in_order = id.family.strip_suffix("-all");
    let name = in_order.unwrap_or(&id.family);
    let family = find(name).filter(|family| family.version == id.version);
    let Some(family) = family else {
        return Err(format!(
            "this program makes no cases of '{}@{}'",
            id.family, id.version
        ));
    };
    if let Some(name) = id
        .parameters
        .kernel
        .as_deref()
        .filter(|name| kernel::find(name).is_none())
    {
        return Err(format!("'{id}': there is no kernel '{name}'"));
    }
    if let Some(scene) = &id.parameters.scene {
        scene
            .check_in::<F>()
            .map_err(|error| format!("'{id}': {error}"))?;
    }
    if family
        .size
        .map_or(in_order.is_some(), |size| id.index >= size)
    {
        return Err(format!("'{id}': family '{name}' has no case of that index"));
    }
    let made: CaseGroup<F> = match in_order {
        Some(_) => family.make_in_order(&id.parameters, id.index),
        None => family.make(&id.parameters, id.seed, id.index),
    };
    let mut cases = made.cases().to_vec();
    if let Some(triangle) = id.triangle {
        cases = vec![chosen_triangle(id, triangle, &cases)?];
    }
    Ok((cases, family.grouping))
}

/// The triangle of a group that an id names.
pub fn chosen_triangle<F: Float>(
    id: &CaseId,
    triangle: usize,
    cases: &[Case<F>],
) -> Result<Case<F>, String> {
    let noun = if cases.len() == 1 {
        "triangle"
    } else {
        "triangles"
    };
    let error = || format!("'{id}' has {} {noun}, counted from 0", cases.len());
    cases.get(triangle).copied().ok_or_else(error)
}

impl Family {
    /// Case `index` of the set of a seed, put through the parameters.
    pub fn make<F: Scalar>(&self, parameters: &Parameters, seed: u64, index: u64) -> CaseGroup<F> {
        let mut draw = Draw::new(self.name, seed, index);
        let index = self
            .size
            .map_or(index, |size| lattice::shuffled(index % size, seed));
        self.generator::<F>()(parameters, &mut draw, index)
    }

    /// Case `index` in the natural order of a finite family.
    pub fn make_in_order<F: Scalar>(&self, parameters: &Parameters, index: u64) -> CaseGroup<F> {
        self.generator::<F>()(parameters, &mut Draw::new(self.name, 0, index), index)
    }

    /// The generator of a scalar, which is one of the two.
    fn generator<F: Scalar>(&self) -> Generator<F> {
        let both: [&dyn Any; 2] = [&self.make_f32, &self.make_f64];
        let found = both
            .into_iter()
            .find_map(|make| make.downcast_ref::<Generator<F>>());
        *found.expect("a scalar is f32 or f64")
    }

    /// True if the truths of one index keep the promise.
    pub fn keeps(&self, truths: &[Truth]) -> bool {
        match self.keeps {
            Promise::Crossings(is_kept) => {
                truths.iter().all(|it| it.crossing().is_some_and(is_kept))
            }
            Promise::Truths(is_kept) => truths.iter().all(is_kept),
            Promise::Together(are_kept) => are_kept(truths),
        }
    }

    /// The id of a case.
    pub fn id<F: Float>(&self, parameters: &Parameters, seed: u64, index: u64) -> CaseId {
        id_of::<F>((self.name, self.version), parameters.clone(), seed, index)
    }
}

/// The id of a case of a family.
fn id_of<F: Float>(
    (family, version): (&str, u32),
    parameters: Parameters,
    seed: u64,
    index: u64,
) -> CaseId {
    CaseId {
        family: family.to_owned(),
        version,
        scalar: F::NAME,
        parameters,
        seed,
        index,
        triangle: None,
    }
}

/// Scales, moves and normalises a case. Where only positions are scaled, t and the ends of the
/// interval scale with them.
pub fn apply<F: Float>(parameters: &Parameters, case: &mut Case<F>) {
    let Parameters {
        scale,
        scale_direction,
        offset,
        ..
    } = parameters;
    if *scale == 0 && *offset == [0.0; 3] && !parameters.unit_direction {
        return;
    }
    let [origin, direction, a, b, c] = case.vectors();
    let moved = |point: [F; 3]| -> [F; 3] {
        std::array::from_fn(|i| {
            let x = scaled(point[i], *scale);
            if offset[i] == 0.0 {
                x
            } else {
                x + F::from_f64(offset[i])
            }
        })
    };
    let end = |t: F| {
        if *scale_direction {
            t
        } else {
            scaled(t, *scale)
        }
    };
    let (t_min, t_max) = (end(case.ray.t_min), end(case.ray.t_max));
    let direction = apply_to_direction(parameters, direction);
    *case = Case::new(moved(origin), direction, [a, b, c].map(moved)).on(t_min, t_max);
}

fn apply_to_direction<F: Float>(parameters: &Parameters, direction: [F; 3]) -> [F; 3] {
    let power = if parameters.scale_direction {
        parameters.scale
    } else {
        0
    };
    let direction = direction.map(|x| scaled(x, power));
    if parameters.unit_direction {
        unit(direction)
    } else {
        direction
    }
}

fn scaled<F: Float>(x: F, power: i32) -> F {
    if power == 0 {
        x
    } else {
        F::from_f64(scale_by_power_of_two(x.to_f64(), power))
    }
}

/// The rounded unit vector; the zero vector and vectors that are not finite stay.
fn unit<F: Float>(direction: [F; 3]) -> [F; 3] {
    let wide = direction.map(F::to_f64);
    let largest = wide.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if largest == 0.0 || wide.iter().any(|x| !x.is_finite()) {
        return direction;
    }
    let near_one = wide.map(|x| x / largest);
    let length = near_one.iter().map(|x| x * x).sum::<f64>().sqrt();
    near_one.map(|x| F::from_f64(x / length))
}
