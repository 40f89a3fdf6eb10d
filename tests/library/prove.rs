//! Bounds of programs: every error found is below its bound, and edge values are what is said of them.

use hairline::internals::arith::recorded::{Comparison, Operation};
use hairline::internals::arith::{Arithmetic, Float, Real};
use hairline::internals::case::Draw;
use hairline::internals::kernel::{KERNELS, Path, Scalar, find, in_arithmetic};
use hairline::internals::prove::{
    Domain, Dyadic, Effort, Format, Goal, Proof, Sample, Search, Searched, Summary, Symmetry,
    paths_of, run,
};

fn no_error_is_above_its_bound<F: Searched + Scalar>(evaluations: u64) {
    for kernel in KERNELS {
        for arithmetic in [Arithmetic::IEEE, Arithmetic::FMA, Arithmetic::REARRANGED] {
            let entry = in_arithmetic(kernel, arithmetic).unwrap();
            let effort = Effort {
                evaluations,
                seed: 7,
            };
            let summary = Summary::<F>::new(entry, Domain::UNIT, &[], &[], effort).unwrap();
            assert_eq!(summary.contradiction, None, "{}", entry.info.name);
            let bounded = summary.gates.iter().filter(|gate| gate.bound.is_ok());
            assert!(bounded.clone().count() > 0, "{}", entry.info.name);
            for gate in bounded.filter(|gate| !gate.uses.floor && !gate.uses.world) {
                // The search finds something of the bound's order at once, so a bound that is too small by much
                // would be noticed.
                let factor = gate.factor().unwrap();
                assert!(
                    factor < 12.0,
                    "{} {}: {factor}",
                    entry.info.name,
                    gate.gate.name
                );
            }
        }
    }
}

#[test]
fn no_error_is_above_its_bound_in_f32() {
    no_error_is_above_its_bound::<f32>(400);
}

#[test]
fn no_error_is_above_its_bound_in_f64() {
    no_error_is_above_its_bound::<f64>(100);
}

/// 17 u by hand, to first order: the roundings of the edges 2 + 2, the products of the cross product 3, its
/// differences 3, the products of the dot product 3, its sums 2 and 2.
#[test]
fn the_determinant_of_moller_trumbore_is_bounded_as_by_hand() {
    let kernel = find("moller-trumbore").unwrap();
    let summary = Summary::<f32>::new(
        kernel,
        Domain::UNIT,
        &[],
        &[],
        Effort {
            evaluations: 0,
            seed: 1,
        },
    )
    .unwrap();
    let units = summary.gates[0].bound.as_ref().unwrap().to_f64() * 2f64.powi(24);
    let below_one = 1.0 - 2f64.powi(-10);
    assert!(
        units <= 17.0 && units >= 17.0 * below_one * below_one,
        "{units}"
    );
}

/// Numbers that overflow, underflow or need too many digits have no bound, or a true one.
#[test]
fn no_size_of_the_inputs_makes_a_proof_panic() {
    for kernel in KERNELS {
        for (points, direction) in [(-140, -140), (-60, 120), (126, 126)] {
            let [points, direction] = [points, direction].map(Dyadic::power);
            let domain = Domain {
                edge: points,
                reach: points,
                world: points,
                direction,
                extent: points,
                direction_floor: direction,
                floor: points,
                ..Domain::UNIT
            };
            let of_f32 = Proof::new(paths_of::<f32>(kernel).unwrap(), None, domain, Format::F32);
            let of_f64 = Proof::new(paths_of::<f64>(kernel).unwrap(), None, domain, Format::F64);
            assert!(!of_f32.quantities.is_empty() && !of_f64.quantities.is_empty());
        }
    }
}

