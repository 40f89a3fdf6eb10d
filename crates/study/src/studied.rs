//! The longest runs, compiled in this crate for both scalars. A crate that called them by a type parameter would compile
//! them once more, with its own optimisation.

use crate::epsilon::{self, Costs, MaxError, Pass, SceneStudy, Setting};
use crate::explore::worst::{self, WorstEntry, WorstGoal};
use crate::family::Family;
use crate::selfcheck::{self, Check, Reference};
use crate::spawn;
use crate::{case::Scene, engine::Observer, kernel::Scalar};

macro_rules! studied {
    ($($run:path: fn $name:ident($($argument:ident: $type:ty),* $(,)?) -> $result:ty;)*) => {
        /// A scalar in which everything is studied: each function is the one of its name in another module.
        #[allow(missing_docs)]
        pub trait Studied: Scalar {
            $(fn $name($($argument: $type),*) -> $result;)*
        }

        impl Studied for f32 {
            $(fn $name($($argument: $type),*) -> $result { $run($($argument),*) })*
        }

        impl Studied for f64 {
            $(fn $name($($argument: $type),*) -> $result { $run($($argument),*) })*
        }
    };
}

studied! {
    epsilon::study_scene: fn study_scene(
        setting: &Setting<'_, Self>,
        costs: &Costs,
        max_error: Option<&MaxError>,
        named: &[(String, Vec<Self>)],
        pass: Pass<'_>,
    ) -> Result<SceneStudy<Self>, String>;
    epsilon::try_elsewhere: fn try_elsewhere(
        setting: &Setting<'_, Self>,
        study: &mut SceneStudy<Self>,
        scenes: &[Scene],
        pass: Pass<'_>,
    ) -> ();
    spawn::run::<Self>: fn spawn(
        plan: &spawn::SpawnPlan<'_>,
        observer: &dyn Observer,
    ) -> spawn::SpawnSums;
    spawn::run_segments::<Self>: fn segments(
        plan: &spawn::SegmentPlan<'_>,
        observer: &dyn Observer,
    ) -> spawn::SegmentSums;
    worst::find_worst::<Self>: fn find_worst(
        goals: &[WorstGoal],
        evaluations: u64,
        seed: u64,
    ) -> Vec<Option<WorstEntry>>;
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
