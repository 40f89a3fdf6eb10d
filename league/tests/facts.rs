//! Findings that are about more than one verdict, in numbers that can be checked by hand.

use hairline::ScalarName;
use hairline::internals::case::Case;
use hairline::internals::contract::{Contract, Extent};
use hairline::internals::kernel::{Entry, Hit, KernelInfo, Scalar, Verdict};
use hairline::internals::oracle;
use hairline_league::{PROMISE, kernels};

fn kernel(name: &str) -> Entry {
    kernels()
        .into_iter()
        .find(|kernel| kernel.info.name == name)
        .unwrap()
}

fn verdict<F: Scalar>(entry: &Entry, case: &Case<F>) -> Verdict<F> {
    let row = hairline::internals::audit::EpsilonChoice::Source;
    let entry: &'static Entry = Box::leak(Box::new(*entry));
    let epsilons = row.rows(&[entry], None).unwrap()[0].epsilons::<F>();
    let mut verdict = [Verdict::miss(None)];
    F::subject(entry)
        .unwrap()
        .run(std::slice::from_ref(case), &epsilons, &mut verdict);
    verdict[0]
}

/// Straight down from height 1 on a right triangle with legs of this length, at its middle.
fn down_on_legs<F: Scalar>(leg: f64) -> Case<F> {
    let [leg, quarter] = [leg, leg / 4.0].map(F::from_f64);
    let (zero, one) = (F::zero(), F::one());
    let triangle = [[zero; 3], [leg, zero, zero], [zero, leg, zero]];
    Case::new([quarter, quarter, one], [zero, zero, -one], triangle)
}

#[test]
fn obvhs_leaves_a_crack_along_an_edge_that_is_seen_from_the_back() {
    let [o, x, y, below] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0], [0.0, -4.0, 0.0]];
    let hits = |name: &str, z: f32| {
        let entry = kernel(name);
        let ray = |triangle| Case::<f32>::new([1.0, 0.0, z], [0.0, 0.0, -z], triangle);
        let cases = [[o, x, y], [o, below, x]].map(ray);
        cases
            .iter()
            .filter(|case| verdict(&entry, case).hit)
            .count()
    };
    // The ray meets both triangles on the edge that they share, from the front at z = 1.
    assert_eq!([hits("obvhs", 1.0), hits("obvhs", -1.0)], [2, 0]);
    assert_eq!(
        [hits("obvhs-embree", 1.0), hits("obvhs-embree", -1.0)],
        [1, 2]
    );
    assert_eq!([hits("parry3d", 1.0), hits("parry3d", -1.0)], [2, 2]);
}

/// From (x, x, 0), a point of the plane of the triangle (0,0,0), (4,0,0), (0,4,0), along +z: away from the
/// plane on its back.
fn from_the_plane<F: Scalar>(x: f64) -> Case<F> {
    let [zero, one, four, x] = [0.0, 1.0, 4.0, x].map(F::from_f64);
    let triangle = [[zero; 3], [four, zero, zero], [zero, four, zero]];
    Case::new([x, x, zero], [zero, zero, one], triangle)
}

#[test]
fn parry_and_ncollide_mirror_a_triangle_if_the_ray_starts_in_its_plane_and_leaves_by_its_front() {
    for name in ["parry3d", "ncollide3d"] {
        let entry = kernel(name);
        // (-1, -1, 0) is 1.4 units off the triangle.
        let outside = from_the_plane::<f32>(-1.0);
        assert_eq!(
            oracle::truth(&outside).to_string(),
            "transversal, back, t at_min, outside"
        );
        let shown = verdict(&entry, &outside);
        assert!(shown.hit, "{name}");
        // The weights are those of (1, 1, 0), on the other side of a.
        assert_eq!((shown.t, shown.u, shown.v), (0.0, 0.25, 0.25), "{name}");
        assert!(verdict(&entry, &from_the_plane::<f64>(-1.0)).hit, "{name}");
        // (1, 1, 0) itself, inside the triangle, is missed.
        let inside = from_the_plane::<f32>(1.0);
        assert_eq!(
            oracle::truth(&inside).to_string(),
            "transversal, back, t at_min, interior"
        );
        assert!(!verdict(&entry, &inside).hit, "{name}");
        assert!(!verdict(&entry, &from_the_plane::<f64>(1.0)).hit, "{name}");
        // From the front both are right.
        for (case, hit) in [(inside, true), (outside, false)] {
            let mut down = case;
            down.ray.direction.z = -1.0;
            assert_eq!(verdict(&entry, &down).hit, hit, "{name}");
        }
        // One float off the plane both are right: a hit in front of the start, a miss behind it.
        for z in [f32::MIN_POSITIVE, -f32::MIN_POSITIVE] {
            for (case, hit) in [(inside, z < 0.0), (outside, false)] {
                let mut off = case;
                off.ray.origin.z = z;
                assert_eq!(verdict(&entry, &off).hit, hit, "{name}");
            }
        }
    }
}

