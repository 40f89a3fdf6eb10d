//! A response says at every epsilon what the audit finds when it runs the kernel at that epsilon.

use hairline::internals::audit::{self, EpsilonChoice, EpsilonText, Observer, Plan, Row, Source};
use hairline::internals::case::{Draw, Parameters};
use hairline::internals::epsilon::{Axis, Question, Request, Response, run, tunable_gates};
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

fn sources(count: u64) -> Vec<Source> {
    let source = |name: &&str| Source::Family {
        family: find(name).expect("a family"),
        parameters: Parameters::default(),
        seed: 1,
        count,
        exhaustive: false,
    };
    FAMILIES.iter().map(source).collect()
}

fn base_rows() -> Vec<Row> {
    let entries: Vec<_> = KERNELS.iter().collect();
    let mut rows = EpsilonChoice::Source.rows(&entries, None).expect("the default plan");
    rows.dedup_by(|second, first| second.entry.info.name == first.entry.info.name);
    rows
}

/// Epsilons where a count changes, their neighbours, edges, and ordinary ones.
fn epsilons<F: Scalar>(draw: &mut Draw, axis: &Axis<F>, response: &Response<F>) -> Vec<F> {
    let steps: Vec<F> = response.curves.iter().flat_map(|curve| curve.steps()).collect();
    let mut chosen = vec![F::zero(), F::from_f64(1e-6)];
    for _ in 0..6 {
        if let Some(near) = (!steps.is_empty()).then(|| draw.pick(&steps)) {
            chosen.push(near.offset_ulps(draw.integer(-1, 1)));
        }
        chosen.push(draw.pick(axis.edges()));
    }
    chosen.retain(|e| e.is_finite());
    chosen
}

/// What the audit counts on one source, by [`Question::ALL`]; a group question only where groups are.
fn audited<F: Scalar>(row: &Row, source: Source, gate: usize, epsilon: F) -> [u64; 5] {
    let mut row = row.clone();
    row.epsilons[gate] = EpsilonText::Decimal(format!("{epsilon:e}"));
    assert!(row.epsilons::<F>()[gate] == epsilon, "the text is the number");
    let scalars = [F::NAME == "f32", F::NAME == "f64"];
    let plan = Plan { rows: vec![row], sources: vec![source], scalars, examples: 0, attribute: 0 };
    let tally = &audit::run(&plan, &Silent).cells[0].tally;
    let total = tally.total();
    [
        total.of(Finding::FalseMiss),
        total.of(Finding::FalseHit),
        tally.groups.cracks,
        tally.groups.doubles,
        tally.self_hits.hits,
    ]
}

fn responses_agree_with_running<F: Scalar>(exact: bool) {
    let mut draw = Draw::new("response", 1, u64::from(exact));
    let count = 60;
    let axis = Axis::<F>::new(&[F::from_f64(1e-6)]);
    for row in base_rows() {
        let gates = tunable_gates(row.entry.info.gates);
        let subject = F::subject(row.entry).unwrap();
        let request = Request { row: &row, subject, gates: &gates, axis: &axis, exact };
        let responses = run(&request, &sources(count), &Silent);
        for (number, source) in responses.iter().enumerate() {
            for response in &source.gates {
                for epsilon in epsilons(&mut draw, &axis, response) {
                    let below_zero = epsilon < F::zero();
                    let gate = &row.entry.info.gates[response.gate];
                    if below_zero && gate.epsilon == Tunable::NonNegative {
                        continue;
                    }
                    let source = sources(count).swap_remove(number);
                    let told = format!(
                        "{} {} {} e = {epsilon:e} on {}",
                        row.entry.info.name,
                        F::NAME,
                        gate.name,
                        source.name()
                    );
                    let counts = audited(&row, source, response.gate, epsilon);
                    for (question, count) in Question::ALL.into_iter().zip(counts) {
                        let wrong = response.curve(question).wrong(epsilon);
                        assert!(wrong.low <= count && count <= wrong.high, "{told}: {question:?}");
                        if exact || axis.edges().contains(&epsilon) {
                            assert_eq!(wrong.exact(), Some(count), "{told}: {question:?}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn responses_agree_with_running_in_f32() {
    responses_agree_with_running::<f32>(false);
    responses_agree_with_running::<f32>(true);
}

#[test]
fn responses_agree_with_running_in_f64() {
    responses_agree_with_running::<f64>(false);
    responses_agree_with_running::<f64>(true);
}

#[test]
fn a_response_does_not_depend_on_the_number_of_threads() {
    let row = &base_rows()[0];
    let gates = tunable_gates(row.entry.info.gates);
    let axis = Axis::<f32>::new(&[]);
    let subject = f32::subject(row.entry).unwrap();
    let request = Request { row, subject, gates: &gates, axis: &axis, exact: false };
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let responses = pool.install(|| run(&request, &sources(5000), &Silent));
        responses.into_iter().map(|source| source.gates).collect::<Vec<_>>()
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(7));
}
