//! The certificate of a guarded kernel: its margins, and that its signs decide what its promise asks.

use super::number::{Format, Number, round_up, show, whole};
use super::program::{Operation, Program, indices, places};
use super::reader::{Outcome, Reader, ensure};
use super::signs::{Literal, Promise, Signs};
use num_bigint::BigInt;
use num_traits::One;
use std::collections::{HashMap, HashSet};

/// A tree of decisions is not deeper.
const MOST_STEPS: usize = 1 << 9;

/// A number with more roundings, terms, shares or underflows has no margin.
const MOST_COUNT: u64 = 1 << 14;

/// How wrong a number may be: see the guide.
#[derive(Clone, Copy)]
struct Count {
    roundings: u64,
    terms: u64,
    shares: u64,
    underflows: u64,
}

impl Count {
    fn all(self) -> u64 {
        self.roundings + self.terms - 1
    }
}

/// The gates that were passed on the way, each with its patterns of acceptance, and the signs that are sure.
#[derive(Clone, Default)]
struct Way {
    gates: Vec<Vec<Vec<Literal>>>,
    sure: Vec<Literal>,
}

struct Guarded<'a> {
    program: Program<'a>,
    /// The numbers that have a margin.
    margins: HashSet<usize>,
    signs: Signs,
    steps: usize,
}

/// Reads and checks everything after the heading. Returns how many margins there are.
pub fn check<'a>(format: Format, reader: &mut Reader<'a>) -> Outcome<usize> {
    let promise = reader.read(
        "guarded line, ray or interval, and both or front",
        |words| {
            let &[extent, sides] = words else { return None };
            let is_known = ["line", "ray", "interval"].contains(&extent);
            let is_front = ["both", "front"].iter().position(|name| *name == sides)? == 1;
            is_known.then(|| Promise {
                extent: extent.to_owned(),
                is_front,
            })
        },
    )?;
    let program = Program::of_operations(format, reader)?;
    let signs = Signs::new(promise, &program);
    let mut guarded = Guarded {
        program,
        margins: HashSet::new(),
        signs,
        steps: 0,
    };
    let mut counts = HashMap::new();
    while reader.is_next("margin") {
        let count = guarded.program.operations.len();
        let form = "margin OPERATION ROUNDINGS FACTOR, once for an operation";
        let (place, found) = reader.read(form, |words| {
            let &[place, roundings, factor] = words else {
                return None;
            };
            let place = indices(&[place], count)?[0];
            let is_new = !guarded.margins.contains(&place);
            is_new.then(|| (place, format!("{roundings} {factor}")))
        })?;
        let right = guarded.margin(place, &mut counts)?;
        ensure(
            found == right,
            format!("found `{found}`, expected `{right}`"),
        )?;
        guarded.margins.insert(place);
    }
    guarded.axes(reader)?;
    reader.read("end", |words| words.is_empty().then_some(()))?;
    ensure(
        reader.lines.peek().is_none(),
        "found more lines after the end",
    )?;
    Ok(guarded.margins.len())
}

impl<'a> Guarded<'a> {
    /// The roundings and the factor of a number's margin; `0 0` for an input and a difference of two.
    fn margin(&self, place: usize, counts: &mut HashMap<(usize, bool), Count>) -> Outcome<String> {
        let [number, size] = [
            self.count(place, false, counts)?,
            self.count(place, true, counts)?,
        ];
        let few = number.underflows + size.underflows <= 500;
        ensure(few, format!("found operation {place} with too many terms"))?;
        let is_sum = ["add", "sub"].contains(&self.program.operations[place].name);
        let roundings = number.all() - u64::from(is_sum);
        let digits = self.program.format.parameters[0];
        // (1 + 2^-place)^count; the numerator is odd.
        let times = |place: i64, count: u64| {
            let one_and_unit: BigInt = (BigInt::one() << place) + 1;
            let power = BigInt::one() << (place as u64 * count);
            Number::new_raw(one_and_unit.pow(count as u32), power)
        };
        let (unit, share) = (digits, digits + 8);
        let error = times(unit, roundings) * times(share, number.shares) - Number::one();
        let factor = error * times(unit, size.all() + 3) * times(share, size.shares);
        Ok(format!("{roundings} {}", show(&round_up(&factor, digits))))
    }

