//! Writes a file with all its mutants in it. Which one is active is asked at each site while the program runs.

use crate::find::{Form, Mutant, Site};
use std::collections::{HashMap, HashSet};
use std::ops::Range;

/// A file with its mutants, and where they stand in it.
pub struct Rewritten {
    pub text: String,
    /// The spans of the mutants' texts, by id.
    mutants: Vec<(Range<usize>, u32)>,
    /// The spans of the sites, by number.
    sites: Vec<(Range<usize>, u32)>,
}

/// What the rewritten files call; it is added to the end of the crate's root.
pub fn runtime(sites: usize) -> String {
    include_str!("runtime.rs").replace("SITES: usize = 0", &format!("SITES: usize = {}", sites + 1))
}

/// Writes the mutants into a file, except those that do not compile.
pub fn rewrite<'m>(
    text: &str,
    sites: &[Site],
    mutants: impl Iterator<Item = &'m Mutant>,
    refused: &HashSet<u32>,
) -> Rewritten {
    let mut by_site: HashMap<u32, Vec<&Mutant>> = HashMap::new();
    for mutant in mutants.filter(|mutant| !refused.contains(&mutant.id)) {
        by_site.entry(mutant.site).or_default().push(mutant);
    }
    let mut sites: Vec<(&Site, &[&Mutant])> = sites
        .iter()
        .filter_map(|site| Some((site, by_site.get(&site.number)?.as_slice())))
        .collect();
    // The outer site first: what begins earlier, or ends later.
    sites.sort_by_key(|(site, _)| {
        (
            site.range.start,
            usize::MAX - site.range.end,
            site.form as u8,
        )
    });
    let mut out = Rewritten {
        text: String::new(),
        mutants: Vec::new(),
        sites: Vec::new(),
    };
    let mut sites = sites.as_slice();
    out.copy(text, 0..text.len(), &mut sites);
    out
}

impl Rewritten {
    /// Copies a span of the text with the sites in it.
    fn copy(&mut self, text: &str, span: Range<usize>, sites: &mut &[(&Site, &[&Mutant])]) {
        let mut done = span.start;
        while let Some(((site, mutants), rest)) = sites.split_first()
            && site.range.end <= span.end
        {
            *sites = rest;
            self.text.push_str(&text[done..site.range.start]);
            self.site(text, site, mutants, sites);
            done = site.range.end;
        }
        self.text.push_str(&text[done..span.end]);
    }

    fn site(
        &mut self,
        text: &str,
        site: &Site,
        mutants: &[&Mutant],
        inner: &mut &[(&Site, &[&Mutant])],
    ) {
        let from = self.text.len();
        let at = format!("crate::mutant::at({})", site.number);
        let span = site.range.clone();
        match site.form {
            Form::Expression => {
                self.text += &format!("(match {at} {{ ");
                for mutant in mutants {
                    self.arm(mutant, &mutant.text);
                }
                self.text += "_ => ";
                self.copy(text, span, inner);
                self.text += " })";
            }
            Form::Body => {
                self.text += &format!("{{ match {at} {{ ");
                for mutant in mutants {
                    self.arm(mutant, &format!("return {}", mutant.text));
                }
                self.text += "_ => {} } ";
                self.copy(text, span.start + 1..span.end, inner);
            }
            Form::Statement | Form::LetCondition => {
                let begin = self.text.len();
                let (before, after) = match site.form {
                    Form::Statement => (format!("if {at} != {} {{ ", mutants[0].id), " }"),
                    _ => (format!("{at} != {} && ", mutants[0].id), ""),
                };
                self.text += &before;
                self.mutants.push((begin..self.text.len(), mutants[0].id));
                self.copy(text, span, inner);
                self.text += after;
            }
        }
        self.sites.push((from..self.text.len(), site.number));
    }

    fn arm(&mut self, mutant: &Mutant, value: &str) {
        let begin = self.text.len();
        self.text += &format!("{} => {value}, ", mutant.id);
        self.mutants.push((begin..self.text.len(), mutant.id));
    }

    /// The mutants and sites that an error at a span speaks of: mutants that it lies in, otherwise sites that lie in
    /// it, otherwise the innermost site around it.
    pub fn blame(&self, span: &Range<usize>) -> Blame {
        let inside = |outer: &Range<usize>, inner: &Range<usize>| {
            outer.start <= inner.start && inner.end <= outer.end
        };
        let mutants = self.mutants.iter().filter(|(range, _)| inside(range, span));
        if let Some((_, id)) = mutants.min_by_key(|(range, _)| range.len()) {
            return Blame::Mutant(*id);
        }
        let within: Vec<u32> = self
            .sites
            .iter()
            .filter(|(range, _)| inside(span, range))
            .map(|(_, n)| *n)
            .collect();
        if !within.is_empty() {
            return Blame::Sites(within);
        }
        let around = self.sites.iter().filter(|(range, _)| inside(range, span));
        let innermost = around.min_by_key(|(range, _)| range.len());
        Blame::Sites(innermost.map(|(_, n)| *n).into_iter().collect())
    }
}

/// What an error of the compiler speaks of.
#[derive(Debug, PartialEq, Eq)]
pub enum Blame {
    Mutant(u32),
    Sites(Vec<u32>),
}
