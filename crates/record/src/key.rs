//! Names of disagreements.

use crate::arith::ScalarName;
use crate::class::FindingClass;
use crate::kind::FindingKind;
use crate::result::KernelResult;
use std::fmt;

/// Names a class of disagreement of a kernel row on a family in a scalar.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Key {
    /// The kernel's name.
    pub kernel: String,
    /// The name of its epsilons.
    pub set: String,
    /// The scalar.
    pub scalar: ScalarName,
    /// The source's name in tables.
    pub family: String,
    /// The subject: a class of truths, or triangles together.
    pub class: FindingClass,
    /// The kind of finding.
    pub finding: FindingKind,
}

impl Key {
    /// The key of a finding of a result.
    pub fn of(result: &KernelResult, class: FindingClass, finding: FindingKind) -> Key {
        Key {
            kernel: result.kernel.clone(),
            set: result.set.clone(),
            scalar: result.scalar,
            family: result.family.clone(),
            class,
            finding,
        }
    }

    /// The same finding, of all classes together.
    pub fn of_all_classes(&self) -> Key {
        Key {
            class: FindingClass::Any,
            ..self.clone()
        }
    }

    /// True if it is of the same kernel row in the same scalar.
    pub fn is_of_row(&self, other: &Key) -> bool {
        self.place()[..3] == other.place()[..3]
    }

    /// The kernel, its epsilons, the scalar and the family.
    pub fn place(&self) -> [&str; 4] {
        [&self.kernel, &self.set, self.scalar.name(), &self.family]
    }

    /// `kernel (set)`.
    pub fn row(&self) -> String {
        format!("{} ({})", self.kernel, self.set)
    }
}

impl fmt::Display for Key {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Key {
            scalar,
            family,
            class,
            finding,
            ..
        } = self;
        write!(f, "{} {scalar} {family}: {finding} of {class}", self.row())
    }
}
