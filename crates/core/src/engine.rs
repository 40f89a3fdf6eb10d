//! Floor 0: the run engine. Indices go in chunks to all threads, and everything found becomes one sum.

#![forbid(unsafe_code)]

#[cfg(feature = "rayon")]
use rayon::prelude::*;
use std::iter;
#[cfg(not(feature = "rayon"))]
use std::num::NonZero;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
#[cfg(any(test, not(feature = "rayon")))]
use std::{panic, thread};

/// Follows the progress of a run, and has the clock that the run reads.
pub trait Observer: Sync {
    /// This many more indices are done.
    fn advance(&self, indices: u64);
    /// Nanoseconds since some moment.
    fn now(&self) -> u64;
}

/// Watches nothing and times nothing.
pub struct Unobserved;

impl Observer for Unobserved {
    fn advance(&self, _: u64) {}

    fn now(&self) -> u64 {
        0
    }
}

/// A sum that comes out the same however it is split: merging is associative and commutative, and an
/// empty sum changes nothing.
pub trait Merge: Send {
    /// Adds another part.
    fn merge(&mut self, other: Self);
}

/// The sum over a range of indices. Every thread has one sum of its own and takes the next chunk when
/// it is done with the last, so memory grows neither with the range nor with the chunks.
pub fn sum<S: Merge>(
    indices: Range<u64>,
    chunk: u64,
    observer: &dyn Observer,
    empty: impl Fn() -> S + Sync,
    add: impl Fn(&mut S, Range<u64>) + Sync,
) -> S {
    let sums = Mutex::new(Vec::new());
    on_threads(indices, chunk, observer, &|chunks| {
        let mut sum = empty();
        chunks.for_each(|indices| add(&mut sum, indices));
        locked(&sums).push(sum);
    });
    let merged = |mut sum: S, more: S| {
        sum.merge(more);
        sum
    };
    let sums = sums.into_inner().unwrap_or_else(PoisonError::into_inner);
    sums.into_iter().reduce(merged).unwrap_or_else(&empty)
}

/// Many items are taken several at a time.
const MOST_CHUNKS: u64 = 4096;

/// The results of a function for all items, in their order.
pub fn map<T: Sync, U: Send>(items: &[T], become_of: impl Fn(&T) -> U + Sync) -> Vec<U> {
    let results: Vec<Mutex<Option<U>>> = items.iter().map(|_| Mutex::new(None)).collect();
    let count = items.len() as u64;
    on_threads(
        0..count,
        (count / MOST_CHUNKS).max(1),
        &Unobserved,
        &|chunks| {
            for index in chunks.flatten() {
                let index = index as usize;
                *locked(&results[index]) = Some(become_of(&items[index]));
            }
        },
    );
    let result = |of_item: Mutex<Option<U>>| of_item.into_inner().ok().flatten();
    results
        .into_iter()
        .map(|of_item| result(of_item).expect("every item has its turn"))
        .collect()
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// How many threads there are.
pub fn threads() -> usize {
    #[cfg(feature = "rayon")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "rayon"))]
    thread::available_parallelism().map_or(1, NonZero::get)
}

/// The work of one thread: all chunks that come to it.
type OfThread<'a> = &'a (dyn Fn(&mut dyn Iterator<Item = Range<u64>>) + Sync);

/// Runs on all threads, one of which is this one, as some machines have no other. It is no generic function, so what
/// threads need is compiled once, and not for every sum.
fn on_threads(indices: Range<u64>, chunk: u64, observer: &dyn Observer, run: OfThread<'_>) {
    let Range { start, end } = indices;
    let chunks = end.saturating_sub(start).div_ceil(chunk);
    let next = AtomicU64::new(0);
    let of_thread = || {
        let mut taken = 0;
        run(&mut iter::from_fn(|| {
            // That of the last one, which is done.
            observer.advance(taken);
            let number = next.fetch_add(1, Ordering::Relaxed);
            let first = (number < chunks).then(|| start + number * chunk)?;
            let indices = first..end.min(first.saturating_add(chunk));
            taken = indices.end - indices.start;
            Some(indices)
        }));
    };
    let threads = usize::try_from(chunks).unwrap_or(usize::MAX).min(threads());
    if threads == 1 {
        return of_thread();
    }
    #[cfg(feature = "rayon")]
    (0..threads)
        .into_par_iter()
        .with_max_len(1)
        .for_each(|_| of_thread());
    #[cfg(not(feature = "rayon"))]
    on_new_threads(threads, &of_thread);
}

/// Without a pool: rayon takes longer to build than an audit in a test takes to run.
#[cfg(any(test, not(feature = "rayon")))]
fn on_new_threads(threads: usize, run: &(dyn Fn() + Sync)) {
    thread::scope(|scope| {
        let threads: Vec<_> = (0..threads).map(|_| scope.spawn(run)).collect();
        let ended = threads.into_iter().map(|thread| thread.join());
        ended.for_each(|end| end.unwrap_or_else(|cause| panic::resume_unwind(cause)));
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[derive(Default)]
    struct Seen(BTreeSet<u64>, u64);

    impl Merge for Seen {
        fn merge(&mut self, other: Seen) {
            self.0.extend(other.0);
            self.1 += other.1;
        }
    }

    struct Counter(AtomicU64);

    impl Observer for Counter {
        fn advance(&self, indices: u64) {
            self.0.fetch_add(indices, Ordering::Relaxed);
        }

        fn now(&self) -> u64 {
            0
        }
    }

    #[test]
    fn every_index_goes_through_once_on_any_number_of_threads() {
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            for range in [0..0, 7..8, 3..1027, 0..10_000, u64::MAX - 70..u64::MAX] {
                let counter = Counter(AtomicU64::new(0));
                let add = |seen: &mut Seen, indices: Range<u64>| {
                    assert!(indices.end - indices.start <= 64);
                    seen.1 += indices.end - indices.start;
                    seen.0.extend(indices);
                };
                let seen = pool.install(|| sum(range.clone(), 64, &counter, Seen::default, add));
                assert!(seen.0.iter().copied().eq(range.clone()), "{range:?}");
                assert_eq!(seen.1, range.end - range.start);
                assert_eq!(counter.0.into_inner(), range.end - range.start);
            }
        }
    }

    #[test]
    fn every_item_becomes_one_in_their_order() {
        let squares = map(&(0..10_000).collect::<Vec<u64>>(), |n| n * n);
        assert!(squares.into_iter().eq((0..10_000).map(|n| n * n)));
        assert!(map(&[], |item: &u64| *item).is_empty());
    }

    #[test]
    fn new_threads_return_once_each_and_hand_a_panic_on() {
        let next = AtomicU64::new(0);
        on_new_threads(5, &|| {
            next.fetch_add(1, Ordering::Relaxed);
        });
        assert_eq!(next.into_inner(), 5);
        assert!(panic::catch_unwind(|| on_new_threads(2, &|| panic!("on purpose"))).is_err());
    }
}
