//! The decisions of a kernel, path by path, as decisions that are only made where rounding cannot change them.

use super::super::bound::Proven;
use super::fraction::{Arena, Literal, Numbers};
use crate::arith::recorded::{Comparison, Operation, Outcome, Place};
use crate::kernel::{Acceptance, Path};
use std::collections::HashMap;

/// Conditions that must all hold.
pub type Pattern = Vec<Literal>;

/// The next decision of a guarded kernel.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// Goes one of two ways, by plain floats: both are right.
    Choice(Comparison, Box<Step>, Box<Step>),
    /// Goes by a sign, the first way if the condition surely holds, the second way if its opposite does; asks otherwise.
    Sign(Literal, Box<Step>, Box<Step>),
    /// A gate: misses if one of the last patterns surely holds; later hits if one of the first does, and asks otherwise.
    Gate(usize, [Vec<Pattern>; 2], Box<Step>),
    /// Gives the axes other names, then goes on.
    Axes(Axes, Box<Step>),
    /// The end: hits if no gate is open, with these values of t, u and v.
    Hit([Option<Place>; 3]),
    /// Asks.
    Ask,
}

/// The axes that are called x, y and z from here on.
#[derive(Clone, Debug, PartialEq)]
pub enum Axes {
    /// These.
    Are([u8; 3]),
    /// One or the other.
    If(Comparison, Box<Axes>, Box<Axes>),
}

impl Step {
    /// Shows every place in it.
    pub fn each(&mut self, visit: &mut impl FnMut(&mut Place)) {
        match self {
            Step::Choice(comparison, yes, no) => {
                each_of(comparison, visit);
                yes.each(visit);
                no.each(visit);
            }
            Step::Sign(literal, yes, no) => {
                each_literal(literal, visit);
                yes.each(visit);
                no.each(visit);
            }
            Step::Gate(_, patterns, next) => {
                for literal in patterns.iter_mut().flatten().flatten() {
                    each_literal(literal, visit);
                }
                next.each(visit);
            }
            Step::Axes(axes, next) => {
                axes.each(visit);
                next.each(visit);
            }
            Step::Hit(values) => values.iter_mut().flatten().for_each(visit),
            Step::Ask => {}
        }
    }

    /// The steps that may follow at once.
    pub fn next(&self) -> Vec<&Step> {
        match self {
            Step::Choice(_, yes, no) | Step::Sign(_, yes, no) => vec![yes, no],
            Step::Gate(.., next) | Step::Axes(_, next) => vec![next],
            Step::Hit(_) | Step::Ask => vec![],
        }
    }

    /// The step and all that may follow, each before what follows it.
    pub fn all(&self) -> Vec<&Step> {
        let mut all = vec![self];
        for next in self.next() {
            all.extend(next.all());
        }
        all
    }

    /// The conditions on signs that it looks at.
    pub fn literals(&self) -> Vec<&Literal> {
        match self {
            Step::Sign(literal, ..) => vec![literal],
            Step::Gate(_, patterns, _) => patterns.iter().flatten().flatten().collect(),
            _ => vec![],
        }
    }

    /// The step under other names of the axes.
    fn renamed(&self, axes: [u8; 3], arena: &mut Arena) -> Step {
        let mut step = self.clone();
        let mut known = HashMap::new();
        step.each(&mut |place| *place = renamed(*place, axes, &mut known, arena));
        step
    }

    /// The step with choices of axes at its head as such, if what follows is the same but for their names.
    pub fn with_axes(self, arena: &mut Arena) -> Step {
        let Step::Choice(..) = self else { return self };
        let mut body = &self;
        while let Step::Choice(_, _, no) = body {
            body = no;
        }
        let all = [
            [0, 1, 2],
            [1, 2, 0],
            [2, 0, 1],
            [1, 0, 2],
            [0, 2, 1],
            [2, 1, 0],
        ];
        let known = all.map(|axes| (axes, body.renamed(axes, arena)));
        match self.axes(&known) {
            Some(axes) => Step::Axes(axes, Box::new(body.clone())),
            None => self,
        }
    }

    fn axes(&self, known: &[([u8; 3], Step)]) -> Option<Axes> {
        if let Some((axes, _)) = known.iter().find(|(_, step)| step == self) {
            return Some(Axes::Are(*axes));
        }
        let Step::Choice(comparison, yes, no) = self else {
            return None;
        };
        Some(Axes::If(
            *comparison,
            Box::new(yes.axes(known)?),
            Box::new(no.axes(known)?),
        ))
    }
}

impl Axes {
    fn each(&mut self, visit: &mut impl FnMut(&mut Place)) {
        if let Axes::If(comparison, yes, no) = self {
            each_of(comparison, visit);
            yes.each(visit);
            no.each(visit);
        }
    }
}

fn each_literal(literal: &mut Literal, visit: &mut impl FnMut(&mut Place)) {
    literal.signs.iter_mut().for_each(&mut *visit);
    literal.nonzero.iter_mut().for_each(visit);
}

