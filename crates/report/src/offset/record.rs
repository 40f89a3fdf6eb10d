//! The findings of `offset`, as its record holds them.

use super::choice::{best, derived_name, is_too_high};
use crate::arith::{ScalarName, three_digits};
use crate::audit::{Trials, quoted, words};
use crate::case::Matrix;
use crate::corpus::lines::{StoredCase, write_case};
use crate::kernel::Scalar;
use crate::segments::SegmentsPart;
use hairline_advice::offset::{
    Heights, Lengths, OfScheme, OffsetPlan, OffsetSums, PointKind, ROOM, Scheme, derived_normal,
    least_weight, new_ray,
};
use hairline_record::{Rate, or_infinite};

/// Everything that was found.
#[apply(part!)]
pub struct OffsetResult {
    /// The scene's words.
    pub scene: String,
    /// The path of the mesh that it is, if it is one.
    pub mesh: Option<String>,
    /// Its unit of length; empty if it has none.
    pub unit: String,
    /// The seed of the rays that are reported.
    pub seed: u64,
    /// The seed of the rays on which schemes were chosen and made.
    pub pilot_seed: u64,
    /// How many first rays.
    pub count: u64,
    /// How far in front of each triangle the wall is, in its longest edges.
    pub wall: f64,
    /// The angle in degrees at which a neighbour is folded up at the edge nearest to the hit point.
    pub fold: f64,
    /// Where the triangles are put, if not where they are: row by row, the last column the translation.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub instance: Option<Matrix<f64>>,
    /// The kinds of planes on which each scheme was tried. All numbers are about the first, but those of `elsewhere`.
    pub planes: Vec<String>,
    /// By kernel, kind of hit point and scalar.
    pub points: Vec<PointsPart>,
    /// By kernel and scalar.
    pub segments: Vec<SegmentsPart>,
}

/// The hit points of one kind, of a kernel in a scalar.
#[apply(part!)]
pub struct PointsPart {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The flags that choose the kernel and its epsilons.
    pub flags: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// `uv` or `ray`.
    pub point: String,
    /// How many hit points.
    pub hits: u64,
    /// First rays on which the kernel reported no hit.
    pub missed: u64,
    /// Hits of a triangle without area, or along its plane.
    pub without_side: u64,
    /// Hits whose point is not finite.
    pub not_finite: u64,
    /// The smallest safe offsets along the normal.
    pub least: LeastPart,
    /// The derived bound: the distance along the normal that, like every larger one, has no wrong start.
    pub derived: Option<DerivedPart>,
    /// A scheme with neither a wrong start nor a self-hit that is about as low as any of them.
    pub best: Option<BestPart>,
    /// The results of each scheme.
    pub schemes: Vec<SchemePart>,
}

/// A distance along the normal from a derivation by hand (docs/guide/offset.md), which no certificate stands for.
#[apply(part!)]
pub struct DerivedPart {
    /// This distance and every larger one have no wrong start, on any ray of the scene.
    pub normal: f64,
    /// It holds where u, v and 1-u-v are at least this.
    pub least_weight: f64,
    /// And where they are at most this, which follows.
    pub largest_weight: f64,
}

/// The smallest safe offsets along the normal, of the hit points that need one.
#[apply(part!)]
pub struct LeastPart {
    /// Hit points that need an offset.
    pub needed: Rate,
    /// Hit points for which no offset along the normal is right.
    pub none: u64,
    /// In the scene's unit of length.
    pub lengths: LengthsPart,
    /// In ulps of the hit point's largest coordinate.
    pub ulps: LengthsPart,
}

/// Quantiles, rounded up by at most one part in 256; the largest seen as it was.
#[apply(part!)]
pub struct LengthsPart {
    /// Half are at most this.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub median: f64,
    /// 99 % are at most this.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub p99: f64,
    /// The largest seen on this seed: a larger one may come with more rays.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub largest: f64,
}

/// The scheme to use.
#[apply(part!)]
pub struct BestPart {
    /// The scheme's name.
    pub scheme: String,
    /// At most one new ray in this many fails, with a confidence of 95 %.
    pub one_in: u64,
    /// True if it is the derived bound.
    pub is_derived: bool,
    /// True if half of its starts are more than a tenth of their triangle's longest edge above it, or one in a hundred
    /// more than the whole: then it is no good, and all others that never fail are as bad.
    pub is_too_high: bool,
    /// Runs this scheme alone.
    pub command: String,
}

