//! The findings of a study of epsilons, as its record holds them.

use crate::arith::ScalarName;
pub(super) use crate::family::Stratum;
use crate::kernel::{Dimension, Role};
use crate::segments::SegmentsPart;
pub(super) use hairline_advice::epsilon::{RayCount, Rays, WrongKind};
use hairline_record::{Rate, Record};
use std::collections::BTreeMap;

/// The record of a study of epsilons.
pub type SceneRecord = Record<SceneResult>;

/// Everything that a study of epsilons found.
#[apply(part!)]
pub struct SceneResult {
    /// The scene's words; empty on other sources.
    pub scene: String,
    /// The names of the families and corpora that were studied instead of a scene. What is said below of a scene's sizes
    /// is then said of none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub sources: Vec<String>,
    /// The flags that choose them again.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub flags: String,
    /// Its unit of length; empty if it has none.
    pub unit: String,
    /// The reason for which a scalar that was asked for is left out: it cannot hold the scene.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub left_out: Option<String>,
    /// The largest coordinate of a ray's start.
    pub reach: f64,
    /// The mesh that it is, if it is one.
    pub mesh: Option<MeshScenePart>,
    /// True if directions have unit length, so that t is a length.
    pub unit_directions: bool,
    /// The longest edge of a triangle: in the smallest triangle, and in the largest.
    pub edge: [f64; 2],
    /// The sines of the angles of almost parallel rays; none for those from 1/8 down to below rounding.
    pub sine: Option<[f64; 2]>,
    /// True if all almost parallel rays are aimed inside their triangle.
    pub aims_inside: bool,
    /// The seed of the rays from which epsilons are chosen.
    pub seed: u64,
    /// The seed of the fresh rays on which they are tried.
    pub fresh_seed: u64,
    /// How many indices of each stratum.
    pub count: u64,
    /// The costs of wrong answers, by kind.
    pub costs: Vec<NamedNumber>,
    /// The largest errors that were wanted: `t`, relative, and `point`, in the scene's unit of length.
    pub max_error: Vec<NamedNumber>,
    /// One entry for each kernel and scalar.
    pub kernels: Vec<SceneKernelPart>,
}

impl SceneResult {
    /// True if it is about a scene, and not about families or stored cases.
    pub fn has_scene(&self) -> bool {
        !self.scene.is_empty()
    }

    /// The cost of a wrong answer of a kind.
    pub(super) fn cost(&self, kind: WrongKind) -> f64 {
        self.costs
            .iter()
            .find(|cost| cost.name == kind.name())
            .map_or(0.0, |cost| cost.number)
    }
}

/// A number with a name.
#[apply(part!)]
pub struct NamedNumber {
    /// The name of the number.
    pub name: String,
    /// The number.
    pub number: f64,
}

/// A mesh that is a scene.
#[apply(part!)]
pub struct MeshScenePart {
    /// The file, as it was named.
    pub path: String,
    /// The digest in case ids.
    pub digest: String,
    /// How many triangles.
    pub triangles: u64,
}

/// One kernel in one scalar. Epsilons are shortest decimals of the scalar.
#[apply(part!)]
pub struct SceneKernelPart {
    /// The kernel's name.
    pub kernel: String,
    /// The flag that chooses it.
    pub selector: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// How many rays of each kind the kernel got, if fewer than the others: it surely costs more than those that the table of
    /// kernels shows first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rays: Option<u64>,
    /// The contract that the kernel is judged by.
    pub contract: String,
    /// The contract in the words of `--contract`; absent if it is the kernel's own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub contract_flag: Option<String>,
    /// True if one of its gates at the edges takes an epsilon.
    pub has_edge_epsilon: bool,
    /// How far apart neighbouring numbers of the scalar are where rays start farthest from 0.
    pub spacing: f64,
    /// Twice the area of the smallest triangle, if the scene is a mesh.
    pub least_shape: Option<f64>,
    /// True if the kernel takes an interval of t.
    pub takes_interval: bool,
    /// The knobs that can be set.
    pub knobs: Vec<KnobPart>,
    /// The epsilons of the gates that are not chosen.
    pub others: BTreeMap<String, String>,
    /// The kinds of wrong answers that are counted.
    pub counts: Vec<RayCount>,
    /// If errors are limited: whether 99 % of the hits that remain keep the limit with the recommended
    /// epsilons, in each kind of ray and with a confidence of 95 %. If they do not, none do.
    pub is_accurate: Option<bool>,
    /// The results of epsilons on fresh rays; the cheapest first.
    pub tried: Vec<TriedPart>,
    /// How far each knob may move while the others stay.
    pub limits: Vec<KnobLimitPart>,
    /// Values that are proved.
    pub proved: Vec<ProvedPart>,
    /// Where segments to hit points end, at the kernel's own epsilons; of several kernels in a table nobody asks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub segments: Option<SegmentsPart>,
    /// By knob: what each value does.
    pub curves: Vec<CurvePart>,
    /// The knobs for which no value keeps every limit, and what does.
    pub conflicts: Vec<ConflictPart>,
    /// Epsilons that follow each case's size, if they are cheaper by a fifth, or if only they keep the errors
    /// as small as was wanted; counted, no kernel runs with them.
    pub relative: Option<TriedPart>,
    /// The results of the recommended epsilons in the same scene on planes of other kinds.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub elsewhere: Vec<PlanePart>,
}

impl SceneResult {
    /// How many rays of each kind a kernel got.
    pub(super) fn rays_of(&self, part: &SceneKernelPart) -> u64 {
        part.rays.unwrap_or(self.count)
    }
}

