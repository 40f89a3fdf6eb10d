//! Kernels' errors beside their permanents, at every exponent, against rational numbers.

use super::super::dyadic::Big;
use super::super::{Domain, Dyadic, Format, Prover, paths_of, relative};
use super::program::{is_taken, run};
use super::recorded;
use crate::arith::recorded::{Operation, Recorded};
use crate::arith::{Float, Real};
use crate::case::Draw;
use crate::kernel::{Path, Scalar, find};
use num_traits::{Signed, ToPrimitive, Zero};

fn exact(x: f64) -> Big {
    Big::from(Dyadic::from_f64(x).expect("finite"))
}

/// The exact value and the permanent of each number; none after a division by zero.
fn numbers<F: Float>(path: &Path, inputs: &[F; 17]) -> Vec<Option<[Big; 2]>> {
    let mut known: Vec<Option<[Big; 2]>> = Vec::new();
    for operation in &path.operations {
        let of = |at: u32| known[at as usize].clone();
        let plain = |x: Big| Some([x.clone(), x.abs()]);
        let sum = |a: Option<[Big; 2]>, b: Option<[Big; 2]>, sign: i32| {
            let ([a, p], [b, q]) = (a?, b?);
            Some([if sign < 0 { a - b } else { a + b }, p + q])
        };
        let product = |a: u32, b: u32| {
            let ([a, p], [b, q]) = (of(a)?, of(b)?);
            Some([a * b, p * q])
        };
        let is_point = |at: u32| matches!(path.operations[at as usize], Operation::Input(i) if i < 3 || (6..15).contains(&i));
        let next = match *operation {
            Operation::Input(i) => plain(exact(inputs[usize::from(i)].to_f64())),
            Operation::Number(value) => plain(exact(value.into())),
            Operation::Sub(a, b) if is_point(a) && is_point(b) => {
                sum(of(a), of(b), -1).and_then(|[difference, _]| plain(difference))
            }
            Operation::Add(a, b) => sum(of(a), of(b), 1),
            Operation::Sub(a, b) => sum(of(a), of(b), -1),
            Operation::Mul(a, b) => product(a, b),
            Operation::Neg(a) => of(a).map(|[x, p]| [-x, p]),
            Operation::Abs(a) => of(a).map(|[x, p]| [x.abs(), p]),
            Operation::Fma(a, b, c) => sum(product(a, b), of(c), 1),
            Operation::Minor(a, b, c, d) => sum(product(a, b), product(c, d), -1),
            Operation::Div(a, b) => match (of(a), of(b)) {
                (Some([a, _]), Some([b, _])) if !b.is_zero() => plain(a / b),
                _ => None,
            },
            Operation::Sqrt(_) => None,
        };
        known.push(next);
    }
    known
}

/// The largest share of its bound that an error has, and how many were compared.
fn largest_share<F: Scalar>(name: &str, format: Format) -> (f64, usize) {
    let entry = find(name).expect("a kernel");
    let gated = F::subject(entry)
        .and_then(|subject| subject.gated())
        .expect("gates");
    let paths = gated.paths().expect("recorded");
    let mut draw = Draw::new("permanent", 1, 1);
    let (mut largest, mut count) = (0.0f64, 0);
    for round in 0..20 {
        // A lattice, where determinants vanish and programs fall back; points of many sizes; and points
        // far down, where products underflow.
        let lowest = [-3, -20, i64::from(F::MIN_EXPONENT) / 2 - 10][round % 3];
        let mut number = || match round % 4 {
            0 => F::from_f64(draw.integer(-2, 2) as f64 / 8.0),
            _ => {
                let exponent = draw.integer(lowest, -2) as i32;
                draw.with_exponent::<F>(exponent)
            }
        };
        let mut inputs = [(); 17].map(|()| number());
        inputs[5] = number() + F::from_f64(0.75);
        let run_of = |path| (path, run(path, &inputs));
        let mut runs = paths.iter().map(run_of);
        let Some((path, values)) = runs.find(|(path, values)| is_taken(path, values)) else {
            continue;
        };
        let numbers = numbers(path, &inputs);
        for place in path
            .compared
            .iter()
            .flat_map(|compared| &compared.quantities)
        {
            let Ok(form) = relative(path, *place, Domain::UNIT, format) else {
                continue;
            };
            let Some([value, permanent]) = &numbers[*place as usize] else {
                continue;
            };
            let error = (exact(values[*place as usize].to_f64()) - value).abs();
            let bound = Big::from(form.factor) * permanent + Big::from(form.underflow);
            assert!(error <= bound, "{name}: {inputs:?} at {place}");
            count += 1;
            if !bound.is_zero() {
                largest = largest.max((error / bound).to_f64().expect("a share"));
            }
        }
    }
    (largest, count)
}

