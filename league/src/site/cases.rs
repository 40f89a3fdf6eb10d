//! A page for each deepest case: the input, the exact truth, and what every kernel of this program answers.

use crate::drawing;
use crate::page::{Pages, slug, table};
use hairline::internals::audit::Row;
use hairline::internals::case::Case;
use hairline::internals::corpus::lines::{AnyCase, StoredCase, write_case};
use hairline::internals::judge::{Obligation, asked, judge};
use hairline::internals::kernel::{Entry, Scalar, Verdict, all};
use hairline::internals::oracle::{define, truth};
use hairline::internals::truth::ExactValues;
use hairline_league::edition::{Depth, EntrantResult};
use maud::{Markup, html};
use num_traits::ToPrimitive;
use std::collections::BTreeMap;
use std::slice;

/// A case, and the entrants whose deepest false verdict it is.
pub struct SiteCase {
    id: String,
    scalar: String,
    case: AnyCase,
    deepest: Vec<(String, &'static str, Depth)>,
}

/// The name of a case's page.
pub fn slug_of(depth: &Depth) -> String {
    slug(&depth.case)
}

/// Those of all entrants, by name of their pages.
pub fn of(results: &[EntrantResult]) -> BTreeMap<String, SiteCase> {
    let mut cases: BTreeMap<String, SiteCase> = BTreeMap::new();
    for entrant in results {
        for (scalar, result) in &entrant.scalars {
            for (what, depth) in [
                ("false miss", &result.deepest_miss),
                ("false hit", &result.deepest_hit),
            ] {
                let Some(depth) = depth else { continue };
                let case = cases.entry(slug_of(depth)).or_insert_with(|| SiteCase {
                    id: depth.case.clone(),
                    scalar: scalar.clone(),
                    case: depth.case(scalar),
                    deepest: Vec::new(),
                });
                case.deepest
                    .push((entrant.kernel.clone(), what, depth.clone()));
            }
        }
    }
    cases
}

/// The pages.
pub fn write(pages: &mut Pages, cases: &BTreeMap<String, SiteCase>) -> Result<(), String> {
    for (slug, case) in cases {
        let body = match case.case {
            AnyCase::F32(numbers) => page(case, &numbers),
            AnyCase::F64(numbers) => page(case, &numbers),
        };
        pages.page(
            &format!("case/{slug}.html"),
            &format!("Case {}", case.id),
            &body,
        )?;
    }
    Ok(())
}

fn page<F: Scalar>(site: &SiteCase, case: &Case<F>) -> Markup {
    let definition = define(case);
    let exact = &definition.exact;
    html! {
        p {
            "The deepest "
            @for (place, (kernel, what, depth)) in site.deepest.iter().enumerate() {
                @if 0 < place { ", the deepest " }
                (what) " of " a href={ "../kernel/" (slug(kernel)) ".html" } { (kernel) } " in " (site.scalar)
                " (" (format!("{:.1e}", depth.edges)) " longest edges)"
            }
            "."
        }
        h2 { "The input" }
        (input(case))
        h2 { "What is right" }
        p { "The line of the ray meets the plane so: " b { (definition.truth) } "." }
        (values(exact))
        @if let Some(picture) = drawing::picture(case, exact) { (picture) }
        h2 { "What kernels answer" }
        p.soft {
            "Those that are built into the program, each with the epsilons of its source and judged by what its own source promises: nothing is asked where that "
            "leaves the case open, as a direction that is not of unit length, or an edge. A bad value is a hit whose t, u or v is promised and is "
            "not finite, or whose side is wrong. The others run in programs of their own and are in the edition's table only."
        }
        h3 { "Published libraries" }
        (answers("Published libraries", case, |entry| !entry.is_built_in()))
        h3 { "hairline's own kernels, from the literature" }
        (answers("hairline's own kernels", case, Entry::is_built_in))
        h2 { "Show it again" }
        @for (_, _, depth) in &site.deepest { pre { code { (depth.command) } } }
        p { "As a line of a corpus file, for " code { "hairline audit --corpus FILE" } ":" }
        pre { code { (write_case(&StoredCase::of(site.case).with_truth())) } }
    }
}

fn input<F: Scalar>(case: &Case<F>) -> Markup {
    let vectors = case.vectors();
    let names = ["origin", "direction", "a", "b", "c"];
    let ends = [case.ray.t_min, case.ray.t_max];
    let numbers = |list: &[F]| {
        list.iter()
            .map(|x| format!("{x:?}"))
            .collect::<Vec<_>>()
            .join(", ")
    };
    let width = size_of::<F>() * 2;
    let bits = |list: &[F]| {
        let words = list.iter().map(|x| format!("{:0width$x}", x.to_bits()));
        words.collect::<Vec<_>>().join(" ")
    };
    let head = html! { th { "what" } th.text { "decimal" } th.text { "bits" } };
    let body = html! {
        @for (name, vector) in names.iter().zip(&vectors) {
            tr { td { (name) } td.text { code { (numbers(vector)) } } td.text { code { (bits(vector)) } } }
        }
        tr { td { "t from, to" } td.text { code { (numbers(&ends)) } } td.text { code { (bits(&ends)) } } }
    };
    table("The input", &head, &body)
}

/// The numbers of the crossing, as fractions where these are short enough to read.
fn values(exact: &ExactValues) -> Markup {
    const MOST: usize = 120;
    let names = ["t", "u (weight of b)", "v (weight of c)"];
    let values = [&exact.t, &exact.u, &exact.v];
    html! {
        @if exact.t.is_some() {
            ul {
                @for (name, value) in names.iter().zip(values) {
                    @if let Some(value) = value {
                        @let fraction = value.to_string();
                        li {
                            (name) " = " code { (format!("{:e}", value.to_f64().unwrap_or(f64::NAN))) }
                            @if fraction.len() <= MOST { ", exactly " code { (fraction) } }
                        }
                    }
                }
            }
        }
    }
}

fn answers<F: Scalar>(label: &str, case: &Case<F>, is_one: fn(&Entry) -> bool) -> Markup {
    let head = html! { th { "kernel" } th.text { "answers" } th.text { "is asked" } th.text { "finding" } };
    let body = html! {
        @for entry in all().into_iter().filter(|entry| is_one(entry)) {
            @if let Some([answer, demand, finding]) = answer(entry, case) {
                tr { td { (entry.info.name) } td.text { (answer) } td.text { (demand) } td.text.wrong { (finding) } }
            }
        }
    };
    table(label, &head, &body)
}

/// What a kernel answers, what is asked of it, and the finding if that is not the same; none if it does not run in
/// this scalar.
fn answer<F: Scalar>(entry: &'static Entry, case: &Case<F>) -> Option<[String; 3]> {
    let subject = F::subject(entry)?;
    let row = Row::named(entry.info.name, None, "own").ok()?;
    let mut verdict = [Verdict::miss(None)];
    subject.run(slice::from_ref(case), &row.epsilons::<F>(), &mut verdict);
    let ([verdict], truth) = (verdict, truth(case));
    let asked = asked(case, &truth, &row.contract, false);
    let demand = match asked {
        Obligation::MustHit => "a hit",
        Obligation::MustMiss => "a miss",
        Obligation::Free => "nothing",
    };
    let answer = match (verdict.hit, entry.info.gives.t) {
        (true, true) => format!("hit at t = {:?}", verdict.t),
        (true, false) => "hit".to_owned(),
        (false, _) => "miss".to_owned(),
    };
    let finding = judge(
        (&row.contract, asked),
        (case, &truth),
        entry.info.gives,
        &verdict,
    );
    Some([
        answer,
        demand.to_owned(),
        finding.map_or(String::new(), |f| f.name().to_owned()),
    ])
}
