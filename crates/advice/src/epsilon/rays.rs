//! The counts: rays that belong together, the ways in which answers on them are wrong, and which gates are there to keep
//! answers right.

use super::knob::Knob;
use crate::audit::{Row, Source, Stock};
use crate::contract::{Contract, Extent, Sides};
use crate::family::{Grouping, Stratum, find};
use crate::judge::Class;
use crate::kernel::{Gate, Role, Tunable};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rays {
    /// A part of a scene.
    Stratum(Stratum),
    /// The family of a name.
    Family(&'static str),
    /// All stored cases.
    Stored,
}

impl Rays {
    /// The rays of a source.
    pub fn of(source: &Source) -> Rays {
        match source.stock {
            Stock::Family(family) | Stock::Whole(family) => {
                Rays::named(family.name).unwrap_or(Rays::Family(family.name))
            }
            _ => Rays::Stored,
        }
    }

    /// The name of the family.
    pub fn name(self) -> &'static str {
        match self {
            Rays::Stratum(stratum) => stratum.name(),
            Rays::Family(name) => name,
            Rays::Stored => "stored",
        }
    }

    fn named(name: &str) -> Option<Rays> {
        let stratum = Stratum::named(name).map(Rays::Stratum);
        let stored = || (name == Rays::Stored.name()).then_some(Rays::Stored);
        stratum
            .or_else(|| find(name).map(|family| Rays::Family(family.name)))
            .or_else(stored)
    }
}

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
    counted
        .map(|(stratum, kind, _)| RayCount {
            rays: Rays::Stratum(stratum),
            kind,
        })
        .collect()
}

