//! Programs as FPCore 2.0 (fpbench.org), for other people's tools.

use super::{Domain, Dyadic, Format, Prover};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::kernel::Path;
use num_bigint::BigInt;
use std::fmt::Write;

/// The numbers of a case as arguments.
const INPUTS: [&str; 17] = [
    "ox", "oy", "oz", "dx", "dy", "dz", "ax", "ay", "az", "bx", "by", "bz", "cx", "cy", "cz",
    "tmin", "tmax",
];

/// The operations that a number needs, its own last.
fn needed(path: &Path, place: Place) -> Vec<Place> {
    let mut is_needed = vec![false; place as usize + 1];
    is_needed[place as usize] = true;
    for at in (0..=place).rev() {
        if is_needed[at as usize] {
            for operand in path.operations[at as usize].operands() {
                is_needed[operand as usize] = true;
            }
        }
    }
    (0..=place).filter(|at| is_needed[*at as usize]).collect()
}

/// A number of a program: a core whose value is, bit for bit, what the program computes on its path. Its
/// precondition is the domain, and the path's comparisons of inputs; comparisons of computed numbers are
/// left out, as they choose a path and do not change what it computes.
pub fn fpcore(path: &Path, place: Place, domain: Domain, format: Format, name: &str) -> String {
    let places = needed(path, place);
    let precision = if format == Format::F32 { "binary32" } else { "binary64" };
    let inputs: Vec<u8> = (0..INPUTS.len() as u8).filter(|i| is_used(path, &places, *i)).collect();
    let arguments: Vec<&str> = inputs.iter().map(|i| INPUTS[usize::from(*i)]).collect();
    let mut text = format!("(FPCore ({})\n", arguments.join(" "));
    let name = name.replace('\\', "\\\\").replace('"', "\\\"");
    writeln!(text, "  :name \"{name}\"\n  :precision {precision}\n  :round nearestEven")
        .expect("a string");
    let conditions = conditions(path, &places, &inputs, domain, format);
    writeln!(text, "  :pre (and\n    {})", conditions.join("\n    ")).expect("a string");
    let bindings: Vec<String> = places
        .iter()
        .filter(|at| !is_atom(path.operations[**at as usize]))
        .map(|at| format!("(r{at} {})", expression(path.operations[*at as usize], path, format)))
        .collect();
    if bindings.is_empty() {
        writeln!(text, "  {})", reference(path, place)).expect("a string");
    } else {
        let bindings = bindings.join("\n         ");
        writeln!(text, "  (let* ({bindings})\n    {}))", reference(path, place)).expect("a string");
    }
    text
}

fn is_used(path: &Path, places: &[Place], input: u8) -> bool {
    places.iter().any(|at| path.operations[*at as usize] == Operation::Input(input))
}

fn is_atom(operation: Operation) -> bool {
    matches!(operation, Operation::Input(_) | Operation::Number(_))
}

fn reference(path: &Path, place: Place) -> String {
    match path.operations[place as usize] {
        Operation::Input(i) => INPUTS[usize::from(i)].to_owned(),
        Operation::Number(value) => value.to_string(),
        _ => format!("r{place}"),
    }
}

fn expression(operation: Operation, path: &Path, format: Format) -> String {
    written(operation, format, &|place| reference(path, place))
}

/// An operation on operands that are written somehow.
fn written(operation: Operation, format: Format, of: &dyn Fn(Place) -> String) -> String {
    match operation {
        Operation::Input(i) => INPUTS[usize::from(i)].to_owned(),
        Operation::Number(value) => value.to_string(),
        Operation::Add(a, b) => format!("(+ {} {})", of(a), of(b)),
        Operation::Sub(a, b) => format!("(- {} {})", of(a), of(b)),
        Operation::Mul(a, b) => format!("(* {} {})", of(a), of(b)),
        Operation::Div(a, b) => format!("(/ {} {})", of(a), of(b)),
        Operation::Neg(a) => format!("(- {})", of(a)),
        Operation::Abs(a) => format!("(fabs {})", of(a)),
        Operation::Sqrt(a) => format!("(sqrt {})", of(a)),
        Operation::Fma(a, b, c) => format!("(fma {} {} {})", of(a), of(b), of(c)),
        Operation::Minor(a, b, c, d) => {
            let [a, b, c, d] = [a, b, c, d].map(of);
            if format == Format::F32 {
                format!("(cast (! :precision binary64 (- (* {a} {b}) (* {c} {d}))))")
            } else {
                format!(
                    "(let* ((p (* {a} {b})) (q (* {c} {d}))) \
                     (+ (- p q) (- (fma {a} {b} (- p)) (fma {c} {d} (- q)))))"
                )
            }
        }
    }
}

