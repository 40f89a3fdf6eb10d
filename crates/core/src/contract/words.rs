//! Contracts in words, as `--contract`, settings, and the hello of a kernel have them.

use super::{Across, Boundary, Contract, Demand, Direction, Extent, NAMED, Sides};
use crate::error::{Error, ErrorKind};
use crate::suggest::nearest_name;
use std::str::FromStr;

impl FromStr for Contract {
    type Err = Error;

    /// As [`Contract::from_words`], where no kernel's own contract is known.
    fn from_str(text: &str) -> Result<Contract, Error> {
        Contract::from_words(text, None)
    }
}

impl Contract {
    /// From words between commas: a named contract or `own` (a kernel's own contract), then `key=value`
    /// pairs that change it, `no-self-hit`, `band=DISTANCE`, `determinant=NUMBER`, and `values=DISTANCE` or `values=free`. Without a
    /// name the words must give extent, sides and boundary; coplanar rays and triangles without area are then missed, invalid
    /// input is free, and directions of any length are promised.
    ///
    /// Errors: one line that says which word is wrong and what is known.
    pub fn from_words(text: &str, own: Option<&Contract>) -> Result<Contract, Error> {
        let words: Vec<&str> = text.split(',').map(str::trim).collect();
        let (mut contract, changes) = match named(words[0], own) {
            Some(named) => (named, &words[1..]),
            None => (Contract::without_name(text, &words)?, &words[..]),
        };
        let mut keys = Vec::new();
        for word in changes {
            let key = word.split('=').next();
            if keys.contains(&key) {
                let line = format!("'{word}': it is said before, in '{text}'");
                return Err(Error::new(ErrorKind::Repeated, line));
            }
            keys.push(key);
            contract.change(word).map_err(Error::syntax)?;
        }
        Ok(contract)
    }

    /// The contract that words without a name begin from, if they give all that has no default.
    fn without_name(text: &str, words: &[&str]) -> Result<Contract, Error> {
        if !words[0].contains('=') {
            return Err(unknown(words[0]));
        }
        for key in ["extent", "sides", "boundary"] {
            let mut keys = words.iter().map(|word| word.split('=').next());
            if !keys.any(|given| given == Some(key)) {
                return Err(Error::syntax(format!("'{text}' does not say {key}=…")));
            }
        }
        Ok(Contract::of_kernel(
            Extent::Ray,
            Sides::Both,
            Boundary::Closed,
        ))
    }

    /// The shortest words that [`Contract::from_words`] reads as this contract: `own` if it is the
    /// kernel's own (where that is known to the reader), a name, or what differs from either.
    pub fn words(&self, own: Option<&Contract>) -> String {
        let all = self.all_words();
        let own = own.map(|own| ("own", *own));
        let named = NAMED.iter().map(|named| (named.name, named.contract));
        let mut possible = Vec::new();
        for (name, base) in own.into_iter().chain(named) {
            // No word takes back a base's `no-self-hit` or its band.
            let keeps_self_hit = self.no_self_hit || !base.no_self_hit;
            let keeps_band = self.band.is_some() || base.band.is_none();
            if !keeps_self_hit || !keeps_band {
                continue;
            }
            let of_base = base.all_words();
            let mut words = vec![name.to_owned()];
            words.extend(all.iter().filter(|word| !of_base.contains(word)).cloned());
            possible.push(words);
        }
        let shortest = possible.into_iter().min_by_key(Vec::len);
        shortest.unwrap_or_default().join(",")
    }

