//! Tries a study's recommendation in the same scene on planes and with rays of other kinds.

use super::measure::{Attempt, count_at};
use super::study::{Elsewhere, SceneStudy};
use super::trials::{Pass, Setting};
use crate::case::Scene;
use crate::kernel::Scalar;

/// Tries the recommended epsilons and the proved values in other scenes. A value that is wrong there is taken out of what
/// is proved: its proof is about the scene's own kind of plane.
pub fn try_elsewhere<F: Scalar>(
    setting: &Setting<'_, F>,
    study: &mut SceneStudy<F>,
    scenes: &[Scene],
    pass: Pass<'_>,
) {
    for scene in scenes {
        let mut attempts = vec![Attempt::new(study.best.clone())];
        attempts.extend(study.proved.iter().map(|found| {
            let bound = &found.bound;
            Attempt::alone(bound.knob, bound.value, bound.is_lower, &study.best)
        }));
        let setting = Setting { scene: Some(scene), store: None, ..*setting };
        let mut wrong = count_at(&setting, &attempts, pass.fresh()).into_iter();
        let of_best = wrong.next().expect("one attempt at least");
        study.elsewhere.push(Elsewhere { kind: scene.kind(), wrong: of_best });
        study.proved.retain(|found| {
            let wrong = wrong.next().expect("an attempt for each proof");
            wrong[found.bound.count].count == 0
        });
    }
}
