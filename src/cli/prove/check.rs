//! Checks certificates, and says what they prove.

use super::ProveArguments;
use crate::cli::exit::{Failure, Status};
use crate::cli::input::read_text;
use crate::cli::output::write_result;
use crate::corpus::InputError;
use crate::kernel::{self, Entry, Role, Scalar};
use crate::prove::certificate::{Claim, program};
use crate::prove::{Domain, checker, each_quantity, format_of, is_impossible, paths_of};
use crate::report::number_of;
use num_traits::ToPrimitive;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Checks certificates, and says what they prove.
pub fn check(arguments: &ProveArguments) -> Result<Status, Failure> {
    // Some take ten times as long as others.
    let files = arguments.check.par_iter().with_max_len(1);
    let lines: Vec<String> = files.map(|file| checked(file)).collect::<Result<_, _>>()?;
    let path = arguments.output.output.first().map_or("-", String::as_str);
    write_result(path, |out| lines.iter().try_for_each(|line| writeln!(out, "{line}")))?;
    Ok(Status::Success)
}

fn checked(file: &str) -> Result<String, Failure> {
    let text = read_text(file)?;
    let proved = checker::check(&text)
        .map_err(|refusal| InputError::at(file, refusal.line, refusal.message))?;
    let bounds = number_of(proved.len() as u64, "bound", "bounds");
    let gates = largest_errors(&proved, |_| true);
    // The checker has read this line.
    let kernel = text.lines().nth(1).unwrap_or_default().trim_start_matches("kernel ");
    let (name, scalar) = kernel.split_once(' ').unwrap_or_default();
    // Another format is no kernel's.
    let entry = kernel::find(name).filter(|_| scalar != "float");
    let recorded = entry.map(|entry| in_named_scalar!(scalar, F => recorded::<F>(entry)));
    let sections = sections(&text);
    let mut is_whole = false;
    let whose = match recorded {
        None => "no kernel of that name is here to compare".to_owned(),
        Some(Err(why)) => format!("not compared with the kernel: {why}"),
        Some(Ok(recorded)) => {
            let found: Vec<(usize, String)> =
                sections.iter().flat_map(|section| section.programs.clone()).collect();
            if let Some((line, _)) =
                found.iter().find(|(_, program)| !recorded.contains_key(program))
            {
                let message = format!(
                    "{file}:{line}: the proof is right, but {name} has no such program here: write its certificate again"
                );
                return Err(Failure::Message(Status::Disagreements, message));
            }
            let missing: BTreeSet<&str> = recorded
                .iter()
                .filter(|(program, _)| found.iter().all(|(_, known)| known != *program))
                .map(|(_, gate)| *gate)
                .collect();
            is_whole = missing.is_empty();
            match is_whole {
                true => "all that the kernel compares".to_owned(),
                false => format!("without all of {}", Vec::from_iter(missing).join(", ")),
            }
        }
    };
    // Signs do not depend on the domain.
    let is_edge = |claim: &&checker::Proved| {
        let mut gates = entry.iter().flat_map(|entry| entry.info.gates);
        gates.any(|gate| gate.name == claim.gate && gate.role == Role::Edge)
    };
    let mut of_edges = proved.iter().filter(is_edge).peekable();
    let has_signs = of_edges.peek().is_some() && of_edges.all(|claim| claim.has_signs);
    let signs = if is_whole && has_signs { ", signs of every edge" } else { "" };
    let mut said = format!(
        "{file}: {bounds} proved of {kernel}: what it compares is wrong by at most {gates}{signs} ({whose})"
    );
    // What divides must be there for each size of triangles for which anything is, and so must what does not.
    let of_kind = |is_limited: bool| -> BTreeSet<&str> {
        sections.iter().flat_map(|section| section.of_kind(is_limited)).collect()
    };
    let (limited, unlimited) = (of_kind(true), of_kind(false));
    // A claim without its domain is none.
    for section in &sections {
        let errors = largest_errors(&proved, |program| section.numbers.contains(&program));
        let all = if section.has_limits() { &limited } else { &unlimited };
        let here: BTreeSet<&str> = section.of_kind(section.has_limits()).collect();
        let missing = if here == *all { "" } else { "; programs of other sizes are missing here" };
        let errors = if sections.len() == 1 { String::new() } else { format!(": {errors}") };
        said.push_str(&format!("\n  for every float with {}{errors}{missing}", section.inputs()));
    }
    Ok(said)
}

/// The largest error of each gate, of some programs by their numbers.
fn largest_errors(proved: &[checker::Proved], is_wanted: impl Fn(usize) -> bool) -> String {
    let mut gates: BTreeMap<&str, f64> = BTreeMap::new();
    for claim in proved.iter().filter(|claim| is_wanted(claim.program)) {
        let error = claim.bound.error.to_f64().unwrap_or(f64::INFINITY);
        let most = gates.entry(&claim.gate).or_default();
        *most = most.max(error);
    }
    let gates = gates.iter().map(|(gate, x)| format!("{gate} {x:.3e}"));
    gates.collect::<Vec<_>>().join(", ")
}

