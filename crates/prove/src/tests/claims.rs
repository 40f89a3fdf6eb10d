//! Kernels whose gates have the usual roles and compare other numbers: the sentences of the roles are not said of them.

use crate::arith::{Exact, Real, Vector};
use crate::case::{Case, Draw, Ray, Triangle};
use crate::contract::{Extent, Sides};
use crate::kernel::{
    Entry, Gate, Generic, Hit, Kernel, KernelIn, KernelInfo, Refuse, Role, Scalar, Sink, find,
};
use crate::repair::{Answer, Answered, Guarded};
use crate::{Domain, Effort, Proof, Sample, Summary, statements};
use hairline_core::{Contract, Verdict};
use std::cell::Cell;

/// The numbers that the gates compare. λ is a barycentric coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Compares {
    /// All λ·N·d, or all -λ·N·d.
    Weights,
    /// All -λ·N·d, on both sides.
    WrongSign,
    /// All λ·N·d, on both sides.
    OneSide,
    /// N·N in the gate for parallel rays.
    LengthOfNormal,
    /// |N·d|, or else d_x².
    VolumeOrDirection,
    /// Each λ with 1.
    WithOne,
    /// |N·d| with N = a×b + b×c + c×a.
    OfPoints,
    /// |N·d| as a difference of products of an edge, a vertex seen from the origin, and d.
    OfEdgesAndReach,
    /// λ·N·d times 2^30.
    LargeNumber,
    /// -λ·N·d one by one, the first with 0 times a number that overflows in its size.
    ZeroTimes,
    /// The same with that number times 0.
    TimesZero,
    /// |N·d| in the gate for parallel rays, if d_x is negative.
    VolumeOnOneSide,
}
use Compares::*;

thread_local! {
    static COMPARES: Cell<Compares> = const { Cell::new(Weights) };
}

const EDGE: usize = 0;
const PARALLEL: usize = 1;

const GATES: &[Gate] = &[
    Gate::signed(Role::Edge, "edge", 3, 1),
    Gate::signed(Role::Parallel, "parallel", 3, 1),
];

const fn info(sides: Sides) -> KernelInfo {
    KernelInfo {
        gates: GATES,
        ..KernelInfo::own(
            "claims",
            Contract {
                extent: Extent::Line,
                sides,
                ..Contract::CLOSED_RAY
            },
        )
    }
}

static ON_BOTH: KernelInfo = info(Sides::Both);
static IN_FRONT: KernelInfo = info(Sides::Front);

struct OfClaims;

impl Kernel for OfClaims {
    const INFO: KernelInfo = info(Sides::Both);

