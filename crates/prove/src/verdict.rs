//! From bounds of numbers to bounds of verdicts: how far from the boundary of its triangle a ray that is judged wrongly can
//! pass. docs/guide/proof.md has the theorem.
//!
//! An edge gate compares λ·s with e: λ is a barycentric coordinate, s a scale that is at least σ. Its error is at most β. So it
//! refuses only where λ < (e + β)/σ, and accepts only where λ ≥ -max(β - e, 0)/σ. A height is no longer than the longest edge.

use super::bound::Proven;
use super::facts::{Fact, Form, Reader, are_of_one_sign, wanted_sides};
use super::meaning::{Meanings, Scale, What};
use super::others::{Other, Others};
use super::{Domain, Lemma, Proof, Rule, Step, VariableOrigin};
use crate::contract::Sides;
use crate::kernel::{Compared, Entry, Role};
use std::collections::{BTreeSet, HashSet};

/// At a share of half a triangle's longest edge and more a bound says nothing.
pub const USELESS: f64 = 0.5;

/// How far from its triangle's boundary a wrong verdict can be, or why nothing is known.
pub type Depth = Proven<Farthest>;

/// A distance between the line of a triangle's edge and where the ray's line meets the plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Farthest {
    /// As a share of the triangle's longest edge.
    pub share: f64,
    /// The distance of a false hit from the triangle itself, which is more beyond a vertex.
    pub apart: f64,
    /// In a scene, the share as a length.
    pub length: Option<f64>,
}

/// The bounds of a kernel's verdicts at some epsilons.
#[derive(Clone, Debug)]
pub struct Verdicts {
    /// Hits that the edge gates refuse: inside.
    pub misses: Depth,
    /// Misses that they let through: outside.
    pub hits: Depth,
    /// The gates that are not about edges.
    pub others: Vec<Other>,
    /// The numbers that the edge gates multiply barycentric coordinates by, and the least size of each.
    pub scales: Vec<(Scale, f64)>,
}

/// The edge gates of a path, and true if nothing but gates refuses there.
type Forms = (Vec<Form>, bool);

/// The verdicts of a kernel at these epsilons, from the bounds of a domain or of its parts. For hits the exact weights may be
/// slightly below 0 and above 1, or be anything of about this size: `near` and `far` have the bounds where they are.
pub fn verdicts(
    entry: &Entry,
    [proof, near, far]: [&Proof; 3],
    epsilons: &[f64],
    parts: &[Domain],
) -> Verdicts {
    let mut meanings = Meanings::new(proof);
    let others = Others {
        entry,
        proof,
        epsilons,
        parts,
    }
    .all(&mut meanings);
    let is_edge = |gate: usize| entry.info.gates[gate].role == Role::Edge;
    let mut forms: HashSet<Forms> = HashSet::new();
    for (index, path) in proof.paths.iter().enumerate() {
        let compared = path.compared.iter();
        let gates = compared.filter(|compared| is_edge(compared.gate));
        let form = |compared: &Compared| {
            let name = entry.info.gates[compared.gate].name;
            if !compared.is_margin() && epsilons[compared.gate] != 0.0 {
                return Err(format!("gate '{name}' rounds with its epsilon"));
            }
            let mut reader = Reader {
                proof,
                index,
                path,
                meanings: &mut meanings,
            };
            let form = reader.form(compared).filter(Form::is_of_weights);
            form.ok_or(format!("what gate '{name}' compares is not read"))
        };
        match gates.map(form).collect::<Proven<Vec<Form>>>() {
            Ok(found) => forms.insert((found, path.hits)),
            Err(why) => {
                return Verdicts {
                    misses: Err(why.clone()),
                    hits: Err(why),
                    others,
                    scales: Vec::new(),
                };
            }
        };
    }
    let farthest = |share_of: &dyn Fn(&Domain) -> Proven<[f64; 2]>| {
        let mut most = Farthest::default();
        for domain in parts {
            let [share, apart] = share_of(domain)?;
            (most.share, most.apart) = (most.share.max(share), most.apart.max(apart));
            let longest = domain.measures.map(|it| it.longest.to_f64());
            most.length = longest.map(|edge| (share * edge).max(most.length.unwrap_or(0.0)));
        }
        Ok(most)
    };
    let sides = entry.info.contract.sides;
    let misses = farthest(&|domain| {
        let bounds = Bounds {
            proof,
            far: None,
            domain,
            epsilons,
        };
        let mut shares = forms.iter().map(|forms| bounds.inside(forms, sides));
        shares.try_fold([0.0; 2], |most, share| Ok(larger(most, [share?; 2])))
    });
    let is_wide = supposes_weights(entry, proof);
    let mut lemmas = far.of_edges(entry).flat_map(|it| &it.lemmas);
    let is_linear = !is_wide || lemmas.all(is_linear);
    let hits = farthest(&|domain| {
        if !is_linear {
            return Err("barycentric coordinates are multiplied with each other".to_owned());
        }
        let bounds = Bounds {
            proof: near,
            far: is_wide.then_some(far),
            domain,
            epsilons,
        };
        let mut shares = forms.iter().map(|forms| bounds.outside(&forms.0));
        shares.try_fold([0.0; 2], |most, share| Ok(larger(most, share?)))
    });
    let forms = forms.iter().flat_map(|(forms, _)| forms);
    let facts = forms.flat_map(|form| form.ways.concat());
    let scales: BTreeSet<Scale> = facts.map(|fact| fact.scale).collect();
    let least = |scale: Scale| {
        let least = parts.iter().map(|domain| scale.least(domain));
        (scale, least.fold(f64::INFINITY, f64::min))
    };
    Verdicts {
        misses,
        hits,
        others,
        scales: scales.into_iter().map(least).collect(),
    }
}

