//! Rounds of many kernels: those that surely cost more than the ones on the screen get no more rays.

use super::{EpsilonRun, PASSES, Tuned};
use crate::advised::Advised;
use crate::arith::ScalarName;
use crate::audit::CHUNK;
use crate::cli::exit::Failure;
use crate::epsilon::{Contender, Pass, SharedCases, surely_dearer};
use crate::record::group_digits;

/// Passes of a round: the grid, its cheapest point, and that point on fresh rays.
const PASSES_OF_ROUND: u64 = 3;

/// Many kernels are first tried on a sixteenth of the rays, and on a fourth. One that surely costs more than those on the
/// screen gets no more.
const ROUNDS: [u64; 2] = [16, 4];

/// The most rays of each kind that are tried on each other kind of plane, where there are many kernels: no row of the table shows
/// them. Kernels that are not on the screen have one chunk of them, which is made for all.
const MOST_ELSEWHERE: u64 = 5_000;
const MOST_BELOW_THE_SCREEN: u64 = CHUNK;

/// Where there are many kernels, numbers that follow each triangle's size are weighed on a fourth of the rays. No row
/// stands where it does because of them, and those that halve the cost show with fewer.
const SHARE_OF_FORMS: u64 = 4;

/// The passes of [`PASSES`] that are about such numbers.
const PASSES_OF_FORMS: u64 = 5;

/// A study in a scalar, and how many rays of each kind it gets.
pub(super) struct PlannedStudy<'a> {
    /// The kernel that is studied.
    pub(super) tuned: &'a Tuned<'a>,
    /// The kernels that it is a study of, each with its place in the record: the same test may have several names.
    pub(super) kernels: Vec<(usize, &'a Tuned<'a>)>,
    pub(super) scalar: ScalarName,
    pub(super) rays: u64,
}

impl<'a> PlannedStudy<'a> {
    /// Plans the study of a kernel with its place in the record, unless a study of the same test is planned: then the
    /// kernel has its results.
    pub(super) fn plan(
        planned: &mut Vec<PlannedStudy<'a>>,
        (place, tuned): (usize, &'a Tuned<'a>),
        scalar: ScalarName,
        rays: u64,
    ) {
        let mut known = planned.iter_mut();
        match known.find(|it| it.scalar == scalar && it.tuned.is_studied_with(tuned)) {
            Some(study) => study.kernels.push((place, tuned)),
            None => planned.push(PlannedStudy {
                tuned,
                kernels: vec![(place, tuned)],
                scalar,
                rays,
            }),
        }
    }
}

impl EpsilonRun<'_> {
    /// Lets the progress know how much the rounds are.
    pub(super) fn expect_rounds(&self, planned: &[PlannedStudy<'_>]) {
        if !self.has_rounds {
            return;
        }
        let in_rounds: u64 = ROUNDS.iter().map(|share| self.pass.count / share).sum();
        let of_each = PASSES_OF_ROUND * self.kinds * in_rounds;
        self.progress.expect_more(planned.len() as u64 * of_each);
    }

    /// Takes rays from kernels that are surely not among the first of their scalar.
    pub(super) fn hold_rounds<F: Advised>(
        &self,
        planned: &mut [PlannedStudy<'_>],
        shared: Option<&SharedCases<F>>,
    ) -> Result<(), Failure> {
        let count = self.pass.count;
        let mut standing: Vec<&mut PlannedStudy<'_>> = planned.iter_mut().collect();
        for share in ROUNDS {
            self.hold_round(&mut standing, count / share, shared)?;
            standing.retain(|study| study.rays == count);
        }
        Ok(())
    }

    /// One round on so many rays of each kind: those that are out get no more.
    fn hold_round<F: Advised>(
        &self,
        standing: &mut [&mut PlannedStudy<'_>],
        rays: u64,
        shared: Option<&SharedCases<F>>,
    ) -> Result<(), Failure> {
        if standing.len() <= self.places {
            return Ok(());
        }
        let mut contenders = Vec::with_capacity(standing.len());
        for study in standing.iter() {
            contenders.push(self.contender(study.tuned, rays, shared)?);
        }
        let out = surely_dearer(&contenders, self.places);
        for (study, is_out) in standing.iter_mut().zip(out) {
            if is_out {
                study.rays = rays;
            }
        }
        self.tell_cheapest(standing, &contenders, rays);
        Ok(())
    }

    /// Says which kernels are the cheapest so far.
    fn tell_cheapest(
        &self,
        standing: &[&mut PlannedStudy<'_>],
        contenders: &[Contender],
        rays: u64,
    ) {
        let mut ranked: Vec<(&str, f64)> = Vec::new();
        for (study, contender) in standing.iter().zip(contenders) {
            ranked.push((study.tuned.row.entry.info.name, contender.fresh.cost));
        }
        ranked.sort_by(|one, other| one.1.total_cmp(&other.1));
        let names: Vec<&str> = ranked.iter().take(3).map(|(name, _)| *name).collect();
        let Some(study) = standing.first() else {
            return;
        };
        self.progress.say(&format!(
            "{}, after {} rays of each kind the cheapest are {}",
            study.scalar,
            group_digits(rays),
            names.join(", ")
        ));
    }

    /// The costs of a kernel on so many rays of each kind.
    fn contender<F: Advised>(
        &self,
        tuned: &Tuned<'_>,
        rays: u64,
        shared: Option<&SharedCases<F>>,
    ) -> Result<Contender, Failure> {
        let judged = self.judged(tuned)?;
        let setting = self.setting(tuned, &judged, shared)?;
        let pass = Pass {
            count: rays,
            ..self.pass
        };
        Ok(F::contender(&setting, self.costs, pass))
    }

    /// Lets the progress know how much the studies are.
    pub(super) fn expect_studies(&self, planned: &[PlannedStudy<'_>]) {
        let others = self.studied.others.len() as u64;
        for (place, study) in planned.iter().enumerate() {
            let of_forms = PASSES_OF_FORMS * self.rays_of_form(study);
            let of_fixed = (PASSES - PASSES_OF_FORMS) * study.rays;
            // Which ones are on the screen shows later.
            let elsewhere = others * self.rays_elsewhere(study, place < self.places);
            self.progress
                .expect_more((of_fixed + of_forms + elsewhere) * self.kinds);
        }
    }

    /// On how many rays of each kind numbers are weighed that follow each triangle's size.
    pub(super) fn rays_of_form(&self, study: &PlannedStudy<'_>) -> u64 {
        if self.has_rounds {
            study.rays.min(self.pass.count / SHARE_OF_FORMS)
        } else {
            study.rays
        }
    }

    /// How many rays of each kind are tried on each other kind of plane.
    pub(super) fn rays_elsewhere(&self, study: &PlannedStudy<'_>, is_wanted: bool) -> u64 {
        let most = match (self.has_rounds, is_wanted) {
            (false, _) => u64::MAX,
            (true, true) => MOST_ELSEWHERE,
            (true, false) => MOST_BELOW_THE_SCREEN,
        };
        study.rays.min(most)
    }

    /// For each of some costs, true if its row is on the screen. Equal costs count once, since the table puts them in one
    /// row.
    pub(super) fn on_screen(&self, costs: &[f64]) -> Vec<bool> {
        let mut different = costs.to_vec();
        different.sort_by(f64::total_cmp);
        different.dedup();
        let shown = &different[..different.len().min(self.places)];
        costs.iter().map(|cost| shown.contains(cost)).collect()
    }
}
