//! The record of `hairline prove`: what `--format json` writes, and what the text is made from.

use super::verdicts::VerdictPart;
use crate::arith::ScalarName;
use crate::prove::{Assumption, Domain};
use hairline_record::{Comparable, NamedRate, NamedValue, Record, Study};

/// The record of a run, with what a page says beside it.
pub struct Report {
    /// The record.
    pub record: Record<ProofResult>,
    /// The scene's words, if it has some.
    pub scene: Option<String>,
    /// The flags of `epsilon` that choose rays in such a scene.
    pub rays: String,
    /// True if it is about one kernel: then its sentences are told.
    pub is_of_one: bool,
}

/// The proofs of some kernels.
#[apply(part!)]
pub struct ProofResult {
    /// The inputs of which it holds.
    pub domain: DomainPart,
    /// Every gate of every kernel, in each scalar.
    pub gates: Vec<GatePart>,
    /// Every kernel as a whole, in each scalar.
    pub kernels: Vec<KernelPart>,
}

/// The inputs of which proofs hold: the most that absolute values of coordinates may be, and limits of divisors.
#[apply(part!)]
pub struct DomainPart {
    /// Sizes of the edge vectors b-a, c-a and c-b.
    pub edge: f64,
    /// Sizes of the vectors from the origin of the ray to the vertices.
    pub reach: f64,
    /// Sizes of the origin and of the vertices themselves.
    pub world: f64,
    /// Sizes of the direction.
    pub direction: f64,
    /// Sizes of t_min and t_max.
    pub extent: f64,
    /// The least that the largest coordinate of a direction may be, where a kernel divides by it.
    pub largest_of_direction_at_least: f64,
    /// The least that every other divisor may be.
    pub divisor_at_least: f64,
    /// The most that a quotient may be.
    pub quotient_at_most: f64,
}

/// One gate of one kernel in one scalar.
#[apply(part!)]
pub struct GatePart {
    /// The kernel's name.
    pub kernel: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// The gate's name.
    pub gate: String,
    /// The formula of what it compares.
    pub compares: String,
    /// No computed number is farther from the exact one.
    pub bound: Option<f64>,
    /// The same in units of 2^-p.
    pub bound_units: Option<f64>,
    /// Why there is no bound.
    pub why: Option<String>,
    /// The largest error that a search found.
    pub witness: Option<WitnessPart>,
    /// bound / witness
    pub factor: Option<f64>,
    /// The assumptions of the bound besides |d| <= 1.
    pub supposes: Vec<String>,
    /// The limits of exact divisors and quotients that it supposes.
    pub limits: Vec<LimitPart>,
    /// The largest computed number of a ray that is exactly parallel, of those known.
    pub parallel_passes: Option<WitnessPart>,
    /// The consequences, in sentences.
    pub statements: Vec<String>,
}

/// At least or at most so large is a number that a kernel divides by, or gets by dividing.
#[apply(part!)]
pub struct LimitPart {
    /// As the kernel's source calls it.
    pub number: String,
    /// The least that it may be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// The most that it may be.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

/// Inputs that a search found.
#[apply(part!)]
pub struct WitnessPart {
    /// The error, or the number that is computed of them.
    pub value: f64,
    /// The same in units of 2^-p.
    pub units: f64,
    /// Their bits, in hexadecimal.
    pub inputs: Vec<String>,
}

/// The statements about a kernel as a whole.
#[apply(part!)]
pub struct KernelPart {
    /// The kernel's name.
    pub kernel: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// How many ways there are through its branches.
    pub paths: usize,
    /// None of a kernel without epsilons.
    pub verdicts: Option<VerdictPart>,
    /// If rays can slip through an edge that two triangles share, in a sentence.
    pub edges: String,
    /// True if it is proved that none can.
    pub watertight: bool,
    /// A ray that both triangles of an edge refuse, if one was found; looked for where one kernel is chosen.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub leak: Option<Leak>,
    /// True if nothing is proved of its edges.
    #[serde(skip)]
    pub may_leak: bool,
}

impl Comparable for ProofResult {
    const STUDY: Study = Study::Prove;

    fn question(&self) -> String {
        format!(
            "domain {}",
            serde_json::to_string(&self.domain).unwrap_or_default()
        )
    }

    fn cases(&self) -> String {
        String::new()
    }

    fn counted(&self) -> Vec<NamedRate> {
        Vec::new()
    }

    /// Every bound; what there is no bound of is infinite.
    fn chosen(&self) -> Vec<NamedValue> {
        let bound = |what: String, value: Option<f64>| NamedValue {
            what,
            value: format!("{:e}", value.unwrap_or(f64::INFINITY)),
            is_bound: true,
        };
        let gates = self.gates.iter().map(
            |GatePart {
                 kernel,
                 scalar,
                 gate,
                 bound: of,
                 ..
             }| { bound(format!("{kernel} {scalar}: bound of gate {gate}"), *of) },
        );
        let kernels = self.kernels.iter().flat_map(
            |KernelPart {
                 kernel,
                 scalar,
                 verdicts,
                 watertight,
                 ..
             }| {
                let depths = verdicts
                    .iter()
                    .flat_map(|it| [("misses inside", &it.misses), ("hits outside", &it.hits)]);
                let depths = depths.map(move |(what, depth)| {
                    bound(
                        format!("{kernel} {scalar}: false {what}, in longest edges"),
                        depth.share,
                    )
                });
                let leaks = bound(
                    format!("{kernel} {scalar}: leaks at edges (0: none, proved)"),
                    watertight.then_some(0.0),
                );
                depths.chain([leaks])
            },
        );
        gates.chain(kernels).collect()
    }
}

impl LimitPart {
    /// In floats.
    pub fn new(
        &Assumption {
            is_most,
            name,
            limit,
        }: &Assumption,
    ) -> LimitPart {
        let limit = Some(limit.to_f64());
        let (at_least, at_most) = if is_most {
            (None, limit)
        } else {
            (limit, None)
        };
        LimitPart {
            number: name.to_owned(),
            at_least,
            at_most,
        }
    }
}

impl DomainPart {
    /// In floats.
    pub fn new(domain: &Domain) -> DomainPart {
        DomainPart {
            edge: domain.edge.to_f64(),
            reach: domain.reach.to_f64(),
            world: domain.world.to_f64(),
            direction: domain.direction.to_f64(),
            extent: domain.extent.to_f64(),
            largest_of_direction_at_least: domain.direction_floor.to_f64(),
            divisor_at_least: domain.floor.to_f64(),
            quotient_at_most: domain.quotient.to_f64(),
        }
    }
}

/// A ray that crosses a surface of two triangles and hits neither.
#[apply(part!)]
pub struct Leak {
    /// The case's name.
    pub case: String,
    /// The command that shows it.
    pub command: String,
}