/// The results of a scheme.
#[apply(part!)]
pub struct SchemePart {
    /// As `--scheme` takes it.
    pub name: String,
    /// Author, title, year and address.
    pub source: String,
    /// Starts on the plane, behind it, or nowhere.
    pub wrong: Rate,
    /// Wrong starts that are not finite.
    pub not_finite: u64,
    /// New rays that hit the triangle which they leave, says the kernel; of none if it cannot tell.
    pub self_hits: Rate,
    /// Starts beyond the wall.
    pub beyond_wall: Rate,
    /// Starts behind the neighbour.
    pub past_neighbour: Rate,
    /// In longest edges of the triangle.
    pub height_in_edges: HeightsPart,
    /// In ulps of the triangle's largest coordinate.
    pub height_in_ulps: HeightsPart,
    /// The way along the normal over the least that is right, where one is needed: its median.
    pub over_least: Option<f64>,
    /// The first wrong start.
    pub first_wrong: Option<WrongPart>,
    /// The results on the other kinds of planes.
    pub elsewhere: Vec<SchemePlanePart>,
}

/// The results of a scheme on planes of one kind.
#[apply(part!)]
pub struct SchemePlanePart {
    /// The name of the kind of planes and rays.
    pub plane: String,
    /// Starts on the plane, behind it, or nowhere.
    pub wrong: Rate,
    /// New rays that hit the triangle which they leave, says the kernel; of none if it cannot tell.
    pub self_hits: Rate,
    /// The first wrong start.
    pub first_wrong: Option<WrongPart>,
}

/// Quantiles of heights over the plane; none on the plane or behind it.
#[apply(part!)]
pub struct HeightsPart {
    /// Half are at most this.
    pub median: Option<f64>,
    /// 99 % are at most this.
    pub p99: Option<f64>,
    /// The highest seen.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub highest: f64,
    /// How deep the deepest wrong start that was seen lies.
    #[serde(deserialize_with = "or_infinite")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub deepest: f64,
}

/// A wrong start.
#[apply(part!)]
pub struct WrongPart {
    /// The id of the first ray, which `hairline explain` takes.
    pub first_ray: String,
    /// Shows the new ray.
    pub explain: String,
}

impl PointsPart {
    /// Plans and sums by kind of plane. `preferred` are places of schemes that come first where they are about as low
    /// as any; `place` are the flags that name the scene or the mesh.
    pub fn new<F: Scalar>(
        plans: &[OffsetPlan<'_>],
        [pilots, runs]: [&[OffsetSums]; 2],
        preferred: &[usize],
        derived: Option<DerivedPart>,
        place: &str,
    ) -> PointsPart {
        let (plan, sums) = (&plans[0], &runs[0]);
        let needed = sums.least.count() + sums.without_least;
        let derived = derived.filter(|derived| derived.covers(runs));
        let is_derived = |scheme: &Scheme| {
            derived
                .as_ref()
                .is_some_and(|derived| scheme.name == derived_name(derived.normal))
        };
        let at_derived = plan.schemes.iter().position(is_derived);
        // A single wrong start refutes a bound, whatever it assumes.
        let is_refuted = |place: usize| runs.iter().any(|sums| 0 < sums.schemes[place].wrong);
        let derived = derived.filter(|_| !at_derived.is_some_and(is_refuted));
        let at_derived = at_derived.filter(|_| derived.is_some());
        let best = best([pilots, runs], preferred, at_derived);
        let flags = match plan.row.set.as_str() {
            "source" => plan.row.entry.selector(),
            _ => plan.row.flags(),
        };
        PointsPart {
            kernel: plan.row.entry.info.name.to_owned(),
            set: plan.row.set.clone(),
            scalar: F::NAME,
            point: plan.kind.name().to_owned(),
            hits: sums.hits,
            missed: sums.missed,
            without_side: sums.without_side,
            not_finite: sums.not_finite,
            least: LeastPart {
                needed: Rate::new(Trials::independent(needed, sums.hits), true),
                none: sums.without_least,
                lengths: LengthsPart::new(&sums.least),
                ulps: LengthsPart::new(&sums.least_in_ulps),
            },
            derived,
            best: best.map(|best| {
                let scheme = plan.schemes[best].name.clone();
                let command = format!(
                    "hairline offset {flags} {place} {} --point {} --scalar {}",
                    plan.schemes[best].flags,
                    plan.kind.name(),
                    F::NAME
                );
                let sums = &sums.schemes[best];
                BestPart {
                    one_in: one_in(sums),
                    is_derived: at_derived == Some(best),
                    is_too_high: is_too_high(sums),
                    scheme,
                    command,
                }
            }),
            flags: flags.clone(),
            schemes: (0..plan.schemes.len())
                .map(|place| SchemePart::new::<F>(plans, runs, place))
                .collect(),
        }
    }
}

impl DerivedPart {
    /// The derived bound of a plan, rounded up; none if what the row's gates let through may have any weights, or a
    /// pilot saw others than that. It assumes nothing of how a plane lies, so it holds on every kind of plane; but it
    /// assumes that triangles are not thin, and those of a mesh may be.
    pub fn of<F: Scalar>(plan: &OffsetPlan<'_>, pilots: &[OffsetSums]) -> Option<DerivedPart> {
        let is_covered =
            plan.kind == PointKind::Weights && plan.mesh.is_none() && plan.instance.is_none();
        let of_weights = is_covered.then(|| least_weight(plan.row))?;
        let least_weight = of_weights?;
        let normal = three_digits(derived_normal::<F>(plan.scene, least_weight)?, true);
        let derived = DerivedPart {
            normal,
            least_weight,
            largest_weight: 1.0 - 2.0 * least_weight,
        };
        Some(derived).filter(|derived| derived.covers(pilots))
    }

