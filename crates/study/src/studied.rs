//! The longest runs, compiled in this crate for both scalars. A crate that called them by a type parameter would compile
//! them once more, with its own optimisation.

use crate::epsilon::{Costs, MaxError, SceneStudy, Setting, study_scene, try_elsewhere};
use crate::explore::worst::{Entry, Goal, find_worst};
use crate::spawn;
use crate::{case::Scene, engine::Observer, kernel::Scalar};

/// A scalar in which everything is studied.
pub trait Studied: Scalar {
    /// [`study_scene`].
    fn study_scene(
        setting: &Setting<'_, Self>,
        costs: &Costs,
        max_error: Option<&MaxError>,
        named: &[(String, Vec<Self>)],
        seed: u64,
        count: u64,
        observer: &dyn Observer,
    ) -> Result<SceneStudy<Self>, String>;
    /// [`try_elsewhere`].
    fn try_elsewhere(
        setting: &Setting<'_, Self>,
        study: &mut SceneStudy<Self>,
        scenes: &[Scene],
        seed: u64,
        count: u64,
        observer: &dyn Observer,
    );
    /// [`spawn::run`].
    fn spawn(plan: &spawn::Plan<'_>, observer: &dyn Observer) -> spawn::Sums;
    /// [`find_worst`].
    fn find_worst(goals: &[Goal], evaluations: u64, seed: u64) -> Vec<Option<Entry>>;
}

macro_rules! studied {
    ($scalar:ty) => {
        impl Studied for $scalar {
            fn study_scene(
                setting: &Setting<'_, Self>,
                costs: &Costs,
                max_error: Option<&MaxError>,
                named: &[(String, Vec<Self>)],
                seed: u64,
                count: u64,
                observer: &dyn Observer,
            ) -> Result<SceneStudy<Self>, String> {
                study_scene(setting, costs, max_error, named, seed, count, observer)
            }

            fn try_elsewhere(
                setting: &Setting<'_, Self>,
                study: &mut SceneStudy<Self>,
                scenes: &[Scene],
                seed: u64,
                count: u64,
                observer: &dyn Observer,
            ) {
                try_elsewhere(setting, study, scenes, seed, count, observer);
            }

            fn spawn(plan: &spawn::Plan<'_>, observer: &dyn Observer) -> spawn::Sums {
                spawn::run::<Self>(plan, observer)
            }

            fn find_worst(goals: &[Goal], evaluations: u64, seed: u64) -> Vec<Option<Entry>> {
                find_worst::<Self>(goals, evaluations, seed)
            }
        }
    };
}

studied!(f32);
studied!(f64);
