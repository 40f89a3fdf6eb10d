//! The longest runs, compiled in this crate for both scalars. A crate that called them by a type parameter would compile
//! them once more, with its own optimisation.

use crate::epsilon::{self, Costs, MaxError, Pass, SceneStudy, Setting};
use crate::family::Family;
use crate::offset;
use crate::selfcheck::{self, Check, Reference};
use crate::{case::Scene, engine::Observer};

/// A trait of functions of both scalars, each of them the one at a path.
#[macro_export]
#[doc(hidden)]
macro_rules! studied {
    ($name_of_trait:ident; $($run:path: fn $name:ident($($argument:ident: $type:ty),* $(,)?) -> $result:ty;)*) => {
        /// A scalar in which everything is studied: each function is the one of its name in another module.
        #[allow(missing_docs)]
        pub trait $name_of_trait: $crate::Scalar {
            $(fn $name($($argument: $type),*) -> $result;)*
        }

        impl $name_of_trait for f32 {
            $(fn $name($($argument: $type),*) -> $result { $run($($argument),*) })*
        }

        impl $name_of_trait for f64 {
            $(fn $name($($argument: $type),*) -> $result { $run($($argument),*) })*
        }
    };
}

studied! {
    Studied;
    epsilon::study_scene: fn study_scene(
        setting: &Setting<'_, Self>,
        costs: &Costs,
        max_error: Option<&MaxError>,
        named: &[(String, Vec<Self>)],
        pass: Pass<'_>,
    ) -> Result<SceneStudy<Self>, String>;
    epsilon::Contender::of: fn contender(
        setting: &Setting<'_, Self>,
        costs: &Costs,
        pass: Pass<'_>,
    ) -> epsilon::Contender;
    epsilon::try_elsewhere: fn try_elsewhere(
        setting: &Setting<'_, Self>,
        study: &mut SceneStudy<Self>,
        scenes: &[Scene],
        pass: Pass<'_>,
    ) -> ();
    offset::run::<Self>: fn offset(
        plan: &offset::OffsetPlan<'_>,
        observer: &dyn Observer,
    ) -> offset::OffsetSums;
    offset::first_without_failure::<Self>: fn first_without_failure(
        plans: &[offset::OffsetPlan<'_>],
        schemes: &[offset::Scheme],
        observer: &dyn Observer,
    ) -> Option<offset::Scheme>;
    offset::run_segments::<Self>: fn segments(
        plan: &offset::SegmentPlan<'_>,
        observer: &dyn Observer,
    ) -> offset::SegmentSums;
    selfcheck::family::<Self>: fn check_family(
        family: &Family,
        reference: Reference,
        seed: u64,
        indices: u64,
        observer: &dyn Observer,
    ) -> Check;
    selfcheck::whole_range::<Self>: fn check_range(
        reference: Reference,
        seed: u64,
        indices: u64,
        observer: &dyn Observer,
    ) -> Check;
}
