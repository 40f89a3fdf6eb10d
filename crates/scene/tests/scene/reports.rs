//! Reports of other libraries come out right: the nearest face, and all hits. Each test has the report's name.

use crate::drawn::Drawn;
use crate::spheres::{icosphere, matlab_sphere, numbered_obj};
use hairline_core::case::Draw;
use hairline_scene::{Answer, Hit, Judgement, Ray, Scene};
use num_rational::BigRational;

fn faces_of(hits: &[Hit]) -> Vec<Vec<u32>> {
    hits.iter().map(|hit| hit.faces.clone()).collect()
}

/// The box of libigl-python-bindings#78.
pub fn igl_box() -> Drawn<f64> {
    let bits = (0..8).map(|k| [2, 1, 0].map(|bit| f64::from(k >> bit & 1)));
    let faces = [
        [1, 7, 5],
        [1, 3, 7],
        [1, 4, 3],
        [1, 2, 4],
        [3, 8, 7],
        [3, 4, 8],
        [5, 7, 8],
        [5, 8, 6],
        [1, 5, 6],
        [1, 6, 2],
        [2, 6, 8],
        [2, 8, 4],
    ];
    Drawn {
        vertices: bits.collect(),
        faces: faces.map(|face: [u32; 3]| face.map(|i| i - 1)).to_vec(),
    }
}

/// libigl/libigl-python-bindings#78: the hits are at t = 9 and 10; the library says 9 and 9.5.
#[test]
fn libigl_python_bindings_78() {
    let scene = igl_box().scene();
    let down = Ray::new([0.5, 0.1, 10.0], [0.0, 0.0, -1.0]);
    assert_eq!(faces_of(&scene.hits(&down).unwrap()), [[10], [0]]);
    let t = |face: u32| scene.values(&down, face).unwrap().unwrap().t[0];
    assert_eq!([t(10), t(0)], [9.0, 10.0]);
    // The face of 9.5: the ray is parallel to its plane.
    assert_eq!(scene.values(&down, 8).unwrap(), None);
}

/// libigl#2026: from (1, 0.1, 0.1) along -x through the cube around 0 the library reports one hit twice.
#[test]
fn libigl_2026() {
    let mut mesh = igl_box();
    for x in mesh.vertices.iter_mut().flatten() {
        *x -= 0.5;
    }
    let scene = mesh.scene();
    let ray = Ray::new([1.0, 0.1, 0.1], [-1.0, 0.0, 0.0]);
    let hits = scene.hits(&ray).unwrap();
    // The point (0.5, 0.1, 0.1) is on the diagonal of its side.
    let counts: Vec<usize> = hits.iter().map(|hit| hit.faces.len()).collect();
    assert_eq!(counts, [2, 2]);
    let t = |hit: &Hit| scene.values(&ray, hit.faces[0]).unwrap().unwrap().t[0];
    assert_eq!([t(&hits[0]), t(&hits[1])], [0.5, 1.5]);
}

/// alecjacobson/gptoolbox#92: the ray meets two points, with six faces each; Embree gives one of them.
#[test]
fn gptoolbox_92() {
    let scene = matlab_sphere(16).scene();
    let ray = Ray::new([-2.0, 0.0, 0.0], [0.5, 0.0, 0.0]);
    let hits = scene.hits(&ray).unwrap();
    // On the left they lie on both sides of the seam.
    let left = vec![14, 15, 16, 495, 496, 497];
    assert_eq!(faces_of(&hits), [left, vec![239, 240, 241, 270, 271, 272]]);
    for (hit, t) in hits.iter().zip([2.0, 6.0]) {
        for face in &hit.faces {
            assert_eq!(scene.values(&ray, *face).unwrap().unwrap().t, [t; 2]);
        }
    }
    let passages = scene.passages(&ray).unwrap();
    assert_eq!(passages.len(), 2);
    assert!(passages.iter().all(|passage| passage.crosses() == Ok(true)));
}

/// rohan-sawhney/fcpw#14: of two rays through opposite sides of a cube, mirror images of each other, one misses. The stored copy
/// of the report ends before the second ray, so it is the image of the first one here.
#[test]
fn fcpw_14() {
    let (low, high) = (1.6, 14.4);
    let corner = |k: usize| [0, 1, 2].map(|axis| if k >> axis & 1 == 0 { low } else { high });
    let vertices: Vec<[f64; 3]> = (0..8).map(corner).collect();
    let faces = [
        [2, 1, 0],
        [1, 2, 3],
        [4, 2, 0],
        [2, 4, 6],
        [1, 4, 0],
        [4, 1, 5],
        [6, 5, 7],
        [5, 6, 4],
        [3, 6, 7],
        [6, 3, 2],
        [5, 3, 7],
        [3, 5, 1],
    ];
    let scene = Scene::new(&vertices, &faces).unwrap();
    // The diagonals of both sides are y + z = 16.
    for (z, expected) in [(11.5, [3, 10]), (4.5, [2, 11])] {
        let ray = Ray::new([1.0, 8.0, z], [1.0, 0.0, 0.0]);
        assert_eq!(
            faces_of(&scene.hits(&ray).unwrap()),
            expected.map(|face| [face])
        );
        let t = |face: u32| scene.values(&ray, face).unwrap().unwrap().t[0];
        assert_eq!(expected.map(t), [low - 1.0, high - 1.0]);
        let judged = scene.judge(
            &ray,
            &Answer {
                face: None,
                t: None,
            },
        );
        assert_eq!(judged.unwrap().judgement, Judgement::Lost);
    }
}

