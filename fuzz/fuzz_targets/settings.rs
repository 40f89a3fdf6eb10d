//! The readers of `hairline.toml` and of expectations: no panic on any bytes, and every line that an error
//! names is there.
#![cfg_attr(fuzzing, no_main)]

use hairline::internals::{cli, expect};

fn errors_name_their_line(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    let expectations = expect::read(text, "fuzz.toml").map_err(|error| error.to_string());
    for error in [cli::read_settings(text, "fuzz.toml").err(), expectations.err()].iter().flatten()
    {
        let named = error.strip_prefix("fuzz.toml:").expect("the file's name");
        let line = named.split(':').next().and_then(|line| line.parse::<usize>().ok());
        // The end of the text is behind its last line.
        assert!(line.is_none_or(|line| 1 <= line && line <= text.split('\n').count()), "{error}");
    }
}

hairline_fuzz::target!(errors_name_their_line);