/// The part of a certificate for one domain.
#[derive(Default)]
struct Section<'a> {
    domain: &'a str,
    /// The programs' numbers, counted from 0 in the whole certificate.
    numbers: Vec<usize>,
    /// The programs without their lemmas and limits, each with its line.
    programs: Vec<(usize, String)>,
    /// The limits of each program's own.
    limits: Vec<Vec<(&'a str, f64)>>,
}

impl Section<'_> {
    fn has_limits(&self) -> bool {
        self.limits.iter().any(|limits| !limits.is_empty())
    }

    /// The programs with limits of their own, or those without.
    fn of_kind(&self, is_limited: bool) -> impl Iterator<Item = &str> {
        let both = self.programs.iter().zip(&self.limits);
        let wanted = both.filter(move |(_, limits)| limits.is_empty() != is_limited);
        wanted.map(|((_, program), _)| &program[..])
    }

    /// The inputs in words.
    fn inputs(&self) -> String {
        let words: Vec<&str> = self.domain.split(' ').collect();
        let after = |name: &str| {
            let at = words.iter().position(|word| *word == name);
            at.and_then(|at| words.get(at + 1)).map_or(f64::NAN, |word| number(word))
        };
        let mut text = format!(
            "coordinates of edges up to {:.3e}, of vertices from the origin of the ray up to {:.3e}, of points up to \
             {:.3e}, of directions up to {}, t_min and t_max up to {:.3e}",
            after("edge"),
            after("reach"),
            after("world"),
            after("direction"),
            after("extent")
        );
        for (word, name) in [("at-least", "divisors at least"), ("at-most", "quotients at most")] {
            let of_word = self.limits.iter().flatten().filter(|(found, _)| *found == word);
            let mut sizes: Vec<f64> = of_word.map(|(_, size)| *size).collect();
            sizes.sort_by(f64::total_cmp);
            let ends = [sizes.first(), sizes.last()].into_iter().flatten();
            let mut sizes: Vec<String> = ends.map(|x| format!("{x:.3e}")).collect();
            sizes.dedup();
            if !sizes.is_empty() {
                text.push_str(&format!(", {name} {}", sizes.join("..")));
            }
        }
        let other = if self.has_limits() { "other " } else { "" };
        text.push_str(&format!(
            ", {other}divisors at least {:.3e} (the direction's largest coordinate {}), {other}quotients at most {:.3e}",
            after("floor"),
            after("direction-floor"),
            after("quotient")
        ));
        text
    }
}

/// A number that the checker has read, `m` or `m*2^e`.
fn number(word: &str) -> f64 {
    let (mantissa, exponent) = word.split_once("*2^").unwrap_or((word, "0"));
    let mantissa: f64 = mantissa.parse().unwrap_or(f64::NAN);
    mantissa * exponent.parse().map_or(f64::NAN, |exponent: i32| 2f64.powi(exponent))
}

/// The parts of a certificate, one for each of its domains.
fn sections(certificate: &str) -> Vec<Section<'_>> {
    let mut sections: Vec<Section> = Vec::new();
    let (mut at, mut count) = (0, 0);
    for (i, line) in certificate.lines().enumerate() {
        let (word, rest) = line.split_once(' ').unwrap_or((line, ""));
        if word == "domain" {
            at = sections.iter().position(|section| section.domain == rest).unwrap_or_else(|| {
                sections.push(Section { domain: rest, ..Section::default() });
                sections.len() - 1
            });
            continue;
        }
        let Some(section) = sections.get_mut(at) else { continue };
        if word == "program" {
            section.numbers.push(count);
            section.programs.push((i + 1, String::new()));
            section.limits.push(Vec::new());
            count += 1;
        }
        let (Some((_, program)), Some(limits)) =
            (section.programs.last_mut(), section.limits.last_mut())
        else {
            continue;
        };
        match word {
            "program" | "op" | "decision" | "claim" | "end" => {
                program.push_str(line);
                program.push('\n');
            }
            "at-least" | "at-most" => {
                let size = rest.split(' ').next_back().map_or(f64::NAN, number);
                limits.push((word, size));
            }
            _ => {}
        }
    }
    sections
}

/// The programs of all that a kernel's gates compare, as certificates have them, each with its gate.
fn recorded<F: Scalar>(entry: &Entry) -> Result<HashMap<String, &'static str>, String> {
    let mut paths = paths_of::<F>(entry)?;
    paths.retain(|path| !is_impossible(path));
    let mut programs = HashMap::new();
    each_quantity(&paths, None, Domain::UNIT, format_of::<F>(), |path, compared, place, _| {
        let gate = &entry.info.gates[compared.gate];
        let claim = Claim::new(gate, &paths[path], place);
        programs.insert(program(&paths[path], &[], &[claim]), gate.name);
    });
    Ok(programs)
}
