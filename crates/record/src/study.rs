//! The study that a record is of, and the part of it that can be compared with another's.

use crate::plan::Provenance;
use crate::rate::Rate;
use crate::result::ResultPart;
use serde::Serialize;
use serde::de::DeserializeOwned;

named! {
    pub names
    /// The study that a record is of, by its command.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Study {
        /// Kernels on cases.
        Audit = "audit",
        /// Epsilons on the rays of a scene, or on other cases.
        Epsilon = "epsilon",
        /// Starts of new rays.
        Offset = "offset" | "spawn",
        /// Bounds that hold for every float of a domain.
        Prove = "prove",
        /// A product's answers to the test vectors.
        Verify = "verify",
        /// Slab tests on boxes.
        Boxes = "boxes",
        /// Answers of a program about rays at a mesh.
        Rays = "rays",
    }
}

/// The findings of a study, as its record holds them.
pub trait Findings: Serialize + DeserializeOwned {
    /// The study.
    const STUDY: Study;

    /// An error in one line if something in it contradicts something else, or the flags that made it.
    fn check(&self, _: &Provenance) -> Result<(), String> {
        Ok(())
    }
}

impl Findings for ResultPart {
    const STUDY: Study = Study::Audit;

    #[cfg(feature = "studies")]
    fn check(&self, provenance: &Provenance) -> Result<(), String> {
        self.check_with(provenance)
    }
}

impl<R: Comparable> Findings for R {
    const STUDY: Study = R::STUDY;
}

/// Findings that are compared count by count, by name.
pub trait Comparable: Serialize + DeserializeOwned {
    /// The study.
    const STUDY: Study;

    /// The question in words, of a scene, a mesh or a domain: answers to two of them are not compared.
    fn question(&self) -> String;

    /// The choice of the cases in words: where these are the same, so are the cases.
    fn cases(&self) -> String;

    /// How often what went wrong.
    fn counted(&self) -> Vec<NamedRate>;

    /// The numbers that were chosen or proved.
    fn chosen(&self) -> Vec<NamedValue> {
        Vec::new()
    }
}

/// How often something went wrong.
pub struct NamedRate {
    /// What, of which kernel, in one line.
    pub what: String,
    /// How often.
    pub rate: Rate,
    /// Shows a case of it, or what the count is of.
    pub command: Option<String>,
}

/// A number that was chosen or proved, or a word.
pub struct NamedValue {
    /// Its name, with that of the kernel, in one line.
    pub what: String,
    /// The number as text.
    pub value: String,
    /// True if it bounds an error, so that more is worse.
    pub is_bound: bool,
}

impl NamedValue {
    /// One that is no bound.
    pub fn chosen(what: String, value: &str) -> NamedValue {
        NamedValue {
            what,
            value: value.to_owned(),
            is_bound: false,
        }
    }
}
