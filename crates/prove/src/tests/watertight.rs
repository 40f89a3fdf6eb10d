//! The claims that follow from the edge values of all paths together, and kernels from which they do not follow.

use crate::Symmetry;
use crate::arith::{Exact, Real, Vector};
use crate::case::{Case, Draw, Ray, Triangle};
use crate::kernel::{
    Gate, Gated, Generic, Hit, Kernel, KernelInfo, Path, Refuse, Role, Scalar, Sink, find,
};
use crate::watertight::symmetry;
use hairline_core::Contract;
use std::cell::Cell;

/// How the kernel of these tests decides its edges.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Decides {
    /// As it should, on both sides.
    Well,
    /// On the front alone.
    OneSide,
    /// On both sides, but the back without its edges.
    WithAnOpenBack,
    /// By its own comparisons, the refusing one first.
    ByItself,
    /// The axes are the ray's choice, or that of a vertex, or of the interval.
    OnAxesOfTheRay,
    OnAxesOfAVertex,
    OnAxesOfTheInterval,
    /// It refuses a 0, whatever a NaN does.
    WithoutZero,
    WithoutZeroOrNan,
    /// On the front by sign bits, of which a 0 may have either.
    BySignBits,
    /// By sizes too.
    AgainstEachOther,
    /// By two values of one edge.
    WithASecondValue,
    /// One of the three values is taken for its negative.
    OneNegated,
    /// Another number than 0 is compared.
    AgainstOne,
    /// Two of three edges are compared.
    TwoOfThree,
    /// Something is refused that is no gate.
    WithoutAGate,
    /// One edge's value is twice as large: opposite for the triangle on the other side only if it is the same edge there.
    OneDoubled,
    /// A sum, not a difference: the same for both sides.
    NotOpposite,
    /// A difference that is no determinant.
    OnOneAxis,
    /// Opposite, but 0 divided by 0 where the edge's ends have one x.
    DividedByTheEdge,
    /// Opposite, but 0 divided by 0 for a ray across the axis of the picture.
    SeenAlongOneAxis,
    /// Opposite, but the root of a negative number for rays of one side.
    WithARoot,
    /// Opposite, but another picture once a hit has shortened the interval.
    WithTheInterval,
    /// It goes on where the gate has refused.
    AgainstTheGate,
}
use Decides::*;

thread_local! {
    static DECIDES: Cell<Decides> = const { Cell::new(Well) };
}

/// Edge functions of the vertices along two axes.
struct Flat;

const EDGE: usize = 0;

impl Kernel for Flat {
    const INFO: KernelInfo = KernelInfo {
        gates: &[Gate::signed(Role::Edge, "one of u, v, w < e", 2, 0)],
        ..KernelInfo::own("flat", Contract::CLOSED_RAY)
    };

    crate::kernel::stores_triangle!();

    fn test<V: Vector, S: Sink<V::Real>>(
        triangle: &Triangle<V>,
        ray: &Ray<V>,
        sink: &mut S,
    ) -> Option<Hit<V::Real>> {
        let decides = DECIDES.get();
        let zero = V::Real::zero();
        let [a, b, c] = [&triangle.a, &triangle.b, &triangle.c].map(|p| p.minus(&ray.origin));
        let turned = match decides {
            OnAxesOfTheRay => ray.direction.at(0).is_less(&zero),
            OnAxesOfAVertex => triangle.a.at(0).is_less(&zero),
            OnAxesOfTheInterval => ray.t_max.is_less(&zero),
            _ => false,
        };
        let (x, y) = if turned { (1, 2) } else { (0, 1) };
        let at = |p: &V, axis: usize| match decides {
            WithTheInterval => p.at(axis) + &ray.t_max,
            SeenAlongOneAxis => {
                let slope = ray.direction.at(axis) / &ray.direction.at(2);
                p.at(axis) - &(slope * &p.at(2))
            }
            WithARoot => p.at(axis) * &ray.direction.at(2).sqrt(),
            _ => p.at(axis),
        };
        let edge = |p: &V, q: &V| {
            let (first, second) = (at(p, x) * at(q, y), at(q, x) * at(p, y));
            match decides {
                NotOpposite => first + &second,
                OnOneAxis => p.at(x) - &q.at(x),
                DividedByTheEdge => (first - &second) / (p.at(x) - &q.at(x)).abs(),
                _ => first - &second,
            }
        };
        let [u, v, mut w] = [edge(&b, &c), edge(&c, &a), edge(&a, &b)];
        if decides == OneDoubled {
            w = w.clone() + &w;
        }
        let [minus_u, minus_v, minus_w] = [-u.clone(), -v.clone(), -w.clone()];
        let clauses = match decides {
            OneNegated => [[&u, &v, &minus_w], [&minus_u, &minus_v, &w]],
            OneSide => [[&u, &v, &w], [&u, &v, &w]],
            TwoOfThree => [[&u, &v, &v], [&minus_u, &minus_v, &minus_v]],
            _ => [[&u, &v, &w], [&minus_u, &minus_v, &minus_w]],
        };
        let all = |accepts: &dyn Fn(&V::Real) -> bool| [&u, &v, &w].into_iter().all(accepts);
        let both = |e: &V::Real| all(&|x| !x.is_less(e)) || all(&|x| !e.is_less(x));
        let passes = match decides {
            WithoutZero => sink.gate(EDGE, Refuse::AtMost, clauses),
            WithoutZeroOrNan => sink.gate(EDGE, Refuse::UnlessAbove, clauses),
            AgainstOne => {
                let one = V::Real::one();
                sink.rounded(EDGE, |_| all(&|x| one.is_at_most(x)), || zero.clone())
            }
            ByItself => sink.rounded(EDGE, both, || zero.clone()),
            WithAnOpenBack => {
                let accepts = |e: &V::Real| all(&|x| !x.is_less(e)) || all(&|x| x.is_less(e));
                sink.rounded(EDGE, accepts, || zero.clone())
            }
            BySignBits => {
                let set = |x: &V::Real| x.is_sign_negative();
                let accepts = |e: &V::Real| all(&|x| !set(x)) || all(&|x| !e.is_less(x));
                sink.rounded(EDGE, accepts, || zero.clone())
            }
            AgainstEachOther => {
                let is_wrong = |e: &V::Real| e.is_less(&u) && u.is_less(&v);
                let accepts = |e: &V::Real| both(e) && !is_wrong(e);
                sink.rounded(EDGE, accepts, || zero.clone())
            }
            WithASecondValue => {
                let second = w.clone() + &w;
                let accepts = |e: &V::Real| both(e) && !second.is_less(e);
                sink.rounded(EDGE, accepts, || zero.clone())
            }
            _ => sink.gate(EDGE, Refuse::Below, clauses),
        };
        let passes = passes.is_some();
        let hits = match decides {
            AgainstTheGate => true,
            WithoutAGate => passes && !(u.clone() + &v + &w).is_zero(),
            _ => passes,
        };
        hits.then_some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    }
}

