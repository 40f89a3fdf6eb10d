//! Profiles: what a specification demands of the tests that are free, with its sentences. They are files
//! that a reader in any language applies alike.

use super::{TestTriangle, VectorTest, word};
use crate::contract::{Boundary, Contract, Demand};
use crate::judge::{Obligation, obligation};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt;

/// The profiles by name.
const PROFILES: [(&str, &str); 4] = [
    ("dxr", include_str!("../../vectors/profiles/dxr.json")),
    ("parity", include_str!("../../vectors/profiles/parity.json")),
    ("picking", include_str!("../../vectors/profiles/picking.json")),
    ("vulkan", include_str!("../../vectors/profiles/vulkan.json")),
];

/// A specification's answers.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// The name on the command line.
    pub name: String,
    /// The specification with its version.
    pub specification: String,
    /// Where it can be read.
    pub url: Option<String>,
    /// Its rules for inputs, each with its sentence: `t_min` may be `at-least-0`. It says nothing about rays that break one.
    #[serde(default)]
    preconditions: Vec<BTreeMap<String, String>>,
    answers: FreeAnswers,
}

/// One answer for each word of `free_because`, and one for groups.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FreeAnswers {
    boundary: ProfileAnswer<Single>,
    ends: ProfileAnswer<Single>,
    coplanar: ProfileAnswer<Single>,
    degenerate: ProfileAnswer<Single>,
    invalid: ProfileAnswer<Single>,
    groups: ProfileAnswer<Groups>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ProfileAnswer<T> {
    result: T,
    /// The answer that it only advises: a "should".
    #[serde(default = "none")]
    advised: Option<T>,
    /// The section of the specification; null where it says nothing.
    section: Option<String>,
    /// Its words, or why there is no answer.
    sentence: String,
}

fn none<T>() -> Option<T> {
    None
}

impl<T> ProfileAnswer<T> {
    fn saying(&self, word: &str) -> Saying {
        Saying {
            word: word.to_owned(),
            section: self.section.clone(),
            sentence: self.sentence.clone(),
        }
    }
}

#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Single {
    Hit,
    Miss,
    Free,
}

/// A specification's demand on the hits on a group.
#[derive(Clone, Copy, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Groups {
    /// One hit.
    ExactlyOne,
    /// One hit or more.
    AtLeastOne,
    /// An odd or an even number.
    Parity,
    /// Any number.
    Free,
}

/// A product's answer to a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answered {
    /// A hit or a miss.
    Single(bool),
    /// How many triangles of a group are hit.
    Hits(u64),
}

impl fmt::Display for Answered {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Answered::Single(true) => f.write_str("hit"),
            Answered::Single(false) => f.write_str("miss"),
            Answered::Hits(hits) => write!(f, "{hits}"),
        }
    }
}

impl Profile {
    /// The names of all profiles.
    pub fn names() -> impl Iterator<Item = &'static str> {
        PROFILES.iter().map(|(name, _)| *name)
    }

    /// The profile of a name.
    pub fn find(name: &str) -> Option<Profile> {
        let (_, text) = PROFILES.iter().find(|(known, _)| *known == name)?;
        Some(serde_json::from_str(text).expect("tests read the profiles"))
    }

    fn contract(&self) -> Contract {
        let FreeAnswers { boundary, ends, coplanar, degenerate, invalid, .. } = &self.answers;
        let rim = |answer: &ProfileAnswer<Single>| match answer.result {
            Single::Hit => Boundary::Closed,
            Single::Miss => Boundary::Open,
            Single::Free => Boundary::Free,
        };
        let demand = |answer: &ProfileAnswer<Single>| match answer.result {
            Single::Hit => Demand::Hit,
            Single::Miss => Demand::Miss,
            Single::Free => Demand::Free,
        };
        Contract {
            boundary: rim(boundary),
            ends: rim(ends),
            coplanar: demand(coplanar),
            degenerate: demand(degenerate),
            invalid: demand(invalid),
            ..super::CLOSED
        }
    }

    /// The demand on groups on which readings differ.
    pub fn of_groups(&self) -> Groups {
        self.answers.groups.result
    }

    /// The sentence that an answer is against although it is right: the specification only advises what is not so.
    pub fn advice_against(&self, test: &VectorTest, answered: Answered) -> Option<Saying> {
        let groups = &self.answers.groups;
        let is_free = demanded(test, Some(self)) == "free";
        let group = test.group.as_ref().filter(|_| is_free)?;
        let advised = match groups.advised? {
            _ if group.result() != "at-least-one" => group.result(),
            Groups::ExactlyOne => "exactly-one",
            Groups::AtLeastOne => "at-least-one",
            Groups::Parity => group.parity(),
            Groups::Free => "free",
        };
        (is_right(advised, answered) == Some(false)).then(|| groups.saying("groups"))
    }

    /// The sentences of the specification that decide a test; none if it is decided without them.
    pub fn sayings(&self, test: &VectorTest) -> Vec<Saying> {
        if test.group.is_some() {
            let decides = demanded(test, Some(self)) != demanded(test, None);
            return Vec::from_iter(decides.then(|| self.answers.groups.saying("groups")));
        }
        let asked = of_triangle(&test.triangles[0], Some(self));
        let decides = |result| match asked {
            Obligation::MustHit => result == Single::Hit,
            Obligation::MustMiss => result == Single::Miss,
            Obligation::Free => false,
        };
        let reasons = test.triangles[0].free_because();
        let of_single = self.answers.of_single().into_iter();
        let deciding =
            of_single.filter(|(word, answer)| reasons.contains(word) && decides(answer.result));
        deciding.map(|(word, answer)| answer.saying(word)).collect()
    }
}