fn each_of(comparison: &mut Comparison, visit: &mut impl FnMut(&mut Place)) {
    *comparison = comparison.with(|mut place| {
        visit(&mut place);
        place
    });
}

/// A number under other names of the axes.
fn renamed(
    place: Place,
    axes: [u8; 3],
    known: &mut HashMap<Place, Place>,
    arena: &mut Arena,
) -> Place {
    if let Some(known) = known.get(&place) {
        return *known;
    }
    let operation = match arena.operations[place as usize] {
        Operation::Input(i @ ..15) => Operation::Input(i / 3 * 3 + axes[usize::from(i % 3)]),
        other => other.with(|operand| renamed(operand, axes, known, arena)),
    };
    let found = arena.push(operation);
    known.insert(place, found);
    found
}

/// Makes the steps of paths.
pub struct Builder<'a> {
    pub paths: &'a [Path],
    pub arena: Arena,
}

impl Builder<'_> {
    /// The steps after so many decisions and gates of some paths, which agree so far.
    pub fn steps(&mut self, set: &[usize], made: usize, gates: usize) -> Proven<Step> {
        let path = &self.paths[set[0]];
        let gate = path.compared.get(gates);
        if let Some(compared) = gate
            && compared.decisions == made
        {
            let patterns = self.patterns(set[0], &compared.accepts);
            let next = self.steps(set, made, gates + 1)?;
            return Ok(Step::Gate(compared.gate, patterns, Box::new(next)));
        }
        if gate.is_none() {
            let mut ends: Vec<Step> = set.iter().map(|path| self.end(*path)).collect();
            ends.dedup();
            if ends.len() == 1 || path.decisions.len() <= made {
                return Ok(ends.swap_remove(0));
            }
        }
        let comparison = path.decisions[made].0;
        if let Some(Acceptance::Fixed(asked, _)) = gate.map(|compared| &compared.accepts)
            && asked.contains(&comparison)
        {
            return self.fixed(set, made, gates);
        }
        let (yes, no): (Vec<usize>, Vec<usize>) = set
            .iter()
            .partition(|path| self.paths[**path].decisions[made].1);
        if yes.is_empty() || no.is_empty() {
            return self.steps(set, made + 1, gates);
        }
        // Where two numbers are equal no margin is left. So the formula of all others is as good there.
        if is_equality(&comparison) {
            return self.steps(&no, made + 1, gates);
        }
        let yes = Box::new(self.steps(&yes, made + 1, gates)?);
        let no = Box::new(self.steps(&no, made + 1, gates)?);
        if yes == no {
            return Ok(*no);
        }
        let mut compared = Vec::new();
        for place in comparison.places() {
            compared.push(path.operations[place as usize]);
        }
        compared.retain(|operation| *operation != Operation::Number(0));
        let are_inputs = compared.iter().all(|it| matches!(it, Operation::Input(_)));
        let is_one_computed = compared.len() < 2 && !are_inputs;
        if !is_one_computed {
            let mut numbers = Numbers::new(&mut self.arena, path);
            let plain = comparison.with(|place| numbers.plain(place));
            return Ok(Step::Choice(plain, yes, no));
        }
        Ok(match self.literal(set[0], comparison, true) {
            Some(literal) => Step::Sign(literal, yes, no),
            None => Step::Ask,
        })
    }

    /// The end of a path on which every gate accepts.
    fn end(&mut self, path: usize) -> Step {
        let path = &self.paths[path];
        let mut numbers = Numbers::new(&mut self.arena, path);
        if !path.hits {
            return Step::Ask;
        }
        let plain = |place: Option<Place>| Some(numbers.plain(place?));
        Step::Hit(path.values.map(plain))
    }

    /// A test without an epsilon: the next decisions are its own.
    fn fixed(&mut self, set: &[usize], made: usize, gates: usize) -> Proven<Step> {
        let mut patterns = [Vec::new(), Vec::new()];
        let mut next = None;
        let mut rest = set.to_vec();
        while let Some(first) = rest.first().copied() {
            let path = &self.paths[first];
            let compared = &path.compared[gates];
            let own = &path.decisions[made..compared.decisions];
            let is_alike = |other: &usize| {
                self.paths[*other].decisions.get(made..compared.decisions) == Some(own)
            };
            let (group, others): (Vec<usize>, Vec<usize>) =
                rest.iter().partition(|other| is_alike(other));
            rest = others;
            let Acceptance::Fixed(asked, accepts) = &compared.accepts else {
                unreachable!("its gate is fixed")
            };
            if !own.iter().all(|(comparison, _)| asked.contains(comparison)) {
                return Err(
                    "a test without an epsilon has comparisons that are not its own".to_owned(),
                );
            }
            let (equalities, signs): (Vec<_>, Vec<_>) = own
                .iter()
                .partition(|(comparison, _)| is_equality(comparison));
            // Where two numbers are equal no margin is left.
            if equalities.iter().any(|(_, is_equal)| *is_equal) {
                continue;
            }
            let literals = signs
                .iter()
                .map(|(comparison, answer)| self.literal(first, *comparison, *answer));
            if let Some(pattern) = literals.collect() {
                patterns[usize::from(!accepts)].push(pattern);
            }
            if *accepts {
                let after = self.steps(&group, compared.decisions, gates + 1)?;
                if next.get_or_insert_with(|| after.clone()) != &after {
                    return Err("it goes on differently after a test without an epsilon".to_owned());
                }
            }
        }
        let next = next.ok_or("a test without an epsilon always rejects")?;
        let gate = self.paths[set[0]].compared[gates].gate;
        Ok(Step::Gate(gate, patterns.map(simplified), Box::new(next)))
    }

    /// The patterns of signs in which a gate accepts, and in which it rejects.
    fn patterns(&mut self, path: usize, accepts: &Acceptance) -> [Vec<Pattern>; 2] {
        match accepts {
            Acceptance::Clauses(_, clauses) => {
                let mut numbers = Numbers::new(&mut self.arena, &self.paths[path]);
                let mut accepts = Vec::new();
                for clause in clauses {
                    let mut pattern = Vec::new();
                    for place in clause {
                        pattern.push(numbers.difference(*place, None));
                    }
                    accepts.push(pattern);
                }
                let rejects = one_negated_of_each(&accepts);
                [accepts, rejects].map(|patterns| simplified(self.possible(patterns)))
            }
            Acceptance::Rounded(outcomes) => [true, false].map(|accepts| {
                let of_kind = outcomes.iter().filter(|outcome| outcome.accepts == accepts);
                let pattern = |outcome: &Outcome| {
                    let answers = outcome.answers.iter();
                    answers
                        .map(|(comparison, answer)| self.literal(path, *comparison, *answer))
                        .collect()
                };
                simplified(of_kind.filter_map(pattern).collect())
            }),
            // What it compares was decided before any gate.
            Acceptance::Fixed(_, accepts) => [if *accepts { vec![vec![]] } else { vec![] }, vec![]],
        }
    }

    /// The condition that a comparison surely has an answer; none if it never has.
    fn literal(&mut self, path: usize, comparison: Comparison, answer: bool) -> Option<Literal> {
        let mut numbers = Numbers::new(&mut self.arena, &self.paths[path]);
        let literal = match comparison {
            Comparison::Less(a, b) | Comparison::AtMost(a, b) => numbers.difference(a, Some(b)),
            Comparison::Negative(a) => numbers.difference(a, None).negated(),
            Comparison::Zero(_) if answer => return None,
            Comparison::Zero(a) => {
                return Some(Literal {
                    is_negative: false,
                    signs: vec![],
                    nonzero: numbers.difference(a, None).places().collect(),
                });
            }
        };
        let literal = if answer { literal } else { literal.negated() };
        self.possible(vec![vec![literal]]).pop()?.pop()
    }

    /// The patterns without those that never hold.
    fn possible(&self, mut patterns: Vec<Pattern>) -> Vec<Pattern> {
        let is_zero = |place: Place| self.arena.operations[place as usize] == Operation::Number(0);
        let never_holds = |literal: &Literal| {
            literal.places().any(is_zero) || literal.signs.is_empty() && literal.is_negative
        };
        patterns.retain(|pattern| !pattern.iter().any(never_holds));
        patterns
    }
}

