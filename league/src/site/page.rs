//! What all pages have in common, where they are written, and the first of them.

use crate::epsilons::Epsilon;
use crate::findings::Finding;
use hairline_league::edition::{CAPTION, EntrantResult, HEAD, rows};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::fs;
use std::path::PathBuf;

const STYLE: &str = include_str!("style.css");

/// The folder of a site.
pub struct Pages {
    folder: PathBuf,
    pub edition: String,
    files: usize,
    bytes: usize,
}

impl Pages {
    /// In a folder, of an edition.
    pub fn new(folder: &str, edition: &str) -> Pages {
        Pages {
            folder: folder.into(),
            edition: edition.to_owned(),
            files: 0,
            bytes: 0,
        }
    }

    /// Writes a file beside its place and renames it.
    pub fn file(&mut self, path: &str, text: &str) -> Result<(), String> {
        let place = self.folder.join(path);
        let beside = self.folder.join(format!("{path}.new"));
        let parent = place.parent().expect("below the folder");
        fs::create_dir_all(parent).map_err(|error| format!("{}: {error}", parent.display()))?;
        fs::write(&beside, text).map_err(|error| format!("{}: {error}", beside.display()))?;
        fs::rename(&beside, &place).map_err(|error| format!("{}: {error}", place.display()))?;
        (self.files, self.bytes) = (self.files + 1, self.bytes + text.len());
        Ok(())
    }

    /// Writes a page one folder below the first.
    pub fn page(&mut self, path: &str, title: &str, body: &Markup) -> Result<(), String> {
        let text = shell(&self.edition, title, "../", body);
        self.file(path, &text)
    }

    /// What was written.
    pub fn said(&self) -> String {
        let folder = self.folder.display();
        let megabytes = self.bytes as f64 / 1e6;
        format!(
            "{folder}: {} files, {megabytes:.1} MB; open index.html",
            self.files
        )
    }
}

/// A page; `up` leads to the folder of the first.
fn shell(edition: &str, title: &str, up: &str, body: &Markup) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                nav { a href={ (up) "index.html" } { (edition) } }
                main { h1 { (title) } (body) }
                footer {
                    p.soft {
                        "Made by hairline, which compares ray–triangle tests with exact arithmetic. In its repository " code { "league" }
                        " in a command is " code { "cargo run --release --manifest-path league/Cargo.toml --" } ", " code { "league-heavy" }
                        " the same with " code { "league/heavy/Cargo.toml" } ", and " code { "hairline" } " is " code { "cargo run --release --" } "."
                    }
                }
            }
        }
    };
    page.into_string()
}

/// A table that scrolls sideways where it is wider than the page.
pub fn table(label: &str, head: &Markup, body: &Markup) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label=(label) {
            table { thead { tr { (head) } } tbody { (body) } }
        }
    }
}

/// A name as part of a file's name.
pub fn slug(name: &str) -> String {
    let words = name.split(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '.');
    words
        .filter(|word| !word.is_empty())
        .collect::<Vec<_>>()
        .join("-")
        .to_lowercase()
}

/// The table, the findings and the epsilons.
pub fn index(
    pages: &mut Pages,
    results: &[EntrantResult],
    findings: &[Finding],
    epsilons: &[Epsilon],
) -> Result<(), String> {
    let head = html! { @for head in HEAD { th { (head) } } };
    let body = html! {
        @for (entrant, _, cells) in rows(results) {
            tr {
                @for (place, cell) in cells.iter().enumerate() {
                    td class=[(HEAD[place] == "claim").then_some(cell)] {
                        @if place == 0 { a href={ "kernel/" (slug(&entrant.kernel)) ".html" } { (cell) } }
                        @else { (cell) }
                    }
                }
            }
        }
    };
    let body = html! {
        p.lead {
            "Which ray–triangle tests that people ship keep what their documentation says? Each function is called as it is \
             documented, at one version, and judged by that documentation alone. Exact arithmetic tells what is right."
        }
        p { (CAPTION) }
        p {
            "The deepest false verdict is the one that is farthest off in ulps of the largest coordinate. Where only shared edges are promised "
            "(embree-robust) held means that no ray slipped through one. A rate is of our cases, and says nothing of how often your scene has such a ray."
        }
        (table("The league", &head, &body))
        h2 { "Findings" }
        p { "Each page has the code that shows it, the cause, and the smallest repair." }
        ul { @for finding in findings { li { a href={ "finding/" (finding.slug) ".html" } { (finding.title) } } } }
        h2 { "Epsilons" }
        p { "Who uses it, what is proved of it, and what it does to rays in four scenes." }
        ul.values { @for epsilon in epsilons { li { a href={ "epsilon/" (epsilon.slug()) ".html" } { (epsilon.text) } } } }
    };
    let title = format!("The league of ray–triangle tests, {}", pages.edition);
    let text = shell(&pages.edition.clone(), &title, "", &body);
    pages.file("index.html", &text)
}
