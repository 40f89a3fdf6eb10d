//! The formula of a lemma: variables, steps, and what their rounding errors add up to.

use super::corners::{Row, search};
use super::number::{F32, F64, Format, Number, power, round_up, split};
use super::program::{Bound, Leaf, Program, indices, terms};
use super::reader::{Outcome, Reader, refuse};
use super::{ERROR_DIGITS, MOST_ROWS};
use num_traits::{One, Zero};
use std::collections::HashSet;

/// A formula of n variables has 2^n corners. Work is counted in corners times steps.
const MOST_VARIABLES: usize = 18;
const MOST_WORK: u64 = 1 << 31;

/// A variable: a leaf, a number with a lemma, or else the quotient that a lemma is about.
struct Variable {
    leaf: Option<Leaf>,
    cut: Option<usize>,
    bound: Bound,
}

/// A step, and what it adds up: variables, a constant, and products of earlier steps.
pub struct Step {
    /// The operation that it stands for; none of steps that only a proof needs.
    pub place: Option<usize>,
    name: String,
    variables: Vec<(bool, usize)>,
    constant: i64,
    terms: Vec<(bool, usize, Option<usize>)>,
    support: usize,
    /// Exact and computed size, and the error of its own.
    pub bound: Bound,
    /// Whether its error is also at most u times its exact result, apart from terms of higher order.
    rounds: bool,
    relative: bool,
}

/// What an argument of a lemma says.
pub struct Formula {
    variables: Vec<Variable>,
    pub steps: Vec<Step>,
}

impl Formula {
    /// The variables and the steps. The quotient is at most `quotient`, in the lemmas that have one.
    pub fn read(
        program: &Program,
        quotient: Option<&Number>,
        reader: &mut Reader,
    ) -> Outcome<Formula> {
        let mut formula = Formula { variables: Vec::new(), steps: Vec::new() };
        // The component of each input, and of the ground under them, in the graph of the leaves.
        let mut components: [usize; 18] = std::array::from_fn(|i| i);
        while reader.is_next("variable") {
            let form = "variable point P AXIS, difference P Q AXIS, direction AXIS, end N, cut OPERATION or quotient";
            let (leaf, cut) = reader.read(form, |words| {
                let (kind, words) = words.split_first()?;
                Some(match (*kind, &indices(words, 1 << 16)?[..]) {
                    ("point", &[p @ 0..4, axis @ 0..3]) => (Some((point(p, axis), None)), None),
                    ("difference", &[p @ 0..4, q @ 0..4, axis @ 0..3]) => {
                        (Some((point(p, axis), Some(point(q, axis)))), None)
                    }
                    ("direction", &[axis @ 0..3]) => (Some((3 + axis, None)), None),
                    ("end", &[end @ 0..2]) => (Some((15 + end, None)), None),
                    ("cut", &[place]) => (None, Some(place)),
                    ("quotient", &[]) if quotient.is_some() => (None, None),
                    _ => return None,
                })
            })?;
            if formula.variables.len() == MOST_VARIABLES {
                return refuse(reader.line, format!("found more than {MOST_VARIABLES} variables"));
            }
            let exact = |size: &Number| Bound {
                size: size.clone(),
                computed: size.clone(),
                error: Number::zero(),
            };
            let bound = match (leaf, cut, quotient) {
                (Some((i, j)), _, _) => {
                    let (from, to) = (components[i], components[j.unwrap_or(17)]);
                    if from == to {
                        return refuse(
                            reader.line,
                            "found a variable that follows from those above, expected an independent one",
                        );
                    }
                    components.iter_mut().filter(|c| **c == from).for_each(|c| *c = to);
                    exact(program.domain.bound((i, j)))
                }
                (_, Some(place), _) => program.bound(reader.line, place)?.clone(),
                (_, _, Some(quotient)) => exact(quotient),
                _ => return refuse(reader.line, "found a quotient, expected none here"),
            };
            formula.variables.push(Variable { leaf, cut, bound });
        }
        while reader.is_next("step") {
            let found =
                reader.read("step OPERATION KIND OPERANDS", |words| Some(words.to_vec()))?;
            let step = formula.step(&found, program, quotient.is_some()).or_else(|expected| {
                refuse(reader.line, format!("found `step {}`, expected {expected}", found.join(" ")))
            })?;
            if step.place.is_some() {
                program
                    .format
                    .finite(&step.bound.computed)
                    .or_else(|message| refuse(reader.line, message))?;
            }
            formula.steps.push(step);
            if MOST_ROWS < formula.steps.len() {
                return refuse(reader.line, format!("found more than {MOST_ROWS} steps"));
            }
        }
        let operands = formula.steps.iter().flat_map(|step| &step.terms);
        let operands: HashSet<usize> = operands.flat_map(|(_, a, b)| [*a, b.unwrap_or(*a)]).collect();
        if operands.len() + 1 != formula.steps.len() {
            return reader.unexpected("a last step that uses all those above");
        }
        if reader.is_next("relative") {
            let steps = &mut formula.steps;
            reader.read("relative STEPS, each an earlier one that rounds once", |words| {
                for i in indices(words, steps.len())? {
                    let is_new = steps[i].rounds && !steps[i].relative;
                    steps[i].relative = is_new.then_some(true)?;
                }
                Some(())
            })?;
        }
        Ok(formula)
    }