    /// A word for each part of the contract. Equal parts have equal words, so contracts differ in the words that are not
    /// in common.
    fn all_words(&self) -> Vec<String> {
        let direction = match self.direction {
            Direction::Any => "any".to_owned(),
            Direction::Unit { ulps } => format!("unit:{ulps}"),
        };
        let values = match self.value_tolerance {
            f64::INFINITY => "free".to_owned(),
            edges => format!("{edges:e}"),
        };
        let mut words = vec![
            format!("extent={}", self.extent),
            format!("sides={}", self.sides),
            format!("boundary={}", self.boundary),
            format!("ends={}", self.ends),
            format!("coplanar={}", self.coplanar),
            format!("degenerate={}", self.degenerate),
            format!("invalid={}", self.invalid),
            format!("direction={direction}"),
            format!("across={}", self.across),
        ];
        words.extend(self.band.map(|band| format!("band={band}")));
        words.push(format!("determinant={:e}", self.least_determinant));
        words.push(format!("values={values}"));
        words.extend(self.no_self_hit.then(|| "no-self-hit".to_owned()));
        words
    }

    /// Changes what one word of a contract's text says.
    fn change(&mut self, word: &str) -> Result<(), String> {
        let (key, value) = word.split_once('=').unwrap_or((word, ""));
        let shown = format!("'{word}'");
        let number = value
            .parse()
            .ok()
            .filter(|number| (0.0..f64::INFINITY).contains(number));
        match key {
            "extent" => self.extent = Extent::chosen(&shown, value)?,
            "sides" => self.sides = Sides::chosen(&shown, value)?,
            "boundary" => self.boundary = Boundary::chosen(&shown, value)?,
            "ends" => self.ends = Boundary::chosen(&shown, value)?,
            "coplanar" => self.coplanar = Demand::chosen(&shown, value)?,
            "degenerate" => self.degenerate = Demand::chosen(&shown, value)?,
            "invalid" => self.invalid = Demand::chosen(&shown, value)?,
            "direction" if value == "any" => self.direction = Direction::Any,
            "direction" => {
                let ulps = value
                    .strip_prefix("unit:")
                    .and_then(|ulps| ulps.parse().ok());
                let advice = format!("'{word}': there are any, unit:ULPS");
                self.direction = Direction::Unit {
                    ulps: ulps.ok_or(advice)?,
                };
            }
            "across" => self.across = Across::chosen(&shown, value)?,
            "band" => self.band = Some(value.parse()?),
            "determinant" => {
                let advice = format!("'{word}': write a number from 0 up, as 1e-8");
                self.least_determinant = number.ok_or(advice)?;
            }
            "values" if value == "free" => self.value_tolerance = f64::INFINITY,
            "values" => {
                let advice = format!(
                    "'{word}': write free, or a distance in longest edges from 0 up, as 1e-3"
                );
                self.value_tolerance = number.ok_or(advice)?;
            }
            "no-self-hit" if word == key => self.no_self_hit = true,
            _ => {
                let keys = "extent, sides, boundary, ends, coplanar, degenerate, invalid, direction, across, band, determinant, values, no-self-hit";
                return Err(format!("'{word}' is none of {keys}"));
            }
        }
        Ok(())
    }
}

/// The contract of this name: the kernel's own, or one that all know.
fn named(name: &str, own: Option<&Contract>) -> Option<Contract> {
    match own {
        Some(own) if name == "own" => Some(*own),
        _ => {
            let named = NAMED.iter().find(|named| named.name == name)?;
            Some(named.contract)
        }
    }
}

