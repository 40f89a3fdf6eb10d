//! The pace of a run, as far as it is steady enough to say when the run ends.

#![forbid(unsafe_code)]

use std::time::Duration;

/// How far a run was at some time since its start.
#[derive(Clone, Copy, Debug)]
struct Mark {
    done: u64,
    at: Duration,
}

/// A mark is kept whenever this many times as much is done as at the last one: 5/4.
const GROWTH: [u64; 2] = [5, 4];

/// So many marks lie between half of what is done and all of it: 1.25³ is almost 2.
const OF_A_HALF: usize = 3;

/// Two halves whose paces differ by more than this factor say nothing of the rest.
const STEADY: f64 = 1.5;

/// Nothing is said sooner: a busy machine's first moments are no sample.
const FIRST: Duration = Duration::from_secs(1);

/// How fast a run goes. Its clock begins with the first work that is done, so that the time before does not count.
#[derive(Debug, Default)]
pub struct Pace {
    marks: Vec<Mark>,
}

impl Pace {
    /// Notes how much is done at a time since the run's start.
    pub fn note(&mut self, done: u64, at: Duration) {
        let [more, than] = GROWTH;
        let is_next = self
            .marks
            .last()
            .is_none_or(|last| last.done.saturating_mul(more) <= done.saturating_mul(than));
        if 0 < done && is_next {
            self.marks.push(Mark { done, at });
        }
    }

    /// How much is done a second; none unless the work since half of it was done went about as fast as the work before.
    pub fn per_second(&self) -> Option<f64> {
        let count = self.marks.len();
        let first = self.marks.first()?;
        let now = self.marks.last()?;
        let half = self.marks.get(count.checked_sub(1 + OF_A_HALF)?)?;
        let quarter = self.marks.get(count.checked_sub(1 + 2 * OF_A_HALF)?)?;
        if now.at.saturating_sub(first.at) < FIRST {
            return None;
        }
        let later = between(half, now)?;
        let earlier = between(quarter, half)?;
        let is_steady = later < STEADY * earlier && earlier < STEADY * later;
        is_steady.then_some(later)
    }
}

/// How much was done a second between two marks.
fn between(from: &Mark, to: &Mark) -> Option<f64> {
    let seconds = to.at.saturating_sub(from.at).as_secs_f64();
    let done = (to.done - from.done) as f64;
    (0.0 < seconds).then(|| done / seconds)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pace of a run after some seconds, told each tenth of one how much is done by then.
    fn after(seconds: f64, done: impl Fn(f64) -> f64) -> Option<f64> {
        let mut pace = Pace::default();
        let mut at = 0.0;
        while at <= seconds {
            pace.note(done(at) as u64, Duration::from_secs_f64(at));
            at += 0.1;
        }
        pace.per_second()
    }

    #[test]
    fn an_even_run_has_a_pace_after_a_second_of_work() {
        let even = |at: f64| 1000.0 * at;
        assert_eq!(after(0.9, even), None);
        for seconds in [1.5, 3.0, 20.0] {
            let pace = after(seconds, even).unwrap();
            assert!((pace - 1000.0).abs() < 1.0, "{pace}");
        }
        // The time before the first work does not count.
        let late = |at: f64| 1000.0 * (at - 5.0).max(0.0);
        assert_eq!(after(5.9, late), None);
        let pace = after(8.0, late).unwrap();
        assert!((pace - 1000.0).abs() < 1.0, "{pace}");
    }

    #[test]
    fn a_run_that_changes_its_pace_has_none_until_it_is_steady() {
        // Twenty times as fast after three seconds, as on a machine that was busy at first.
        let freed = |at: f64| 100.0 * at + 1900.0 * (at - 3.0).max(0.0);
        assert_eq!(after(3.5, freed), None);
        let pace = after(20.0, freed).unwrap();
        assert!((pace - 2000.0).abs() < 200.0, "{pace}");
        // Ever slower.
        assert_eq!(after(20.0, |at| 1000.0 * at.powf(0.3)), None);
        // Nothing is done.
        assert_eq!(after(20.0, |_| 0.0), None);
        assert_eq!(after(20.0, |_| 7.0), None);
    }
}
