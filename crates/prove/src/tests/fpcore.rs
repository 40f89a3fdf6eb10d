//! FPCore, read back by an evaluator that knows the standard and not the writer.

use super::super::{Domain, Format, Number, fpcore};
use crate::arith::Float;
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::case::{Case, Draw};
use crate::kernel::{Compared, Entry, Gated, KERNELS, Path, Scalar, find};

#[derive(Clone, Debug)]
enum Term {
    Atom(String),
    List(Vec<Term>),
}

fn parse(text: &str) -> Term {
    let mut open = vec![Vec::new()];
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '(' | ')' => 1,
            '"' => 2 + rest[1..].find('"').expect("the end of a string"),
            _ => rest.find(|c: char| c.is_whitespace() || "()".contains(c)).unwrap_or(rest.len()),
        };
        match first {
            '(' => open.push(Vec::new()),
            ')' => {
                let list = open.pop().expect("a parenthesis");
                open.last_mut().expect("balanced").push(Term::List(list));
            }
            _ => open.last_mut().expect("balanced").push(Term::Atom(rest[..length].to_owned())),
        }
        rest = rest[length..].trim_start();
    }
    let [mut all] = <[Vec<Term>; 1]>::try_from(open).expect("balanced");
    assert_eq!(all.len(), 1, "one core");
    all.remove(0)
}

/// The values of a core: numbers are f64 that hold the number of their context exactly; truth is 1 or 0.
struct Scope {
    names: Vec<(String, f64)>,
}

impl Scope {
    fn number(&mut self, term: &Term, precision: &str) -> f64 {
        let list = match term {
            Term::Atom(atom) => {
                let named = self.names.iter().rev().find(|(name, _)| name == atom);
                return named.map_or_else(|| literal(atom), |(_, value)| *value);
            }
            Term::List(list) => list,
        };
        let Term::Atom(head) = &list[0] else { panic!("{list:?} has no operator") };
        if head == "!" {
            let [_, Term::Atom(property), Term::Atom(inner), body] = &list[..] else { panic!() };
            assert_eq!(property, ":precision");
            return self.number(body, inner);
        }
        if head == "let*" {
            let [_, Term::List(bindings), body] = &list[..] else { panic!("{list:?}") };
            let before = self.names.len();
            for binding in bindings {
                let Term::List(binding) = binding else { panic!("{binding:?}") };
                let [Term::Atom(name), value] = &binding[..] else { panic!("{binding:?}") };
                let value = self.number(value, precision);
                self.names.push((name.clone(), value));
            }
            let result = self.number(body, precision);
            self.names.truncate(before);
            return result;
        }
        let of: Vec<f64> = list[1..].iter().map(|term| self.number(term, precision)).collect();
        let truth = |yes: bool| f64::from(u8::from(yes));
        match head.as_str() {
            "and" => truth(of.iter().all(|x| *x == 1.0)),
            "not" => 1.0 - of[0],
            "<=" => truth(of.is_sorted()),
            "<" => truth(of.windows(2).all(|pair| pair[0] < pair[1])),
            "==" => truth(of[0] == of[1]),
            "signbit" => truth(of[0].is_sign_negative()),
            _ if precision == "binary32" => {
                let of: Vec<f32> = of.iter().map(|x| *x as f32).collect();
                f64::from(rounded(head, &of))
            }
            _ => rounded(head, &of),
        }
    }
}

/// One operation of FPCore, rounded in the scalar.
fn rounded<F: Float + Number>(head: &str, of: &[F]) -> F {
    match (head, of) {
        ("+", [a, b]) => *a + b,
        ("-", [a, b]) => *a - b,
        ("-", [a]) => -*a,
        ("*", [a, b]) => *a * b,
        ("/", [a, b]) => *a / b,
        ("fma", [a, b, c]) => F::fused(a, b, c),
        ("sqrt", [a]) => a.sqrt(),
        ("fabs", [a]) => a.abs(),
        ("cast", [a]) => *a,
        _ => panic!("{head} of {of:?}"),
    }
}

fn literal(atom: &str) -> f64 {
    let number = |text: &str| text.parse::<f64>().unwrap_or_else(|_| panic!("{atom} is unknown"));
    atom.split_once('/').map_or_else(|| number(atom), |(n, d)| number(n) / number(d))
}

const NAMES: [&str; 17] = [
    "ox", "oy", "oz", "dx", "dy", "dz", "ax", "ay", "az", "bx", "by", "bz", "cx", "cy", "cz",
    "tmin", "tmax",
];

/// The value of a core on a case; its precondition must be one.
fn value(text: &str, inputs: &[f64; 17]) -> f64 {
    let Term::List(core) = parse(text) else { panic!("{text}") };
    let [Term::Atom(head), Term::List(arguments), properties @ .., body] = &core[..] else {
        panic!("{text}")
    };
    assert_eq!(head, "FPCore");
    let names = arguments.iter().map(|argument| {
        let Term::Atom(name) = argument else { panic!("{argument:?}") };
        let at = NAMES.iter().position(|known| known == name).expect("a number of a case");
        (name.clone(), inputs[at])
    });
    let mut scope = Scope { names: names.collect() };
    let mut precision = "";
    for property in properties.chunks(2) {
        match property {
            [Term::Atom(key), Term::Atom(value)] if key == ":precision" => precision = value,
            [Term::Atom(key), pre] if key == ":pre" => {
                let holds = scope.number(pre, "real");
                assert!(holds == 0.0 || holds == 1.0, "a truth");
            }
            [Term::Atom(key), Term::Atom(_)] => assert!(key == ":name" || key == ":round", "{key}"),
            _ => panic!("{property:?}"),
        }
    }
    scope.number(body, precision)
}