/// Where a profile says what is demanded of tests.
#[apply(part!)]
#[derive(PartialEq)]
pub struct Saying {
    /// A word of `free_because`, or `groups`.
    pub word: String,
    /// The section of the specification, where it says something.
    pub section: Option<String>,
    /// Its words, or why the answer is what it is.
    pub sentence: String,
}

impl FreeAnswers {
    /// By the words of `free_because`.
    fn of_single(&self) -> [(&'static str, &ProfileAnswer<Single>); 5] {
        [
            ("boundary", &self.boundary),
            ("ends", &self.ends),
            ("coplanar", &self.coplanar),
            ("degenerate", &self.degenerate),
            ("invalid", &self.invalid),
        ]
    }
}

/// The demand of a test: a word of `result`, `odd` or `even`.
pub fn demanded(test: &VectorTest, profile: Option<&Profile>) -> &'static str {
    let starts_early = || either_scalar!(&test.cases[0], case => case.ray.t_min < 0.0);
    let is_rule =
        |rule: &BTreeMap<String, String>| rule.get("t_min").is_some_and(|t| t == "at-least-0");
    if profile.is_some_and(|profile| profile.preconditions.iter().any(is_rule)) && starts_early() {
        return "free";
    }
    match (&test.group, profile.map(|profile| profile.answers.groups.result)) {
        (None, _) => word(of_triangle(&test.triangles[0], profile)),
        (Some(group), Some(Groups::Parity)) => group.parity(),
        // Two triangles that fold have no number that is right but for parity.
        (Some(group), _) if group.result() != "at-least-one" => group.result(),
        (Some(_), Some(Groups::ExactlyOne)) => "exactly-one",
        (Some(_), Some(Groups::Free)) => "free",
        (Some(_), None | Some(Groups::AtLeastOne)) => "at-least-one",
    }
}

fn of_triangle(triangle: &TestTriangle, profile: Option<&Profile>) -> Obligation {
    match (triangle.result(), profile) {
        (Obligation::Free, Some(profile)) => {
            obligation(&triangle.truth, &profile.contract(), false)
        }
        (result, _) => result,
    }
}

/// True if an answer meets the demand; none if it is the answer to another kind of test.
pub fn is_right(demanded: &str, answered: Answered) -> Option<bool> {
    Some(match (demanded, answered) {
        ("free", _) => true,
        ("hit", Answered::Single(hit)) => hit,
        ("miss", Answered::Single(hit)) => !hit,
        ("exactly-one", Answered::Hits(hits)) => hits == 1,
        ("at-least-one", Answered::Hits(hits)) => hits > 0,
        ("odd", Answered::Hits(hits)) => hits % 2 == 1,
        ("even", Answered::Hits(hits)) => hits % 2 == 0,
        _ => return None,
    })
}
