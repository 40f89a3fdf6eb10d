//! A page for each entrant: what is called, what is promised, what came out.

use crate::badges;
use crate::cases;
use crate::findings::Finding;
use crate::page::{Pages, slug, table};
use hairline_league::edition::{Depth, EntrantResult, GROUPS, ScalarResult, Share};
use maud::{Markup, html};

/// The pages.
pub fn write(
    pages: &mut Pages,
    results: &[EntrantResult],
    findings: &[Finding],
    url: Option<&str>,
) -> Result<(), String> {
    for entrant in results {
        let about = findings.iter().filter(|finding| entrant.findings.contains(&finding.file));
        let body = html! {
            p { "Package " b { (entrant.package) } ", version " (entrant.version) ". What is called: " code { (entrant.function) } "." }
            h2 { "What is promised" }
            @if entrant.claim.is_empty() { p { "Its documentation promises nothing about which rays hit." } }
            @for sentence in &entrant.claim { blockquote { p { (linked(sentence)) } } }
            p { (linked(&entrant.page)) }
            @if !entrant.note.is_empty() { p { (linked(&entrant.note)) } }
            p.soft { "Judged by: " (entrant.contract) ". " (entrant.cases) " cases of each family, " (entrant.audited) "." }
            h2 { "What came out" }
            @for (scalar, result) in &entrant.scalars { (section(scalar, result)) }
            h2 { "Findings" }
            @if entrant.findings.is_empty() { p { "None is written up." } }
            ul { @for finding in about { li { a href={ "../finding/" (finding.slug) ".html" } { (finding.title) } } } }
            h2 { "Badges" }
            @for badge in badges::of(&pages.edition, entrant) {
                p { (badge.shown()) }
                pre { code { (badge.markdown(url.unwrap_or("URL-OF-THIS-FOLDER"))) } }
            }
        };
        let path = format!("kernel/{}.html", slug(&entrant.kernel));
        pages.page(&path, &format!("{} {}", entrant.kernel, entrant.version), &body)?;
    }
    Ok(())
}

/// What a group of families asks.
fn question(group: &str) -> &'static str {
    match group {
        "plain" => "inside and outside, nothing special",
        "edges" => "on edges and within some ulps of them",
        "vertices" => "on vertices and within some ulps of them",
        "parallel" => "nearly parallel to the triangle, and thin triangles",
        "start" => "starts and ends on or near the triangle",
        "size" => "small, large and far, directions short and long",
        "range" => "the ends of the exponent range (counts for no verdict)",
        _ => "",
    }
}

fn section(scalar: &str, result: &ScalarResult) -> Markup {
    let verdict = match result.verdict.as_str() {
        "held" => "held: every false verdict is within 4 ulps of the input",
        "rounding" => "right but for rounding: every false verdict is within half of the digits",
        "refuted by size" => {
            "refuted, but for triangles or directions that are small, large or far only"
        }
        "refuted" => "refuted",
        _ => "nothing is claimed",
    };
    let head =
        html! { th { "rays" } th { "false misses" } th { "of" } th { "false hits" } th { "of" } };
    let body = html! {
        @for (group, [misses, hits]) in GROUPS.iter().filter_map(|(name, _)| Some((name, result.groups.get(*name)?))) {
            tr { td { (question(group)) } td { (misses.count) } td { (misses.of) } td { (hits.count) } td { (hits.of) } }
        }
    };
    html! {
        h3 { (scalar) ": " span class=(result.verdict.split(' ').next_back().unwrap_or_default()) { (verdict) } }
        (table(&format!("By kind of rays, {scalar}"), &head, &body))
        p { "Rays through shared edges and vertices: " (of(result.cracks)) " hit nothing, " (of(result.doubles)) " more than one triangle." }
        @if let Some([half, most]) = result.t_error_ulps {
            p { "Of plain hits, half have t within " (half) " ulps of the exact one, 99 % within " (most) "." }
        }
        @for (what, depth) in [("false miss", &result.deepest_miss), ("false hit", &result.deepest_hit)] {
            @if let Some(depth) = depth { (deepest(what, depth)) }
        }
    }
}

fn of(share: Share) -> String {
    format!("{} of {}", share.count, share.of)
}

fn deepest(what: &str, depth: &Depth) -> Markup {
    html! {
        p {
            "The deepest " (what) " is " b { (format!("{:.1e}", depth.edges)) } " longest edges (" (format!("{:.1e}", depth.ulps))
            " ulps of the largest coordinate) from where it would be right: "
            a href={ "../case/" (cases::slug_of(depth)) ".html" } { (depth.case) } "."
        }
        pre { code { (depth.command) } }
    }
}

/// Text, in which an address is a link, and what stands between backquotes is code.
fn linked(text: &str) -> Markup {
    html! {
        @for (place, part) in text.split('`').enumerate() {
            @if place % 2 == 1 { code { (part) } } @else {
                @for word in part.split_inclusive(' ') {
                    @if word.starts_with("https://") { a href=(word.trim_end_matches(['.', ',', ';', ' '])) { (word) } }
                    @else { (word) }
                }
            }
        }
    }
}
