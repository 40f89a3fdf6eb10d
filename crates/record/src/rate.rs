//! How often something was found, with its interval, and how people read it.

use crate::audit::{RayProducts, Trials};
use crate::plot::group_digits;
use serde::{Deserialize, Serialize};

/// A count of a number of trials, with its 95 % interval if the trials are a random sample.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, try_from = "Read")]
#[cfg_attr(feature = "schema", schemars(!try_from))]
pub struct Rate {
    /// How many.
    pub count: u64,
    /// The number of trials.
    pub of: u64,
    /// `count / of`; none of nothing.
    pub rate: Option<f64>,
    /// Clopper-Pearson, 95 %, with the ray as the unit of trial.
    pub interval: Option<[f64; 2]>,
    /// Sums over the rays of products of the findings k and the trials n on each; left out where each ray
    /// has one trial.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rays: Option<RayProducts>,
}

/// A rate as it is read.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Read {
    count: u64,
    of: u64,
    rate: Option<f64>,
    interval: Option<[f64; 2]>,
    #[serde(default)]
    rays: Option<RayProducts>,
}

impl TryFrom<Read> for Rate {
    type Error = String;

    fn try_from(read: Read) -> Result<Rate, String> {
        let Read {
            count,
            of,
            rate,
            interval,
            rays,
        } = read;
        let trials = Trials::independent(count, of);
        if of < count || rate != trials.share() {
            let found = rate.map_or_else(|| "null".to_owned(), |rate| rate.to_string());
            return Err(format!(
                "found a rate of {found} for {count} of {of}, expected their quotient, at most 1"
            ));
        }
        Ok(Rate {
            count,
            of,
            rate,
            interval,
            rays,
        })
    }
}

impl Rate {
    /// With an interval if the trials are a random sample.
    pub fn new(trials: Trials, sample: bool) -> Rate {
        let Trials {
            count,
            of,
            products,
        } = trials;
        let interval = (sample && 0 < of).then(|| trials.interval());
        Rate {
            count,
            of,
            rate: trials.share(),
            interval: interval.map(|interval| [interval.low, interval.high]),
            rays: (products != RayProducts::of_single(count, of)).then_some(products),
        }
    }

    /// The sum, with an interval if all that have a trial are random samples.
    pub fn sum<'a>(rates: impl IntoIterator<Item = &'a Rate>) -> Rate {
        let (mut sum, mut sample) = (Trials::default(), true);
        for rate in rates {
            sum.merge(&rate.trials());
            sample &= rate.interval.is_some() || rate.of == 0;
        }
        Rate::new(sum, sample)
    }

    /// `3 of 57`.
    pub fn counts(&self) -> String {
        format!("{} of {}", group_digits(self.count), group_digits(self.of))
    }

    /// The trials, of which an interval of any width can be had.
    pub fn trials(&self) -> Trials {
        let products = self
            .rays
            .unwrap_or_else(|| RayProducts::of_single(self.count, self.of));
        Trials {
            count: self.count,
            of: self.of,
            products,
        }
    }
}

/// ` (20.3% [20.0%, 20.6%])`; nothing without an interval.
pub fn interval_of(rate: &Rate) -> String {
    let (Some(share), Some([low, high])) = (rate.rate, rate.interval) else {
        return String::new();
    };
    format!(
        " ({} [{}, {}])",
        percent(share),
        percent(low),
        percent(high)
    )
}

/// `12.3%`, `0.45%`, `3e-4%`.
pub fn percent(share: f64) -> String {
    let value = share * 100.0;
    if share == 0.0 {
        "0%".to_owned()
    } else if value < 0.01 {
        format!("{value:.0e}%")
    } else if value < 1.0 {
        format!("{value:.2}%")
    } else {
        format!("{value:.1}%")
    }
}
