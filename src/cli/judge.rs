//! `hairline judge`: the verdicts of a kernel that is a filter. Nothing is known of the cases but
//! their ids; memory does not grow with their number.

use super::case::family_of;
use super::exit::{Failure, Status};
use super::input::open;
use super::reporting::ReportArguments;
use crate::arith::Float;
use crate::audit::{Answers, Audit, CHUNK, EpsilonChoice, Given, Plan, Row, Source};
use crate::case::CaseId;
use crate::conformance::conforms;
use crate::contract::Contract;
use crate::corpus::InputError;
use crate::corpus::text_lines::TextLines;
use crate::engine::Unobserved;
use crate::kernel::{Entry, Gives, KernelInfo, Scalar, Verdict};
use crate::plugin::{Start, text};
use crate::report::{Context, build};
use clap::Args;
use std::io::{BufReader, Read};

/// The arguments of `judge`: the verdicts to read, and how to report.
#[derive(Args)]
pub struct JudgeArguments {
    /// The kernel's output; - is standard input
    #[arg(value_name = "FILE", default_value = "-")]
    file: String,

    /// A contract instead of the kernel's own (see `hairline list contracts`); needed if the kernel does not
    /// announce one
    #[arg(long, value_name = "CONTRACT")]
    contract: Option<String>,

    #[command(flatten)]
    report: ReportArguments,

    /// How many examples of each class of finding to keep
    #[arg(long, default_value_t = 3, value_name = "N")]
    examples: usize,
}

/// How many findings of each class to attribute: none can be, which is said of so many. The values of
/// hits are measured of all.
const ATTRIBUTE: usize = 100;

/// Runs the command.
pub fn run(arguments: &JudgeArguments) -> Result<Status, Failure> {
    let outputs = arguments.report.outputs()?;
    let contract = arguments.contract.as_deref();
    let reader = BufReader::with_capacity(1 << 16, open(&arguments.file)?);
    let mut lines = TextLines::new(reader, &arguments.file, LONGEST_LINE);
    let mut line = next(&mut lines)?;
    let no_verdicts = || {
        let message = format!("{}: no verdicts in it", arguments.file);
        Err(Failure::Message(Status::NothingSelected, message))
    };
    if line.is_none() {
        return no_verdicts();
    }
    let mut info =
        KernelInfo { gives: NOTHING, ..KernelInfo::own("answers", Contract::CLOSED_RAY) };
    if line.as_deref().is_some_and(|line| line.starts_with("hairline-kernel")) {
        // Epsilons stay as they are: a filter is never told any.
        info = KernelInfo { gates: &[], ..*hello(&mut lines, line)? };
        info.epsilon_sets = KernelInfo::own("", Contract::CLOSED_RAY).epsilon_sets;
        line = next(&mut lines)?;
    } else if contract.is_none_or(|words| words.starts_with("own")) {
        let message = "there is no hello that states a contract: give --contract NAME";
        return Err(lines.error(message).into());
    }
    let mut sets = Sets::new(info, contract, arguments.examples)?;
    let mut count = 0;
    let ended = loop {
        let Some(text) = line else { break false };
        match text::answer::<f64>(&text).map_err(|message| lines.error(message))? {
            text::Answer::Verdict(id, verdict) => sets.take(id, verdict, &lines)?,
            text::Answer::End { cases, .. } if cases == count => break true,
            text::Answer::End { cases, .. } => {
                let message = format!("'end {cases}' after {count} verdicts");
                return Err(lines.error(message).into());
            }
        }
        count += 1;
        line = next(&mut lines)?;
    };
    if !ended {
        let message = format!(
            "expected 'end N' after the verdicts, found nothing: the kernel stopped after {count}"
        );
        return Err(InputError::of(&arguments.file, message).into());
    }
    if let Some(more) = next(&mut lines)? {
        let message = format!("'{}' stands behind the last 'end'", text::shown(&more));
        return Err(lines.error(message).into());
    }
    if count == 0 {
        return no_verdicts();
    }
    let (plan, audit) = sets.finish(&lines)?;
    let context = Context { seconds: 0.0, threads: 1 };
    let record = build(&plan, &audit, &context);
    outputs.write(&record)?;
    Ok(if conforms(&record) { Status::Success } else { Status::Disagreements })
}

