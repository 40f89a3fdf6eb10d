//! Certificates: every number of a proof as text, for a checker that shares nothing with the prover.
//!
//! The format is described in docs/guide/proof.md.

use super::bound::Ratio;
use super::forms::Leaf;
use super::formula::{Formula, Maximum, Source, Step};
use super::run::cone;
use super::watertight::symmetry_of;
use super::{Domain, Dyadic, Format, Lemma, Limit, Names, Rule, Symmetry};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::kernel::{Gate, Path, Role};
use std::collections::BTreeSet;
use std::fmt::{self, Display, Write};

impl Display for Dyadic {
    /// `m` or `m*2^e`, the mantissa odd.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.parts() {
            (mantissa, 0) => write!(f, "{mantissa}"),
            (mantissa, exponent) => write!(f, "{mantissa}*2^{exponent}"),
        }
    }
}

/// A claim about a number: a gate compares it, and what else its lines say of it.
pub struct Claim<'a> {
    /// The gate's name.
    pub gate: &'a str,
    /// The number.
    pub place: Place,
    /// The claim about the two sides of an edge.
    pub symmetry: Symmetry,
    /// The orders of inputs that its proof supposes.
    pub orders: &'a BTreeSet<(u8, u8)>,
    /// The names of axes and vertices under which gates compare it too.
    pub also: &'a [Names],
}

/// The symmetry that is claimed of a number of this gate.
pub fn symmetry_at(gate: &Gate, path: &Path, place: Place) -> Symmetry {
    if gate.role == Role::Edge {
        symmetry_of(path, place)
    } else {
        Symmetry::None
    }
}

/// The first lines: the kernel's name, its arithmetic included, `f32` or `f64`, and the format of the floats.
pub fn heading(kernel: &str, scalar: &str, format: Format) -> String {
    let Format {
        digits,
        smallest,
        largest,
    } = format;
    format!("hairline proof 3\nkernel {kernel} {scalar}\nformat {digits} {smallest} {largest}\n")
}

/// The domain of the programs that follow.
pub fn domain(domain: &Domain) -> String {
    let Domain {
        edge,
        reach,
        world,
        direction,
        extent,
        direction_floor,
        floor,
        quotient,
        ..
    } = domain;
    format!(
        "domain edge {edge} reach {reach} world {world} direction {direction} extent {extent} \
         direction-floor {direction_floor} floor {floor} quotient {quotient}\n"
    )
}

/// The operations of a number, one a line.
pub fn operations(path: &Path, place: Place) -> String {
    text_of(&cone(&path.operations, place).operations)
}

fn text_of(operations: &[Operation]) -> String {
    let line = |(place, operation)| format!("op {place} {}\n", operation_text(operation));
    operations.iter().enumerate().map(line).collect()
}

/// One program: the operations of a number, what its proof supposes, the lemmas in order, and what they show.
pub fn program(path: &Path, lemmas: &[Lemma], claim: &Claim) -> String {
    let cone = cone(&path.operations, claim.place);
    let writer = Writer {
        places: &cone.places,
    };
    let mut text = format!("program\n{}", text_of(&cone.operations));
    let orders = claim.orders.iter().map(|(a, b)| format!("order {a} {b}"));
    let also = claim.also.iter().map(|names| format!("also {names}"));
    for line in orders.chain(writer.limits(lemmas)).chain(also) {
        writeln!(text, "{line}").expect("a string");
    }
    text.extend(lemmas.iter().map(|lemma| writer.lemma(lemma)));
    let symmetry = match claim.symmetry {
        Symmetry::None => "",
        Symmetry::Negatives => " opposite",
        Symmetry::ExactSigns => " signs",
    };
    write!(text, "claim {}{symmetry}\nend\n", claim.gate).expect("a string");
    text
}

/// An operation in words.
pub(super) fn operation_text<P: Copy + Display>(operation: &Operation<P>) -> String {
    match *operation {
        Operation::Input(i) => format!("input {i}"),
        Operation::Number(value) => format!("number {value}"),
        Operation::Add(a, b) => format!("add {a} {b}"),
        Operation::Sub(a, b) => format!("sub {a} {b}"),
        Operation::Mul(a, b) => format!("mul {a} {b}"),
        Operation::Div(a, b) => format!("div {a} {b}"),
        Operation::Neg(a) => format!("neg {a}"),
        Operation::Abs(a) => format!("abs {a}"),
        Operation::Sqrt(a) => format!("sqrt {a}"),
        Operation::Fma(a, b, c) => format!("fma {a} {b} {c}"),
        Operation::Minor(a, b, c, d) => format!("minor {a} {b} {c} {d}"),
    }
}

