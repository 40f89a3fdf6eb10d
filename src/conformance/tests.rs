use super::*;
use crate::case::Case;
use crate::kernel::{Hit, KERNELS, KernelInfo};
use crate::record::{FindingKind, disagreements};

#[test]
fn an_entry_is_kept_once_however_often_it_is_audited() {
    const INFO: KernelInfo = KernelInfo::own("kept-once", Contract::CLOSED_RAY);
    static OWN: &KernelInfo = &INFO;
    let always = |_: &Case<f64>, _: &[f64]| Some(Hit::at(1.0));
    let never = |_: &Case<f64>, _: &[f64]| None;
    let [always, never] = [Entry::new(OWN).f64(always), Entry::new(OWN).f64(never)];
    let kept = |entry: &Entry| std::ptr::from_ref(audit(entry).entry);
    assert_eq!(kept(&always), kept(&always.clone()));
    assert_eq!(kept(&KERNELS[3]), std::ptr::from_ref(&KERNELS[3]));
    // The same name with other code is another kernel.
    assert_ne!(kept(&always), kept(&never));
    let hits = |entry: &Entry| {
        let outcome = audit(entry).families(["behind"]).count(20).run().unwrap();
        outcome
            .findings()
            .any(|finding| finding.finding == FindingKind::FalseHit)
    };
    assert_eq!([hits(&always), hits(&never)], [true, false]);
}

#[test]
fn what_is_allowed_passes_up_to_its_share_and_no_further() {
    let kernel = KERNELS
        .iter()
        .find(|entry| entry.info.name == "moller-trumbore")
        .unwrap();
    let request = audit(kernel).families(["edge-near"]).count(500);
    let outcome = request.run().unwrap();
    assert!(!outcome.conforms());
    let results = &outcome.record.result.results;
    let most = |rate: fn(&crate::record::Counts) -> f64| {
        results
            .iter()
            .map(|result| rate(&result.total))
            .fold(0.0, f64::max)
    };
    let share = |rate: &crate::record::Rate| rate.count as f64 / rate.of as f64;
    let [misses, hits] = [
        most(|c| c.false_misses.rate.unwrap()),
        most(|c| c.false_hits.rate.unwrap()),
    ];
    assert_eq!(
        misses,
        results
            .iter()
            .map(|r| share(&r.total.false_misses))
            .fold(0.0, f64::max)
    );
    let both = |misses: f64, hits: f64| {
        let request = request
            .clone()
            .allow("false-miss", misses)
            .allow("false-hit", hits);
        request.run().unwrap()
    };
    let more = |share: f64| share * (1.0 + 1e-12);
    assert!(both(more(misses), more(hits)).conforms());
    let outcome = both(misses * 0.99, more(hits));
    let text = outcome.to_string();
    assert!(
        !outcome.conforms() && !text.contains("(source): false-hit"),
        "{text}"
    );
    assert!(text.contains("allowed: false-miss in up to"), "{text}");
    assert!(
        text.contains("::new([") && text.contains(" --kernel moller-trumbore"),
        "{text}"
    );
}

#[test]
fn all_kinds_of_a_scene_causes_and_a_case_are_there_for_the_asking() {
    let kernel = KERNELS
        .iter()
        .find(|entry| entry.info.name == "moller-trumbore")
        .unwrap();
    let request = audit(kernel)
        .scene("room")
        .families(["scene-edges"])
        .count(50);
    let sources = |request: &Request| request.run().unwrap().record.result.plan.sources.len();
    assert_eq!(sources(&request), 1);
    assert!(5 < sources(&request.clone().all_kinds()));
    let with_causes = |request: &Request| {
        request
            .run()
            .unwrap()
            .findings()
            .filter(|finding| finding.causes.is_some())
            .count()
    };
    let request = audit(kernel).families(["edge-near"]).count(100);
    assert_eq!(with_causes(&request), 0);
    assert!(0 < with_causes(&request.clone().attribute(10)));
    let text = request.explain("edge-near@2/f32/-/1/7").unwrap();
    assert!(text.starts_with("moller-trumbore (source): "), "{text}");
    let error = request.explain("edge-near").unwrap_err().to_string();
    assert!(error.contains("edge-near"), "{error}");
}

#[test]
fn a_promise_a_band_and_a_scene_change_what_is_asked() {
    let kernel = KERNELS
        .iter()
        .find(|entry| entry.info.name == "moller-trumbore")
        .unwrap();
    let scene = |request: Request| request.scene("room").families(["scene-edges"]).count(500);
    let findings = |request: &Request| -> Vec<FindingKind> {
        let outcome = request.run().unwrap();
        let found = disagreements(&outcome.record.result);
        found.iter().map(|found| found.key.finding).collect()
    };
    let plain = scene(audit(kernel));
    // At a shared edge a neighbour may take the ray, so only cracks count, and only a promise forbids them.
    let promised = plain.clone().promise(Across::AtLeastOne);
    for (request, conforms) in [(&plain, true), (&promised, false)] {
        let found = findings(request);
        assert!(
            !found.is_empty() && found.iter().all(|finding| *finding == FindingKind::Crack),
            "{found:?}"
        );
        assert_eq!(request.run().unwrap().conforms(), conforms);
    }
    // As the guide has it: a test without a crack passes whatever single triangles say.
    let crackless = |name: &str| {
        let entry = KERNELS
            .iter()
            .find(|entry| entry.info.name == name)
            .unwrap();
        let request = scene(audit(entry))
            .promise(Across::AtLeastOne)
            .allow("crack", 1e-3);
        request.run().unwrap().conforms()
    };
    assert_eq!(
        ["woop-watertight", "moller-trumbore"].map(crackless),
        [true, false]
    );
    // At an edge everything is within a hundredth of a triangle's size.
    assert_eq!(findings(&plain.clone().band("0.01")), []);
    for (request, part) in [
        (plain.clone().band("wide"), "band: "),
        (plain.clone().scene("castle"), "scene: "),
        (
            plain.clone().families(["edge-near"]),
            "unknown family 'edge-near'",
        ),
        (
            plain.clone().allow("crash", 0.1),
            "expected one of false-miss",
        ),
        (
            plain.clone().allow("crack", f64::NAN),
            "a share from 0 to 1",
        ),
    ] {
        let error = request.run().unwrap_err().to_string();
        assert!(error.contains(part), "{part}: {error}");
    }
}
