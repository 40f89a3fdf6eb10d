//! How often a guarded kernel asks, by kind of ray in a scene.

use crate::audit::Source;
use crate::engine::{Merge, Observer, sum};
use crate::family::Family;
use crate::kernel::Scalar;
use crate::prove::repair::{Answer, Answered, Guarded};
use hairline_report::page::{Block, Cell, Head, Row, Table};

/// How many rays got each answer: hit, miss, ask.
#[derive(Clone, Copy, Debug, Default)]
struct Answers([u64; 3]);

impl Merge for Answers {
    fn merge(&mut self, other: Answers) {
        self.0
            .iter_mut()
            .zip(other.0)
            .for_each(|(sum, more)| *sum += more);
    }
}

/// The shares of the answers, a line for each kind of ray.
pub struct Asks {
    kernel: String,
    kinds: Vec<(String, &'static str, Answers)>,
}

impl Asks {
    /// Counts the answers to the rays of some sources.
    pub fn count<F: Scalar + Answered>(
        guarded: &Guarded,
        sources: &[(&'static Family, Source)],
        observer: &dyn Observer,
    ) -> Asks {
        let ready = guarded.ready::<F>();
        let count = |(family, source): &(&'static Family, Source)| {
            let answers = sum(
                0..source.count::<F>(),
                1024,
                observer,
                Answers::default,
                |sum, indices| {
                    for index in indices {
                        for case in source.make::<F>(index).cases() {
                            let place = match F::answer(&ready, case) {
                                Answer::Hit(_) => 0,
                                Answer::Miss => 1,
                                Answer::Ask => 2,
                            };
                            sum.0[place] += 1;
                        }
                    }
                },
            );
            (
                family.name.trim_start_matches("scene-").to_owned(),
                family.promise,
                answers,
            )
        };
        let kernel = format!("{} in {}", guarded.info.name, guarded.scalar);
        Asks {
            kernel,
            kinds: sources.iter().map(count).collect(),
        }
    }

    /// In one line.
    pub fn line(&self) -> String {
        let kinds = self
            .kinds
            .iter()
            .map(|(name, _, answers)| format!("{name} {}", share(answers, 2)));
        kinds.collect::<Vec<_>>().join(", ")
    }

    /// The share of all rays on which it asks, in percent.
    pub fn whole(&self) -> String {
        let mut all = Answers::default();
        self.kinds
            .iter()
            .for_each(|(.., answers)| all.merge(*answers));
        share(&all, 2)
    }

    /// As blocks of a page.
    pub fn blocks(&self) -> Vec<Block> {
        let heads = ["rays", "hit", "miss", "ask"].map(Head::of).to_vec();
        let row = |(name, _, answers): &(String, &'static str, Answers)| {
            Row::new(
                name.clone(),
                [0, 1, 2].map(|place| share_cell(answers, place)),
            )
        };
        let table = Table::new(heads, self.kinds.iter().map(row).collect());
        let terms = self
            .kinds
            .iter()
            .map(|(name, promise, _)| (name.clone(), (*promise).to_owned()));
        let title = format!("How often the guarded {} asks", self.kernel);
        vec![
            Block::Heading(title),
            Block::Table(table),
            Block::Terms(terms.collect()),
        ]
    }
}

fn share_cell(answers: &Answers, place: usize) -> Cell {
    Cell::number(answers.0[place] as f64, share(answers, place))
}

/// A share of all answers in percent.
fn share(answers: &Answers, place: usize) -> String {
    let all: u64 = answers.0.iter().sum();
    match answers.0[place] {
        0 => "0".to_owned(),
        count => format!("{:.3} %", 100.0 * count as f64 / all.max(1) as f64),
    }
}
