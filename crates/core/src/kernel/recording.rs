//! A kernel's straight-line programs, one a path, with the quantities that its gates compare.

use super::{Kernel, Refuse, Sink};
use crate::arith::recorded::{
    Comparison, Operation, Outcome, Place, Recorded, asked_from, asked_so_far, decisions_so_far,
    next_script, outcomes, record,
};
use crate::arith::{Arithmetic, Real};
use crate::case::Target;

/// How many paths a kernel may have. Woop's has 2,304.
const MOST_PATHS: usize = 1 << 14;

/// How many ways there may be through the comparisons of one gate. Plücker's has 13.
const MOST_OUTCOMES: usize = 1 << 10;

/// A kernel's run along one path.
#[derive(Clone, Debug)]
pub struct Path {
    /// The program.
    pub operations: Vec<Operation>,
    /// The comparisons that chose the path, and their answers.
    pub decisions: Vec<(Comparison, bool)>,
    /// The quantities that the gates compare, in order.
    pub compared: Vec<Compared>,
    /// True if it is a hit when every gate accepts; false if something refuses it that is not a gate.
    pub hits: bool,
    /// Its t, u and v of a hit, if it reports them.
    pub values: [Option<Place>; 3],
}

/// The quantities that a gate compares, and how it decides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Compared {
    /// Which gate.
    pub gate: usize,
    /// How it decides.
    pub accepts: Acceptance,
    /// Its quantities.
    pub quantities: Vec<Place>,
    /// How many decisions of the path come before.
    pub decisions: usize,
}

impl Compared {
    /// True if its quantities are compared with the epsilon itself; false if with 0, or with each other.
    pub fn is_margin(&self) -> bool {
        matches!(self.accepts, Acceptance::Clauses(..))
    }
}

/// How a gate decides.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Acceptance {
    /// It accepts if all quantities of some clause pass a comparison with its epsilon.
    Clauses(Refuse, Vec<Vec<Place>>),
    /// It rounds with its epsilon: every way through its comparisons at an epsilon of 0.
    Rounded(Vec<Outcome>),
    /// It takes no epsilon: the comparisons since the fixed test before, and whether it accepts on this path.
    Fixed(Vec<Comparison>, bool),
}

/// The sink that writes down what each gate compares, and goes on.
#[derive(Debug, Default)]
struct Recording {
    compared: Vec<Compared>,
    /// The comparisons before this place belong to no later fixed test.
    asked: usize,
    /// True if a gate compares in more ways than can be written down.
    is_too_wide: bool,
    /// Which of the comparisons is refused; else it never stops.
    refused: Option<usize>,
}

impl Recording {
    fn note(&mut self, gate: usize, accepts: Acceptance, mut quantities: Vec<Place>) -> Option<()> {
        quantities.sort_unstable();
        quantities.dedup();
        let decisions = decisions_so_far();
        self.compared.push(Compared {
            gate,
            accepts,
            quantities,
            decisions,
        });
        (self.refused != Some(self.compared.len() - 1)).then_some(())
    }
}

impl Sink<Recorded> for Recording {
    fn gate<const M: usize, const N: usize>(
        &mut self,
        gate: usize,
        refuse: Refuse,
        clauses: [[&Recorded; N]; M],
    ) -> Option<()> {
        let clauses = clauses
            .map(|clause| clause.map(Recorded::place).to_vec())
            .to_vec();
        let quantities = clauses.concat();
        self.note(gate, Acceptance::Clauses(refuse, clauses), quantities)
    }

    fn rounded(
        &mut self,
        gate: usize,
        accepts: impl Fn(&Recorded) -> bool,
        _: impl FnOnce() -> Recorded,
    ) -> Option<()> {
        let zero = Recorded::zero();
        let outcomes = outcomes(MOST_OUTCOMES, || accepts(&zero));
        self.is_too_wide |= outcomes.is_none();
        let outcomes = outcomes.unwrap_or_default();
        let compared = outcomes.iter().flat_map(|outcome| &outcome.answers);
        let quantities = compared
            .flat_map(|(comparison, _)| comparison.places())
            .collect();
        self.note(gate, Acceptance::Rounded(outcomes), quantities)
    }

    /// Notes all comparisons since the fixed test before.
    fn fixed(&mut self, gate: usize, accepts: bool) -> Option<()> {
        let compared = asked_from(self.asked);
        self.asked = asked_so_far();
        let quantities = compared.iter().flat_map(Comparison::places).collect();
        self.note(gate, Acceptance::Fixed(compared, accepts), quantities)
    }
}

/// Every path of a kernel in an arithmetic; an error in one sentence if it has no program, or too many paths.
pub(super) fn paths<T: Target, K: Kernel<T>>(arithmetic: Arithmetic) -> Result<Vec<Path>, String> {
    if arithmetic.flushed {
        return Err("its arithmetic flushes subnormal numbers to zero".to_owned());
    }
    let mut paths = Vec::new();
    let mut script = Vec::new();
    loop {
        let ((sink, hit), tape) = record(&script, arithmetic, || run::<T, K>(None));
        let decisions = tape.decisions.made;
        if tape.operations.contains(&Operation::INFINITY) {
            return Err("it computes with infinity".to_owned());
        }
        if let Some(question) = tape.unanswered {
            return Err(question.to_owned());
        }
        if sink.is_too_wide {
            return Err(format!("a gate compares in more than {MOST_OUTCOMES} ways"));
        }
        let next = next_script(&decisions);
        let compared = sink.compared;
        for (
            number,
            Compared {
                gate,
                decisions: before,
                ..
            },
        ) in compared.iter().enumerate()
        {
            // Paths that begin alike come one after the other, and the gate refuses all of them alike.
            let decided = |path: &Path| path.decisions.get(..*before) == decisions.get(..*before);
            if paths.last().is_some_and(decided) {
                continue;
            }
            let refused = || run::<T, K>(Some(number));
            let ((sink, hit), tape) = record(&script, arithmetic, refused);
            let goes_on = sink.compared.len() > number + 1 || tape.decisions.made.len() > *before;
            if hit.is_some() || goes_on {
                let name = K::INFO.gates[*gate].name;
                return Err(format!("it goes on after gate '{name}' has refused"));
            }
        }
        let values = hit.unwrap_or_default();
        paths.push(Path {
            operations: tape.operations,
            compared,
            decisions,
            hits: hit.is_some(),
            values,
        });
        if paths.len() > MOST_PATHS {
            return Err(format!("its program has more than {MOST_PATHS} paths"));
        }
        match next {
            Some(next) => script = next,
            None => return Ok(paths),
        }
    }
}

/// Records a run: the gates' comparisons, of which one may refuse, and t, u and v if the run is a hit.
fn run<T: Target, K: Kernel<T>>(refused: Option<usize>) -> (Recording, Option<[Option<Place>; 3]>) {
    let (ray, shape) = T::placed(|i| Recorded::input(i as u8));
    let mut sink = Recording {
        refused,
        ..Recording::default()
    };
    let prepared = K::prepare(&shape);
    sink.asked = asked_so_far();
    let hit = K::test(&prepared, &ray, &mut sink).map(|hit| {
        let (u, v) = hit.uv.unzip();
        [hit.t, u, v].map(|value| value.map(|value| value.place()))
    });
    (sink, hit)
}