const NOTHING: Gives = Gives { t: false, uv: false, facing: false };

/// The rest of a hello, its first line read.
fn hello(lines: &mut Lines, first: Option<String>) -> Result<&'static KernelInfo, Failure> {
    let (mut start, mut line) = (Start::default(), first);
    while let Some(text) = line {
        if let Some(hello) = start.take(&text).map_err(|message| lines.error(message))? {
            return Ok(hello.info());
        }
        line = next(lines)?;
    }
    Err(lines.error("the hello has no line 'ready'").into())
}

/// The sets of cases that were answered: one is open, of the others only the sums are left.
struct Sets {
    row: Row,
    given: (&'static Given<f32>, &'static Given<f64>),
    examples: usize,
    sources: Vec<Source>,
    scalars: [bool; 2],
    /// The text before the index in the ids of each set.
    seen: Vec<String>,
    open: Option<Box<dyn Open>>,
    audit: Audit,
}

impl Sets {
    fn new(info: KernelInfo, contract: Option<&str>, examples: usize) -> Result<Sets, Failure> {
        let given: (&Given<f32>, &Given<f64>) =
            (Box::leak(Box::default()), Box::leak(Box::default()));
        let entry = Entry::new(Box::leak(Box::new(info))).with_f32(given.0).with_f64(given.1);
        let entry: &'static Entry = Box::leak(Box::new(entry.chosen_by("")));
        let row = EpsilonChoice::Source.rows(&[entry], contract)?.remove(0);
        Ok(Sets {
            row,
            given,
            examples,
            sources: Vec::new(),
            scalars: [false; 2],
            seen: Vec::new(),
            open: None,
            audit: Audit::default(),
        })
    }

    /// Takes the verdict on a case, which must be the next one of its set or begin another.
    fn take(&mut self, id: &str, verdict: Verdict<f64>, lines: &Lines) -> Result<(), Failure> {
        let expected = match &mut self.open {
            Some(open) => match open.take(id, verdict) {
                Ok(()) => return Ok(()),
                Err(expected) => format!("{expected}, or the first case of another set"),
            },
            None => "the first case of a set".to_owned(),
        };
        let out_of_order = || {
            let message = format!(
                "expected the verdict on {expected}, found '{}': answers come in the order of the cases, each once",
                text::shown(id)
            );
            Failure::from(lines.error(message))
        };
        let case: CaseId = id.parse().map_err(|_| out_of_order())?;
        let set = id[..id.rfind('/').unwrap_or(0)].to_owned();
        let is_first = case.index == 0 && matches!(case.triangle, None | Some(0));
        if !is_first || self.seen.contains(&set) {
            return Err(out_of_order());
        }
        self.close(lines)?;
        self.seen.push(set);
        self.open = Some(self.begin(&case, lines)?);
        let taken = self.open.as_mut().map_or(Ok(()), |open| open.take(id, verdict));
        taken.map_err(|_| out_of_order())
    }

    fn begin(&mut self, case: &CaseId, lines: &Lines) -> Result<Box<dyn Open>, Failure> {
        let family = family_of(case, &case.family).map_err(|failure| match failure.message() {
            Some(message) => lines.error(message).into(),
            None => failure,
        })?;
        let source = Source::Family {
            family,
            parameters: case.parameters.clone(),
            seed: case.seed,
            count: 0,
            exhaustive: false,
        };
        let name = source.id::<f64>(0, None);
        let known = self.sources.iter().position(|other| other.id::<f64>(0, None) == name);
        let number = known.unwrap_or(self.sources.len());
        if known.is_none() {
            self.sources.push(source.clone());
        }
        match case.scalar.as_str() {
            "f32" => {
                self.scalars[0] = true;
                Ok(Box::new(Set::new(source, number, &self.row, self.given.0, self.examples)))
            }
            "f64" => {
                self.scalars[1] = true;
                Ok(Box::new(Set::new(source, number, &self.row, self.given.1, self.examples)))
            }
            other => Err(lines.error(format!("unknown scalar '{other}' in '{case}'")).into()),
        }
    }

