//! Certificates: every number of a proof as text, for a checker that shares nothing with the prover.
//!
//! The format is described in docs/guide/proof.md.

use super::bound::Ratio;
use super::forms::Leaf;
use super::formula::{Formula, Maximum, Step, VariableOrigin};
use super::run::{Cone, cone};
use super::watertight::symmetry_of;
use super::{Bound, Domain, Dyadic, Format, Lemma, Limit, Names, Rule, Symmetry};
use crate::arith::ScalarName;
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
pub fn heading(kernel: &str, scalar: ScalarName, format: Format) -> String {
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
    let writer = Writer { cone: &cone };
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
    let name = match operation {
        Operation::Input(i) => return format!("input {i}"),
        Operation::Number(value) => return format!("number {value}"),
        Operation::Add(..) => "add",
        Operation::Sub(..) => "sub",
        Operation::Mul(..) => "mul",
        Operation::Div(..) => "div",
        Operation::Neg(_) => "neg",
        Operation::Abs(_) => "abs",
        Operation::Sqrt(_) => "sqrt",
        Operation::Fma(..) => "fma",
        Operation::Minor(..) => "minor",
    };
    with_operands(name, operation.operands())
}

/// A comparison in words.
pub(super) fn comparison_text(comparison: &Comparison) -> String {
    let name = match comparison {
        Comparison::Less(..) => "less",
        Comparison::AtMost(..) => "at-most",
        Comparison::Zero(_) => "zero",
        Comparison::Negative(_) => "negative",
    };
    with_operands(name, comparison.places())
}

fn with_operands<P: Display>(name: &str, operands: Vec<P>) -> String {
    let mut text = name.to_owned();
    for operand in operands {
        text.push_str(&format!(" {operand}"));
    }
    text
}

/// Writes the lemmas of a number.
struct Writer<'a> {
    cone: &'a Cone,
}

impl Writer<'_> {
    fn at(&self, place: Place) -> Place {
        self.cone.at(place)
    }

    /// The limits of divisors and quotients that stand in place of the domain's.
    fn limits(&self, lemmas: &[Lemma]) -> BTreeSet<String> {
        let mut limits = BTreeSet::new();
        for lemma in lemmas {
            match lemma.rule {
                Rule::Sum => {}
                Rule::Unit { length, floor, .. } => {
                    limits.extend(self.limit("at-least", length, floor));
                }
                Rule::Quotient {
                    divisor,
                    floor,
                    most,
                    below,
                    ..
                } => {
                    limits.extend(self.limit("at-least", divisor, floor));
                    limits.extend(self.limit("at-most", lemma.place, most));
                    let below = below.map(Limit::Own);
                    limits.extend(below.and_then(|it| self.limit("down-to", lemma.place, it)));
                }
            }
        }
        limits
    }

    fn limit(&self, word: &str, place: Place, limit: Limit) -> Option<String> {
        if let Limit::Domain(_) = limit {
            return None;
        }
        Some(format!("{word} {} {}", self.at(place), limit.size()))
    }

    fn lemma(&self, lemma: &Lemma) -> String {
        let mut rule = match lemma.rule {
            Rule::Sum => "sum",
            Rule::Unit { .. } => "unit",
            Rule::Quotient { ratio, .. } => match ratio {
                Ratio::One => "quotient",
                Ratio::Sum => "sum-of-quotients",
                Ratio::Rest => "rest-of-quotients",
            },
        }
        .to_owned();
        if let Rule::Quotient { twice: true, .. } = lemma.rule {
            rule.push_str("-by-reciprocal");
        }
        let mut lines = vec![format!("lemma {} {rule}", self.at(lemma.place))];
        lines.extend(self.formula(&lemma.formula, &lemma.maximum));
        let Bound {
            size,
            computed,
            error,
        } = &lemma.bound;
        lines.push(format!("size {size}"));
        lines.push(format!("computed {computed}"));
        lines.push(format!("error {error}\n"));
        lines.join("\n")
    }

    fn formula(&self, formula: &Formula, maximum: &Maximum) -> Vec<String> {
        let mut lines = Vec::new();
        for source in &formula.origins {
            let source = self.source(source);
            lines.push(format!("variable {source}"));
        }
        for (i, step) in formula.steps.iter().enumerate() {
            let place = formula.places[i].map(|place| self.at(place).to_string());
            let place = place.unwrap_or("-".to_owned());
            lines.push(format!("step {place} {}", step_text(step)));
        }
        let mut relative: Vec<usize> = (0..formula.steps.len()).collect();
        relative.retain(|i| formula.relative[*i]);
        if !relative.is_empty() {
            lines.push(with_operands("relative", relative));
        }
        if !formula.steps.is_empty() {
            let corner: String = maximum.corner.iter().map(|minus| sign(*minus)).collect();
            lines.push(format!("corner {corner}"));
            lines.push(format!("first {}", maximum.first));
            lines.push(format!("rest {}", maximum.rest));
        }
        lines
    }

    fn source(&self, source: &VariableOrigin) -> String {
        match *source {
            VariableOrigin::Leaf(Leaf::Point(p, axis)) => format!("point {p} {axis}"),
            VariableOrigin::Leaf(Leaf::Difference(p, q, axis)) => {
                format!("difference {p} {q} {axis}")
            }
            VariableOrigin::Leaf(Leaf::Direction(axis)) => format!("direction {axis}"),
            VariableOrigin::Leaf(Leaf::End(end)) => format!("end {end}"),
            VariableOrigin::Boxed(p, axis) => format!("boxed {p} {axis}"),
            VariableOrigin::Cut(place) => format!("cut {}", self.at(place)),
            VariableOrigin::Part(place) => format!("part {}", self.at(place)),
            VariableOrigin::Quotient => "quotient".to_owned(),
        }
    }
}

fn step_text(step: &Step) -> String {
    match step {
        Step::Variables(sum) => {
            let terms = sum
                .iter()
                .map(|(v, factor)| format!("{}{v}", sign(*factor < 0)));
            with_operands("variables", terms.collect())
        }
        Step::Of(operation) => operation_text(operation),
    }
}

fn sign(is_negative: bool) -> char {
    if is_negative { '-' } else { '+' }
}