/// svenstaro/bvh#159, with its two triangles: the box of the second one is inside the box of the first, and the order of boxes is
/// not that of hits.
#[test]
fn bvh_159() {
    let large = [[-0.5, -0.5, -1.0], [1.5, -0.5, 1.0], [-0.5, 1.5, 1.0]];
    let (low, side) = (-0.371737f32, 0.628263);
    let small = [
        [low, low, -0.128263],
        [side, low, 0.871737],
        [low, side, 0.871737],
    ];
    let vertices: Vec<[f32; 3]> = [large, small].concat();
    for faces in [[[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 1, 2]]] {
        let scene = Scene::new(&vertices, &faces).unwrap();
        let [in_large, in_small] = [0, 3].map(|first| {
            let face = faces.iter().position(|face| face[0] == first);
            face.unwrap() as u32
        });
        // The small one lies 0.6152 above the plane z = x + y of the large one.
        let up = Ray::new([0.0, 0.0, -2.0], [0.0, 0.0, 1.0]);
        let down = Ray::new([0.0, 0.0, 2.0], [0.0, 0.0, -1.0]);
        for (ray, order) in [(up, [in_large, in_small]), (down, [in_small, in_large])] {
            assert_eq!(
                faces_of(&scene.hits(&ray).unwrap()),
                order.map(|face| [face])
            );
            assert_eq!(scene.nearest(&ray).unwrap().unwrap().faces, [order[0]]);
        }
    }
}

