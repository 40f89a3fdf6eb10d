//! One program of a certificate: the operations of a number, what its proof supposes, and the bounds so far.

use super::number::{Bound, Format, Number, number, power, whole};
use super::reader::{Outcome, Reader, ensure};
use num_bigint::BigInt;
use num_traits::Signed;
use std::array::from_fn;
use std::collections::{BTreeSet, HashMap, HashSet};

/// Longer programs and formulas are refused.
pub const MOST_ROWS: usize = 1 << 12;

/// The numbers of a case.
const INPUTS: usize = 17;

/// Bounds of the inputs, in the order of their names.
#[derive(Clone)]
pub struct Domain(pub [Number; 8]);

const EDGE: usize = 0;
const REACH: usize = 1;
const WORLD: usize = 2;
const DIRECTION: usize = 3;
const EXTENT: usize = 4;
const DIRECTION_FLOOR: usize = 5;
const FLOOR: usize = 6;
const QUOTIENT: usize = 7;

/// A leaf of a formula: an input, or the difference of two points' inputs along one axis.
pub type Leaf = (usize, Option<usize>);

impl Domain {
    pub fn parse(words: &[&str]) -> Option<Domain> {
        let names = "edge reach world direction extent direction-floor floor quotient".split(' ');
        let right = words.len() == 16 && words.iter().step_by(2).copied().eq(names);
        let numbers: Option<Vec<Number>> =
            words.iter().skip(1).step_by(2).map(|x| number(x)).collect();
        right.then_some(Domain(numbers?.try_into().ok()?))
    }

    /// The largest difference of two points' coordinates.
    pub fn largest_difference(&self) -> &Number {
        (&self.0[EDGE]).max(&self.0[REACH])
    }

    pub fn bound(&self, leaf: Leaf) -> &Number {
        &self.0[match leaf {
            (0..3, Some(_)) | (_, Some(0..3)) => REACH,
            (_, Some(_)) => EDGE,
            (3..6, None) => DIRECTION,
            (0..15, None) => WORLD,
            _ => EXTENT,
        }]
    }
}

/// An input's or a number's value is `value`; everything else has operands.
pub struct Operation<'a> {
    pub name: &'a str,
    pub operands: Vec<usize>,
    pub value: i64,
}

/// A signed product of two numbers, or a signed number.
pub type Term = (bool, usize, Option<usize>);

/// The terms that an operation adds up; none for operations that are not sums.
pub fn terms(name: &str, operands: &[usize]) -> Option<Vec<Term>> {
    Some(match (name, operands) {
        ("neg", &[a]) => vec![(true, a, None)],
        ("add", &[a, b]) => vec![(false, a, None), (false, b, None)],
        ("sub", &[a, b]) => vec![(false, a, None), (true, b, None)],
        ("mul", &[a, b]) => vec![(false, a, Some(b))],
        ("fma", &[a, b, c]) => vec![(false, a, Some(b)), (false, c, None)],
        ("minor", &[a, b, c, d]) => vec![(false, a, Some(b)), (true, c, Some(d))],
        _ => return None,
    })
}

/// The axis in place of each axis, and the vertex in place of each vertex.
#[derive(Clone, Copy)]
pub struct Names {
    axes: [usize; 3],
    vertices: [usize; 3],
}

/// The place of each letter of a word that has all three of them.
pub fn places(word: &str, letters: &str) -> Option<[usize; 3]> {
    let places: Option<Vec<usize>> = word.chars().map(|letter| letters.find(letter)).collect();
    let places: [usize; 3] = places?.try_into().ok()?;
    (0..3).all(|i| places.contains(&i)).then_some(places)
}

impl Names {
    pub const SAME: Names = Names {
        axes: [0, 1, 2],
        vertices: [0, 1, 2],
    };

    /// Two words, each with all three letters: the first is in place of x, or of a.
    pub fn parse(words: &[&str]) -> Option<Names> {
        let &[axes, vertices] = words else {
            return None;
        };
        Some(Names {
            axes: places(axes, "xyz")?,
            vertices: places(vertices, "abc")?,
        })
    }

    /// The input in place of an input. The origin, the direction and the ends stay what they are.
    pub fn input(&self, i: usize) -> usize {
        match i {
            0..6 => i / 3 * 3 + self.axes[i % 3],
            6..15 => 6 + 3 * self.vertices[i / 3 - 2] + self.axes[i % 3],
            _ => i,
        }
    }
}

/// A program of which a bound is proved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variant {
    /// Its operations, one a line.
    pub operations: String,
    /// Pairs of inputs of which the first must be at most as large as the second.
    pub orders: BTreeSet<(usize, usize)>,
}

/// The program of one number, the last one.
pub struct Program<'a> {
    pub format: Format,
    pub domain: Domain,
    pub operations: Vec<Operation<'a>>,
    /// Pairs of inputs: without their signs, the first is at most the second.
    pub orders: BTreeSet<(usize, usize)>,
    /// The limits of divisors and of quotients that stand in place of the domain's; and how far below zero quotients may be,
    /// where that is supposed.
    pub limits: [HashMap<usize, Number>; 3],
    /// Other names of axes and vertices, under which the same is claimed.
    pub also: Vec<Names>,
    pub lemmas: HashMap<usize, Lemma>,
}

