//! What must hold for every input, whatever its kernel gets wrong: the parts of this crate agree with
//! each other. A kernel's own disagreements are told apart from these.

use hairline::internals::arith::Float;
use hairline::internals::audit::{CorpusSet, Source, Unobserved};
use hairline::internals::case::{Case, Draw};
use hairline::internals::corpus::lines::AnyCase;
use hairline::internals::epsilon::{
    Attempt, Knob, Pass, RayCount, Rays, Setting, WrongKind, count_at,
};
use hairline::internals::explore::inputs::{Input, of_kernel};
use hairline::internals::explore::{Signature, mutate};
use hairline::internals::judge::{self, Obligation};
use hairline::internals::kernel::{KernelIn, Scalar, Tunable, Verdict, refused_by};
use hairline::internals::oracle::{self, Batch, Layers};
use hairline::internals::truth::Truth;
use std::fmt;

/// Two parts of this crate disagree: a bug in one of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Contradiction(String);

impl fmt::Display for Contradiction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Contradiction {}

fn agree<T: PartialEq + fmt::Debug>(
    about: &dyn fmt::Display,
    left: T,
    right: T,
) -> Result<(), Contradiction> {
    if left == right {
        return Ok(());
    }
    Err(Contradiction(format!("{about}: {left:?} and {right:?}")))
}

/// The oracle, one by one, in lanes and in columns, gives the truth of its definition in rationals, and its numbers.
pub fn check_oracle<F: Float>(case: &Case<F>) -> Result<(), Contradiction> {
    let (defined, found) = (oracle::define(case), oracle::truth(case));
    let about = format!("{} {}", F::NAME, case.hex());
    agree(
        &format!("the oracle and its definition on {about}"),
        found,
        defined.truth,
    )?;
    let numbers = oracle::exact_values(case, &found);
    agree(
        &format!("exact values and their definition on {about}"),
        numbers,
        defined.exact,
    )?;
    // The neighbours need other layers.
    let others = (0..16).map(|i| mutate(case, &mut Draw::new("lanes", 1, i)));
    let some: Vec<Case<F>> = std::iter::once(*case).chain(others).collect();
    let cases: Vec<Case<F>> = (0..4 * some.len()).map(|i| in_lanes(&some, i)).collect();
    let single: Vec<Truth> = cases.iter().map(oracle::truth).collect();
    let (mut truths, mut layers) = (Vec::new(), Layers::default());
    oracle::truths(&cases, &mut truths, &mut layers);
    agree(
        &format!("truths in lanes and one by one about {about}"),
        &truths,
        &single,
    )?;
    let mut batch = Batch::new();
    cases.iter().for_each(|case| batch.push(case));
    let mut in_columns = Vec::new();
    batch.truths(&mut in_columns, &mut layers);
    agree(
        &format!("truths in columns and one by one about {about}"),
        in_columns,
        single,
    )
}

/// Every fourth of many cases is one of some, each time in another lane of four: with 17 they fill two of the groups
/// of 32 that the filter takes together, and a rest. The others are decided quickly.
fn in_lanes<F: Float>(some: &[Case<F>], i: usize) -> Case<F> {
    let quick = || {
        let float = |v: [f64; 3]| v.map(F::from_f64);
        let triangle = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        Case::new(
            float([0.25, 0.25, 1.0]),
            float([0.0, 0.0, -1.0]),
            triangle.map(float),
        )
    };
    if i % 4 == i / 4 % 4 {
        some[i / 4]
    } else {
        quick()
    }
}

fn verdict<F: Float>(subject: &dyn KernelIn<F>, case: &Case<F>, epsilons: &[F]) -> Verdict<F> {
    let mut verdict = [Verdict::miss(None)];
    subject.run(std::slice::from_ref(case), epsilons, &mut verdict);
    verdict[0]
}

