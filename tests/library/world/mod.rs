//! A second world of another design: meshes, rays and a truth that share no code with the families, the meshes or the
//! oracle. What happens in it is compared with what hairline says of a scene whose numbers fit: rates by stratum, the
//! table of `offset`, and the cost of recommended epsilons. So a family that never draws what real meshes have is noticed.
//!
//! `HAIRLINE_WORLD=whole` draws 25 times as many rays, and prints every comparison.

mod allowed;
mod costs;
mod counts;
mod dice;
mod exact;
mod meshes;
mod rays;
mod starts;

use allowed::{Allowed, Comparison};
use costs::Recommended;
use counts::{Tuned, by_plane, read, scene_of, theirs, theirs_at};
use dice::Dice;
use hairline::internals::kernel::Scalar;
use hairline::internals::offset::{PUBLISHED, PointKind, Scheme, default_schemes};
use meshes::{MESHES, Mesh};
use rays::{Aim, shots};

fn sample(count: u64) -> u64 {
    if std::env::var("HAIRLINE_WORLD").is_ok_and(|word| word == "whole") {
        25 * count
    } else {
        count
    }
}

fn meshes<F: Scalar>() -> impl Iterator<Item = Mesh> {
    MESHES.iter().map(|make| make(|x| F::from_f64(x).to_f64()))
}

/// Planes of which so few rays are in a sample are left out.
const FEW: usize = 100;

const RATES: &[Allowed] = &[
    Allowed::new(
        "room plane-inside-out Edge axis|axis-0|axis-near-0",
        1.5,
        7.0,
        "edges along axes never crack there, and both halves of a tile have one normal, so that diagonals seldom do; the \
         loft, with the same tiles pulled out of shape, agrees within 1.5",
    ),
    Allowed::new(
        "room Edge|Vertex axis|axis-0|axis-near-0",
        1.25,
        3.0,
        "two of three edges lie along axes, where products with 0 are exact; half of hairline's do",
    ),
    Allowed::new(
        "loft Edge|Vertex axis|axis-0|axis-near-0",
        1.8,
        1.25,
        "no edge lies along an axis, and floors are at one y: MT's cracks at floors of hairline are 1.7 times as many \
         where the edge is turned, and 1.4 times as many at one y as at one z",
    ),
    Allowed::new(
        "Edge|Vertex",
        1.5,
        1.6,
        "triangles have other shapes, and fans from 4 to 8 of them",
    ),
    Allowed::new(
        "Leave",
        1.3,
        1.2,
        "first rays come from a room's air, not from all sides",
    ),
    Allowed::new(
        "source Inside",
        1.5,
        3.5,
        "an epsilon of a determinant cuts by area: hairline's triangles have half that of even ones of the same longest edge",
    ),
    Allowed::new(
        "field Along|AlongBeside",
        1.5,
        3.5,
        "the field is flatter than most of hairline's terrain, so that heights are rounded by less",
    ),
    Allowed::new(
        "Along|AlongBeside",
        1.6,
        2.5,
        "the same triangles of half the area",
    ),
    Allowed::new("Inside|Beside", 2.0, 2.0, "both are rare"),
];

#[test]
fn wrong_answers_are_as_frequent_as_hairline_says() {
    let mut comparison = Comparison::new(RATES);
    let kernels = [
        "moller-trumbore",
        "cramer",
        "plane-inside-out",
        "woop-watertight",
    ];
    compare_rates::<f32>(&mut comparison, &kernels);
    compare_rates::<f64>(&mut comparison, &kernels[..1]);
    assert!(80 < comparison.seen, "{}", comparison.seen);
    comparison.end();
}

fn compare_rates<F: Scalar>(comparison: &mut Comparison, kernels: &[&str]) {
    for mesh in meshes::<F>() {
        for kernel in kernels {
            let tuned = Tuned::new(kernel);
            let all = [
                ("zero", tuned.zeros::<F>()),
                ("source", tuned.published::<F>()),
            ];
            // Where a source has no epsilons, both are the same.
            let different = 1 + usize::from(all[0].1 != all[1].1);
            for aim in Aim::ALL {
                let planes = by_plane::<F>(&mesh, aim, &tuned, 5, sample(4000) as usize);
                for (plane, shots) in planes.iter().filter(|(_, shots)| FEW <= shots.len()) {
                    let scene = scene_of(&mesh, shots, plane);
                    for (set, epsilons) in &all[..different] {
                        let here = tuned.wrong(aim, shots, epsilons);
                        let said = theirs(&tuned, &scene, aim, epsilons, sample(4000));
                        let row =
                            format!("{} {kernel} {} {set} {aim:?} {plane}", mesh.name, F::NAME);
                        comparison.add(&row, here, said);
                    }
                }
            }
        }
    }
}

const AT_MESHES: &[Allowed] = &[
    Allowed::new(
        "room|loft Along|AlongBeside",
        1.5,
        3.5,
        "hairline chooses any face, small ones included; here a face is as likely as it is large",
    ),
    Allowed::new(
        "room|loft Edge|Vertex",
        1.15,
        1.5,
        "hairline's rays come through walls, too",
    ),
    Allowed::new("", 1.2, 1.2, "the mesh is the same"),
];

