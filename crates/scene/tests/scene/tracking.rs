//! A particle that follows exact answers is lost by rounding alone, and one that follows kernels by their answers too.

use crate::track::{Losses, Parts, Program, Reason, follow};
use hairline_core::Scalar;

const STEPS: u64 = 4000;

fn losses<F: Scalar>() -> Vec<(&'static str, Losses)> {
    let parts = Parts::<F>::new();
    let all = Program::all().into_iter();
    all.map(|(name, program)| (name, follow(&parts, &program, 1, STEPS)))
        .collect()
}

/// How often a particle was lost for some reasons.
fn count(losses: &Losses, is_reason: impl Fn(Reason) -> bool) -> u64 {
    let some = losses.iter().filter(|((_, reason), _)| is_reason(*reason));
    some.map(|(_, count)| count).sum()
}

fn check<F: Scalar>() {
    let all = losses::<F>();
    assert!(10 < all.len());
    let is_wrong = |reason| matches!(reason, Reason::Wrong(_));
    for (name, losses) in &all {
        // Touched edges and offsets lose few, with whatever kernel.
        let of_all = count(losses, |reason| !is_wrong(reason));
        assert!(of_all < STEPS / 50, "{name} {losses:?}");
    }
    let of = |name: &str| {
        let found = all.iter().find(|(other, _)| *other == name);
        count(&found.unwrap().1, is_wrong)
    };
    assert_eq!(of("exact"), 0);
    assert!(
        of("woop-watertight") < 10 && 10 * of("woop-watertight") < of("plane-inside-out-strict")
    );
    assert!(20 < of("plane-inside-out-strict") && 5 < of("moller-trumbore"));
}

/// openmc-dev/openmc#3600 and svalinn/DAGMC#986: particles that are lost in closed parts.
#[test]
fn openmc_3600_and_dagmc_986() {
    check::<f32>();
    check::<f64>();
}

/// svalinn/DAGMC#986: the particle of the report is in the wall of a cube of 120, and not lost.
#[test]
fn dagmc_986() {
    let at = [
        -59.750_000_000_000_01,
        -20.311_014_690_968_396,
        -39.065_376_794_309_4,
    ];
    let direction = [
        -0.713_760_495_335_717_4,
        -0.685_108_337_656_646_4,
        -0.145_507_803_816_352_03,
    ];
    Parts::<f64>::new().check_wall(at, direction);
}