/// Every number of a path's program, by the operations of its floats.
pub(super) fn run<F: Float>(path: &Path, inputs: &[F; 17]) -> Vec<F> {
    let mut values: Vec<F> = Vec::with_capacity(path.operations.len());
    for operation in &path.operations {
        let of = |place: Place| values[place as usize];
        values.push(match *operation {
            Operation::Input(i) => inputs[usize::from(i)],
            Operation::Number(value) => F::from_f64(value.into()),
            Operation::Add(a, b) => of(a) + of(b),
            Operation::Sub(a, b) => of(a) - of(b),
            Operation::Mul(a, b) => of(a) * of(b),
            Operation::Div(a, b) => of(a) / of(b),
            Operation::Neg(a) => -of(a),
            Operation::Abs(a) => of(a).abs(),
            Operation::Sqrt(a) => of(a).sqrt(),
            Operation::Fma(a, b, c) => of(a).mul_add(of(b), of(c)),
            Operation::Minor(a, b, c, d) => {
                F::difference_of_products(&of(a), &of(b), &of(c), &of(d))
            }
        });
    }
    values
}

/// True if inputs of these numbers take a path.
pub(super) fn is_taken<F: Float>(path: &Path, values: &[F]) -> bool {
    let of = |place: Place| values[place as usize];
    path.decisions.iter().all(|(comparison, answer)| {
        let holds = match *comparison {
            Comparison::Less(a, b) => of(a) < of(b),
            Comparison::AtMost(a, b) => of(a) <= of(b),
            Comparison::Zero(a) => of(a).is_zero(),
            Comparison::Negative(a) => of(a).is_sign_negative(),
        };
        holds == *answer
    })
}

fn cores_compute_what_a_kernel_does<F: Scalar>(entry: &Entry, format: Format) -> usize {
    let gated: &dyn Gated<F> = F::subject(entry).expect("both scalars").gated().expect("gates");
    let paths = gated.paths().expect("recorded");
    let mut draw = Draw::new("fpcore", 1, 1);
    let mut compared = 0;
    for round in 0..16 {
        // Every other case on a lattice, where determinants vanish.
        let mut number = || match round % 2 {
            0 => draw.symmetric::<F>(),
            _ => F::from_f64(draw.integer(-2, 2) as f64 / 2.0),
        };
        let mut vector = || [(); 3].map(|()| number());
        let [o, d, a, b, c] = [(); 5].map(|()| vector());
        let case = Case::new(o, d, [a, b, c]).on(F::zero(), F::one());
        let ends = [F::zero(), F::one()];
        let inputs: Vec<F> = [o, d, a, b, c].concat().into_iter().chain(ends).collect();
        let inputs: [F; 17] = inputs.try_into().expect("seventeen");
        let wide = inputs.map(F::to_f64);
        let runs = paths.iter().map(|path| (path, run(path, &inputs)));
        let Some((path, values)) = runs.into_iter().find(|(path, values)| is_taken(path, values))
        else {
            continue;
        };
        let thresholds = gated.thresholds(&case);
        for (gate, expected) in thresholds.into_iter().enumerate() {
            let mine: Vec<&Compared> = path.compared.iter().filter(|c| c.gate == gate).collect();
            let places = mine.iter().flat_map(|c| &c.quantities);
            let found = places.map(|at| {
                let found = value(&fpcore(path, *at, Domain::UNIT, format, "a gate"), &wide);
                let expected = values[*at as usize].to_f64();
                let is_same = found.to_bits() == expected.to_bits();
                assert!(is_same || found.is_nan() && expected.is_nan(), "{found} {expected}");
                found
            });
            let found: Vec<f64> = found.collect();
            compared += found.len();
            // What gates that round with their epsilon compare are not their margins.
            if mine.iter().any(|c| !c.is_margin()) || found.iter().any(|x| x.is_nan()) {
                continue;
            }
            // The least of all; where a gate takes either of two signs, one of its quantities.
            let is_one = mine.iter().all(|c| c.quantities.len() == 1);
            let least = found.iter().copied().fold(f64::INFINITY, f64::min);
            let expected = expected.to_f64();
            let agrees = if is_one { least == expected } else { found.contains(&expected) };
            let name = entry.info.name;
            assert!(agrees, "{name} gate {gate}: {found:?}, {expected}, {}", case.hex());
        }
    }
    compared
}

#[test]
fn every_core_computes_the_margins_of_its_kernel() {
    for entry in KERNELS {
        for name in [entry.info.name.to_owned(), format!("{}+fma", entry.info.name)] {
            let entry = find(&name).expect("a kernel");
            let counts = [
                cores_compute_what_a_kernel_does::<f32>(entry, Format::F32),
                cores_compute_what_a_kernel_does::<f64>(entry, Format::F64),
            ];
            assert!(counts.iter().all(|count| *count >= 20), "{name}: {counts:?}");
        }
    }
}
