//! Answers of other programs, judged.

use hairline_core::case::Draw;
use hairline_scene::{Answer, Judgement, Ray, Scene};

/// Two parallel squares of two faces each: z = 0 with the diagonal from (0, 0) to (1, 1), and z = -2.
fn squares() -> Scene<f64> {
    let square = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [1.0, 1.0, z], [0.0, 1.0, z]];
    let vertices = [square(0.0), square(-2.0)].concat();
    Scene::new(&vertices, &[[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]]).unwrap()
}

fn judged(ray: &Ray<f64>, face: Option<u32>, t: Option<f64>) -> (Judgement, Option<f64>) {
    let judged = squares().judge(ray, &Answer { face, t }).unwrap();
    (judged.judgement, judged.off)
}

#[test]
fn each_kind_of_answer_has_its_judgement() {
    // Through face 0 at t = 0.5, and face 2 at t = 1.5.
    let ray = Ray::new([0.75, 0.25, 1.0], [0.0, 0.0, -2.0]);
    let longest = 2f64.sqrt();
    assert_eq!(judged(&ray, Some(0), None), (Judgement::Right, None));
    assert_eq!(
        judged(&ray, Some(0), Some(0.5)),
        (Judgement::Right, Some(0.0))
    );
    let late = judged(&ray, Some(0), Some(0.6));
    assert_eq!(late.0, Judgement::WrongT);
    assert!((late.1.unwrap() - 0.2 / longest).abs() < 1e-15);
    assert_eq!(
        judged(&ray, Some(0), Some(f64::NAN)),
        (Judgement::WrongT, None)
    );
    assert_eq!(judged(&ray, None, None), (Judgement::Lost, None));
    let farther = judged(&ray, Some(2), Some(1.5));
    assert_eq!(farther, (Judgement::Farther, Some(2.0 / longest)));
    // Beside the ray, and no face at all.
    assert_eq!(judged(&ray, Some(1), Some(0.5)).0, Judgement::Ghost);
    assert_eq!(judged(&ray, Some(9), None).0, Judgement::Ghost);
    let past = ray.on(2.0, 3.0);
    assert_eq!(judged(&past, None, None).0, Judgement::Right);
    assert_eq!(judged(&past, Some(0), Some(0.5)).0, Judgement::Ghost);
}

#[test]
fn each_face_of_a_tie_is_right() {
    let diagonal = Ray::new([0.25, 0.25, 1.0], [0.0, 0.0, -1.0]);
    for face in [0, 1] {
        assert_eq!(judged(&diagonal, Some(face), Some(1.0)).0, Judgement::Tie);
    }
    assert_eq!(judged(&diagonal, Some(3), Some(3.0)).0, Judgement::Farther);
}

#[test]
fn a_face_beside_the_ray_is_a_neighbour_where_the_point_is_right() {
    // A hair beside the diagonal, in face 0.
    let ray = Ray::new([0.25 + 1e-6, 0.25, 1.0], [0.0, 0.0, -1.0]);
    assert_eq!(judged(&ray, Some(0), None).0, Judgement::Right);
    assert_eq!(judged(&ray, Some(1), None).0, Judgement::Neighbour);
    assert_eq!(judged(&ray, Some(1), Some(1.0001)).0, Judgement::Neighbour);
    assert_eq!(judged(&ray, Some(1), Some(1.1)).0, Judgement::Ghost);
    // No number, and a number beyond all.
    assert_eq!(
        judged(&ray, Some(0), Some(f64::INFINITY)).0,
        Judgement::WrongT
    );
    assert_eq!(
        judged(&ray, Some(1), Some(f64::INFINITY)).0,
        Judgement::Ghost
    );
    // A silhouette: beside the squares nothing is hit, or what lies behind.
    let past = Ray::new([1.0 + 1e-6, 0.5, 1.0], [0.0, 0.0, -1.0]);
    assert_eq!(judged(&past, Some(0), Some(1.0)).0, Judgement::Neighbour);
    assert_eq!(judged(&past, Some(0), None).0, Judgement::Neighbour);
    assert_eq!(judged(&past, Some(0), Some(1.1)).0, Judgement::Ghost);
    assert_eq!(
        judged(&past.on(0.0, 0.5), Some(0), None).0,
        Judgement::Ghost
    );
    // From below, past the lower square, whose faces are in front of the upper ones there.
    let onto = Ray::new([0.999, 0.5, -3.0], [1e-3 + 1e-9, 0.0, 1.0]);
    assert_eq!(judged(&onto, Some(2), None).0, Judgement::Neighbour);
    // The same face a tenth away.
    let aside = Ray::new([0.35, 0.25, 1.0], [0.0, 0.0, -1.0]);
    assert_eq!(judged(&aside, Some(1), None).0, Judgement::Ghost);
}

