//! Programs as scripts for Gappa (gappa.gitlabpages.inria.fr), which proves bounds by intervals and
//! writes proofs for Coq.

use super::forms::{Forms, Leaf};
use super::{Domain, Dyadic, Format, Prover};
use crate::arith::recorded::{Operation, Place};
use crate::kernel::Path;
use std::collections::HashMap;
use std::fmt::Write;

/// A script about the error of a number in a domain: that it is at most `goal`, or, without a goal, the
/// question what it is at most. An error in one sentence if a divisor has no bound.
///
/// The variables are those of the prover: inputs, and exact differences of two points, each of which
/// the script rounds. A script may be true though Gappa does not find its proof.
pub fn gappa(
    path: &Path,
    place: Place,
    domain: Domain,
    format: Format,
    name: &str,
    goal: Option<Dyadic>,
) -> Result<String, String> {
    let mut place = place;
    while let Operation::Neg(inner) | Operation::Abs(inner) = path.operations[place as usize] {
        // Its error is that of its operand.
        place = inner;
    }
    let mut script = Script {
        path,
        format,
        prover: Prover::new(path, domain, format),
        forms: Forms::default(),
        variables: Vec::new(),
        names: HashMap::new(),
        definitions: String::new(),
        hypotheses: Vec::new(),
        hints: String::new(),
    };
    let [computed, exact] = script.define(place)?;
    let digits = if format == Format::F32 { 32 } else { 64 };
    let name = name.replace(['\n', '\r'], " ");
    let mut text = format!("# {name}\n#@ -Eno-auto-dichotomy\n@rnd = float<ieee_{digits},ne>;\n");
    if script.definitions.contains("wide(") {
        text.push_str("@wide = float<ieee_64,ne>;\n");
    }
    text.push_str(&script.definitions);
    let goal = goal.map_or("in ?".to_owned(), |goal| format!("<= {}", number(goal)));
    let hypotheses = script.hypotheses.join(" /\\\n  ");
    write!(text, "{{ {hypotheses}\n  -> |{computed} - {exact}| {goal} }}\n").expect("a string");
    text.push_str(&script.hints);
    Ok(text)
}

struct Script<'a> {
    path: &'a Path,
    format: Format,
    prover: Prover<'a>,
    forms: Forms,
    variables: Vec<String>,
    /// By place: the names of the computed and of the exact number.
    names: HashMap<Place, [String; 2]>,
    definitions: String,
    hypotheses: Vec<String>,
    hints: String,
}