    fn count(
        &self,
        place: usize,
        of_size: bool,
        counts: &mut HashMap<(usize, bool), Count>,
    ) -> Outcome<Count> {
        if let Some(known) = counts.get(&(place, of_size)) {
            return Ok(*known);
        }
        let input = Count {
            roundings: 0,
            terms: 1,
            shares: 0,
            underflows: 1,
        };
        let Operation { name, operands, .. } = &self.program.operations[place];
        let found = match (self.program.leaf(place), *name, &operands[..]) {
            (Some((_, None)), ..) => input,
            (Some(_), ..) => Count {
                roundings: 1,
                underflows: 4,
                ..input
            },
            (_, "number", _) => Count {
                underflows: 0,
                ..input
            },
            (_, "neg" | "abs", &[a]) => self.count(a, of_size, counts)?,
            (_, "add" | "sub", &[a, b]) => {
                let (a, b) = (
                    self.count(a, of_size, counts)?,
                    self.count(b, of_size, counts)?,
                );
                Count {
                    roundings: a.roundings.max(b.roundings),
                    terms: a.terms + b.terms,
                    shares: a.shares.max(b.shares),
                    underflows: a.underflows + b.underflows + 1,
                }
            }
            (_, "mul", &[a, b]) => {
                let mut product = Count {
                    roundings: 1,
                    shares: 0,
                    ..input
                };
                for factor in [a, b] {
                    let mut count = self.count(factor, of_size, counts)?;
                    if of_size && self.count(factor, false, counts)?.underflows > 0 {
                        count.terms += 1;
                        count.underflows += 1;
                    }
                    product.roundings += count.all();
                    product.shares += count.shares + 2 * count.underflows;
                }
                product
            }
            _ => {
                return Err(format!(
                    "found a margin of a number with `{name}`, which has none"
                ));
            }
        };
        let Count {
            roundings,
            terms,
            shares,
            underflows,
        } = found;
        let is_small = [roundings, terms, shares, underflows]
            .iter()
            .all(|n| *n <= MOST_COUNT);
        ensure(
            is_small,
            format!("found operation {place} with too many roundings"),
        )?;
        counts.insert((place, of_size), found);
        Ok(found)
    }

    /// The choice of the names of the axes, and the steps that follow under each of them.
    fn axes(&mut self, reader: &mut Reader<'a>) -> Outcome<()> {
        let mut all = Vec::new();
        let mut open = usize::from(reader.is_next("axes"));
        while open > 0 {
            let count = self.program.operations.len();
            let form = "axes XYZ in some order, or a comparison";
            let axes = reader.read(form, |words| match words {
                [names] => places(names, "xyz").map(Some),
                _ => comparison(words, count).map(|()| None),
            })?;
            open = if axes.is_some() { open - 1 } else { open + 1 };
            all.extend(axes);
            ensure(open < MOST_STEPS, "found too many names of axes")?;
        }
        if all.is_empty() {
            all.push([0, 1, 2]);
        }
        self.signs.axes = all;
        self.step(&Way::default(), reader)
    }

    fn step(&mut self, way: &Way, reader: &mut Reader<'a>) -> Outcome<()> {
        self.steps += 1;
        ensure(self.steps < MOST_STEPS, "found too many steps")?;
        let count = self.program.operations.len();
        let program = &self.program;
        if reader.is_next("choice") {
            reader.read("choice COMPARISON", |words| comparison(words, count))?;
            self.step(way, reader)?;
            return self.step(way, reader);
        }
        if reader.is_next("sign") {
            let literal = reader.read("sign CONDITION", |words| {
                let &[literal] = words else { return None };
                self.literal(literal)
            })?;
            for literal in [literal.clone(), literal.negated()] {
                let mut way = way.clone();
                way.sure.push(literal);
                self.step(&way, reader)?;
            }
            return Ok(());
        }
        if reader.is_next("gate") {
            let name = reader.read("gate NAME", |words| {
                (words.len() == 1).then(|| words[0].to_owned())
            })?;
            let mut hits = Vec::new();
            while reader.is_next("hit") {
                hits.push(self.pattern("hit CONDITIONS", reader)?);
            }
            while reader.is_next("miss") {
                let known = [&way.sure[..], &self.pattern("miss CONDITIONS", reader)?].concat();
                let outcome = self.signs.ensure_miss(program, &known);
                outcome.map_err(|why| format!("gate '{name}' {why}"))?;
            }
            let mut way = way.clone();
            way.gates.push(hits);
            return self.step(&way, reader);
        }
        if reader.is_next("found") {
            reader.read("found", |words| words.is_empty().then_some(()))?;
            return self.signs.ensure_hit(program, &way.sure, &way.gates);
        }
        reader.read("ask", |words| words.is_empty().then_some(()))
    }

    /// A line of conditions.
    fn pattern(&self, form: &str, reader: &mut Reader<'a>) -> Outcome<Vec<Literal>> {
        reader.read(form, |words| {
            words.iter().map(|word| self.literal(word)).collect()
        })
    }

    /// `-3*7!5`, of numbers with margins.
    fn literal(&self, word: &str) -> Option<Literal> {
        let (sign, rest) = word.split_at_checked(1)?;
        let is_negative = ["+", "-"].iter().position(|known| *known == sign)? == 1;
        let (signs, nonzero) = match rest.split_once('!') {
            Some((signs, nonzero)) => (signs, nonzero.split('!').collect()),
            None => (rest, vec![]),
        };
        let signs: Vec<&str> = if signs.is_empty() {
            vec![]
        } else {
            signs.split('*').collect()
        };
        let places = |words: &[&str]| -> Option<Vec<usize>> {
            let all = words
                .iter()
                .map(|word| whole(word))
                .collect::<Option<Vec<usize>>>()?;
            all.iter()
                .all(|place| self.margins.contains(place))
                .then_some(all)
        };
        Some(Literal {
            is_negative,
            signs: places(&signs)?,
            nonzero: places(&nonzero)?,
        })
    }
}

/// A comparison of floats; which one is not important, since both ways are proved.
fn comparison(words: &[&str], count: usize) -> Option<()> {
    let (name, places) = words.split_first()?;
    let places = indices(places, count)?.len();
    let is_known = matches!(
        (*name, places),
        ("less" | "at-most", 2) | ("zero" | "negative", 1)
    );
    is_known.then_some(())
}