#[test]
fn parrys_triangle_does_so_through_its_public_ray_cast_too() {
    use parry3d::{math::Vector, query::Ray, query::RayCast, shape::Triangle};
    let [a, b, c] = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(Vector::from);
    let cast = |x: f32, z: f32| {
        let ray = Ray::new(Vector::new(x, x, 0.0), Vector::new(0.0, 0.0, z));
        Triangle::new(a, b, c).cast_local_ray(&ray, f32::MAX, true)
    };
    assert_eq!([cast(1.0, 1.0), cast(-1.0, 1.0)], [None, Some(0.0)]);
    assert_eq!([cast(1.0, -1.0), cast(-1.0, -1.0)], [Some(0.0), None]);
}

#[test]
fn obvhs_intersect_embree_gives_t_times_the_determinant() {
    for leg in [1.0f32, 2.0, 4.0, 0.5] {
        let case = down_on_legs::<f32>(f64::from(leg));
        assert_eq!(verdict(&kernel("obvhs"), &case).t, 1.0);
        // |det| = leg² for this ray.
        assert_eq!(verdict(&kernel("obvhs-embree"), &case).t, leg * leg);
    }
}

/// The shortest leg, a power of two, at which a triangle is hit from straight above.
fn shortest_leg<F: Scalar>(name: &str) -> i32 {
    let entry = kernel(name);
    let is_hit = |power: i32| verdict(&entry, &down_on_legs::<F>(2f64.powi(power))).hit;
    assert!(is_hit(0), "{name}");
    (-60..=0)
        .rev()
        .take_while(|power| is_hit(*power))
        .last()
        .unwrap()
}

#[test]
fn absolute_epsilons_lose_small_triangles_through_their_middle() {
    // det = leg² >= 2^-23 = f32::EPSILON, and 2^-52 = f64::EPSILON.
    assert_eq!(shortest_leg::<f32>("bvh"), -11);
    assert_eq!(shortest_leg::<f64>("bvh"), -26);
    // det = leg² >= 16 EPSILON.
    assert_eq!(shortest_leg::<f32>("rayx-moller-trumbore"), -9);
    assert_eq!(shortest_leg::<f64>("rayx-moller-trumbore"), -24);
    // det = leg² >= 1e-8, 1e-9.
    assert_eq!(shortest_leg::<f32>("mesh-geometry"), -13);
    assert_eq!(shortest_leg::<f64>("mesh-geometry"), -13);
    assert_eq!(shortest_leg::<f64>("manifold-rust"), -14);
    // |n|² = leg⁴ >= 1e-20.
    assert_eq!(shortest_leg::<f32>("rayx"), -16);
    assert_eq!(shortest_leg::<f64>("rayx"), -16);
    // |n| = leg² > f32::EPSILON.
    assert_eq!(shortest_leg::<f32>("fyrox-math"), -11);
    for name in ["parry3d", "obvhs", "obvhs-embree", "ncollide3d"] {
        assert_eq!(shortest_leg::<f32>(name), -60, "{name} has none");
    }
}

