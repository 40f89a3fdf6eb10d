//! Rates that are higher on planes, or with rays, of other kinds than those that a table is about.

use super::page::{Block, Head, Row, Table};
use super::record::Rate;

/// The rates of one thing: on the first kind, and on each of the others.
pub(crate) struct Compared<'a> {
    /// Its name.
    pub label: String,
    /// On the kind that the table is about.
    pub own: &'a Rate,
    /// On the others, in order.
    pub others: Vec<&'a Rate>,
}

/// True if a rate is higher than another by more than chance explains.
pub(crate) fn is_worse(own: &Rate, other: &Rate) -> bool {
    let [_, most] = own.interval.unwrap_or([0.0, 1.0]);
    other.interval.is_some_and(|[least, _]| most < least)
}

impl Compared<'_> {
    /// True if it is more often wrong on any other kind.
    pub fn is_worse(&self) -> bool {
        self.others.iter().any(|other| is_worse(self.own, other))
    }
}

/// The most kinds that have columns: more do not fit on a line.
const MOST_KINDS: usize = 4;

/// Those rows that are worse on some kind, with a column for each kind on which one is; one sentence if none is.
pub(crate) fn blocks(
    title: &str,
    kinds: &[String],
    rows: &[Compared],
    share: fn(&Rate) -> String,
) -> Vec<Block> {
    let Some((own, others)) = kinds.split_first().filter(|(_, others)| !others.is_empty()) else {
        return Vec::new();
    };
    let worse: Vec<&Compared> = rows.iter().filter(|row| row.is_worse()).collect();
    if worse.is_empty() {
        return vec![Block::text(format!("{title} on other planes or rays: nothing"))];
    }
    let is_shown = |place: &usize| worse.iter().any(|row| is_worse(row.own, row.others[*place]));
    let mut shown: Vec<usize> = (0..others.len()).filter(is_shown).collect();
    let more = shown.split_off(shown.len().min(MOST_KINDS));
    let mut heads = vec![Head::of(format!("{title} on")), Head::of(own)];
    heads.extend(shown.iter().map(|place| Head::of(&others[*place])));
    let row = |row: &&Compared| {
        let rates = [row.own].into_iter().chain(shown.iter().map(|place| row.others[*place]));
        Row::new(&row.label, rates.map(share))
    };
    let mut blocks = vec![Block::Table(Table::new(heads, worse.iter().map(row).collect()))];
    if !more.is_empty() {
        let more: Vec<&str> = more.iter().map(|place| others[*place].as_str()).collect();
        blocks.push(Block::text(format!("(also on {})", more.join(", "))));
    }
    blocks
}
