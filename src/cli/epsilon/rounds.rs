//! Rounds of many kernels: those that surely cost more than the ones on the screen get no more rays.

use super::{EpsilonRun, PASSES, Tuned};
use crate::advised::Advised;
use crate::arith::ScalarName;
use crate::cli::exit::Failure;
use crate::epsilon::{Contender, Pass, SharedCases, surely_dearer};
use crate::record::group_digits;

/// Passes of a round: the grid, its cheapest point, and that point on fresh rays.
const PASSES_OF_ROUND: u64 = 3;

/// Many kernels are first tried on a sixteenth of the rays, and on a fourth. One that surely costs more than those on the
/// screen gets no more.
const ROUNDS: [u64; 2] = [16, 4];

/// The most rays of each kind that are tried on each other kind of plane, where there are many kernels: no row of the table shows
/// them.
const MOST_ELSEWHERE: u64 = 5_000;

/// A kernel in a scalar, and how many rays of each kind it gets.
pub(super) struct PlannedStudy<'a> {
    /// Its place in the record.
    pub(super) place: usize,
    pub(super) tuned: &'a Tuned<'a>,
    pub(super) scalar: ScalarName,
    pub(super) rays: u64,
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
        for study in planned {
            let passes = PASSES * study.rays + others * self.rays_elsewhere(study);
            self.progress.expect_more(passes * self.kinds);
        }
    }

    /// How many rays of each kind are tried on each other kind of plane.
    pub(super) fn rays_elsewhere(&self, study: &PlannedStudy<'_>) -> u64 {
        if self.has_rounds {
            study.rays.min(MOST_ELSEWHERE)
        } else {
            study.rays
        }
    }
}
