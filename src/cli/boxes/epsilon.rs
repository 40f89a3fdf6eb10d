//! `hairline boxes epsilon`: which growth of the far end, or which padding, loses no ray.

use super::case::name;
use super::record::label;
use super::select::{CaseArguments, TestArguments};
use crate::arith::ScalarName;
use crate::cli::before::set_threads;
use crate::cli::epsilon::tells_margins;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::OutputArguments;
use crate::cli::progress::Progress;
use crate::kernel::Tunable;
use crate::record::number_of;
use crate::report::Format;
use crate::report::page::{Block, Cell, Command, Head, Page, Paged, Row, Table, Tone};
use clap::Args;
use hairline_boxes::{Answer, FamilyScalar, Question, Setup, Source, epsilon};
use hairline_core::Float;
use hairline_core::kernel::Scalar;
use serde::Serialize;

/// Which slab tests, on which boxes, and how to report.
#[derive(Args)]
pub struct EpsilonArguments {
    #[command(flatten)]
    tests: TestArguments,

    #[command(flatten)]
    cases: CaseArguments,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &EpsilonArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let setups = arguments.tests.setups()?;
    let sources = arguments.cases.sources(arguments.output.quiet)?;
    let scalars = arguments.cases.scalars()?;
    set_threads(arguments.cases.threads)?;
    let mut advice = Advice {
        count: arguments.cases.count,
        seed: arguments.cases.seed,
        sources: sources.iter().map(ToString::to_string).collect(),
        rows: Vec::new(),
    };
    let progress = Progress::without_end("slab tests and gates", arguments.output.quiet);
    for setup in &setups {
        tells_margins(setup.entry, "hairline boxes audit").map_err(Failure::usage)?;
        for (place, gate) in setup.gates().iter().enumerate() {
            if gate.epsilon == Tunable::Fixed {
                continue;
            }
            if scalars[0] {
                advice.add::<f32>(setup, place, &sources, &progress)?;
            }
            if scalars[1] {
                advice.add::<f64>(setup, place, &sources, &progress)?;
            }
        }
    }
    progress.finish();
    if advice.rows.is_empty() {
        let message = "no chosen slab test takes an epsilon in a chosen scalar";
        return Err(Failure::usage(message));
    }
    arguments.output.write(outputs, &advice)?;
    Ok(Status::Success)
}

/// The epsilons of all slab tests.
#[derive(Serialize)]
struct Advice {
    count: u64,
    seed: u64,
    sources: Vec<String>,
    rows: Vec<AdviceRow>,
}

/// A gate of a slab test in one scalar, on all sources together.
#[derive(Serialize)]
struct AdviceRow {
    test: String,
    /// The flag that chooses it.
    #[serde(skip)]
    selector: String,
    gate: &'static str,
    scalar: ScalarName,
    must_hit: u64,
    must_miss: u64,
    /// Lost at every epsilon of this gate.
    lost_anyway: u64,
    lost_at_zero: u64,
    lost_at_own: u64,
    /// The largest epsilon that loses none but those; none if there are no others.
    largest: Option<f64>,
    /// That epsilon by the scalar's distance from 1 to the next number, if the gate compares plain numbers.
    in_epsilons: Option<f64>,
    /// The case that allows no larger one.
    decided_by: Option<String>,
    false_hits_at_zero: u64,
    false_hits_at_largest: u64,
}

impl Advice {
    fn add<F: FamilyScalar + Scalar>(
        &mut self,
        setup: &Setup,
        gate: usize,
        sources: &[Source],
        progress: &Progress,
    ) -> Result<(), Failure> {
        if F::subject(setup.entry).is_none() {
            return Ok(());
        }
        let gate = &setup.gates()[gate];
        let mut row = AdviceRow {
            test: label(setup),
            selector: setup.entry.selector(),
            gate: gate.name,
            scalar: F::NAME,
            must_hit: 0,
            must_miss: 0,
            lost_anyway: 0,
            lost_at_zero: 0,
            lost_at_own: 0,
            largest: None,
            in_epsilons: None,
            decided_by: None,
            false_hits_at_zero: 0,
            false_hits_at_largest: 0,
        };
        progress.tell(format!("{}, gate {}, {}", row.test, row.gate, row.scalar));
        for source in sources {
            let question = Question {
                setup,
                gate: gate.name,
                source: *source,
                count: self.count,
                seed: self.seed,
            };
            let answer = epsilon::<F>(&question, progress).map_err(Failure::usage)?;
            row.take(&answer, |index| name::<F>(source, self.seed, index));
        }
        let unit = F::from_f64(1.0).offset_ulps(1).to_f64() - 1.0;
        row.in_epsilons = row
            .largest
            .filter(|_| !gate.dimension.has_unit())
            .map(|largest| largest / unit);
        self.rows.push(row);
        Ok(())
    }
}

