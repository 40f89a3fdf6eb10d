//! All hits of a ray, their number, or whether there is one at all, as a program answered them.

use super::{Judged, Judgement};
use crate::passage::Passage;
use crate::ray::{InvalidRay, Ray};
use crate::scene::{Hit, Nearest, Scene};
use hairline_core::Float;
use std::collections::BTreeSet;

/// One of the hits that a program named.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NamedHit {
    /// The face, by number.
    pub face: u32,
    /// Its t, if the program gives one.
    pub t: Option<f64>,
}

/// The place of a named hit among the passages of a ray.
enum Place {
    /// The ray meets the face, in this passage.
    Met(usize),
    /// The ray meets the face, in this passage, and the face is named where the ray starts.
    AtStart(usize),
    /// The ray misses the face by a hair, near this passage.
    ByAHair(usize),
    /// The ray misses the face by a hair, near no passage.
    Alone(Judgement),
}

/// The hits that a program named in one passage.
#[derive(Clone, Default)]
struct NamedThere {
    met: usize,
    by_a_hair: usize,
}

impl<F: Float> Scene<F> {
    /// Judges all hits that a program named, in its order. Every point has to be named once at least, by one of the faces that are
    /// met there; which of them, and how many, is a program's own way. An error if the ray means nothing.
    pub fn judge_hits(&self, ray: &Ray<F>, named: &[NamedHit]) -> Result<Judged, InvalidRay> {
        let judged = self.judge_hits_strictly(ray, named)?;
        self.or_neighbour(ray, judged, |beside| {
            Ok(self.judge_hits_strictly(beside, named)?.judgement)
        })
    }

    fn judge_hits_strictly(&self, ray: &Ray<F>, named: &[NamedHit]) -> Result<Judged, InvalidRay> {
        let passages = self.passages(ray)?;
        let hits = self.hits(ray)?;
        let mut there = vec![NamedThere::default(); passages.len()];
        let mut kinds = BTreeSet::new();
        let mut last = 0;
        let mut faces = Vec::new();
        for hit in named {
            let exact = hits.iter().find(|it| it.faces.contains(&hit.face));
            let place = self.place_of_hit(ray, &passages, exact, hit);
            // A face that is named at its exact t too is not named twice there.
            if !matches!(place, Place::AtStart(_)) {
                faces.push(hit.face);
            }
            let passage = match place {
                Place::Met(i) => {
                    there[i].met += 1;
                    Some(i)
                }
                Place::AtStart(i) => {
                    kinds.insert(Judgement::SelfHit);
                    there[i].met += 1;
                    None
                }
                Place::ByAHair(i) => {
                    kinds.insert(Judgement::Neighbour);
                    there[i].by_a_hair += 1;
                    Some(i)
                }
                Place::Alone(judgement) => {
                    kinds.insert(judgement);
                    None
                }
            };
            let Some(passage) = passage else {
                continue;
            };
            if passage < last {
                // No program tells two points in order that are nearer to each other than anybody sees.
                let gap = passages[last].from.lower - passages[passage].to.upper;
                kinds.insert(match self.hair(ray, hit.face) < gap {
                    true => Judgement::WrongOrder,
                    false => Judgement::Neighbour,
                });
            }
            last = passage.max(last);
            if exact.is_some_and(|exact| self.is_off(ray, exact, hit)) {
                kinds.insert(Judgement::WrongT);
            }
        }
        let different: BTreeSet<u32> = faces.iter().copied().collect();
        if different.len() < faces.len() {
            kinds.insert(Judgement::Twice);
        }
        let met: BTreeSet<u32> = hits.iter().flat_map(|hit| hit.faces.clone()).collect();
        let mut lost = None;
        for (passage, there) in passages.iter().zip(&there) {
            let on_interval = passage
                .faces
                .iter()
                .filter(|face| met.contains(face))
                .count();
            let judgement = judgement_of(passage, there, on_interval);
            kinds.insert(judgement);
            if lost.is_none() && judgement == Judgement::Lost {
                lost = Some(nearest_of(passage));
            }
        }
        // The worst; of nothing, rightly, nothing.
        let worst = kinds.first().copied().unwrap_or(Judgement::Right);
        let hit = lost.or_else(|| passages.first().map(nearest_of));
        Ok(Judged::new(worst, hit, None))
    }

