//! Rates that are higher on planes, or with rays, of other kinds than those that a table is about.

use super::page::{Block, Cell, Head, Row, Table};
use hairline_record::Rate;

/// The rates of one thing.
pub struct ComparedRates {
    /// Its name.
    pub label: String,
    /// One a kind; the first is the one that tables are about.
    pub rates: Vec<Rate>,
}

/// The most rows on a screen.
const MOST: usize = 10;

/// The rows that are more often wrong on some other kind than on the first, by more than chance explains, each with the
/// kind on which it is most; the worst first, or one sentence if there is none.
pub fn blocks(
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
    let mut worse: Vec<Worse<'_>> = rows
        .iter()
        .filter_map(|row| Worse::of(row, &kinds[1..]))
        .collect();
    if worse.is_empty() {
        let others = others.join(", ");
        return vec![Block::text(format!(
            "{title} on other planes or rays: nothing ({others})"
        ))];
    }
    worse.sort_by(|one, other| other.difference().total_cmp(&one.difference()));
    let heads = vec![
        Head::of(format!("{title} elsewhere")),
        Head::of(first),
        Head::of("most"),
        Head::text("on"),
    ];
    let row = |found: Worse<'_>| {
        let cell = |rate: &Rate| Cell::rate(rate, share(rate));
        let cells = [cell(found.own), cell(found.most), Cell::words(found.kind)];
        Row::new(found.label, cells)
    };
    let rows = worse.into_iter().map(row).collect();
    vec![Block::Table(Table::new(heads, rows).at_most(MOST))]
}

/// A rate that is higher on some other kind than chance explains.
struct Worse<'a> {
    label: &'a str,
    own: &'a Rate,
    most: &'a Rate,
    kind: &'a str,
}

impl<'a> Worse<'a> {
    /// The kind on which a row is most often wrong, if its interval is above that of the first.
    fn of(row: &'a ComparedRates, kinds: &'a [String]) -> Option<Worse<'a>> {
        let (own, others) = row.rates.split_first()?;
        let [_, high] = own.interval.unwrap_or([0.0, 1.0]);
        let mut found: Option<Worse<'a>> = None;
        for (rate, kind) in others.iter().zip(kinds) {
            let is_worse = rate.interval.is_some_and(|[low, _]| high < low);
            let is_most = found
                .as_ref()
                .is_none_or(|worse| value(worse.most) <= value(rate));
            if is_worse && is_most {
                found = Some(Worse {
                    label: &row.label,
                    own,
                    most: rate,
                    kind,
                });
            }
        }
        found
    }

    fn difference(&self) -> f64 {
        value(self.most) - value(self.own)
    }
}

fn value(rate: &Rate) -> f64 {
    rate.rate.unwrap_or(0.0)
}