fn paths_of_flat(decides: Decides) -> Result<Vec<Path>, String> {
    DECIDES.set(decides);
    <Generic<Flat> as Gated<f32>>::paths(&Generic::SUBJECT)
}

#[test]
fn all_edges_that_one_ray_may_meet_are_of_one_picture_and_decided_by_their_closed_signs() {
    for (decides, expected) in [
        (Well, Symmetry::ExactSigns),
        (ByItself, Symmetry::ExactSigns),
        (OnAxesOfTheRay, Symmetry::ExactSigns),
        (OnOneAxis, Symmetry::Negatives),
        // Of triangles that face away nothing is accepted, or not the edges.
        (OneSide, Symmetry::None),
        (WithAnOpenBack, Symmetry::None),
        // Two triangles of an edge may have two pictures.
        (OnAxesOfAVertex, Symmetry::None),
        // A hit that is found shortens the interval of the triangles after it.
        (OnAxesOfTheInterval, Symmetry::None),
        (WithoutZero, Symmetry::None),
        (WithoutZeroOrNan, Symmetry::None),
        (BySignBits, Symmetry::None),
        (AgainstEachOther, Symmetry::None),
        (WithASecondValue, Symmetry::None),
        (OneNegated, Symmetry::None),
        (AgainstOne, Symmetry::None),
        (TwoOfThree, Symmetry::None),
        (WithoutAGate, Symmetry::None),
        (OneDoubled, Symmetry::None),
        (NotOpposite, Symmetry::None),
        (DividedByTheEdge, Symmetry::None),
        (SeenAlongOneAxis, Symmetry::None),
        (WithARoot, Symmetry::None),
        (WithTheInterval, Symmetry::None),
    ] {
        let paths = paths_of_flat(decides).unwrap();
        assert_eq!(
            symmetry(&paths, |gate| gate == EDGE),
            expected,
            "{decides:?}"
        );
    }
    assert_eq!(
        symmetry(&paths_of_flat(Well).unwrap(), |_| false),
        Symmetry::None
    );
}

#[test]
fn a_gate_that_compares_by_itself_hides_none_of_its_numbers() {
    for decides in [Well, ByItself, BySignBits, AgainstOne] {
        for path in paths_of_flat(decides).unwrap() {
            let compared = &path.compared[0].quantities;
            let computed = compared.iter().filter(|place| {
                let operation = path.operations[**place as usize];
                matches!(operation, crate::arith::recorded::Operation::Sub(..))
            });
            assert_eq!(computed.count(), 3, "{decides:?}");
        }
    }
}

#[test]
fn a_kernel_that_goes_on_where_a_gate_has_refused_has_no_program() {
    let error = paths_of_flat(AgainstTheGate).unwrap_err();
    assert_eq!(error, "it goes on after gate 'edge' has refused");
}

/// Vertices whose images are all at the origin: each is rounded onto the ray. The ray meets the triangle's inside, and the
/// edge gate accepts it, but the determinant is computed as 0.
#[test]
fn woops_parallel_gate_refuses_met_triangles_whose_edge_values_are_all_zero() {
    let kernel = find("woop-watertight").expect("a kernel");
    let gated: &dyn Gated<f32> = f32::subject(kernel).expect("f32").gated().expect("gates");
    let place = |name: &str| kernel.info.gates.iter().position(|gate| gate.name == name);
    let [edge, parallel] = ["edge", "parallel"].map(|name| place(name).expect("a gate"));
    let direction = [0.3f32, -0.7, 1.0];
    let mut draw = Draw::new("images", 1, 1);
    let mut met = 0;
    for _ in 0..64 {
        let vertices = [(); 3].map(|()| {
            let z = 1.5 + draw.symmetric::<f32>() / 2.0;
            direction.map(|x| x * z)
        });
        let case = Case::new([0.0; 3], direction, vertices).on(0.0, 4.0);
        let exact = gated.measure_exact(&case).margins;
        let zero = Exact::zero();
        if zero.is_less(&exact[edge]) && zero.is_less(&exact[parallel]) {
            met += 1;
            let computed = gated.thresholds(&case);
            assert_eq!(
                (computed[edge], computed[parallel]),
                (0.0, 0.0),
                "{}",
                case.hex()
            );
        }
    }
    assert!(8 < met, "{met}");
}
