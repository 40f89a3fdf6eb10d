//! The case-file reader: no panic on any bytes, and what it reads it writes and reads back.
#![cfg_attr(fuzzing, no_main)]

use hairline::internals::corpus::lines::{read, write_case};

fn read_back(data: &[u8]) {
    for stored in read(data, "fuzz").flatten() {
        let line = write_case(&stored);
        let again = read(line.as_bytes(), "again")
            .next()
            .expect("a line")
            .expect("a case");
        assert_eq!(write_case(&again), line);
    }
}

hairline_fuzz::target!(read_back);
