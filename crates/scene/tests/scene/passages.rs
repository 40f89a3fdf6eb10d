//! Passages and locations are those of winding numbers from solid angles; open surfaces name an edge.

use crate::solids::{Faces, cube, cut_cube, scene, solids, turned, winding};
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;
use hairline_scene::{Location, OpenEdge, Passage, Ray, Winding};

fn lattice(draw: &mut Draw, bound: i64) -> [f64; 3] {
    draw.lattice_point(bound).map(|x| x as f64)
}

/// A t between the end of one passage and the start of the next one, or beyond the first or the last.
fn gaps(passages: &[Passage]) -> Vec<f64> {
    let first = passages
        .first()
        .map_or(0.0, |passage| passage.from.lower - 0.375);
    let last = passages.last().map(|passage| passage.to.upper + 0.375);
    let between = passages
        .windows(2)
        .map(|pair| (pair[0].to.upper + pair[1].from.lower) / 2.0);
    [first].into_iter().chain(between).chain(last).collect()
}

/// How many passages of some lines crossed, touched or ran in the surface.
#[derive(Debug, Default)]
struct Counts {
    crossings: u64,
    touches: u64,
    segments: u64,
}

/// Compares the passages of a line with the windings between them.
fn check_line(name: &str, faces: &Faces, [origin, direction]: [[f64; 3]; 2], counts: &mut Counts) {
    let line = Ray::new(origin, direction).on(f64::NEG_INFINITY, f64::INFINITY);
    let passages = scene(faces).passages(&line).unwrap();
    let at = |t: f64| [0, 1, 2].map(|i| origin[i] + t * direction[i]);
    let windings = gaps(&passages).into_iter().map(|t| winding(faces, at(t)));
    let windings: Vec<i64> = windings.collect();
    for (k, passage) in passages.iter().enumerate() {
        let about = || format!("{name} {origin:?} {direction:?} {passage:?} {faces:?}");
        let [before, after] = [windings[k], windings[k + 1]];
        let change = Winding::Number(after - before);
        assert_eq!(passage.change, Ok(change), "{}", about());
        let around = [before, after].map(Winding::Number);
        assert_eq!(passage.around, Ok(around), "{}", about());
        assert_eq!(passage.crosses(), Ok(before != after));
        counts.segments += u64::from(passage.is_segment);
        counts.touches += u64::from(before == after);
        counts.crossings += u64::from(before != after);
    }
}

#[test]
fn windings_around_passages_are_those_of_solid_angles() {
    let mut counts = Counts::default();
    for (name, faces) in solids() {
        let closed = *scene(&faces).closed();
        assert_eq!((closed.oriented, closed.even), (Ok(()), Ok(())), "{name}");
        for index in 0..1500 {
            let mut draw = Draw::new("passages", 1, index);
            let line = [lattice(&mut draw, 7), lattice(&mut draw, 3)];
            if line[1] != [0.0; 3] {
                check_line(name, &faces, line, &mut counts);
            }
        }
    }
    let Counts {
        crossings,
        touches,
        segments,
    } = counts;
    assert!(
        3000 < crossings && 300 < touches && 300 < segments,
        "{counts:?}"
    );
}

#[test]
fn windings_of_tetrahedra_that_share_lattice_points_are_those_of_solid_angles() {
    let mut counts = Counts::default();
    for index in 0..2000 {
        let mut draw = Draw::new("tetrahedra", 1, index);
        let mut faces = Faces::new();
        // Some without volume, some inside out, some in one plane.
        for _ in 0..1 + draw.below(4) {
            let [a, b, c, d] = [(); 4].map(|()| lattice(&mut draw, 2));
            faces.extend([[a, b, c], [a, c, d], [a, d, b], [b, d, c]]);
        }
        assert_eq!(scene(&faces).closed().oriented, Ok(()), "{faces:?}");
        for _ in 0..6 {
            let line = [lattice(&mut draw, 3), lattice(&mut draw, 2)];
            if line[1] != [0.0; 3] {
                check_line("tetrahedra", &faces, line, &mut counts);
            }
        }
    }
    let Counts {
        crossings,
        touches,
        segments,
    } = counts;
    assert!(
        3000 < crossings && 300 < touches && 100 < segments,
        "{counts:?}"
    );
}

