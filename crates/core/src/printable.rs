//! Floor 0: text that other people wrote, as a terminal shows it and does not obey it.

#![forbid(unsafe_code)]

/// A text on one line, without what a terminal obeys.
pub fn printable(text: &str) -> String {
    text.chars().map(shown).collect()
}

/// Text of several lines, each of them [`printable`].
pub fn printable_lines(text: &str) -> String {
    let lines: Vec<String> = text.split('\n').map(printable).collect();
    lines.join("\n")
}

/// True for a character that is an order and no letter: a control character, one that is not seen, or one that turns the
/// direction of what follows (Unicode Standard Annex 9, table of explicit formatting characters).
pub fn is_obeyed(c: char) -> bool {
    let turns = matches!(
        c,
        '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}'
    );
    let breaks_lines = matches!(c, '\u{2028}' | '\u{2029}');
    let is_not_seen = c == '\u{feff}';
    c.is_control() || turns || breaks_lines || is_not_seen
}

fn shown(c: char) -> String {
    if is_obeyed(c) {
        c.escape_default().to_string()
    } else {
        c.to_string()
    }
}
