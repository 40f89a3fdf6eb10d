//! What a study of epsilons counts by margins is what the audit finds when it runs the kernel at those epsilons.

use hairline::internals::audit::{
    self, EpsilonChoice, EpsilonText, Observer, Plan, Row, Source, Tally,
};
use hairline::internals::case::{Draw, Parameters};
use hairline::internals::epsilon::{
    Attempt, Knob, Pass, RayCount, Setting, WrongKind, count_at, counts_of,
};
use hairline::internals::family::find;
use hairline::internals::judge::Finding;
use hairline::internals::kernel::{KERNELS, Scalar, Tunable};

struct Silent;

impl Observer for Silent {
    fn advance(&self, _: u64) {}
    fn now(&self) -> u64 {
        0
    }
}

const FAMILIES: [&str; 12] = [
    "edge-exact",
    "edge-near",
    "vertex-near",
    "coplanar",
    "grazing",
    "origin-near",
    "secondary-ray",
    "tiny",
    "range-ends",
    "invalid",
    "shared-edge",
    "fan",
];

fn source(name: &str, count: u64) -> Source {
    Source::of(
        find(name).expect("a family"),
        Parameters::default(),
        1,
        count,
    )
}

fn base_rows() -> Vec<Row> {
    let entries: Vec<_> = KERNELS.iter().collect();
    let mut rows = EpsilonChoice::Source
        .rows(&entries, None)
        .expect("the default plan");
    rows.dedup_by(|second, first| second.entry.info.name == first.entry.info.name);
    rows
}

/// The knobs of a row that are gates: only those does an audit run.
fn gates(row: &Row) -> Vec<Knob> {
    let gates = row.entry.info.gates.iter().enumerate();
    let tunable = gates.filter(|(_, gate)| gate.epsilon != Tunable::Fixed);
    tunable.map(|(place, _)| Knob::Gate(place)).collect()
}

fn setting<'a, F: Scalar>(
    row: &'a Row,
    knobs: &'a [Knob],
    counts: &'a [RayCount],
    sources: &'a [Source],
) -> Setting<'a, F> {
    let subject = F::subject(row.entry).unwrap();
    let (scene, mesh, store, shared) = (None, None, None, None);
    let (relative, fine_curves) = (false, false);
    Setting {
        row,
        subject,
        knobs,
        counts,
        scene,
        sources,
        mesh,
        relative,
        fine_curves,
        store,
        shared,
    }
}

/// What the audit counts on one source.
fn audited<F: Scalar>(row: &Row, source: &Source, knobs: &[Knob], epsilons: &[F]) -> Tally {
    let mut row = row.clone();
    for (knob, epsilon) in knobs.iter().zip(epsilons) {
        let Knob::Gate(gate) = *knob else {
            unreachable!("gates only")
        };
        row.epsilons[gate] = EpsilonText::Decimal(format!("{epsilon:e}"));
        assert!(
            row.epsilons::<F>()[gate] == *epsilon,
            "the text is the number"
        );
    }
    let scalars = F::NAME.alone();
    let plan = Plan::new(vec![row], vec![source.clone()], scalars, 0);
    audit::run(&plan, &Silent).cells.remove(0).tally
}

fn counts_agree_with_running<F: Scalar>() {
    let mut draw = Draw::new("response", 1, 0);
    let mut compared = 0;
    for row in base_rows() {
        let knobs = gates(&row);
        if knobs.is_empty() {
            continue;
        }
        for name in FAMILIES {
            let sources = [source(name, 60)];
            let counts = counts_of(&sources, &knobs, &row);
            let setting = setting::<F>(&row, &knobs, &counts, &sources);
            for _ in 0..8 {
                let epsilon = |knob: &Knob| {
                    let size = F::from_f64(10f64.powi(draw.integer(-16, 1) as i32));
                    let signed = knob.takes_negative(row.entry.info.gates);
                    [size, F::zero(), if signed { -size } else { size }][draw.below(3)]
                };
                let epsilons: Vec<F> = knobs.iter().map(epsilon).collect();
                let attempt = [Attempt::new(epsilons.clone())];
                let found = count_at(&setting, &attempt, Pass::new(1, 60, &Silent)).remove(0);
                let tally = audited(&row, &sources[0], &knobs, &epsilons);
                let total = tally.total();
                for (count, found) in counts.iter().zip(found) {
                    let run = match count.kind {
                        WrongKind::Miss => total.of(Finding::FalseMiss),
                        WrongKind::Hit => total.of(Finding::FalseHit),
                        WrongKind::Crack => tally.groups.cracks,
                        WrongKind::SelfHit => tally.self_hits.hits,
                    };
                    let kernel = row.entry.info.name;
                    let told = format!("{kernel} {} at {epsilons:?} on {name}", F::NAME);
                    assert_eq!(found.count, run, "{told}: {:?}", count.kind);
                    compared += run;
                }
            }
        }
    }
    assert!(10_000 < compared, "{compared}");
}

#[test]
fn counts_by_margins_agree_with_running_in_f32() {
    counts_agree_with_running::<f32>();
}

#[test]
fn counts_by_margins_agree_with_running_in_f64() {
    counts_agree_with_running::<f64>();
}

#[test]
fn counts_do_not_depend_on_the_number_of_threads() {
    let row = &base_rows()[0];
    let knobs = gates(row);
    let sources = FAMILIES.map(|name| source(name, 5000));
    let counts = counts_of(&sources, &knobs, row);
    let setting = setting::<f32>(row, &knobs, &counts, &sources);
    let attempt = [Attempt::new(vec![1e-6; knobs.len()])];
    let with = |threads: usize| {
        let stock = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        stock.install(|| count_at(&setting, &attempt, Pass::new(1, 5000, &Silent)))
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(7));
}