#[test]
fn changes_do_not_depend_on_sizes_or_on_the_names_of_axes() {
    for (name, faces) in solids() {
        for index in 0..150 {
            let mut draw = Draw::new("passages", 2, index);
            let (origin, direction) = (lattice(&mut draw, 4), lattice(&mut draw, 3));
            if direction == [0.0; 3] {
                continue;
            }
            let changes = |faces: &Faces, origin: [f64; 3], direction: [f64; 3]| {
                let passages = scene(faces).passages(&Ray::new(origin, direction)).unwrap();
                let changes = passages
                    .into_iter()
                    .map(|passage| (passage.faces, passage.change));
                changes.collect::<Vec<_>>()
            };
            let expected = changes(&faces, origin, direction);
            // The ray is moved on other axes where others come first; and no size is too large or too small.
            for [power, turns] in [[0, 1], [0, 2], [500, 0], [-500, 1], [1000, 2], [-1070, 0]] {
                let moved = |mut point: [f64; 3]| {
                    point.rotate_left(turns as usize);
                    point.map(|x| scale_by_power_of_two(x, power))
                };
                let solid: Faces = faces.iter().map(|face| face.map(moved)).collect();
                let found = changes(&solid, moved(origin), moved(direction));
                assert_eq!(
                    found, expected,
                    "{name} {power} {turns} {origin:?} {direction:?}"
                );
            }
        }
    }
}

