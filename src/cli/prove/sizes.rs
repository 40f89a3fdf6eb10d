//! `--demand-domain`: the sizes that a certificate must cover.

use crate::prove::checker::{Number, Proved};
use num_traits::{Signed, ToPrimitive};

/// The bounds of a domain in the order of its line in a certificate, and true if a domain with a larger one is wider.
const BOUNDS: [(&str, bool); 8] = [
    ("edge", true),
    ("reach", true),
    ("world", true),
    ("direction", true),
    ("extent", true),
    ("direction-floor", false),
    (FLOOR, false),
    (QUOTIENT, true),
];
const FLOOR: &str = "floor";
const QUOTIENT: &str = "quotient";

/// A bound of a domain that is demanded, as `edge=10`.
#[derive(Clone, Debug)]
pub struct DemandedSize {
    text: String,
    /// Its place in the domain.
    at: usize,
    size: Number,
}

impl DemandedSize {
    /// Reads `NAME=SIZE`.
    pub fn parse(text: &str) -> Result<DemandedSize, String> {
        let names = BOUNDS.map(|(name, _)| name).join(", ");
        let expected = || format!("expected NAME=SIZE, where NAME is one of {names}");
        let (name, number) = text.split_once('=').ok_or_else(expected)?;
        let at = BOUNDS
            .iter()
            .position(|(known, _)| *known == name)
            .ok_or_else(expected)?;
        let size = number.parse().ok().and_then(Number::from_float::<f64>);
        let size = size.filter(|size| !size.is_negative());
        let size = size.ok_or_else(|| format!("'{number}' is no size: expected 0 or more"))?;
        Ok(DemandedSize {
            text: text.to_owned(),
            at,
            size,
        })
    }

    /// The bounds of a claim that this one is compared with: those of its domain, and of single divisors and quotients.
    fn found<'a>(&self, claim: &'a Proved) -> Vec<&'a Number> {
        let own: &[Number] = match BOUNDS[self.at].0 {
            FLOOR => &claim.limits[0],
            QUOTIENT => &claim.limits[1],
            _ => &[],
        };
        own.iter().chain([&claim.domain[self.at]]).collect()
    }

    fn is_met(&self, claim: &Proved) -> bool {
        let (_, is_wider) = BOUNDS[self.at];
        let mut found = self.found(claim).into_iter();
        if is_wider {
            found.all(|x| self.size <= *x)
        } else {
            found.all(|x| *x <= self.size)
        }
    }

    /// The bound of a claim that is nearest to meeting the demand, or farthest from it.
    fn narrowest<'a>(&self, claim: &'a Proved) -> &'a Number {
        let (_, is_wider) = BOUNDS[self.at];
        let found = self.found(claim).into_iter();
        let narrowest = if is_wider { found.min() } else { found.max() };
        narrowest.expect("the domain's own is among them")
    }
}

/// True if the domain of a claim covers all sizes that are demanded.
pub fn is_within(demands: &[DemandedSize], claim: &Proved) -> bool {
    demands.iter().all(|demand| demand.is_met(claim))
}

/// Why a gate has no claim that covers the demanded sizes, in a line.
pub fn why_not(demands: &[DemandedSize], proved: &[Proved], gate: &str) -> String {
    let claims: Vec<&Proved> = proved.iter().filter(|claim| claim.gate == gate).collect();
    let all: Vec<&str> = demands.iter().map(|demand| &demand.text[..]).collect();
    let nothing = format!("not all of gate '{gate}' is proved for {}", all.join(","));
    let unmet = demands
        .iter()
        .find(|demand| !claims.iter().all(|claim| demand.is_met(claim)));
    let Some(demand) = unmet.filter(|_| !claims.is_empty()) else {
        return format!("{nothing}: the certificate is without some of its numbers");
    };
    let (name, is_wider) = BOUNDS[demand.at];
    let mut found: Vec<&Number> = claims.iter().map(|claim| demand.narrowest(claim)).collect();
    found.sort_unstable();
    let [first, last] = [found.first(), found.last()].map(|x| x.map_or(0.0, |x| float(x)));
    let sizes = if first == last {
        format!("{last}")
    } else {
        format!("{first:.3e}..{last:.3e}")
    };
    let side = if is_wider { "up to" } else { "from" };
    format!(
        "{nothing}: its domain has {name} {side} {sizes}, demanded {}",
        demand.text
    )
}

fn float(x: &Number) -> f64 {
    x.to_f64().unwrap_or(f64::INFINITY)
}
