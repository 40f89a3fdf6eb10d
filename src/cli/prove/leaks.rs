//! Rays that leak: where a kernel is not proved watertight, one that both triangles of an edge refuse.

use crate::audit::{self, EpsilonChoice, Plan, Row, Source, Unobserved};
use crate::case::Parameters;
use crate::contract::Direction;
use crate::family;
use crate::kernel::{Entry, Role, Scalar, Tunable};
use crate::report::proofs::Leak;

/// How many rays are tried, most of them within a few ulps of the edge.
const TRIES: u64 = 20_000;

/// The first ray of the family `shared-edge` that crosses both triangles together, by the exact truth, and that the
/// gates of edges refuse in both, at an epsilon of 0.
pub fn leak<F: Scalar>(entry: &'static Entry) -> Option<Leak> {
    let gates = entry.info.gates;
    let is_zero = |role: Role| matches!(role, Role::Edge | Role::Parallel);
    let zeros = gates
        .iter()
        .filter(|gate| is_zero(gate.role) && gate.epsilon != Tunable::Fixed);
    let zeros = zeros
        .map(|gate| format!("{}=0", gate.name))
        .collect::<Vec<_>>()
        .join(",");
    let choice = match &zeros[..] {
        "" => EpsilonChoice::Source,
        _ => EpsilonChoice::parse(&zeros).ok()?,
    };
    let row: Row = choice.rows(&[entry], None).ok()?.into_iter().next()?;
    let family = family::find("shared-edge").expect("a family");
    let unit_direction = row.contract.direction != Direction::Any;
    let parameters = Parameters {
        unit_direction,
        ..Parameters::default()
    };
    let seed = 1;
    let source = Source::of(family, parameters.clone(), seed, TRIES);
    let scalars = F::NAME.alone();
    let (rows, sources) = (vec![row.clone()], vec![source]);
    let plan = Plan::new(rows, sources, scalars, 64);
    let cells = audit::run(&plan, &Unobserved).cells;
    let kernel = F::subject(entry)?.gated()?;
    let is_of_edges = |index: &&u64| {
        let made = family.make::<F>(&parameters, seed, **index);
        made.cases().iter().all(|case| {
            let margins = kernel.thresholds(case);
            let mut edges = gates
                .iter()
                .zip(&margins)
                .filter(|(gate, _)| gate.role == Role::Edge);
            edges.any(|(_, margin)| *margin < F::zero())
        })
    };
    let index = cells
        .first()?
        .tally
        .groups
        .first_cracks
        .iter()
        .find(is_of_edges)?;
    let case = family.id::<F>(&parameters, seed, *index).to_string();
    let command = row.explain_command(&audit::shell_word(&case));
    Some(Leak { case, command })
}