#[test]
fn at_the_same_mesh_wrong_answers_are_as_frequent() {
    let mut comparison = Comparison::new(AT_MESHES);
    for mesh in meshes::<f32>() {
        for kernel in ["moller-trumbore", "plane-inside-out"] {
            let tuned = Tuned::new(kernel);
            let zeros = tuned.zeros::<f32>();
            for aim in Aim::ALL {
                let mut dice = Dice::new(31);
                let count = sample(4000);
                let shots = shots::<f32>(&mesh, aim, tuned.row.entry, &mut dice, count as usize);
                let here = tuned.wrong(aim, &shots, &zeros);
                let said = theirs_at(&tuned, &read(&mesh, &shots), aim, &zeros, count);
                comparison.add(&format!("{} {kernel} {aim:?}", mesh.name), here, said);
            }
        }
    }
    assert!(20 < comparison.seen, "{}", comparison.seen);
    comparison.end();
}

const STARTS: &[Allowed] = &[
    Allowed::new(
        "Ray normal|t-min|t-relative",
        5.0,
        f64::INFINITY,
        "a fixed distance fails at the largest coordinates and on the steepest rays from afar: the walls of a room are at the \
         largest, and below its ceiling no ray comes from as far above a floor as in hairline's scene",
    ),
    Allowed::new(
        "Ray waechter-binder|pbrt-v3|pbrt-v4|mitsuba axis",
        1.5,
        f64::INFINITY,
        "walls are far from 0, where these schemes never fail; hairline's planes are at any coordinate, and the sphere, whose \
         surface passes 0, agrees",
    ),
    Allowed::new(
        "Ray mitsuba generic",
        1.5,
        12.0,
        "wrong only near 0, and there is little surface",
    ),
    Allowed::new(
        "Ray waechter-binder|mitsuba axis-0|axis-near-0|terrain",
        1.5,
        2.0,
        "how often depends on heights and on how steep rays are",
    ),
    Allowed::new(
        "",
        1.35,
        1.35,
        "nothing differs but the shapes of triangles",
    ),
];

#[test]
fn new_rays_start_wrong_as_often_as_offset_says() {
    // Other tests of this binary may add schemes of their own.
    let name = |scheme: &Scheme| scheme.name.split('=').next().unwrap().to_owned();
    let is_published = |scheme: &Scheme| {
        PUBLISHED
            .iter()
            .any(|published| published.name == name(scheme))
    };
    let schemes: Vec<Scheme> = default_schemes().into_iter().filter(is_published).collect();
    let tuned = Tuned::new("moller-trumbore");
    let mut comparison = Comparison::new(STARTS);
    for mesh in meshes::<f32>() {
        for kind in PointKind::ALL {
            let planes = starts::hits::<f32>(&mesh, &tuned, kind, 11, sample(5000) as usize);
            for (plane, hits) in planes.iter().filter(|(_, hits)| FEW <= hits.len()) {
                let scene = scene_of(&mesh, &starts::first_rays(hits), plane);
                let said = starts::theirs::<f32>(&tuned, &scene, kind, &schemes, sample(5000));
                for (scheme, said) in schemes.iter().zip(said) {
                    let row = format!("{} {} {kind:?} {plane}", mesh.name, name(scheme));
                    comparison.add(&row, starts::wrong(scheme, hits), said);
                }
            }
        }
    }
    assert!(40 < comparison.seen, "{}", comparison.seen);
    comparison.end();
}

/// The scenes of the two meshes whose best epsilons still cost something; all, if much time is given.
fn costly() -> impl Iterator<Item = (Mesh, &'static str)> {
    let is_costly = |mesh: &Mesh| ["sphere", "scan"].contains(&mesh.name) || sample(1) != 1;
    // In a room planes of several kinds meet.
    let all = meshes::<f32>().filter(move |mesh| mesh.name != "room" && is_costly(mesh));
    all.map(|mesh| {
        let plane = if mesh.name == "loft" {
            "axis"
        } else {
            mesh.ground
        };
        (mesh, plane)
    })
}

#[test]
fn recommended_epsilons_cost_what_hairline_says_and_little_more_than_the_best() {
    let count = sample(1500);
    for (mesh, plane) in costly() {
        for kernel in ["moller-trumbore", "woop-watertight", "plane-unit-normal"] {
            let found = costs::recommended::<f32>(&mesh, plane, kernel, count);
            let Recommended {
                said,
                here,
                least,
                chance,
            } = found;
            let name = format!("{} {kernel}: {found:?}", mesh.name);
            if std::env::var("HAIRLINE_WORLD").is_ok() {
                println!("{name}");
            }
            // Nothing that this world finds by itself may be much cheaper.
            assert!(here <= 1.1 * least + chance, "{name}");
            // Triangles of hairline's scenes have half the area of even ones.
            assert!(
                here <= 1.5 * said + chance && said <= 3.0 * here + chance,
                "{name}"
            );
        }
    }
}
