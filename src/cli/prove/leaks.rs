//! Rays that leak: where a kernel is not proved watertight, a ray that both triangles of an edge refuse.

use crate::audit::{self, EpsilonChoice, Plan, Row, Source, Unobserved};
use crate::case::{Case, Parameters};
use crate::contract::Direction;
use crate::family;
use crate::kernel::{Entry, Role, Scalar, Tunable};
use crate::report::proofs::Leak;

/// How many rays are tried, most of them within a few ulps of the edge.
const TRIES: u64 = 20_000;

const SEED: u64 = 1;

/// The first ray of the family `shared-edge` that crosses both triangles together, by the exact truth, and that the
/// gates of edges refuse in both, at an epsilon of 0.
pub fn leak<F: Scalar>(entry: &'static Entry) -> Option<Leak> {
    let row = with_zeros(entry)?;
    let family = family::find("shared-edge").expect("a family");
    let parameters = Parameters {
        unit_direction: row.contract.direction != Direction::Any,
        ..Parameters::default()
    };
    let source = Source::of(family, parameters.clone(), SEED, TRIES);
    let plan = Plan::new(vec![row.clone()], vec![source], F::NAME.alone(), 64);
    let cells = audit::run(&plan, &Unobserved).cells;
    let cracks = &cells.first()?.tally.groups.first_cracks;
    let is_refused_at_edges = |index: u64| {
        let made = family.make::<F>(&parameters, SEED, index);
        let mut cases = made.cases().iter();
        cases.all(|case| refuses_at_an_edge(entry, case))
    };
    let index = cracks.iter().find(|index| is_refused_at_edges(**index))?;
    let case = family.id::<F>(&parameters, SEED, *index).to_string();
    let command = row.explain_command(&audit::shell_word(&case));
    Some(Leak { case, command })
}

/// A kernel whose gates for edges and for parallel rays have an epsilon of 0, if they have one at all.
fn with_zeros(entry: &'static Entry) -> Option<Row> {
    let mut zeros = Vec::new();
    for gate in entry.info.gates {
        let is_zero = matches!(gate.role, Role::Edge | Role::Parallel);
        if is_zero && gate.epsilon != Tunable::Fixed {
            zeros.push(format!("{}=0", gate.name));
        }
    }
    let choice = if zeros.is_empty() {
        EpsilonChoice::Source
    } else {
        EpsilonChoice::parse(&zeros.join(",")).ok()?
    };
    choice.rows(&[entry], None).ok()?.into_iter().next()
}

/// True if a gate of an edge refuses a case at an epsilon of 0.
fn refuses_at_an_edge<F: Scalar>(entry: &Entry, case: &Case<F>) -> bool {
    let Some(kernel) = F::subject(entry).and_then(|subject| subject.gated()) else {
        return false;
    };
    let thresholds = kernel.thresholds(case);
    let mut gates = entry.info.gates.iter().zip(thresholds);
    gates.any(|(gate, threshold)| gate.role == Role::Edge && threshold < F::zero())
}
