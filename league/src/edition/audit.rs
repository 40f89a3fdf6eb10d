//! What one audit says of an entrant.

use crate::Entrant;
use hairline::ScalarName;
use hairline::internals::arith::Float;
use hairline::internals::case::Case;
use hairline::internals::corpus::lines::AnyCase;
use hairline::internals::record::{
    Example, FindingKind, FindingPart, KernelResult, Promised, Record,
};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// An entrant's file of an edition.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EntrantResult {
    pub kernel: String,
    pub package: String,
    pub version: String,
    /// The function that is called.
    pub function: String,
    /// Sentences of its documentation, word for word; empty where nothing is promised.
    pub claim: Vec<String>,
    /// Where they stand.
    pub page: String,
    pub note: String,
    /// What is asked of it, in hairline's words.
    pub contract: String,
    /// Pages about it in league/findings.
    pub findings: Vec<String>,
    /// Cases of each family.
    pub cases: u64,
    /// The day, the machine and the program of the audit.
    pub audited: String,
    pub scalars: BTreeMap<String, ScalarResult>,
}

/// An entrant in one scalar.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ScalarResult {
    /// `held`, `rounding`, `refuted`, `refuted by size`, or `none`.
    pub verdict: String,
    /// False misses and false hits by group of families: [`GROUPS`].
    pub groups: BTreeMap<String, [Share; 2]>,
    /// Of the rays through edges and vertices that triangles share: hits of none and of more than one.
    pub cracks: Share,
    pub doubles: Share,
    /// Cracks where coordinates of about 1 stand beside some of about 2^-53; since league-2026.4.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cracks_beside_noise: Option<Share>,
    /// The deepest false miss and false hit of the groups that count for the verdict.
    pub deepest_miss: Option<Depth>,
    pub deepest_hit: Option<Depth>,
    /// Errors of t in ulps that half and 99 % of the hits of `interior` do not exceed.
    pub t_error_ulps: Option<[f64; 2]>,
    /// Right hits of ordinary groups whose t, u or v is off by more than rounding explains; since league-2026.2.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub wrong_values: Option<Share>,
    /// A ray, the way there included: the pipe of a process, or the scene that is made for one triangle.
    pub nanoseconds: Option<f64>,
}

/// So many of so many.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Share {
    pub count: u64,
    pub of: u64,
}

impl Share {
    fn add(&mut self, count: u64, of: u64) {
        *self = Share {
            count: self.count + count,
            of: self.of + of,
        };
    }
}

/// How far a case with a false verdict is from one where that verdict would be right.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Depth {
    /// In longest edges of the triangle.
    pub edges: f64,
    /// In ulps of the largest coordinate.
    pub ulps: f64,
    pub family: String,
    pub case: String,
    /// Origin, direction, a, b, c, interval: bit patterns in hexadecimal.
    pub bits: String,
    /// Shows the case again.
    pub command: String,
}

impl Depth {
    /// The case, whose bits are those of a scalar: `o=…,…,… d=… a=… b=… c=… t=…,…`, in hexadecimal.
    pub fn case(&self, scalar: &str) -> AnyCase {
        match scalar {
            "f32" => AnyCase::F32(self.numbers(|bits| f32::from_bits(bits as u32))),
            _ => AnyCase::F64(self.numbers(f64::from_bits)),
        }
    }

    fn numbers<F: Float>(&self, number: impl Fn(u64) -> F) -> Case<F> {
        let words = self.bits.split(' ').flat_map(|word| word[2..].split(','));
        let bits = words.map(|word| u64::from_str_radix(word, 16).expect("a record's bits"));
        let numbers: Vec<F> = bits.map(number).collect();
        let triple = |i: usize| [numbers[i], numbers[i + 1], numbers[i + 2]];
        let corners = [triple(6), triple(9), triple(12)];
        Case::new(triple(0), triple(3), corners).on(numbers[15], numbers[16])
    }
}

