//! The scene that cases come from, by its numbers: counts of one scene say nothing about another.

use super::Expectations;
use hairline_files::InputError;
use hairline_record::{PlanPart, Record, apart};

/// The numbers of a plan's scene, as case ids have them; none if it has no scene.
pub(super) fn scene_of(plan: &PlanPart) -> Option<String> {
    plan.parameters()
        .filter_map(|parameters| parameters.scene)
        .next()
        .map(|it| it.to_string())
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
        let bless = match &record.provenance.plan_flags {
            Some(_) => "`hairline check --bless --accept-worse`",
            None => "HAIRLINE_BLESS=worse",
        };
        let none = "none of the other's";
        let [before, now] = [
            apart(before, &now, ",", none),
            apart(&now, before, ",", none),
        ];
        let message = format!(
            "its cases are of a scene with {before}, and this run's scene has {now}: how many are wrong in one \
             says nothing about the other; give that scene, or let {bless} write what is wrong in this one"
        );
        Err(InputError::of(file, message))
    }
}
