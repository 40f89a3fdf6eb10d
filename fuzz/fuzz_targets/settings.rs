//! The readers of `hairline.toml`, of expectations and of their lock file: no panic on any bytes, and every
//! line that an error names is there.
#![cfg_attr(fuzzing, no_main)]

use hairline::internals::cli;
use hairline::internals::expect::{self, Lock};

fn errors_name_their_line(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else {
        return;
    };
    let settings = cli::read_settings(text, "fuzz.toml").err();
    let expectations = expect::read(text, "fuzz.toml", &[])
        .err()
        .map(|error| error.to_string());
    let lock = Lock::read(text, "fuzz.toml")
        .err()
        .map(|error| error.to_string());
    for error in [settings, expectations, lock].iter().flatten() {
        let named = error.strip_prefix("fuzz.toml:").expect("the file's name");
        let line = named
            .split(':')
            .next()
            .and_then(|line| line.parse::<usize>().ok());
        // The end of the text is behind its last line.
        assert!(
            line.is_none_or(|line| 1 <= line && line <= text.split('\n').count()),
            "{error}"
        );
    }
}

hairline_fuzz::target!(errors_name_their_line);
