//! Errors relative to a permanent: bounds that hold at every exponent, short of overflow and underflow.
//!
//! The permanent of a number is what its program computes without rounding if each input and each
//! difference of two inputs is replaced by its absolute value, each subtraction by an addition, and each
//! quotient by its absolute value. Shewchuk's filters compare a determinant with it.
//!
//! A rounded result is z·f, with f in [1/(1+u), 1+u], plus at most half the smallest subnormal number
//! where a product or a quotient underflows. So a number whose monomials pass at most K roundings is
//!
//! ```text
//! |computed - exact| <= ((1+u)^K - 1) * permanent + underflow
//! ```
//!
//! An underflow is multiplied by the other factors of its term. So what it adds is known in a domain only.
//!
//! By induction: a sum of numbers with K and L roundings has max(K, L) + 1, a product K + L + 1, and a
//! quotient too, if its divisor is not rounded or is a sum of two numbers that are not: then it does not
//! cancel. With the permanent as the program's own arithmetic computes it, in the same order, the same
//! inequality holds: z = computed·f works both ways.
//!
//! The last sum cannot change a sign. For the sign only the roundings before it count.

use super::bound::Proven;
use super::dyadic::{Big, round_up};
use super::forms::Leaf;
use super::formula::DIGITS;
use super::{Domain, Dyadic, Format, Prover};
use crate::arith::recorded::{Operation, Place, Term};
use crate::kernel::Path;
use num_traits::{One, Zero};

/// The form relative to the permanent of a number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Relative {
    /// The roundings that a monomial passes at most: K.
    pub roundings: Roundings,
    /// The same without the last operation, if it is a sum: enough for the sign.
    pub for_sign: Roundings,
    /// (1+u)^K - 1, rounded up: the error is at most this times the permanent,
    pub factor: Dyadic,
    /// and at most this more, in the domain, where products underflow.
    pub underflow: Dyadic,
}

/// How many roundings a monomial passes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Roundings {
    /// To the format.
    pub of_format: u32,
    /// In wider arithmetic: to 53 digits in f32, and half a double format's in f64.
    pub wider: u32,
}

impl Roundings {
    const ONE: Roundings = Roundings {
        of_format: 1,
        wider: 0,
    };

    fn and(self, other: Roundings) -> Roundings {
        let Roundings { of_format, wider } = other;
        Roundings {
            of_format: self.of_format + of_format,
            wider: self.wider + wider,
        }
    }

    /// At least both.
    fn or(self, other: Roundings) -> Roundings {
        let Roundings { of_format, wider } = other;
        Roundings {
            of_format: self.of_format.max(of_format),
            wider: self.wider.max(wider),
        }
    }

    /// (1+u)^K, exactly.
    pub fn power(self, format: Format) -> Big {
        let power = |unit: Dyadic, times: u32| {
            let step = Big::one() + Big::from(unit);
            (0..times).fold(Big::one(), |product, _| product * &step)
        };
        power(format.unit(), self.of_format) * power(wider_unit(format), self.wider)
    }
}

/// The unit roundoff of the wider arithmetic.
fn wider_unit(format: Format) -> Dyadic {
    if format == Format::F32 {
        Format::F64.unit()
    } else {
        Dyadic::power(2 - 2 * format.digits as i32)
    }
}

impl Relative {
    /// The factor of a filter: a sign is right where |computed| is at least this times the permanent as
    /// it is computed, in the same order. It covers the rounding of the last sum of both, and that of the
    /// product of the factor and the permanent. It holds for sums and products, without underflow.
    pub fn filter(&self, format: Format) -> Big {
        let three = Roundings {
            of_format: 3,
            wider: 0,
        };
        (self.for_sign.power(format) - Big::one()) * three.power(format)
    }
}

/// A number on the way: its roundings, and sizes in the domain.
#[derive(Clone)]
struct Node {
    roundings: Roundings,
    /// Those before its own rounding, if it is a sum.
    before: Option<Roundings>,
    /// True if it is computed with a relative error: it does not cancel, and does not underflow.
    sharp: bool,
    /// The permanent, at most.
    permanent: Big,
    /// The most that underflow adds to the error.
    underflow: Big,
}

impl Node {
    /// A number of this size that is not rounded.
    fn exact(size: Dyadic) -> Node {
        Node {
            roundings: Roundings::default(),
            before: None,
            sharp: true,
            permanent: size.into(),
            underflow: Big::zero(),
        }
    }
}

/// The form of a number relative to its permanent; an error in one sentence if it has none: it is
/// divided by a number that may cancel, or is a root. The domain says how large numbers are that
/// multiply an underflow; the factor does not depend on it.
pub fn relative(path: &Path, place: Place, domain: Domain, format: Format) -> Proven<Relative> {
    let mut forms = Forms {
        path,
        format,
        prover: Prover::new(path, domain, format),
        nodes: Vec::new(),
    };
    forms.nodes.resize(path.operations.len(), None);
    let node = forms.node(place)?;
    let roundings = node.roundings;
    let factor = round_up(&(roundings.power(format) - Big::one()), DIGITS);
    let underflow = round_up(&node.underflow, DIGITS);
    Ok(Relative {
        roundings,
        for_sign: node.before.unwrap_or(roundings),
        factor,
        underflow,
    })
}

