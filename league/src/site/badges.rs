//! A badge for each entrant and scalar, as shields.io reads it: <https://shields.io/badges/endpoint-badge>.

use crate::page::{Pages, slug};
use hairline_league::edition::EntrantResult;
use maud::{Markup, html};
use serde_json::json;

/// What a badge says.
pub struct Badge {
    label: String,
    message: &'static str,
    color: &'static str,
    file: String,
}

/// The badges of an entrant, by scalar.
pub fn of<'a>(edition: &'a str, entrant: &'a EntrantResult) -> impl Iterator<Item = Badge> + 'a {
    entrant.scalars.iter().map(move |(scalar, result)| {
        let (message, color) = match result.verdict.as_str() {
            "held" => ("claims held", "brightgreen"),
            "rounding" => ("right but for rounding", "green"),
            "refuted by size" => ("refuted at extreme sizes", "yellow"),
            "refuted" => ("claims refuted", "red"),
            _ => ("nothing promised", "lightgrey"),
        };
        let file = format!("badge/{}-{scalar}.json", slug(&entrant.kernel));
        Badge {
            label: format!("{edition} {scalar}"),
            message,
            color,
            file,
        }
    })
}

impl Badge {
    /// As it looks, more or less.
    pub fn shown(&self) -> Markup {
        html! { span.badge { b { (self.label) } i class=(self.color) { (self.message) } } }
    }

    /// For a README, if the site is published at a URL.
    pub fn markdown(&self, url: &str) -> String {
        let url = url.trim_end_matches('/');
        format!(
            "![{}](https://img.shields.io/endpoint?url={url}/{})",
            self.label, self.file
        )
    }
}

/// The files.
pub fn write(pages: &mut Pages, results: &[EntrantResult]) -> Result<(), String> {
    let edition = pages.edition.clone();
    for badge in results.iter().flat_map(|entrant| of(&edition, entrant)) {
        let Badge {
            label,
            message,
            color,
            file,
        } = badge;
        let text = json!({"schemaVersion": 1, "label": label, "message": message, "color": color});
        pages.file(&file, &format!("{text}\n"))?;
    }
    Ok(())
}