impl AdviceRow {
    /// Takes the answer of one more source; the smallest epsilon counts.
    fn take<F: Float>(&mut self, answer: &Answer<F>, name: impl Fn(u64) -> String) {
        self.must_hit += answer.must_hit;
        self.must_miss += answer.must_miss;
        self.lost_anyway += answer.lost_anyway;
        self.lost_at_zero += answer.lost_at_zero;
        self.lost_at_own += answer.lost_at_own;
        self.false_hits_at_zero += answer.false_hits_at_zero;
        self.false_hits_at_largest += answer.false_hits_at_largest;
        let Some(largest) = answer.largest else {
            return;
        };
        let epsilon = largest.epsilon.to_f64();
        if self.largest.is_none_or(|known| epsilon < known) {
            self.largest = Some(epsilon);
            self.decided_by = Some(name(largest.index));
        }
    }

    /// The epsilon in words: none is needed, or which.
    fn needed(&self) -> String {
        match (self.largest, self.in_epsilons) {
            (None, _) => "-".to_owned(),
            (Some(largest), _) if 0.0 <= largest => "0".to_owned(),
            (Some(largest), Some(_)) if largest < -MOST_GROWTH => "no growth helps".to_owned(),
            (Some(_), Some(units)) => format!("{}*EPSILON", short(units)),
            (Some(largest), None) => format!("{largest:.2e}"),
        }
    }
}

/// A far end that has to grow by more than this share of itself is lost for another reason: an overflow, an underflow, or the
/// error of o·inv in a fused product.
const MOST_GROWTH: f64 = 0.01;

/// A number in few characters.
fn short(number: f64) -> String {
    if number.abs() < 1e4 {
        return format!("{}", (number * 100.0).round() / 100.0);
    }
    format!("{number:.1e}")
}

impl Paged for Advice {
    fn page(&self) -> Page {
        let heads = vec![
            Head::of("test"),
            Head::text("gate"),
            Head::text("scalar"),
            Head::of("lost at 0"),
            Head::of("as it is")
                .about("lost at the test's own epsilon, those of the last column among them"),
            Head::of("needs").about(
                "the epsilon at which no ray of this run is lost but those of the last column; more rays may need more",
            ),
            Head::of("lost anyway")
                .about("lost at every epsilon of this gate: by a NaN, an infinity or another gate"),
        ];
        let rows: Vec<Row> = self.rows.iter().map(row).collect();
        let rays = number_of(self.count, "ray", "rays");
        let sources = match self.sources.len() {
            1 => self.sources[0].clone(),
            count => format!("each of {count} families"),
        };
        let mut blocks = vec![
            Block::Table(Table::new(heads, rows)),
            Block::text(
                "`growth` multiplies the far end by 1 - e, `padding` moves each face inwards by e: an epsilon below 0 is a \
                 tolerance. Set it with --epsilon growth=VALUE, or write far * (1 + 2*EPSILON) for growth=-2*EPSILON.",
            ),
        ];
        let decided = self
            .rows
            .iter()
            .filter(|row| row.largest.is_some_and(|it| it < 0.0));
        let lowest = decided.max_by(|a, b| a.lost_at_zero.cmp(&b.lost_at_zero));
        if let Some(row) = lowest {
            let case = row.decided_by.as_deref().unwrap_or_default();
            blocks.push(Block::Commands(
                "next",
                vec![Command {
                    line: format!("hairline boxes explain '{case}' {}", row.selector),
                    what: "the ray that needs it",
                }],
            ));
        }
        Page {
            command: "boxes",
            title: format!(
                "Which epsilon loses no ray: {rays} of {sources}, aimed at what is hard"
            ),
            tone: Tone::Plain,
            blocks,
        }
    }
}

fn row(row: &AdviceRow) -> Row {
    let count = |lost: u64| Cell::count(lost).broken_if(0 < lost);
    let cells = [
        Cell::words(row.gate),
        Cell::words(row.scalar.name()),
        count(row.lost_at_zero + row.lost_anyway),
        count(row.lost_at_own + row.lost_anyway),
        Cell::words(row.needed()),
        count(row.lost_anyway),
    ];
    Row::new(row.test.clone(), cells)
}
