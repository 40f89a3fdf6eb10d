//! A record's page against hostile and huge records.

use super::super::Paged;
use super::*;
use crate::arith::ScalarName;
use crate::judge::Class;
use hairline_record::{
    ComparisonVerdict, ComputedFormula, Conformance, Counts, Deviation, ErrorChange, Example,
    FindingClass, FindingKind, FindingPart, Illustrations, KernelResult, Method, NetChange,
    PlanPart, PlannedSource, ProofPart, ProvedGate, Provenance, Rate, Record, ResultPart,
    RowChange, RowPart, ShortCase, SourcePart, Unproved,
};
use std::collections::BTreeMap;

/// A name that a person with bad intentions gives to things.
const HOSTILE: &str = "<script>alert('1')</script>\"><img src=x onerror=alert(2)>&amp;";

fn rate(count: u64, of: u64) -> Rate {
    let interval = (0 < of).then_some([0.25, 0.75]);
    let rate = (0 < of).then(|| count as f64 / of as f64);
    Rate {
        count,
        of,
        rate,
        interval,
        ..Rate::default()
    }
}

fn counts(misses: u64) -> Counts {
    Counts {
        cases: 100,
        free: 0,
        hits: 40,
        false_misses: rate(misses, 50),
        false_hits: rate(0, 50),
        bad_values: rate(0, 40),
        wrong_values: rate(0, 40),
        panics: 0,
        crashes: 0,
        timeouts: 0,
    }
}

fn example(text: &str) -> Example {
    Example {
        case: text.to_owned(),
        bits: format!("o={text}"),
        severity: None,
        command: format!("hairline explain '{text}'"),
    }
}

fn finding(class: &str, first: Vec<Example>) -> FindingPart {
    FindingPart {
        finding: FindingKind::FalseMiss,
        // A record has no class of another name.
        class: class.parse().unwrap_or(FindingClass::Any),
        rate: rate(5, 50),
        causes: None,
        digest: String::new(),
        worst: example(class),
        first,
    }
}

/// Rows of these names on sources of those, with the same findings each.
fn record(kernels: &[String], families: &[String], findings: &[FindingPart]) -> Record {
    let row = |kernel: &String| RowPart {
        contract_words: "own".to_owned(),
        kernel: kernel.clone(),
        selector: format!("--kernel {kernel}"),
        set: "source".to_owned(),
        epsilons: [("edge".to_owned(), "0".to_owned())].into(),
        contract: "ray".to_owned(),
    };
    let result = |kernel: &String, family: &String| KernelResult {
        scalar: ScalarName::F32,
        kernel: kernel.clone(),
        set: "source".to_owned(),
        family: family.clone(),
        total: counts(5 * findings.len() as u64),
        classes: BTreeMap::new(),
        findings: findings.to_vec(),
        severity: BTreeMap::new(),
        accuracy: BTreeMap::new(),
        across: None,
        polygons: None,
        self_hits: None,
    };
    let source = |family: &String| PlannedSource {
        family: family.clone(),
        set: family.clone(),
        count: 100,
    };
    let summary = |family: &String| SourcePart {
        scalar: ScalarName::F32,
        family: family.clone(),
        sample: true,
        promises: true,
        indices: 100,
        cases: 100,
        promise_broken: 0,
        first_broken: None,
        left_out: None,
    };
    let results = kernels
        .iter()
        .flat_map(|k| families.iter().map(move |f| result(k, f)));
    let result = ResultPart {
        mesh: None,
        plan: PlanPart {
            hash: "0123".to_owned(),
            rows: kernels.iter().map(row).collect(),
            sources: families.iter().map(source).collect(),
            scalars: vec![ScalarName::F32],
        },
        partial: None,
        sources: families.iter().take(1).map(summary).collect(),
        results: results.collect(),
        totals: Vec::new(),
    };
    Record::new(
        result,
        Provenance {
            tool: "hairline".to_owned(),
            ..Provenance::default()
        },
    )
}

pub fn deviation(text: &str, url: &str) -> Deviation {
    Deviation {
        kernel: text.to_owned(),
        set: text.to_owned(),
        scalar: ScalarName::F32,
        family: text.to_owned(),
        class: FindingClass::Group,
        finding: FindingKind::Crack,
        expected: text.to_owned(),
        expected_count: Some(2),
        found: rate(1, 2),
        line: Some(3),
        case: Some(text.to_owned()),
        bits: Some(text.to_owned()),
        command: Some(text.to_owned()),
        why: Some(text.to_owned()),
        url: Some(url.to_owned()),
    }
}

