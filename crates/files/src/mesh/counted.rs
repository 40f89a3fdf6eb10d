//! How much of a file is read: a reader that reports how far it is, and what is too much.

use std::io::{self, BufRead, Read};

const MEBIBYTE: u64 = 1 << 20;

/// How much is read before a file is an error.
#[derive(Clone, Copy)]
pub(super) struct ReadLimits {
    /// Bytes in a line, with what is joined to it by backslashes in an OBJ file; in the header of a PLY file.
    pub line: usize,
    /// Vertices, and triangles after polygons are cut up.
    pub elements: usize,
}

/// One MiB, and what 32-bit indices hold with room to spare.
pub(super) const LIMITS: ReadLimits = ReadLimits {
    line: 1 << 20,
    elements: 100_000_000,
};

/// Calls `progress` about every MiB with the bytes read so far.
pub(super) struct Counted<'p, R> {
    reader: R,
    progress: &'p mut dyn FnMut(u64),
    bytes: u64,
    next_report: u64,
}

impl<'p, R> Counted<'p, R> {
    pub fn new(reader: R, progress: &'p mut dyn FnMut(u64)) -> Counted<'p, R> {
        Counted {
            reader,
            progress,
            bytes: 0,
            next_report: MEBIBYTE,
        }
    }

    /// Reports the end.
    pub fn finish(&mut self) {
        (self.progress)(self.bytes);
    }

    fn count(&mut self, read: usize) {
        self.bytes += read as u64;
        if self.bytes >= self.next_report {
            (self.progress)(self.bytes);
            self.next_report = self.bytes + MEBIBYTE;
        }
    }
}

impl<R: Read> Read for Counted<'_, R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.reader.read(buffer)?;
        self.count(read);
        Ok(read)
    }
}

impl<R: BufRead> BufRead for Counted<'_, R> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.reader.fill_buf()
    }

    fn consume(&mut self, read: usize) {
        self.reader.consume(read);
        self.count(read);
    }
}
