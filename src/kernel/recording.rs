//! A kernel's straight-line programs, one a path, with the quantities that its gates compare.

use super::{Kernel, Refuse, Sink};
use crate::arith::recorded::{
    Comparison, Operation, Place, Recorded, comparisons, decisions_from, decisions_so_far, record,
};
use crate::arith::{Arithmetic, Triple};
use crate::case::{Ray, Triangle};

/// How many paths a kernel may have. Woop's has 2,304.
const MOST_PATHS: usize = 1 << 14;

/// A kernel's run along one path.
#[derive(Clone, Debug)]
pub struct Path {
    /// The program.
    pub operations: Vec<Operation>,
    /// The comparisons that chose the path, and their answers.
    pub decisions: Vec<(Comparison, bool)>,
    /// What the gates compare, in order.
    pub compared: Vec<Compared>,
}

/// What a gate compares with its epsilon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Compared {
    /// Which gate.
    pub gate: usize,
    /// How it compares; none of a gate that is a fixed test, or that rounds with its epsilon: its numbers
    /// are compared with zero, or with each other.
    pub refuse: Option<Refuse>,
    /// Its quantities.
    pub quantities: Vec<Place>,
    /// How many decisions of the path come before.
    pub decisions: usize,
}

/// The sink that writes down what each gate compares, and never stops.
#[derive(Debug, Default)]
struct Recording {
    compared: Vec<Compared>,
    decisions: usize,
}

impl Recording {
    fn note(&mut self, gate: usize, refuse: Option<Refuse>, mut quantities: Vec<Place>) -> bool {
        quantities.sort_unstable();
        quantities.dedup();
        self.decisions = decisions_so_far();
        self.compared.push(Compared { gate, refuse, quantities, decisions: self.decisions });
        true
    }
}

impl Sink<Recorded> for Recording {
    fn gate<const M: usize, const N: usize>(
        &mut self,
        gate: usize,
        refuse: Refuse,
        clauses: [[&Recorded; N]; M],
    ) -> bool {
        let quantities = clauses.iter().flatten().map(|x| x.place()).collect();
        self.note(gate, Some(refuse), quantities)
    }

    /// At an epsilon of zero.
    fn rounded(
        &mut self,
        gate: usize,
        accepts: impl Fn(&Recorded) -> bool,
        _: impl FnOnce() -> Recorded,
    ) -> bool {
        let zero = <Recorded as crate::arith::Real>::zero();
        let compared = comparisons(|| {
            accepts(&zero);
        });
        self.note(gate, None, compared.iter().flat_map(Comparison::places).collect())
    }

    /// What was compared since the gate before.
    fn fixed(&mut self, gate: usize, _: bool) -> bool {
        let compared = decisions_from(self.decisions);
        self.note(gate, None, compared.iter().flat_map(Comparison::places).collect())
    }
}

/// Every path of a kernel in an arithmetic; an error in one sentence if it has no program, or too many paths.
pub(super) fn paths<K: Kernel>(arithmetic: Arithmetic) -> Result<Vec<Path>, String> {
    if arithmetic.flushed {
        return Err("its arithmetic flushes subnormal numbers to zero".to_owned());
    }
    let mut paths = Vec::new();
    let mut script = Vec::new();
    loop {
        let (compared, tape) = record(&script, arithmetic.fused, run::<K>);
        let decisions = tape.decisions;
        if tape.operations.contains(&Operation::INFINITY) {
            return Err("it computes with infinity".to_owned());
        }
        paths.push(Path { operations: tape.operations, compared, decisions });
        if paths.len() > MOST_PATHS {
            return Err(format!("its program has more than {MOST_PATHS} paths"));
        }
        // The next script: the last no becomes a yes, and what came after it is open again.
        script = paths[paths.len() - 1].decisions.iter().map(|(_, answer)| *answer).collect();
        while script.pop_if(|answer| *answer).is_some() {}
        match script.last_mut() {
            Some(answer) => *answer = true,
            None => return Ok(paths),
        }
    }
}

fn run<K: Kernel>() -> Vec<Compared> {
    let number = |i: u8| Recorded::input(i);
    let triple = |i: u8| Triple::from([number(i), number(i + 1), number(i + 2)]);
    let ray = Ray { origin: triple(0), direction: triple(3), t_min: number(15), t_max: number(16) };
    let triangle = Triangle { a: triple(6), b: triple(9), c: triple(12) };
    let mut sink = Recording::default();
    let prepared = K::prepare(&triangle);
    sink.decisions = decisions_so_far();
    K::test(&prepared, &ray, &mut sink);
    sink.compared
}
