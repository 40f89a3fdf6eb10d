//! Reports of other libraries come out right: inside or outside, crossed or touched. Each test has the report's name.

use crate::drawn::Drawn;
use crate::reports::igl_box;
use crate::solids::{Faces, cube, cuboid, octahedron, scene, solids, turned, winding};
use hairline_core::case::Draw;
use hairline_scene::{Location, Ray, Scene, Winding};

const OUTSIDE: Location = Location::Off(Winding::Number(0));
const INSIDE: Location = Location::Off(Winding::Number(1));

/// Oblikovati#1317: parity over the faces that one ray meets. With two points and three faces an outside point seems inside.
#[test]
fn oblikovati_1317() {
    let scene = igl_box().scene();
    let through_edge = Ray::new([0.5, 0.25, 2.0], [0.0, 0.25, -1.0]);
    let hits = scene.hits(&through_edge).unwrap();
    let counts: Vec<usize> = hits.iter().map(|hit| hit.faces.len()).collect();
    assert_eq!(counts, [2, 1]);
    assert_eq!(scene.locate([0.5, 0.25, 2.0]), Ok(OUTSIDE));
    // From inside through a corner of five faces: parity says inside by luck, and outside through one of four.
    let counted = |origin: [f64; 3], corner: [f64; 3]| {
        let direction = [0, 1, 2].map(|i| corner[i] - origin[i]);
        let passages = scene.passages(&Ray::new(origin, direction)).unwrap();
        assert_eq!(passages.len(), 1);
        assert_eq!(passages[0].around, Ok([1, 0].map(Winding::Number)));
        passages[0].faces.len()
    };
    let middle = [0.5; 3];
    let corners = (0..8).map(|k| [0, 1, 2].map(|axis| f64::from(k >> axis & 1)));
    let counts: Vec<usize> = corners.map(|corner| counted(middle, corner)).collect();
    assert_eq!(counts.iter().sum::<usize>(), 36);
    assert!(counts.iter().any(|count| count % 2 == 0), "{counts:?}");
    assert_eq!(scene.locate(middle), Ok(INSIDE));
}

/// isl-org/Open3D#5105: the ray from (-1, -1, 0) along (1, 1, 1) touches one vertex of the unit cube, and the library says inside.
#[test]
fn open3d_5105() {
    let scene = igl_box().scene();
    let ray = Ray::new([-1.0, -1.0, 0.0], [1.0; 3]);
    let passages = scene.passages(&ray).unwrap();
    assert_eq!(passages.len(), 1);
    let point = scene.values(&ray, passages[0].faces[0]).unwrap().unwrap();
    assert_eq!(point.points, [[0.0, 0.0, 1.0]; 2]);
    assert_eq!(passages[0].crosses(), Ok(false));
    assert_eq!(passages[0].around, Ok([Winding::Number(0); 2]));
    // The three points of the report.
    for (point, expected) in [
        ([-1.0, -1.0, 0.0], OUTSIDE),
        ([-1.0; 3], OUTSIDE),
        ([0.5; 3], INSIDE),
    ] {
        assert_eq!(scene.locate(point), Ok(expected));
    }
}

/// dimforge/parry#171, dimforge/ncollide#335 and clbarnes/ncollpyde#3: a ray touches the ridge of a house, and the library reports
/// the inside of the roof, so the point seems inside. The meshes of the reports are not published with them.
#[test]
fn parry_171() {
    let house = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
        [0.0, 2.0, 3.0],
        [4.0, 2.0, 3.0],
    ];
    let faces = [
        [0, 2, 1],
        [0, 3, 2],
        [0, 1, 5],
        [0, 5, 4],
        [2, 3, 4],
        [2, 4, 5],
        [0, 4, 3],
        [1, 2, 5],
    ];
    let scene = Scene::<f64>::new(&house, &faces).unwrap();
    assert_eq!(scene.closed().oriented, Ok(()));
    // Across the ridge, up to it and down from it, along it, and at its end.
    for (origin, target) in [
        ([1.0, -6.0, 3.0], [1.0, 2.0, 3.0]),
        ([1.0, 0.0, 2.0], [1.0, 2.0, 3.0]),
        ([3.0, 0.0, 4.0], [3.0, 2.0, 3.0]),
        ([-1.0, 2.0, 3.0], [0.0, 2.0, 3.0]),
        ([4.0, 0.0, 2.5], [4.0, 2.0, 3.0]),
    ] {
        let ray = Ray::new(origin, [0, 1, 2].map(|i| target[i] - origin[i]));
        let passages = scene.passages(&ray).unwrap();
        assert_eq!(passages.len(), 1, "{ray:?}");
        assert!(2 <= passages[0].faces.len());
        assert_eq!(passages[0].crosses(), Ok(false), "{ray:?}");
        assert_eq!(scene.locate(origin), Ok(OUTSIDE));
    }
}

