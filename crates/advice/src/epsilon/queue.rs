//! The sources of a pass one after the other, in chunks: threads wait for each other once a pass, and not at the end of each
//! kind of rays.

use super::rays::Rays;
use crate::audit::Source;
use std::ops::Range;

/// The sources of a pass.
#[derive(Default)]
pub(super) struct Queue(Vec<QueuedSource>);

/// A source of a pass, whose chunks come after those of others.
pub(super) struct QueuedSource {
    pub rays: Rays,
    /// The place of its kind of rays.
    pub group: usize,
    /// Its place among the sources of its kind.
    pub place: usize,
    pub source: Source,
    count: u64,
    first_chunk: u64,
    chunks: u64,
}

impl Queue {
    /// Adds so many indices of a source, which has a place among the kinds of rays and one in its kind.
    pub fn add(&mut self, rays: Rays, [group, place]: [usize; 2], source: Source, count: u64) {
        self.0.push(QueuedSource {
            rays,
            group,
            place,
            chunks: count.div_ceil(source.chunk()),
            source,
            count,
            first_chunk: self.chunks(),
        });
    }

    /// How many chunks there are.
    pub fn chunks(&self) -> u64 {
        self.0
            .last()
            .map_or(0, |last| last.first_chunk + last.chunks)
    }

    /// The source and the indices of a chunk.
    pub fn at(&self, chunk: u64) -> (&QueuedSource, Range<u64>) {
        let end = self.0.partition_point(|queued| queued.first_chunk <= chunk);
        let queued = &self.0[end - 1];
        let length = queued.source.chunk();
        let start = (chunk - queued.first_chunk) * length;
        let end = queued.count.min(start.saturating_add(length));
        (queued, start..end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::audit::{CHUNK, CorpusSet};

    #[test]
    fn every_index_is_in_one_chunk() {
        let counts = [0, 1, CHUNK, 0, 0, 2 * CHUNK + 5, 0];
        let mut queue = Queue::default();
        for (place, count) in counts.into_iter().enumerate() {
            let source = Source::stored(CorpusSet::default(), None);
            queue.add(Rays::Stored, [7, place], source, count);
        }
        let mut all = Vec::new();
        for chunk in 0..queue.chunks() {
            let (queued, indices) = queue.at(chunk);
            assert_eq!(queued.group, 7);
            all.push((queued.place, indices));
        }
        let long = [0..CHUNK, CHUNK..2 * CHUNK, 2 * CHUNK..2 * CHUNK + 5];
        let mut expected = vec![(1, 0..1), (2, 0..CHUNK)];
        expected.extend(long.map(|indices| (5, indices)));
        assert_eq!(all, expected);
    }
}