/// brepkit's edge functions and tie-breaks, with its fused multiply-add or with a product rounded by
/// itself; hits alone.
fn brepkit(case: &Case<f64>, fused: bool) -> bool {
    let [o, d, a, b, c] = case.vectors();
    let abs = d.map(f64::abs);
    let kz = match abs {
        [x, y, z] if x > y && x > z => 0,
        [_, y, z] if y > z => 1,
        _ => 2,
    };
    let (mut kx, mut ky) = ((kz + 1) % 3, (kz + 2) % 3);
    if d[kz] < 0.0 {
        std::mem::swap(&mut kx, &mut ky);
    }
    let sz = 1.0 / d[kz];
    let (sx, sy) = (d[kx] * sz, d[ky] * sz);
    let [a, b, c] = [a, b, c].map(|p| {
        let p = [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
        [p[kx] - sx * p[kz], p[ky] - sy * p[kz], sz * p[kz]]
    });
    let edge = |p: [f64; 3], q: [f64; 3]| {
        let (ahead, back) = (p[0] * q[1], p[1] * q[0]);
        let value = if fused {
            p[0].mul_add(q[1], -back)
        } else {
            ahead - back
        };
        let sign = |is_positive: bool| if is_positive { 1.0 } else { -1.0 } * f64::MIN_POSITIVE;
        match value {
            0.0 if ahead != back => sign(ahead > back),
            0.0 if p[0] != q[0] => sign(p[0] > q[0]),
            0.0 => sign(p[1] > q[1]),
            value => value,
        }
    };
    let (u, v, w) = (edge(c, b), edge(a, c), edge(b, a));
    let (any_below, any_above) = (u.min(v).min(w) < 0.0, u.max(v).max(w) > 0.0);
    let det = u + v + w;
    let t = u.mul_add(a[2], v.mul_add(b[2], w * c[2]));
    !(any_below && any_above) && det != 0.0 && t * det.signum() > 0.0
}

/// Cracks and doubles, of how many crossings.
fn across(entry: &Entry, family: &str) -> [u64; 3] {
    let outcome = hairline::audit(entry)
        .families([family])
        .count(20_000)
        .run()
        .unwrap();
    let results = outcome.record.result.results.into_iter();
    let part = results
        .filter(|r| r.scalar == ScalarName::F64)
        .find_map(|r| r.across)
        .unwrap();
    [part.cracks.count, part.doubles.count, part.cracks.of]
}

#[test]
fn brepkits_fused_multiply_add_breaks_its_promise_of_exactly_one_hit() {
    const FUSED: KernelInfo = KernelInfo::own("fused", PROMISE);
    const APART: KernelInfo = KernelInfo::own("apart", PROMISE);
    let hit = || {
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    };
    let fused = Entry::new(&FUSED)
        .f64(move |case: &Case<f64>, _: &[f64]| brepkit(case, true).then(hit).flatten());
    let apart = Entry::new(&APART)
        .f64(move |case: &Case<f64>, _: &[f64]| brepkit(case, false).then(hit).flatten());
    let published = kernel("brepkit-math");
    for (family, expected) in [
        ("shared-edge", [291, 284, 8803]),
        ("fan", [29, 27, 20_000]),
        ("polygon", [36, 32, 5030]),
    ] {
        let found = across(&published, family);
        // With both products rounded the promise is kept.
        let [cracks, doubles, _] = across(&apart, family);
        assert_eq!([cracks, doubles], [0, 0], "{family}");
        assert_eq!(found, across(&fused, family), "{family}: not the same test");
        assert_eq!(found, expected, "{family}");
    }
}

/// parry's formula, whose branch follows the sign of t or, repaired, that of d; hits alone.
fn parry(case: &Case<f32>, repaired: bool) -> bool {
    let [o, direction, a, b, c] = case.vectors().map(glam::Vec3::from);
    let (ab, ac, ap) = (b - a, c - a, o - a);
    let n = ab.cross(ac);
    let (d, t) = (n.dot(direction), ap.dot(n));
    if d == 0.0 || t < 0.0 && d < 0.0 || t > 0.0 && d > 0.0 {
        return false;
    }
    let is_negated = if repaired { d > 0.0 } else { t < 0.0 };
    let (sign, e) = (if is_negated { -1.0 } else { 1.0 }, -direction.cross(ap));
    let (v, w) = (sign * ac.dot(e), -sign * ab.dot(e));
    v >= 0.0 && v <= d.abs() && w >= 0.0 && v + w <= d.abs()
}

#[test]
fn parrys_branch_by_the_sign_of_d_mends_starts_in_the_plane_and_changes_nothing_else() {
    const MIRRORED: KernelInfo = KernelInfo::own("mirrored", PROMISE);
    const REPAIRED: KernelInfo = KernelInfo::own("repaired", PROMISE);
    let published = kernel("parry3d");
    let contract = published.info.contract;
    let hit = || {
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    };
    let entry = |info: &'static KernelInfo, repaired| {
        Entry::new(info)
            .f32(move |case: &Case<f32>, _: &[f32]| parry(case, repaired).then(hit).flatten())
    };
    let with_contract = |info: KernelInfo| -> &'static KernelInfo {
        Box::leak(Box::new(KernelInfo { contract, ..info }))
    };
    let [mirrored, repaired] = [
        entry(with_contract(MIRRORED), false),
        entry(with_contract(REPAIRED), true),
    ];
    let wrong = |entry: &Entry, family: &str| {
        let outcome = hairline::audit(entry)
            .families([family])
            .count(20_000)
            .run()
            .unwrap();
        let results = outcome.record.result.results.into_iter();
        let total = results
            .into_iter()
            .find(|result| result.scalar == ScalarName::F32)
            .unwrap()
            .total;
        [total.false_misses.count, total.false_hits.count]
    };
    for (family, before, after) in [
        ("origin-on", [2850, 0], [375, 0]),
        ("lattice", [7, 64], [0, 0]),
        ("edge-near", [1165, 2338], [1165, 2338]),
    ] {
        let found = wrong(&published, family);
        println!(
            "{family}: {found:?} {:?} {:?}",
            wrong(&mirrored, family),
            wrong(&repaired, family)
        );
        assert_eq!(
            found,
            wrong(&mirrored, family),
            "{family}: not the same test"
        );
        assert_eq!(found, before, "{family}");
        assert_eq!(wrong(&repaired, family), after, "{family}");
    }
}