/// A kernel's run agrees with its margins: at the given epsilons, at each margin and just above it.
pub fn check_kernel<F: Scalar>(input: &Input<F>) -> Result<(), Contradiction> {
    let Input {
        entry,
        epsilons,
        case,
    } = input;
    let (subject, gated) = of_kernel::<F>(entry);
    let about = format!(
        "{} {} {epsilons:?} on {}",
        entry.info.name,
        F::NAME,
        case.hex()
    );
    let measured = gated.measure(case);
    let margins = &measured.margins;
    let refusal = |epsilons: &[F]| {
        let verdict = verdict(subject, case, epsilons);
        (verdict.hit, verdict.refused_by.map(usize::from))
    };
    let told = |epsilons: &[F]| {
        let refused = refused_by(margins, epsilons);
        (refused.is_none(), refused)
    };
    agree(
        &format!("run and margins of {about}"),
        refusal(epsilons),
        told(epsilons),
    )?;
    let most = F::infinity().offset_ulps(-1);
    let at: Vec<F> = margins
        .iter()
        .map(|m| if most < *m { most } else { *m })
        .collect();
    if at.iter().any(|margin| *margin < -most) {
        return Ok(());
    }
    agree(
        &format!("margins accept {about}"),
        refusal(&at),
        (true, None),
    )?;
    for gate in (0..at.len()).filter(|&gate| margins[gate] < most) {
        let mut above = at.clone();
        above[gate] = above[gate].offset_ulps(1);
        let about = format!("above the margin of gate {gate} of {about}");
        agree(&about, refusal(&above), (false, Some(gate)))?;
    }
    Ok(())
}

/// What the kernel of an input gets wrong under its own contract; none if nothing.
pub fn disagreement<F: Scalar>(input: &Input<F>) -> Option<Signature> {
    Signature::of(&input.row(), &input.case)
}

/// A study of epsilons says of a case and some of its neighbours, gate by gate, how often the kernel is wrong when it
/// is run: at the given epsilon, at each case's margin and beside it.
pub fn check_response<F: Scalar>(input: &Input<F>) -> Result<(), Contradiction>
where
    AnyCase: From<Case<F>>,
{
    let Input {
        entry,
        epsilons,
        case,
    } = input;
    let mut cases = vec![*case];
    cases.extend((0..7).map(|i| mutate(case, &mut Draw::new("response", 1, i))));
    let (row, (subject, gated)) = (input.row(), of_kernel::<F>(entry));
    let asked = |case| judge::asked(case, &oracle::truth(case), &row.contract, false);
    let asked: Vec<Obligation> = cases.iter().map(asked).collect();
    let sources = [Source::stored(stored(&cases), None)];
    let gates = entry.info.gates;
    let tunable = (0..gates.len()).filter(|gate| gates[*gate].epsilon != Tunable::Fixed);
    for gate in tunable {
        let knobs = [Knob::Gate(gate)];
        let counts = [WrongKind::Miss, WrongKind::Hit].map(|kind| RayCount {
            rays: Rays::Stored,
            kind,
        });
        let setting = Setting {
            row: &row,
            subject,
            knobs: &knobs,
            counts: &counts,
            scene: None,
            sources: &sources,
            mesh: None,
            relative: false,
            fine_curves: false,
            store: None,
            shared: None,
        };
        let margin = |case: &Case<F>| gated.measure(case).margins[gate];
        let margins = cases.iter().map(margin).filter(|margin| margin.is_finite());
        let about = margins.flat_map(|m| [m.offset_ulps(-1), m, m.offset_ulps(1)]);
        let is_taken = |e: &F| gates[gate].epsilon == Tunable::Signed || F::zero() <= *e;
        let about = about
            .chain([epsilons[gate]])
            .filter(|e| is_taken(e) && e.is_finite());
        let about: Vec<F> = about.collect();
        let attempts: Vec<_> = about.iter().map(|e| Attempt::new(vec![*e])).collect();
        let told = count_at(&setting, &attempts, Pass::new(1, 1, &Unobserved));
        for (epsilon, told) in about.iter().zip(told) {
            let mut at = epsilons.clone();
            at[gate] = *epsilon;
            let wrong = |obligation: Obligation, hit: bool| {
                let all = cases
                    .iter()
                    .zip(&asked)
                    .filter(|(_, asked)| **asked == obligation);
                all.filter(|(case, _)| verdict(subject, case, &at).hit == hit)
                    .count() as u64
            };
            let run = [
                wrong(Obligation::MustHit, false),
                wrong(Obligation::MustMiss, true),
            ];
            let name = entry.info.name;
            let about = format!("response and run of {name} at {at:?} about {}", case.hex());
            agree(&about, [told[0].count, told[1].count], run)?;
        }
    }
    Ok(())
}

fn stored<F: Float>(cases: &[Case<F>]) -> CorpusSet
where
    AnyCase: From<Case<F>>,
{
    let mut set = CorpusSet {
        file: "fuzz".to_owned(),
        ..CorpusSet::default()
    };
    for case in cases {
        match AnyCase::from(*case) {
            AnyCase::F32(case) => set.f32.push((String::new(), case)),
            AnyCase::F64(case) => set.f64.push((String::new(), case)),
        }
    }
    set
}