/// The error that says that no contract has this name, and what to write.
fn unknown(name: &str) -> Error {
    let names: Vec<&str> = NAMED.iter().map(|named| named.name).collect();
    let advice = match nearest_name(name, names.iter().copied()) {
        Some(near) => format!("; did you mean '{near}'?"),
        None => {
            let names = names.join(", ");
            format!(": write {names}, or extent=ray,sides=both,boundary=closed")
        }
    };
    let line = format!("'{name}' is no contract{advice}");
    Error::new(ErrorKind::UnknownName, line)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contracts_are_read_from_their_words() {
        let read = |text: &str| text.parse::<Contract>();
        for named in NAMED {
            assert_eq!(read(named.name), Ok(named.contract));
        }
        let own = read("extent=line, sides=front, boundary=open").unwrap();
        assert_eq!(
            own,
            Contract::of_kernel(Extent::Line, Sides::Front, Boundary::Open)
        );
        let all = "closed-interval,boundary=free,ends=open,coplanar=hit,degenerate=free,invalid=free,\
            direction=unit:4,across=exactly-one,no-self-hit,determinant=1e-8,values=1e-3";
        assert_eq!(
            read(all).unwrap().describe(),
            "interval, both sides, boundary free, ends open, coplanar hit, degenerate free, invalid free, \
             exactly-one across triangles, unit directions within 4 ulps, no self-hit, \
             no hit owed at |det| < 1e-8, values free within 1e-3 longest edges"
        );
        assert_eq!(
            Contract::CLOSED_RAY.describe(),
            "ray, both sides, closed, coplanar miss, degenerate miss, invalid miss"
        );
        for band in ["0", "0ulps", "-1", "inf", "NaN"] {
            assert!(band.parse::<crate::contract::Band>().is_err(), "{band}");
        }
        let banded = |band: &str| Contract {
            band: band.parse().ok(),
            ..Contract::CLOSED_RAY
        };
        let ends = |band| {
            banded(band)
                .describe()
                .split_once(", free within ")
                .map(|x| x.1.to_owned())
        };
        assert_eq!(ends("4ulps").as_deref(), Some("4ulps of the boundary"));
        assert_eq!(
            ends("0.25").as_deref(),
            Some("2.5e-1 longest edges of the boundary")
        );
        for named in NAMED {
            let own = Contract::of_kernel(Extent::Line, Sides::Front, Boundary::Open);
            let banded = Contract {
                band: "4ulps".parse().ok(),
                ..named.contract
            };
            let free = Contract {
                value_tolerance: f64::INFINITY,
                ..named.contract
            };
            for contract in [own, named.contract, banded, free, read(all).unwrap()] {
                assert_eq!(read(&contract.words(None)), Ok(contract));
                let words = contract.words(Some(&own));
                assert_eq!(
                    Contract::from_words(&words, Some(&own)),
                    Ok(contract),
                    "{words}"
                );
            }
        }
        assert_eq!(
            Contract::CLOSED_RAY.words(Some(&read(all).unwrap())),
            "closed-ray"
        );
        // What only the kernel's own contract promises keeps that from being the base, be it as near as can be.
        let near = read("closed-ray,ends=open").unwrap();
        let banded = Contract {
            band: "4ulps".parse().ok(),
            ..near
        };
        for (own, words) in [
            (near, "own"),
            (
                Contract {
                    no_self_hit: true,
                    ..near
                },
                "closed-ray,ends=open",
            ),
            (banded, "closed-ray,ends=open"),
        ] {
            assert_eq!(near.words(Some(&own)), words, "{own:?}");
        }
        assert_eq!(banded.words(Some(&banded)), "own");
        assert_eq!(banded.words(Some(&near)), "own,band=4ulps");
        for (text, message) in [
            ("own", "'own' is no contract: write closed-line, "),
            ("", "'' is no contract: write closed-line, "),
            ("closed", "'closed' is no contract: write closed-line, "),
            (
                "extent=ray,sides=both",
                "'extent=ray,sides=both' does not say boundary=…",
            ),
            (
                "closed-ray,sides=back",
                "'sides=back': there are both, front",
            ),
            ("closed-ray,side=both", "'side=both' is none of extent, "),
            (
                "closed-ray,direction=unit",
                "'direction=unit': there are any, unit:ULPS",
            ),
            (
                "closed-ray,values=-1",
                "'values=-1': write free, or a distance",
            ),
            (
                "closed-ray,determinant=-1",
                "'determinant=-1': write a number from 0 up",
            ),
            (
                "closed-ray,values=inf",
                "'values=inf': write free, or a distance",
            ),
            (
                "closed-ray,ends=open,ends=closed",
                "'ends=closed': it is said before",
            ),
            (
                "closed-ray,no-self-hit=yes",
                "'no-self-hit=yes' is none of ",
            ),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.starts_with(message), "{text}: {error}");
        }
        let _: Box<dyn std::error::Error> = read("own").unwrap_err().into();
    }
}