/// True if a comparison holds where the two numbers are equal.
fn is_equality(comparison: &Comparison) -> bool {
    matches!(comparison, Comparison::Zero(_) | Comparison::AtMost(..))
}

/// The patterns that take a literal of each clause, and have its opposite.
fn one_negated_of_each(clauses: &[Pattern]) -> Vec<Pattern> {
    let mut all = vec![Pattern::new()];
    for clause in clauses {
        let mut longer = Vec::new();
        for known in &all {
            for literal in clause {
                let mut pattern = known.clone();
                pattern.push(literal.negated());
                longer.push(pattern);
            }
        }
        all = longer;
    }
    all
}

/// The same condition with fewer patterns.
fn simplified(mut patterns: Vec<Pattern>) -> Vec<Pattern> {
    for pattern in &mut patterns {
        pattern.sort();
        pattern.dedup();
    }
    patterns.retain(|pattern| !pattern.iter().any(|it| pattern.contains(&it.negated())));
    let all = patterns.clone();
    let mut kept: Vec<Pattern> = Vec::new();
    for pattern in patterns {
        let is_weaker =
            |other: &Pattern| *other != pattern && other.iter().all(|it| pattern.contains(it));
        if !all.iter().any(is_weaker) && !kept.contains(&pattern) {
            kept.push(pattern);
        }
    }
    kept
}
