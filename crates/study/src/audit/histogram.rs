//! Distributions in constant memory: counts in logarithmic bins, eight or more to the octave.

use serde::{Deserialize, Deserializer, Serialize, Serializer, de};
use std::collections::BTreeMap;
use std::fmt;

/// Counts of numbers that are not negative, in 2^`BITS` bins to the octave. Merging is commutative, and
/// the number of bins is bounded by the range of `f64`.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(into = "StoredHistogram", from = "StoredHistogram")]
pub struct Histogram<const BITS: u32 = 3> {
    zeros: u64,
    infinite: u64,
    /// The number of the first bin of `counts`.
    first: u32,
    /// The counts of all bins from the lowest to the highest that is not empty, and of some more.
    counts: Vec<u64>,
    count: u64,
    largest: f64,
}

/// Where zeros are counted.
const ZERO: u32 = 0;

/// How many bins are made at a time.
const ROOM: u32 = 64;

impl<const BITS: u32> Histogram<BITS> {
    /// Where infinite numbers are counted.
    const INFINITE: u32 = Self::bin(f64::INFINITY);

    /// The leading bits of a number: the exponent, and some of the significand.
    const fn bin(value: f64) -> u32 {
        if value == 0.0 {
            ZERO
        } else {
            (value.to_bits() >> (52 - BITS)) as u32 + 1
        }
    }

    /// Where a bin starts.
    fn start(bin: u32) -> f64 {
        if bin == ZERO {
            0.0
        } else {
            f64::from_bits(u64::from(bin - 1) << (52 - BITS))
        }
    }

    /// Counts a number; NaN as infinite, the sign left out.
    pub fn add(&mut self, value: f64) {
        let value = if value.is_nan() {
            f64::INFINITY
        } else {
            value.abs()
        };
        *self.slot(Self::bin(value)) += 1;
        self.count += 1;
        self.largest = self.largest.max(value);
    }

    /// Adds another histogram.
    pub fn merge(&mut self, other: &Self) {
        for (bin, count) in other.bins() {
            *self.slot(bin) += count;
        }
        self.count += other.count;
        self.largest = self.largest.max(other.largest);
    }

    /// The count of a bin, with room made for it.
    fn slot(&mut self, bin: u32) -> &mut u64 {
        if bin == ZERO {
            return &mut self.zeros;
        }
        if bin == Self::INFINITE {
            return &mut self.infinite;
        }
        if bin < self.first || self.counts.is_empty() {
            let first = bin.saturating_sub(ROOM).max(ZERO + 1);
            let missing = if self.counts.is_empty() {
                ROOM
            } else {
                self.first - first
            };
            self.counts
                .splice(0..0, std::iter::repeat_n(0, missing as usize));
            self.first = first;
        }
        let place = (bin - self.first) as usize;
        if self.counts.len() <= place {
            self.counts.resize(place + ROOM as usize, 0);
        }
        &mut self.counts[place]
    }

    /// The bins that are not empty, in order.
    fn bins(&self) -> impl Iterator<Item = (u32, u64)> {
        let between = (self.first..).zip(self.counts.iter().copied());
        let all = std::iter::once((ZERO, self.zeros))
            .chain(between)
            .chain(std::iter::once((Self::INFINITE, self.infinite)));
        all.filter(|(_, count)| *count > 0)
    }

    /// How many numbers.
    pub fn count(&self) -> u64 {
        self.count
    }

    /// The largest number, as it was; zero of none.
    pub fn largest(&self) -> f64 {
        self.largest
    }

    /// The number below or at which a share of the numbers lies, rounded up to the end of its bin (by
    /// at most one part in 2^`BITS`), and never above the largest; zero of none.
    pub fn quantile(&self, share: f64) -> f64 {
        let rank = ((share * self.count as f64).ceil() as u64).max(1);
        let mut below = 0;
        for (bin, count) in self.bins() {
            below += count;
            if rank <= below {
                let end = if bin == ZERO {
                    0.0
                } else {
                    Self::start(bin + 1)
                };
                return if end < self.largest {
                    end
                } else {
                    self.largest
                };
            }
        }
        self.largest
    }