#[test]
fn a_search_is_reproducible_and_stays_in_its_domain() {
    let kernel = find("moller-trumbore-culling").unwrap();
    let paths = <f32 as Scalar>::subject(kernel)
        .unwrap()
        .gated()
        .unwrap()
        .paths()
        .unwrap();
    let proof = Proof::new(paths, None, Domain::UNIT, Format::F32);
    for quantity in &proof.quantities {
        let mut search = Search::<f32>::new(&proof, quantity, None);
        let mut found = || search.climb(Goal::Error, 3000, &mut Draw::new("test", 1, 2), &[]);
        let (inputs, score) = found().unwrap();
        assert_eq!(found(), Some((inputs, score)));
        // The error in f64, which is exact enough for f32.
        let last = quantity.place as usize;
        let operations = &proof.paths[quantity.path].operations[..=last];
        let (mut computed, mut exact) = (Vec::new(), Vec::new());
        run(operations, &inputs, &mut computed);
        run(operations, &inputs.map(f64::from), &mut exact);
        let error = (f64::from(computed[last]) - exact[last]).abs();
        assert!((error - score).abs() <= 1e-12, "{error} {score}");
        for axis in 0..3 {
            let at = |point: usize| exact_input(&inputs, point, axis);
            // The other quantities know one edge only.
            for (p, q) in [(9, 6), (12, 6)].into_iter().filter(|_| quantity.gate == 0) {
                assert!((at(p) - at(q)).abs() <= Domain::UNIT.edge.to_f64());
            }
            assert!(at(3).abs() <= 1.0);
        }
    }
}

/// The numbers of a stored witness in a scalar.
fn numbers<F: Float>(witness: &serde_json::Value) -> [F; 17] {
    let words = witness["inputs"]
        .as_array()
        .unwrap()
        .iter()
        .map(|word| word.as_str().unwrap());
    let bits = words.map(|word| F::from_bits(u64::from_str_radix(word, 16).unwrap()));
    bits.collect::<Vec<F>>().try_into().unwrap()
}

/// The values of a path's program at inputs, in floats of 53 digits; of the path that the kernel takes there.
pub fn taken<F: Searched + Scalar>(paths: &[Path], inputs: &[F; 17]) -> (usize, Vec<f64>) {
    let is_taken = |path: &&Path| {
        let mut values = Vec::new();
        run(&path.operations, inputs, &mut values);
        let of = |place: u32| values[place as usize];
        path.decisions.iter().all(|(comparison, answer)| {
            *answer
                == match *comparison {
                    Comparison::Less(a, b) => of(a).is_less(&of(b)),
                    Comparison::AtMost(a, b) => of(a).is_at_most(&of(b)),
                    Comparison::Zero(a) => of(a).is_zero(),
                    Comparison::Negative(a) => of(a).is_sign_negative(),
                }
        })
    };
    let index = paths.iter().position(|path| is_taken(&path)).unwrap();
    let path = &paths[index];
    let mut values = Vec::new();
    let floats = inputs.map(|x| x.to_f64());
    run(&path.operations, &floats, &mut values);
    (index, values)
}

/// No divisor or root is below a half, and no quotient above 1, but a barycentric coordinate next to its range.
fn divides_as_the_unit_domain_says<F: Searched + Scalar>(witness: &serde_json::Value) -> usize {
    let entry = find(witness["kernel"].as_str().unwrap()).unwrap();
    let paths = paths_of::<F>(entry).unwrap();
    let inputs = numbers::<F>(witness);
    let (index, values) = taken(&paths, &inputs);
    let sample = Sample::of(&inputs.map(|x| x.to_f64()));
    let is_weight = |x: f64| {
        let weights = [0, 1, 2].map(|vertex| sample.weight(vertex));
        weights
            .into_iter()
            .any(|w| (x - w).abs() < 1e-9 || (x - (1.0 - w)).abs() < 1e-9)
    };
    let mut divisions = 0;
    for (operation, value) in paths[index].operations.iter().zip(&values) {
        match *operation {
            Operation::Div(n, d) => {
                let (numerator, divisor) = (values[n as usize], values[d as usize]);
                assert!(
                    0.5 - 1e-12 <= divisor.abs(),
                    "{witness}: divides by {divisor}"
                );
                let is_within = value.abs() <= 1.0 + 1e-12;
                let is_near = is_weight(*value) && (-1e-3..1.001).contains(value);
                assert!(
                    is_within || is_near || numerator == 1.0,
                    "{witness}: a quotient {value}"
                );
                divisions += 1;
            }
            Operation::Sqrt(_) => assert!(0.5 - 1e-12 <= *value, "{witness}: a root {value}"),
            _ => {}
        }
    }
    divisions
}

