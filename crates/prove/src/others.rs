//! Gates that are not about edges: where they may refuse a hit, or let something through.
//!
//! Such a gate is read as an edge gate is, by each way to be accepted and for either sign of N·d. If it compares a number with
//! the wrong sign, or in the wrong direction, it may refuse any hit, and nothing is said of it.

use super::facts::{Fact, Form, Reader, wanted_sides};
use super::meaning::{Meaning, Meanings, Scale, What};
use super::order::unsigned;
use super::{Domain, Proof};
use crate::arith::recorded::Comparison::{AtMost, Negative};
use crate::arith::recorded::{Operation, Place};
use crate::contract::{Extent, Sides};
use crate::kernel::{Compared, Entry, Path, Role};
use std::ops::Range;

/// A gate that is not about edges, and where it may decide wrongly.
#[derive(Clone, Debug)]
pub struct Other {
    /// The gate; none for a test of an end that no gate has.
    pub gate: Option<usize>,
    /// Where.
    pub may: WrongDecisions,
}

/// Where a gate that is not about edges may decide wrongly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WrongDecisions {
    /// It never refuses a hit of the domain.
    Never,
    /// It may refuse a hit where the size of a number of this name is below this.
    Refuse(&'static str, f64),
    /// It may refuse a hit whose t is nearer to an end than the first, and let one through that is farther beyond than the second.
    Ends(f64, f64),
    /// Nothing is known.
    Unknown,
    /// No gate compares t with this end, so hits beyond it are let through.
    Missing(End),
}

/// An end of the ray.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// t = 0, or t_min.
    Start,
    /// t_max.
    Far,
}

/// A kernel at some epsilons, and the bounds of its numbers.
pub(super) struct Others<'a> {
    pub entry: &'a Entry,
    pub proof: &'a Proof,
    pub epsilons: &'a [f64],
    pub parts: &'a [Domain],
}

/// All that a gate compares on a path.
#[derive(PartialEq)]
struct OnPath {
    comparisons: Vec<Form>,
    /// The side that the path is surely for, true where the scale is positive: it has asked for the sign of this scale.
    side: Option<(Scale, bool)>,
    /// True if it is a hit when every gate accepts.
    hits: bool,
}

impl OnPath {
    /// The ends that it looks at.
    fn ends(&self) -> impl Iterator<Item = End> {
        let facts = self.comparisons.iter().flat_map(Form::facts);
        facts.filter_map(end_of)
    }
}

impl<'a> Others<'a> {
    /// All gates that are not about edges.
    pub fn all(&self, meanings: &mut Meanings<'a>) -> Vec<Other> {
        let mut others = Vec::new();
        let mut ends: Option<Vec<End>> = Some(Vec::new());
        for (gate, info) in self.entry.info.gates.iter().enumerate() {
            if info.role == Role::Edge {
                continue;
            }
            let on_paths = self.on_paths(gate, meanings);
            if info.role == Role::T {
                let found = on_paths.as_ref().map(|all| ends_in(all));
                ends = ends
                    .zip(found)
                    .map(|(before, found)| [before, found].concat());
            }
            let may = on_paths.and_then(|on_paths| self.may(gate, &on_paths));
            others.push(Other {
                gate: Some(gate),
                may: may.unwrap_or(WrongDecisions::Unknown),
            });
        }
        let wanted: &[End] = match self.entry.info.contract.extent {
            Extent::Line => &[],
            Extent::Ray => &[End::Start],
            Extent::Interval => &[End::Start, End::Far],
        };
        // Where a gate of t is not read, nothing is known to be missing.
        let ends = ends.unwrap_or(wanted.to_vec());
        for end in wanted.iter().filter(|end| !ends.contains(end)) {
            others.push(Other {
                gate: None,
                may: WrongDecisions::Missing(*end),
            });
        }
        others
    }

    /// A gate as it is on each path, if all that it compares is known.
    fn on_paths(&self, gate: usize, meanings: &mut Meanings<'a>) -> Option<Vec<OnPath>> {
        let mut all: Vec<OnPath> = Vec::new();
        for (index, path) in self.proof.paths.iter().enumerate() {
            let mut comparisons = Vec::new();
            for compared in path.compared.iter().filter(|it| it.gate == gate) {
                if !compared.is_margin() && self.epsilons[gate] != 0.0 {
                    return None;
                }
                let (index, compared) = self
                    .difference_of_equals(path, compared)
                    .unwrap_or((index, compared));
                let mut reader = Reader {
                    proof: self.proof,
                    index,
                    path: &self.proof.paths[index],
                    meanings,
                };
                comparisons.push(reader.form(compared)?);
            }
            let side = if comparisons.is_empty() {
                None
            } else {
                self.side_of(index, meanings)
            };
            let here = OnPath {
                comparisons,
                side,
                hits: path.hits,
            };
            if !all.contains(&here) {
                all.push(here);
            }
        }
        Some(all)
    }

    /// The sign of a scale that a path has asked for, if rounding cannot have changed it in the domain.
    fn side_of(&self, index: usize, meanings: &mut Meanings<'a>) -> Option<(Scale, bool)> {
        let path = &self.proof.paths[index];
        let gates = 0..self.entry.info.gates.len();
        path.decisions.iter().find_map(|(comparison, is_negative)| {
            let Negative(place) = *comparison else {
                return None;
            };
            // The error is known of numbers that gates compare too.
            let mut programs = gates.clone().map(|gate| (gate, index, place));
            let program = programs.find_map(|key| self.proof.programs.get(&key))?;
            let Meaning {
                what,
                scale,
                is_minus,
            } = meanings.of(index, place)?;
            let is_sure = |domain: &Domain| {
                let error = self.proof.error(*program, domain);
                error.is_ok_and(|error| error < scale.least(domain))
            };
            let is_known = what == What::One && scale.has_sign() && self.parts.iter().all(is_sure);
            is_known.then_some((scale, *is_negative == is_minus))
        })
    }