    fn close(&mut self, lines: &Lines) -> Result<(), Failure> {
        let Some(open) = self.open.take() else { return Ok(()) };
        let (number, indices) = open
            .close(&mut self.audit)
            .map_err(|missing| lines.error(format!("the verdict on {missing} is missing")))?;
        if let Source::Family { count, .. } = &mut self.sources[number] {
            *count = indices.max(*count);
        }
        Ok(())
    }

    fn finish(mut self, lines: &Lines) -> Result<(Plan, Audit), Failure> {
        self.close(lines)?;
        let Sets { row, sources, scalars, examples, audit, .. } = self;
        Ok((Plan { rows: vec![row], sources, scalars, examples, attribute: ATTRIBUTE }, audit))
    }
}

/// A set in one of the scalars.
trait Open {
    /// Takes the verdict on the next case; an error is that case's id.
    fn take(&mut self, id: &str, verdict: Verdict<f64>) -> Result<(), String>;

    /// Adds it to the sums; returns the source's number and how many indices it had. An error is the
    /// id of a case that is missing in the last group.
    fn close(self: Box<Self>, audit: &mut Audit) -> Result<(usize, u64), String>;
}

struct Set<F: Scalar> {
    source: Source,
    number: usize,
    answers: Answers<'static, F>,
    /// The verdicts from the first index of the chunk on.
    verdicts: Vec<Verdict<F>>,
    first_index: u64,
    /// The next case.
    index: u64,
    triangle: usize,
    /// How many triangles its index has.
    triangles: usize,
}

impl<F: Scalar> Set<F> {
    fn new(
        source: Source,
        number: usize,
        row: &Row,
        given: &'static Given<F>,
        examples: usize,
    ) -> Set<F> {
        let answers = Answers::new(row, given, examples, ATTRIBUTE, number, &Unobserved);
        let triangles = source.make::<F>(0).cases().len();
        let verdicts = Vec::new();
        Set { source, number, answers, verdicts, first_index: 0, index: 0, triangle: 0, triangles }
    }

    fn next_id(&self) -> String {
        self.source.id::<F>(self.index, (self.triangles > 1).then_some(self.triangle))
    }

    fn judge_chunk(&mut self) {
        let verdicts = std::mem::take(&mut self.verdicts);
        self.answers.add(&self.source, self.first_index..self.index, verdicts);
        self.first_index = self.index;
    }
}

impl<F: Scalar> Open for Set<F> {
    fn take(&mut self, id: &str, verdict: Verdict<f64>) -> Result<(), String> {
        let expected = self.next_id();
        if id != expected {
            return Err(expected);
        }
        self.verdicts.push(rounded(verdict));
        self.triangle += 1;
        if self.triangle == self.triangles {
            (self.index, self.triangle) = (self.index + 1, 0);
            self.triangles = self.source.make::<F>(self.index).cases().len();
            if self.index - self.first_index == CHUNK {
                self.judge_chunk();
            }
        }
        Ok(())
    }

    fn close(mut self: Box<Self>, audit: &mut Audit) -> Result<(usize, u64), String> {
        if self.triangle > 0 {
            return Err(self.next_id());
        }
        self.judge_chunk();
        self.answers.finish(&self.source, audit);
        Ok((self.number, self.index))
    }
}

/// A verdict in the case's scalar.
fn rounded<F: Float>(verdict: Verdict<f64>) -> Verdict<F> {
    let [t, u, v] = [verdict.t, verdict.u, verdict.v].map(F::from_f64);
    Verdict { t, u, v, hit: verdict.hit, facing: verdict.facing, ..Verdict::miss(None) }
}

/// The most bytes of a line.
const LONGEST_LINE: usize = 1 << 16;

type Lines = TextLines<BufReader<Box<dyn Read>>>;

/// The next line without blanks at its ends.
fn next(lines: &mut Lines) -> Result<Option<String>, Failure> {
    let line = lines.next().transpose()?;
    Ok(line.map(|(_, text)| text.trim().to_owned()))
}
