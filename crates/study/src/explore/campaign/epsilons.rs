//! The epsilons that a campaign tries on a kernel.

use crate::audit::{EpsilonChoice, EpsilonText, Row};
use crate::case::Draw;
use crate::kernel::{PRESETS, Tunable};
use std::sync::Arc;

/// The rows of one kernel that a campaign draws from.
pub struct CampaignRows {
    rows: Vec<Arc<Row>>,
    varies: bool,
}

impl CampaignRows {
    /// The epsilons of a kernel's rows, of which there is at least one. If they may vary, then also the published
    /// epsilons that fit, zero, and numbers between.
    pub fn new(rows: &[&Row], varies: bool) -> CampaignRows {
        let mut all: Vec<Row> = rows.iter().map(|row| (*row).clone()).collect();
        let first = rows[0];
        let published = PRESETS.iter().filter(|_| varies).filter_map(|preset| {
            EpsilonChoice::Preset(preset.name.to_owned()).rows(&[first.entry], None).ok()
        });
        for row in published.flatten() {
            if all.iter().all(|known| known.epsilons != row.epsilons) {
                all.push(Row { contract: first.contract, ..row });
            }
        }
        let varies = varies && first.tuned().next().is_some();
        CampaignRows { rows: all.into_iter().map(Arc::new).collect(), varies }
    }

    /// One of the rows, or one with numbers between theirs.
    pub fn draw(&self, draw: &mut Draw) -> Arc<Row> {
        let row = &self.rows[draw.below(self.rows.len())];
        if self.varies && draw.below(3) == 0 { self.between(row, draw) } else { row.clone() }
    }

    /// A row some of whose epsilons lie between zero and one that another row has there.
    fn between(&self, row: &Row, draw: &mut Draw) -> Arc<Row> {
        let mut row = row.clone();
        for (i, gate) in row.entry.info.gates.iter().enumerate() {
            if gate.epsilon == Tunable::Fixed || draw.coin() {
                continue;
            }
            let other = &self.rows[draw.below(self.rows.len())].epsilons[i];
            let value = other.value::<f64>().filter(|value| *value != 0.0).unwrap_or(1e-6);
            // Two digits: whoever reads them should be able to remember them.
            let share = draw.unit() * draw.pick(&[1.0, 1e-2, 1e-4, 1e-8]);
            row.epsilons[i] = EpsilonText::Decimal(format!("{:.1e}", value * share));
        }
        row.set = row.epsilon_argument().unwrap_or(row.set);
        Arc::new(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::KERNELS;
    use std::collections::BTreeSet;

    #[test]
    fn every_row_that_is_drawn_can_be_named_again() {
        let mut draw = Draw::new("epsilons", 1, 0);
        for entry in KERNELS {
            let rows = EpsilonChoice::Source.rows(&[entry], None).unwrap();
            let epsilons = CampaignRows::new(&rows.iter().collect::<Vec<_>>(), true);
            let mut seen = BTreeSet::new();
            for _ in 0..200 {
                let row = epsilons.draw(&mut draw);
                let argument = row.epsilon_argument();
                let again = Row::named(entry.info.name, argument.as_deref(), "own").unwrap();
                assert_eq!(again.epsilons::<f32>(), row.epsilons::<f32>(), "{argument:?}");
                assert_eq!(again.epsilons::<f64>(), row.epsilons::<f64>(), "{argument:?}");
                seen.insert(argument);
            }
            assert!(rows[0].tuned().next().is_none() || seen.len() > 30, "{}", entry.info.name);
            let fixed = CampaignRows::new(&[&rows[0]], false);
            assert!((0..20).all(|_| fixed.draw(&mut draw).epsilons == rows[0].epsilons));
        }
    }
}
