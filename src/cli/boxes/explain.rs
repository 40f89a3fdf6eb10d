//! `hairline boxes explain`.

use super::case::case_named;
use super::published::{self, Published};
use super::record::label;
use super::select::TestArguments;
use super::written::AnyBoxCase;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::OutputArguments;
use crate::report::Format;
use crate::report::page::{Block, Cell, Head, Page, Paged, Row, Table, Tone};
use clap::Args;
use hairline_boxes::{
    BoxCase, Class, Definition, FamilyScalar, Finding, Meeting, Obligation, Origin, Overlap, Range,
    Setup, TABLE, Truth, define, padding,
};
use hairline_core::kernel::{Scalar, verdicts_of};
use hairline_core::{Extent, ScalarName, Verdict};
use num_rational::BigRational;
use num_traits::{ToPrimitive, Zero};
use serde::Serialize;
use std::cmp::Ordering;

/// Which box and ray, and which slab tests.
#[derive(Args)]
pub struct ExplainArguments {
    /// The id of a family's case, as corner@1/f32/-/1/17, a published case, as @bvh-107, or a box and a ray as JSON
    #[arg(value_name = "CASE")]
    case: String,

    #[command(flatten)]
    tests: TestArguments,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &ExplainArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let setups = arguments.tests.setups()?;
    let mut explained = match case_named(&arguments.case)? {
        AnyBoxCase::F32(case) => explain(&arguments.case, &case, &setups),
        AnyBoxCase::F64(case) => explain(&arguments.case, &case, &setups),
    };
    if explained.answers.is_empty() {
        let scalar = explained.scalar;
        return Err(Failure::nothing(format!(
            "none of the chosen tests runs in {scalar}, which the case is in"
        )));
    }
    if let Some(name) = arguments.case.strip_prefix('@') {
        explained.published = Some(published::find(name)?);
    }
    arguments.output.write(outputs, &explained)?;
    Ok(Status::Success)
}

/// A box and a ray, what is true of them, and what slab tests say.
#[derive(Serialize)]
struct Explained {
    case: String,
    published: Option<Published>,
    scalar: ScalarName,
    /// The numbers of the case, by name.
    numbers: Vec<(&'static str, String)>,
    truth: String,
    /// Where the line enters and leaves the box, as fractions.
    line: Option<[String; 2]>,
    /// How far the box must grow on all sides to be met, by the largest coordinate; below 0 if it is met.
    padding: Option<f64>,
    /// The exact comparison of that with 0.
    #[serde(skip)]
    padding_sign: Option<Ordering>,
    #[serde(skip)]
    has_negative_start: bool,
    answers: Vec<Answer>,
    /// The answer of the test that the guide recommends.
    recommended: Option<Answer>,
}

/// The test that loses no ray, short of overflow and underflow, with the growth that its analysis allows: docs/guide/boxes.md.
fn recommended() -> Option<Setup> {
    Setup::published(TABLE.find("ize")?).pop()
}

/// The answer of one slab test.
#[derive(Serialize)]
struct Answer {
    test: String,
    says: &'static str,
    judged: &'static str,
    /// True if it breaks its promise here.
    #[serde(skip)]
    is_wrong: bool,
    /// The margin of each gate: the largest epsilon at which it lets the case through.
    margins: Vec<(String, f64)>,
}

fn explain<F: FamilyScalar + Scalar>(name: &str, case: &BoxCase<F>, setups: &[Setup]) -> Explained {
    let defined = define(case);
    let [origin, direction, min, max] = case.vectors();
    let vector = |[x, y, z]: [F; 3]| format!("{x:?} {y:?} {z:?}");
    let padding = padding(&case.widen());
    let line = defined.line.as_ref();
    Explained {
        case: name.to_owned(),
        published: None,
        scalar: F::NAME,
        numbers: vec![
            ("origin", vector(origin)),
            ("direction", vector(direction)),
            ("min", vector(min)),
            ("max", vector(max)),
            ("t", format!("{:?} to {:?}", case.ray.t_min, case.ray.t_max)),
        ],
        truth: in_words(&defined),
        line: line.map(|Range { enter, exit }| [enter.to_string(), exit.to_string()]),
        padding_sign: padding
            .as_ref()
            .map(|padding| padding.length.cmp(&BigRational::zero())),
        padding: padding.map(|padding| padding.share),
        has_negative_start: case.ray.t_min < F::zero(),
        answers: setups
            .iter()
            .filter_map(|setup| answer(case, &defined.truth, setup))
            .collect(),
        recommended: recommended().and_then(|setup| answer(case, &defined.truth, &setup)),
    }
}

fn answer<F: FamilyScalar + Scalar>(
    case: &BoxCase<F>,
    truth: &Truth,
    setup: &Setup,
) -> Option<Answer> {
    let subject = F::subject(setup.entry)?;
    let epsilons: Vec<F> = setup.epsilons()?;
    let mut verdict = [Verdict::miss(None)];
    verdicts_of(subject, &[*case], &epsilons, &mut verdict);
    let gates = if subject.tells_margins() {
        setup.gates()
    } else {
        &[]
    };
    let mut margins = vec![F::zero(); gates.len()];
    if !gates.is_empty() {
        subject.margins(setup.entry.info, &[*case], &mut margins, &mut []);
    }
    let gates = gates.iter().map(|gate| gate.name.to_owned());
    let says = match (verdict[0].failure, verdict[0].hit) {
        (Some(_), _) => "fails",
        (None, true) => "hit",
        (None, false) => "miss",
    };
    let finding = Obligation::new(truth, &setup.contract).judge(&verdict[0]);
    Some(Answer {
        test: label(setup),
        says,
        judged: judged(truth, setup, &verdict[0]),
        is_wrong: finding != Finding::Right,
        margins: gates
            .zip(margins.iter().map(|margin| margin.to_f64()))
            .collect(),
    })
}

/// The judgement of a verdict, with the reason where it is not the closed box and the closed interval that decide.
fn judged<F: FamilyScalar>(truth: &Truth, setup: &Setup, verdict: &Verdict<F>) -> &'static str {
    let contract = &setup.contract;
    let obligation = Obligation::new(truth, contract);
    if obligation == Obligation::Free && verdict.failure.is_none() {
        return "not judged: its promise leaves this open";
    }
    let is_met = truth.hits_closed() == Some(true);
    match obligation.judge(verdict) {
        Finding::Right if verdict.hit && !is_met => match contract.extent {
            Extent::Line => "right: it asks about the whole line",
            _ => "right: it asks about every t >= 0",
        },
        Finding::Right if !verdict.hit && is_met => "right: its source leaves out this end",
        Finding::Right => "right",
        Finding::FalseHit if is_met => "wrong: its source leaves out this end",
        Finding::FalseHit => "wrong: the box is not met",
        Finding::FalseMiss => "wrong: the ray is lost",
        Finding::Failed => "wrong: no verdict",
    }
}

