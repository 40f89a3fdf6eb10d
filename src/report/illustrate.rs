//! Computes what a report's pictures are drawn from.

use super::illustration::{Illustrations, MapPart};
use crate::audit::{Plan, Row};
use crate::kernel::Scalar;
use crate::map::{self, Ink, Map, Spot};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Pixels of a map's panel on a side.
const PIXELS: usize = 64;

/// Computes what the pictures of a plan's report are drawn from, without proofs: the same whatever the number of
/// threads.
pub fn illustrations(plan: &Plan) -> Illustrations {
    let mut all = Illustrations { maps: Vec::new(), proofs: Vec::new() };
    if plan.scalars[0] {
        add::<f32>(plan, &mut all);
    }
    if plan.scalars[1] {
        add::<f64>(plan, &mut all);
    }
    all
}

/// All of one scalar. A kernel that panics on the way has no pictures: the run counts its panics.
fn add<F: Scalar>(plan: &Plan, all: &mut Illustrations) {
    for row in plan.rows.iter().filter(|row| F::subject(row.entry).is_some()) {
        for spot in Spot::ALL {
            let map =
                catch_unwind(AssertUnwindSafe(|| map::standard::<F>(row, spot, [PIXELS; 2]).ok()));
            let map = map.ok().flatten();
            all.maps.extend(map.and_then(|map| map_part(row, spot, &map)));
        }
    }
}

fn map_part(row: &Row, spot: Spot, map: &Map) -> Option<MapPart> {
    let counts = |legend: Vec<(Ink, &'static str, usize)>| -> Vec<(String, u64)> {
        legend.into_iter().map(|(_, words, n)| (words.to_owned(), n as u64)).collect()
    };
    Some(MapPart {
        kernel: row.entry.info.name.to_owned(),
        set: row.set.clone(),
        scalar: map.scalar.to_owned(),
        spot: spot.name().to_owned(),
        size: map.size().map(|side| side as u64),
        axes: map.axes.each_ref().map(|axis| {
            format!("{} in steps of {} about {}", axis.name, axis.step.describe(), axis.centre)
        }),
        wrong: map.wrong() as u64,
        computed: counts(map.computed_legend()),
        exact: counts(map.exact_legend()),
        png: BASE64_STANDARD.encode(map::png(map, 1).ok()?),
    })
}
