//! Floor 1: what a kernel promises. Pure data; `judge` turns it and a truth into an obligation.

#![forbid(unsafe_code)]

use crate::suggest::nearest_name;
use std::fmt;
use std::str::FromStr;

/// The promise a kernel is judged by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contract {
    /// Which part of the line counts.
    pub extent: Extent,
    /// Which sides of a triangle can be hit.
    pub sides: Sides,
    /// Whether edges and vertices are hits.
    pub boundary: Boundary,
    /// Whether t = 0 of a ray, and t_min and t_max of an interval, are hits.
    pub ends: Boundary,
    /// Lines in the plane of the triangle.
    pub coplanar: Demand,
    /// Triangles without area.
    pub degenerate: Demand,
    /// NaN, infinities, a zero direction, an impossible interval.
    pub invalid: Demand,
    /// The directions that the kernel promises anything for.
    pub direction: Direction,
    /// What it promises about triangles that share an edge or a vertex.
    pub across: Across,
    /// A ray that starts at a kernel's own hit point must not hit that triangle again.
    pub no_self_hit: bool,
    /// Cases nearer than this to where another verdict would be right are free.
    pub band: Option<Band>,
}

/// A distance to the boundary below which nothing is demanded.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Band {
    /// How far; above zero.
    pub size: f64,
    /// In what.
    pub unit: BandUnit,
}

/// What a band is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BandUnit {
    /// The triangle's longest edge.
    Edges,
    /// Units in the last place of the largest coordinate of the case's points.
    Ulps,
}

impl fmt::Display for Band {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.unit {
            BandUnit::Edges => write!(f, "{:e}", self.size),
            BandUnit::Ulps => write!(f, "{}ulps", self.size),
        }
    }
}

impl FromStr for Band {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (number, unit) = match text.strip_suffix("ulps").or(text.strip_suffix("ulp")) {
            Some(number) => (number, BandUnit::Ulps),
            None => (text, BandUnit::Edges),
        };
        let size = number.trim().parse().ok().filter(|size: &f64| *size > 0.0 && size.is_finite());
        size.map(|size| Band { size, unit }).ok_or_else(|| {
            format!("'{text}' is not a band: write a distance above 0, in longest edges as 1e-6 or in ulps as 4ulps")
        })
    }
}

/// The part of the line that counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Extent {
    /// All t.
    Line,
    /// t ≥ 0.
    Ray,
    /// t in `[t_min, t_max]`.
    Interval,
}

/// The sides that can be hit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Sides {
    /// Both.
    Both,
    /// Only the front: the back must be missed.
    Front,
}

/// What edges and vertices are, or the ends of a ray or an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Boundary {
    /// Hits.
    Closed,
    /// Misses.
    Open,
    /// Either.
    Free,
}

/// What is demanded of a kernel in a situation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Demand {
    /// A miss.
    Miss,
    /// A hit where there is a common point, else a miss.
    Hit,
    /// Nothing.
    Free,
}

/// The directions that a kernel promises anything for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Direction {
    /// Any length.
    Any,
    /// Unit length within this many ulps; other directions are free.
    Unit {
        /// The tolerance on the length, in ulps of 1.
        ulps: u32,
    },
}

/// What is promised across triangles that share an edge or a vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Across {
    /// Nothing.
    Nothing,
    /// No crack: at least one of the triangles reports the hit.
    AtLeastOne,
    /// No crack and no double.
    ExactlyOne,
}

impl Across {
    /// The word in contracts and reports.
    pub fn name(self) -> &'static str {
        match self {
            Across::Nothing => "nothing",
            Across::AtLeastOne => "at-least-one",
            Across::ExactlyOne => "exactly-one",
        }
    }
}

impl Contract {
    /// The closed triangle on a ray, both sides; a coplanar ray, a triangle without area and invalid
    /// input are missed, as the ray tracing interfaces of graphics libraries rule.
    pub const CLOSED_RAY: Contract = Contract {
        extent: Extent::Ray,
        sides: Sides::Both,
        boundary: Boundary::Closed,
        ends: Boundary::Closed,
        coplanar: Demand::Miss,
        degenerate: Demand::Miss,
        invalid: Demand::Miss,
        direction: Direction::Any,
        across: Across::Nothing,
        no_self_hit: false,
        band: None,
    };

