//! The words of a record: kinds of findings, and promises across triangles.

use crate::contract::Across;
use crate::judge::Finding;
use std::cmp::Ordering;

named! {
    pub names
    /// A kind of finding that a record can hold.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    pub enum FindingKind {
        /// The contract asks for a hit and the kernel reports a miss.
        FalseMiss = "false-miss",
        /// The contract asks for a miss and the kernel reports a hit.
        FalseHit = "false-hit",
        /// A hit that is not false, with a value that is not finite or a wrong facing.
        BadValue = "bad-value",
        /// A hit that is not false, with a t, u or v farther from its exact value than rounding could carry it.
        WrongValue = "wrong-value",
        /// The kernel panicked.
        Panic = "panic",
        /// The kernel's process died, or it wrote outside its output.
        Crash = "crash",
        /// The kernel's process gave no answer in time.
        Timeout = "timeout",
        /// No triangle of a group reports a ray through its inside.
        Crack = "crack",
        /// Two triangles of a group report one crossing.
        Double = "double",
        /// The contract asks for a hit of the whole polygon, and it is missed.
        PolygonFalseMiss = "polygon-false-miss",
        /// The contract asks for a miss of the whole polygon, and it is hit.
        PolygonFalseHit = "polygon-false-hit",
        /// Over a folded edge the number of hits on its two triangles has the wrong parity.
        OddFold = "odd-fold",
        /// A bound or a property that must be proved is not.
        Unproved = "unproved",
    }
}

impl FindingKind {
    /// Those that expectations may name: all that runs find.
    pub const FOUND: &[FindingKind] = FindingKind::ALL.split_at(FindingKind::Unproved as usize).0;

    /// Those of single triangles.
    #[cfg(feature = "studies")]
    pub const OF_A_TRIANGLE: &[FindingKind] =
        FindingKind::ALL.split_at(FindingKind::Crack as usize).0;

    /// True if the kernel gave no verdict at all.
    pub fn is_failure(self) -> bool {
        matches!(
            self,
            FindingKind::Panic | FindingKind::Crash | FindingKind::Timeout
        )
    }

    /// True of a false miss or a false hit of a single triangle.
    pub fn is_wrong_verdict(self) -> bool {
        matches!(self, FindingKind::FalseMiss | FindingKind::FalseHit)
    }
}

impl From<Finding> for FindingKind {
    fn from(finding: Finding) -> FindingKind {
        match finding {
            Finding::FalseMiss => FindingKind::FalseMiss,
            Finding::FalseHit => FindingKind::FalseHit,
            Finding::BadValue => FindingKind::BadValue,
            Finding::WrongValue => FindingKind::WrongValue,
            Finding::Panic => FindingKind::Panic,
            Finding::Crash => FindingKind::Crash,
            Finding::Timeout => FindingKind::Timeout,
        }
    }
}

/// By name, as files list them.
impl Ord for FindingKind {
    fn cmp(&self, other: &FindingKind) -> Ordering {
        self.name().cmp(other.name())
    }
}

impl PartialOrd for FindingKind {
    fn partial_cmp(&self, other: &FindingKind) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

named! {
    pub names
    /// The promise for the number of hits on triangles that share an edge or a vertex.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Promised {
        /// Nothing.
        Nothing = "nothing",
        /// At least one where the ray passes through.
        AtLeastOne = "at-least-one",
        /// One where the ray passes through.
        ExactlyOne = "exactly-one",
        /// An odd number where the ray passes through, an even one at folds.
        Parity = "parity",
    }
}

impl Promised {
    /// True if it rules out cracks, true if doubles, and true if a wrong parity at folds.
    pub fn rules_out(self) -> [bool; 3] {
        match self {
            Promised::Nothing => [false; 3],
            Promised::AtLeastOne => [true, false, false],
            Promised::ExactlyOne => [true; 3],
            Promised::Parity => [false, false, true],
        }
    }

    /// The number of hits in short; none without a promise.
    pub fn in_short(self) -> Option<&'static str> {
        match self {
            Promised::Nothing => None,
            Promised::AtLeastOne => Some(">= 1"),
            Promised::ExactlyOne => Some("= 1"),
            Promised::Parity => Some("parity"),
        }
    }
}

impl From<Across> for Promised {
    fn from(across: Across) -> Promised {
        match across {
            Across::Nothing => Promised::Nothing,
            Across::AtLeastOne => Promised::AtLeastOne,
            Across::ExactlyOne => Promised::ExactlyOne,
        }
    }
}