pub fn conformance(deviations: Vec<Deviation>) -> Conformance {
    Conformance {
        verdict: ComparisonVerdict::Disagreements,
        method: Method::CaseByCase,
        is_by_family: false,
        expectations: Some(HOSTILE.to_owned()),
        note: Some(HOSTILE.to_owned()),
        computes: vec![ComputedFormula {
            kernel: HOSTILE.to_owned(),
            set: HOSTILE.to_owned(),
            formula: HOSTILE.to_owned(),
            is_fused: true,
            epsilon: Some(HOSTILE.to_owned()),
            same: 1,
            hits: 2,
        }],
        short_case: Some(ShortCase {
            kernel: HOSTILE.to_owned(),
            set: HOSTILE.to_owned(),
            scalar: ScalarName::F32,
            family: HOSTILE.to_owned(),
            class: FindingClass::Any,
            finding: FindingKind::FalseMiss,
            right: Some(HOSTILE.to_owned()),
            bits: HOSTILE.to_owned(),
            command: HOSTILE.to_owned(),
        }),
        change: NetChange::default(),
        rows: vec![RowChange {
            kernel: HOSTILE.to_owned(),
            set: HOSTILE.to_owned(),
            what: HOSTILE.to_owned(),
            before: HOSTILE.to_owned(),
            now: HOSTILE.to_owned(),
        }],
        unsteady: Vec::new(),
        unproved: vec![Unproved {
            kernel: HOSTILE.to_owned(),
            scalar: ScalarName::F32,
            gate: HOSTILE.to_owned(),
            demanded: HOSTILE.to_owned(),
            why: HOSTILE.to_owned(),
            command: HOSTILE.to_owned(),
        }],
        errors: vec![ErrorChange {
            what: HOSTILE.to_owned(),
            before: HOSTILE.to_owned(),
            now: HOSTILE.to_owned(),
            is_worse: true,
        }],
        unexpected: deviations.clone(),
        stale: deviations.clone(),
        known: deviations,
        too_rare_to_tell: 1,
        outside_the_plan: 1,
    }
}

/// One of everything, with the hostile text wherever there is text.
fn hostile() -> Record {
    let name = HOSTILE.to_owned();
    let found = finding(HOSTILE, vec![example(HOSTILE)]);
    let mut record = record(
        std::slice::from_ref(&name),
        std::slice::from_ref(&name),
        &[found],
    );
    record.result.plan.hash = name.clone();
    record.result.plan.rows[0].contract = name.clone();
    record.result.plan.rows[0].epsilons = [(name.clone(), name.clone())].into();
    record.provenance.tool = name.clone();
    record.provenance.target = name.clone();
    let urls = [
        "javascript:alert(3)",
        "https://example.org/?a=\"><b>",
        "HTTP://x\ny",
        HOSTILE,
    ];
    record.conformance = Some(conformance(urls.map(|url| deviation(HOSTILE, url)).into()));
    record.illustrations = Some(Illustrations {
        proofs: vec![ProofPart {
            kernel: name.clone(),
            scalar: ScalarName::F64,
            edges: name.clone(),
            gates: [(
                name.clone(),
                ProvedGate {
                    bound: Some(f64::MAX),
                    known: Some(f64::NAN),
                },
            )]
            .into(),
        }],
    });
    record
}

/// The tags of a page with their attributes, after a check that they are nested, that attributes are
/// quoted and that text has no bare special character.
fn tags(page: &str) -> Vec<(String, Vec<(String, String)>)> {
    let body = page.strip_prefix("<!DOCTYPE html>").unwrap();
    let (mut open, mut all): (Vec<&str>, Vec<_>) = (Vec::new(), Vec::new());
    let mut rest = body;
    while let Some(start) = rest.find('<') {
        assert!(!rest[..start].contains('>'), "{}", &rest[..start]);
        rest = &rest[start + 1..];
        // No attribute of ours holds a bare `>`: the templates escape it.
        let (tag, after) = rest.split_once('>').unwrap();
        rest = after;
        if let Some(name) = tag.strip_prefix('/') {
            assert_eq!(open.pop(), Some(name));
            continue;
        }
        let empty = tag.strip_suffix('/');
        let tag = empty.unwrap_or(tag);
        let name = tag.split(' ').next().unwrap();
        let mut attributes = Vec::new();
        let mut words = tag[name.len()..].trim_start();
        while !words.is_empty() {
            let end = words.find(['=', ' ']).unwrap_or(words.len());
            let (attribute, more) = words.split_at(end);
            let mut value = "";
            words = more;
            if let Some(quoted) = more.strip_prefix("=\"") {
                let (inside, behind) = quoted.split_once('"').unwrap();
                (value, words) = (inside, behind);
            }
            assert!(
                attribute.chars().all(|c| c.is_alphanumeric() || c == '-'),
                "{tag}"
            );
            attributes.push((attribute.to_owned(), value.to_owned()));
            words = words.trim_start();
        }
        all.push((name.to_owned(), attributes));
        if matches!(name, "style" | "script") {
            // What stands in them is no markup.
            let (_, after) = rest.split_once(&format!("</{name}>")).unwrap();
            rest = after;
        } else if empty.is_none() && !["meta", "img", "input"].contains(&name) {
            open.push(name);
        }
    }
    assert!(open.is_empty(), "{open:?}");
    all
}

