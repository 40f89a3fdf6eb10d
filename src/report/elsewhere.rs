//! Rates that are higher on planes, or with rays, of other kinds than those that a table is about.

use super::page::{Block, Head, Row, Table};
use super::record::Rate;

/// The rates of one thing.
pub(crate) struct ComparedRates {
    /// Its name.
    pub label: String,
    /// One a kind; the first is the one that tables are about.
    pub rates: Vec<Rate>,
}

/// The most rows on a screen.
const MOST: usize = 10;

/// The rows that are more often wrong on some other kind than on the first, by more than chance explains, each with the
/// kind on which it is most; the worst first, or one sentence if there is none.
pub(crate) fn blocks(
    title: &str,
    kinds: &[String],
    rows: &[ComparedRates],
    share: fn(&Rate) -> String,
) -> Vec<Block> {
    let [first, others @ ..] = kinds else {
        return Vec::new();
    };
    if others.is_empty() {
        return Vec::new();
    }
    let of_rate = |rate: &Rate| rate.rate.unwrap_or(0.0);
    let most = |row: &ComparedRates| {
        let (own, others) = row.rates.split_first()?;
        let [_, high] = own.interval.unwrap_or([0.0, 1.0]);
        let is_worse = |rate: &Rate| rate.interval.is_some_and(|[low, _]| high < low);
        let worse = others
            .iter()
            .zip(&kinds[1..])
            .filter(|(rate, _)| is_worse(rate));
        let (most, kind) = worse.max_by(|(a, _), (b, _)| of_rate(a).total_cmp(&of_rate(b)))?;
        let cells = [share(own), share(most), kind.clone()];
        Some((of_rate(most) - of_rate(own), Row::new(&row.label, cells)))
    };
    let mut worse: Vec<(f64, Row)> = rows.iter().filter_map(most).collect();
    if worse.is_empty() {
        let others = others.join(", ");
        return vec![Block::text(format!(
            "{title} on other planes or rays: nothing ({others})"
        ))];
    }
    worse.sort_by(|(a, _), (b, _)| b.total_cmp(a));
    let heads = vec![
        Head::of(format!("{title} elsewhere")),
        Head::of(first),
        Head::of("most"),
        Head::text("on"),
    ];
    let rows = worse.into_iter().map(|(_, row)| row).collect();
    vec![Block::Table(Table::new(heads, rows).at_most(MOST))]
}
