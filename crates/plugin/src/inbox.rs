//! Bytes that came from a process and are not taken yet, in memory that is kept: new or cleared memory for each read
//! costs as much as the read.

#![forbid(unsafe_code)]

use std::io::{self, Read};

/// The most bytes that are read at once.
pub(super) const ROOM: usize = 1 << 16;

#[derive(Default)]
pub(super) struct Inbox {
    /// The first of them came, in order; the rest is room.
    bytes: Vec<u8>,
    came: usize,
    taken: usize,
}

impl Inbox {
    /// The bytes that are not taken yet.
    pub fn unread(&self) -> &[u8] {
        &self.bytes[self.taken..self.came]
    }

    /// The next bytes, if so many are there.
    pub fn take(&mut self, count: usize) -> Option<&[u8]> {
        let start = self.taken;
        let end = start.checked_add(count).filter(|end| *end <= self.came)?;
        self.taken = end;
        Some(&self.bytes[start..end])
    }

    /// Appends bytes.
    pub fn add(&mut self, more: &[u8]) {
        self.make_room(more.len()).copy_from_slice(more);
        self.came += more.len();
    }

    /// Appends what one read gives; how many bytes.
    pub fn read(&mut self, from: &mut impl Read) -> io::Result<usize> {
        let read = from.read(self.make_room(ROOM))?;
        self.came += read;
        Ok(read)
    }

    /// Room behind what came, for so many bytes; what was taken is forgotten.
    fn make_room(&mut self, count: usize) -> &mut [u8] {
        self.bytes.copy_within(self.taken..self.came, 0);
        (self.came, self.taken) = (self.came - self.taken, 0);
        let end = self.came + count;
        if self.bytes.len() < end {
            self.bytes.resize(end, 0);
        }
        &mut self.bytes[self.came..end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_come_out_once_and_in_order() {
        let mut inbox = Inbox::default();
        inbox.add(b"abc");
        assert_eq!(inbox.take(4), None);
        assert_eq!(inbox.take(2), Some(&b"ab"[..]));
        assert_eq!(inbox.read(&mut &b"defg"[..]).unwrap(), 4);
        assert_eq!(inbox.unread(), b"cdefg");
        inbox.add(&[b'x'; 2 * ROOM]);
        assert_eq!(inbox.take(6), Some(&b"cdefgx"[..]));
        assert_eq!(inbox.unread().len(), 2 * ROOM - 1);
        assert_eq!(inbox.take(usize::MAX), None);
    }
}