    /// A kernel's own contract starts here: as [`Contract::CLOSED_RAY`], invalid input free.
    pub const fn of_kernel(extent: Extent, sides: Sides, boundary: Boundary) -> Contract {
        Contract { extent, sides, boundary, invalid: Demand::Free, ..Contract::CLOSED_RAY }
    }

    /// The same with other demands on coplanar lines and triangles without area.
    pub const fn with_flat(self, coplanar: Demand, degenerate: Demand) -> Contract {
        Contract { coplanar, degenerate, ..self }
    }

    /// The same with a promise across triangles.
    pub const fn with_across(self, across: Across) -> Contract {
        Contract { across, ..self }
    }

    /// The contract in one line, as reports show it.
    pub fn describe(&self) -> String {
        let extent = match self.extent {
            Extent::Line => "line",
            Extent::Ray => "ray",
            Extent::Interval => "interval",
        };
        let sides = match self.sides {
            Sides::Both => "both sides",
            Sides::Front => "front only",
        };
        let boundary = match self.boundary {
            Boundary::Closed => "closed",
            Boundary::Open => "open",
            Boundary::Free => "boundary free",
        };
        let ends = match self.ends {
            Boundary::Closed => "",
            Boundary::Open => ", ends open",
            Boundary::Free => ", ends free",
        };
        let demand = |demand| match demand {
            Demand::Miss => "miss",
            Demand::Hit => "hit",
            Demand::Free => "free",
        };
        let mut text = format!(
            "{extent}, {sides}, {boundary}{ends}, coplanar {}, degenerate {}, invalid {}",
            demand(self.coplanar),
            demand(self.degenerate),
            demand(self.invalid)
        );
        if self.across != Across::Nothing {
            text.push_str(&format!(", {} across triangles", self.across.name()));
        }
        if let Direction::Unit { ulps } = self.direction {
            text.push_str(&format!(", unit directions within {ulps} ulps"));
        }
        if self.no_self_hit {
            text.push_str(", no self-hit");
        }
        match self.band {
            None => {}
            Some(band) if band.unit == BandUnit::Ulps => {
                text.push_str(&format!(", free within {band} of the boundary"));
            }
            Some(band) => {
                text.push_str(&format!(", free within {band} longest edges of the boundary"));
            }
        }
        text
    }
}

impl FromStr for Contract {
    type Err = String;

    /// As [`Contract::from_words`], where no kernel's own contract is known.
    fn from_str(text: &str) -> Result<Contract, String> {
        Contract::from_words(text, None)
    }
}

impl Contract {
    /// From words between commas: a named contract or `own` (a kernel's own contract), then `key=value`
    /// pairs that change it, `no-self-hit`, and `band=DISTANCE`. Without a name the words must give
    /// extent, sides and boundary; coplanar rays and triangles without area are then missed, invalid
    /// input is free, and directions of any length are promised.
    ///
    /// Errors: one line that says which word is wrong and what is known.
    pub fn from_words(text: &str, own: Option<&Contract>) -> Result<Contract, String> {
        let words: Vec<&str> = text.split(',').map(str::trim).collect();
        let named = match own.filter(|_| words[0] == "own") {
            Some(own) => Some(*own),
            None => NAMED.iter().find(|named| named.name == words[0]).map(|named| named.contract),
        };
        let has = |key: &str| words.iter().any(|word| word.split('=').next() == Some(key));
        if named.is_none() {
            if !words[0].contains('=') {
                let names: Vec<&str> = NAMED.iter().map(|named| named.name).collect();
                let advice = match nearest_name(words[0], names.iter().copied()) {
                    Some(near) => format!("; did you mean '{near}'?"),
                    None => {
                        let names = names.join(", ");
                        format!(": write {names}, or extent=ray,sides=both,boundary=closed")
                    }
                };
                return Err(format!("'{}' is no contract{advice}", words[0]));
            }
            if let Some(key) = ["extent", "sides", "boundary"].into_iter().find(|key| !has(key)) {
                return Err(format!("'{text}' does not say {key}=…"));
            }
        }
        let mut contract =
            named.unwrap_or(Contract::of_kernel(Extent::Ray, Sides::Both, Boundary::Closed));
        for word in &words[usize::from(named.is_some())..] {
            contract.change(word)?;
        }
        Ok(contract)
    }