/// Families that ask alike. The last group, at the ends of the exponent range, counts for no verdict: what
/// is right there can be disputed.
pub const GROUPS: &[(&str, &[&str])] = &[
    (
        "plain",
        &["interior", "outside", "behind", "axis-aligned", "lattice"],
    ),
    (
        "edges",
        &["edge-exact", "edge-near", "shared-edge", "polygon"],
    ),
    (
        "vertices",
        &["vertex-exact", "vertex-near", "fan", "vertex-fan"],
    ),
    ("parallel", &["grazing", "sliver", "parallel-off"]),
    (
        "start",
        &["origin-on", "origin-near", "secondary-ray", "interval-ends"],
    ),
    ("size", &["tiny", "huge", "far", "direction-length"]),
    ("range", &["mixed-scale", "range-ends", NOISE]),
];

/// A false verdict within this many ulps of the largest coordinate is a matter of the input's last digits.
const HELD: f64 = 4.0;

impl EntrantResult {
    /// From the record of an entrant's audit.
    pub fn of(entrant: &Entrant, record: &Record, day: &str) -> Result<EntrantResult, String> {
        let wrong = |message: &str| format!("{}: {message}", entrant.name);
        let [plan] = &record.result.plan.rows[..] else {
            return Err(wrong("not one row"));
        };
        if plan.kernel != entrant.name {
            return Err(wrong(&format!("its kernel calls itself '{}'", plan.kernel)));
        }
        let results = |scalar: ScalarName| -> Vec<&KernelResult> {
            record
                .result
                .results
                .iter()
                .filter(|result| result.scalar == scalar)
                .collect()
        };
        let scalars = ScalarName::ALL
            .into_iter()
            .filter(|scalar| !results(*scalar).is_empty());
        let words = |list: &[&str]| list.iter().map(|word| (*word).to_owned()).collect();
        let provenance = &record.provenance;
        Ok(EntrantResult {
            kernel: entrant.name.to_owned(),
            package: entrant.package.to_owned(),
            version: entrant.version.to_owned(),
            function: entrant.function.to_owned(),
            claim: words(entrant.claim),
            page: entrant.page.to_owned(),
            note: entrant.note.to_owned(),
            contract: plan.contract.clone(),
            findings: words(entrant.findings),
            cases: record
                .result
                .sources
                .iter()
                .map(|source| source.indices)
                .max()
                .unwrap_or(0),
            audited: format!("{day}, {}, {}", provenance.target, provenance.tool),
            scalars: scalars
                .map(|scalar| {
                    let times = provenance.kernel_nanoseconds.get(&scalar);
                    let time = times.and_then(|times| times.values().next()).copied();
                    (
                        scalar.to_string(),
                        scalar_result(entrant, scalar.name(), &results(scalar), time),
                    )
                })
                .collect(),
        })
    }
}

