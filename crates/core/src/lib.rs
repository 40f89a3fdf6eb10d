//! An exact answer to "does this ray hit this triangle?" for every finite `f32` and `f64`; and the published kernels
//! that try to give it in floats.
//!
//! ```
//! use hairline_core::{Case, Truth, truth};
//!
//! let triangle = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
//! let case = Case::<f64>::new([0.25, 0.25, 1.0], [0.0, 0.0, -1.0], triangle);
//! assert!(matches!(truth(&case), Truth::Transversal(_)));
//! ```
//!
//! [`truth()`] answers for one case, [`truths`] and [`Batch`] for millions. A [`Kernel`] is written once for every
//! arithmetic; [`find`] knows the published ones. The crate `hairline` compares the two.
//!
//! The root of this crate is the interface. The modules hold what `hairline` and its prover share, and change with
//! them.

// Runs that find margins are compiled with the feature of their name alone.
#![cfg_attr(not(feature = "margins"), allow(dead_code, unused_imports))]

#[doc(hidden)]
pub use serde;

/// An enum whose values have names: in text, in files and in records. Old names are read too, and never written.
#[macro_export]
#[doc(hidden)]
macro_rules! named {
    ($methods:vis names $(#[$about:meta])* $visible:vis enum $type:ident {
        $($(#[doc = $doc:literal])* $value:ident = $name:literal $(| $old_name:literal)*,)*
    }) => {
        $(#[$about])*
        $visible enum $type {
            $($(#[doc = $doc])* $value,)*
        }

        impl $type {
            /// All of them, in their order.
            $methods const ALL: [$type; [$($name),*].len()] = [$($type::$value),*];

            /// The name in files, in reports and on the command line.
            $methods const fn name(self) -> &'static str {
                match self {
                    $($type::$value => $name,)*
                }
            }

            /// The meaning, as its documentation has it, without the full stop.
            #[allow(dead_code)]
            $methods fn about(self) -> &'static str {
                let text = match self {
                    $($type::$value => concat!($($doc),*),)*
                };
                text.trim().trim_end_matches('.')
            }

            /// The value of a name, or of one that it had once.
            #[allow(dead_code)]
            $methods fn named(name: &str) -> Option<$type> {
                match name {
                    $($name $(| $old_name)* => Some($type::$value),)*
                    _ => None,
                }
            }

            /// The value of a name; an error says after the word in which it stands what names there are.
            #[allow(dead_code)]
            $methods fn chosen(word: &str, name: &str) -> Result<$type, String> {
                let unknown = || format!("{word}: there are {}", [$($name),*].join(", "));
                $type::named(name).ok_or_else(unknown)
            }
        }

        impl std::fmt::Display for $type {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl $crate::serde::Serialize for $type {
            fn serialize<S: $crate::serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                to.serialize_str(self.name())
            }
        }

        impl<'de> $crate::serde::Deserialize<'de> for $type {
            fn deserialize<D: $crate::serde::Deserializer<'de>>(from: D) -> Result<$type, D::Error> {
                let name = <String as $crate::serde::Deserialize>::deserialize(from)?;
                let unknown = || $crate::serde::de::Error::unknown_variant(&name, &[$($name),*]);
                $type::named(&name).ok_or_else(unknown)
            }
        }
    };
}

/// Does the same with whichever scalar's value an [`AnyScalar`](crate::case::AnyScalar) holds.
#[macro_export]
#[doc(hidden)]
macro_rules! either_scalar {
    ($any:expr, $value:pat => $do:expr) => {
        match $any {
            $crate::case::AnyScalar::F32($value) => $do,
            $crate::case::AnyScalar::F64($value) => $do,
        }
    };
}

/// Does something in the scalar of a [`ScalarName`](crate::arith::ScalarName).
#[macro_export]
#[doc(hidden)]
macro_rules! in_named_scalar {
    ($name:expr, $scalar:ident => $do:expr) => {
        match $name {
            $crate::arith::ScalarName::F32 => {
                type $scalar = f32;
                $do
            }
            $crate::arith::ScalarName::F64 => {
                type $scalar = f64;
                $do
            }
        }
    };
}

// The floors, from the ground up: each module uses only those above it in this list.
#[doc(hidden)]
pub mod arith;
#[doc(hidden)]
pub mod engine;
mod error;

#[doc(hidden)]
pub mod case;
#[doc(hidden)]
pub mod contract;
#[doc(hidden)]
pub mod printable;
#[doc(hidden)]
pub mod suggest;
#[doc(hidden)]
pub mod truth;

#[doc(hidden)]
pub mod kernel;
#[doc(hidden)]
pub mod oracle;

pub mod exact;

pub use case::{Case, Parameters, Ray, Triangle};
pub use error::{Error, ErrorKind};
pub use oracle::{Batch, Layers, UnequalColumns, truth, truths, truths_of_rows};
pub use truth::{Contact, ContactKind, Crossing, Facing, Feature, Place, Truth};

pub use contract::{
    Across, Band, BandUnit, Boundary, Contract, Demand, Direction, Extent, NAMED, NamedContract,
    Sides,
};

pub use arith::{Float, Real, ScalarName, Vector};
pub use kernel::{
    Dimension, Entry, EpsilonSet, Failure, Gate, Gives, Hit, Kernel, KernelIn, KernelInfo, Refuse,
    Role, Scalar, Sink, Test, Tunable, Verdict, find,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
