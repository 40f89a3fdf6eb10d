//! On which kinds of planes the recommended epsilons are more often wrong than on the scene's own.

use super::record::SceneKernelPart;
use super::words::{label, share};

/// The kinds, and a label with a share for each. Only what is more often wrong on some kind, by
/// more than chance explains.
pub(super) fn worse_elsewhere(
    part: &SceneKernelPart,
) -> (Vec<&str>, Vec<(&'static str, Vec<String>)>) {
    let own = &part.tried[0].wrong;
    let is_worse = |count: &usize| {
        let most = own[*count].interval.map_or(1.0, |[_, high]| high);
        let mut lows = part.elsewhere.iter().filter_map(|plane| plane.wrong[*count].interval);
        lows.any(|[low, _]| most < low)
    };
    let row = |count: usize| {
        let others = part.elsewhere.iter().map(|plane| share(&plane.wrong[count]));
        let words = &part.counts[count];
        (label(words), others.collect())
    };
    let planes = part.elsewhere.iter().map(|plane| plane.plane.as_str()).collect();
    (planes, (0..own.len()).filter(is_worse).map(row).collect())
}
