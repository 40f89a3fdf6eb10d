//! Profiles: what a specification demands of the tests that are free, with its sentences. They are files
//! that a reader in any language applies alike.

use super::test::{CLOSED, TestGroup, TestTriangle, VectorTest, result, word};
use crate::contract::{Boundary, Contract, Demand};
use crate::judge::{Obligation, obligation};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::fmt;

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
    boundary: ProfileAnswer<Demand>,
    ends: ProfileAnswer<Demand>,
    coplanar: ProfileAnswer<Demand>,
    degenerate: ProfileAnswer<Demand>,
    invalid: ProfileAnswer<Demand>,
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

named! {
    names
    /// A specification's demand on the hits on a group.
    #[derive(Clone, Copy)]
    enum Groups {
        /// One hit.
        ExactlyOne = "exactly-one",
        /// One hit or more.
        AtLeastOne = "at-least-one",
        /// An odd or an even number.
        Parity = "parity",
        /// Any number.
        Free = "free",
    }
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
    /// Reads a profile's file, as JSON.
    pub fn parse(text: &str) -> serde_json::Result<Profile> {
        serde_json::from_str(text)
    }

    fn contract(&self) -> Contract {
        let FreeAnswers {
            boundary,
            ends,
            coplanar,
            degenerate,
            invalid,
            ..
        } = &self.answers;
        let rim = |answer: &ProfileAnswer<Demand>| match answer.result {
            Demand::Hit => Boundary::Closed,
            Demand::Miss => Boundary::Open,
            Demand::Free => Boundary::Free,
        };
        Contract {
            boundary: rim(boundary),
            ends: rim(ends),
            coplanar: coplanar.result,
            degenerate: degenerate.result,
            invalid: invalid.result,
            ..CLOSED
        }
    }

    /// The sentence that an answer is against although it is right: the specification only advises what is not so.
    pub fn advice_against(&self, test: &VectorTest, answered: Answered) -> Option<Saying> {
        let groups = &self.answers.groups;
        let is_free = demanded(test, Some(self)) == "free";
        let group = test.group.as_ref().filter(|_| is_free)?;
        let advised = of_group(group, groups.advised?);
        (is_right(advised, answered) == Some(false)).then(|| groups.saying("groups"))
    }

    /// The sentences of the specification that decide a test; none if it is decided without them.
    pub fn sayings(&self, test: &VectorTest) -> Vec<Saying> {
        if test.group.is_some() {
            let decides = demanded(test, Some(self)) != demanded(test, None);
            return Vec::from_iter(decides.then(|| self.answers.groups.saying("groups")));
        }
        let asked = of_triangle(&test.triangles[0], Some(self));
        let decides = |answer: &ProfileAnswer<Demand>| {
            asked != Obligation::Free && answer.result.name() == word(asked)
        };
        let reasons = test.triangles[0].free_because();
        let answers = reasons
            .into_iter()
            .map(|reason| (reason, self.answers.of_single(reason)));
        let deciding = answers.filter(|(_, answer)| decides(answer));
        deciding
            .map(|(reason, answer)| answer.saying(reason))
            .collect()
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
    fn of_single(&self, reason: &str) -> &ProfileAnswer<Demand> {
        match reason {
            "boundary" => &self.boundary,
            "ends" => &self.ends,
            "coplanar" => &self.coplanar,
            "degenerate" => &self.degenerate,
            _ => &self.invalid,
        }
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
    let of_groups = profile.map_or(Groups::AtLeastOne, |profile| profile.answers.groups.result);
    match &test.group {
        None => word(of_triangle(&test.triangles[0], profile)),
        Some(group) => of_group(group, of_groups),
    }
}

/// The demand on a group, with what is asked of those on which readings differ.
fn of_group(group: &TestGroup, asked: Groups) -> &'static str {
    match asked {
        Groups::Parity => group.parity(),
        // Two triangles that fold have no number that is right but for parity.
        _ if group.result() != "at-least-one" => group.result(),
        asked => asked.name(),
    }
}

fn of_triangle(triangle: &TestTriangle, profile: Option<&Profile>) -> Obligation {
    match (result(&triangle.truth), profile) {
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
