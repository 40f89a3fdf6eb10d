//! Answers of other programs, judged.

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