/// A number without sharing or rounding, for preconditions.
fn tree(path: &Path, place: Place, format: Format) -> String {
    written(path.operations[place as usize], format, &|operand| tree(path, operand, format))
}

fn conditions(
    path: &Path,
    places: &[Place],
    inputs: &[u8],
    domain: Domain,
    format: Format,
) -> Vec<String> {
    let mut conditions = Vec::new();
    for i in inputs {
        let bound = match i {
            3..=5 => domain.direction,
            15.. => domain.extent,
            _ => domain.world,
        };
        let (bound, name) = (rational(bound), INPUTS[usize::from(*i)]);
        conditions.push(format!("(<= -{bound} {name} {bound})"));
    }
    // Differences of each two points that are used, axis by axis.
    let points: Vec<u8> = inputs.iter().copied().filter(|i| !matches!(i, 3..=5 | 15..)).collect();
    for (k, p) in points.iter().enumerate() {
        for q in points[..k].iter().filter(|q| *q % 3 == p % 3) {
            let (a, b) = (INPUTS[usize::from(*p)], INPUTS[usize::from(*q)]);
            let bound = rational(if *q < 3 { domain.reach } else { domain.edge });
            conditions.push(format!("(<= -{bound} (- {a} {b}) {bound})"));
        }
    }
    // Exact sizes of divisors and of what is under a root: without rounding.
    let prover = Prover::new(path, domain, format);
    let mut floors: Vec<(Place, Dyadic)> = Vec::new();
    for at in places {
        let (of, floor) = match path.operations[*at as usize] {
            Operation::Div(_, divisor) => (divisor, prover.floor(divisor).size()),
            Operation::Sqrt(square) => (square, {
                let floor = prover.floor(*at).size();
                floor * floor
            }),
            _ => continue,
        };
        if !floors.iter().any(|(known, _)| *known == of) {
            floors.push((of, floor));
        }
    }
    for (of, floor) in floors {
        let size = tree(path, of, Format::F32).replace(":precision binary64", ":precision real");
        conditions.push(format!("(! :precision real (<= {} (fabs {size})))", rational(floor)));
    }
    conditions.extend(path.decisions.iter().filter_map(|(comparison, yes)| {
        let places = comparison.places();
        let is_exact = places.iter().all(|place| {
            needed(path, *place).iter().all(|at| {
                let operation = path.operations[*at as usize];
                is_atom(operation) || matches!(operation, Operation::Neg(_) | Operation::Abs(_))
            })
        });
        let is_known = places.iter().flat_map(|place| needed(path, *place)).all(|at| {
            !matches!(path.operations[at as usize], Operation::Input(i) if !inputs.contains(&i))
        });
        let of = |place: Place| tree(path, place, Format::F32);
        let text = match *comparison {
            Comparison::Less(a, b) => format!("(< {} {})", of(a), of(b)),
            Comparison::AtMost(a, b) => format!("(<= {} {})", of(a), of(b)),
            Comparison::Zero(a) => format!("(== {} 0)", of(a)),
            Comparison::Negative(a) => format!("(signbit {})", of(a)),
        };
        let text = if *yes { text } else { format!("(not {text})") };
        (is_exact && is_known).then_some(text)
    }));
    conditions
}

/// A bound as an exact rational.
fn rational(x: Dyadic) -> String {
    let (mantissa, exponent) = x.parts();
    let power = BigInt::from(1) << exponent.unsigned_abs();
    if exponent < 0 {
        format!("{mantissa}/{power}")
    } else {
        (BigInt::from(mantissa) * power).to_string()
    }
}
