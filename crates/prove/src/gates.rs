//! The bounds of all gates of a kernel: every path, every quantity, each program once.

use super::bound::{Lemma, Proven, Prover};
use super::forms::Leaf;
use super::formula::VariableOrigin;
use super::names::Names;
use super::order::{is_impossible, unsigned};
use super::run::cone;
use super::{Bound, Domain, Dyadic, Format, Limit, Rule};
use crate::arith::recorded::{Operation, Place};
use crate::kernel::{Compared, Entry, Path, Role};
use std::collections::{BTreeSet, HashMap};

/// The proof of a kernel in a domain.
#[derive(Debug)]
pub struct Proof {
    /// Its paths that some input takes.
    pub paths: Vec<Path>,
    /// The numbers that its gates compare; the same program on several paths is there once.
    pub quantities: Vec<Quantity>,
    /// The program that a gate compares at a place of a path, as its quantities call it.
    pub programs: HashMap<(usize, usize, Place), usize>,
}

/// A number that a gate compares, on one of the paths where its program is the same.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// Its program; the same in every part of a domain.
    pub program: usize,
    /// The gate.
    pub gate: usize,
    /// The path.
    pub path: usize,
    /// True if it is compared with the epsilon itself; false if with zero, at an epsilon of 0.
    pub is_margin: bool,
    /// How many decisions of the path come before the comparison.
    pub decisions: usize,
    /// Its place in the path's program, without a sign around it.
    pub place: Place,
    /// The pairs of inputs of which its proof supposes that the first is at most as large as the second; the path's
    /// decisions say so.
    pub orders: BTreeSet<(u8, u8)>,
    /// The names of axes and vertices under which gates compare it too, on this path and on others.
    pub also: Vec<Names>,
    /// The domain of its bound.
    pub domain: Domain,
    /// Its bound, or why there is none.
    pub bound: Proven<Bound>,
    /// The lemmas of the bound, its own last.
    pub lemmas: Vec<Lemma>,
}

/// The bounds of the inputs that a quantity's bound supposes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Uses {
    /// A bound of the edges.
    pub edge: bool,
    /// A bound of the vectors from the origin to the vertices.
    pub reach: bool,
    /// A bound of the points themselves.
    pub world: bool,
    /// A bound of t_min and t_max.
    pub extent: bool,
    /// A floor of divisors.
    pub floor: bool,
    /// That barycentric coordinates which are quotients are not below 0.
    pub inside: bool,
}

/// A limit that a bound supposes in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Assumption {
    /// True if the size of the number is at most the limit; false if it is at least that.
    pub is_most: bool,
    /// The number.
    pub name: &'static str,
    /// The limit.
    pub limit: Dyadic,
}

impl Assumption {
    fn of(limit: Limit, is_most: bool) -> Option<Assumption> {
        let name = match limit {
            Limit::Own(_) => return None,
            Limit::Scene(name, _) => name,
            Limit::Domain(_) if is_most => "any quotient",
            Limit::Domain(_) => "any other divisor",
        };
        Some(Assumption {
            is_most,
            name,
            limit: limit.size(),
        })
    }
}

impl Quantity {
    /// The limits of divisors and of quotients that its bound supposes.
    pub fn limits(&self) -> Vec<Assumption> {
        let mut all = Vec::new();
        for lemma in &self.lemmas {
            match lemma.rule {
                Rule::Sum => {}
                Rule::Unit { floor, .. } => all.extend(Assumption::of(floor, false)),
                Rule::Quotient { floor, most, .. } => {
                    all.extend(Assumption::of(floor, false));
                    // Else the largest numerator over the least divisor is smaller.
                    if most.size() <= lemma.bound.size {
                        all.extend(Assumption::of(most, true));
                    }
                }
            }
        }
        all
    }

    /// The error of its bound, if it has one.
    pub fn error(&self) -> Option<Dyadic> {
        self.bound.as_ref().ok().map(|bound| bound.error)
    }

    /// The suppositions of its bound.
    pub fn uses(&self) -> Uses {
        Uses::of(&self.lemmas)
    }
}

impl Uses {
    /// True if it supposes nothing but a bound of the edges, and of the direction.
    pub fn is_of_edges_alone(self) -> bool {
        self == Uses {
            edge: true,
            ..Uses::default()
        }
    }

    /// The suppositions of some lemmas.
    pub fn of<'a>(lemmas: impl IntoIterator<Item = &'a Lemma>) -> Uses {
        let mut uses = Uses::default();
        for lemma in lemmas {
            uses.floor |= lemma.rule != Rule::Sum;
            uses.inside |= matches!(lemma.rule, Rule::Quotient { below: Some(_), .. });
            for source in &lemma.formula.origins {
                match source {
                    VariableOrigin::Leaf(Leaf::Point(..)) => uses.world = true,
                    VariableOrigin::Leaf(Leaf::Difference(0, ..) | Leaf::Difference(_, 0, _)) => {
                        uses.reach = true;
                    }
                    VariableOrigin::Leaf(Leaf::Difference(..)) => uses.edge = true,
                    VariableOrigin::Boxed(..) => (uses.edge, uses.reach) = (true, true),
                    VariableOrigin::Leaf(Leaf::End(_)) => uses.extent = true,
                    _ => {}
                }
            }
        }
        uses
    }
}

