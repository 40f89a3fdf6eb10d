//! Turns with a kernel: how many threads ask it at the same time, each in a process of its own.

#![forbid(unsafe_code)]

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The turns of a kernel. There is one at first; another is added whenever its processes have worked for much longer than
/// one takes to start.
pub(super) struct Turns {
    /// The number of processes that the kernel wants at most.
    most: u32,
    /// How much work is worth the start of a process.
    worth: Duration,
    state: Mutex<TurnsState>,
    ended: Condvar,
}

/// All threads may wait at the end of a family for one whose process starts.
const WORK_A_START: u32 = 4;

#[derive(Default)]
struct TurnsState {
    taken: u32,
    /// How long processes took to answer, all together.
    worked: Duration,
}

/// A turn; dropping it ends it.
pub(super) struct Turn<'a>(&'a Turns);

impl Turns {
    /// Those of a kernel that wants so many processes at most, each of which takes so long to start.
    pub fn new(most: u32, start: Duration) -> Turns {
        let worth = WORK_A_START * start.max(Duration::from_millis(1));
        Turns {
            most,
            worth,
            state: Mutex::default(),
            ended: Condvar::new(),
        }
    }

    /// Waits for a turn.
    pub fn take(&self) -> Turn<'_> {
        let is_over = |state: &mut TurnsState| self.number(state) <= state.taken;
        let free = self.ended.wait_while(self.state(), is_over);
        free.unwrap_or_else(PoisonError::into_inner).taken += 1;
        Turn(self)
    }

    /// Adds how long a process took to answer.
    pub fn add_work(&self, time: Duration) {
        self.state().worked += time;
    }

    /// The number of turns that there are.
    fn number(&self, state: &TurnsState) -> u32 {
        let more = state.worked.as_nanos() / self.worth.as_nanos();
        u32::try_from(more)
            .unwrap_or(u32::MAX)
            .saturating_add(1)
            .min(self.most)
    }

    fn state(&self) -> MutexGuard<'_, TurnsState> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Turn<'_> {
    fn drop(&mut self) {
        self.0.state().taken -= 1;
        self.0.ended.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU32, Ordering};
    use std::thread;

    /// The largest number of turns at the same time, of eight threads that take five each.
    fn most_at_once(most: u32, start: Duration) -> u32 {
        let turns = Turns::new(most, start);
        let (now, largest) = (AtomicU32::new(0), AtomicU32::new(0));
        let five_turns = || {
            for _ in 0..5 {
                let _turn = turns.take();
                largest.fetch_max(now.fetch_add(1, Ordering::SeqCst) + 1, Ordering::SeqCst);
                thread::sleep(Duration::from_millis(4));
                turns.add_work(Duration::from_millis(4));
                now.fetch_sub(1, Ordering::SeqCst);
            }
        };
        thread::scope(|scope| (0..8).for_each(|_| drop(scope.spawn(five_turns))));
        largest.into_inner()
    }

    #[test]
    fn there_are_more_turns_as_work_outweighs_a_start_and_never_more_than_wanted() {
        assert_eq!(most_at_once(u32::MAX, Duration::from_secs(60)), 1);
        assert_eq!(most_at_once(2, Duration::ZERO), 2);
        assert!(2 < most_at_once(u32::MAX, Duration::ZERO));
    }
}