    /// The count of each octave that has one.
    pub fn octaves(&self) -> BTreeMap<Octave, u64> {
        let mut octaves = BTreeMap::new();
        for (bin, count) in self.bins() {
            let octave = match (Self::start(bin).to_bits() >> 52) as i32 {
                0 => Octave::Zero,
                0x7ff => Octave::Infinite,
                exponent => Octave::From(exponent - 1023),
            };
            *octaves.entry(octave).or_default() += count;
        }
        octaves
    }
}

/// An octave of numbers that are not negative; in files `0`, `2^k`, `inf`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Octave {
    /// Zero, and whatever is below the normal numbers.
    Zero,
    /// From 2^k to 2^(k+1).
    From(i32),
    /// Infinity.
    Infinite,
}

impl fmt::Display for Octave {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Octave::Zero => f.write_str("0"),
            Octave::From(exponent) => write!(f, "2^{exponent}"),
            Octave::Infinite => f.write_str("inf"),
        }
    }
}

impl Serialize for Octave {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Octave {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Octave, D::Error> {
        let text = String::deserialize(from)?;
        let power = || text.strip_prefix("2^")?.parse().ok();
        match text.as_str() {
            "0" => Ok(Octave::Zero),
            "inf" => Ok(Octave::Infinite),
            _ => power()
                .map(Octave::From)
                .ok_or_else(|| de::Error::custom(format!("'{text}' is no octave: 0, 2^k or inf"))),
        }
    }
}

impl<const BITS: u32> PartialEq for Histogram<BITS> {
    fn eq(&self, other: &Self) -> bool {
        let whole = |histogram: &Self| (histogram.count, histogram.largest);
        whole(self) == whole(other) && self.bins().eq(other.bins())
    }
}

/// As shards hand it on.
#[derive(Serialize, Deserialize)]
struct StoredHistogram {
    bins: BTreeMap<u32, u64>,
    count: u64,
    #[serde(with = "super::forms::bits")]
    largest: f64,
}

impl<const BITS: u32> From<Histogram<BITS>> for StoredHistogram {
    fn from(histogram: Histogram<BITS>) -> StoredHistogram {
        let bins = histogram.bins().collect();
        StoredHistogram {
            bins,
            count: histogram.count,
            largest: histogram.largest,
        }
    }
}

impl<const BITS: u32> From<StoredHistogram> for Histogram<BITS> {
    fn from(
        StoredHistogram {
            bins,
            count,
            largest,
        }: StoredHistogram,
    ) -> Self {
        let mut histogram = Self {
            count,
            largest,
            ..Self::default()
        };
        for (bin, count) in bins {
            // A number beyond the bins is none that a histogram wrote.
            *histogram.slot(bin.min(Self::INFINITE)) += count;
        }
        histogram
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_are_those_of_the_sorted_numbers_within_an_eighth() {
        let numbers: Vec<f64> = (0..1000u64)
            .map(|i| ((i * 7919 % 1000) as f64).powi(3) * 1e-5)
            .collect();
        let (mut left, mut right) = (<Histogram>::default(), Histogram::default());
        for (i, number) in numbers.iter().enumerate() {
            if i % 3 == 0 {
                left.add(*number)
            } else {
                right.add(*number)
            }
        }
        let mut swapped = right.clone();
        swapped.merge(&left);
        left.merge(&right);
        assert_eq!(left, swapped);
        let mut sorted = numbers;
        sorted.sort_by(f64::total_cmp);
        for share in [0.0005, 0.1, 0.5, 0.9, 0.99, 1.0] {
            let rank = ((share * 1000.0f64).ceil() as usize).max(1);
            let (found, exact) = (left.quantile(share), sorted[rank - 1]);
            assert!(
                exact <= found && found <= exact * 1.125,
                "{share}: {found} {exact}"
            );
        }
        assert_eq!((left.count(), left.largest()), (1000, sorted[999]));
    }

    #[test]
    fn zero_and_infinity_have_bins_of_their_own() {
        let mut histogram = <Histogram>::default();
        [0.0, 0.0, 0.0, f64::NAN]
            .into_iter()
            .for_each(|x| histogram.add(x));
        assert_eq!(
            (histogram.quantile(0.75), histogram.quantile(0.76)),
            (0.0, f64::INFINITY)
        );
        histogram.add(3.0);
        let octaves: Vec<_> = histogram.octaves().into_iter().collect();
        assert_eq!(
            octaves,
            [
                (Octave::Zero, 3),
                (Octave::From(1), 1),
                (Octave::Infinite, 1)
            ]
        );
    }
}
