//! Turns with a kernel: how many threads ask it at the same time, each in a process of its own.

#![forbid(unsafe_code)]

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The turns of a kernel. There is one at first. Another is added whenever its processes have worked for as long as one
/// takes to start, so that starting them never costs more than it may save.
pub(super) struct Turns {
    /// The number of processes that the kernel wants at most.
    most: u32,
    /// How long a process takes to start.
    start: Duration,
    state: Mutex<TurnsState>,
    ended: Condvar,
}

#[derive(Default)]
struct TurnsState {
    taken: u32,
    /// How long turns took, all together.
    worked: Duration,
}

/// A turn; dropping it ends it.
pub(super) struct Turn<'a> {
    turns: &'a Turns,
    since: Instant,
}

impl Turns {
    pub fn new(most: u32, start: Duration) -> Turns {
        let start = start.max(Duration::from_millis(1));
        Turns { most, start, state: Mutex::default(), ended: Condvar::new() }
    }

    /// Waits for a turn.
    pub fn take(&self) -> Turn<'_> {
        let mut state = self.state();
        while self.number(&state) <= state.taken {
            let woken = self.ended.wait_timeout(state, self.start);
            let (after, wait) = woken.unwrap_or_else(PoisonError::into_inner);
            state = after;
            if wait.timed_out() {
                // A kernel that hangs has worked meanwhile.
                state.worked += self.start;
            }
        }
        state.taken += 1;
        Turn { turns: self, since: Instant::now() }
    }

    /// The number of turns that there are.
    fn number(&self, state: &TurnsState) -> u32 {
        let more = state.worked.as_nanos() / self.start.as_nanos();
        u32::try_from(more).unwrap_or(u32::MAX).saturating_add(1).min(self.most)
    }

    fn state(&self) -> MutexGuard<'_, TurnsState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        let mut state = self.turns.state();
        state.taken -= 1;
        state.worked += self.since.elapsed();
        self.turns.ended.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU32, Ordering};
    use std::thread;

    /// The largest number of turns at the same time, of eight threads that take three each.
    fn most_at_once(turns: &Turns, each: Duration) -> u32 {
        let (now, most) = (AtomicU32::new(0), AtomicU32::new(0));
        let three_turns = || {
            for _ in 0..3 {
                let _turn = turns.take();
                most.fetch_max(now.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
                thread::sleep(each);
                now.fetch_sub(1, Ordering::SeqCst);
            }
        };
        thread::scope(|scope| (0..8).for_each(|_| drop(scope.spawn(three_turns))));
        most.into_inner()
    }

    #[test]
    fn there_are_more_turns_as_work_outweighs_a_start_and_never_more_than_wanted() {
        let each = Duration::from_millis(4);
        let slow_start = Duration::from_secs(60);
        assert_eq!(most_at_once(&Turns::new(u32::MAX, slow_start), each), 1);
        assert_eq!(most_at_once(&Turns::new(2, Duration::ZERO), each), 2);
        assert!(2 < most_at_once(&Turns::new(u32::MAX, Duration::ZERO), each));
    }

    #[test]
    fn nobody_waits_for_a_turn_that_does_not_end() {
        let turns = Turns::new(u32::MAX, Duration::from_millis(5));
        let _hangs = turns.take();
        let _other = turns.take();
        assert_eq!(turns.state().taken, 2);
    }
}
