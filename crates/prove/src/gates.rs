//! The bounds of all gates of a kernel: every path, every quantity, each program once.

use super::bound::{Lemma, Prover};
use super::forms::Leaf;
use super::formula::Source;
use super::order::{is_impossible, unsigned};
use super::{Bound, Domain, Dyadic, Format, Limit, Rule};
use crate::arith::recorded::{Operation, Place};
use crate::kernel::{Compared, Path};
use std::collections::{BTreeSet, HashMap};

/// The proof of a kernel in a domain.
#[derive(Debug)]
pub struct Proof {
    /// Its paths that some input takes.
    pub paths: Vec<Path>,
    /// The numbers that its gates compare; the same program on several paths is there once.
    pub quantities: Vec<Quantity>,
}

/// A number that a gate compares, on one of the paths where its program is the same.
#[derive(Clone, Debug)]
pub struct Quantity {
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
    /// The domain of its bound.
    pub domain: Domain,
    /// Its bound, or why there is none.
    pub bound: Result<Bound, String>,
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
}

/// A limit that a bound supposes in a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Supposed {
    /// True if the size of the number is at most the limit; false if it is at least that.
    pub is_most: bool,
    /// The number.
    pub name: &'static str,
    /// The limit.
    pub limit: Dyadic,
}

impl Uses {
    /// True if it supposes nothing but a bound of the edges, and of the direction.
    pub fn is_of_edges_alone(self) -> bool {
        self == Uses { edge: true, ..Uses::default() }
    }
}

impl Quantity {
    /// The limits of divisors and of quotients that its bound supposes.
    pub fn limits(&self) -> Vec<Supposed> {
        let supposed = |is_most: bool, limit: Limit| {
            let (name, limit) = match limit {
                Limit::Own(_) => return None,
                Limit::Scene(name, size) => (name, size),
                Limit::Domain(size) if is_most => ("any quotient", size),
                Limit::Domain(size) => ("any other divisor", size),
            };
            Some(Supposed { is_most, name, limit })
        };
        let of_lemma = |lemma: &Lemma| match lemma.rule {
            Rule::Sum => [None, None],
            Rule::Unit { floor, .. } => [supposed(false, floor), None],
            Rule::Quotient { floor, most, .. } => {
                // Else the largest numerator over the least divisor is smaller.
                let most = Some(most).filter(|most| most.size() <= lemma.bound.size);
                [supposed(false, floor), most.and_then(|most| supposed(true, most))]
            }
        };
        self.lemmas.iter().flat_map(of_lemma).flatten().collect()
    }