/// True if no step of a lemma multiplies two numbers that depend on quotients: then its error grows no faster than they do.
/// That of a vector divided by its length may.
fn is_linear(lemma: &Lemma) -> bool {
    if matches!(lemma.rule, Rule::Unit { .. }) {
        return false;
    }
    let mut depends: Vec<bool> = Vec::new();
    for step in &lemma.formula.steps {
        let of = |step: usize| depends[step];
        let is_cut =
            |(v, _): &(usize, i8)| !matches!(lemma.formula.origins[*v], VariableOrigin::Leaf(_));
        if step.terms().any(|(_, a, b)| of(a) && b.is_some_and(of)) {
            return false;
        }
        depends.push(match step {
            Step::Variables(sum) => sum.iter().any(is_cut),
            _ => step.operands().any(of),
        });
    }
    true
}

fn larger([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a.max(c), b.max(d)]
}

/// True if a program divides to get a barycentric coordinate that its proof supposes to be at most 1.
pub fn supposes_weights(entry: &Entry, proof: &Proof) -> bool {
    let mut meanings = Meanings::new(proof);
    proof.of_edges(entry).any(|quantity| {
        let mut lemmas = quantity.lemmas.iter();
        lemmas.any(|lemma| {
            if !matches!(lemma.rule, Rule::Quotient { .. }) {
                return false;
            }
            let meaning = meanings.of(quantity.path, lemma.place);
            meaning.is_some_and(|it| matches!(it.what, What::Weight(_) | What::Rest(_)))
        })
    })
}

/// The bounds of numbers in one domain, and the epsilons.
struct Bounds<'a> {
    proof: &'a Proof,
    /// The bounds farther away, if the proof supposes that no weight is above [`WIDE`].
    far: Option<&'a Proof>,
    domain: &'a Domain,
    epsilons: &'a [f64],
}

/// Exact weights up to this are proved, in the wide domain; beyond they are done in steps of two.
const WIDE: f64 = 1.0 + 1.0 / 512.0;

