//! Values that differ between two records, and whether that is better or worse.

use hairline_report::page::Item;
use serde::Serialize;

/// The trend of a class of disagreement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Trend {
    /// It is more frequent.
    Worse,
    /// It is less frequent.
    Better,
    /// As many cases, but other ones.
    Other,
    /// The rates differ by no more than their intervals allow.
    Insignificant,
}

/// A word or a number that differs: the contract of a kernel, an epsilon that was chosen, a bound.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OtherValue {
    /// What, of which kernel.
    pub what: String,
    /// Better or worse, if it is a bound.
    pub change: Option<Trend>,
    /// The old record's.
    pub old: String,
    /// The new one's.
    pub new: String,
}

impl OtherValue {
    pub(super) fn item(&self) -> Item {
        let trend = match self.change {
            Some(Trend::Worse) => " (worse)",
            Some(_) => " (better)",
            None => "",
        };
        Item {
            text: format!("{}{trend}", self.what),
            notes: vec![
                format!("before: {}", self.old),
                format!("now: {}", self.new),
            ],
            ..Item::default()
        }
    }
}