    /// The shortest words that [`Contract::from_words`] reads as this contract: `own` if it is the
    /// kernel's own, a name, or what differs from either.
    pub fn words(&self, own: &Contract) -> String {
        let named = NAMED.iter().map(|named| (named.name, named.contract));
        let known = std::iter::once(("own", *own)).chain(named);
        let changes = |(name, base): (&str, Contract)| {
            std::iter::once(name.to_owned()).chain(self.changes_from(&base)).collect::<Vec<_>>()
        };
        // What a base promises and this contract does not, no word takes back.
        let possible = known.filter(|(_, base)| {
            (self.no_self_hit || !base.no_self_hit) && (self.band.is_some() || base.band.is_none())
        });
        let shortest = possible.map(changes).min_by_key(Vec::len);
        shortest.unwrap_or_default().join(",")
    }

    /// The `key=value` words that turn another contract into this one.
    fn changes_from(&self, base: &Contract) -> Vec<String> {
        let mut words = Vec::new();
        let mut change = |same: bool, key: &str, value: String| {
            if !same {
                words.push(format!("{key}={value}"));
            }
        };
        let name = |value: String| value.to_lowercase();
        change(self.extent == base.extent, "extent", name(format!("{:?}", self.extent)));
        change(self.sides == base.sides, "sides", name(format!("{:?}", self.sides)));
        change(self.boundary == base.boundary, "boundary", name(format!("{:?}", self.boundary)));
        change(self.ends == base.ends, "ends", name(format!("{:?}", self.ends)));
        change(self.coplanar == base.coplanar, "coplanar", name(format!("{:?}", self.coplanar)));
        change(
            self.degenerate == base.degenerate,
            "degenerate",
            name(format!("{:?}", self.degenerate)),
        );
        change(self.invalid == base.invalid, "invalid", name(format!("{:?}", self.invalid)));
        let direction = match self.direction {
            Direction::Any => "any".to_owned(),
            Direction::Unit { ulps } => format!("unit:{ulps}"),
        };
        change(self.direction == base.direction, "direction", direction);
        change(self.across == base.across, "across", self.across.name().to_owned());
        if let Some(band) = self.band {
            change(self.band == base.band, "band", band.to_string());
        }
        if self.no_self_hit && !base.no_self_hit {
            words.push("no-self-hit".to_owned());
        }
        words
    }
}

/// One `key=value` of a contract's text: the values of its key.
fn choice<T: Copy>(word: &str, value: &str, known: &[(&str, T)]) -> Result<T, String> {
    let found = known.iter().find(|(name, _)| *name == value);
    found.map(|(_, choice)| *choice).ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|(name, _)| *name).collect();
        format!("'{word}': there are {}", names.join(", "))
    })
}

impl Contract {
    /// Changes what one word of a contract's text says.
    fn change(&mut self, word: &str) -> Result<(), String> {
        let (key, value) = word.split_once('=').unwrap_or((word, ""));
        let boundaries =
            [("closed", Boundary::Closed), ("open", Boundary::Open), ("free", Boundary::Free)];
        let demands = [("miss", Demand::Miss), ("hit", Demand::Hit), ("free", Demand::Free)];
        match key {
            "extent" => {
                let extents =
                    [("line", Extent::Line), ("ray", Extent::Ray), ("interval", Extent::Interval)];
                self.extent = choice(word, value, &extents)?;
            }
            "sides" => {
                self.sides =
                    choice(word, value, &[("both", Sides::Both), ("front", Sides::Front)])?;
            }
            "boundary" => self.boundary = choice(word, value, &boundaries)?,
            "ends" => self.ends = choice(word, value, &boundaries)?,
            "coplanar" => self.coplanar = choice(word, value, &demands)?,
            "degenerate" => self.degenerate = choice(word, value, &demands)?,
            "invalid" => self.invalid = choice(word, value, &demands)?,
            "direction" => {
                let unit = value.strip_prefix("unit:").and_then(|ulps| ulps.parse().ok());
                self.direction = match (value, unit) {
                    ("any", _) => Direction::Any,
                    (_, Some(ulps)) => Direction::Unit { ulps },
                    _ => return Err(format!("'{word}': there are any, unit:ULPS")),
                };
            }
            "across" => {
                let promises = [Across::Nothing, Across::AtLeastOne, Across::ExactlyOne];
                self.across = choice(word, value, &promises.map(|across| (across.name(), across)))?;
            }
            "band" => self.band = Some(value.parse()?),
            "no-self-hit" if word == key => self.no_self_hit = true,
            _ => {
                let keys = "extent, sides, boundary, ends, coplanar, degenerate, invalid, direction, across, band, no-self-hit";
                return Err(format!("'{word}' is none of {keys}"));
            }
        }
        Ok(())
    }
}

