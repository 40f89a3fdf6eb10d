//! One of several parts of a run, by ranges of indices.

use std::fmt;
use std::ops::Range;
use std::str::FromStr;

/// Part `index` of `of`, counted from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: u64,
    of: u64,
}

/// The most parts of a run.
pub const MOST_SHARDS: u64 = 100_000;

impl Shard {
    /// All of it.
    pub const WHOLE: Shard = Shard { index: 0, of: 1 };

    /// One index of so many.
    pub fn of_index(index: u64, of: u64) -> Shard {
        Shard { index, of }
    }

    /// Which one, counted from 0.
    pub fn index(self) -> u64 {
        self.index
    }

    /// The number of shards.
    pub fn of(self) -> u64 {
        self.of
    }

    /// Its indices of a source: the parts of all shards are a source's indices, each once.
    pub fn range(self, count: u64) -> Range<u64> {
        let cut = |k: u64| (u128::from(count) * u128::from(k) / u128::from(self.of)) as u64;
        cut(self.index)..cut(self.index + 1)
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        let parts = text
            .split_once('/')
            .and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match parts {
            Some((index, of)) if index < of && of <= MOST_SHARDS => Ok(Shard { index, of }),
            _ => Err(format!(
                "'{text}' is not a shard: write k/n with k from 0 below n, and n at most {MOST_SHARDS}, as 0/4"
            )),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ranges_of_all_shards_follow_on_each_other() {
        for of in [1, 2, 3, 7, 1000] {
            for count in [0, 1, 5, 1024, 20_000, 1_000_000_000_000] {
                let mut next = 0;
                for index in 0..of {
                    let range = Shard { index, of }.range(count);
                    assert_eq!(range.start, next);
                    assert!(range.end - range.start <= count / of + 1);
                    next = range.end;
                }
                assert_eq!(next, count);
            }
        }
    }

    #[test]
    fn only_k_below_n_is_a_shard() {
        for good in ["2/7", "0/1", "99999/100000"] {
            assert_eq!(good.parse::<Shard>().unwrap().to_string(), good);
        }
        for bad in ["", "1", "1/0", "7/7", "-1/2", "a/b", "1/2/3", "0/100001"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }
}