impl Bounds<'_> {
    /// The error of a number in a proof over the least size of its scale.
    fn share(&self, proof: &Proof, fact: &Fact) -> Proven<f64> {
        let error = proof.error(fact.program, self.domain)?;
        Ok(error / fact.scale.least(self.domain))
    }

    fn epsilon(&self, gate: usize, fact: &Fact) -> f64 {
        self.epsilons[gate] / fact.scale.least(self.domain)
    }

    /// The farthest inside that a gate of a path refuses, on the sides that the contract has.
    fn inside(&self, (forms, hits): &Forms, sides: Sides) -> Proven<f64> {
        if !hits {
            return Err("something refuses that is no gate".to_owned());
        }
        let facts = || forms.iter().flat_map(|form| form.ways.concat());
        let mut most: f64 = 0.0;
        for side in wanted_sides(facts(), sides) {
            for Form { gate, refuses, .. } in forms {
                let refuses = refuses[side].as_ref();
                for fact in refuses.ok_or("its edge gates may refuse any hit of one side")? {
                    let share = self.epsilon(*gate, fact) + self.share(self.proof, fact)?;
                    // If no weight is below δ, 1 less one of them is not below 2δ.
                    let is_rest = matches!(fact.what, What::Rest(_));
                    most = most.max(if is_rest { share / 2.0 } else { share });
                }
            }
        }
        Ok(most)
    }

    /// The farthest outside an edge, and from the triangle, that a path's gates let through.
    fn outside(&self, forms: &[Form]) -> Proven<[f64; 2]> {
        let mut ways: Vec<Vec<(usize, Fact)>> = vec![Vec::new()];
        for form in forms {
            let mut longer = Vec::new();
            for way in &ways {
                for facts in &form.ways {
                    let mut way = way.clone();
                    way.extend(facts.iter().map(|fact| (form.gate, *fact)));
                    longer.push(way);
                }
            }
            ways = longer;
        }
        let mut most = [0.0; 2];
        for way in &ways {
            for side in [true, false] {
                most = larger(most, self.outside_on(way, side)?);
            }
        }
        Ok(most)
    }

    /// The same of one way to be accepted, where the scale is positive or negative.
    fn outside_on(&self, way: &[(usize, Fact)], side: bool) -> Proven<[f64; 2]> {
        let is_impossible = way.iter().any(|(gate, x)| {
            way.iter().any(|(other_gate, y)| {
                let is_negative = x.number == y.number && x.is_plus != y.is_plus;
                // x >= e and -x >= e' leave no x if e + e' > 0.
                let sum = self.epsilons[*gate] + self.epsilons[*other_gate];
                is_negative && (sum > 0.0 || sum == 0.0 && (x.is_strict || y.is_strict))
            })
        });
        let has_sign = way.iter().any(|(_, fact)| fact.has_sign());
        if is_impossible || !has_sign && !side {
            return Ok([0.0; 2]);
        }
        if !are_of_one_sign(way.iter().map(|(_, fact)| fact)) {
            return Err("its edge gates compare numbers whose signs differ".to_owned());
        }
        // Of each weight the least that is known, and its error: on this side, or on the other one.
        let known = |proof: &Proof, is_side: bool| -> Proven<Option<[(f64, f64); 3]>> {
            let mut all = [None; 3];
            for (gate, fact) in way.iter().filter(|(_, fact)| fact.is_side(side) == is_side) {
                if let What::Weight(vertex) = fact.what {
                    let error = self.share(proof, fact)?;
                    all[vertex] = Some((self.epsilon(*gate, fact), error));
                }
            }
            let [Some(a), Some(b), Some(c)] = all else {
                return Ok(None);
            };
            Ok(Some([a, b, c]))
        };
        let at = |weights: &[(f64, f64); 3], times: f64| {
            // Of a larger epsilon than a half no more is said.
            weights.map(|(epsilon, error)| (times * error - epsilon.min(0.5)).max(0.0))
        };
        let Some(weights) = known(self.proof, true)? else {
            // All weights are small, and their sum is 1.
            let is_none =
                known(self.proof, false)?.is_some_and(|it| at(&it, 1.0).iter().sum::<f64>() < 1.0);
            return if is_none {
                Ok([0.0; 2])
            } else {
                Err("its edge gates accept without all three edges".to_owned())
            };
        };
        // Where a weight is above 1 by something, another one is below 0 by half of that.
        let mut most = [0.0; 2];
        let (mut weights, mut times, mut least) = (weights, 1.0, 0.0);
        loop {
            let outside = at(&weights, times);
            let largest = outside.into_iter().fold(0.0, f64::max);
            if 1.0 < times && largest < least {
                return Ok(most);
            }
            // Near a vertex two weights may be below 0.
            let smallest = outside.into_iter().fold(f64::INFINITY, f64::min);
            most = larger(most, [largest, outside.iter().sum::<f64>() - smallest]);
            let Some(far) = self.far else { return Ok(most) };
            if 0.5 < largest {
                return Err("the bound of its errors outside reaches half of the longest edge, so from no distance on are all \
                            rays surely refused"
                    .to_owned());
            }
            least = (times * WIDE - 1.0) / 2.0;
            times *= 2.0;
            weights = known(far, true)?.unwrap_or(weights);
        }
    }
}
