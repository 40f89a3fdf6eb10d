//! `hairline boxes prove`: the least growth of a far end for which no ray of some sizes is lost.

use crate::audit::shell_word;
use crate::cli::exit::{Failure, Status};
use crate::cli::output::OutputArguments;
use crate::report::Format;
use crate::report::page::{Block, Cell, Command, Head, Page, Paged, Row, Table, Tone};
use clap::Args;
use hairline_boxes::{Domain, FamilyScalar, least_growths};
use hairline_core::ScalarName;
use hairline_core::kernel::Scalar;
use serde::Serialize;

/// The sizes of a program's numbers.
#[derive(Args)]
pub struct ProveArguments {
    /// The largest coordinate
    #[arg(long, value_name = "LENGTH", default_value_t = 1e6)]
    extent: f64,

    /// The smallest coordinate but 0
    #[arg(long, value_name = "LENGTH", default_value_t = 1e-6)]
    least: f64,

    /// The largest component of a direction
    #[arg(long, value_name = "NUMBER", default_value_t = 1e6)]
    fastest: f64,

    /// The smallest component of a direction but 0
    #[arg(long, value_name = "NUMBER", default_value_t = 1e-6)]
    slowest: f64,

    #[command(flatten)]
    output: OutputArguments,
}

/// Runs the command.
pub fn run(arguments: &ProveArguments) -> Result<Status, Failure> {
    let outputs = arguments.output.pairs(Format::OF_PAGE)?;
    let coordinates = [arguments.least, arguments.extent];
    let directions = [arguments.slowest, arguments.fastest];
    let domain = Domain::new(coordinates, directions).map_err(Failure::usage)?;
    let mut proofs = Proofs {
        coordinates,
        directions,
        rows: Vec::new(),
    };
    proofs.add::<f32>(&domain);
    proofs.add::<f64>(&domain);
    arguments.output.write(outputs, &proofs)?;
    Ok(match proofs.are_proved() {
        true => Status::Success,
        false => Status::Disagreements,
    })
}

/// The answers for all formulas.
#[derive(Serialize)]
struct Proofs {
    coordinates: [f64; 2],
    directions: [f64; 2],
    rows: Vec<Proof>,
}

/// The answer for a formula in a scalar.
#[derive(Serialize)]
struct Proof {
    test: &'static str,
    scalar: ScalarName,
    /// The epsilon that is enough, by the scalar's distance from 1 to the next number; none if no growth is.
    in_epsilons: Option<u32>,
    /// The ray that needs more than one unit less.
    witness: String,
    /// All that it rests on, each with its truth.
    conditions: Vec<(String, bool)>,
}

impl Proofs {
    fn are_proved(&self) -> bool {
        self.rows.iter().all(|proof| proof.fault().is_none())
    }

    fn add<F: FamilyScalar + Scalar>(&mut self, domain: &Domain) {
        for growth in least_growths::<F>(domain) {
            self.rows.push(Proof {
                test: growth.test,
                scalar: F::NAME,
                in_epsilons: growth.enough,
                witness: growth.witness.json(),
                conditions: growth.conditions,
            });
        }
    }
}

impl Proof {
    /// The first condition that does not hold.
    fn fault(&self) -> Option<&str> {
        let mut failed = self.conditions.iter().filter(|(_, holds)| !holds);
        failed.next().map(|(what, _)| what.as_str())
    }

    fn row(&self) -> Row {
        let (least, halves) = match self.in_epsilons {
            Some(units) => (format!("growth=-{units}*EPSILON"), (2 * units).to_string()),
            None => ("none is enough".to_owned(), "–".to_owned()),
        };
        let words = match (self.fault(), self.in_epsilons) {
            (Some(fault), _) => format!("not proved, since this fails: {fault}"),
            (None, Some(_)) => "proved for these sizes".to_owned(),
            (None, None) => "a ray is lost with 2^32*EPSILON".to_owned(),
        };
        let cells = [
            Cell::words(self.scalar.name()),
            Cell::words(least),
            Cell::words(halves),
            Cell::words(words).broken_if(self.fault().is_some()),
        ];
        Row::new(self.test, cells)
    }

    /// Shows the ray that a smaller growth loses.
    fn command(&self) -> Command {
        let (test, case) = (self.test, &self.witness);
        let (less, what) = match self.in_epsilons {
            Some(units) => (
                format!("growth=-{}*EPSILON", units - 1),
                "a smaller growth loses this ray",
            ),
            None => (
                "growth=-1e6".to_owned(),
                "the near end is an error of o/d alone",
            ),
        };
        let [case, less] = [case, &less].map(|word| shell_word(word));
        Command {
            line: format!("hairline boxes explain {case} -k {test} --epsilon {less}"),
            what,
        }
    }
}

impl Paged for Proofs {
    fn page(&self) -> Page {
        let heads = vec![
            Head::of("formula"),
            Head::text("scalar"),
            Head::text("least growth"),
            Head::of("EPSILON/2").about("the same in halves of EPSILON, the unit of rounding"),
            Head::text("verdict"),
        ];
        let rows: Vec<Row> = self.rows.iter().map(Proof::row).collect();
        let [[least, extent], [slow, fast]] = [self.coordinates, self.directions];
        let mut blocks = vec![
            Block::Table(Table::new(heads, rows)),
            Block::text(format!(
                "These sizes: t_min is not below 0, coordinates are 0 or from {least:e} to {extent:e}, components of directions 0 or from {slow:e} to \
                 {fast:e}. That nothing overflows or underflows then is checked. docs/design/boxes-proof.md has the steps."
            )),
        ];
        if self.rows.iter().any(|proof| proof.in_epsilons.is_none()) {
            blocks.push(Block::text(
                "None is enough: whatever the growth, a ray whose far end is near enough to its start needs more.",
            ));
        }
        let commands = self.rows.iter().map(Proof::command).collect();
        blocks.push(Block::Commands("witnesses", commands));
        let are_proved = self.are_proved();
        Page {
            command: "boxes",
            title: match are_proved {
                true => "The least growth of the far end for which no ray is lost".to_owned(),
                false => {
                    "Not proved: the sizes leave the range in which a rounding is small".to_owned()
                }
            },
            tone: if are_proved { Tone::Good } else { Tone::Bad },
            blocks,
        }
    }
}