fn scalar_result(
    entrant: &Entrant,
    scalar: &str,
    results: &[&KernelResult],
    nanoseconds: Option<f64>,
) -> ScalarResult {
    let of_group = |group: &str| {
        let (_, families) = GROUPS
            .iter()
            .find(|(name, _)| *name == group)
            .expect("a group");
        results
            .iter()
            .copied()
            .filter(|result| families.contains(&result.family.as_str()))
    };
    let shares = |group: &str| {
        let mut shares = [Share::default(); 2];
        for result in of_group(group) {
            shares[0].add(
                result.total.false_misses.count,
                result.total.false_misses.of,
            );
            shares[1].add(result.total.false_hits.count, result.total.false_hits.of);
        }
        shares
    };
    let (noise, others): (Vec<_>, Vec<_>) =
        results.iter().copied().partition(|it| it.family == NOISE);
    let [noise, ordinary_sizes] = [noise, others].map(|results| Across::of(&results));
    let deepest = |finding: FindingKind, groups: &[&str]| {
        let results = groups.iter().flat_map(|group| of_group(group));
        let depths = results.flat_map(|result| {
            let parts = result
                .findings
                .iter()
                .filter(|part| part.finding == finding);
            parts.filter_map(|part| depth(entrant, &result.family, part))
        });
        depths.max_by(|a, b| a.ulps.total_cmp(&b.ulps))
    };
    const ORDINARY: &[&str] = &["plain", "edges", "vertices", "parallel", "start"];
    let findings = [FindingKind::FalseMiss, FindingKind::FalseHit];
    let [ordinary, sized] = [ORDINARY, &["size"]].map(|groups| {
        let depths = findings
            .into_iter()
            .filter_map(|finding| deepest(finding, groups));
        depths.map(|depth| depth.ulps).fold(0.0, f64::max)
    });
    let half = half_of_digits(scalar);
    let verdict = match () {
        () if entrant.claim.is_empty() => "none",
        () if ordinary_sizes.breaks_its_promise() => "refuted",
        () if ordinary > half && !entrant.only_shared => "refuted",
        () if noise.breaks_its_promise() => "refuted by size",
        () if entrant.only_shared => "held",
        () if sized > half => "refuted by size",
        () if ordinary.max(sized) > HELD => "rounding",
        () => "held",
    };
    let mut wrong_values = Share::default();
    for result in ORDINARY.iter().flat_map(|group| of_group(group)) {
        wrong_values.add(
            result.total.wrong_values.count,
            result.total.wrong_values.of,
        );
    }
    let all = &[ORDINARY, &["size"]].concat();
    let interior = results.iter().find(|result| result.family == "interior");
    let t = interior.and_then(|result| result.accuracy.get("t"));
    ScalarResult {
        verdict: verdict.to_owned(),
        groups: GROUPS
            .iter()
            .map(|(name, _)| ((*name).to_owned(), shares(name)))
            .collect(),
        cracks: ordinary_sizes.cracks,
        doubles: ordinary_sizes.doubles,
        cracks_beside_noise: (0 < noise.cracks.of).then_some(noise.cracks),
        deepest_miss: deepest(FindingKind::FalseMiss, all),
        deepest_hit: deepest(FindingKind::FalseHit, all),
        t_error_ulps: t.and_then(|t| Some([t.median?, t.percent_99?])),
        wrong_values: (0 < wrong_values.of).then_some(wrong_values),
        nanoseconds: nanoseconds.map(f64::round),
    }
}

/// The family whose coordinates of about 1 stand beside some of about 2^-53. Its leaks have a number of their own.
const NOISE: &str = "noise";

/// Rays through edges and vertices that triangles share, and what the kernel promises about them.
struct Across {
    cracks: Share,
    doubles: Share,
    promised: Promised,
}

impl Across {
    fn of(results: &[&KernelResult]) -> Across {
        let mut sum = Across {
            cracks: Share::default(),
            doubles: Share::default(),
            promised: Promised::Nothing,
        };
        for part in results.iter().filter_map(|result| result.across.as_ref()) {
            sum.cracks.add(part.cracks.count, part.cracks.of);
            sum.doubles.add(part.doubles.count, part.doubles.of);
            sum.promised = part.promised;
        }
        sum
    }

    fn breaks_its_promise(&self) -> bool {
        match self.promised {
            Promised::ExactlyOne => 0 < self.cracks.count + self.doubles.count,
            Promised::AtLeastOne => 0 < self.cracks.count,
            _ => false,
        }
    }
}

/// The ulps beyond which half of the digits of a scalar are right, or fewer.
pub fn half_of_digits(scalar: &str) -> f64 {
    if scalar == "f32" {
        2f64.powi(12)
    } else {
        2f64.powf(26.5)
    }
}

/// Of the worst case of a finding: how far it is from where the verdict would be right.
fn depth(entrant: &Entrant, family: &str, part: &FindingPart) -> Option<Depth> {
    let severity = part.worst.severity.as_ref()?;
    let along = severity.along.unwrap_or(f64::INFINITY);
    // To be missed because of where the ray starts and ends alone: the line passes through the triangle.
    let is_off_an_end = severity.off_end.is_some() && !part.class.starts_with("outside");
    let edges = match part.finding {
        FindingKind::FalseHit if is_off_an_end => along,
        FindingKind::FalseHit => severity.in_space,
        _ => severity.in_space.min(along),
    };
    let ulps = edges * severity.edge_in_ulps;
    (edges.is_finite() && ulps.is_finite()).then(|| Depth {
        edges,
        ulps,
        family: family.to_owned(),
        case: part.worst.case.clone(),
        bits: part.worst.bits.clone(),
        command: command(entrant, &part.worst),
    })
}

/// The command that shows an example, with the program that knows the kernel.
fn command(entrant: &Entrant, example: &Example) -> String {
    example.command.replacen("hairline", entrant.program(), 1)
}