    /// Where a = b and a gate compares 0: its comparison on another path, of a - b, which is 0 here too.
    fn difference_of_equals(&self, path: &Path, compared: &Compared) -> Option<(usize, &Compared)> {
        let made = &path.decisions[..compared.decisions];
        let [before @ .., (AtMost(a, b), true), (AtMost(c, d), true)] = made else {
            return None;
        };
        let is_zero = |place: &Place| {
            path.operations[unsigned(path, *place) as usize] == Operation::Number(0)
        };
        if (a, b) != (d, c) || !compared.quantities.iter().all(is_zero) {
            return None;
        }
        let mut others = self.proof.paths.iter().enumerate();
        others.find_map(|(index, other)| {
            let is_here = |it: &&Compared| it.gate == compared.gate && before.len() < it.decisions;
            let here = other.compared.iter().find(is_here)?;
            let [place] = here.quantities[..] else {
                return None;
            };
            let is_difference = other.operations[place as usize] == Operation::Sub(*a, *b);
            (other.decisions.starts_with(before) && is_difference).then_some((index, here))
        })
    }

    /// The wrong decisions of a gate that is so on its paths; none if nothing is known.
    fn may(&self, gate: usize, on_paths: &[OnPath]) -> Option<WrongDecisions> {
        let wanted = self.entry.info.contract.sides;
        let mut may = None;
        let comparisons = on_paths
            .iter()
            .flat_map(|path| path.comparisons.iter().map(|form| (form, path.side)));
        for (form, side) in comparisons {
            for side in sides_of(form, side, wanted) {
                let refuses = form.refuses[side].as_ref()?;
                if !bounds_ends(form, refuses, side == 0) {
                    return None;
                }
                for fact in refuses {
                    for domain in self.parts {
                        let here = self.of_fact(gate, fact, domain)?;
                        may = Some(may.map_or(Some(here), |before| worse(before, here))?);
                    }
                }
            }
        }
        // A path that looks at fewer ends lets everything through there.
        let all = ends_in(on_paths);
        let mut hits = on_paths.iter().filter(|path| path.hits);
        let is_alike = hits.all(|path| all.iter().all(|end| path.ends().any(|it| it == *end)));
        may.filter(|_| is_alike)
    }

    /// The wrong decisions where a gate takes a number to be too small.
    fn of_fact(&self, gate: usize, fact: &Fact, domain: &Domain) -> Option<WrongDecisions> {
        let e = self.epsilons[gate];
        let error = self.proof.error(fact.program, domain).ok()?;
        let least = fact.scale.least(domain);
        match fact.what {
            What::One | What::Size if e + error < least => Some(WrongDecisions::Never),
            What::One | What::Size => Some(WrongDecisions::Refuse(fact.scale.name(), e + error)),
            What::Weight(_) | What::Rest(_) => None,
            What::Time | What::AfterMin | What::BeforeMax => {
                let [early, late] = [e + error, error - e].map(|x| x.max(0.0) / least);
                Some(WrongDecisions::Ends(early, late))
            }
        }
    }
}

/// The sides on which a comparison meets hits that are owed, as indices of what it [refuses](Form::refuses).
fn sides_of(form: &Form, side: Option<(Scale, bool)>, wanted: Sides) -> Range<usize> {
    let sides = wanted_sides(form.facts().copied(), wanted);
    let signed: Vec<&Fact> = form.facts().filter(|fact| fact.has_sign()).collect();
    match side {
        Some((scale, is_positive))
            if !signed.is_empty() && signed.iter().all(|fact| fact.scale == scale) =>
        {
            let side = usize::from(!is_positive);
            let is_wanted = usize::from(sides.contains(&side));
            side..side + is_wanted
        }
        _ => sides,
    }
}

/// The end that a number is the distance of t from, if it is.
fn end_of(fact: &Fact) -> Option<End> {
    match fact.what {
        What::Time | What::AfterMin => Some(End::Start),
        What::BeforeMax => Some(End::Far),
        What::One | What::Size | What::Weight(_) | What::Rest(_) => None,
    }
}

/// The ends that a gate looks at on some path.
fn ends_in(on_paths: &[OnPath]) -> Vec<End> {
    let mut ends = vec![End::Start, End::Far];
    ends.retain(|end| on_paths.iter().any(|path| path.ends().any(|it| it == *end)));
    ends
}

/// True if a gate that refuses t beyond some ends accepts it in no other way, where N·d is positive, or negative.
fn bounds_ends(form: &Form, refuses: &[Fact], side: bool) -> bool {
    form.ways.iter().all(|way| {
        // N·d itself has the other sign.
        let is_impossible = way
            .iter()
            .any(|fact| fact.what == What::One && !fact.is_side(side));
        let has = |end: End| {
            way.iter()
                .any(|fact| end_of(fact) == Some(end) && fact.is_side(side))
        };
        is_impossible || refuses.iter().filter_map(end_of).all(has)
    })
}

/// Both of two wrong decisions of a gate; none if they cannot be said in one.
fn worse(one: WrongDecisions, other: WrongDecisions) -> Option<WrongDecisions> {
    use WrongDecisions::{Ends, Never, Refuse};
    match (one, other) {
        (Never, it) | (it, Never) => Some(it),
        (Refuse(name, x), Refuse(other, y)) if name == other => Some(Refuse(name, x.max(y))),
        (Ends(a, b), Ends(c, d)) => Some(Ends(a.max(c), b.max(d))),
        _ => None,
    }
}
