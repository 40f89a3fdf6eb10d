//! Runs in parts: which parts a record is of, and what merging needs besides its result.

use crate::audit::Shard;

/// Which parts of a plan a result is of.
#[apply(part!)]
#[derive(PartialEq)]
pub struct PartialPart {
    /// How many parts there are.
    pub of: u64,
    /// Which are in it, counted from 0.
    pub present: Vec<u64>,
}

/// The data in the record of a part besides its result, for `merge` of the same version alone.
#[apply(part!)]
pub struct ShardPart {
    /// The plan and the sums, as JSON of no stable form.
    pub sums: String,
    /// SHA-256 of them, the first 16 hexadecimal digits.
    pub digest: String,
}

impl PartialPart {
    /// A sentence that says which parts the numbers are of.
    pub fn sentence(&self) -> String {
        let present: Vec<String> = self.present.iter().map(u64::to_string).collect();
        let noun = if present.len() == 1 {
            "shard"
        } else {
            "shards"
        };
        let present = present.join(", ");
        format!(
            "A part of a run: {noun} {present} of {} only; all numbers are of this part.",
            self.of
        )
    }
}

impl From<Shard> for PartialPart {
    fn from(shard: Shard) -> PartialPart {
        PartialPart {
            of: shard.of(),
            present: vec![shard.index()],
        }
    }
}
