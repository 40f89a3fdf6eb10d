//! All hits, counts and places of other programs, judged; and what nobody sees.

use crate::drawn::{Style, ray, soup};
use hairline_core::case::Draw;
use hairline_scene::{
    Answer, Judgement, NamedHit, NamedPlace, NoTargets, NotConforming, Ray, Scene,
};

/// Cubes of side 1 from these corners, wound to the outside: two faces a side.
fn cubes(corners: &[[f64; 3]]) -> Scene<f64> {
    const SIDES: [[u32; 4]; 6] = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let mut vertices = Vec::new();
    let mut faces = Vec::new();
    for [x, y, z] in corners {
        let first = vertices.len() as u32;
        for i in 0..8 {
            let [along_x, along_y, along_z] = [i & 1, i >> 1 & 1, i >> 2 & 1].map(f64::from);
            vertices.push([x + along_x, y + along_y, z + along_z]);
        }
        for [a, b, c, d] in SIDES.map(|side| side.map(|i| first + i)) {
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    Scene::new(&vertices, &faces).unwrap()
}

/// The cube from 0 to 1.
fn cube() -> Scene<f64> {
    cubes(&[[0.0; 3]])
}

/// Across the cube along z, through the inside of the faces 9 and 10.
const ACROSS: ([f64; 3], [f64; 3]) = ([0.75, 0.25, -1.0], [0.0, 0.0, 1.0]);

fn named(faces: &[u32]) -> Vec<NamedHit> {
    faces
        .iter()
        .map(|face| NamedHit {
            face: *face,
            t: None,
        })
        .collect()
}

fn judged(ray: &Ray<f64>, faces: &[u32]) -> Judgement {
    cube().judge_hits(ray, &named(faces)).unwrap().judgement
}

#[test]
fn all_hits_have_their_judgement() {
    let across = Ray::new(ACROSS.0, ACROSS.1);
    let faces: Vec<Vec<u32>> = cube()
        .hits(&across)
        .unwrap()
        .iter()
        .map(|hit| hit.faces.clone())
        .collect();
    assert_eq!(faces, [[9], [10]]);
    assert_eq!(judged(&across, &[9, 10]), Judgement::Right);
    assert_eq!(judged(&across, &[10, 9]), Judgement::WrongOrder);
    assert_eq!(judged(&across, &[9, 10, 10]), Judgement::Twice);
    assert_eq!(judged(&across, &[9]), Judgement::Lost);
    assert_eq!(judged(&across, &[]), Judgement::Lost);
    assert_eq!(judged(&across, &[9, 3, 10]), Judgement::Ghost);
    assert_eq!(judged(&across, &[9, 10, 77]), Judgement::Ghost);
    // The lost one is named.
    let lost = cube().judge_hits(&across, &named(&[9])).unwrap().hit;
    assert_eq!(lost.unwrap().faces, [10]);
    let at = |t: f64| {
        let hits = [(9, 1.0), (10, t)].map(|(face, t)| NamedHit { face, t: Some(t) });
        cube().judge_hits(&across, &hits).unwrap().judgement
    };
    assert_eq!(at(2.0), Judgement::Right);
    assert_eq!(at(2.001), Judgement::Right);
    assert_eq!(at(2.1), Judgement::WrongT);
    assert_eq!(at(f64::NAN), Judgement::WrongT);
    let past = across.on(0.0, 1.5);
    assert_eq!(judged(&past, &[9]), Judgement::Right);
    assert_eq!(judged(&past, &[9, 10]), Judgement::Ghost);
    assert_eq!(judged(&across.on(0.0, 0.5), &[]), Judgement::Right);
}

#[test]
fn at_an_edge_one_face_is_enough_and_a_face_beside_it_is_one_too_many() {
    // Through the diagonals of two sides.
    let diagonal = Ray::new([0.5, 0.5, -1.0], [0.0, 0.0, 1.0]);
    for faces in [[8, 10], [8, 11], [9, 10], [9, 11]] {
        assert_eq!(judged(&diagonal, &faces), Judgement::Tie);
    }
    assert_eq!(judged(&diagonal, &[8, 9, 11, 10]), Judgement::Right);
    assert_eq!(judged(&diagonal, &[8, 9]), Judgement::Lost);
    // A hair beside them.
    let beside = Ray::new([0.5 + 1e-6, 0.5, -1.0], [0.0, 0.0, 1.0]);
    assert_eq!(judged(&beside, &[9, 10]), Judgement::Right);
    assert_eq!(judged(&beside, &[8, 10]), Judgement::Neighbour);
    assert_eq!(judged(&beside, &[8, 9, 10]), Judgement::Twice);
}

#[test]
fn a_silhouette_may_be_missed_and_a_wall_may_not() {
    let miss = Answer {
        face: None,
        t: None,
    };
    let nearest = |scene: &Scene<f64>, ray: &Ray<f64>, answer: &Answer| {
        scene.judge(ray, answer).unwrap().judgement
    };
    // Past the cube along an edge's middle, and at a corner; along a side.
    for (origin, direction) in [
        ([-0.5, 0.5, 0.5], [1.0, 0.0, -1.0]),
        ([-1.0, 1.0, 1.0], [1.0, -1.0, 0.0]),
        ([-1.0, 0.25, 1.0], [1.0, 0.0, 0.0]),
    ] {
        let touching = Ray::new(origin, direction).on(-9.0, 9.0);
        assert!(cube().nearest(&touching).unwrap().is_some());
        assert_eq!(nearest(&cube(), &touching, &miss), Judgement::Neighbour);
        assert_eq!(judged(&touching, &[]), Judgement::Neighbour);
        assert_eq!(
            cube().judge_any(&touching, false).unwrap().judgement,
            Judgement::Neighbour
        );
        let right = cube().judge_any(&touching, true).unwrap();
        assert_eq!(right.judgement, Judgement::Right);
    }
    // Past the edge of one cube at another: that one's face is seen, and its far side is not.
    let both = cubes(&[[0.0; 3], [-2.25, 0.0, -1.5]]);
    // x - z = -1 touches the near cube along its edge at (0, 1), and goes on into the far one.
    let ray = Ray::new([1.0, 0.3, 2.0], [-1.0, 0.0, -1.0]);
    let hits = both.hits(&ray).unwrap();
    assert!(hits[0].faces.iter().all(|face| *face < 12));
    let seen = hits.iter().find(|hit| 12 <= hit.faces[0]).unwrap();
    let answer = |face: u32, t: Option<f64>| Answer {
        face: Some(face),
        t,
    };
    let t = seen.from.lower.midpoint(seen.from.upper);
    assert_eq!(
        nearest(&both, &ray, &answer(seen.faces[0], Some(t))),
        Judgement::Neighbour
    );
    assert_ne!(
        nearest(&both, &ray, &answer(seen.faces[0], Some(t + 0.1))),
        Judgement::Neighbour
    );
    assert_eq!(nearest(&both, &ray, &miss), Judgement::Lost);
    let last = hits.last().unwrap();
    assert_eq!(
        nearest(&both, &ray, &answer(last.faces[0], None)),
        Judgement::Farther
    );
    // Two faces of opposite sides in one place are a wall, although the winding does not change there.
    let wall = Scene::new(
        &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
        &[[0, 1, 2], [0, 2, 1]],
    )
    .unwrap();
    let onto = Ray::new([0.25, 0.25, 1.0], [0.0, 0.0, -1.0]);
    assert_eq!(wall.passages(&onto).unwrap()[0].crosses(), Ok(false));
    assert_eq!(nearest(&wall, &onto, &miss), Judgement::Lost);
}

#[test]
fn counts_are_of_points_or_of_faces() {
    let counted = |ray: &Ray<f64>, count: u64| cube().judge_count(ray, count).unwrap().judgement;
    let diagonal = Ray::new([0.5, 0.5, -1.0], [0.0, 0.0, 1.0]);
    let judgements: Vec<Judgement> = (1..=5).map(|count| counted(&diagonal, count)).collect();
    let [few, right, many, tie] = [
        Judgement::TooFew,
        Judgement::Right,
        Judgement::TooMany,
        Judgement::Tie,
    ];
    assert_eq!(judgements, [few, right, tie, tie, many]);
    let touching = Ray::new([-0.5, 0.5, 0.5], [1.0, 0.0, -1.0]).on(-9.0, 9.0);
    assert_eq!(counted(&touching, 0), Judgement::Neighbour);
    assert_eq!(counted(&touching, 1), Judgement::Right);
    assert_eq!(counted(&touching, 3), Judgement::TooMany);
}

#[test]
fn a_hit_where_nothing_is_may_be_near_something() {
    let any = |x: f64| {
        let ray = Ray::new([x, 0.3, -1.0], [0.0, 0.0, 1.0]);
        cube().judge_any(&ray, true).unwrap().judgement
    };
    assert_eq!(any(0.5), Judgement::Right);
    assert_eq!(any(1.0 + 1e-6), Judgement::Neighbour);
    assert_eq!(any(1.1), Judgement::Ghost);
}

#[test]
fn a_program_conforms_or_its_worst_answer_is_told() {
    let scene = cubes(&[[0.0; 3], [3.0, 0.25, -1.0]]);
    let exact = |ray: &Ray<f64>| Answer {
        face: scene.nearest(ray).unwrap().map(|nearest| nearest.faces[0]),
        t: None,
    };
    assert!(scene.conforms(3000, 1, exact).is_ok());
    // At edges and vertices it looks through the wall.
    let leaky = |ray: &Ray<f64>| {
        let hits = scene.hits(ray).unwrap();
        let inside = hits.iter().find(|hit| hit.faces.len() == 1);
        Answer {
            face: inside.map(|hit| hit.faces[0]),
            t: None,
        }
    };
    let NotConforming::Wrong(wrong) = scene.conforms(3000, 1, leaky).unwrap_err() else {
        panic!("rays can be made");
    };
    assert!(50 < wrong.count && wrong.count < 1500, "{}", wrong.count);
    let worst = &wrong.worst;
    let again = scene.judge(&worst.ray, &worst.answer).unwrap();
    assert_eq!(again, worst.judged);
    assert_eq!(worst.judged.judgement, Judgement::Lost);
    let said = wrong.to_string();
    assert!(
        said.starts_with(&format!(
            "{} of 3000 answers are wrong; the worst (lost)",
            wrong.count
        )),
        "{said}"
    );
}

#[test]
fn rays_that_are_made_are_finite_or_nobody_is_asked() {
    let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mut is_asked_in_some = false;
    for size in [1e34f32, 2e36, 3e36, 5e37, 1e38, f32::MAX] {
        let vertices = [
            [0.0; 3],
            [size, 0.0, 0.0],
            [0.0, size, 0.0],
            [0.0, 0.0, size],
        ];
        let scene = Scene::new(&vertices, &faces).unwrap();
        let mut asked = 0;
        let conforms = scene.conforms(600, 1, |ray| {
            asked += 1;
            let numbers = ray.origin.iter().chain(&ray.direction);
            assert!(numbers.clone().all(|x| x.is_finite()), "{size}: {ray:?}");
            Answer {
                face: None,
                t: None,
            }
        });
        match conforms.unwrap_err() {
            NotConforming::NotAsked(NoTargets::TooLarge) => assert_eq!(asked, 0),
            NotConforming::NotAsked(NoTargets::NoSize) => panic!("it has a size"),
            NotConforming::Wrong(_) => is_asked_in_some = true,
        }
    }
    assert!(is_asked_in_some);
}

#[test]
fn places_of_points_are_judged() {
    let place = |point: [f64; 3], named: NamedPlace| cube().judge_place(point, named).unwrap();
    let inside = [0.5, 0.5, 0.875];
    assert_eq!(
        place(inside, NamedPlace::Inside).judgement,
        Judgement::Right
    );
    let wrong = place(inside, NamedPlace::Outside);
    assert_eq!(wrong.judgement, Judgement::WrongSide);
    assert!((wrong.off.unwrap() - 0.125 / 2f64.sqrt()).abs() < 1e-15);
    assert_eq!(
        place(inside, NamedPlace::On).judgement,
        Judgement::WrongSide
    );
    let on = [0.5, 0.5, 1.0];
    assert_eq!(place(on, NamedPlace::On).judgement, Judgement::Right);
    assert_eq!(place(on, NamedPlace::Outside).judgement, Judgement::Tie);
    let open = Scene::new(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]).unwrap();
    let judged = open.judge_place(inside, NamedPlace::Inside).unwrap();
    assert_eq!(judged.judgement, Judgement::NotDefined);
}

#[test]
fn exact_answers_are_right_in_any_scene_and_one_that_is_left_out_is_lost() {
    let mut lost = 0;
    let mut unseen = 0;
    for index in 0..4000 {
        let mut draw = Draw::new("judged hits", 1, index);
        let style = Style::draw::<f64>(&mut draw);
        let mesh = soup::<f64>(&mut draw, style);
        let ray = ray(&mut draw, style, &mesh);
        let scene = mesh.scene();
        let Ok(hits) = scene.hits(&ray) else {
            continue;
        };
        let passages = scene.passages(&ray).unwrap();
        let all: Vec<u32> = hits.iter().flat_map(|hit| hit.faces.clone()).collect();
        let judge = |faces: &[u32]| scene.judge_hits(&ray, &named(faces)).unwrap().judgement;
        assert_eq!(judge(&all), Judgement::Right, "{index}: {all:?}");
        for counted in passages.len()..=all.len() {
            let judged = scene.judge_count(&ray, counted as u64).unwrap();
            assert!(judged.judgement.is_right(), "{index}: {counted}");
        }
        let count = scene.judge_count(&ray, passages.len() as u64).unwrap();
        assert_eq!(count.judgement, Judgement::Right);
        let any = scene.judge_any(&ray, !hits.is_empty()).unwrap();
        assert_eq!(any.judgement, Judgement::Right);
        // Faces of one passage left out.
        let Some(left_out) = passages.get(draw.below(passages.len().max(1))) else {
            continue;
        };
        let is_kept = |face: &u32| !left_out.faces.contains(face);
        let others: Vec<u32> = all.iter().copied().filter(is_kept).collect();
        match judge(&others) {
            Judgement::Lost => {
                assert!(!left_out.is_silhouette, "{index}");
                lost += 1;
            }
            // Or a ray beside it misses them.
            Judgement::Neighbour => unseen += 1,
            other => panic!("{index}: {other}"),
        }
    }
    assert!(400 < lost && 500 < unseen, "{lost} {unseen}");
}

/// Two floors of size 1, one just below the other; a ray that starts a hair above the upper one and meets both far away.
fn over_floors() -> (Scene<f64>, Ray<f64>) {
    let floor = |z: f64| [[0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]];
    let vertices = [floor(0.0), floor(-4e-4)].concat();
    let scene = Scene::new(&vertices, &[[0, 1, 2], [3, 4, 5]]).unwrap();
    (scene, Ray::new([0.1, 0.1, 4e-4], [1.0, 0.0, -4e-3]))
}

#[test]
fn a_face_named_at_the_start_and_met_later_is_a_self_hit() {
    let (scene, ray) = over_floors();
    let of_all = |hits: &[(u32, f64)]| {
        let hits: Vec<NamedHit> = hits
            .iter()
            .map(|(face, t)| NamedHit {
                face: *face,
                t: Some(*t),
            })
            .collect();
        scene.judge_hits(&ray, &hits).unwrap().judgement
    };
    let of_nearest = |face: u32, t: f64| {
        let answer = Answer {
            face: Some(face),
            t: Some(t),
        };
        scene.judge(&ray, &answer).unwrap().judgement
    };
    assert_eq!(of_all(&[(0, 0.1), (1, 0.2)]), Judgement::Right);
    for hits in [
        &[(0, 0.0), (0, 0.1), (1, 0.2)][..],
        &[(1, 0.0), (0, 0.1), (1, 0.2)],
        &[(0, 0.0), (1, 0.2)],
    ] {
        assert_eq!(of_all(hits), Judgement::SelfHit, "{hits:?}");
    }
    // At the exact t it is named twice; away from the start its t is wrong.
    let twice = [(0, 0.1), (0, 0.1), (1, 0.2)];
    assert_eq!(of_all(&twice), Judgement::Twice);
    assert_eq!(of_all(&[(0, 0.05), (1, 0.2)]), Judgement::WrongT);
    assert_eq!(of_nearest(0, 0.1), Judgement::Right);
    assert_eq!(of_nearest(0, 0.05), Judgement::WrongT);
    assert_eq!(of_nearest(1, 0.2), Judgement::Farther);
    for face in [0, 1] {
        assert_eq!(of_nearest(face, 0.0), Judgement::SelfHit);
    }
}
