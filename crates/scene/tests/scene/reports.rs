//! Reports of other libraries come out right.

use crate::drawn::Drawn;
use crate::solids::{cube, scene as closed_scene, turned, winding};
use hairline_core::case::Draw;
use hairline_scene::{Hit, Location, Ray, Scene, Winding};

fn faces_of(hits: &[Hit]) -> Vec<Vec<u32>> {
    hits.iter().map(|hit| hit.faces.clone()).collect()
}

/// The box of libigl/libigl-python-bindings#78.
fn igl_box() -> Drawn<f64> {
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

#[test]
fn reports_of_other_libraries_come_out_right() {
    let mesh = igl_box();
    let scene = mesh.scene();
    // libigl-python-bindings#78: t = 9 and 10; the library says 9 and 9.5.
    let down = Ray::new([0.5, 0.1, 10.0], [0.0, 0.0, -1.0]);
    assert_eq!(faces_of(&scene.hits(&down).unwrap()), [[10], [0]]);
    let t = |face: u32| scene.values(&down, face).unwrap().unwrap().t[0];
    assert_eq!([t(10), t(0)], [9.0, 10.0]);
    // gptoolbox#92: along the diagonal, two points of six faces each.
    let diagonal = Ray::new([-1.0; 3], [1.0; 3]);
    let hits = scene.hits(&diagonal).unwrap();
    assert_eq!(
        faces_of(&hits).iter().map(Vec::len).collect::<Vec<_>>(),
        [6, 6]
    );
    let passages = scene.passages(&diagonal).unwrap();
    assert!(passages.iter().all(|passage| passage.crosses() == Ok(true)));
    // Oblikovati#1317: two points and three faces, and the origin is outside: parity by faces says inside.
    let at_edge = Ray::new([0.5, 0.25, 2.0], [0.0, 0.25, -1.0]);
    let hits = scene.hits(&at_edge).unwrap();
    assert_eq!(
        faces_of(&hits).iter().map(Vec::len).collect::<Vec<_>>(),
        [2, 1]
    );
    let outside = Location::Off(Winding::Number(0));
    assert_eq!(scene.locate([0.5, 0.25, 2.0]).unwrap(), outside);
}

#[test]
fn rays_at_the_vertices_of_a_closed_surface_do_not_leak() {
    // Embree 4 in its robust mode lets 66 of 19,002 such rays through a tetrahedron.
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

#[test]
fn unsorted_hits_and_repeated_faces_do_not_spoil_the_inside() {
    let faces = [cube(), cube().into_iter().map(turned).collect()].concat();
    let scene = closed_scene(&faces);
    // Two equal surfaces with opposite fronts cancel; with parity they would too.
    assert_eq!(
        scene.locate([0.0; 3]).unwrap(),
        Location::Off(Winding::Number(0))
    );
    assert_eq!(winding(&faces, [0.0; 3]), 0);
}