    /// One step, or what was expected.
    fn step(
        &self,
        words: &[&str],
        program: &Program,
        in_quotient: bool,
    ) -> Result<Step, &'static str> {
        let (&[place, name], words) =
            words.split_first_chunk().ok_or("`step OPERATION KIND OPERANDS`")?;
        let place = match place {
            "-" => None,
            _ => Some(
                indices(&[place], program.operations.len()).ok_or("an operation of the program")?
                    [0],
            ),
        };
        let operation = place.map(|place| &program.operations[place]);
        if operation.is_none()
            && !(in_quotient && ["variables", "number", "mul", "sub"].contains(&name))
        {
            return Err("an operation of the program");
        }
        let format = program.format;
        let exact = Bound { size: Number::zero(), computed: Number::zero(), error: Number::zero() };
        let mut step = Step {
            place,
            name: name.to_owned(),
            variables: vec![],
            constant: 0,
            terms: vec![],
            support: 0,
            bound: exact,
            rounds: false,
            relative: false,
        };
        if name == "variables" {
            let sum = words.iter().map(|word| {
                let (sign, v) =
                    word.split_at_checked(1).filter(|(sign, _)| ["+", "-"].contains(sign))?;
                Some((sign == "-", indices(&[v], self.variables.len())?[0]))
            });
            step.variables = sum.collect::<Option<_>>().ok_or("variables, each with its sign")?;
            step.support = step.variables.iter().fold(0, |bits, (_, v)| bits | 1 << v);
            let single = match step.variables[..] {
                [(false, v)] => Some(&self.variables[v]),
                _ => None,
            };
            match (single, place) {
                (Some(v), None) if v.leaf.is_none() && v.cut.is_none() => {
                    step.bound = v.bound.clone()
                }
                (Some(v), Some(_)) if v.cut == place => step.bound = v.bound.clone(),
                (_, Some(place)) => {
                    let leaf =
                        program.leaf(place).filter(|leaf| self.is_sum(*leaf, &step.variables));
                    let leaf = leaf.ok_or("variables that add up to this operation")?;
                    let size = program.domain.bound(leaf).clone();
                    step.rounds = leaf.1.is_some();
                    let (computed, error) = if step.rounds {
                        (format.float_up(&size), format.half_ulp(&size))
                    } else {
                        (size.clone(), Number::zero())
                    };
                    step.bound = Bound { size, computed, error };
                }
                _ => return Err("the quotient"),
            }
        } else if name == "number" {
            let value =
                words.first().and_then(|word| word.parse().ok()).filter(|_| words.len() == 1);
            let right = operation.map_or(Some(1), |o| (o.name == name).then_some(o.value));
            step.constant = value.filter(|value| right == Some(*value)).ok_or("this number")?;
            let size = Number::from(num_bigint::BigInt::from(step.constant.abs()));
            step.bound = Bound { computed: size.clone(), size, error: Number::zero() };
        } else {
            let operands = indices(words, self.steps.len()).ok_or("earlier steps")?;
            step.terms = terms(name, &operands).ok_or("a step that adds or multiplies")?;
            let places = |operands: &[usize]| {
                operands.iter().map(|i| self.steps[*i].place).collect::<Vec<_>>()
            };
            if operation.is_some_and(|o| {
                o.name != name || !o.operands.iter().map(|o| Some(*o)).eq(places(&operands))
            }) {
                return Err("the operation of the program with its operands");
            }
            for (_, a, b) in &step.terms {
                let (a, b) = (self.steps[*a].support, b.map_or(0, |b| self.steps[b].support));
                if a & b != 0 {
                    return Err("factors without a variable in common");
                }
                step.support |= a | b;
            }
            self.round(&mut step, format)?;
        }
        Ok(step)
    }

    /// The sizes and the own error of a step with operands.
    fn round(&self, step: &mut Step, format: &Format) -> Result<(), &'static str> {
        let products = |part: fn(&Bound) -> &Number| -> Vec<Number> {
            let part = |i: usize| part(&self.steps[i].bound).clone();
            step.terms.iter().map(|(_, a, b)| part(*a) * b.map_or(Number::one(), part)).collect()
        };
        let (size, before) =
            (products(|bound| &bound.size).iter().sum(), products(|bound| &bound.computed));
        let z: Number = before.iter().sum();
        step.rounds = step.place.is_some() && step.name != "neg";
        let (computed, error) = match step.name.as_str() {
            "neg" => (z, Number::zero()),
            _ if step.place.is_none() => (Number::clone(&size), Number::zero()),
            // Rounded to f64 before it is rounded to f32.
            "minor" if format.parameters == F32 => {
                (format.float_up(&z), format.half_ulp(&z) + Format::of(F64).half_ulp(&z))
            }
            // Two rounded products p and q, and their remainders: (p - q) + (rest of p - rest of q).
            "minor" if format.parameters == F64 => {
                step.rounds = false;
                let products = before.iter().map(|x| format.float_up(x)).sum();
                let twice = &format.tiny + &format.tiny;
                let remainders = before.iter().map(|x| format.half_ulp(x)).sum::<Number>() + &twice;
                let both = format.float_up(&remainders);
                let error =
                    format.half_ulp(&products) + &both + format.half_ulp(&remainders) + twice;
                (format.float_up(&(format.float_up(&products) + both)), error)
            }
            "minor" => return Err("an operation that is defined for this scalar"),
            _ => (format.float_up(&z), format.half_ulp(&z)),
        };
        step.bound = Bound { size, computed, error };
        Ok(())
    }

    /// Whether the variables add up to a leaf, input by input.
    fn is_sum(&self, (i, j): Leaf, sum: &[(bool, usize)]) -> bool {
        let mut left = [0i64; 17];
        left[i] -= 1;
        j.into_iter().for_each(|j| left[j] += 1);
        for (minus, v) in sum {
            let Some((i, j)) = self.variables[*v].leaf else { return false };
            let sign = if *minus { -1 } else { 1 };
            left[i] += sign;
            j.into_iter().for_each(|j| left[j] -= sign);
        }
        left == [0; 17]
    }

    /// The last step is n - quotient*d, and no other step is without an operation but n, if it is one.
    pub fn is_quotient_of(&self, n: Option<usize>, d: usize) -> bool {
        let count = self.steps.len();
        let Some([.., q, product, last]) = self.steps.get(count.saturating_sub(3)..) else {
            return false;
        };
        let is = |i: usize, place: Option<usize>| self.steps[i].place == place;
        let at_one = self.steps[..count - 3].iter().position(|step| step.place.is_none());
        let others = self.steps[..count - 3].iter().filter(|step| step.place.is_none()).count();
        let right = match (&q.variables[..], &product.terms[..], &last.terms[..]) {
            ([_], &[(_, q, Some(divisor))], &[(_, above, None), (true, below, None)]) => {
                let is_one = at_one == Some(above) && self.steps[above].name == "number";
                let numerator =
                    if n.is_none() { is_one && others == 1 } else { is(above, n) && others == 0 };
                numerator && q == count - 3 && is(divisor, Some(d)) && below == count - 2
            }
            _ => false,
        };
        right && [q, product, last].iter().all(|step| step.place.is_none())
    }

    /// The largest exact size of the last step at a corner, and the bound of its error. Reads the corner
    /// and both parts of the bound.
    pub fn maximum(
        &self,
        format: &Format,
        work: &mut u64,
        reader: &mut Reader,
    ) -> Outcome<(Number, Number)> {
        *work += (self.steps.len() as u64) << self.variables.len();
        if MOST_WORK < *work {
            return refuse(reader.line, "found too many corners of too many steps in this file");
        }
        let Some((first, corner, largest)) = self.corners(format) else {
            return refuse(reader.line, "found numbers that are too long");
        };
        let signs = (0..self.variables.len()).map(|v| if corner >> v & 1 == 1 { '-' } else { '+' });
        let signs: String = signs.collect();
        reader.read(&format!("corner {signs}"), |words| (words.concat() == signs).then_some(()))?;
        let rest = self.higher_order(format);
        reader.demand("first", &first)?;
        reader.demand("rest", &rest)?;
        Ok((largest, first + rest))
    }

    fn corners(&self, format: &Format) -> Option<(Number, usize, Number)> {
        // Every number is an integer times a power of two that does not depend on the corner.
        let (sizes, exponents): (Vec<_>, Vec<_>) =
            self.variables.iter().map(|v| split(&v.bound.size)).unzip();
        let mut scales: Vec<i64> = Vec::new();
        for step in &self.steps {
            let variables = step.variables.iter().map(|(_, v)| exponents[*v]);
            let terms = step.terms.iter().map(|(_, a, b)| scales[*a] + b.map_or(0, |b| scales[b]));
            scales.push(variables.chain(terms).min().unwrap_or(0));
        }
        let weight = |(step, scale): (&Step, &i64)| {
            if step.relative { format.unit.clone() } else { &step.bound.error * power(-scale) }
        };
        let weights: Vec<Number> = self.steps.iter().zip(&scales).map(weight).collect();
        let finest = weights.iter().filter(|w| !w.is_zero()).map(|w| split(w).1).min().unwrap_or(0);
        let row = |(k, step): (usize, &Step)| {
            let factor = |minus: bool, scale: i64| {
                let power = power(scale - scales[k]).to_integer();
                if minus { -power } else { power }
            };
            let term = |&(minus, a, b): &(bool, usize, Option<usize>)| {
                (factor(minus, scales[a] + b.map_or(0, |b| scales[b])), a, b)
            };
            Row {
                constant: step.constant.into(),
                variables: step
                    .variables
                    .iter()
                    .map(|&(minus, v)| (factor(minus, exponents[v]), v))
                    .collect(),
                terms: step.terms.iter().map(term).collect(),
                weight: (&weights[k] * power(-finest)).to_integer(),
                relative: step.relative,
                support: step.support,
            }
        };
        let rows: Vec<_> = self.steps.iter().enumerate().map(row).collect();
        let (first, corner, largest) = search(&rows, &sizes)?;
        let scale = power(scales[scales.len() - 1]);
        Some((Number::from(first) * &scale * power(finest), corner, Number::from(largest) * scale))
    }

    /// The terms of second and higher order, with every number at its largest size and nothing cancelled.
    fn higher_order(&self, format: &Format) -> Number {
        // Of each step: its terms of first order, and the others.
        let mut orders: Vec<[Number; 2]> = Vec::new();
        for step in &self.steps {
            let (mut first, mut rest) = (Number::zero(), Number::zero());
            for (_, a, b) in &step.terms {
                let (size, [f, r]) = (&self.steps[*a].bound.size, &orders[*a]);
                let Some(b) = b else {
                    first += f;
                    rest += r;
                    continue;
                };
                let (other, [g, s]) = (&self.steps[*b].bound.size, &orders[*b]);
                first += size * g + f * other;
                rest += f * g + r * (other + g + s) + (size + f) * s;
            }
            if step.relative {
                rest += &format.unit * (&first + &rest) + &format.tiny;
                first += &format.unit * &step.bound.size;
            } else {
                first += &step.bound.error;
            }
            orders.push([first, rest]);
        }
        round_up(&orders[orders.len() - 1][1], ERROR_DIGITS)
    }
}

/// The input that is a coordinate of the origin, a, b or c.
fn point(p: usize, axis: usize) -> usize {
    if p == 0 { axis } else { 3 + 3 * p + axis }
}