/// The results of epsilons on planes of one kind, on fresh rays.
#[apply(part!)]
pub struct PlanePart {
    /// The name of the kind of planes and rays.
    pub plane: String,
    /// By count: the wrong answers.
    pub wrong: Vec<Rate>,
}

/// A number that can be chosen.
#[apply(part!)]
pub struct KnobPart {
    /// The gate's name, or `t_min`.
    pub name: String,
    /// True if it is a gate's epsilon, which `--epsilon` takes.
    pub is_gate: bool,
    /// The cases that it is there to refuse: `parallel`, `t`, `edge` or `other`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub role: Role,
    /// The condition under which the gate refuses, with the number as `e`; none for `t_min`.
    pub refuses: Option<String>,
    /// The same as the kernel's source prints it, where it has other words for it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub printed: Option<String>,
    /// The powers of length and of |d| in what is compared with it.
    #[cfg_attr(feature = "schema", schemars(with = "[i8; 2]"))]
    pub dimension: Dimension,
    /// The form without a unit, if it has one: `e * L^2 * |d|`.
    pub form: Option<String>,
}

/// The results of epsilons on fresh rays.
#[apply(part!)]
pub struct TriedPart {
    /// `recommended`, the name of one of the kernel's sets, `zero`, a value of `--at`, or `scale-free`.
    pub name: String,
    /// By knob.
    pub epsilons: Vec<String>,
    /// By count: the wrong answers.
    pub wrong: Vec<Rate>,
    /// The sum of their shares, each times its cost.
    pub cost: f64,
    /// By count: rays at a shared edge or vertex that hit more than one triangle; they cost nothing. Of none where no
    /// crack is counted.
    pub doubles: Vec<Rate>,
    /// Holes at shared edges in a million pixels of a picture that triangles of the scene cover once, side by side; none
    /// where no crack at shared edges is counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holes_per_million: Option<f64>,
    /// The 95 % interval of that; none where no ray leaked.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub holes_interval: Option<[f64; 2]>,
    /// The errors of the hits that remain.
    pub errors: Vec<ErrorPart>,
    /// If errors are limited: by count, the hits that remain and are farther off; of none where no hit can
    /// be lost.
    pub exceeded: Vec<Rate>,
}

/// The errors of some hits.
#[apply(part!)]
pub struct ErrorPart {
    /// The place of the count whose hits they are.
    pub count: usize,
    /// `t`, relative to itself, or `point`, in the scene's unit of length.
    pub value: String,
    /// How many hits.
    pub hits: u64,
    /// Half of the errors are at most this, rounded up by at most an eighth; none if that is not finite.
    pub median: Option<f64>,
    /// 99 % of the errors are at most this, rounded up by at most an eighth.
    pub most: Option<f64>,
    /// The largest error seen.
    pub worst: Option<f64>,
}

/// How far a knob may move while the others stay.
#[apply(part!)]
pub struct KnobLimitPart {
    /// The knob's place.
    pub knob: usize,
    /// The count's place.
    pub count: usize,
    /// True if values must be at or above the limit, false if at or below it.
    pub is_lower: bool,
    /// The limit; none if no value keeps the share.
    pub value: Option<String>,
    /// The other end of an interval: beyond it more than that share is wrong, with the same confidence; none if the rays
    /// show no such number.
    pub far: Option<String>,
    /// True if the rays show so little of where the limit is that nobody should act on its value.
    pub is_unsure: bool,
    /// At most one in this many answers is wrong at the limit, with a confidence of 95 %.
    pub one_in: u64,
    /// The wrong answers on fresh rays at the limit.
    pub fresh: Option<Rate>,
    /// The property of the scene that sets the limit, if the kernel's rounding does not.
    pub set_by: Option<String>,
    /// The price of the value, if it is one that loses plain hits or lets rays beside triangles hit.
    pub price: Option<PricePart>,
}

/// The price of a value on fresh rays, while the other numbers stay.
#[apply(part!)]
pub struct PricePart {
    /// The count's place: hits lost at a triangle, or false hits beside one.
    pub count: usize,
    /// Its wrong answers, of all its rays.
    pub wrong: Rate,
}

/// A value that is proved for every ray of the scene.
#[apply(part!)]
pub struct ProvedPart {
    /// The knob's place.
    pub knob: usize,
    /// The place of the count of which nothing is wrong.
    pub count: usize,
    /// True if it holds for all values at and above, false if for all at and below.
    pub is_lower: bool,
    /// The value.
    pub value: String,
    /// The wrong answers on fresh rays at the value: none, or the proof is wrong.
    pub fresh: Rate,
    /// The price of the value.
    pub price: Option<PricePart>,
}

/// The results of the values of one knob on fresh rays while the others stay.
#[apply(part!)]
pub struct CurvePart {
    /// The values, in order.
    pub values: Vec<String>,
    /// One entry a count.
    pub counts: Vec<CurveCount>,
}

/// One count of a curve.
#[apply(part!)]
pub struct CurveCount {
    /// How many rays.
    pub of: u64,
    /// How many of them the other knobs refuse, whatever this one is.
    pub refused_by_others: u64,
    /// By value: how many are hits.
    pub hits: Vec<u64>,
}

/// Two limits of one knob that do not meet.
#[apply(part!)]
pub struct ConflictPart {
    /// The place of the limit from below in the list of limits.
    pub lower: usize,
    /// The place of the limit from above.
    pub upper: usize,
    /// If the limits of epsilons that follow each case's size meet, from where to where.
    pub scale_free: Option<[String; 2]>,
}
