//! Checks certificates, and says what they prove.

use super::ProveArguments;
use super::sizes::{DemandedSize, is_within, why_not};
use crate::arith::ScalarName;
use crate::cli::exit::{Failure, Status};
use crate::cli::input::read_text;
use crate::cli::output::write_result;
use crate::command::named_file::SizeLimit;
use crate::files::InputError;
use crate::kernel::{self, Entry, Path, Role, Scalar};
use crate::printable::printable_lines;
use crate::prove::certificate::operations;
use crate::prove::checker::{self, Number, Proved};
use crate::prove::repair::Guarded;
use crate::prove::{above, compared, is_at_most, is_impossible, paths_of};
use crate::record::number_of;
use num_traits::ToPrimitive;
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Checks certificates, and says what they prove.
pub fn check(arguments: &ProveArguments) -> Result<Status, Failure> {
    // Some take ten times as long as others.
    let files = arguments.check.par_iter().with_max_len(1);
    let demands = &arguments.demand_domain;
    let lines: Vec<String> = files
        .map(|file| checked(file, demands))
        .collect::<Result<_, _>>()?;
    let path = arguments.output.output.first().map_or("-", String::as_str);
    write_result(path, |out| {
        lines
            .iter()
            .try_for_each(|line| writeln!(out, "{}", printable_lines(line)))
    })?;
    Ok(Status::Success)
}

fn checked(file: &str, demands: &[DemandedSize]) -> Result<String, Failure> {
    let text = read_text(file, SizeLimit::CERTIFICATE)?;
    if text
        .lines()
        .nth(3)
        .is_some_and(|line| line.starts_with("guarded "))
    {
        return guarded(file, &text);
    }
    let proved = checker::check(&text)
        .map_err(|refusal| InputError::at(file, refusal.line, refusal.message))?;
    let bounds = number_of(proved.len() as u64, "bound", "bounds");
    let all: Vec<&Proved> = proved.iter().collect();
    let gates = largest_errors(&all);
    let (kernel, name, both) = kernel_of(&text);
    let recorded =
        both.map(|(entry, scalar)| in_named_scalar!(scalar, F => Recorded::new::<F>(entry)));
    let mut is_whole = false;
    let within: Vec<Proved> = proved
        .iter()
        .filter(|claim| is_within(demands, claim))
        .cloned()
        .collect();
    let mut outside = gates_without(&proved, &within);
    let whose = match recorded {
        None => "no kernel of that name is here to compare".to_owned(),
        Some(Err(why)) => format!("not compared with the kernel: {why}"),
        Some(Ok(recorded)) => {
            if let Some(Proved { line, .. }) = proved.iter().find(|claim| !recorded.has(claim)) {
                let message = format!(
                    "{file}:{line}: the proof is right, but {name} has no such program here: write its certificate again"
                );
                return Err(Failure::Message(Status::Disagreements, message));
            }
            let missing = recorded.missing(&proved);
            outside.extend(recorded.missing(&within).into_iter().map(str::to_owned));
            is_whole = missing.is_empty();
            match is_whole {
                true => recorded.all(&proved),
                false => format!("without all of {}", Vec::from_iter(missing).join(", ")),
            }
        }
    };
    if !demands.is_empty()
        && let Some(gate) = outside.first()
    {
        let message = format!("{file}: {}", why_not(demands, &proved, gate));
        return Err(Failure::Message(Status::Disagreements, message));
    }
    // Signs do not depend on the domain.
    let is_edge = |claim: &&Proved| {
        let mut gates = both.iter().flat_map(|(entry, _)| entry.info.gates);
        gates.any(|gate| gate.name == claim.gate && gate.role == Role::Edge)
    };
    let mut of_edges = proved.iter().filter(is_edge).peekable();
    let has_signs = of_edges.peek().is_some() && of_edges.all(|claim| claim.has_signs);
    let signs = if is_whole && has_signs {
        ", signs of every edge"
    } else {
        ""
    };
    let mut said = format!(
        "{file}: {bounds} proved of {kernel}: what it compares is wrong by at most {gates}{signs} ({whose})"
    );
    let mut sections: Vec<(&[Number; 8], Vec<&Proved>)> = Vec::new();
    for claim in &proved {
        match sections
            .iter_mut()
            .find(|(domain, _)| **domain == claim.domain)
        {
            Some((_, claims)) => claims.push(claim),
            None => sections.push((&claim.domain, vec![claim])),
        }
    }
    // What divides must be there for each size of triangles for which anything is, and so must what does not.
    let of_kind = |claims: &[&Proved], is_limited: bool| -> BTreeSet<String> {
        let of_kind = claims
            .iter()
            .filter(|claim| has_limits(claim) == is_limited);
        of_kind
            .map(|claim| claim.programs[0].operations.clone())
            .collect()
    };
    // A claim without its domain is none.
    for (domain, claims) in &sections {
        let is_limited = claims.iter().any(|claim| has_limits(claim));
        let here = of_kind(claims, is_limited);
        let is_whole = here == of_kind(&all, is_limited);
        let missing = if is_whole {
            ""
        } else {
            "; programs of other sizes are missing here"
        };
        let errors = match sections.len() {
            1 => String::new(),
            _ => format!(": {}", largest_errors(claims)),
        };
        let inputs = inputs(domain, claims);
        said.push_str(&format!(
            "\n  for every float with {inputs}{errors}{missing}"
        ));
    }
    Ok(said)
}

