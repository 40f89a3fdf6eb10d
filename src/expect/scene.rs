//! The scene that cases come from, by its numbers: counts of one scene say nothing about another.

use super::Expectations;
use crate::corpus::InputError;
use crate::report::{PlanPart, Record, apart};

/// The numbers of a plan's scene, as case ids have them; none if it has no scene.
pub(super) fn scene_of(plan: &PlanPart) -> Option<String> {
    plan.parameters().filter_map(|parameters| parameters.scene).next().map(|it| it.to_string())
}

impl Expectations {
    /// Checks that a run's scene, if it has one, is that of the expectations.
    ///
    /// Errors: the numbers that differ, and what to do.
    pub(super) fn are_of_the_scene(&self, record: &Record, file: &str) -> Result<(), InputError> {
        let (Some(before), Some(now)) = (&self.scene, scene_of(&record.result.plan)) else {
            return Ok(());
        };
        if *before == now {
            return Ok(());
        }
        let advice = match &record.provenance.plan_flags {
            Some(_) => {
                "give that scene, or let `hairline check --bless --accept-worse` write what is \
                        wrong in this one"
            }
            None => "give that scene, or let HAIRLINE_BLESS=worse write what is wrong in this one",
        };
        let [before, now] = [apart(before, &now, ","), apart(&now, before, ",")].map(|numbers| {
            match numbers.is_empty() {
                true => "none of the other's".to_owned(),
                false => numbers,
            }
        });
        let message = format!(
            "its cases are of a scene with {before}, and this run's scene has {now}: how many are wrong in one \
             says nothing about the other; {advice}"
        );
        Err(InputError::of(file, message))
    }
}
