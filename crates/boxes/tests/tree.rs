//! Boxes of meshes, and neighbours that share a wall.

use hairline_boxes::{BoxCase, Source, Tree, check, find_family, truth};
use std::collections::BTreeSet;

type Point = [f64; 3];

/// A wavy sheet of triangles.
fn sheet() -> Vec<[Point; 3]> {
    let point = |i: usize, j: usize| [i as f64, j as f64, ((i * i + 3 * j) % 7) as f64];
    let cells = (0..6).flat_map(|i| (0..5).map(move |j| (i, j)));
    let halves = cells.flat_map(|(i, j)| {
        let [a, b, c, d] = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| point(i + x, j + y));
        [[a, b, c], [b, d, c]]
    });
    halves.collect()
}

fn bits(x: Point) -> [u64; 3] {
    x.map(f64::to_bits)
}

#[test]
fn boxes_of_a_mesh_are_those_of_its_faces_and_of_halves_of_halves() {
    let triangles = sheet();
    let of_face = |corners: &[Point; 3]| {
        let of = |choose: fn(f64, f64) -> f64| {
            [0, 1, 2].map(|i| corners.iter().map(|x| x[i]).reduce(choose).unwrap())
        };
        [of(f64::min), of(f64::max)]
    };
    let faces: Vec<[Point; 2]> = triangles.iter().map(of_face).collect();
    let known: BTreeSet<[[u64; 3]; 2]> = faces.iter().map(|face| face.map(bits)).collect();
    let tree = Tree::new("sheet".to_owned(), &triangles).unwrap();
    let mut sizes = BTreeSet::new();
    let mut boxes = BTreeSet::new();
    let mut inside = 0;
    for index in 0..6000 {
        let case = tree.case::<f64>(1, index);
        let [origin, _, min, max] = case.vectors();
        check(&case).unwrap();
        boxes.insert([bits(min), bits(max)]);
        let is_within =
            |face: &&[Point; 2]| (0..3).all(|i| min[i] <= face[0][i] && face[1][i] <= max[i]);
        let held = faces.iter().filter(is_within).count();
        assert!(1 <= held, "{}", case.hex());
        // A box that is no face's is the least around those in it.
        if !known.contains(&[bits(min), bits(max)]) {
            let touched = |i: usize| {
                faces
                    .iter()
                    .filter(is_within)
                    .any(|face| face[0][i] == min[i])
                    && faces
                        .iter()
                        .filter(is_within)
                        .any(|face| face[1][i] == max[i])
            };
            assert!((0..3).all(touched), "{}", case.hex());
            sizes.insert(held);
        }
        inside += usize::from((0..3).all(|i| min[i] <= origin[i] && origin[i] <= max[i]));
    }
    // 60 faces and 59 nodes, though some of either have one box.
    assert!(
        sizes.contains(&60) && sizes.iter().any(|size| *size < 6),
        "{sizes:?}"
    );
    assert!(known.is_subset(&boxes) && boxes.len() <= 119);
    assert!(1500 < inside && inside < 3500, "{inside}");
    assert!(Tree::new("nothing".to_owned(), &[]).is_err());
    // All faces in one place: no axis divides them, and there is an end.
    let same = vec![triangles[0]; 100];
    Tree::new("same".to_owned(), &same)
        .unwrap()
        .case::<f32>(1, 1);
}

#[test]
fn neighbours_share_a_wall_a_ray_and_the_t_at_which_they_are_met() {
    let family = find_family("neighbour").unwrap();
    assert!(Source::Family(family).is_of_pairs());
    let mut along = 0;
    for pair in 0..1000 {
        let cases = [2 * pair, 2 * pair + 1].map(|index| family.case::<f64>(3, index));
        let [one, other] = cases.map(|case| case.vectors());
        assert_eq!(one[..2], other[..2]);
        let axes = (0..3).filter(|i| one[3][*i] == other[2][*i]);
        let walls: Vec<usize> = axes.filter(|i| one[2][*i] < other[2][*i]).collect();
        assert_eq!(walls.len(), 1, "{}", cases[0].hex());
        for i in (0..3).filter(|i| *i != walls[0]) {
            assert_eq!([one[2][i], one[3][i]], [other[2][i], other[3][i]]);
        }
        assert!(
            cases
                .iter()
                .all(|case| truth(case).hits_closed() == Some(true))
        );
        // Cut down to the wall alone, both are the same box, and it is met.
        let [o, d, mut min, max] = one;
        min[walls[0]] = max[walls[0]];
        let wall = BoxCase::new(o, d, [min, max]);
        assert_eq!(truth(&wall).hits_closed(), Some(true));
        along += usize::from(d[walls[0]] == 0.0);
    }
    assert!(400 < along && along < 600, "{along}");
}
