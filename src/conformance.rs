//! Floor 6, beside the command line: an audit from a program's own tests.

#![forbid(unsafe_code)]

use crate::audit::{self, EpsilonChoice, Plan, PlanError, Source};
use crate::case::Parameters;
use crate::contract::Contract;
use crate::engine::Unobserved;
use crate::family::{FAMILIES, Family, find};
use crate::kernel::{Entry, kept};
use crate::report::{Context, FindingPart, Key, Rate, Record, build, disagreements, interval_of};
use crate::suggest::did_you_mean;
use std::fmt::{self, Write};

/// An audit of a kernel, to be narrowed and run: all families, 2,000 cases of each, seed 1, the
/// kernel's own epsilons and contract, unless said otherwise.
///
/// ```
/// use hairline::{Case, Contract, Entry, Hit, KernelInfo, Vector};
///
/// // The plane's t alone: whatever the triangle, it hits.
/// fn plane(case: &Case<f64>, _: &[f64]) -> Option<Hit<f64>> {
///     let (ray, triangle) = (&case.ray, &case.triangle);
///     let normal = (triangle.b - triangle.a).cross(triangle.c - triangle.a);
///     let t = normal.dot(triangle.a - ray.origin) / normal.dot(ray.direction);
///     (t >= 0.0).then(|| Hit::at(t))
/// }
///
/// const INFO: KernelInfo = KernelInfo::own("plane", Contract::CLOSED_RAY);
/// let kernel = Entry::new(&INFO).f64(plane);
/// hairline::audit(&kernel).families(["interior"]).count(500).assert_conforms();
/// let outcome = hairline::audit(&kernel).families(["outside"]).count(500).run()?;
/// assert!(outcome.findings().any(|finding| finding.finding == "false-hit"));
/// # Ok::<(), hairline::PlanError>(())
/// ```
pub fn audit(kernel: &Entry) -> Request {
    Request {
        entry: kept(kernel),
        families: None,
        count: 2000,
        seed: 1,
        parameters: Parameters::default(),
        epsilons: EpsilonChoice::Source,
        contract: None,
    }
}

/// What to run; see [`audit()`].
#[derive(Clone)]
pub struct Request {
    entry: &'static Entry,
    families: Option<Vec<String>>,
    count: u64,
    seed: u64,
    parameters: Parameters,
    epsilons: EpsilonChoice,
    contract: Option<Contract>,
}

impl Request {
    /// These families only.
    pub fn families<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Request {
        self.families = Some(names.into_iter().map(Into::into).collect());
        self
    }

    /// This many indices of each family; 0 counts as 1.
    pub fn count(mut self, count: u64) -> Request {
        self.count = count.max(1);
        self
    }

    /// Another set of random cases.
    pub fn seed(mut self, seed: u64) -> Request {
        self.seed = seed;
        self
    }

    /// How the cases are transformed: a scale, an offset, unit directions.
    pub fn parameters(mut self, parameters: Parameters) -> Request {
        self.parameters = parameters;
        self
    }

    /// Epsilons by the names of their gates; the others as the kernel has them.
    pub fn epsilons(mut self, pairs: &[(&str, &str)]) -> Request {
        let owned = |(gate, value): &(&str, &str)| ((*gate).to_owned(), (*value).to_owned());
        self.epsilons = EpsilonChoice::Given(pairs.iter().map(owned).collect());
        self
    }

    /// Another contract than the kernel's own.
    pub fn contract(mut self, contract: Contract) -> Request {
        self.contract = Some(contract);
        self
    }

    /// Runs it, in each scalar that the kernel runs in. An error names the family, gate or epsilon
    /// that does not exist.
    pub fn run(&self) -> Result<Outcome, PlanError> {
        let mut rows = self.epsilons.rows(&[self.entry], None)?;
        if let Some(contract) = self.contract {
            rows.iter_mut().for_each(|row| row.contract = contract);
        }
        rows.iter().try_for_each(|row| row.check_in([true; 2]))?;
        let source = |family| Source::Family {
            family,
            parameters: self.parameters.clone(),
            seed: self.seed,
            count: self.count,
            exhaustive: false,
        };
        let plan = Plan {
            rows,
            sources: self.chosen_families()?.into_iter().map(source).collect(),
            scalars: self.entry.scalars(),
            examples: 3,
            attribute: 0,
        };
        let sums = audit::run(&plan, &Unobserved);
        let context = Context { seconds: 0.0, threads: rayon::current_num_threads() };
        Ok(Outcome { record: build(&plan, &sums, &context) })
    }

