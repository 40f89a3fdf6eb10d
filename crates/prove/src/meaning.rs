//! The exact number that a gate compares, in the words of a user: a barycentric coordinate or t, times something that
//! depends on the kernel. Like the numbers of a scene it is known by its value, in whatever order a program computes it.

use super::measures::Sample;
use super::run::cone;
use super::samples::Samples;
use super::{Domain, Proof};
use crate::arith::recorded::{Operation, Place};
use crate::arith::{Real, Vector};
use std::cell::OnceCell;
use std::collections::HashMap;

/// Where the line meets the plane, or how the ray lies to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum What {
    /// Nothing but the scale.
    One,
    /// Nothing but the size of the scale.
    Size,
    /// The barycentric coordinate of a vertex.
    Weight(usize),
    /// 1 less that.
    Rest(usize),
    /// t.
    Time,
    /// t less t_min.
    AfterMin,
    /// t_max less t.
    BeforeMax,
}

/// The factor that depends on the kernel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Scale {
    /// 1.
    One,
    /// N·d, N = (b-a)×(c-a).
    Volume,
    /// 2 N·d.
    Twice,
    /// N·d over a coordinate of d.
    Over(usize),
    /// |N|.
    Length,
    /// N·N.
    Square,
    /// N·d over |N|.
    Sine,
}

/// The exact value of a number: `what` times `scale`, or the negative of that.
#[derive(Clone, Copy)]
pub struct Meaning {
    /// Which program it is of: the same one always rounds alike.
    pub number: usize,
    pub what: What,
    pub scale: Scale,
    pub is_minus: bool,
}

const WHATS: [What; 10] = {
    use What::*;
    let [a, b, c] = [Weight(0), Weight(1), Weight(2)];
    [
        One,
        a,
        b,
        c,
        Rest(0),
        Rest(1),
        Rest(2),
        Time,
        AfterMin,
        BeforeMax,
    ]
};

const SCALES: [Scale; 9] = {
    use Scale::*;
    [
        One,
        Volume,
        Twice,
        Over(0),
        Over(1),
        Over(2),
        Length,
        Square,
        Sine,
    ]
};

impl What {
    fn of<R: Real>(self, sample: &Sample<R>) -> R {
        match self {
            What::One | What::Size => R::one(),
            What::Weight(vertex) => sample.weight(vertex),
            What::Rest(vertex) => R::one() - sample.weight(vertex),
            What::Time => sample.time(),
            What::AfterMin => sample.time() - &sample.ends[0],
            What::BeforeMax => sample.ends[1].clone() - sample.time(),
        }
    }
}

impl Scale {
    pub(super) fn of<R: Real>(self, sample: &Sample<R>) -> R {
        let square = || sample.normal.dot(&sample.normal);
        match self {
            Scale::One => R::one(),
            Scale::Volume => sample.volume(),
            Scale::Twice => sample.volume() + sample.volume(),
            Scale::Over(axis) => sample.volume() / sample.direction.at(axis),
            Scale::Length => square().sqrt(),
            Scale::Square => square(),
            Scale::Sine => sample.volume() / square().sqrt(),
        }
    }

    /// True if its sign says which side the ray meets.
    pub fn has_sign(self) -> bool {
        !matches!(self, Scale::One | Scale::Length | Scale::Square)
    }

    /// Its size is at least this in a domain where |N·d| is at least the floor, or the scene's least.
    pub fn least(self, domain: &Domain) -> f64 {
        // |d| is at most √3 times its largest coordinate.
        let [floor, direction] = [domain.floor, domain.direction].map(|x| x.to_f64());
        let (length, sine, volume) = match &domain.measures {
            Some(of) => (
                of.area.to_f64(),
                of.sine.to_f64(),
                (of.area * of.sine).to_f64(),
            ),
            None => {
                // A coordinate of N is at most twice the square of an edge's, and |N| at most √3 times that.
                let edge = domain.edge.to_f64();
                let longest = 2.0 * 1.732_050_81 * edge * edge;
                (floor / (direction * 1.732_050_81), floor / longest, floor)
            }
        };
        match self {
            Scale::One => 1.0,
            Scale::Volume => volume,
            Scale::Twice => 2.0 * volume,
            Scale::Over(_) => volume / direction,
            // A program that divides by a length supposes that it is not below the floor.
            Scale::Length if domain.measures.is_none() => floor,
            Scale::Length => length,
            Scale::Square => length * length * (1.0 - 1e-9),
            Scale::Sine => sine,
        }
    }

    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Scale::One => "1",
            Scale::Volume => "|N·d|",
            Scale::Twice => "2|N·d|",
            Scale::Over(_) => "|N·d/d_k|",
            Scale::Length => "|N|",
            Scale::Square => "N·N",
            Scale::Sine => "|N·d|/|N|",
        }
    }
}

fn product<R: Real>(what: What, scale: Scale, sample: &Sample<R>) -> R {
    what.of(sample) * scale.of(sample)
}

/// The meanings of a proof's numbers, each program looked at once.
pub struct Meanings<'a> {
    proof: &'a Proof,
    samples: Vec<OnceCell<Samples<'a>>>,
    /// By program; by its path too where its sign depends on that.
    known: HashMap<(Option<usize>, Vec<Operation>), Option<Meaning>>,
}

impl<'a> Meanings<'a> {
    pub fn new(proof: &'a Proof) -> Meanings<'a> {
        let samples = proof.paths.iter().map(|_| OnceCell::new()).collect();
        Meanings {
            proof,
            samples,
            known: HashMap::new(),
        }
    }

    /// The meaning of a number, if it has one.
    pub fn of(&mut self, path: usize, place: Place) -> Option<Meaning> {
        let program = cone(&self.proof.paths[path].operations, place).operations;
        let program = (Samples::has_sizes(&program).then_some(path), program);
        if let Some(known) = self.known.get(&program) {
            return *known;
        }
        let samples = self.samples[path].get_or_init(|| Samples::new(&self.proof.paths[path]));
        let number = self.known.len();
        let meaning = SCALES.into_iter().find_map(|scale| {
            let mut whats = WHATS.into_iter();
            let (what, is_minus) =
                whats.find_map(|what| product_at(samples, place, what, scale))?;
            Some(Meaning {
                number,
                what,
                scale,
                is_minus,
            })
        });
        self.known.insert(program, meaning);
        meaning
    }
}

/// The number at a place as this product, and true if it is the negative of it; none if it is another number.
fn product_at(
    samples: &Samples<'_>,
    place: Place,
    what: What,
    scale: Scale,
) -> Option<(What, bool)> {
    let is_this = samples.may_be(place, |i| product(what, scale, &samples.values[i].1))
        && samples.is_exactly(place, |sample| product(what, scale, sample));
    if !is_this {
        return None;
    }
    // Where |x| is compared, it is large on both sides of the triangle, whichever of them the path is for.
    if what == What::One && scale.has_sign() && samples.is_size(place) {
        return Some((What::Size, false));
    }
    let is_minus = samples.is_negative_of(place, |sample| product(what, scale, sample))?;
    Some((what, is_minus))
}