    /// True if every hit point of these runs has such weights, but for rounding.
    fn covers(&self, runs: &[OffsetSums]) -> bool {
        runs.iter()
            .all(|sums| self.least_weight - ROOM <= sums.least_weight)
    }
}

/// At most one new ray in this many fails, with a confidence of 95 %: two digits, rounded down.
fn one_in(scheme: &OfScheme) -> u64 {
    // One-sided: all that may be missed is left out above.
    let most = scheme.trials(scheme.failed).interval_at(0.05).high;
    let one_in = (1.0 / most).floor() as u64;
    let unit = 10u64.pow(one_in.max(1).ilog10().saturating_sub(1));
    one_in / unit * unit
}

impl LengthsPart {
    fn new(lengths: &Lengths) -> LengthsPart {
        let [median, p99] = [0.5, 0.99].map(|share| lengths.quantile(share));
        LengthsPart {
            median,
            p99,
            largest: lengths.largest(),
        }
    }
}

impl HeightsPart {
    fn new(heights: &Heights) -> HeightsPart {
        let [median, p99] = [0.5, 0.99].map(|share| heights.quantile(share));
        let (highest, deepest) = (heights.above.largest(), heights.behind.largest());
        HeightsPart {
            median,
            p99,
            highest,
            deepest,
        }
    }
}

impl SchemePart {
    /// The results of the scheme at a place.
    fn new<F: Scalar>(plans: &[OffsetPlan<'_>], runs: &[OffsetSums], place: usize) -> SchemePart {
        let (scheme, sums) = (&plans[0].schemes[place], &runs[0].schemes[place]);
        let over_least = &sums.over_least;
        let rate = |count| Rate::new(sums.trials(count), true);
        let on_plane = |(plan, sums): (&OffsetPlan<'_>, &OffsetSums)| {
            SchemePlanePart::new::<F>(plan, &sums.schemes[place], place)
        };
        let mut of_planes = plans.iter().zip(runs).map(on_plane);
        let first = of_planes.next().expect("one kind of plane");
        SchemePart {
            name: scheme.name.clone(),
            source: scheme.source.clone(),
            wrong: first.wrong,
            not_finite: sums.not_finite,
            self_hits: first.self_hits,
            beyond_wall: rate(sums.beyond_wall),
            past_neighbour: rate(sums.past_neighbour),
            height_in_edges: HeightsPart::new(&sums.in_edges),
            height_in_ulps: HeightsPart::new(&sums.in_ulps),
            over_least: (0 < over_least.count()).then(|| over_least.quantile(0.5)),
            first_wrong: first.first_wrong,
            elsewhere: of_planes.collect(),
        }
    }
}

impl SchemePlanePart {
    fn new<F: Scalar>(plan: &OffsetPlan<'_>, sums: &OfScheme, place: usize) -> SchemePlanePart {
        let rate = |count| Rate::new(sums.trials(count), true);
        let wrong_at = |index| WrongPart::new::<F>(plan, &plan.schemes[place], index);
        SchemePlanePart {
            plane: plan.scene.kind().to_string(),
            wrong: rate(sums.wrong),
            self_hits: if plan.tells_self_hits() {
                rate(sums.self_hits)
            } else {
                Rate::default()
            },
            first_wrong: sums.first_wrong.and_then(wrong_at),
        }
    }
}

impl WrongPart {
    fn new<F: Scalar>(plan: &OffsetPlan<'_>, scheme: &Scheme, index: u64) -> Option<WrongPart> {
        let case = new_ray::<F>(plan, scheme, index)?;
        let line = write_case(&StoredCase {
            is_secondary: true,
            ..StoredCase::of(case)
        });
        Some(WrongPart {
            first_ray: plan.source().id::<F>(index, None),
            explain: {
                let words = plan
                    .instance
                    .map(|matrix| format!(" --instance {}", quoted(&words(&matrix))));
                plan.row
                    .explain_command(&(quoted(&line) + &words.unwrap_or_default()))
            },
        })
    }
}