/// obvhs' formula, with the signs of its weights compared as bits or, repaired, as numbers.
fn obvhs(case: &Case<f32>, repaired: bool) -> bool {
    let [o, direction, a, b, c] = case.vectors().map(glam::Vec3A::from);
    let (e1, e2, to_a) = (a - b, c - a, a - o);
    let n = e1.cross(e2);
    let r = direction.cross(to_a);
    let inverse = 1.0 / n.dot(direction);
    let (u, v) = (r.dot(e2) * inverse, r.dot(e1) * inverse);
    let weights = [u, v, 1.0 - u - v];
    let is_inside = match repaired {
        true => weights.iter().all(|w| *w >= 0.0),
        false => weights.iter().all(|w| w.is_sign_positive()),
    };
    let t = n.dot(to_a) * inverse;
    inverse != 0.0 && is_inside && t >= case.ray.t_min && t <= case.ray.t_max
}

#[test]
fn obvhs_weights_compared_as_numbers_leave_fewer_cracks() {
    const INTERVAL: Contract = Contract {
        extent: Extent::Interval,
        ..PROMISE
    };
    const BITS: KernelInfo = KernelInfo::own("bits", INTERVAL);
    const NUMBERS: KernelInfo = KernelInfo::own("numbers", INTERVAL);
    let hit = || {
        Some(Hit {
            t: None,
            uv: None,
            facing: None,
        })
    };
    let entry = |info: &'static KernelInfo, repaired| {
        Entry::new(info)
            .f32(move |case: &Case<f32>, _: &[f32]| obvhs(case, repaired).then(hit).flatten())
    };
    let [bits, numbers] = [entry(&BITS, false), entry(&NUMBERS, true)];
    let across = |entry: &Entry, family: &str| {
        let outcome = hairline::audit(entry)
            .families([family])
            .count(20_000)
            .run()
            .unwrap();
        let results = outcome.record.result.results.into_iter();
        let part = results
            .filter(|r| r.scalar == ScalarName::F32)
            .find_map(|r| r.across)
            .unwrap();
        [part.cracks.count, part.cracks.of]
    };
    for (family, of, before, after) in [
        ("shared-edge", 7278, 1541, 304),
        ("fan", 16_723, 1933, 238),
        ("polygon", 4082, 438, 0),
    ] {
        assert_eq!(
            across(&kernel("obvhs"), family),
            across(&bits, family),
            "{family}: another test"
        );
        assert_eq!(across(&bits, family), [before, of], "{family}");
        assert_eq!(across(&numbers, family), [after, of], "{family}");
    }
}