/// The gates of which some program is not among these claims.
fn gates_without(all: &[Proved], claims: &[Proved]) -> BTreeSet<String> {
    let has = |claim: &Proved, wanted: &Proved| {
        let is_same = claim.programs[0].operations == wanted.programs[0].operations;
        is_same && claim.gate == wanted.gate
    };
    let without = all
        .iter()
        .filter(|wanted| !claims.iter().any(|claim| has(claim, wanted)));
    without.map(|claim| claim.gate.clone()).collect()
}

/// The kernel of a certificate that the checker has read: its name with its scalar, its name, and both themselves; none of
/// another format, which is no kernel's.
fn kernel_of(text: &str) -> (&str, &str, Option<(&'static Entry, ScalarName)>) {
    let kernel = text
        .lines()
        .nth(1)
        .unwrap_or_default()
        .trim_start_matches("kernel ");
    let (name, scalar) = kernel.split_once(' ').unwrap_or_default();
    let both = kernel::find(name).zip(ScalarName::named(scalar));
    (kernel, name, both)
}

/// The same of the certificate of a guarded kernel.
fn guarded(file: &str, text: &str) -> Result<String, Failure> {
    let margins = checker::check_guarded(text)
        .map_err(|refusal| InputError::at(file, refusal.line, refusal.message))?;
    let (kernel, name, both) = kernel_of(text);
    let made = both.map(|(entry, scalar)| in_named_scalar!(scalar, F => Guarded::new::<F>(entry)));
    let whose = match made {
        Some(Ok(made)) if made.certificate() == text => {
            "`hairline repair` writes the same proof here"
        }
        Some(_) => {
            let message = format!(
                "{file}: the proof is right, but {name} is repaired in another way here: write its certificate again"
            );
            return Err(Failure::Message(Status::Disagreements, message));
        }
        None => "no kernel of that name is here to compare",
    };
    let margins = number_of(margins as u64, "margin was", "margins were");
    Ok(format!(
        "{file}: every hit and every miss of the guarded {kernel} is right: {margins} computed again, and its decisions tried with all \
         signs that can occur ({whose})"
    ))
}

fn float(x: &Number) -> f64 {
    x.to_f64().unwrap_or(f64::INFINITY)
}

/// The largest error of each gate.
fn largest_errors(proved: &[&Proved]) -> String {
    let mut gates: BTreeMap<&str, f64> = BTreeMap::new();
    for claim in proved {
        let most = gates.entry(&claim.gate).or_default();
        *most = most.max(float(&claim.bound.error));
    }
    let gates = gates
        .iter()
        .map(|(gate, x)| format!("{gate} {}", above(*x)));
    gates.collect::<Vec<_>>().join(", ")
}

fn has_limits(claim: &Proved) -> bool {
    claim.limits[..2].iter().any(|limits| !limits.is_empty())
}

/// The inputs that some claims of one domain are about, in words.
fn inputs(domain: &[Number; 8], claims: &[&Proved]) -> String {
    let [
        edge,
        reach,
        world,
        direction,
        extent,
        direction_floor,
        floor,
        quotient,
    ] = domain.each_ref().map(float);
    let mut text = format!(
        "coordinates of edges up to {edge:.3e}, of vertices from the origin of the ray up to {reach:.3e}, of points \
         up to {world:.3e}, of directions up to {direction}, t_min and t_max up to {extent:.3e}"
    );
    for (kind, name) in ["divisors at least", "quotients at most"]
        .into_iter()
        .enumerate()
    {
        let sizes = claims
            .iter()
            .flat_map(|claim| &claim.limits[kind])
            .map(float);
        let mut sizes: Vec<f64> = sizes.collect();
        sizes.sort_by(f64::total_cmp);
        let ends = [sizes.first(), sizes.last()].into_iter().flatten();
        let mut sizes: Vec<String> = ends.map(|x| format!("{x:.3e}")).collect();
        sizes.dedup();
        if !sizes.is_empty() {
            text.push_str(&format!(", {name} {}", sizes.join("..")));
        }
    }
    let other = if claims.iter().any(|claim| has_limits(claim)) {
        "other "
    } else {
        ""
    };
    text.push_str(&format!(
        ", {other}divisors at least {floor:.3e} (the direction's largest coordinate {direction_floor}), \
         {other}quotients at most {quotient:.3e}"
    ));
    let down_to = claims.iter().flat_map(|claim| &claim.limits[2]).map(float);
    if let Some(down_to) = down_to.reduce(f64::min) {
        text.push_str(&format!(
            " (at least {} where a line down-to says so)",
            0.0 - down_to
        ));
    }
    text
}

/// A kernel's paths that some input takes, and the numbers that its gates compare: for each gate and program, the paths.
struct Recorded {
    paths: Vec<Path>,
    numbers: HashMap<(String, String), Vec<usize>>,
}

impl Recorded {
    fn new<F: Scalar>(entry: &Entry) -> Result<Recorded, String> {
        let mut paths = paths_of::<F>(entry)?;
        paths.retain(|path| !is_impossible(path));
        let mut numbers: HashMap<_, Vec<usize>> = HashMap::new();
        for (index, path) in paths.iter().enumerate() {
            for (compared, place) in compared(path) {
                let gate = entry.info.gates[compared.gate].name.to_owned();
                numbers
                    .entry((gate, operations(path, place)))
                    .or_default()
                    .push(index);
            }
        }
        Ok(Recorded { paths, numbers })
    }

    /// True if the orders of inputs follow from the decisions of a path.
    fn follow(&self, orders: &BTreeSet<(usize, usize)>, path: usize) -> bool {
        orders
            .iter()
            .all(|(a, b)| is_at_most(&self.paths[path], *a as u8, *b as u8))
    }

    /// True if a gate compares each of the programs of a claim, on a path with its orders.
    fn has(&self, claim: &Proved) -> bool {
        claim.programs.iter().all(|program| {
            let number = (claim.gate.clone(), program.operations.clone());
            let mut paths = self.numbers.get(&number).into_iter().flatten();
            paths.any(|path| self.follow(&program.orders, *path))
        })
    }

    /// The gates of which some number, on some path, is none of the programs.
    fn missing(&self, proved: &[Proved]) -> BTreeSet<&str> {
        let is_proved = |gate: &str, operations: &str, path: usize| {
            let claims = proved.iter().filter(|claim| claim.gate == gate);
            let mut programs = claims.flat_map(|claim| &claim.programs);
            programs.any(|program| {
                program.operations == operations && self.follow(&program.orders, path)
            })
        };
        let missing = self.numbers.iter().filter(|((gate, operations), paths)| {
            !paths.iter().all(|path| is_proved(gate, operations, *path))
        });
        missing.map(|((gate, _), _)| &gate[..]).collect()
    }

    /// The comparison in words, where nothing is missing.
    fn all(&self, proved: &[Proved]) -> String {
        let programs: BTreeSet<&str> = proved
            .iter()
            .map(|claim| &claim.programs[0].operations[..])
            .collect();
        let all: BTreeSet<&str> = proved
            .iter()
            .flat_map(|claim| &claim.programs)
            .map(|x| &x.operations[..])
            .collect();
        let paths = number_of(self.paths.len() as u64, "path", "paths");
        let programs_ = number_of(programs.len() as u64, "program", "programs");
        let names = match all.len() - programs.len() {
            0 => String::new(),
            more => format!(", and {more} more under other names of axes and vertices"),
        };
        format!("all that the kernel compares, on {paths} recorded again: {programs_}{names}")
    }
}