/// A comparison in words.
pub(super) fn comparison_text(comparison: &Comparison) -> String {
    match comparison {
        Comparison::Less(a, b) => format!("less {a} {b}"),
        Comparison::AtMost(a, b) => format!("at-most {a} {b}"),
        Comparison::Zero(a) => format!("zero {a}"),
        Comparison::Negative(a) => format!("negative {a}"),
    }
}

/// Writes the lemmas of a number.
struct Writer<'a> {
    /// Where each operation of the path went.
    places: &'a [Option<Place>],
}

impl Writer<'_> {
    fn at(&self, place: Place) -> Place {
        self.places[place as usize].expect("a proof of a number uses what it is made of")
    }

    /// The limits of divisors and quotients that stand in place of the domain's.
    fn limits(&self, lemmas: &[Lemma]) -> BTreeSet<String> {
        let line = |word: &str, place: Place, limit: Limit| match limit {
            Limit::Domain(_) => None,
            Limit::Scene(_, size) | Limit::Own(size) => {
                Some(format!("{word} {} {size}", self.at(place)))
            }
        };
        let down_to = |place: Place, x: Dyadic| format!("down-to {} {x}", self.at(place));
        let of_lemma = |lemma: &Lemma| match lemma.rule {
            Rule::Sum => [None, None, None],
            Rule::Unit { length, floor, .. } => [line("at-least", length, floor), None, None],
            Rule::Quotient {
                divisor,
                floor,
                most,
                below,
                ..
            } => [
                line("at-least", divisor, floor),
                line("at-most", lemma.place, most),
                below.map(|x| down_to(lemma.place, x)),
            ],
        };
        lemmas.iter().flat_map(of_lemma).flatten().collect()
    }

    fn lemma(&self, lemma: &Lemma) -> String {
        let rule = match lemma.rule {
            Rule::Sum => "sum".to_owned(),
            Rule::Quotient { twice, ratio, .. } => {
                let what = match ratio {
                    Ratio::One => "quotient",
                    Ratio::Sum => "sum-of-quotients",
                    Ratio::Rest => "rest-of-quotients",
                };
                format!("{what}{}", if twice { "-by-reciprocal" } else { "" })
            }
            Rule::Unit { .. } => "unit".to_owned(),
        };
        let mut text = format!("lemma {} {rule}\n", self.at(lemma.place));
        text.push_str(&self.formula(&lemma.formula, &lemma.maximum));
        let bound = &lemma.bound;
        writeln!(
            text,
            "size {}\ncomputed {}\nerror {}",
            bound.size, bound.computed, bound.error
        )
        .expect("a string");
        text
    }

    fn formula(&self, formula: &Formula, maximum: &Maximum) -> String {
        let mut text = String::new();
        for source in &formula.sources {
            let source = match *source {
                Source::Leaf(Leaf::Point(p, axis)) => format!("point {p} {axis}"),
                Source::Leaf(Leaf::Difference(p, q, axis)) => format!("difference {p} {q} {axis}"),
                Source::Leaf(Leaf::Direction(axis)) => format!("direction {axis}"),
                Source::Leaf(Leaf::End(end)) => format!("end {end}"),
                Source::Boxed(p, axis) => format!("boxed {p} {axis}"),
                Source::Cut(place) => format!("cut {}", self.at(place)),
                Source::Part(place) => format!("part {}", self.at(place)),
                Source::Quotient => "quotient".to_owned(),
            };
            writeln!(text, "variable {source}").expect("a string");
        }
        for (i, step) in formula.steps.iter().enumerate() {
            writeln!(text, "step {}", self.step(formula, i, step)).expect("a string");
        }
        let relative = formula.relative.iter().enumerate().filter(|(_, yes)| **yes);
        let relative: Vec<String> = relative.map(|(i, _)| i.to_string()).collect();
        if !relative.is_empty() {
            writeln!(text, "relative {}", relative.join(" ")).expect("a string");
        }
        if !formula.steps.is_empty() {
            let corner = maximum
                .corner
                .iter()
                .map(|minus| if *minus { '-' } else { '+' });
            writeln!(text, "corner {}", corner.collect::<String>()).expect("a string");
            writeln!(text, "first {}", maximum.first).expect("a string");
            writeln!(text, "rest {}", maximum.rest).expect("a string");
        }
        text
    }

    fn step(&self, formula: &Formula, i: usize, step: &Step) -> String {
        let place = formula.places[i].map_or("-".to_owned(), |place| self.at(place).to_string());
        let operation = match *step {
            Step::Variables(ref sum) => {
                let term =
                    |(v, sign): &(usize, i8)| format!("{}{v}", if *sign < 0 { '-' } else { '+' });
                format!(
                    "variables {}",
                    sum.iter().map(term).collect::<Vec<_>>().join(" ")
                )
            }
            Step::Of(ref operation) => operation_text(operation),
        };
        format!("{place} {operation}")
    }
}
