//! The counts: rays that belong together, and the ways in which answers on them are wrong.

use super::duty::guards_start;
use super::knob::Knob;
use crate::audit::{Row, Source, Stock};
use crate::contract::{Contract, Extent, Sides};
use crate::family::{Family, Grouping, Stratum, find};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::fmt;

named! {
    pub names
    /// How an answer is wrong in a scene; the word in `--cost`.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum WrongKind {
        /// A ray slips through between triangles that share an edge or a vertex.
        Crack = "crack",
        /// A hit is lost.
        Miss = "miss",
        /// A hit is reported where there is none.
        Hit = "hit",
        /// A ray hits the triangle that it starts on.
        SelfHit = "self-hit",
    }
}

impl WrongKind {
    /// True if it is the refusal that is wrong.
    pub fn is_wrong_if_refused(self) -> bool {
        matches!(self, WrongKind::Crack | WrongKind::Miss)
    }
}

/// Rays that are counted together.
#[derive(Clone, Copy)]
pub enum Rays {
    /// A part of a scene.
    Stratum(Stratum),
    /// A family.
    Family(&'static Family),
    /// All stored cases.
    Stored,
}

impl Rays {
    /// The rays of a source.
    pub fn of(source: &Source) -> Rays {
        match source.stock {
            Stock::Family(family) | Stock::Whole(family) => {
                Rays::named(family.name).unwrap_or(Rays::Family(family))
            }
            _ => Rays::Stored,
        }
    }

    /// The name of the family.
    pub fn name(self) -> &'static str {
        match self {
            Rays::Stratum(stratum) => stratum.name(),
            Rays::Family(family) => family.name,
            Rays::Stored => "stored",
        }
    }

    fn named(name: &str) -> Option<Rays> {
        let stratum = Stratum::named(name).map(Rays::Stratum);
        let stored = || (name == Rays::Stored.name()).then_some(Rays::Stored);
        stratum.or_else(|| find(name).map(Rays::Family)).or_else(stored)
    }
}

impl fmt::Debug for Rays {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl PartialEq for Rays {
    fn eq(&self, other: &Rays) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Rays {}

impl Serialize for Rays {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for Rays {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Rays, D::Error> {
        let name = String::deserialize(deserializer)?;
        Rays::named(&name).ok_or_else(|| D::Error::custom(format!("no family '{name}'")))
    }
}

/// A number that is counted: the wrong answers of one kind on some rays.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RayCount {
    /// The family of the rays, `scene-…` for a stratum.
    #[serde(rename = "stratum")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub rays: Rays,
    /// `crack`, `miss`, `hit` or `self-hit`.
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub kind: WrongKind,
}

/// The counts of a kernel with these knobs under a contract, in the order of reports. Without a
/// least t nothing can keep a ray from hitting the triangle that it starts on.
pub fn counts(knobs: &[Knob], contract: &Contract) -> Vec<RayCount> {
    use Stratum::*;
    let starts = contract.extent != Extent::Line;
    let culls = contract.sides == Sides::Front;
    let all = [
        (Interior, WrongKind::Miss, true),
        (Interior, WrongKind::Hit, culls),
        (Edges, WrongKind::Crack, true),
        (Vertices, WrongKind::Crack, true),
        (Grazing, WrongKind::Miss, true),
        (Grazing, WrongKind::Hit, true),
        (Parallel, WrongKind::Hit, true),
        (Shadow, WrongKind::SelfHit, starts && !knobs.is_empty()),
        (Outside, WrongKind::Hit, true),
    ];
    let counted = all.into_iter().filter(|(.., is_counted)| *is_counted);
    counted.map(|(stratum, kind, _)| RayCount { rays: Rays::Stratum(stratum), kind }).collect()
}

/// The counts on sources: of strata those of a scene; of other rays all that they can show. On a ray that starts on a
/// triangle self-hits are counted, if a knob can prevent them, and nothing else.
pub fn counts_of(sources: &[Source], knobs: &[Knob], row: &Row) -> Vec<RayCount> {
    let of_scene = counts(knobs, &row.contract);
    let gates = row.entry.info.gates;
    let has_start = knobs.iter().any(|knob| guards_start(knob.role(gates), &row.contract));
    let mut counts: Vec<RayCount> = Vec::new();
    for source in sources {
        let (rays, grouping) = (Rays::of(source), source.grouping());
        let starts = has_start && grouping == Grouping::SecondaryRay;
        let of_rays = |kind: WrongKind| match rays {
            Rays::Stratum(_) => of_scene.contains(&RayCount { rays, kind }),
            _ => match kind {
                WrongKind::SelfHit => starts,
                WrongKind::Crack => grouping.shares_a_ray(),
                WrongKind::Miss | WrongKind::Hit => !starts,
            },
        };
        let of_rays = WrongKind::ALL.into_iter().filter(|kind| of_rays(*kind));
        let found = of_rays.map(|kind| RayCount { rays, kind });
        let new: Vec<RayCount> = found.filter(|count| !counts.contains(count)).collect();
        counts.extend(new);
    }
    counts
}