#[test]
fn stored_rays_divide_as_the_unit_domain_says() {
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../corpora/proofs/witnesses.ndjson"
    );
    let text = std::fs::read_to_string(file).unwrap();
    let (mut rays, mut divisions) = (0, 0);
    for line in text.lines() {
        let witness: serde_json::Value = serde_json::from_str(line).unwrap();
        if witness["goal"] != "missed" && witness["goal"] != "hit" {
            continue;
        }
        rays += 1;
        divisions += match witness["scalar"] == "f32" {
            true => divides_as_the_unit_domain_says::<f32>(&witness),
            false => divides_as_the_unit_domain_says::<f64>(&witness),
        };
    }
    // Fifteen kernels at least, with fused products and without, in two scalars, on two sides.
    assert!(120 <= rays, "{rays}");
    assert!(100 < divisions, "{divisions}");
}

fn exact_input(inputs: &[f32; 17], point: usize, axis: usize) -> f64 {
    inputs[point + axis].into()
}

/// The edge values of two triangles on either side, run as programs: where they are proved to be exact
/// negatives they are, and where they are not a ray is found for which they are not.
#[test]
fn edge_values_are_exact_negatives_where_it_is_said() {
    for (name, symmetry) in [
        ("woop-watertight", Symmetry::ExactSigns),
        ("woop-watertight+fma", Symmetry::None),
        ("plucker", Symmetry::Negatives),
        ("plucker+fma", Symmetry::Negatives),
        ("scalar-triple", Symmetry::None),
        ("moller-trumbore", Symmetry::None),
    ] {
        let kernel = find(name).unwrap();
        let effort = Effort {
            evaluations: 0,
            seed: 1,
        };
        let summary = Summary::<f32>::new(kernel, Domain::UNIT, &[], &[], effort).unwrap();
        assert_eq!(summary.symmetry, symmetry, "{name}");
        let gate = summary
            .gates
            .iter()
            .find(|gate| gate.gate.name == "edge")
            .unwrap();
        // The value of edge bc where the kernel has one: b and c exchanged.
        let of_edge = summary
            .proof
            .quantities
            .iter()
            .filter(|q| q.gate == gate.index);
        let mut differ = 0;
        for quantity in of_edge {
            let operations = &summary.proof.paths[quantity.path].operations;
            let last = quantity.place as usize;
            let mut draw = Draw::new("test", 3, 4);
            let (mut one, mut other) = (Vec::new(), Vec::new());
            for _ in 0..2000 {
                let inputs: [f32; 17] = std::array::from_fn(|_| draw.symmetric());
                let value = |values: &mut Vec<f32>, inputs: &[f32; 17]| {
                    run(&operations[..=quantity.place as usize], inputs, values);
                    values[last]
                };
                let here = value(&mut one, &inputs);
                // Some pair of vertices exchanged gives the negative.
                let there = [(6, 9), (9, 12), (6, 12)].map(|(p, q)| {
                    let mut exchanged = inputs;
                    (0..3).for_each(|axis| exchanged.swap(p + axis, q + axis));
                    value(&mut other, &exchanged)
                });
                differ += usize::from(there.iter().all(|there| *there != -here));
            }
        }
        assert_eq!(differ == 0, symmetry != Symmetry::None, "{name}: {differ}");
    }
}
