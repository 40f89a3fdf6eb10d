//! A picture of a scene: how many of its pixels are holes at the edges that triangles share.
//!
//! The areas of the leaks over those of the triangles, as the rays see them, are the share of holes among the pixels of a
//! picture that these triangles cover once, side by side. No numbers of the kernel are asked, only its answers, so
//! epsilons may be as wide as they like.

use super::knob::KnobMargins;
use super::trials::{Pass, Setting, accepts, is_unknown};
use crate::audit::{Interval, clopper_pearson};
use crate::case::Case;
use crate::engine;
use crate::family::{Pixel, Stratum};
use crate::judge::{Obligation, obligation};
use crate::kernel::Scalar;
use crate::oracle::{self, Layers};

/// Rays that are summed together.
const CHUNK: u64 = 1024;

/// The share of a picture's pixels that are holes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HoleShare {
    /// As estimated.
    pub share: f64,
    /// The 95 % interval; none where no ray leaked, which does not say how far from the edge one would.
    pub interval: Option<Interval>,
}

/// How much larger than the largest leak that was seen the next may be: of samples of 300 rays, 19 in 20 have the share of a
/// million rays in their interval with 8, 9 in 10 with 4.
const UNSEEN: f64 = 8.0;

/// The areas for which leaking rays stand.
#[derive(Clone, Copy, Default)]
struct Leaks {
    area: f64,
    /// The sum of the areas' squares.
    squares: f64,
    /// The largest area of one.
    largest: f64,
}

/// The sums of some rays.
#[derive(Clone)]
struct RaySums {
    /// By epsilons.
    leaks: Vec<Leaks>,
    triangles: f64,
}

/// The share of holes with each of some epsilons, on a seed's first rays near edges; none where there is no scene, or no two triangles share
/// one.
pub fn holes<F: Scalar>(
    setting: &Setting<'_, F>,
    epsilons: &[Vec<F>],
    pass: Pass<'_>,
) -> Vec<Option<HoleShare>> {
    // Families are no scene, whose triangles could cover a picture.
    let Some(scene) = setting.scene else {
        return vec![None; epsilons.len()];
    };
    let empty = RaySums {
        leaks: vec![Leaks::default(); epsilons.len()],
        triangles: 0.0,
    };
    let count = setting
        .source(Stratum::Edges, pass.seed, pass.count)
        .count::<F>();
    let starts: Vec<u64> = (0..count).step_by(CHUNK as usize).collect();
    let of_chunk = |start: &u64| {
        let mut sums = empty.clone();
        let indices = *start..count.min(start + CHUNK);
        pass.observer.advance(indices.end - indices.start);
        for index in indices {
            let pixel = setting.pixel(scene, pass.seed, index);
            sums.add(
                &pixel,
                setting.leaking(epsilons, (pass.seed, index), &pixel),
            );
        }
        sums
    };
    let mut sums = empty.clone();
    // In their order: sums of floats depend on it.
    for part in engine::map(&starts, of_chunk) {
        sums.merge(&part);
    }
    sums.leaks
        .iter()
        .map(|leaks| leaks.share_of(sums.triangles))
        .collect()
}

impl Leaks {
    fn add(&mut self, area: f64) {
        self.area += area;
        self.squares += area * area;
        self.largest = self.largest.max(area);
    }

    fn merge(&mut self, other: &Leaks) {
        self.area += other.area;
        self.squares += other.squares;
        self.largest = self.largest.max(other.largest);
    }

    /// The share of holes, given the area of the triangles; none without a triangle. The area of leaks is that of a sample in
    /// which places near the edge have more rays, and where every ray leaks it may come out above that of the triangles.
    ///
    /// Leaks of unequal area count as so many of equal area as have the same variance, for the interval of Clopper and
    /// Pearson (Korn and Graubard 1998). Its upper end supposes one leak more (Fay and Feuer 1997): each halving of the
    /// distance from the edge has as many rays, so that the next leak may be [`UNSEEN`] times as far out as the farthest.
    fn share_of(&self, triangles: f64) -> Option<HoleShare> {
        if triangles <= 0.0 {
            return None;
        }
        let share = (self.area / triangles).min(1.0);
        if self.area == 0.0 {
            return Some(HoleShare {
                share,
                interval: None,
            });
        }
        let seen = self.interval(triangles, 0.0);
        let mut supposed = *self;
        supposed.add(UNSEEN * self.largest);
        let interval = Interval {
            low: seen.low,
            high: supposed.interval(triangles, 1.0).high,
        };
        Some(HoleShare {
            share,
            interval: Some(interval),
        })
    }

    /// The binomial interval of equal leaks, some less than were seen.
    fn interval(&self, triangles: f64, fewer: f64) -> Interval {
        let unit = self.squares / self.area;
        clopper_pearson(self.area / unit - fewer, triangles / unit, 0.025)
    }
}