/// facebookresearch/momentum PR#1035: hits came in the order of the tree, and what was not behind the last one was dropped as a
/// repetition of it.
#[test]
fn momentum_1035() {
    let mut faces = Faces::new();
    for k in 1..12 {
        let [low, high] = [f64::from(-3 * k), f64::from(3 * k + 1)];
        faces.extend(cuboid([low, -2.0, -2.0], [high, 2.0, f64::from(k)]));
        faces.extend(
            octahedron()
                .into_iter()
                .map(|face| face.map(|[x, y, z]| [x + f64::from(5 * k), 2.0 * y, 2.0 * z])),
        );
    }
    let scene = scene(&faces);
    let mut wrong = 0;
    for index in 0..400 {
        let mut draw = Draw::new("unsorted", 1, index);
        let point = draw.lattice_point(12).map(|x| x as f64 + 0.25);
        let number = winding(&faces, point);
        assert_eq!(
            scene.locate(point),
            Ok(Location::Off(Winding::Number(number))),
            "{point:?}"
        );
        let ray = Ray::new(point, [1.0, 0.125, 0.0625]);
        let mut last = 0.0;
        let mut is_odd = false;
        let visited = scene.visit(&ray, |face, _| {
            if let Some(values) = scene.values(&ray, face).unwrap()
                && last + 1e-9 < values.t[0]
            {
                last = values.t[0];
                is_odd = !is_odd;
            }
            None
        });
        visited.unwrap();
        wrong += u32::from(is_odd != (number % 2 != 0));
    }
    assert!(20 < wrong, "{wrong}");
}

/// lcpp-org/RustBCA#238: is a point inside a mesh that is not watertight? That is not defined, and an edge of the hole says why.
#[test]
fn rust_bca_238() {
    let whole = scene(&cube());
    for missing in 0..12 {
        let mut faces = cube();
        let hole = faces.remove(missing);
        let open = scene(&faces);
        let mut draw = Draw::new("open", 1, missing as u64);
        for _ in 0..50 {
            let point = draw.lattice_point(3).map(|x| x as f64 + 0.5);
            let Ok(Location::NotDefined(edge)) = open.locate(point) else {
                panic!("{point:?}");
            };
            assert!(edge.ends.iter().all(|end| hole.contains(end)));
            assert!(matches!(whole.locate(point), Ok(Location::Off(_))));
        }
        // What is on a face is on it, hole or not.
        let [a, b, c] = faces[0];
        let on = [0, 1, 2].map(|i| a[i] / 2.0 + b[i] / 4.0 + c[i] / 4.0);
        assert_eq!(open.locate(on), Ok(Location::On(vec![0])));
    }
}

/// BlueQuartzSoftware/simplnx#961: the answer depended on the direction of the ray. The report has no numbers.
#[test]
fn simplnx_961() {
    let mut odd_and_even = 0;
    for (name, faces) in solids() {
        let scene = scene(&faces);
        for index in 0..60 {
            let mut draw = Draw::new("directions", 1, index);
            let point = draw.lattice_point(4).map(|x| x as f64 + 0.5);
            let number = winding(&faces, point);
            let mut parities = [false; 2];
            for _ in 0..30 {
                // Many of them meet edges and vertices, and run in faces.
                let direction = draw.lattice_point(2).map(|x| x as f64);
                if direction == [0.0; 3] {
                    continue;
                }
                let ray = Ray::new(point, direction);
                let passages = scene.passages(&ray).unwrap();
                let first = passages.first().map(|passage| passage.around.unwrap()[0]);
                let found = first.unwrap_or(Winding::Number(0));
                assert_eq!(found, Winding::Number(number), "{name} {ray:?}");
                let met: usize = passages.iter().map(|passage| passage.faces.len()).sum();
                parities[met % 2] = true;
            }
            odd_and_even += u32::from(parities == [true; 2]);
        }
    }
    assert!(200 < odd_and_even, "{odd_and_even}");
}

