//! Gates that are not about edges: where they may refuse a hit, or let something through.
//!
//! Such a gate is read as an edge gate is, by each way to be accepted and for either sign of N·d. If it compares a number with
//! the wrong sign, or in the wrong direction, it may refuse any hit, and nothing is said of it.

use super::facts::{Fact, Form, Reader, wanted_sides};
use super::meaning::{Meaning, Meanings, Scale, What};
use super::order::unsigned;
use super::{Domain, Proof};
use crate::arith::recorded::Comparison::{AtMost, Negative, Zero};
use crate::arith::recorded::{Comparison, Operation, Place};
use crate::contract::{Extent, Sides};
use crate::kernel::{Compared, Entry, Path, Role};
use std::ops::Range;

/// A gate that is not about edges, and where it may decide wrongly.
#[derive(Clone, Debug)]
pub struct Other {
    /// The gate; none for a test of an end, or of the side, that no gate has.
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
    /// It may refuse a hit whose t is nearer to an end than the first, and accept one that is up to the second beyond it.
    Ends(f64, f64),
    /// Nothing is known.
    Unknown,
    /// No gate compares t with this end, so hits beyond it are let through.
    Missing(End),
    /// The contract is of front faces alone, and no gate refuses the back wherever it is asked.
    Back,
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
    /// The scale whose sign the path has asked for, and true if it is positive there; none unless rounding surely keeps that sign.
    side: Option<(Scale, bool)>,
    /// True if it is a hit when every gate accepts.
    hits: bool,
    /// True if the path has found that t_min is 0: then t itself tells how far it is from the start.
    starts_at_zero: bool,
}

impl OnPath {
    /// True if a hit of the back is refused, or if it is not known which side its numbers are of.
    fn refuses_back(&self) -> bool {
        let is_against = |fact: &Fact| {
            let is_turned = fact.has_sign() && matches!(fact.scale, Scale::Over(_));
            is_turned || !fact.is_side(true)
        };
        let refuses = |form: &Form| form.ways.iter().all(|way| way.iter().any(is_against));
        let is_of_front = matches!(self.side, Some((Scale::Over(_), _) | (_, false)));
        is_of_front || self.comparisons.iter().any(refuses)
    }

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
        let mut ends = Vec::new();
        // What is not read, or refuses without a gate, may look at an end.
        let mut is_all_read = self.proof.paths.iter().all(|path| path.hits);
        let mut refuses_back = self.entry.info.contract.sides != Sides::Front;
        for (gate, info) in self.entry.info.gates.iter().enumerate() {
            let on_paths = self.on_paths(gate, meanings);
            is_all_read &= on_paths.is_some();
            if let Some(on_paths) = &on_paths {
                ends.extend(ends_in(on_paths));
                refuses_back |= on_paths.iter().all(OnPath::refuses_back);
            }
            if info.role == Role::Edge {
                continue;
            }
            let may = on_paths.and_then(|on_paths| self.may(gate, &on_paths));
            others.push(Other {
                gate: Some(gate),
                may: may.unwrap_or(WrongDecisions::Unknown),
            });
        }
        let wanted: &[End] = match self.entry.info.contract.extent {
            _ if !is_all_read => &[],
            Extent::Line => &[],
            Extent::Ray => &[End::Start],
            Extent::Interval => &[End::Start, End::Far],
        };
        for end in wanted.iter().filter(|end| !ends.contains(end)) {
            others.push(Other {
                gate: None,
                may: WrongDecisions::Missing(*end),
            });
        }
        if is_all_read && !refuses_back {
            others.push(Other {
                gate: None,
                may: WrongDecisions::Back,
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
            let is_zero = |(comparison, answer): &(Comparison, bool)| match *comparison {
                Zero(place) => *answer && path.operations[place as usize] == Operation::Input(15),
                _ => false,
            };
            let here = OnPath {
                comparisons,
                side,
                hits: path.hits,
                starts_at_zero: path.decisions.iter().any(is_zero),
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
                ..
            } = meanings.of(index, place)?;
            let is_sure = |domain: &Domain| {
                let error = self.proof.error(*program, domain);
                error.is_ok_and(|error| error < scale.least(domain))
            };
            let is_known = what == What::One && scale.has_sign() && self.parts.iter().all(is_sure);
            is_known.then_some((scale, *is_negative == is_minus))
        })
    }