impl Script<'_> {
    fn define(&mut self, place: Place) -> Result<[String; 2], String> {
        if let Some(known) = self.names.get(&place) {
            return Ok(known.clone());
        }
        let operation = self.path.operations[place as usize];
        let names = match (Leaf::of(operation, &self.path.operations), operation) {
            (Some(leaf), _) => self.leaf(leaf, place),
            (None, Operation::Number(value)) => [value.to_string(), value.to_string()],
            _ => self.operation(operation, place)?,
        };
        self.names.insert(place, names.clone());
        Ok(names)
    }

    fn leaf(&mut self, leaf: Leaf, place: Place) -> [String; 2] {
        let name = leaf_name(leaf);
        let (sum, is_new) = self.forms.sum(leaf, self.variables.len());
        if is_new {
            self.variables.push(name.clone());
        } else if !self.hypotheses.iter().any(|known| known.starts_with(&format!("{name} in"))) {
            let term = |(v, sign): &(usize, i8)| {
                format!("{}{}", if *sign < 0 { "-" } else { "+" }, self.variables[*v])
            };
            let terms: String = sum.iter().map(term).collect();
            writeln!(self.definitions, "{name} = {};", terms.trim_start_matches('+'))
                .expect("a string");
        }
        self.assume(&name, leaf.bound(&self.prover.domain));
        if !leaf.is_difference() {
            return [name.clone(), name];
        }
        writeln!(self.definitions, "r{place} = rnd({name});").expect("a string");
        [format!("r{place}"), name]
    }

    fn assume(&mut self, name: &str, bound: Dyadic) {
        let bound = number(bound);
        self.hypotheses.push(format!("{name} in [-{bound},{bound}]"));
    }

    fn operation(&mut self, operation: Operation, place: Place) -> Result<[String; 2], String> {
        let operands = operation.operands();
        let names: Vec<[String; 2]> =
            operands.iter().map(|operand| self.define(*operand)).collect::<Result<_, _>>()?;
        let of = |which: usize| -> Vec<&str> { names.iter().map(|n| n[which].as_str()).collect() };
        let is_exact = matches!(operation, Operation::Neg(_) | Operation::Abs(_));
        let (exact, before) = (plain(operation, &of(1)), plain(operation, &of(0)));
        let computed = match operation {
            _ if is_exact => before.clone(),
            Operation::Minor(..) => self.minor(&of(0), place),
            _ => format!("rnd({before})"),
        };
        let [small, large] = [format!("r{place}"), format!("R{place}")];
        writeln!(self.definitions, "{small} = {computed};").expect("a string");
        if is_exact && exact == before {
            return Ok([small.clone(), small]);
        }
        if exact == before {
            // The same expression has one name only, and the computed number rounds it.
            self.definitions.truncate(self.definitions.len() - small.len() - computed.len() - 5);
            writeln!(self.definitions, "{large} = {exact};\n{small} = rnd({large});")
                .expect("a string");
        } else {
            writeln!(self.definitions, "{large} = {exact};").expect("a string");
        }
        if let Some((numerator, divisor, twice)) = self.prover.quotient(place) {
            self.quotient(&large, [of(0)[0], of(0)[1]], numerator, divisor, twice, place)?;
        }
        Ok([small, large])
    }

    /// Adds what the prover knows of a quotient, and how it bounds its error: by what the computed numerator
    /// lacks of the exact quotient times the computed divisor.
    fn quotient(
        &mut self,
        large: &str,
        factors: [&str; 2],
        numerator: Option<Place>,
        divisor: Place,
        twice: bool,
        place: Place,
    ) -> Result<(), String> {
        let [d, exact] = self.define(divisor)?;
        let [n, above] = match numerator {
            Some(numerator) => self.define(numerator)?,
            None => ["1".to_owned(), "1".to_owned()],
        };
        let floor = number(self.prover.floor(divisor).size());
        let size = self.prover.bound(place)?.size;
        self.assume(large, size);
        if !twice {
            self.hypotheses.push(format!("|{exact}| >= {floor}"));
        }
        if d == exact {
            return Ok(());
        }
        let not_zero = format!("{{ {d} <> 0, {exact} <> 0 }}");
        let lacking = if n == "1" { "0".to_owned() } else { format!("({n} - {above})") };
        let quotient = format!("{n} / {d}");
        let error = format!("{quotient} - {large}");
        let mut hints = vec![
            format!("{d} -> {exact} + ({d} - {exact});"),
            format!("{error} -> ({lacking} - ({d} - {exact}) * {large}) / {d} {not_zero};"),
        ];
        if let (true, [x, y]) = (twice, factors) {
            // The product by a rounded reciprocal: the quotient, and the reciprocal's relative error of it.
            let reciprocal = if x == n { y } else { x };
            let relative = format!("(({reciprocal} - 1 / {d}) / (1 / {d}))");
            hints.push(format!("{quotient} -> {large} + ({error}) {not_zero};"));
            hints.push(format!(
                "{x} * {y} - {large} -> ({quotient}) * {relative} + ({error}) {not_zero};"
            ));
        }
        for hint in hints {
            if !self.hints.contains(&hint) {
                writeln!(self.hints, "{hint}").expect("a string");
            }
        }
        Ok(())
    }

    /// The difference of products as f32 and f64 compute it, in f64 by rounded products and their
    /// remainders.
    fn minor(&mut self, of: &[&str], place: Place) -> String {
        let [x, y] = [format!("{} * {}", of[0], of[1]), format!("{} * {}", of[2], of[3])];
        if self.format == Format::F32 {
            return format!("rnd(wide({x} - {y}))");
        }
        let [p, q, s, g] = ["p", "q", "s", "g"].map(|letter| format!("{letter}{place}"));
        write!(
            self.definitions,
            "{p} = rnd({x});\n{q} = rnd({y});\n{s} = rnd({p} - {q});\n\
             {g} = rnd(rnd({x} - {p}) - rnd({y} - {q}));\n"
        )
        .expect("a string");
        write!(
            self.hints,
            "({s} + {g}) - ({x} - {y}) -> ({s} - ({p} - {q})) + ({g} - (({x} - {p}) - ({y} - {q})));\n\
             ({s} + {g}) - R{place} -> (({s} + {g}) - ({x} - {y})) + (({x} - {y}) - R{place});\n"
        )
        .expect("a string");
        format!("rnd({s} + {g})")
    }
}

/// An operation without rounding.
fn plain(operation: Operation, of: &[&str]) -> String {
    match operation {
        Operation::Input(_) | Operation::Number(_) => unreachable!("it has no operands"),
        Operation::Add(..) => format!("{} + {}", of[0], of[1]),
        Operation::Sub(..) => format!("{} - {}", of[0], of[1]),
        Operation::Mul(..) => format!("{} * {}", of[0], of[1]),
        Operation::Div(..) => format!("{} / {}", of[0], of[1]),
        Operation::Neg(_) => format!("-{}", of[0]),
        Operation::Abs(_) => format!("|{}|", of[0]),
        Operation::Sqrt(_) => format!("sqrt({})", of[0]),
        Operation::Fma(..) => format!("{} * {} + {}", of[0], of[1], of[2]),
        Operation::Minor(..) => format!("{} * {} - {} * {}", of[0], of[1], of[2], of[3]),
    }
}

/// Its name as a variable: `ba_x` for b - a along x.
fn leaf_name(leaf: Leaf) -> String {
    let (point, axis) = (|p: usize| ["o", "a", "b", "c"][p], |i: usize| ["x", "y", "z"][i]);
    match leaf {
        Leaf::Point(p, i) => format!("{}{}", point(p), axis(i)),
        Leaf::Difference(p, q, i) => format!("{}{}_{}", point(p), point(q), axis(i)),
        Leaf::Direction(i) => format!("d{}", axis(i)),
        Leaf::End(i) => ["tmin", "tmax"][i].to_owned(),
    }
}

/// A number as Gappa reads it.
fn number(x: Dyadic) -> String {
    match x.parts() {
        (mantissa, 0) => mantissa.to_string(),
        (mantissa, exponent) => format!("{mantissa}b{exponent}"),
    }
}
