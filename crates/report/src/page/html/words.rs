//! Links and code in a page.

use maud::{Markup, html};

/// Text that people wrote, as a link if it is an address of the web.
pub(super) fn link(url: &str) -> Markup {
    let is_scheme = |scheme: &str| {
        url.get(..scheme.len())
            .is_some_and(|start| start.eq_ignore_ascii_case(scheme))
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
pub(crate) fn code(text: &str) -> Markup {
    html! { code { (text) } }
}

/// At most so many characters.
pub(crate) fn shortened(text: &str, most: usize) -> String {
    match text.char_indices().nth(most) {
        Some((end, _)) => format!("{}…", &text[..end]),
        None => text.to_owned(),
    }
}
