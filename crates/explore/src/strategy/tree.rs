//! Drawing cases from families, and shrinking them by the search's simplifications.

use super::promise::StrategyPromise;
use crate::arith::Float;
use crate::case::{Case, Parameters};
use crate::kernel::Scalar;
use crate::simplify::{Simplification, Size};
use proptest::prelude::any;
use proptest::strategy::{NewTree, Strategy, ValueTree};
use proptest::test_runner::TestRunner;
use std::marker::PhantomData;
use std::sync::LazyLock;

static STEPS: LazyLock<Vec<Simplification>> = LazyLock::new(Simplification::all);

/// The cases of some families: all triangles of one ray.
pub struct FamilyCases<F> {
    promises: Vec<&'static StrategyPromise>,
    scalar: PhantomData<fn() -> F>,
}

impl<F> FamilyCases<F> {
    pub(super) fn new(promises: Vec<&'static StrategyPromise>) -> Self {
        FamilyCases {
            promises,
            scalar: PhantomData,
        }
    }
}

impl<F> std::fmt::Debug for FamilyCases<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list()
            .entries(self.promises.iter().map(|promise| promise.name()))
            .finish()
    }
}

impl<F: Scalar> Strategy for FamilyCases<F> {
    type Tree = CaseTree<F>;
    type Value = Vec<Case<F>>;

    fn new_tree(&self, runner: &mut TestRunner) -> NewTree<Self> {
        let seed = any::<u64>().new_tree(runner)?.current();
        let promise = self.promises[(seed % self.promises.len() as u64) as usize];
        // Some families promise a little less than their strategy: most indices keep it.
        (0..1000)
            .map(|i| {
                promise
                    .family()
                    .make::<F>(&Parameters::default(), seed, i)
                    .cases()
                    .to_vec()
            })
            .find(|cases| promise.keeps(cases))
            .map(|cases| CaseTree::new(promise, cases))
            .ok_or_else(|| format!("'{}' keeps no promise", promise.name()).into())
    }
}

/// The triangles of one ray, and which simpler ones were tried.
#[derive(Clone)]
pub struct CaseTree<F: Float> {
    promise: &'static StrategyPromise,
    /// The last ones that failed the test; those drawn, at first.
    failing: Vec<Case<F>>,
    current: Vec<Case<F>>,
    /// A place in the list of steps, and how many in a row led nowhere.
    next: usize,
    idle: usize,
}

impl<F: Float> std::fmt::Debug for CaseTree<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("CaseTree")
            .field(&self.promise.name())
            .field(&self.current)
            .finish()
    }
}

impl<F: Scalar> CaseTree<F> {
    fn new(promise: &'static StrategyPromise, cases: Vec<Case<F>>) -> Self {
        CaseTree {
            promise,
            failing: cases.clone(),
            current: cases,
            next: 0,
            idle: 0,
        }
    }

    /// To the next simpler cases that keep the promise; back to the failing ones if there are none.
    fn advance(&mut self) -> bool {
        let steps = STEPS.len() * self.failing.len();
        let size = total_size(&self.failing);
        while self.idle < steps {
            let (triangle, step) = (self.next / STEPS.len(), STEPS[self.next % STEPS.len()]);
            let candidate = applied(step, &self.failing, triangle);
            if total_size(&candidate) < size && self.promise.keeps(&candidate) {
                self.current = candidate;
                return true;
            }
            self.skip(steps);
        }
        self.current.clone_from(&self.failing);
        false
    }

    fn skip(&mut self, steps: usize) {
        self.next = (self.next + 1) % steps;
        self.idle += 1;
    }
}

impl<F: Scalar> ValueTree for CaseTree<F> {
    type Value = Vec<Case<F>>;

    fn current(&self) -> Vec<Case<F>> {
        self.current.clone()
    }

    /// The current cases fail the test: on from them.
    fn simplify(&mut self) -> bool {
        self.failing.clone_from(&self.current);
        self.idle = 0;
        self.advance()
    }

    /// They pass it: another step from the last ones that failed.
    fn complicate(&mut self) -> bool {
        let steps = STEPS.len() * self.failing.len();
        if self.idle < steps {
            self.skip(steps);
        }
        self.advance()
    }
}

/// As [`Size`] orders cases: bits, different values, and the rest case by case.
fn total_size<F: Float>(cases: &[Case<F>]) -> (u32, usize, Vec<Size>) {
    let sizes: Vec<Size> = cases.iter().map(Size::of).collect();
    let bits = sizes.iter().map(|size| size.bits).sum();
    (bits, sizes.iter().map(|size| size.values).sum(), sizes)
}

/// One step on all triangles of a ray: what changes all points alike is done to each, any other step is
/// done to one triangle, and the others follow where they share a vertex with it.
fn applied<F: Float>(step: Simplification, cases: &[Case<F>], triangle: usize) -> Vec<Case<F>> {
    use Simplification::*;
    let to_each = matches!(
        step,
        DefaultInterval(_) | TurnHalf(_) | MoveToZero { point: 0, .. } | Scale { .. }
    );
    if to_each {
        return cases.iter().map(|case| step.apply(case)).collect();
    }
    let (old, new) = (&cases[triangle], step.apply(&cases[triangle]));
    let [before, after] =
        [old, &new].map(|case| case.triangle.vertices().map(Into::<[F; 3]>::into));
    let follow = |case: &Case<F>| {
        let vertices = case.triangle.vertices().map(|vertex| {
            let vertex: [F; 3] = vertex.into();
            before
                .iter()
                .position(|old| *old == vertex)
                .map_or(vertex, |i| after[i])
        });
        let [origin, direction, ..] = new.vectors();
        Case::new(origin, direction, vertices).on(new.ray.t_min, new.ray.t_max)
    };
    let others = cases.iter().enumerate();
    others
        .map(|(i, case)| if i == triangle { new } else { follow(case) })
        .collect()
}
