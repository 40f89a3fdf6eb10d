//! Numbers, links and code in the report.

use crate::report::Rate;
use crate::report::{group_digits, rate};
use maud::{Markup, html};

/// `15.8 %`.
pub(in crate::report) fn percent(share: f64) -> String {
    let number = rate::percent(share);
    format!("{}\u{a0}%", number.trim_end_matches('%'))
}

/// `15.1–16.6`, in percent.
pub(in crate::report) fn interval([low, high]: [f64; 2]) -> String {
    let number = |share: f64| rate::percent(share).trim_end_matches('%').to_owned();
    format!("{}–{}", number(low), number(high))
}

/// `1,597 of 10,092`.
pub(in crate::report) fn counts(rate: &Rate) -> String {
    format!("{} of {}", group_digits(rate.count), group_digits(rate.of))
}

/// Text that people wrote, as a link if it is an address of the web.
pub(super) fn link(url: &str) -> Markup {
    let is_scheme = |scheme: &str| {
        url.get(..scheme.len()).is_some_and(|start| start.eq_ignore_ascii_case(scheme))
    };
    let is_web = is_scheme("https://") || is_scheme("http://");
    let is_plain = !url.chars().any(|c| c.is_whitespace() || c.is_control());
    html! {
        @if is_web && is_plain {
            a href=(url) rel="noopener noreferrer" { (url) }
        } @else {
            (url)
        }
    }
}

/// A command or bits, to be selected with one click.
pub(in crate::report) fn code(text: &str) -> Markup {
    html! { code { (text) } }
}

/// At most so many characters.
pub(in crate::report) fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
