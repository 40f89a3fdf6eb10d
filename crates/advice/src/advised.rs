//! Which epsilons and which offsets, compiled in this crate for both scalars, as `hairline_study::studied` has its runs.

use crate::case::Scene;
use crate::engine::Observer;
use crate::epsilon::{self, Chosen, Costs, MaxError, Pass, SceneStudy, Setting};
use crate::offset;

hairline_study::studied! {
    Advised;
    epsilon::choose: fn choose(
        setting: &Setting<'_, Self>,
        costs: &Costs,
        max_error: Option<&MaxError>,
        pass: Pass<'_>,
        form_rays: u64,
    ) -> Chosen<Self>;
    epsilon::try_on_fresh: fn try_on_fresh(
        setting: &Setting<'_, Self>,
        chosen: Chosen<Self>,
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
        scene: &Scene,
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
}