#[test]
fn no_error_passes_its_bound_by_the_permanent() {
    for name in [
        "scalar-triple",
        "moller-trumbore-culling",
        "moller-trumbore-culling+fma",
        "woop-watertight",
        "woop-watertight+fma",
        "plucker",
    ] {
        let found = [
            largest_share::<f32>(name, Format::F32),
            largest_share::<f64>(name, Format::F64),
        ];
        println!("{name}: {found:?}");
        assert!(
            found
                .iter()
                .all(|(largest, count)| *largest > 0.1 && *count > 50),
            "{name}: {found:?}"
        );
    }
}

/// A case with an error of 1.995 u, from a random search.
#[test]
fn a_difference_of_products_in_f64_is_rounded_more_than_once() {
    let inputs = [
        0x3fef_9661_6cc1_34e8,
        0x3fef_f3f2_6270_b4ee,
        0x3feb_c0cb_e8dc_666a,
        0xbfed_a7da_1cf2_ed3e,
    ];
    let inputs: [f64; 4] = inputs.map(f64::from_bits);
    let (path, place) = recorded(|| {
        let [a, b, c, d] = [6, 7, 9, 10].map(Recorded::input);
        Recorded::difference_of_products(&a, &b, &c, &d)
    });
    let [a, b, c, d] = inputs.map(exact);
    let computed = f64::difference_of_products(&inputs[0], &inputs[1], &inputs[2], &inputs[3]);
    let units = (exact(computed) - (a * b - c * d)).abs() / Big::from(Format::F64.unit());
    let units = units.to_f64().expect("small");
    assert!(units > 1.995, "{units}");
    let domain = Domain {
        world: Dyadic::ONE,
        ..Domain::UNIT
    };
    let mut prover = Prover::new(&path, domain, Format::F64);
    let bound = prover.bound(place).expect("a bound").error.to_f64() / Format::F64.unit().to_f64();
    assert!((2.0..2.001).contains(&bound), "{bound}");
    assert_eq!(
        prover.bound_before_last(place),
        Ok(prover.bound(place).expect("a bound").error)
    );
}

/// One product underflows, and is multiplied by 2^100: wrong by more than the permanent and the unit domain's share of
/// underflows allow. Both hold with 2^20 times as long a direction, where nothing underflows.
#[test]
fn what_underflow_adds_is_known_in_a_domain_only() {
    let paths = paths_of::<f32>(find("moller-trumbore").expect("a kernel")).expect("a program");
    let place = paths[0].compared[0].quantities[0];
    let form = relative(&paths[0], place, Domain::UNIT, Format::F32).expect("a permanent");
    // o, d, a, b, c, t_min and t_max; with a = 0 the edges are b and c.
    let error = |d_y: f64| {
        let inputs: [f64; 17] = std::array::from_fn(|i| match i {
            4 => d_y,
            9 => 2f64.powi(100),
            14 => f64::from(1.4f32) * 2f64.powi(-74),
            _ => 0.0,
        });
        let computed = run(&paths[0], &inputs.map(|x| x as f32));
        let exact = run(&paths[0], &inputs);
        // One term: its size is the permanent.
        let (exact, computed) = (exact[place as usize].abs(), computed[place as usize].abs());
        let allowed = form.factor.to_f64() * exact + form.underflow.to_f64();
        ((f64::from(computed) - exact).abs(), allowed)
    };
    let d_y = f64::from(1.3f32) * 2f64.powi(-75);
    let (wrong, allowed) = error(d_y);
    assert!(
        (3.1e-16..3.3e-16).contains(&wrong) && allowed < 1.4e-21,
        "{wrong} {allowed}"
    );
    let (wrong, allowed) = error(d_y * 2f64.powi(20));
    assert!(wrong <= allowed, "{wrong} {allowed}");
}
