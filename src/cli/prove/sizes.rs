//! `--demand-domain`: the sizes that a certificate must cover.

use crate::prove::checker::{Number, Proved};
use num_traits::{Signed, ToPrimitive};

/// A bound of a domain.
struct Bound {
    name: &'static str,
    /// True if a domain with a larger bound is wider.
    is_upper: bool,
}

/// The bounds in the order of a domain's line in a certificate.
const BOUNDS: [Bound; 8] = [
    upper("edge"),
    upper("reach"),
    upper("world"),
    upper("direction"),
    upper("extent"),
    lower("direction-floor"),
    lower(FLOOR),
    upper(QUOTIENT),
];
const FLOOR: &str = "floor";
const QUOTIENT: &str = "quotient";

const fn upper(name: &'static str) -> Bound {
    let is_upper = true;
    Bound { name, is_upper }
}

const fn lower(name: &'static str) -> Bound {
    let is_upper = false;
    Bound { name, is_upper }
}

/// A bound of a domain that is demanded, as `edge=10`.
#[derive(Clone, Debug)]
pub struct DemandedSize {
    text: String,
    /// Its place among [`BOUNDS`].
    at: usize,
    size: Number,
}

impl DemandedSize {
    /// Reads `NAME=SIZE`.
    pub fn parse(text: &str) -> Result<DemandedSize, String> {
        let names = BOUNDS.map(|bound| bound.name).join(", ");
        let expected = || format!("expected NAME=SIZE, where NAME is one of {names}");
        let (name, number) = text.split_once('=').ok_or_else(expected)?;
        let at = BOUNDS.iter().position(|bound| bound.name == name);
        let at = at.ok_or_else(expected)?;
        let size = number.parse().ok().and_then(Number::from_float::<f64>);
        let size = size.filter(|size| !size.is_negative());
        let size = size.ok_or_else(|| format!("'{number}' is no size: expected 0 or more"))?;
        Ok(DemandedSize {
            text: text.to_owned(),
            at,
            size,
        })
    }

    fn bound(&self) -> &'static Bound {
        &BOUNDS[self.at]
    }

    /// The bounds of a claim that this one is compared with: the domain's, and those of single divisors or quotients.
    fn found<'a>(&self, claim: &'a Proved) -> Vec<&'a Number> {
        let [divisors, quotients, _] = &claim.limits;
        let single: &[Number] = match self.bound().name {
            FLOOR => divisors,
            QUOTIENT => quotients,
            _ => &[],
        };
        single.iter().chain([&claim.domain[self.at]]).collect()
    }

    fn is_met(&self, claim: &Proved) -> bool {
        let narrowest = self.narrowest(claim);
        if self.bound().is_upper {
            self.size <= *narrowest
        } else {
            *narrowest <= self.size
        }
    }

    /// The bound of a claim that is nearest to failing the demand, or fails it by most.
    fn narrowest<'a>(&self, claim: &'a Proved) -> &'a Number {
        let found = self.found(claim).into_iter();
        let narrowest = if self.bound().is_upper {
            found.min()
        } else {
            found.max()
        };
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
    let demanded: Vec<&str> = demands.iter().map(|demand| &demand.text[..]).collect();
    let demanded = demanded.join(",");
    let nothing = format!("not all of gate '{gate}' is proved for {demanded}");
    let is_unmet = |demand: &&DemandedSize| claims.iter().any(|claim| !demand.is_met(claim));
    let Some(demand) = demands.iter().find(is_unmet) else {
        return format!("{nothing}: the certificate is without some of its numbers");
    };
    let mut sizes: Vec<&Number> = claims.iter().map(|claim| demand.narrowest(claim)).collect();
    sizes.sort_unstable();
    let least = sizes.first().map_or(0.0, |size| float(size));
    let most = sizes.last().map_or(0.0, |size| float(size));
    let found = if least == most {
        format!("{most}")
    } else {
        format!("{least:.3e}..{most:.3e}")
    };
    let Bound { name, is_upper } = demand.bound();
    let side = if *is_upper { "up to" } else { "from" };
    let demanded = &demand.text;
    format!("{nothing}: its domain has {name} {side} {found}, demanded {demanded}")
}

fn float(x: &Number) -> f64 {
    x.to_f64().unwrap_or(f64::INFINITY)
}