    /// The place of a named hit among the passages; `exact` is the exact hit of its face, if the ray meets that.
    fn place_of_hit(
        &self,
        ray: &Ray<F>,
        passages: &[Passage],
        exact: Option<&Hit>,
        hit: &NamedHit,
    ) -> Place {
        // A passage may reach beyond the ray's interval, and have faces there.
        let place = passages.iter().position(|it| it.faces.contains(&hit.face));
        if let Some((place, exact)) = place.zip(exact) {
            return match self.is_self_hit(ray, hit.face, hit.t, exact.from.lower) {
                true => Place::AtStart(place),
                false => Place::Met(place),
            };
        }
        let Some(t) = self.missed_by_a_hair(ray, hit.face, hit.t, f64::INFINITY) else {
            return Place::Alone(Judgement::Ghost);
        };
        let hair = self.hair(ray, hit.face);
        let is_near =
            |passage: &Passage| (passage.from.lower - hair..=passage.to.upper + hair).contains(&t);
        match passages.iter().position(is_near) {
            Some(near) => Place::ByAHair(near),
            None => Place::Alone(self.of_hit_before(ray, hit.face, t)),
        }
    }

    /// True if the t of a named hit is off by more than anybody sees.
    fn is_off(&self, ray: &Ray<F>, exact: &Hit, hit: &NamedHit) -> bool {
        let hair = self.hair(ray, hit.face);
        let range = exact.from.lower - hair..=exact.to.upper + hair;
        hit.t.is_some_and(|t| !range.contains(&t))
    }

    /// Judges whether a program found any hit. An error if the ray means nothing.
    pub fn judge_any(&self, ray: &Ray<F>, is_hit: bool) -> Result<Judged, InvalidRay> {
        let Some(nearest) = self.nearest(ray)? else {
            let judgement = match is_hit {
                false => Judgement::Right,
                true if self.passes_by_a_hair(ray) => Judgement::Neighbour,
                true => Judgement::Ghost,
            };
            return Ok(Judged::new(judgement, None, None));
        };
        let judgement = match is_hit {
            true => Judgement::Right,
            false if self.passages(ray)?.iter().all(|it| it.is_silhouette) => Judgement::Neighbour,
            false => Judgement::Lost,
        };
        let judged = Judged::new(judgement, Some(nearest), None);
        self.or_neighbour(ray, judged, |beside| {
            Ok(match self.nearest(beside)? {
                None => Judgement::Right,
                Some(_) => Judgement::Lost,
            })
        })
    }

    /// Judges the number of hits that a program counted. Each point at which the ray meets the surface counts at least once, and at
    /// most once for each of the faces there. Silhouettes may be left out. An error if the ray means nothing.
    pub fn judge_count(&self, ray: &Ray<F>, count: u64) -> Result<Judged, InvalidRay> {
        let judged = Judged::new(self.of_count(ray, count)?, self.nearest(ray)?, None);
        self.or_neighbour(ray, judged, |beside| self.of_count(beside, count))
    }

    fn of_count(&self, ray: &Ray<F>, count: u64) -> Result<Judgement, InvalidRay> {
        let passages = self.passages(ray)?;
        let points = passages.len() as u64;
        let seen = passages.iter().filter(|it| !it.is_silhouette).count() as u64;
        let hits = self.hits(ray)?;
        let faces: u64 = hits.iter().map(|hit| hit.faces.len() as u64).sum();
        Ok(match count {
            _ if count == points => Judgement::Right,
            _ if faces < count => Judgement::TooMany,
            _ if points < count => Judgement::Tie,
            _ if seen <= count => Judgement::Neighbour,
            _ => Judgement::TooFew,
        })
    }
}

/// The faces of a passage as those of a hit.
fn nearest_of(passage: &Passage) -> Nearest {
    Nearest {
        t: passage.from,
        faces: passage.faces.clone(),
    }
}

/// The judgement of what was named in a passage, so many of whose faces the ray meets on its interval.
fn judgement_of(passage: &Passage, there: &NamedThere, on_interval: usize) -> Judgement {
    let named = there.met + there.by_a_hair;
    match named {
        0 if passage.is_silhouette => Judgement::Neighbour,
        0 => Judgement::Lost,
        // Where the ray meets one face only, its neighbour is a hit too many.
        _ if 1 < named && 0 < there.by_a_hair && !passage.is_silhouette => Judgement::Twice,
        _ if there.met < on_interval => Judgement::Tie,
        _ => Judgement::Right,
    }
}
