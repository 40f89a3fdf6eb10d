//! The small changes that are tried of a kernel, what is proved of each, and each as a difference between two listings of
//! what the kernel compares.

use crate::arith::Arithmetic;
use crate::audit::{EpsilonText, Row};
use crate::contract::Boundary;
use crate::kernel::{Change, Gate, Role, Scalar, Tunable, changed, in_arithmetic, refuses_at};
use crate::prove::{Domain, Effort, Judged, Searched, Summary, Symmetry, above};

/// A change to try.
pub struct Candidate {
    /// The kernel with the change.
    pub row: Row,
    /// Its name in the table.
    pub name: String,
    /// Its meaning.
    pub what: String,
}

impl Candidate {
    /// The change around the kernel; none of other epsilons or other arithmetic.
    pub fn change(&self) -> Option<Change> {
        Change::named(self.name.strip_prefix('+')?)
    }

    /// True if products are fused.
    pub fn is_fused(&self) -> bool {
        self.name == "+fma"
    }
}

/// The statements of `prove` about a row.
#[derive(Clone, Copy, Default)]
pub struct ProvedDepths {
    /// How far inside a false miss and outside a false hit can be by the edges' gates, as shares of the longest edge, in the
    /// unit domain.
    pub depths: Option<[f64; 2]>,
    /// True if no ray passes between neighbours.
    pub is_tight: bool,
}

/// The statements without a search, at these epsilons; and the bound of the edge gate's numbers.
pub fn proved<F: Searched + Scalar>(row: &Row, epsilons: &[F]) -> (ProvedDepths, Option<f64>) {
    let summary = Summary::<F>::new(row.entry, Domain::UNIT, &[], &[], Effort::NONE);
    let Ok(summary) = summary else {
        return (ProvedDepths::default(), None);
    };
    let edges = summary
        .gates
        .iter()
        .filter(|gate| gate.gate.role == Role::Edge && gate.is_margin);
    let bounds = edges.map(|gate| Some(gate.bound.as_ref().ok()?.to_f64()));
    let most = bounds
        .reduce(|most, bound| Some(most?.max(bound?)))
        .flatten();
    let effort = (&[][..], Effort::NONE);
    let judged = Judged::new(row.entry, &summary, epsilons, &[Domain::UNIT], effort);
    let depths = judged.and_then(|judged| {
        let [misses, hits] = [judged.verdicts.misses, judged.verdicts.hits];
        Some([misses.ok()?.share, hits.ok()?.share])
    });
    let is_tolerant = |(gate, e): (&Gate, &F)| gate.role != Role::Edge || *e <= F::zero();
    let is_tight = summary.symmetry == Symmetry::ExactSigns
        && row.entry.info.gates.iter().zip(epsilons).all(is_tolerant);
    (ProvedDepths { depths, is_tight }, most)
}

/// The changes to try of a kernel, the smallest first.
pub fn candidates<F: Scalar>(row: &Row, bound: Option<f64>) -> Vec<Candidate> {
    let gates = row.entry.info.gates;
    let mut all = Vec::new();
    let mut of_epsilons = |text: &dyn Fn(usize) -> Option<String>, what: &str| {
        let mut epsilons = row.epsilons.clone();
        let mut words = Vec::new();
        for (i, epsilon) in epsilons.iter_mut().enumerate() {
            if let Some(text) = text(i) {
                words.push(format!("{}={text}", gates[i].name));
                *epsilon = EpsilonText::Decimal(text);
            }
        }
        if !words.is_empty() {
            let row = Row {
                epsilons,
                ..row.clone()
            };
            all.push(Candidate {
                row,
                name: words.join(","),
                what: what.to_owned(),
            });
        }
    };
    let value = |i: usize| row.epsilons[i].value::<F>().map_or(0.0, F::to_f64);
    of_epsilons(
        &|i| (value(i) != 0.0).then(|| "0".to_owned()),
        "Without epsilons",
    );
    let is_edge = |i: usize| gates[i].role == Role::Edge && gates[i].epsilon == Tunable::Signed;
    if row.entry.info.contract.boundary == Boundary::Open {
        let least = if F::DIGITS == 24 { "-1e-45" } else { "-5e-324" };
        let what = "Edges count as hits: >= for >, which is an epsilon of the least float below 0";
        of_epsilons(&|i| is_edge(i).then(|| least.to_owned()), what);
    }
    if let Some(bound) = bound {
        let is_plain = |i: usize| is_edge(i) && !gates[i].dimension.has_unit();
        let what = "A tolerance at edges, as large as the rounding errors there can be in the unit domain (a scene may have larger ones)";
        of_epsilons(&|i| is_plain(i).then(|| format!("-{}", above(bound))), what);
    }
    let what = "Products are fused into sums, by the compiler or by hand";
    let fused = in_arithmetic(row.entry, Arithmetic::FMA).map(|entry| (entry, what));
    let changes = Change::ALL.into_iter().filter_map(|change| {
        let sizes = change != Change::BySize || row.epsilons.iter().any(|it| it.to_string() != "0");
        let entry = changed(row.entry, change).filter(|_| sizes)?;
        F::subject(entry).map(|_| (entry, change.about()))
    });
    for (entry, what) in fused.into_iter().chain(changes) {
        let contract = entry.info.contract;
        let contract = if contract == row.entry.info.contract {
            row.contract
        } else {
            contract
        };
        all.push(Candidate {
            row: Row {
                entry,
                contract,
                ..row.clone()
            },
            name: entry.info.name.replacen(row.entry.info.name, "", 1),
            what: what.to_owned(),
        });
    }
    all
}