#[test]
fn a_face_that_is_a_point_is_right_at_its_t() {
    let vertices = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let point = [[0, 0, 0]];
    let ray = Ray::new([0.0, 0.0, 3.0], [0.0, 0.0, -1.0]);
    let alone = Scene::<f64>::new(&vertices, &point).unwrap();
    let with_face = Scene::<f64>::new(&vertices, &[point[0], [0, 1, 2]]).unwrap();
    let judged = |scene: &Scene<f64>, t: f64| {
        let answer = Answer {
            face: Some(0),
            t: Some(t),
        };
        scene.judge(&ray, &answer).unwrap().judgement
    };
    assert_eq!(judged(&alone, 3.0), Judgement::Right);
    assert_eq!(judged(&alone, 4.0), Judgement::WrongT);
    // Measured by the edges of the other face.
    assert_eq!(judged(&with_face, 3.0 + 1e-6), Judgement::Tie);
    assert_eq!(judged(&with_face, 3.1), Judgement::WrongT);
}

#[test]
fn wrong_is_what_somebody_sees() {
    use Judgement::{Farther, Ghost, Lost, Neighbour, Right, Tie, WrongT};
    for (judgements, is_wrong) in [
        (&[Right, Tie, Neighbour][..], false),
        (&[WrongT, Lost, Farther, Ghost][..], true),
    ] {
        assert!(judgements.iter().all(|it| it.is_wrong() == is_wrong));
    }
}

#[test]
fn t_is_told_from_the_first_point_of_a_segment() {
    // In the plane of the upper square, from so far away that the bounds of t are wide.
    let far = 2f64.powi(45);
    let ray = Ray::new([-far, 0.25, 0.0], [1.0, 0.0, 0.0]);
    let nearest = squares().nearest(&ray).unwrap().unwrap();
    assert_eq!(nearest.faces, [1]);
    assert!(0.01 < nearest.t.upper - nearest.t.lower);
    assert_eq!(
        judged(&ray, Some(1), Some(far)),
        (Judgement::Right, Some(0.0))
    );
}

#[test]
fn a_ray_in_the_plane_of_a_face_meets_it_all_the_way() {
    // Along face 0 from t = 1 to 2, and into nothing.
    let ray = Ray::new([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    assert_eq!(judged(&ray, Some(0), Some(1.0)).0, Judgement::Tie);
    assert_eq!(judged(&ray, Some(0), Some(1.5)).0, Judgement::Neighbour);
    assert_eq!(judged(&ray, Some(0), Some(2.5)).0, Judgement::WrongT);
}

#[test]
fn a_face_just_behind_the_nearest_one_is_a_neighbour() {
    // A fold: below its ridge a ray meets both sides, the second one later by twice its depth.
    let vertices = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, -1.0, 1.0],
        [0.0, -1.0, -1.0],
    ];
    let ridge = Scene::<f64>::new(&vertices, &[[0, 1, 2], [0, 3, 1]]).unwrap();
    let judged = |depth: f64| {
        let ray = Ray::new([0.25, -depth, 3.0], [0.0, 0.0, -1.0]);
        let answer = Answer {
            face: Some(1),
            t: None,
        };
        ridge.judge(&ray, &answer).unwrap().judgement
    };
    assert_eq!(judged(1e-12), Judgement::Neighbour);
    assert_eq!(judged(0.125), Judgement::Farther);
}