    crate::kernel::stores_triangle!();

    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let d = &ray.direction;
        let number = |x: i32| <V::Real as Real>::number(f64::from(x));
        let [ab, ac] = [&triangle.b, &triangle.c].map(|p| p.minus(&triangle.a));
        let normal = ab.cross(&ac);
        let volume = normal.dot(d);
        let [a, b, c] = [&triangle.a, &triangle.b, &triangle.c].map(|p| p.minus(&ray.origin));
        let positive = [(&b, &c), (&c, &a), (&a, &b)].map(|(p, q)| p.cross(q).dot(d));
        let negative = positive.each_ref().map(|x| -x.clone());
        let parallel = match COMPARES.get() {
            LengthOfNormal => Some(normal.dot(&normal)),
            OfPoints => {
                let [a, b, c] = [&triangle.a, &triangle.b, &triangle.c];
                let normal = a.cross(b).plus(&b.cross(c)).plus(&c.cross(a));
                Some(normal.dot(d).abs())
            }
            VolumeOnOneSide if d.at(0).is_sign_negative() => Some(volume.abs()),
            OfEdgesAndReach => Some((ab.cross(&c).dot(d) - &ab.cross(&a).dot(d)).abs()),
            _ => None,
        };
        if let Some(number) = parallel {
            sink.gate(PARALLEL, Refuse::Below, [[&number]])?;
        }
        match COMPARES.get() {
            WrongSign => sink.gate(EDGE, Refuse::Below, [negative.each_ref()])?,
            OneSide => sink.gate(EDGE, Refuse::Below, [positive.each_ref()])?,
            WithOne => {
                let one = number(1);
                let weights = positive.each_ref().map(|x| x.clone() / &volume);
                let accepts = |_: &V::Real| weights.iter().all(|x| x.is_at_most(&one));
                sink.rounded(EDGE, accepts, V::Real::zero)?;
            }
            LargeNumber => {
                let large = number(1 << 30);
                let positive = positive.each_ref().map(|x| x.clone() * &large);
                let negative = positive.each_ref().map(|x| -x.clone());
                sink.gate(
                    EDGE,
                    Refuse::Below,
                    [positive.each_ref(), negative.each_ref()],
                )?;
            }
            ZeroTimes | TimesZero => {
                let [p, q] = [&triangle.a, &triangle.b];
                let minor = p.at(0) * &q.at(1) - &(p.at(1) * &q.at(0));
                let step = number(1 << 15);
                let large = minor * &step * &step * &step;
                let zero = match COMPARES.get() {
                    ZeroTimes => number(0) * &large,
                    _ => large * &number(0),
                };
                sink.gate(EDGE, Refuse::Below, [[&(negative[0].clone() + &zero)]])?;
                sink.gate(EDGE, Refuse::Below, [[&negative[1]]])?;
                sink.gate(EDGE, Refuse::Below, [[&negative[2]]])?;
            }
            VolumeOrDirection => {
                let along = d.at(0) * &d.at(0);
                sink.gate(PARALLEL, Refuse::Below, [[&volume.abs()], [&along]])?;
                sink.gate(
                    EDGE,
                    Refuse::Below,
                    [positive.each_ref(), negative.each_ref()],
                )?;
            }
            _ => sink.gate(
                EDGE,
                Refuse::Below,
                [positive.each_ref(), negative.each_ref()],
            )?,
        }
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    }
}

fn entry(compares: Compares, info: &'static KernelInfo) -> Entry {
    COMPARES.set(compares);
    Entry::new(info)
        .with_f32(const { &Generic::<OfClaims>::SUBJECT })
        .with_f64(const { &Generic::<OfClaims>::SUBJECT })
}

/// All sentences about a kernel, and about an epsilon of 1e-4.
fn said(compares: Compares) -> String {
    let entry = entry(compares, &ON_BOTH);
    let summary = Summary::<f32>::new(&entry, Domain::UNIT, &[], &[], Effort::NONE).unwrap();
    let published = [("1e-4".to_owned(), 1e-4)];
    let of_gate = |gate| statements::<f32>(&entry, &summary, gate, None, &published).join("\n");
    let lines: Vec<String> = summary.gates.iter().map(of_gate).collect();
    lines.join("\n")
}

fn hits(compares: Compares, case: Case<f32>, [edge, parallel]: [f32; 2]) -> bool {
    COMPARES.set(compares);
    let mut verdict = [Verdict::miss(None)];
    Generic::<OfClaims>::SUBJECT.run(&[case], &[edge, parallel], &mut verdict);
    verdict[0].hit
}

const TRIANGLE: [[f32; 3]; 3] = [[-0.49, -0.49, 0.25], [0.49, -0.49, 0.25], [0.0, 0.49, 0.25]];

/// Through the middle of the triangle, which has its front below.
fn through(z: f32) -> Case<f32> {
    Case::new([0.0, 0.0, 0.25 - z / 4.0], [0.0, 0.0, z], TRIANGLE)
}

#[test]
fn an_epsilon_loses_no_hit_at_an_edge_only_if_the_gate_wants_weights_of_the_right_sign() {
    let sentence = "loses no hit at an edge";
    assert!(said(Weights).contains(sentence));
    for (compares, z) in [(WrongSign, 1.0), (OneSide, -1.0)] {
        assert!(!said(compares).contains(sentence), "{compares:?}");
        assert!(!hits(compares, through(z), [-0.01, 0.0]));
        assert!(hits(compares, through(-z), [-0.01, 0.0]));
    }
}

