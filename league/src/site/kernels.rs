//! A page for each entrant: what is called, what is promised, what came out.

use crate::badges;
use crate::cases;
use crate::findings::Finding;
use crate::page::{Pages, slug, table};
use hairline::internals::audit::shell_word;
use hairline_league::edition::{Depth, EntrantResult, GROUPS, ScalarResult, Share, half_of_digits};
use hairline_league::{Entrant, entrants};
use maud::{Markup, html};

/// The pages.
pub fn write(
    pages: &mut Pages,
    results: &[EntrantResult],
    findings: &[Finding],
    url: Option<&str>,
) -> Result<(), String> {
    let entrants = entrants();
    for entrant in results {
        let about = findings
            .iter()
            .filter(|finding| entrant.findings.contains(&finding.file));
        let body = html! {
            p { "Package " b { (entrant.package) } ", version " (entrant.version) ". What is called: " code { (entrant.function) } "." }
            h2 { "What is promised" }
            @if entrant.claim.is_empty() { p { "Its documentation promises nothing about which rays hit." } }
            @for sentence in &entrant.claim { blockquote { p { (linked(sentence)) } } }
            p { (linked(&entrant.page)) }
            @if !entrant.note.is_empty() { p { (linked(&entrant.note)) } }
            p.soft { "Judged by: " (entrant.contract) ". " (entrant.cases) " cases of each family, " (entrant.audited) "." }
            h2 { "What came out" }
            p.soft {
                "Refuted: a false verdict is deeper than half of the number's digits (4,096 ulps of the largest coordinate in f32, 9.5e7 in f64), or a "
                "promise about shared edges is broken."
            }
            @let facts = entrants.iter().find(|facts| facts.name == entrant.kernel);
            @for (scalar, result) in &entrant.scalars { (section(entrant, facts, scalar, result)) }
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
        pages.page(
            &path,
            &format!("{} {}", entrant.kernel, entrant.version),
            &body,
        )?;
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

fn section(
    entrant: &EntrantResult,
    facts: Option<&Entrant>,
    scalar: &str,
    result: &ScalarResult,
) -> Markup {
    let verdict = match result.verdict.as_str() {
        "held" if facts.is_some_and(|facts| facts.only_shared) => {
            "held: no ray slipped through a shared edge, and nothing else is promised"
        }
        "held" => "held: every false verdict is within 4 ulps of the input",
        "rounding" => "right but for rounding: every false verdict is within half of the digits",
        "refuted by size" => {
            "refuted, for small, large or far triangles and short or long directions only"
        }
        "refuted" => "refuted",
        _ => "nothing is claimed",
    };
    let head =
        html! { th { "rays" } th { "false misses" } th { "of" } th { "false hits" } th { "of" } };
    let body = html! {
        @for (group, [misses, hits]) in GROUPS.iter().filter_map(|(name, _)| Some((name, result.groups.get(*name)?))) {
            tr { td.text { (question(group)) ": " span.soft { (families(group)) } } td { (misses.count) } td { (misses.of) } td { (hits.count) } td { (hits.of) } }
        }
    };
    html! {
        h3 { (scalar) ": " span class=(result.verdict.split(' ').next_back().unwrap_or_default()) { (verdict) } (refuting(facts, scalar, result)) }
        (table(&format!("By kind of rays, {scalar}"), &head, &body))
        @if let Some(facts) = facts { pre { code { (command(entrant, facts, scalar)) } } }
        p { "Rays through shared edges and vertices: " (of(result.cracks)) " hit nothing, " (of(result.doubles)) " more than one triangle." }
        @if let Some(noise) = result.cracks_beside_noise {
            p { "Where coordinates of about 1 stand beside some of about 2^-53: " (of(noise)) " hit nothing." }
        }
        @if let Some([half, most]) = result.t_error_ulps {
            p { "Of plain hits, half have t within " (short(half)) " ulps of the exact one, 99 % within " (short(most)) "." }
        }
        @if let Some(wrong) = result.wrong_values {
            p { (of(wrong)) " right hits have a t, u or v that is off by more than rounding explains." }
        }
        @for (what, depth) in [("false miss", &result.deepest_miss), ("false hit", &result.deepest_hit)] {
            @if let Some(depth) = depth { (deepest(what, depth)) }
        }
    }
}

/// What refutes a claim, if one is refuted and that is known: the deepest case of the groups that the verdict is
/// about, or what slips through shared edges.
fn refuting(facts: Option<&Entrant>, scalar: &str, result: &ScalarResult) -> Markup {
    let depths = [("miss", &result.deepest_miss), ("hit", &result.deepest_hit)];
    let depths = depths
        .into_iter()
        .filter_map(|(what, depth)| Some((what, depth.as_ref()?)));
    let deepest = depths.max_by(|(_, a), (_, b)| a.ulps.total_cmp(&b.ulps));
    let deepest = deepest.filter(|(_, depth)| half_of_digits(scalar) < depth.ulps);
    let sized = GROUPS
        .iter()
        .find(|(group, _)| *group == "size")
        .map_or(&[][..], |(_, all)| all);
    let only_shared = facts.is_some_and(|facts| facts.only_shared);
    html! {
        @match (result.verdict.as_str(), deepest) {
            ("refuted", _) if only_shared => (SHARED),
            ("refuted", None) => (SHARED),
            (verdict @ ("refuted" | "refuted by size"), Some((what, depth)))
                if sized.contains(&depth.family.as_str()) == (verdict == "refuted by size") =>
            {
                ": " a href={ "../case/" (cases::slug_of(depth)) ".html" } {
                    "a false " (what) ", " (short(depth.ulps)) " ulps deep"
                }
            }
            _ => {}
        }
    }
}

const SHARED: &str = ": rays through shared edges and vertices, counted below";

fn of(share: Share) -> String {
    format!("{} of {}", share.count, share.of)
}

/// The families of a group, as the command line takes them.
fn families(group: &str) -> String {
    let families = GROUPS.iter().find(|(name, _)| *name == group);
    families.map_or(String::new(), |(_, families)| families.join(","))
}

/// Counts the same again; with `--details` by family.
fn command(entrant: &EntrantResult, facts: &Entrant, scalar: &str) -> String {
    let selector = facts
        .selector()
        .into_iter()
        .map(shell_word)
        .collect::<Vec<_>>()
        .join(" ");
    let direction = if facts.takes_unit_directions() {
        " --direction unit"
    } else {
        ""
    };
    let (program, cases) = (facts.program(), entrant.cases);
    let families: Vec<String> = GROUPS.iter().map(|(group, _)| families(group)).collect();
    let families = families.join(",");
    format!(
        "{program} audit {selector} --scalar {scalar}{direction} -n {cases} --details --family {families}"
    )
}

/// In as many digits as are read.
fn short(x: f64) -> String {
    match x {
        x if x == 0.0 || (0.01..1e5).contains(&x) => format!("{}", (x * 100.0).round() / 100.0),
        x => format!("{x:.1e}"),
    }
}

fn deepest(what: &str, depth: &Depth) -> Markup {
    html! {
        p {
            "The deepest " (what) " is " b { (short(depth.edges)) } " longest edges (" (short(depth.ulps))
            " ulps of the largest coordinate) off, from the triangle's boundary or along the ray from its end, whichever is nearer: "
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