    /// On a path that has found a = b a gate may compare 0 in place of a - b: its comparison of a - b on another path.
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
        for path in on_paths {
            for form in &path.comparisons {
                for side in sides_of(form, path.side, wanted) {
                    let refuses = form.refuses[side].as_ref()?;
                    // How far beyond an end it accepts t depends on each way.
                    let of_ends = form.ways.iter().flatten();
                    let of_ends =
                        of_ends.filter(|fact| end_of(fact).is_some() && fact.is_side(side == 0));
                    for fact in refuses.iter().chain(of_ends) {
                        for domain in self.parts {
                            let here = self.of_fact(gate, fact, domain)?;
                            may = Some(may.map_or(Some(here), |before| worse(before, here))?);
                        }
                    }
                }
            }
        }
        // An end that it looks at at all has to bound t on each path.
        let ends = ends_in(on_paths);
        let mut hits = on_paths.iter().filter(|path| path.hits);
        let are_bounded = hits.all(|path| {
            ends.iter()
                .all(|end| self.is_wanted(path, *end) && self.bounds(gate, path, *end))
        });
        may.filter(|_| are_bounded)
    }

    /// True if t may be compared with an end as a path does it: the contract has the end, and it is where the path takes it to be.
    fn is_wanted(&self, path: &OnPath, end: End) -> bool {
        let has = |what: What| {
            let mut facts = path.comparisons.iter().flat_map(Form::facts);
            facts.any(|fact| fact.what == what)
        };
        match (self.entry.info.contract.extent, end) {
            (Extent::Line, _) | (Extent::Ray, End::Far) => false,
            (Extent::Ray, End::Start) => !has(What::AfterMin),
            (Extent::Interval, End::Start) => path.starts_at_zero || !has(What::Time),
            (Extent::Interval, End::Far) => true,
        }
    }

    /// True if a gate accepts no t far beyond an end on a path, on the sides that hits are owed on.
    fn bounds(&self, gate: usize, path: &OnPath, end: End) -> bool {
        let facts = path
            .comparisons
            .iter()
            .flat_map(|form| form.facts().copied());
        let mut sides = wanted_sides(facts, self.entry.info.contract.sides);
        sides.all(|side| {
            path.comparisons.iter().any(|form| {
                let of_path = side_of_path(form, path.side);
                of_path.is_some_and(|of_path| of_path != side)
                    || self.bounds_in_all_ways(gate, form, end, side == 0)
            })
        })
    }

    /// True if all ways to be accepted want t to be on this side of an end, where N·d is positive, or negative.
    fn bounds_in_all_ways(&self, gate: usize, form: &Form, end: End, side: bool) -> bool {
        form.ways.iter().all(|way| {
            // N·d itself has the other sign, and the epsilon does not reach it.
            let is_impossible = |fact: &Fact| {
                let is_far = |domain: &Domain| {
                    let error = self.proof.error(fact.program, domain);
                    error.is_ok_and(|error| error - self.epsilons[gate] < fact.scale.least(domain))
                };
                fact.what == What::One && !fact.is_side(side) && self.parts.iter().all(is_far)
            };
            way.iter()
                .any(|fact| end_of(fact) == Some(end) && fact.is_side(side) || is_impossible(fact))
        })
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

/// The side that a path is surely for, as an index of what a comparison [refuses](Form::refuses), if its numbers have that sign.
fn side_of_path(form: &Form, side: Option<(Scale, bool)>) -> Option<usize> {
    let (scale, is_positive) = side?;
    let mut signed = form.facts().filter(|fact| fact.has_sign()).peekable();
    let is_known = signed.peek().is_some() && signed.all(|fact| fact.scale == scale);
    is_known.then_some(usize::from(!is_positive))
}

/// The sides on which a comparison meets hits that are owed, as indices of what it [refuses](Form::refuses).
fn sides_of(form: &Form, side: Option<(Scale, bool)>, wanted: Sides) -> Range<usize> {
    let sides = wanted_sides(form.facts().copied(), wanted);
    match side_of_path(form, side) {
        Some(side) => side..side + usize::from(sides.contains(&side)),
        None => sides,
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
