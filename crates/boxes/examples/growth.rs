//! Which growth of the far end loses nothing, for the three formulas of t: on families, and in a search.
//! `cargo run --release -p hairline-boxes --example growth -- 100000 2000 20000` (cases, starts, steps).

use hairline_boxes::{
    BoxCase, FamilyScalar, Question, Scene, Search, Setup, Source, TABLE, epsilon, find_family,
    search,
};
use hairline_core::engine::Unobserved;
use hairline_core::kernel::{EpsilonText, Scalar};

const GROWTHS: [&str; 4] = ["0", "-EPSILON", "-2*EPSILON", "-3*EPSILON"];

/// The units in the last place by which an epsilon makes the far end larger.
fn units<F: FamilyScalar>(epsilon: F) -> f64 {
    (((F::one() - epsilon) - F::one()) / F::EPSILON).to_f64()
}

fn print<F: FamilyScalar + Scalar>(counts: [u64; 3]) {
    let [count, starts, steps] = counts;
    let mut sources: Vec<Source> = [
        "corner",
        "corner-near",
        "edge-near",
        "far",
        "in-face",
        "flat",
        "point",
        "origin-on",
    ]
    .iter()
    .filter_map(|name| find_family(name).ok())
    .map(Source::Family)
    .collect();
    sources.extend(
        [1.0, 64.0]
            .into_iter()
            .filter_map(|ratio| Scene::new(64.0, 64.0 / ratio).ok())
            .map(Source::Scene),
    );
    for name in ["divided", "multiplied", "fused"] {
        let Some(entry) = TABLE.find(name) else {
            continue;
        };
        let plain = Setup::published(entry).swap_remove(0);
        for source in &sources {
            let lost = GROWTHS.map(|growth| {
                let value = EpsilonText::of(growth).expect("an epsilon");
                let setup = plain.clone().with("growth", value).expect("a gate");
                let question = Question {
                    setup: &setup,
                    gate: "growth",
                    source: *source,
                    count,
                    seed: 1,
                };
                epsilon::<F>(&question, &Unobserved).expect("an answer")
            });
            let answer = &lost[0];
            let needed = answer.largest.map_or(0.0, |largest| units(largest.epsilon));
            println!(
                "{} {name:<10} {source:<22} must hit {:>6} lost anyway {:>5}, at 0, 1, 2, 3 units {:?}, needed {needed:.3e}; must miss {}, false hits {} -> {}",
                F::NAME,
                answer.must_hit,
                answer.lost_anyway,
                lost.each_ref().map(|answer| answer.lost_at_own),
                answer.must_miss,
                answer.false_hits_at_zero,
                answer.false_hits_at_largest
            );
        }
        let from = Search {
            setup: &plain,
            source: sources[1],
            starts,
            steps,
            seed: 1,
        };
        if let Ok(Some(found)) = search::<F>(&from, &Unobserved) {
            println!(
                "{} {name:<10} search: {:.3e} units, {}",
                F::NAME,
                units(found.margin),
                BoxCase::hex(&found.case)
            );
        }
    }
}

fn main() {
    let numbers: Vec<u64> = std::env::args()
        .skip(1)
        .filter_map(|text| text.parse().ok())
        .collect();
    let counts = [numbers.first(), numbers.get(1), numbers.get(2)];
    let [count, starts, steps] = counts.map(Option::<&u64>::copied);
    let counts = [
        count.unwrap_or(10_000),
        starts.unwrap_or(100),
        steps.unwrap_or(2_000),
    ];
    print::<f32>(counts);
    print::<f64>(counts);
}
