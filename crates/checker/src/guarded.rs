//! The certificate of a guarded kernel: its margins, and that its signs decide what its promise asks.
//!
//! docs/guide/repair.md has its lines in "The certificate", and the argument in "Why it is right".

use super::format::Format;
use super::margins::Margins;
use super::names::places;
use super::number::whole;
use super::operations::{index, indices};
use super::program::Program;
use super::promise::Promise;
use super::reader::{Outcome, Reader, ensure};
use super::signs::{Gate, Literal, Pattern, Signs};
use std::collections::HashSet;

/// A tree of decisions is not deeper.
const MOST_STEPS: usize = 1 << 9;

/// The gates that were passed on the way, and the conditions that are sure.
#[derive(Clone, Default)]
struct Way {
    gates: Vec<Gate>,
    sure: Pattern,
}

struct Guarded<'p> {
    program: &'p Program,
    /// The numbers that have a margin.
    margins: HashSet<usize>,
    signs: Signs<'p>,
    steps: usize,
}

/// Reads and checks everything after the heading. Returns how many margins there are.
pub fn check(format: Format, reader: &mut Reader) -> Outcome<usize> {
    let form = "guarded line, ray or interval, and both or front";
    let promise = reader.read(form, Promise::parse)?;
    let program = Program::of_operations(format, reader)?;
    let signs = Signs::new(promise, &program);
    let mut guarded = Guarded {
        program: &program,
        margins: HashSet::new(),
        signs,
        steps: 0,
    };
    guarded.read_margins(reader)?;
    guarded.read_axes(reader)?;
    guarded.step(&Way::default(), reader)?;
    reader.read_word("end")?;
    ensure(
        reader.lines.peek().is_none(),
        "found more lines after the end",
    )?;
    Ok(guarded.margins.len())
}

impl Guarded<'_> {
    fn read_margins(&mut self, reader: &mut Reader) -> Outcome<()> {
        let mut margins = Margins::new(self.program);
        while reader.is_next("margin") {
            let form = "margin OPERATION ROUNDINGS FACTOR, once for an operation";
            let (place, found) = reader.read(form, |words| {
                let &[place, roundings, factor] = words else {
                    return None;
                };
                let place = index(place, self.program.operations.len())?;
                let is_new = !self.margins.contains(&place);
                is_new.then(|| (place, format!("{roundings} {factor}")))
            })?;
            let right = margins.margin(place)?;
            ensure(
                found == right,
                format!("found `{found}`, expected `{right}`"),
            )?;
            self.margins.insert(place);
        }
        Ok(())
    }

    /// Reads the choice of the names of the axes. All steps that follow are to hold under each of them.
    fn read_axes(&mut self, reader: &mut Reader) -> Outcome<()> {
        let mut open = usize::from(reader.is_next("axes"));
        while open > 0 {
            let form = "axes XYZ in some order, or a comparison";
            let axes = reader.read(form, |words| match words {
                [names] => Some(vec![places(names, "xyz")?]),
                _ => self.is_comparison(words).then(Vec::new),
            })?;
            if axes.is_empty() {
                open += 1;
            } else {
                open -= 1;
            }
            self.signs.axes.extend(axes);
            ensure(open < MOST_STEPS, "found too many names of axes")?;
        }
        if self.signs.axes.is_empty() {
            self.signs.axes.push([0, 1, 2]);
        }
        Ok(())
    }

    /// Reads and checks the decisions after a way, each with its branches.
    fn step(&mut self, way: &Way, reader: &mut Reader) -> Outcome<()> {
        self.steps += 1;
        ensure(self.steps < MOST_STEPS, "found too many steps")?;
        if reader.is_next("choice") {
            // Which branch is taken does not matter, because both are proved.
            reader.read("choice COMPARISON", |words| {
                self.is_comparison(words).then_some(())
            })?;
            self.step(way, reader)?;
            self.step(way, reader)
        } else if reader.is_next("sign") {
            self.sign(way, reader)
        } else if reader.is_next("gate") {
            self.gate(way, reader)
        } else if reader.is_next("found") {
            reader.read_word("found")?;
            self.signs.ensure_hit(&way.sure, &way.gates)
        } else {
            reader.read_word("ask")
        }
    }

    /// The branches in which a condition surely holds, and its opposite. Otherwise the kernel asks.
    fn sign(&mut self, way: &Way, reader: &mut Reader) -> Outcome<()> {
        let literal = reader.read("sign CONDITION", |words| {
            let &[word] = words else { return None };
            self.literal(word)
        })?;
        let opposite = literal.negated();
        for sure in [literal, opposite] {
            let mut branch = way.clone();
            branch.sure.push(sure);
            self.step(&branch, reader)?;
        }
        Ok(())
    }

    /// A gate: wherever it misses no hit is possible. After it, one of its patterns of acceptance holds.
    fn gate(&mut self, way: &Way, reader: &mut Reader) -> Outcome<()> {
        let name = reader.read("gate NAME", |words| {
            let &[name] = words else { return None };
            Some(name)
        })?;
        let mut hits = Vec::new();
        while reader.is_next("hit") {
            hits.push(self.pattern("hit CONDITIONS", reader)?);
        }
        while reader.is_next("miss") {
            let mut known = way.sure.clone();
            known.extend(self.pattern("miss CONDITIONS", reader)?);
            let outcome = self.signs.ensure_miss(&known);
            outcome.map_err(|why| format!("gate '{name}' {why}"))?;
        }
        let mut passed = way.clone();
        passed.gates.push(hits);
        self.step(&passed, reader)
    }

    /// Reads a line of conditions.
    fn pattern(&self, form: &str, reader: &mut Reader) -> Outcome<Pattern> {
        reader.read(form, |words| {
            let mut pattern = Vec::new();
            for word in words {
                pattern.push(self.literal(word)?);
            }
            Some(pattern)
        })
    }

    /// Reads a condition as `-3*7!5`, of numbers with margins.
    fn literal(&self, word: &str) -> Option<Literal> {
        let (sign, numbers) = word.split_at_checked(1)?;
        if !["+", "-"].contains(&sign) {
            return None;
        }
        let mut literal = Literal {
            is_negative: sign == "-",
            signs: vec![],
            nonzero: vec![],
        };
        let mut signs = numbers;
        if let Some((before, nonzero)) = numbers.split_once('!') {
            signs = before;
            literal.nonzero = self.numbers(nonzero, '!')?;
        }
        if !signs.is_empty() {
            literal.signs = self.numbers(signs, '*')?;
        }
        Some(literal)
    }

    /// Numbers with margins, separated by a sign.
    fn numbers(&self, text: &str, separator: char) -> Option<Vec<usize>> {
        let mut numbers = Vec::new();
        for word in text.split(separator) {
            let place = whole(word)?;
            if !self.margins.contains(&place) {
                return None;
            }
            numbers.push(place);
        }
        Some(numbers)
    }

    /// True if it is a comparison of floats.
    fn is_comparison(&self, words: &[&str]) -> bool {
        let [name, operands @ ..] = words else {
            return false;
        };
        if indices(operands, self.program.operations.len()).is_none() {
            return false;
        }
        match *name {
            "less" | "at-most" => operands.len() == 2,
            "zero" | "negative" => operands.len() == 1,
            _ => false,
        }
    }
}