/// The counts on sources: of strata those of a scene; of other rays all that they can show. On a ray that starts on a
/// triangle self-hits are counted, if a knob can prevent them, and nothing else.
pub fn counts_of(sources: &[Source], knobs: &[Knob], row: &Row) -> Vec<RayCount> {
    let of_scene = counts(knobs, &row.contract);
    let gates = row.entry.info.gates;
    let has_start = knobs
        .iter()
        .any(|knob| guards_start(knob.gate(gates).role, &row.contract));
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

/// True if a gate of a role, among a kernel's gates, is there to refuse the cases of a class that must be missed under a
/// contract.
///
/// By its [`Role`]: a gate on t guards the ends of the extent; a gate on the determinant or on n·d guards
/// rays parallel to the plane and triangles without area, and with a sign the side as well; the others
/// guard everything else, and whatever has no gate of its own.
pub fn guards(gates: &[Gate], role: Role, contract: &Contract, class: Class) -> bool {
    let has = |role: Role| gates.iter().any(|gate| gate.role == role);
    let is_culling = |gate: &Gate| gate.role == Role::Parallel && gate.epsilon == Tunable::Signed;
    let culls = gates.iter().any(is_culling);
    let off_the_ends = class.is_off_the_interval() && contract.extent != Extent::Line;
    let from_behind = class.is_back() && contract.sides == Sides::Front;
    let within = !class.is_flat() && !off_the_ends && !from_behind;
    // Inside the triangle nothing must be missed but what lies on an open end.
    let at_an_end = within && class.part() == "interior" && contract.extent != Extent::Line;
    let outside = within && class.part() != "interior" || class.part() == "outside";
    match role {
        Role::Parallel => class.is_flat() || from_behind && culls,
        Role::T => off_the_ends || at_an_end,
        Role::Edge | Role::Other => {
            outside
                || class.is_flat() && !has(Role::Parallel)
                || (off_the_ends || at_an_end) && !has(Role::T)
                || from_behind && !culls
        }
    }
}

/// True if a gate of a role is there to keep a ray from hitting the triangle that it starts on: the epsilon of a gate on
/// t is.
pub fn guards_start(role: Role, contract: &Contract) -> bool {
    role == Role::T && contract.extent != Extent::Line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel;

    fn guarded(kernel: &str, gate: &str) -> Vec<String> {
        let info = kernel::find(kernel).unwrap().info;
        let gate = info
            .gates
            .iter()
            .position(|known| known.name == gate)
            .unwrap();
        let role = info.gates[gate].role;
        let is_guarded = |class: &Class| guards(info.gates, role, &info.contract, *class);
        Class::all()
            .filter(is_guarded)
            .map(|class| class.name().to_owned())
            .collect()
    }

    /// True if a class fits one of some patterns, which have `*` for any word.
    fn fits(patterns: &[&str], class: &str) -> bool {
        let word = |(pattern, word): (&str, &str)| pattern == "*" || pattern == word;
        let has_all = |pattern: &str| {
            pattern.split('/').count() == class.split('/').count()
                && pattern.split('/').zip(class.split('/')).all(word)
        };
        patterns.iter().any(|pattern| has_all(pattern))
    }

    #[test]
    fn what_has_no_gate_of_its_own_is_guarded_by_the_others() {
        use Role::{Edge, Other, Parallel, T};
        let of = |roles: &[Role], culls: bool, extent, sides| {
            let gate = |role: &Role| {
                let epsilon = if culls {
                    Tunable::Signed
                } else {
                    Tunable::NonNegative
                };
                let dimension = crate::kernel::Dimension::new(0, 0);
                Gate {
                    name: role.name(),
                    role: *role,
                    refuses: "",
                    printed: None,
                    dimension,
                    epsilon,
                }
            };
            let gates: Vec<Gate> = roles.iter().map(gate).collect();
            (
                gates,
                Contract {
                    extent,
                    sides,
                    ..Contract::CLOSED_RAY
                },
            )
        };
        let flat = ["parallel", "coplanar", "degenerate"];
        let off = ["*/*/before", "*/*/beyond"];
        let beside = ["edge/*/within", "vertex/*/within", "outside/*/*", "invalid"];
        let seen_beside = [
            "edge/front/within",
            "vertex/front/within",
            "outside/*/*",
            "invalid",
        ];
        let all = [&["*/*/*", "invalid"], &flat[..]].concat();
        let (line, interval) = (Extent::Line, Extent::Interval);
        let (both, front) = (Sides::Both, Sides::Front);
        let three = [Parallel, T, Edge];
        type Row<'a> = (&'a [Role], bool, Extent, Sides, Role, Vec<&'a str>);
        let rows: [Row; 16] = [
            (&three, true, interval, both, Parallel, flat.to_vec()),
            (
                &three,
                true,
                interval,
                both,
                T,
                [&off[..], &["interior/*/within"]].concat(),
            ),
            (&three, true, interval, both, Edge, beside.to_vec()),
            (&three, true, line, both, T, vec![]),
            (
                &three,
                true,
                line,
                both,
                Edge,
                vec!["edge/*/*", "vertex/*/*", "outside/*/*", "invalid"],
            ),
            (&three, false, interval, front, Parallel, flat.to_vec()),
            (
                &three,
                true,
                interval,
                front,
                Parallel,
                [&flat[..], &["*/back/*"]].concat(),
            ),
            (
                &three,
                false,
                interval,
                front,
                T,
                [&off[..], &["interior/front/within"]].concat(),
            ),
            (
                &three,
                false,
                interval,
                front,
                Edge,
                [&seen_beside[..], &["*/back/*"]].concat(),
            ),
            (&three, true, interval, front, Edge, seen_beside.to_vec()),
            (&[Other], true, interval, front, Other, all),
            (
                &[Edge],
                true,
                line,
                both,
                Edge,
                [
                    &flat[..],
                    &["edge/*/*", "vertex/*/*", "outside/*/*", "invalid"],
                ]
                .concat(),
            ),
            (
                &[Edge, T],
                false,
                interval,
                both,
                Edge,
                [&flat[..], &beside[..]].concat(),
            ),
            (
                &[Parallel, Other],
                false,
                interval,
                both,
                Other,
                [&off[..], &beside[..], &["interior/*/within"]].concat(),
            ),
            (
                &[Parallel, Edge],
                true,
                interval,
                front,
                Edge,
                [&off[..], &seen_beside[..], &["interior/front/within"]].concat(),
            ),
            (&[Edge, T], true, line, front, Edge, {
                let seen = ["edge/front/*", "vertex/front/*", "outside/*/*", "*/back/*"];
                [&flat[..], &seen[..], &["invalid"]].concat()
            }),
        ];
        for (roles, culls, extent, sides, role, patterns) in rows {
            let (gates, contract) = of(roles, culls, extent, sides);
            for class in Class::all() {
                let expected = fits(&patterns, class.name());
                let told = format!("{roles:?} {culls} {extent:?} {sides:?} {role:?}");
                assert_eq!(
                    guards(&gates, role, &contract, class),
                    expected,
                    "{told}: {}",
                    class.name()
                );
            }
            assert_eq!(guards_start(role, &contract), role == T && extent != line);
        }
    }

    #[test]
    fn each_class_is_guarded_by_the_gate_that_asks_about_it() {
        let flat = ["parallel", "coplanar", "degenerate"];
        assert_eq!(guarded("moller-trumbore", "parallel"), flat);
        assert!(guarded("plane-inside-out", "t").contains(&"interior/front/before".to_owned()));
        assert!(!guarded("plane-inside-out", "t").contains(&"outside/front/within".to_owned()));
        let at_an_open_end = "interior/front/within".to_owned();
        assert!(guarded("plane-inside-out", "t").contains(&at_an_open_end));
        assert!(!guarded("plane-inside-out", "edge").contains(&at_an_open_end));
        assert!(guarded("plane-inside-out", "edge").contains(&"outside/back/before".to_owned()));
        // Culling by the determinant's sign; by the edges' where there is no determinant.
        let culled = "interior/back/within".to_owned();
        assert!(guarded("moller-trumbore-culling", "parallel").contains(&culled));
        assert!(guarded("scalar-triple", "edge").contains(&culled));
        assert!(
            flat.iter()
                .all(|class| guarded("scalar-triple", "edge").contains(&(*class).to_owned()))
        );
    }
}