    /// The suppositions of its bound.
    pub fn uses(&self) -> Uses {
        let mut uses = Uses::default();
        for lemma in &self.lemmas {
            uses.floor |= lemma.rule != Rule::Sum;
            for source in lemma.sources() {
                match source {
                    Source::Leaf(Leaf::Point(..)) => uses.world = true,
                    Source::Leaf(Leaf::Difference(0, ..) | Leaf::Difference(_, 0, _)) => {
                        uses.reach = true;
                    }
                    Source::Leaf(Leaf::Difference(..)) | Source::Third(..) => uses.edge = true,
                    Source::Leaf(Leaf::End(_)) => uses.extent = true,
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
        let paths: Vec<Path> = paths.into_iter().filter(|path| !is_impossible(path)).collect();
        let mut quantities = Vec::new();
        each_quantity(&paths, gate, domain, format, |path, compared, place, prover| {
            quantities.push(Quantity {
                gate: compared.gate,
                path,
                is_margin: compared.is_margin(),
                decisions: compared.decisions,
                place,
                domain,
                bound: prover.bound(place),
                lemmas: prover.lemmas_of(place),
            });
        });
        quantities.sort_by_key(|quantity| quantity.gate);
        Proof { paths, quantities }
    }

    /// The same where the inputs lie in one of several domains, each a part of this one: what divides is proved in
    /// each of them.
    pub fn split(mut self, domains: &[Domain], format: Format) -> Proof {
        let Proof { paths, quantities } = &mut self;
        let divides = |quantity: &Quantity| quantity.bound.is_err() || quantity.uses().floor;
        let prove = |quantity: &Quantity| {
            let path = &paths[quantity.path];
            let tries = domains.iter().filter(|_| divides(quantity)).map(|domain| {
                let mut prover = Prover::new(path, *domain, format);
                prover.limit_to(quantity.place);
                let bound = prover.bound(quantity.place);
                let lemmas = prover.lemmas_of(quantity.place);
                Quantity { domain: *domain, bound, lemmas, ..quantity.clone() }
            });
            let found: Vec<Quantity> = tries.collect();
            if found.is_empty() { vec![quantity.clone()] } else { found }
        };
        *quantities = quantities.iter().flat_map(prove).collect();
        self
    }

    /// The quantity of a gate with the largest error; an error in one sentence if one has no bound.
    pub fn gate(&self, gate: usize) -> Option<Result<&Quantity, String>> {
        let of_gate = || self.quantities.iter().filter(|quantity| quantity.gate == gate);
        if let Some(Err(why)) = of_gate().map(|quantity| &quantity.bound).find(|b| b.is_err()) {
            return Some(Err(why.clone()));
        }
        of_gate().max_by_key(|q| q.bound.as_ref().map(|bound| bound.error).ok()).map(Ok)
    }
}

/// Visits what the gates compare, or one of them: each program once, with the number of its path and its place
/// there, without a sign around it.
pub fn each_quantity(
    paths: &[Path],
    gate: Option<usize>,
    domain: Domain,
    format: Format,
    mut visit: impl FnMut(usize, &Compared, Place, &mut Prover),
) {
    let mut seen = BTreeSet::new();
    for (index, path) in paths.iter().enumerate() {
        let mut prover = Prover::new(path, domain, format);
        let is_wanted = |compared: &&Compared| gate.is_none_or(|gate| compared.gate == gate);
        for compared in path.compared.iter().filter(is_wanted) {
            for place in &compared.quantities {
                let place = unsigned(path, *place);
                let program = canonical(&prover, path, place);
                if program.0.len() > 2 && seen.insert((compared.gate, program)) {
                    prover.limit_to(place);
                    visit(index, compared, place, &mut prover);
                }
            }
        }
    }
}

/// A program that is the same for all renamings of axes and of a, b and c, because the domain is; and what a scene
/// says of its divisors and quotients.
fn canonical(prover: &Prover, path: &Path, place: Place) -> (Vec<u32>, Vec<Limit>) {
    let mut names = Names {
        path,
        prover,
        text: Vec::new(),
        limits: Vec::new(),
        seen: HashMap::new(),
        axes: vec![],
        points: vec![],
    };
    names.visit(place);
    (names.text, names.limits)
}

struct Names<'a> {
    path: &'a Path,
    prover: &'a Prover<'a>,
    text: Vec<u32>,
    limits: Vec<Limit>,
    seen: HashMap<Place, u32>,
    axes: Vec<usize>,
    points: Vec<usize>,
}

impl Names<'_> {
    fn visit(&mut self, place: Place) {
        if let Some(known) = self.seen.get(&place) {
            self.text.extend([u32::MAX, *known]);
            return;
        }
        let index = self.seen.len() as u32;
        self.seen.insert(place, index);
        let operation = self.path.operations[place as usize];
        if let Operation::Input(i) = operation {
            let leaf = Leaf::input(i.into());
            let code = match leaf {
                Leaf::Point(0, axis) => 100 + self.axis(axis),
                Leaf::Point(p, axis) => {
                    let axis = self.axis(axis);
                    200 + 10 * number_of(&mut self.points, p) + axis
                }
                Leaf::Direction(axis) => 300 + self.axis(axis),
                _ => 400 + u32::from(i),
            };
            self.text.push(code);
            return;
        }
        let kind = match operation {
            Operation::Number(value) => 1000 + value as u32,
            Operation::Add(..) => 1,
            Operation::Sub(..) => 2,
            Operation::Mul(..) => 3,
            Operation::Div(numerator, divisor) => {
                // What the path says of the divisor belongs to the program.
                10 + u32::from(self.prover.is_at_most_in_size(numerator, divisor))
                    + 2 * u32::from(self.prover.is_largest_of_direction(divisor))
            }
            Operation::Neg(_) => 4,
            Operation::Abs(_) => 5,
            Operation::Sqrt(_) => 6,
            Operation::Fma(..) => 7,
            Operation::Minor(..) => 8,
            Operation::Input(_) => unreachable!("handled above"),
        };
        self.text.push(kind);
        if let Some((_, divisor, _)) = self.prover.quotient(place) {
            self.limits.push(self.prover.floor(divisor));
            self.limits.extend(self.prover.most(place));
        }
        for operand in operation.operands() {
            self.visit(operand);
        }
    }

    fn axis(&mut self, axis: usize) -> u32 {
        number_of(&mut self.axes, axis)
    }
}

/// The place of a value in a list; it is appended if it is new.
fn number_of(list: &mut Vec<usize>, value: usize) -> u32 {
    let at = list.iter().position(|known| *known == value);
    at.unwrap_or_else(|| {
        list.push(value);
        list.len() - 1
    }) as u32
}