fn attribute<'a>(tag: &'a (String, Vec<(String, String)>), name: &str) -> Option<&'a str> {
    tag.1
        .iter()
        .find(|(key, _)| key == name)
        .map(|(_, value)| value.as_str())
}

#[test]
fn a_page_is_well_formed_and_whatever_a_record_says_is_text() {
    for record in [
        hostile(),
        record(&["a".to_owned()], &["b".to_owned()], &[]),
        record(&[], &[], &[]),
    ] {
        let page = within(&record.page(), LIMIT);
        let tags = tags(&page);
        let count = |name: &str| tags.iter().filter(|tag| tag.0 == name).count();
        assert_eq!(
            (count("script"), count("style"), count("h1"), count("main")),
            (1, 1, 1, 1)
        );
        let ids: Vec<&str> = tags.iter().filter_map(|tag| attribute(tag, "id")).collect();
        assert_eq!(
            ids.iter().collect::<BTreeSet<_>>().len(),
            ids.len(),
            "{ids:?}"
        );
        for tag in &tags {
            assert!(
                tag.1
                    .iter()
                    .all(|(name, _)| !name.starts_with("on") && name != "style")
            );
            if let Some(target) = attribute(tag, "href") {
                let inside = target.strip_prefix('#').is_some_and(|id| ids.contains(&id));
                assert!(
                    inside || target.starts_with("https://example.org/?a=&quot;"),
                    "{target}"
                );
            }
            assert_eq!(attribute(tag, "src"), None);
        }
    }
    let page = within(&hostile().page(), LIMIT);
    assert!(page.contains("&lt;script&gt;alert('1')&lt;/script&gt;"));
    assert!(page.contains("javascript:alert(3)"), "as text");
}

#[test]
fn the_policy_names_the_page_s_own_style_and_script() {
    let page = within(&hostile().page(), LIMIT);
    let digest = |text: &str| BASE64_STANDARD.encode(Hash::hash(text.as_bytes()));
    for name in ["style", "script"] {
        let (_, after) = page.split_once(&format!("<{name}>")).unwrap();
        let inside = after.split_once(&format!("</{name}>")).unwrap().0;
        assert!(
            page.contains(&format!("{name}-src 'sha256-{}'", digest(inside))),
            "{name}"
        );
    }
}

#[test]
fn a_hundred_thousand_findings_stay_below_the_limit_and_what_is_left_out_is_said() {
    let names = |letter: &str, count: usize| -> Vec<String> {
        (0..count).map(|i| format!("{letter}{i}")).collect()
    };
    let classes = |count: usize| -> Vec<FindingPart> {
        let classes = Class::all().take(count);
        classes
            .map(|class| finding(class.name(), Vec::new()))
            .collect()
    };
    let examples = (0..100_000)
        .map(|i| example(&format!("tiny@1/f32/-/1/{i}")))
        .collect();
    let long = "x".repeat(20 << 20);
    let only = std::slice::from_ref::<String>;
    let long_texts = vec![deviation(&long, &long); 2];
    let mut too_long = record(&names("k", 2), &names("f", 2), &classes(2));
    too_long.conformance = Some(conformance(long_texts));
    let many = vec![deviation("why", "https://example.org"); 100_000];
    let mut many_deviations = record(&names("k", 2), &names("f", 2), &classes(2));
    many_deviations.conformance = Some(conformance(many));
    for (what, record) in [
        (
            "examples",
            record(
                &["k".to_owned()],
                &names("f", 10),
                &[finding("coplanar", examples)],
            ),
        ),
        ("kernels", record(&names("k", 1_000), &names("f", 5), &[])),
        (
            "families",
            record(&names("k", 4), &names("f", 10_000), &classes(2)),
        ),
        (
            "a long name",
            record(only(&long), only(&long), &[finding(&long, Vec::new())]),
        ),
        ("long texts", too_long),
        ("deviations", many_deviations),
    ] {
        let page = within(&record.page(), LIMIT);
        assert!(page.len() < LIMIT, "{what}: {}", page.len());
        let is_told = page.contains(" left out here; the JSON record has all.");
        assert!(is_told || what == "examples", "{what}");
        tags(&page);
    }
}