impl RaySums {
    fn merge(&mut self, other: &RaySums) {
        self.triangles += other.triangles;
        for (leaks, more) in self.leaks.iter_mut().zip(&other.leaks) {
            leaks.merge(more);
        }
    }

    /// Adds a pixel: by epsilons, if its ray leaks; nothing if the kernel failed.
    fn add<F: Scalar>(&mut self, pixel: &Pixel<F>, leaking: Option<Vec<bool>>) {
        let Some(leaking) = leaking else { return };
        self.triangles += pixel.triangles;
        for (leaks, is_leaking) in self.leaks.iter_mut().zip(leaking) {
            if is_leaking {
                leaks.add(pixel.area);
            }
        }
    }
}

impl<F: Scalar> Setting<'_, F> {
    /// By epsilons, if the ray of a pixel leaks: it must hit one of its triangles, and neither these report it nor those
    /// around them. None if the kernel failed.
    fn leaking(
        &self,
        epsilons: &[Vec<F>],
        (seed, index): (u64, u64),
        pixel: &Pixel<F>,
    ) -> Option<Vec<bool>> {
        let none = vec![false; epsilons.len()];
        let own = self.margins_of_pixel(&pixel.cases)?;
        let mut truths = Vec::with_capacity(pixel.cases.len());
        oracle::truths(&pixel.cases, &mut truths, &mut Layers::default());
        let contract = &self.row.contract;
        let must_hit = |truth| obligation(truth, contract, false) == Obligation::MustHit;
        let is_lost = |epsilons: &Vec<F>| !own.iter().any(|margins| accepts(margins, epsilons));
        if !truths.iter().any(must_hit) || !epsilons.iter().any(is_lost) {
            return Some(none);
        }
        // Where the triangles around it are too many, or the kernel fails on them, nobody is accused.
        let around = self.around_pixel(pixel, seed, index);
        let Some(around) = around.and_then(|around| self.margins_of_pixel(&around)) else {
            return Some(none);
        };
        let is_moved = |epsilons: &Vec<F>| around.iter().any(|margins| accepts(margins, epsilons));
        Some(
            epsilons
                .iter()
                .map(|epsilons| is_lost(epsilons) && !is_moved(epsilons))
                .collect(),
        )
    }

    /// The margins of a pixel's triangles, relative if epsilons are; none if the kernel failed.
    fn margins_of_pixel(&self, cases: &[Case<F>]) -> Option<Vec<KnobMargins<F>>> {
        let (margins, _) = self.margins(cases);
        if margins.iter().any(is_unknown) {
            return None;
        }
        Some(if self.relative {
            self.relative_margins(cases, &margins)
        } else {
            margins
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::Tuned;
    use super::*;
    use crate::audit::Unobserved;
    use crate::case::Draw;
    use crate::epsilon::Knob;
    use crate::kernel::Role;
    use glam::DVec3;
    use std::slice;

    #[test]
    fn there_are_no_more_holes_than_pixels() {
        let share = |areas: &[f64], triangles: f64| {
            let mut leaks = Leaks::default();
            areas.iter().for_each(|area| leaks.add(*area));
            leaks.share_of(triangles)
        };
        let estimated = |areas: &[f64], triangles| share(areas, triangles).map(|it| it.share);
        assert_eq!(estimated(&[0.6, 0.5], 1.0), Some(1.0));
        assert_eq!(estimated(&[0.5], 2.0), Some(0.25));
        assert_eq!(estimated(&[], 0.0), None);
        assert_eq!(share(&[], 2.0).unwrap().interval, None);
        // Of equal areas the lower end is the binomial's; a leak of hardly any area adds hardly anything.
        let interval =
            |areas: &[f64], triangles| share(areas, triangles).unwrap().interval.unwrap();
        assert_eq!(
            interval(&[1.0; 3], 40.0).low,
            clopper_pearson(3.0, 40.0, 0.025).low
        );
        let [unequal, single] = [&[1.0, 1e-9][..], &[1.0]].map(|areas| interval(areas, 1e6));
        assert!(
            (unequal.low / single.low - 1.0).abs() < 1e-3,
            "{unequal:?} {single:?}"
        );
        assert!(
            (unequal.high / single.high - 1.0).abs() < 1e-3,
            "{unequal:?} {single:?}"
        );
        // With one of 8 more, a leak of 1 is as many as 9²/65 equal ones of 65/9.
        let by_hand = clopper_pearson(16.0 / 65.0, 1e6 / (65.0 / 9.0), 0.025).high;
        assert!(
            (single.high / by_hand - 1.0).abs() < 1e-12,
            "{single:?} {by_hand}"
        );
    }

    /// The share of holes among rays at uniform points of both triangles, parallel to their own. Those that are nearest
    /// to the shared edge count, for each of a triangle's three edges; and how many they are.
    fn by_pixels(tuned: &Tuned, epsilons: &[f32], count: u64) -> (f64, u64) {
        let setting = tuned.setting();
        let wide = |point: [f32; 3]| DVec3::from(point.map(f64::from));
        let (mut leaks, mut all, mut found) = (0.0, 0.0, 0);
        for index in 0..count {
            let Pixel { mut cases, .. } = setting.pixel(setting.scene.unwrap(), 7, index);
            let mut draw = Draw::new("uniform", 7, index);
            let own = cases[usize::from(draw.coin())];
            let [origin, d, a, b, c] = own.vectors().map(wide);
            let (u, v) = (draw.unit(), draw.unit());
            let [u, v] = if u + v > 1.0 {
                [1.0 - u, 1.0 - v]
            } else {
                [u, v]
            };
            let point = a + (b - a) * u + (c - a) * v;
            let area = (b - a).cross(c - a).dot(d).abs() / d.length();
            all += area;
            let other = cases.iter().find(|case| **case != own).unwrap().vectors();
            let is_shared = |p: DVec3| other[2..].iter().any(|q| wide(*q) == p);
            let weights = [1.0 - u - v, u, v];
            let opposite = [a, b, c].iter().position(|p| !is_shared(*p)).unwrap();
            let nearest = (0..3)
                .min_by(|i, j| weights[*i].total_cmp(&weights[*j]))
                .unwrap();
            if opposite != nearest {
                continue;
            }
            let way = point - origin;
            for case in &mut cases {
                case.ray.direction = (way / way.length()).to_array().map(|x| x as f32).into();
            }
            let (margins, _) = setting.margins(&cases);
            let mut truths = Vec::new();
            oracle::truths(&cases, &mut truths, &mut Layers::default());
            let contract = &setting.row.contract;
            let must_hit = |truth| obligation(truth, contract, false) == Obligation::MustHit;
            let is_hit = margins.iter().any(|margins| accepts(margins, epsilons));
            if truths.iter().any(must_hit) && !is_hit {
                found += 1;
                leaks += 3.0 * area;
            }
        }
        (leaks / all, found)
    }

    #[test]
    fn the_interval_covers_the_share_of_many_more_rays() {
        let tuned = Tuned::new(
            "moller-trumbore",
            "extent=1e5,edge=1..4,distance=10..100,direction=unit",
        );
        let at = |seed: u64, count: u64, epsilon: f32| {
            let epsilons = vec![epsilon; tuned.knobs.len()];
            holes(
                &tuned.setting(),
                &[epsilons],
                Pass::new(seed, count, &Unobserved),
            )[0]
            .unwrap()
        };
        for epsilon in [0.0, 0.01] {
            let truth = at(1, 1_000_000, epsilon).share;
            let few = (2..202).map(|seed| at(seed, 300, epsilon));
            let intervals: Vec<Interval> = few.filter_map(|holes| holes.interval).collect();
            let covers = |it: &&Interval| it.low <= truth && truth <= it.high;
            let covering = intervals.iter().filter(covers).count();
            println!("{epsilon}: {truth:e}, {covering} of {}", intervals.len());
            assert!(
                9 * intervals.len() <= 10 * covering,
                "{epsilon}: {covering} of {}",
                intervals.len()
            );
        }
    }

    #[test]
    fn holes_are_those_of_pixels_all_over_the_triangles() {
        // Far from the origin, so that pixels meet enough holes.
        let numbers = "extent=1e5,edge=1..4,distance=10..100,direction=unit";
        // A gate that refuses below 0.01 makes holes that are 0.02 of a height wide: about 6 %.
        for (kernel, at, fewest) in [
            ("moller-trumbore", 0.01, 5_000),
            ("half-space", 0.0, 200),
            ("moller-trumbore", 0.0, 0),
        ] {
            let tuned = Tuned::new(kernel, numbers);
            let gates = tuned.setting().row.entry.info.gates;
            let of_knob = |knob: &Knob| match knob.gate(gates).role {
                Role::Edge => at,
                _ => 0.0,
            };
            let epsilons: Vec<f32> = tuned.knobs.iter().map(of_knob).collect();
            let found = holes(
                &tuned.setting(),
                slice::from_ref(&epsilons),
                Pass::new(7, 60_000, &Unobserved),
            );
            let found = found[0].unwrap().share;
            let (share, pixels) = by_pixels(&tuned, &epsilons, 600_000);
            assert!(fewest <= pixels, "{kernel} {at}: {pixels} pixels");
            match fewest {
                // A handful of pixels shows no more.
                0 => assert!(
                    0.0 < found && found < 1e-5 && share < 1e-4,
                    "{found}, {share}"
                ),
                _ => assert!(
                    (found / share - 1.0).abs() < 0.2,
                    "{kernel} {at}: {found}, {share}"
                ),
            }
        }
    }
}