#[test]
fn an_interval_keeps_the_passages_that_have_a_point_in_it() {
    let scene = scene(&cube());
    let ray = Ray::new([-4.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    let count = |t_min: f64, t_max: f64| scene.passages(&ray.on(t_min, t_max)).unwrap().len();
    assert_eq!(count(2.0, 6.0), 2);
    assert_eq!(count(2.0f64.next_up(), 6.0), 1);
    assert_eq!(count(2.0f64.next_up(), 6.0f64.next_down()), 0);
    // In the plane of a side: the line runs in it from -2 to 2.
    let along = Ray::new([-4.0, 0.0, 2.0], [1.0, 0.0, 0.0]).on(3.0, 3.5);
    let passages = scene.passages(&along).unwrap();
    assert_eq!(passages.len(), 1);
    assert!(passages[0].is_segment);
    let (from, to) = (passages[0].from, passages[0].to);
    assert!(from.lower <= 2.0 && 2.0 <= from.upper && from.upper < 2.1);
    assert!(to.lower <= 6.0 && 6.0 <= to.upper && 5.9 < to.lower);
    assert_eq!(passages[0].crosses(), Ok(false));
}

#[test]
fn points_are_inside_outside_or_on_as_solid_angles_and_the_definition_have_it() {
    let mut counts = [0; 3];
    for (name, faces) in solids() {
        let scene = scene(&faces);
        for index in 0..1000 {
            let mut draw = Draw::new("points", 1, index);
            let mut point = lattice(&mut draw, 5);
            if draw.coin() {
                point = point.map(|x| x + 0.5 * draw.below(2) as f64);
            }
            // A ray that is nothing but the point.
            let there = Ray::new(point, [1.0, 0.0, 0.0]).on(0.0, 0.0);
            let defined = hairline_scene::define(&faces, &there).unwrap();
            let mut on: Vec<u32> = defined.iter().flat_map(|hit| hit.faces.clone()).collect();
            on.sort();
            let expected = if on.is_empty() {
                Location::Off(Winding::Number(winding(&faces, point)))
            } else {
                Location::On(on)
            };
            counts[match &expected {
                Location::On(_) => 0,
                Location::Off(winding) if winding.is_zero() => 1,
                _ => 2,
            }] += 1;
            assert_eq!(scene.locate(point).unwrap(), expected, "{name} {point:?}");
        }
    }
    assert!(counts.iter().all(|count| 200 < *count), "{counts:?}");
}

fn edge_of(faces: &Faces, edge: OpenEdge) {
    let [p, q] = edge.ends;
    let face = faces[edge.face as usize];
    assert!(face.contains(&p) && face.contains(&q), "{edge:?} {face:?}");
}

#[test]
fn an_open_surface_names_an_edge_and_local_passages_stay_defined() {
    let mut faces = cube();
    let lost = faces.pop().unwrap();
    let open = scene(&faces);
    let edge = open.closed().oriented.unwrap_err();
    edge_of(&faces, edge);
    assert!(edge.ends.iter().all(|end| lost.contains(end)), "{edge:?}");
    assert!(open.closed().even.is_err());
    assert!(matches!(
        open.locate([0.0, 0.5, 0.25]).unwrap(),
        Location::NotDefined(_)
    ));
    assert!(matches!(
        open.locate([-2.0, 0.5, 0.25]).unwrap(),
        Location::On(_)
    ));
    // Through a face that is there: it crosses, but no winding is defined.
    let passages = open
        .passages(&Ray::new([-4.0, 0.25, 0.5], [1.0, 0.0, 0.0]))
        .unwrap();
    assert_eq!(passages[0].change, Ok(Winding::Number(1)));
    assert!(passages[0].around.is_err());
    // Through the boundary: not even that.
    let middle = [0, 1, 2].map(|i| (edge.ends[0][i] + edge.ends[1][i]) / 2.0);
    let direction = [0.375, 0.5, 0.25];
    let origin = [0, 1, 2].map(|i| middle[i] - direction[i]);
    let passages = open.passages(&Ray::new(origin, direction)).unwrap();
    let at_boundary = passages
        .iter()
        .find(|passage| passage.from.lower <= 1.0 && 1.0 <= passage.to.upper);
    edge_of(&faces, at_boundary.unwrap().change.unwrap_err());
}

#[test]
fn a_face_with_nan_opens_the_surface() {
    let mut faces = cube();
    faces[3][1][2] = f64::NAN;
    let scene = scene(&faces);
    assert_eq!(scene.not_finite(), [3]);
    assert!(scene.closed().oriented.is_err());
}

#[test]
fn almost_collinear_points_leave_a_crack() {
    let mut faces = cut_cube(false);
    assert_eq!(scene(&faces).closed().oriented, Ok(()));
    // The point that both halves of the cut face share.
    let count = faces.len();
    let shared = faces[count - 2][1];
    for face in &mut faces[count - 2..] {
        for vertex in face.iter_mut().filter(|vertex| **vertex == shared) {
            vertex[2] = vertex[2].next_up();
        }
    }
    edge_of(&faces, scene(&faces).closed().oriented.unwrap_err());
}

#[test]
fn faces_of_mixed_orientation_leave_the_parity() {
    let mut draw = Draw::new("mixed", 1, 0);
    for (name, faces) in solids() {
        let mut mixed = faces.clone();
        for face in mixed.iter_mut().step_by(3) {
            *face = turned(*face);
        }
        let scene = scene(&mixed);
        assert_eq!(scene.closed().even, Ok(()), "{name}");
        for _ in 0..300 {
            let point = lattice(&mut draw, 5).map(|x| x + 0.25);
            let location = scene.locate(point).unwrap();
            let is_odd = winding(&faces, point) % 2 != 0;
            // Orientations that cancel again, in faces that are there twice, keep their number.
            let Location::Off(found) = location else {
                panic!("{name} {location:?}");
            };
            match found {
                Winding::IsOdd(found) => assert_eq!(found, is_odd, "{name} {point:?}"),
                Winding::Number(found) => assert_eq!(found % 2 != 0, is_odd, "{name} {point:?}"),
            }
        }
    }
}

#[test]
fn between_a_face_and_a_turned_one_only_the_parity_is_defined() {
    let mut faces = cube();
    let [a, b, c] = faces[0];
    faces[0] = turned(faces[0]);
    let scene = scene(&faces);
    assert!(scene.closed().oriented.is_err());
    let change = |through: [f64; 3]| {
        let direction = [0.25, 0.375, 0.5];
        let origin = [0, 1, 2].map(|i| through[i] - direction[i]);
        let ray = Ray::new(origin, direction).on(1.0, 1.0);
        scene.passages(&ray).unwrap()[0].change
    };
    let middle = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|i| (p[i] + q[i]) / 2.0);
    for (p, q) in [(a, b), (b, c), (c, a)] {
        assert!(
            matches!(change(middle(p, q)), Ok(Winding::IsOdd(_))),
            "{p:?} {q:?}"
        );
    }
    // In its inside the turned face is just one that is seen from behind.
    assert_eq!(change(middle(middle(a, b), c)), Ok(Winding::Number(-1)));
}