    /// Runs it and panics unless the kernel keeps its contract on every case. The message has each
    /// kind of finding with its rate and 95 % interval, and the first cases with the command that
    /// shows their truth.
    #[track_caller]
    pub fn assert_conforms(&self) {
        match self.run() {
            Ok(outcome) => outcome.assert_conforms(),
            Err(error) => panic!("{error}"),
        }
    }

    fn chosen_families(&self) -> Result<Vec<&'static Family>, PlanError> {
        let Some(names) = &self.families else { return Ok(FAMILIES.iter().collect()) };
        let known = |name: &String| {
            find(name).ok_or_else(|| {
                let names = FAMILIES.iter().map(|family| family.name);
                let advice = did_you_mean(name, names, "hairline list families");
                PlanError(format!("unknown family '{name}'{advice}"))
            })
        };
        names.iter().map(known).collect()
    }
}

/// What an audit found.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The record, as `hairline audit --format json` writes it; its times are zero.
    pub record: Record,
}

impl Outcome {
    /// Each class of finding that occurred, by scalar, family and epsilons.
    pub fn findings(&self) -> impl Iterator<Item = &FindingPart> {
        self.record.result.results.iter().flat_map(|result| &result.findings)
    }

    /// Whether the kernel kept its contract on every case, and what it promises across triangles.
    pub fn conforms(&self) -> bool {
        conforms(&self.record)
    }

    /// Panics unless [`Outcome::conforms`].
    #[track_caller]
    pub fn assert_conforms(&self) {
        if !self.conforms() {
            panic!("{self}");
        }
    }
}

/// Whether every kernel of a record kept its contract, on polygons and across triangles too.
pub(crate) fn conforms(record: &Record) -> bool {
    disagreements(&record.result).is_empty()
}

/// How many findings a message shows in full.
const SHOWN: usize = 8;

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut parts = Vec::new();
        for result in &self.record.result.results {
            let at = format!("{} {} ({})", result.scalar, result.family, result.set);
            for part in &result.findings {
                parts.push(describe(&at, part)?);
            }
        }
        // What single cases do not show: polygons, and what is promised across triangles.
        let across = disagreements(&self.record.result);
        for found in across.iter().filter(|found| !found.is_of_cases()) {
            let Key { kernel: _, set, scalar, family, class, finding } = &found.key;
            let Rate { count, of, .. } = found.rate;
            let share = interval_of(found.rate);
            let mut text = format!(
                "{scalar} {family} ({set}): {finding} of {class}: {count} of {of}{share}\n"
            );
            if let Some(example) = &found.example {
                writeln!(text, "    hairline explain '{}'", example.case)?;
            }
            parts.push(text);
        }
        for row in &self.record.result.plan.rows {
            let breaks = if parts.is_empty() { "keeps" } else { "breaks" };
            writeln!(f, "{} ({}) {breaks} its contract: {}", row.kernel, row.set, row.contract)?;
        }
        parts.iter().take(SHOWN).try_for_each(|part| f.write_str(part))?;
        match parts.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => writeln!(f, "and {more} more classes of findings"),
        }
    }
}

/// A class of findings with its rate and its first cases.
fn describe(at: &str, part: &FindingPart) -> Result<String, fmt::Error> {
    let Rate { count, of, .. } = part.rate;
    let share = interval_of(&part.rate);
    let mut text = format!("{at}: {} {}: {count} of {of}{share}\n", part.finding, part.class);
    for example in &part.first {
        writeln!(text, "    hairline explain '{}'\n        {}", example.case, example.bits)?;
    }
    Ok(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;
    use crate::kernel::{Hit, KERNELS, KernelInfo};

    #[test]
    fn an_entry_is_kept_once_however_often_it_is_audited() {
        const INFO: KernelInfo = KernelInfo::own("kept-once", Contract::CLOSED_RAY);
        static OWN: &KernelInfo = &INFO;
        let always = |_: &Case<f64>, _: &[f64]| Some(Hit::at(1.0));
        let never = |_: &Case<f64>, _: &[f64]| None;
        let [always, never] = [Entry::new(OWN).f64(always), Entry::new(OWN).f64(never)];
        let kept = |entry: &Entry| std::ptr::from_ref(audit(entry).entry);
        assert_eq!(kept(&always), kept(&always.clone()));
        assert_eq!(kept(&KERNELS[3]), std::ptr::from_ref(&KERNELS[3]));
        // The same name with other code is another kernel.
        assert_ne!(kept(&always), kept(&never));
        let hits = |entry: &Entry| {
            let outcome = audit(entry).families(["behind"]).count(20).run().unwrap();
            outcome.findings().any(|finding| finding.finding == "false-hit")
        };
        assert_eq!([hits(&always), hits(&never)], [true, false]);
    }
}