#[test]
fn a_point_of_any_nearest_face_is_no_wrong_one() {
    // Two triangles in a plane, the ray in it: it runs in the one to x = 1, and in the other to x = 2.
    let vertices = [
        [0.0; 3],
        [1.0, -0.5, 0.0],
        [1.0, 0.5, 0.0],
        [2.0, -1.0, 0.0],
        [2.0, 1.0, 0.0],
    ];
    let ray = Ray::new([-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
    for faces in [[[0, 1, 2], [0, 3, 4]], [[0, 3, 4], [0, 1, 2]]] {
        let scene = Scene::<f64>::new(&vertices, &faces).unwrap();
        let longer = faces.iter().position(|face| face[1] == 3).unwrap() as u32;
        for (face, judgement) in [
            (longer, Judgement::Neighbour),
            (1 - longer, Judgement::WrongT),
        ] {
            let answer = Answer {
                face: Some(face),
                t: Some(2.8),
            };
            assert_eq!(scene.judge(&ray, &answer).unwrap().judgement, judgement);
        }
    }
}

/// A number times 2 to a power.
fn times_two_to(x: f64, power: i32) -> f64 {
    hairline_core::arith::scale_by_power_of_two(x, power)
}

#[test]
fn judgements_do_not_depend_on_the_unit_of_length_or_of_t() {
    let powers = [-1000, -400, -270, 270, 400, 450, 900];
    let kinds = [
        Some((0, 0.0)),
        Some((0, 1e-5)),
        Some((0, 0.01)),
        Some((1, 0.0)),
        Some((2, 0.3)),
        None,
    ];
    for index in 0..200 {
        let draw = &mut Draw::new("judged-scales", 1, index);
        let mut point = || [(); 3].map(|()| draw.integer(-999, 999) as f64 / 256.0);
        let vertices: Vec<[f64; 3]> = (0..9).map(|_| point()).collect();
        let (origin, target) = (point(), point());
        let direction = [0, 1, 2].map(|axis| target[axis] - origin[axis]);
        let ray = Ray::new(origin, direction);
        let faces = [[0, 1, 2], [3, 4, 5], [6, 7, 8]];
        let scene = Scene::new(&vertices, &faces).unwrap();
        let t = scene
            .nearest(&ray)
            .unwrap()
            .map_or(1.0, |nearest| nearest.t.lower);
        for kind in kinds {
            let answer = |power: i32| Answer {
                face: kind.map(|(face, _)| face),
                t: kind.map(|(_, off)| times_two_to(t + off, power)),
            };
            let expected = scene.judge(&ray, &answer(0)).unwrap();
            for power in powers {
                let larger: Vec<[f64; 3]> = vertices
                    .iter()
                    .map(|vertex| vertex.map(|x| times_two_to(x, power)))
                    .collect();
                let scene = Scene::new(&larger, &faces).unwrap();
                let origin = origin.map(|x| times_two_to(x, power));
                // The direction has the unit of length, or one of its own: then t has another one.
                for of_direction in [power, -power, 0] {
                    let direction = direction.map(|x| times_two_to(x, of_direction));
                    let ray = Ray::new(origin, direction);
                    let of_t = power - of_direction;
                    if of_t.abs() > 1000 {
                        continue;
                    }
                    let judged = scene.judge(&ray, &answer(of_t)).unwrap();
                    let about = format!("{index} {kind:?} {power} {of_direction}");
                    assert_eq!(judged.judgement, expected.judgement, "{about}");
                    match (judged.off, expected.off) {
                        (Some(off), Some(expected)) => {
                            assert!((off - expected).abs() <= 1e-9 * expected.abs().max(1.0));
                        }
                        (off, expected) => assert_eq!(off, expected, "{about}"),
                    }
                }
            }
        }
    }
}
