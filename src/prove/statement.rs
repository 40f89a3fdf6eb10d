//! From bounds to sentences: which epsilons are proved to do what.

use super::sizes::BySize;
use super::summary::{GateSummary, Summary, Witness, format_of};
use super::witness::Searched;
use super::{Domain, Proof, Quantity, Scene, Symmetry, Uses};
use crate::kernel::{Entry, Role, Scalar};

/// An epsilon, and where it comes from.
pub type Published = (String, f64);

/// The sentences about a gate; of each published epsilon it is said how far it carries.
pub fn statements<F: Searched + Scalar>(
    entry: &Entry,
    summary: &Summary<F>,
    gate: &GateSummary<F>,
    scene: Option<&Scene>,
    published: &[Published],
) -> Vec<String> {
    let bound = match &gate.bound {
        Ok(bound) => *bound,
        Err(why) => return vec![format!("No bound: {why}.")],
    };
    let beta = bound.to_f64();
    let unit = summary.format.unit().to_f64();
    let mut lines = vec![match &gate.witnesses[0] {
        Some(Witness { score, .. }) => format!(
            "What it compares is never wrong by more than {} ({:.2} u); {} ({:.2} u) is known.",
            above(beta),
            beta / unit,
            below(*score),
            score / unit
        ),
        None => format!(
            "What it compares is never wrong by more than {} ({:.2} u).",
            above(beta),
            beta / unit
        ),
    }];
    let tunable = gate.gate.epsilon != crate::kernel::Tunable::Fixed;
    match gate.gate.role {
        _ if !gate.is_margin => lines.push(format!(
            "At an epsilon of 0 this gate decides otherwise than exact arithmetic only where the exact number \
             is within {} of 0.",
            above(beta)
        )),
        Role::Parallel if tunable => {
            parallel(gate, scene, beta, &mut lines);
            for epsilon in published.iter().filter(|(_, e)| *e > 0.0) {
                lines.push(about_epsilon(entry, summary, gate, scene, epsilon, beta));
            }
        }
        Role::Edge => edge(gate, scene, beta, tunable, &mut lines),
        _ if tunable => lines.push(format!(
            "An epsilon below -{0} loses nothing that the exact formula accepts; one above {0} accepts nothing that \
             it refuses.",
            above(beta)
        )),
        _ => {}
    }
    lines
}

fn parallel<F>(gate: &GateSummary<F>, scene: Option<&Scene>, beta: f64, lines: &mut Vec<String>) {
    let passes = gate.witnesses[1].as_ref().filter(|witness| witness.score > 0.0);
    let known = passes.map_or(String::new(), |witness| {
        format!(" A parallel ray is known that reaches {}.", below(witness.score))
    });
    lines.push(format!(
        "An epsilon above {} refuses every ray that is exactly parallel.{known}",
        above(beta)
    ));
    lines.push(match scene {
        None => format!(
            "With an epsilon e this gate refuses a hit only where the exact value is below e + {}.",
            above(beta)
        ),
        Some(scene) => {
            format!("With that epsilon this gate refuses hits {}.", cost(scene, 2.0 * beta))
        }
    });
}

/// Where the exact |det| can be below a number.
fn cost(scene: &Scene, value: f64) -> String {
    // |det| = 2 * area * |d| * sine of the angle to the plane.
    let sine = value / scene.least_shape();
    if sine < 1.0 {
        let angle = libm::asin(sine).to_degrees();
        format!("only where the ray meets the smallest triangles at less than {}", degrees(angle))
    } else {
        "at any angle on the smallest triangles: their determinants are no larger than that"
            .to_owned()
    }
}

/// How far one published epsilon carries.
fn about_epsilon<F: Searched + Scalar>(
    entry: &Entry,
    summary: &Summary<F>,
    gate: &GateSummary<F>,
    scene: Option<&Scene>,
    (name, value): &Published,
    beta: f64,
) -> String {
    if let Some(scene) = scene {
        let refuses = if *value > beta {
            "refuses every parallel ray of this scene"
        } else {
            "is not proved to refuse every parallel ray of this scene"
        };
        return format!("e = {name} {refuses}; it refuses hits {}.", cost(scene, value + beta));
    }
    let what = if gate.uses.edge { "edges" } else { "vectors from the origin to the vertices" };
    let mut sizes = BySize::<F>::new(entry, gate.index);
    let proved = sizes.as_mut().and_then(|sizes| sizes.largest(*value)).map_or_else(
        || format!("e = {name} is proved for no size of {what}."),
        |size| {
            format!(
                "e = {name} is proved to refuse every parallel ray where coordinates of {what} are at most {}.",
                below(size.to_f64())
            )
        },
    );
    // A power of two changes no rounding, so the known case passes e at every larger power of two.
    let passes = gate.witnesses[1].as_ref().map(|witness| witness.score).filter(|x| *x > 0.0);
    let fails = passes.map(|score| {
        let bound = if gate.uses.edge { summary.domain.edge } else { summary.domain.reach };
        let power = f64::from(gate.gate.dimension.length.max(1));
        let exponent = ((value / score).log2() / power).floor() as i32 + 1;
        let size = bound.to_f64() * 2f64.powi(exponent);
        format!(" A known parallel ray passes it where they are up to {}.", above(size))
    });
    format!("{proved}{}", fails.unwrap_or_default())
}