#[test]
fn an_epsilon_refuses_parallel_rays_only_if_the_gate_compares_what_is_0_for_them() {
    let sentence = "refuses every ray that is exactly parallel";
    let in_the_plane = Case::new([0.0, 0.0, 0.25], [1.0, 0.0, 0.0], TRIANGLE);
    for compares in [LengthOfNormal, VolumeOrDirection, VolumeOnOneSide] {
        assert!(!said(compares).contains(sentence), "{compares:?}");
        assert!(hits(compares, in_the_plane, [0.0, 0.5]), "{compares:?}");
    }
    assert!(said(OfPoints).contains(sentence));
    assert!(!hits(OfPoints, in_the_plane, [0.0, 0.5]));
}

#[test]
fn the_coordinates_that_a_parallel_gate_computes_with_are_all_named() {
    let of = |what: &str| {
        format!(
            "e = 1e-4 is proved to refuse every parallel ray where coordinates of {what} are at most"
        )
    };
    let points = said(OfPoints);
    assert!(points.contains(&of("points")), "{points}");
    let both = said(OfEdgesAndReach);
    assert!(
        both.contains(&of("edges and of vectors from the origin to the vertices")),
        "{both}"
    );
}

#[test]
fn a_gate_that_compares_with_1_is_wrong_near_1() {
    assert!(!said(WithOne).contains("decides otherwise"));
    // A weight is above 1 by 4e-8.
    let case = Case::new(
        [-0.23484814, -0.65660614, -0.24924491],
        [-0.7408463, 0.9810069, -0.5866176],
        [
            [-0.3706774, -0.47674495, -0.35679737],
            [-0.2539909, 0.43242586, 0.17459019],
            [0.20262466, 0.20144278, -0.32225922],
        ],
    )
    .on(0.0, 1.0);
    let exact = Sample::of(&case.numbers().map(|x| Exact::from_f64(f64::from(x))));
    let one = Exact::one();
    assert!([0, 1, 2].iter().any(|i| one.is_less(&exact.weight(*i))));
    assert!(hits(WithOne, case, [0.0, 0.0]));
}

#[test]
fn a_number_that_the_checker_does_not_read_has_no_bound() {
    let entry = entry(LargeNumber, &ON_BOTH);
    let proof = Proof::of::<f32>(&entry, None, Domain::UNIT).unwrap();
    let why = "it has a number of more digits than a float has";
    assert_eq!(proof.quantities[0].bound.as_ref().unwrap_err(), why);
    // A guarded kernel asks for the sign alone, and needs no factor.
    assert!(Guarded::new::<f32>(&entry).is_ok());
    // In f64 it has.
    let wide = Proof::of::<f64>(&entry, None, Domain::UNIT).unwrap();
    assert!(wide.quantities[0].bound.is_ok());
}

/// The number whose size would be infinity times 0 is near its edge, where the margins of the other two are far too small.
#[test]
fn zero_times_a_number_whose_size_overflows_costs_no_margin() {
    for compares in [ZeroTimes, TimesZero] {
        no_margin_is_lost(compares);
    }
}

fn no_margin_is_lost(compares: Compares) {
    let guarded = Guarded::new::<f32>(&entry(compares, &IN_FRONT)).unwrap();
    let ready = guarded.ready::<f32>();
    let mut draw = Draw::new("zero", 1, 1);
    let mut decided = 0;
    for _ in 0..20_000 {
        let far = 2f64.powi(41) * (1.0 + 0.3 * draw.unit());
        let vertices = [(); 3]
            .map(|()| [(); 3].map(|()| (far + draw.symmetric::<f64>() * 2f64.powi(40)) as f32));
        let [a, b, c] = vertices.map(|vertex| vertex.map(f64::from));
        let near = 2f64.powi(20 + draw.below(20) as i32);
        let origin = a.map(|x| (x + near * draw.symmetric::<f64>()) as f32);
        let share = draw.unit();
        let direction = std::array::from_fn(|i| {
            let on_edge = b[i] + share * (c[i] - b[i]);
            ((on_edge - f64::from(origin[i])) * 2f64.powi(-40)) as f32
        });
        let case = Case::new(origin, direction, vertices).on(-f32::INFINITY, f32::INFINITY);
        let exact = Sample::of(&case.numbers().map(|x| {
            // The interval is not looked at.
            Exact::from_f64(f64::from(x.clamp(f32::MIN, f32::MAX)))
        }));
        let zero = Exact::zero();
        let is_front = exact.volume().is_less(&zero);
        let is_inside = [0, 1, 2].iter().all(|i| zero.is_at_most(&exact.weight(*i)));
        match f32::answer(&ready, &case) {
            Answer::Ask => continue,
            Answer::Hit(_) => assert!(is_front && is_inside, "{}", case.hex()),
            Answer::Miss => assert!(!(is_front && is_inside), "{}", case.hex()),
        }
        decided += 1;
    }
    assert!(500 < decided, "{decided}");
}