/// A kernel's comparisons in order, with its epsilons; and what stands around them. Plain gates are those of the kernel
/// without the change.
fn listing(row: &Row, plain: &[Gate], change: Option<Change>, is_fused: bool) -> Vec<String> {
    let head: &[&str] = match change {
        None if is_fused => &["// compiled with -ffp-contract=fast, or with fma() by hand"],
        Some(Change::Sorted) => {
            &["sort(a, b, c);  // by x, then y, then z; u and v go with b and c"]
        }
        Some(Change::Double) => &["double o, d, a, b, c;  // from the floats; so is all below"],
        Some(Change::BySize) => &[
            "L = largest |coordinate| of b-a and c-a;",
            "D = largest |coordinate| of d;",
        ],
        _ => &[],
    };
    let mut lines: Vec<String> = head.iter().map(|line| (*line).to_owned()).collect();
    if row
        .entry
        .info
        .gates
        .iter()
        .any(|gate| gate.refuses.contains("TINY"))
    {
        lines.push("TINY = the least positive float;".to_owned());
    }
    for ((gate, plain), epsilon) in row.entry.info.gates.iter().zip(plain).zip(&row.epsilons) {
        let epsilon = epsilon.to_string();
        // Nothing times a size is nothing.
        let refuses = if epsilon == "0" {
            plain.refuses
        } else {
            gate.refuses
        };
        if change == Some(Change::Fallback) && gate.role == Role::Edge {
            let what = "the least number below == 0";
            lines.push(format!(
                "if ({what}) return the_same_in_double(o, d, a, b, c);"
            ));
        }
        lines.push(format!(
            "if ({}) miss;  // {}",
            refuses_at(refuses, &epsilon),
            gate.name
        ));
    }
    lines.extend((change == Some(Change::Ahead)).then(|| "if (t < 0) miss;".to_owned()));
    lines.push("hit;".to_owned());
    lines
}

/// The changes from a row to a candidate, as a unified diff.
pub fn patch(before: &Row, after: &Candidate) -> String {
    let gates = before.entry.info.gates;
    let old = listing(before, gates, None, false);
    let new = listing(&after.row, gates, after.change(), after.is_fused());
    let names = [before, &after.row].map(|row| row.flags().replacen("--kernel ", "", 1));
    let mut lines = vec![
        format!("--- {}", names[0]),
        format!("+++ {}", names[1]),
        format!("@@ -1,{} +1,{} @@", old.len(), new.len()),
    ];
    let mut rest = &new[..];
    for line in &old {
        match rest.iter().position(|it| it == line) {
            Some(place) => {
                lines.extend(rest[..place].iter().map(|line| format!("+{line}")));
                lines.push(format!(" {line}"));
                rest = &rest[place + 1..];
            }
            None => lines.push(format!("-{line}")),
        }
    }
    lines.extend(rest.iter().map(|line| format!("+{line}")));
    lines.join("\n")
}