fn edge<F>(
    gate: &GateSummary<F>,
    scene: Option<&Scene>,
    beta: f64,
    tunable: bool,
    lines: &mut Vec<String>,
) {
    if tunable {
        let lost = gate.witnesses[2].as_ref().filter(|witness| witness.score > 0.0);
        let known = lost.map_or(String::new(), |witness| {
            format!(" At {} a hit is known to be lost.", signed(-witness.score))
        });
        lines.push(format!("An epsilon below {} loses no hit at an edge.{known}", signed(-beta)));
    }
    let length = gate.gate.dimension.length;
    let depth = match scene {
        _ if length == 0 => Some(beta),
        Some(scene) if length == 2 => {
            let sine = libm::sin(scene.grazing.to_radians());
            Some(beta / (scene.least_shape() * sine))
        }
        _ => None,
    };
    let flat = scene.map_or(String::new(), |scene| {
        format!(", for rays that meet the plane at {} or more", degrees(scene.grazing))
    });
    let most = match depth {
        Some(depth) if depth >= 1.0 => {
            lines.push(format!("The bound says nothing of the smallest triangles{flat}."));
            return;
        }
        Some(depth) => format!("{} of the way across the triangle{flat}", above(depth)),
        None => format!(
            "{} / S of the way across the triangle, S being the sum of its three edge values",
            above(beta)
        ),
    };
    lines.push(format!(
        "At an epsilon of 0 this gate loses no hit deeper inside, and lets no miss through farther outside, than {most}."
    ));
}

/// What follows from the symmetry of the edge values.
pub fn about_edges(symmetry: Symmetry) -> &'static str {
    match symmetry {
        Symmetry::None => {
            "Watertight: not proved. The two triangles of an edge may compute two values of the same sign, and \
             both refuse the ray."
        }
        Symmetry::Negatives => {
            "At an edge that two consistently wound triangles share, both compute the same value with opposite \
             signs, bit for bit: at an epsilon of 0 no ray is refused by both for that edge. Nothing follows \
             for vertices, nor where a triangle faces away from its neighbour (folds)."
        }
        Symmetry::ExactSigns => {
            "Watertight, proved (short of underflow): at a shared edge both triangles compute opposite values, \
             and a value that is not zero has the sign of the exact determinant of the rounded, sheared vertices. So at an epsilon \
             of 0 the kernel decides as an exact test would on the mesh with its vertices so rounded: no ray \
             passes between the triangles of an edge, nor of a closed fan that stays closed and unfolded when \
             it is rounded. Nothing follows for folds."
        }
    }
}

/// What is proved of a gate's epsilons in the unit domain, in one sentence; none where the proof supposes more
/// than sizes of differences and directions.
pub fn in_short<F: Scalar>(entry: &Entry, gate: usize) -> Option<String> {
    let paths = F::subject(entry)?.gated()?.paths().ok()?;
    let proof = Proof::new(paths, Some(gate), Domain::UNIT, format_of::<F>());
    let beta = proof.gate(gate)?.ok()?.bound.as_ref().ok()?.error.to_f64();
    let uses = proof.quantities.iter().map(Quantity::uses).fold(Uses::default(), Uses::and);
    let is_margin = proof.quantities.iter().all(|quantity| quantity.is_margin);
    if uses.floor || uses.world || uses.extent || !is_margin {
        return None;
    }
    let of = if uses.edge { "edges" } else { "vectors from the origin to the vertices" };
    let what = match entry.info.gates[gate].role {
        Role::Parallel => format!("an e above {} refuses every exactly parallel ray", above(beta)),
        Role::Edge => format!("an e below {} loses no hit at an edge", signed(-beta)),
        _ => return None,
    };
    Some(format!("for every float with coordinates of {of} up to 0.999 and |d| <= 1: {what}"))
}

/// A positive number in three digits, not below it.
fn above(x: f64) -> String {
    short(x, true)
}

/// A positive number in three digits, not above it.
fn below(x: f64) -> String {
    short(x, false)
}

/// A number in three digits, away from zero.
fn signed(x: f64) -> String {
    if x < 0.0 { format!("-{}", above(-x)) } else { above(x) }
}

fn short(x: f64, up: bool) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string();
    }
    let exponent = x.log10().floor() as i32;
    let scale = 10f64.powi(2 - exponent);
    let digits = if up { (x * scale - 1e-9).ceil() } else { (x * scale + 1e-9).floor() };
    let (digits, exponent) =
        if digits >= 1000.0 { (100.0, exponent + 1) } else { (digits, exponent) };
    if (-2..4).contains(&exponent) {
        let decimals = (2 - exponent).max(0) as usize;
        let text = format!("{:.decimals$}", digits / 10f64.powi(2 - exponent));
        let text = if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.')
        } else {
            &text
        };
        text.to_owned()
    } else {
        format!("{:.2}e{exponent}", digits / 100.0)
    }
}

fn degrees(angle: f64) -> String {
    format!("{} degrees", above(angle))
}