/// A coordinate of a vector, and the vector's length; and whether its rounded reciprocal is multiplied.
pub type Unit = (usize, (usize, bool));

/// A lemma: the bound that is proved of a number.
pub struct Lemma {
    pub bound: Bound,
    /// The error before the operation rounds, if it rounds once; else that of the number.
    pub before: Number,
    /// If it is a coordinate of a vector divided by the vector's length: of what.
    pub unit: Option<Unit>,
}

impl<'a> Program<'a> {
    /// Operations alone.
    pub fn of_operations(format: Format, reader: &mut Reader<'a>) -> Outcome<Program<'a>> {
        let operations = operations(&format, reader)?;
        let (orders, lemmas, also) = (BTreeSet::new(), HashMap::new(), Vec::new());
        let (limits, domain) = (Default::default(), Domain(from_fn(|_| Number::default())));
        Ok(Program {
            format,
            domain,
            operations,
            orders,
            limits,
            also,
            lemmas,
        })
    }

    /// The operations, and what the proof supposes of them.
    pub fn read(format: Format, domain: Domain, reader: &mut Reader<'a>) -> Outcome<Program<'a>> {
        reader.read("program", |words| words.is_empty().then_some(()))?;
        let mut program = Program {
            domain,
            ..Program::of_operations(format, reader)?
        };
        while reader.is_next("order") {
            let order = reader.read("order INPUT INPUT, each pair once", |words| {
                let &[a, b] = &indices(words, INPUTS)?[..] else {
                    return None;
                };
                Some((a, b)).filter(|pair| a != b && !program.orders.contains(pair))
            })?;
            program.orders.insert(order);
        }
        for (limits, word) in program
            .limits
            .iter_mut()
            .zip(["at-least", "at-most", "down-to"])
        {
            while reader.is_next(word) {
                let count = program.operations.len();
                let form = format!("{word} OPERATION X, once for an operation");
                let (place, limit) = reader.read(&form, |words| {
                    let &[place, limit] = words else { return None };
                    let place = indices(&[place], count)?[0];
                    Some((place, number(limit)?)).filter(|_| !limits.contains_key(&place))
                })?;
                limits.insert(place, limit);
            }
        }
        while reader.is_next("also") {
            let form = "also AXES VERTICES, as yzx abc, for another program";
            let names = reader.read(form, |words| {
                let names = Names::parse(words)?;
                let other = program.variant(names);
                let is_other = program.variants().iter().all(|known| *known != other);
                is_other.then_some(names)
            })?;
            program.also.push(names);
        }
        Ok(program)
    }

    /// The last operation; an error if there is none, or if something is written that no proof of its number uses.
    pub fn last_of_used(&self) -> Outcome<usize> {
        const UNUSED: &str = "found operations that the last one does not use, or none";
        let last = self.operations.len().checked_sub(1).ok_or(UNUSED)?;
        let used: HashSet<usize> = self
            .operations
            .iter()
            .flat_map(|operation| operation.operands.clone())
            .collect();
        // Operands are earlier operations.
        ensure(used.len() == last, UNUSED)?;
        let uses = |(a, b): &(usize, usize)| {
            self.lemmas
                .keys()
                .filter_map(|place| self.fraction(*place))
                .any(|(n, d)| {
                    self.input(d) == Some(*b)
                        && (self.input(n) == Some(*a) || (3..6).contains(a) && self.is_largest(*b))
                })
        };
        let unused = self.orders.iter().find(|order| !uses(order));
        unused.map_or(Ok(last), |(a, b)| {
            Err(format!("found `order {a} {b}`, which no lemma uses"))
        })
    }

    /// The program and its orders under these names.
    fn variant(&self, names: Names) -> Variant {
        let mut text = String::new();
        for (
            place,
            Operation {
                name,
                operands,
                value,
            },
        ) in self.operations.iter().enumerate()
        {
            let value = match *name {
                "input" => vec![names.input(*value as usize) as i64],
                "number" => vec![*value],
                _ => operands.iter().map(|operand| *operand as i64).collect(),
            };
            let value: Vec<String> = value.iter().map(i64::to_string).collect();
            text.push_str(&format!("op {place} {name} {}\n", value.join(" ")));
        }
        let orders = self
            .orders
            .iter()
            .map(|(a, b)| (names.input(*a), names.input(*b)));
        Variant {
            operations: text,
            orders: orders.collect(),
        }
    }

    /// The programs that the claim is about.
    pub fn variants(&self) -> Vec<Variant> {
        let all = [Names::SAME].into_iter().chain(self.also.iter().copied());
        all.map(|names| self.variant(names)).collect()
    }

    /// Numerator and divisor of n/d, or of n*(1/d).
    pub fn fraction(&self, place: usize) -> Option<(usize, usize)> {
        let operands = |place: usize, name: &str| {
            let Operation {
                name: found,
                operands,
                ..
            } = &self.operations[place];
            (*found == name).then(|| (operands[0], operands[1]))
        };
        let times = |n: usize, place: usize| {
            operands(place, "div")
                .filter(|(one, _)| self.is_one(*one))
                .map(|(_, d)| (n, d))
        };
        let product =
            || operands(place, "mul").and_then(|(a, b)| times(a, b).or_else(|| times(b, a)));
        operands(place, "div").or_else(product)
    }

    pub fn is_one(&self, place: usize) -> bool {
        let Operation { name, value, .. } = self.operations[place];
        (name, value) == ("number", 1)
    }

    pub fn name(&self, place: usize) -> &'a str {
        self.operations[place].name
    }

    pub fn operands(&self, place: usize) -> &[usize] {
        &self.operations[place].operands
    }

    pub fn input(&self, place: usize) -> Option<usize> {
        let operation = &self.operations[place];
        (operation.name == "input").then_some(operation.value as usize)
    }

    pub fn leaf(&self, place: usize) -> Option<Leaf> {
        let operation = &self.operations[place];
        if operation.name != "sub" {
            return self.input(place).map(|i| (i, None));
        }
        let (i, j) = (
            self.input(operation.operands[0])?,
            self.input(operation.operands[1])?,
        );
        let are_points = [i, j]
            .iter()
            .all(|i| (0..3).contains(i) || (6..15).contains(i));
        (are_points && i % 3 == j % 3 && i != j).then_some((i, Some(j)))
    }

    /// The least size of a divisor.
    pub fn floor(&self, divisor: usize) -> &Number {
        self.limits[0].get(&divisor).unwrap_or_else(|| {
            let largest = self.input(divisor).filter(|d| self.is_largest(*d));
            &self.domain.0[if largest.is_some() {
                DIRECTION_FLOOR
            } else {
                FLOOR
            }]
        })
    }

    /// True if an input is the largest coordinate of the direction.
    fn is_largest(&self, d: usize) -> bool {
        let is_smaller = |axis: usize| axis == d || self.orders.contains(&(axis, d));
        (3..6).contains(&d) && (3..6).all(is_smaller)
    }

    /// How far below zero a quotient may be, if that is supposed.
    pub fn down_to(&self, quotient: usize) -> Option<&Number> {
        self.limits[2].get(&quotient)
    }

    /// The largest size of a quotient.
    pub fn most(&self, quotient: usize) -> &Number {
        self.limits[1]
            .get(&quotient)
            .unwrap_or(&self.domain.0[QUOTIENT])
    }

    pub fn bound(&self, place: usize) -> Outcome<&Bound> {
        Ok(&self.lemma(place)?.bound)
    }

    /// The lemma of a number, or of the number in its neg or abs.
    pub fn lemma(&self, place: usize) -> Outcome<&Lemma> {
        let mut inner = place;
        while let Some(Operation {
            name: "neg" | "abs",
            operands,
            ..
        }) = self.operations.get(inner)
        {
            inner = operands[0];
        }
        let missing = || format!("found operation {place}, expected one with a lemma above");
        self.lemmas.get(&inner).ok_or_else(missing)
    }
}

/// The lines of operations.
fn operations<'a>(format: &Format, reader: &mut Reader<'a>) -> Outcome<Vec<Operation<'a>>> {
    let mut operations: Vec<Operation> = Vec::new();
    let most = power(format.parameters[0]).to_integer();
    while reader.is_next("op") && operations.len() < MOST_ROWS {
        let next = operations.len();
        let form = format!("op {next} OPERATION OPERANDS, each an earlier one");
        operations.push(reader.read(&form, |words| {
            let (&[place, name], words) = words.split_first_chunk()?;
            let parsed: Option<Vec<i64>> = words.iter().map(|word| whole(word)).collect();
            let parsed = parsed.filter(|_| whole(place) == Some(next))?;
            if let ("input" | "number", &[value]) = (name, &parsed[..]) {
                let is_input = name == "input" && (0..INPUTS as i64).contains(&value);
                let is_exact = name == "number" && BigInt::from(value).abs() <= most;
                let operation = Operation {
                    name,
                    operands: vec![],
                    value,
                };
                return (is_input || is_exact).then_some(operation);
            }
            let operands = indices(words, next)?;
            let is_known = matches!((name, operands.len()), ("abs" | "sqrt", 1) | ("div", 2));
            (is_known || terms(name, &operands).is_some()).then_some(Operation {
                name,
                operands,
                value: 0,
            })
        })?);
    }
    Ok(operations)
}

/// Whole numbers below `end`.
pub fn indices(words: &[&str], end: usize) -> Option<Vec<usize>> {
    let index = |word: &&str| whole(word).filter(|i| *i < end);
    words.iter().map(index).collect()
}