/// The truth of a case, in a sentence.
fn in_words(defined: &Definition) -> String {
    let meeting = match &defined.truth {
        Truth::Invalid => {
            return "no question: NaN, an infinite coordinate, a zero direction, or an interval whose ends are not in order".to_owned();
        }
        Truth::Empty => return "the box has no points, so no ray meets it".to_owned(),
        Truth::Outside => return "the line passes outside the box".to_owned(),
        Truth::Meets(meeting) => meeting,
    };
    let Meeting {
        class,
        origin,
        ray,
        interval,
    } = meeting;
    let passes = match class {
        Class::Interior => "passes through the interior",
        Class::Face => "has one point of the flat box, inside a face",
        Class::Edge => "touches an edge and nothing else",
        Class::Corner => "touches a corner and nothing else",
        Class::Along => "runs in the plane of a face",
    };
    let starts = match origin {
        Origin::Outside => "outside",
        Origin::On => "on the boundary",
        Origin::Inside => "inside",
    };
    let on_the_ray = overlap(*ray);
    let on_the_interval = overlap(*interval);
    format!(
        "the line {passes}; the ray starts {starts}. Of what line and box have in common, {on_the_ray} has t >= 0, and \
         {on_the_interval} lies between t_min and t_max"
    )
}

fn overlap(overlap: Overlap) -> &'static str {
    match overlap {
        Overlap::None => "nothing",
        Overlap::AtAnEnd => "one point, the end,",
        Overlap::Within => "some",
    }
}

/// A fraction as a decimal, with the fraction if it is short.
fn decimal(fraction: &str) -> String {
    let value = fraction.parse::<BigRational>().ok();
    let value = value.and_then(|value| value.to_f64());
    let value = value.filter(|value| value.is_finite());
    let Some(value) = value else {
        return "a number beyond the range of doubles (--format json has it)".to_owned();
    };
    let near = format!("{value:?}");
    if fraction.len() <= 24 && near != fraction {
        return format!("{fraction} = {near}");
    }
    near
}

impl Paged for Explained {
    fn page(&self) -> Page {
        let mut terms: Vec<(&str, String)> = Vec::new();
        if let Some(report) = &self.published {
            terms.push(("report", report.source.clone()));
            terms.push(("about", report.about.clone()));
            terms.push(("numbers", report.numbers.clone()));
        }
        terms.push(("truth", self.truth.clone()));
        if let Some([enter, exit]) = &self.line {
            let (enter, exit) = (decimal(enter), decimal(exit));
            terms.push(("line", format!("in the box from t = {enter} to {exit}")));
        }
        if let (Some(share), Some(order)) = (self.padding, self.padding_sign) {
            let words = match order {
                Ordering::Greater => {
                    format!("missed by {share:.1e} of the largest coordinate")
                }
                Ordering::Equal => "just met: a smaller box would not be".to_owned(),
                Ordering::Less => {
                    format!("met with {:.1e} of the largest coordinate to spare", -share)
                }
            };
            terms.push(("box", words));
        }
        if self.has_negative_start {
            let note = "t_min is below 0: a far end below 0 does not grow here, as it does in pbrt's and Embree's sources";
            terms.push(("note", note.to_owned()));
        }
        if let Some(Answer {
            test, says, judged, ..
        }) = &self.recommended
        {
            terms.push(("advised", format!("{test} says {says}: {judged}")));
        }
        for (name, numbers) in &self.numbers {
            terms.push((name, numbers.clone()));
        }
        let heads = vec![
            Head::of("test"),
            Head::text("says"),
            Head::text("which is"),
            Head::text("margins").about("the largest epsilon at which a gate lets the ray through"),
        ];
        let rows = self.answers.iter().map(row).collect();
        let wrong = self.answers.iter().filter(|it| it.is_wrong).count();
        let title = format!(
            "{}: {wrong} of {} tests are wrong",
            self.case,
            self.answers.len()
        );
        Page {
            command: "boxes",
            title,
            tone: if wrong == 0 { Tone::Good } else { Tone::Bad },
            blocks: vec![Block::terms(terms), Block::Table(Table::new(heads, rows))],
        }
    }
}

fn row(answer: &Answer) -> Row {
    let margin = |(gate, margin): &(String, f64)| format!("{gate} {margin:.2e}");
    let margins: Vec<String> = answer.margins.iter().map(margin).collect();
    let cells = [
        Cell::words(answer.says),
        Cell::words(answer.judged).broken_if(answer.is_wrong),
        Cell::words(margins.join(", ")),
    ];
    Row::new(answer.test.clone(), cells)
}