/// A contract that all kernels can be judged by, for a league table.
pub struct NamedContract {
    /// The name on the command line.
    pub name: &'static str,
    /// The promise.
    pub contract: Contract,
    /// What it is for.
    pub about: &'static str,
}

/// One row per named contract.
pub const NAMED: &[NamedContract] = &[
    NamedContract {
        name: "closed-line",
        contract: Contract { extent: Extent::Line, ..Contract::CLOSED_RAY },
        about: "the closed triangle, any t",
    },
    NamedContract {
        name: "closed-ray",
        contract: Contract::CLOSED_RAY,
        about: "the closed triangle, t >= 0",
    },
    NamedContract {
        name: "closed-interval",
        contract: Contract { extent: Extent::Interval, ..Contract::CLOSED_RAY },
        about: "the closed triangle, t in [t_min, t_max]",
    },
    NamedContract {
        name: "open-ray",
        contract: Contract { boundary: Boundary::Open, ..Contract::CLOSED_RAY },
        about: "the open triangle (edges and vertices are misses), t >= 0",
    },
    NamedContract {
        name: "front-closed-ray",
        contract: Contract { sides: Sides::Front, ..Contract::CLOSED_RAY },
        about: "the closed triangle from its front, t >= 0",
    },
    NamedContract {
        name: "no-self-hit",
        contract: Contract { no_self_hit: true, ..Contract::CLOSED_RAY },
        about: "closed-ray, and no second hit on the triangle that the ray starts on (respawn)",
    },
];

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
        assert_eq!(own, Contract::of_kernel(Extent::Line, Sides::Front, Boundary::Open));
        let all = "closed-interval,boundary=free,ends=open,coplanar=hit,degenerate=free,invalid=free,\
            direction=unit:4,across=exactly-one,no-self-hit";
        assert_eq!(
            read(all).unwrap().describe(),
            "interval, both sides, boundary free, ends open, coplanar hit, degenerate free, invalid free, \
             exactly-one across triangles, unit directions within 4 ulps, no self-hit"
        );
        for named in NAMED {
            let own = Contract::of_kernel(Extent::Line, Sides::Front, Boundary::Open);
            let banded = Contract { band: "4ulps".parse().ok(), ..named.contract };
            for contract in [own, named.contract, banded, read(all).unwrap()] {
                let words = contract.words(&own);
                assert_eq!(Contract::from_words(&words, Some(&own)), Ok(contract), "{words}");
            }
        }
        assert_eq!(Contract::CLOSED_RAY.words(&read(all).unwrap()), "closed-ray");
        for (text, message) in [
            ("own", "'own' is no contract: write closed-line, "),
            ("", "'' is no contract: write closed-line, "),
            ("closed", "'closed' is no contract: write closed-line, "),
            ("extent=ray,sides=both", "'extent=ray,sides=both' does not say boundary=…"),
            ("closed-ray,sides=back", "'sides=back': there are both, front"),
            ("closed-ray,side=both", "'side=both' is none of extent, "),
            ("closed-ray,direction=unit", "'direction=unit': there are any, unit:ULPS"),
            ("closed-ray,no-self-hit=yes", "'no-self-hit=yes' is none of "),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.starts_with(message), "{text}: {error}");
        }
    }
}