struct Forms<'a> {
    path: &'a Path,
    format: Format,
    prover: Prover<'a>,
    nodes: Vec<Option<Node>>,
}

impl Forms<'_> {
    fn node(&mut self, place: Place) -> Proven<Node> {
        if let Some(node) = &self.nodes[place as usize] {
            return Ok(node.clone());
        }
        let node = self.made(place)?;
        self.nodes[place as usize] = Some(node.clone());
        Ok(node)
    }

    fn made(&mut self, place: Place) -> Proven<Node> {
        let operation = self.path.operations[place as usize];
        if let Some(leaf) = Leaf::of(operation, &self.path.operations) {
            let mut node = Node::exact(leaf.bound(&self.prover.domain));
            if leaf.is_difference() {
                node.before = Some(node.roundings);
                node.roundings = Roundings::ONE;
            }
            return Ok(node);
        }
        match operation {
            Operation::Input(_) => unreachable!("inputs are leaves"),
            Operation::Number(value) => Ok(Node::exact(Dyadic::new(i128::from(value).abs(), 0))),
            Operation::Neg(a) | Operation::Abs(a) => self.node(a),
            Operation::Add(..) | Operation::Sub(..) | Operation::Mul(..) | Operation::Fma(..) => {
                let term = |(_, a, b): Term<Place>| match b {
                    Some(b) => self.product(a, b),
                    None => self.node(a),
                };
                let terms = operation.terms().map(term).collect::<Proven<Vec<Node>>>()?;
                let is_exact = |x: &Node| x.sharp && x.roundings == Roundings::default();
                let sharp = terms.iter().all(is_exact);
                let has_product = operation.terms().any(|(_, _, b)| b.is_some());
                let is_sum = 1 < terms.len();
                let exact = terms.into_iter().reduce(|a, b| sum(&a, &b));
                let exact = exact.expect("a term");
                let mut rounded = self.rounded(exact, i128::from(has_product));
                rounded.sharp = sharp;
                rounded.before = rounded.before.filter(|_| is_sum);
                Ok(rounded)
            }
            Operation::Minor(a, b, c, d) => {
                let p = self.product(a, b)?;
                let q = self.product(c, d)?;
                let (sum, before) = (sum(&p, &q), p.roundings.or(q.roundings));
                let wider = Roundings {
                    of_format: 0,
                    wider: 1,
                };
                if self.format == Format::F32 {
                    // First to f64, where no product of two f32 underflows. Two roundings in a row do not
                    // change a sign.
                    let twice = self.rounded(self.rounded(sum, 0), 1);
                    let roundings = before.and(Roundings::ONE).and(wider);
                    return Ok(Node {
                        roundings,
                        before: Some(before),
                        ..twice
                    });
                }
                // x = (p - q) + (e - f), where p and q are rounded products and e and f their
                // remainders. Each difference is rounded, and then their sum. |p - q| is at most |x| and u
                // times the permanent, and |e - f| at most u times it: so an error of u and 2u² of it
                // before the last sum. The remainders may underflow.
                let before = before.and(Roundings::ONE).and(wider);
                let thrice = self.rounded(self.rounded(self.rounded(sum, 2), 0), 0);
                Ok(Node {
                    roundings: before.and(Roundings::ONE),
                    before: Some(before),
                    ..thrice
                })
            }
            Operation::Div(n, d) => {
                let (n, d) = (self.node(n)?, self.node(d)?);
                if !n.sharp || !d.sharp {
                    return Err(
                        "it is divided by a number, or of a number, that may cancel".to_owned()
                    );
                }
                let mut quotient = Node::exact(self.prover.bound(place)?.size);
                quotient.roundings = n.roundings.and(d.roundings);
                quotient.sharp = false;
                let mut rounded = self.rounded(quotient, 1);
                rounded.before = None;
                Ok(rounded)
            }
            Operation::Sqrt(_) => Err("it has a root".to_owned()),
        }
    }

    /// An exact product of computed numbers.
    fn product(&mut self, a: Place, b: Place) -> Proven<Node> {
        let (a, b) = (self.node(a)?, self.node(b)?);
        let computed = |x: &Node| x.roundings.power(self.format) * &x.permanent;
        // The computed b is at most its permanent with its errors.
        let underflow = &a.underflow * (computed(&b) + &b.underflow) + computed(&a) * &b.underflow;
        Ok(Node {
            roundings: a.roundings.and(b.roundings),
            before: None,
            sharp: false,
            permanent: a.permanent * b.permanent,
            underflow,
        })
    }

    /// One more rounding, which may underflow so often.
    fn rounded(&self, exact: Node, underflows: i128) -> Node {
        let step = Big::one() + Big::from(self.format.unit());
        let tiny = Big::from(Dyadic::new(underflows, 0)) * Big::from(self.format.tiny());
        Node {
            before: Some(exact.roundings),
            roundings: exact.roundings.and(Roundings::ONE),
            underflow: exact.underflow * step + tiny,
            ..exact
        }
    }
}

/// An exact sum of computed numbers.
fn sum(a: &Node, b: &Node) -> Node {
    Node {
        roundings: a.roundings.or(b.roundings),
        before: None,
        sharp: false,
        permanent: &a.permanent + &b.permanent,
        underflow: &a.underflow + &b.underflow,
    }
}