impl Proof {
    /// Proves what can be proved of recorded paths, of all gates or of one.
    pub fn new(paths: Vec<Path>, gate: Option<usize>, domain: Domain, format: Format) -> Proof {
        let mut paths = paths;
        paths.retain(|path| !is_impossible(path));
        let mut quantities: Vec<Quantity> = Vec::new();
        let mut known: HashMap<Key, (usize, Names)> = HashMap::new();
        let mut programs = HashMap::new();
        for (index, path) in paths.iter().enumerate() {
            let mut prover = Prover::new(path, domain, format);
            for (compared, place) in compared(path) {
                if gate.is_some_and(|gate| compared.gate != gate) {
                    continue;
                }
                let (key, names) = key(&prover, compared.gate, place);
                let known_program = known.get(&key).map(|(known, _)| *known);
                let program = known_program.unwrap_or(quantities.len());
                programs.insert((compared.gate, index, place), program);
                if let Some((known, from)) = known.get(&key) {
                    let Quantity { also, .. } = &mut quantities[*known];
                    let to = from.to(names);
                    if from.to(*from) != to && !also.contains(&to) {
                        also.push(to);
                    }
                    continue;
                }
                known.insert(key, (quantities.len(), names));
                quantities.push(Quantity {
                    program,
                    gate: compared.gate,
                    path: index,
                    is_margin: compared.is_margin(),
                    decisions: compared.decisions,
                    place,
                    orders: prover.orders(place),
                    also: Vec::new(),
                    domain,
                    bound: prover.bound(place),
                    lemmas: prover.lemmas_of(place),
                });
            }
        }
        quantities.sort_by_key(|quantity| quantity.gate);
        Proof {
            paths,
            quantities,
            programs,
        }
    }

    /// The same where the inputs lie in one of several domains, each a part of this one: what divides is proved in
    /// each of them.
    pub fn split(mut self, domains: &[Domain], format: Format) -> Proof {
        let Proof {
            paths, quantities, ..
        } = &mut self;
        let divides = |quantity: &Quantity| quantity.bound.is_err() || quantity.uses().floor;
        let mut all = Vec::new();
        for quantity in quantities.drain(..) {
            if domains.is_empty() || !divides(&quantity) {
                all.push(quantity);
                continue;
            }
            for domain in domains {
                let mut prover = Prover::new(&paths[quantity.path], *domain, format);
                all.push(Quantity {
                    domain: *domain,
                    bound: prover.bound(quantity.place),
                    lemmas: prover.lemmas_of(quantity.place),
                    ..quantity.clone()
                });
            }
        }
        *quantities = all;
        self
    }

    /// The numbers that the gates at edges compare.
    pub(super) fn of_edges(&self, entry: &Entry) -> impl Iterator<Item = &Quantity> {
        let gates = entry.info.gates;
        let quantities = self.quantities.iter();
        quantities.filter(|quantity| gates[quantity.gate].role == Role::Edge)
    }

    /// The quantity of a gate with the largest error; an error in one sentence if one has no bound.
    pub fn gate(&self, gate: usize) -> Option<Proven<&Quantity>> {
        for quantity in self.of_gate(gate) {
            if let Err(why) = &quantity.bound {
                return Some(Err(why.clone()));
            }
        }
        let quantities = self.of_gate(gate);
        quantities.max_by_key(|quantity| quantity.error()).map(Ok)
    }

    /// The bound of a program's error in a domain.
    pub(super) fn error(&self, program: usize, domain: &Domain) -> Proven<f64> {
        let is_of_program = |it: &&Quantity| it.program == program;
        let mut quantities = self.quantities.iter().filter(is_of_program);
        let in_domain = quantities.clone().find(|it| it.domain == *domain);
        let quantity = in_domain.or(quantities.next());
        let bound = &quantity.expect("each program has a quantity").bound;
        match bound {
            Ok(bound) => Ok(bound.error.to_f64()),
            Err(why) => Err(format!("no bound: {why}")),
        }
    }

    /// The numbers that a gate compares.
    pub(super) fn of_gate(&self, gate: usize) -> impl Iterator<Item = &Quantity> {
        let quantities = self.quantities.iter();
        quantities.filter(move |quantity| quantity.gate == gate)
    }
}

/// The numbers that a path's gates compare and that are computed, without the signs around them.
pub fn compared(path: &Path) -> Vec<(&Compared, Place)> {
    let mut all = Vec::new();
    for compared in &path.compared {
        for place in &compared.quantities {
            let place = unsigned(path, *place);
            let program = cone(&path.operations, place).operations;
            let mut operands = program.iter().map(Operation::operands);
            if operands.any(|operands| 1 < operands.len()) {
                all.push((compared, place));
            }
        }
    }
    all
}

/// A gate and the program of what it compares, under the names of axes and vertices that the program needs first; the
/// orders of inputs and the limits that its proof supposes.
type Key = (usize, Vec<Operation>, BTreeSet<(u8, u8)>, Vec<Limit>);

/// The program of a number as a key, and its own names.
fn key(prover: &Prover, gate: usize, place: Place) -> (Key, Names) {
    let operations = &prover.path.operations;
    let cone = cone(operations, place);
    let names = Names::of(&cone.operations);
    let renamed = |operation| names.operation(operation);
    let program = cone.operations.into_iter().map(renamed).collect();
    let orders = prover.orders(place).into_iter();
    let orders = orders
        .map(|(a, b)| (names.input(a), names.input(b)))
        .collect();
    let mut quotients: Vec<(Place, Place)> = (0..)
        .zip(cone.places)
        .filter_map(|(old, new)| Some((new?, old)))
        .collect();
    quotients.sort_unstable();
    let mut limits = Vec::new();
    for (_, place) in quotients {
        if let Some(fraction) = prover.quotient(place) {
            limits.push(prover.floor(fraction.divisor));
            limits.extend(prover.most(place));
        }
    }
    ((gate, program, orders, limits), names)
}