/// gkjohnson/three-mesh-bvh#140: with `firstHitOnly` another face than the first of all hits. The report has no numbers; here are
/// long faces whose boxes hold each other, in all directions.
#[test]
fn three_mesh_bvh_140() {
    let mut several = 0;
    for index in 0..300 {
        let mut draw = Draw::new("long faces", 1, index);
        let mut vertices: Vec<[f32; 3]> = Vec::new();
        for _ in 0..20 {
            let (from, to): ([f32; 3], [f32; 3]) = (draw.point(), draw.point());
            let aside: [f32; 3] = draw.point();
            vertices.extend([from, to, [0, 1, 2].map(|i| to[i] + aside[i] / 8.0)]);
        }
        let faces: Vec<[u32; 3]> = (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let scene = Scene::new(&vertices, &faces).unwrap();
        for _ in 0..20 {
            let target: [f32; 3] = draw.pick(&vertices);
            let origin: [f32; 3] = draw.point();
            let ray = Ray::new(origin, [0, 1, 2].map(|i| target[i] - origin[i]));
            // All faces, one by one, in rationals.
            let exact = (0..20).filter_map(|face| {
                let values = scene.fractions(&ray, face).unwrap()?;
                Some((values.t[0].clone(), face))
            });
            let exact: Vec<(BigRational, u32)> = exact.collect();
            let least = exact.iter().map(|(t, _)| t).min();
            let first = exact.iter().filter(|(t, _)| Some(t) == least);
            let first: Vec<u32> = first.map(|(_, face)| *face).collect();
            let nearest = scene.nearest(&ray).unwrap();
            assert_eq!(nearest.map_or(Vec::new(), |nearest| nearest.faces), first);
            several += u64::from(1 < exact.len());
        }
    }
    assert!(300 < several, "{several}");
}

/// Embree 4 in its robust mode lets 66 of 19,002 such rays through a tetrahedron.
#[test]
fn embree_at_the_vertices_of_a_tetrahedron() {
    let (p, q) = (0.75, 0.5);
    let vertices = [[p, q, q], [-p, -q, q], [-q, p, -q], [q, -p, -p]];
    let scene =
        Scene::<f32>::new(&vertices, &[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]).unwrap();
    let mut from_outside = 0;
    for index in 0..3000 {
        let mut draw = Draw::new("tetrahedron", 1, index);
        let vertex = draw.below(4);
        let direction = draw.lattice_point(1 << 15).map(|x| x as f32 / 32768.0);
        let origin = [0, 1, 2].map(|i| vertices[vertex][i] - direction[i]);
        let is_exact = (0..3).all(|i| origin[i] + direction[i] == vertices[vertex][i]);
        if !is_exact || direction == [0.0; 3] {
            continue;
        }
        let ray = Ray::new(origin, direction);
        let nearest = scene.nearest(&ray).unwrap().expect("a vertex at t = 1");
        assert!(nearest.t.lower <= 1.0);
        if 1.0 <= nearest.t.upper {
            assert_eq!(nearest.faces.len(), 3, "{ray:?}");
            from_outside += 1;
        }
    }
    assert!(500 < from_outside, "{from_outside}");
}

/// Embree 4 in its robust mode passes through a vertex of six faces, none of which the ray grazes, and answers the far side, at
/// t = 1.894: 1.95 behind, where the longest edge is 0.165.
#[test]
fn embree_at_a_vertex_of_an_icosphere() {
    let mesh = icosphere(3);
    assert_eq!(mesh.faces.len(), 1280);
    let origin = [-1.871_312_1, -0.391_418_46, -2.519_657_1];
    let direction = [1.345_581, 0.391_418_46, 1.669_006_3];
    let point = [-0.525_731_1, 0.0, -0.850_650_8];
    let is_exact = |i: usize| f64::from(origin[i]) + f64::from(direction[i]) == f64::from(point[i]);
    assert!((0..3).all(is_exact));
    let scene = mesh.scene();
    let ray = Ray::new(origin, direction);
    let nearest = scene.nearest(&ray).unwrap().unwrap();
    let with_vertex = (0..1280).filter(|face| {
        let corners = mesh.faces[*face as usize];
        corners.iter().any(|i| mesh.vertices[*i as usize] == point)
    });
    assert_eq!(nearest.faces, with_vertex.collect::<Vec<u32>>());
    assert_eq!(nearest.faces.len(), 6);
    for face in &nearest.faces {
        assert_eq!(scene.values(&ray, *face).unwrap().unwrap().t, [1.0; 2]);
    }
    let behind = &scene.hits(&ray).unwrap()[1];
    assert!((behind.from.lower - 1.894).abs() < 0.001, "{behind:?}");
    let answer = Answer {
        face: Some(behind.faces[0]),
        t: Some(behind.from.lower),
    };
    let judged = scene.judge(&ray, &answer).unwrap();
    assert_eq!(judged.judgement, Judgement::Farther);
    assert!(
        (judged.off.unwrap() - 1.95 / 0.165).abs() < 0.1,
        "{judged:?}"
    );
}

/// Three rays almost in the plane of a twisted strip: Embree 4 answers the second hit, or a t that is off by half the way. The
/// fractions are from another program.
#[test]
fn embree_on_a_twisted_strip() {
    let (mesh, numbers) = numbered_obj(include_str!("mobius.obj"));
    let scene = mesh.scene();
    let cases = [
        (
            [
                -0.8064469695091248,
                -0.03525410592556,
                -0.009604211896657944,
            ],
            [
                0.043769240379333496,
                9.71445146547012e-17,
                2.6020852139652106e-17,
            ],
            vec![
                (
                    999,
                    "2912158999089190982497764992118995/6229801804781413918594948455893074",
                ),
                (
                    1001,
                    "3019690218899908769680511673326525820698624/2294654456810002752302624154338364433304807",
                ),
                (
                    1956,
                    "403497843157595429700680810496/8152255187335163970066824425",
                ),
            ],
        ),
        (
            [
                2.5604100227355957,
                0.028877075761556625,
                0.016007021069526672,
            ],
            [
                -6.405378341674805,
                -3.725290298461914e-09,
                -3.725290298461914e-09,
            ],
            vec![
                (
                    977,
                    "1237037981254612914251484510004203687/2501976345835405774928541587279709944",
                ),
                (
                    976,
                    "1312052401070202183042232977621053942352133/2624104802294664817219313393136090755540896",
                ),
                (
                    974,
                    "2529876273634309498132881261443522935/5003951744511320982571042925071881847",
                ),
            ],
        ),
        (
            [
                -2.397892475128174,
                -0.05438520014286041,
                0.009604211896657944,
            ],
            [
                2.3729610443115234,
                -7.450580596923828e-09,
                -2.6020852139652106e-17,
            ],
            vec![
                (
                    986,
                    "15082573923042308369255183912613136276914176/31101329458208058165625522444350835979313273",
                ),
                (
                    987,
                    "122389153805179863609796501628068653198703/244778312454699169387757639729627593075696",
                ),
                (
                    989,
                    "64075017783848143642907186980709546827186176/124405309392017559367787803379175426205665259",
                ),
                (
                    1940,
                    "42936216150523671123987529728/31569747928584752157049252979",
                ),
            ],
        ),
    ];
    for (origin, direction, expected) in cases {
        let ray = Ray::new(
            origin.map(|x: f64| x as f32),
            direction.map(|x: f64| x as f32),
        );
        let hits = scene.hits(&ray).unwrap();
        let found = hits.iter().map(|hit| {
            let [face] = hit.faces[..] else {
                panic!("{hit:?}");
            };
            let t = scene.fractions(&ray, face).unwrap().unwrap().t;
            (numbers[face as usize], t[0].clone())
        });
        let expected = expected.iter().map(|(face, t)| (*face, t.parse().unwrap()));
        assert_eq!(
            found.collect::<Vec<_>>(),
            expected.collect::<Vec<(u32, BigRational)>>()
        );
        let nearest = scene.nearest(&ray).unwrap().unwrap();
        assert_eq!(nearest.faces, hits[0].faces);
    }
}