/// Two equal surfaces with opposite fronts cancel.
#[test]
fn a_surface_and_its_reverse_have_no_inside() {
    let faces = [cube(), cube().into_iter().map(turned).collect()].concat();
    assert_eq!(scene(&faces).locate([0.0; 3]), Ok(OUTSIDE));
    assert_eq!(winding(&faces, [0.0; 3]), 0);
}

/// A strip of eight quadrangles around a square ring, with half a twist.
fn moebius() -> Drawn<f64> {
    let ring = [
        [1, 0],
        [1, 1],
        [0, 1],
        [-1, 1],
        [-1, 0],
        [-1, -1],
        [0, -1],
        [1, -1],
    ];
    // From upright to upside down.
    let across = [
        [0, 4],
        [2, 4],
        [3, 3],
        [4, 2],
        [4, 0],
        [4, -2],
        [3, -3],
        [2, -4],
    ];
    let mut vertices = Vec::new();
    for ([x, y], [out, up]) in ring.into_iter().zip(across) {
        for sign in [1, -1] {
            let radius = 16 + sign * out;
            vertices.push([radius * x, radius * y, sign * up].map(f64::from));
        }
    }
    let mut faces = Vec::new();
    for k in 0..8 {
        let [a, b] = [2 * k, 2 * k + 1];
        // The last one is turned over.
        let [c, d] = if k == 7 { [0, 1] } else { [a + 3, a + 2] };
        faces.extend([[a, b, c], [a, c, d]]);
    }
    Drawn { vertices, faces }
}

#[test]
fn a_moebius_strip_has_no_orientation_and_no_inside() {
    let mesh = moebius();
    let scene = mesh.scene();
    assert!(scene.closed().oriented.is_err() && scene.closed().even.is_err());
    let centre = scene.locate([0.5; 3]).unwrap();
    assert!(matches!(centre, Location::NotDefined(_)), "{centre:?}");
    let direction = [0.375, 0.5, -1.0];
    let change = |p: [f64; 3], q: [f64; 3]| {
        let middle = [0, 1, 2].map(|i| (p[i] + q[i]) / 2.0);
        let origin = [0, 1, 2].map(|i| middle[i] - direction[i]);
        let passages = scene
            .passages(&Ray::new(origin, direction).on(1.0, 1.0))
            .unwrap();
        let [passage] = &passages[..] else {
            panic!("{passages:?}");
        };
        passage.change
    };
    let vertex = |i: u32| mesh.vertices[i as usize];
    let mut flips = 0;
    for k in 0..8 {
        // Across the strip: faces meet in pairs. At one edge both show the same side, wherever one begins.
        match change(vertex(2 * k), vertex(2 * k + 1)) {
            Ok(Winding::Number(number)) => assert!(number.abs() <= 1),
            Ok(Winding::IsOdd(is_odd)) => {
                assert!(is_odd);
                flips += 1;
            }
            Err(edge) => panic!("{edge:?}"),
        }
        // Within a quadrangle both show the same side of the strip.
        let [a, _, c] = mesh.faces[2 * k as usize];
        let diagonal = change(vertex(a), vertex(c));
        assert!(matches!(diagonal, Ok(Winding::Number(_))), "{diagonal:?}");
        // One edge of the second face is at the rim.
        let [a, _, d] = mesh.faces[2 * k as usize + 1];
        assert!(change(vertex(d), vertex(a)).is_err());
    }
    assert_eq!(flips, 1);
    // With its reverse it is closed, and winds around nothing.
    let mut faces = mesh.triangles();
    faces.extend(mesh.triangles().into_iter().map(turned));
    let both = crate::solids::scene(&faces);
    assert_eq!(both.closed().oriented, Ok(()));
    assert_eq!(both.locate([0.5; 3]), Ok(OUTSIDE));
}
