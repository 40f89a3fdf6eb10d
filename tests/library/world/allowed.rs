//! How far the two worlds may be apart, and why.

use super::counts::Rate;
use std::fmt::Write;

/// An allowed factor: that of the first line with all of whose words a row agrees.
pub struct Allowed {
    /// Words of a row: its mesh, its kernel, its epsilons or its scheme, what is aimed at or how points are formed, and
    /// how planes lie. Alternatives stand between bars.
    words: &'static str,
    /// How many times as often something may happen here as hairline says.
    above: f64,
    /// How many times as often hairline may say that it happens.
    below: f64,
    /// Why.
    why: &'static str,
}

impl Allowed {
    pub const fn new(words: &'static str, above: f64, below: f64, why: &'static str) -> Allowed {
        Allowed {
            words,
            above,
            below,
            why,
        }
    }

    fn is_of(&self, row: &str) -> bool {
        let has = |word: &str| {
            row.split(' ')
                .any(|of_row| word.split('|').any(|one| one == of_row))
        };
        self.words.split_whitespace().all(has)
    }
}

/// Rows of two rates that are held to a table.
pub struct Comparison {
    table: &'static [Allowed],
    uses: Vec<u64>,
    /// How many rows saw something happen in either world.
    pub seen: u64,
    faults: String,
}

impl Comparison {
    pub fn new(table: &'static [Allowed]) -> Comparison {
        Comparison {
            table,
            uses: vec![0; table.len()],
            seen: 0,
            faults: String::new(),
        }
    }

    /// Compares what happens here with what hairline says. `HAIRLINE_WORLD` prints all rows.
    pub fn add(&mut self, row: &str, here: Rate, said: Rate) {
        let line = self.table.iter().position(|line| line.is_of(row));
        let line = line.unwrap_or_else(|| panic!("no factor for {row}"));
        let Allowed {
            words,
            above,
            below,
            why,
        } = &self.table[line];
        self.uses[line] += 1;
        self.seen += u64::from(here.count + said.count != 0);
        let times = here.share() / said.share();
        let text = format!("{row}: here {here}, hairline says {said}: {times:.2} times");
        if std::env::var("HAIRLINE_WORLD").is_ok() {
            println!("{text}");
        }
        if here.is_above(said, *above) || said.is_above(here, *below) {
            let from = 1.0 / below;
            writeln!(
                self.faults,
                "{text}; allowed are {from:.2} to {above:.2} ({words}: {why})"
            )
            .unwrap();
        }
    }

    /// Fails with all rows that are too far apart, and if a line of the table is about nothing.
    pub fn end(self) {
        assert!(
            self.faults.is_empty(),
            "the two worlds differ:\n{}",
            self.faults
        );
        for (line, uses) in self.table.iter().zip(self.uses) {
            assert!(0 < uses, "nothing is held to '{}'", line.words);
        }
    }
}