/// Times a power of two the known ray is another one where its products underflow.
#[test]
fn a_known_parallel_ray_is_said_to_pass_only_where_it_does() {
    let entry = find("cramer").unwrap();
    let effort = Effort {
        evaluations: 2000,
        seed: 1,
    };
    let summary = Summary::<f32>::new(entry, Domain::UNIT, &[], &[], effort).unwrap();
    let mut gates = summary.gates.iter();
    let gate = gates.find(|gate| gate.gate.role == Role::Parallel).unwrap();
    let said = |epsilon: f64| {
        let published = [("that".to_owned(), epsilon)];
        statements::<f32>(entry, &summary, gate, None, &published).join("\n")
    };
    let sentence = "A known parallel ray passes it";
    assert!(said(1e-4).contains(sentence));
    assert!(!said(1e-45).contains(sentence));
}

/// Each ray is divided by less than the bound supposes, and contradicts the sentence without its supposition.
#[test]
fn what_is_said_of_epsilons_holds_where_the_bound_does() {
    let parallel = Case::new(
        [0.0; 3],
        [0.84328145, -0.88634014, 0.67419237],
        [
            [0.0; 3],
            [0.84328145, -0.88634014, 0.67419237],
            [0.6575207, -0.6911172, 0.5256428],
        ],
    );
    let inside = Case::new(
        [0.23685193, 0.019915145, 0.3630145],
        [-0.09413931, -0.11647581, 0.033050433],
        [
            [0.15445551, 0.0041171196, 0.3704322],
            [0.13096973, -0.19723846, 0.42169765],
            [-0.18233205, -0.14812094, 0.42272153],
        ],
    );
    let zero = Exact::zero();
    let exact = |case: &Case<f32>| {
        let case = case.on(0.0, 1.0);
        Sample::of(&case.numbers().map(|x| Exact::from_f64(f64::from(x))))
    };
    assert!(exact(&parallel).volume().is_zero());
    let sample = exact(&inside);
    assert!([0, 1, 2].iter().all(|i| zero.is_less(&sample.weight(*i))));
    for (name, role, sentence, case) in [
        (
            "plane-unit-normal",
            Role::Parallel,
            "refuses every ray that is exactly parallel",
            parallel,
        ),
        (
            "moller-trumbore",
            Role::Edge,
            "loses no hit at an edge",
            inside,
        ),
    ] {
        let entry = find(name).unwrap();
        let summary = Summary::<f32>::new(entry, Domain::UNIT, &[], &[], Effort::NONE).unwrap();
        let mut gates = summary.gates.iter();
        let gate = gates.find(|gate| gate.gate.role == role).unwrap();
        let lines = statements::<f32>(entry, &summary, gate, None, &[]);
        let line = lines.iter().find(|line| line.contains(sentence)).unwrap();
        assert!(
            line.starts_with("With such divisors and quotients an epsilon"),
            "{line}"
        );
        let gated = f32::subject(entry).unwrap().gated().unwrap();
        let margin = gated.measure(&case).margins[gate.index];
        // The bounds are 1.65e-6 and 3.94e-6.
        let contradicts = match role {
            Role::Parallel => 1e-5 < margin,
            _ => margin < -1e-5,
        };
        assert!(contradicts, "{name} {margin:e}");
    }
}
