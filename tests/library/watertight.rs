//! Rays at the edges and vertices of meshes: what a mesh is, by hand and by brute force; counts against
//! the definition in rationals; known facts; threads.

use hairline::internals::arith::Float;
use hairline::internals::audit::{
    Aimed, CLASSES, EpsilonChoice, Plan, Row, Source, SourceCell, Unobserved, exact_severity, run,
};
use hairline::internals::case::{Case, Draw, Parameters};
use hairline::internals::contract::{Extent, NAMED};
use hairline::internals::family::MeshFamily;
use hairline::internals::files::mesh::{Mesh, read as read_mesh};
use hairline::internals::judge::may_be_elsewhere;
use hairline::internals::kernel::{Entry, Failure, Scalar, Verdict, find};
use hairline::internals::mesh::{
    Aim, AimedPart, EdgeKind, FaceKind, MOST_AROUND, Surface, Targets, Topology, VertexKind,
};
use hairline::internals::truth::{Crossing, Facing, Feature, Place, Truth};
use num_rational::BigRational;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::{fs, io};

fn read(text: &str) -> Mesh {
    let mut beside = |_: &str, _| Err(io::ErrorKind::NotFound.into());
    read_mesh(text.as_bytes(), "test.obj", &mut beside, &mut |_| {}).unwrap()
}

/// A mesh from points and faces counted from 0.
fn mesh(points: &[[f64; 3]], faces: &[[usize; 3]]) -> Mesh {
    let mut text = String::new();
    for [x, y, z] in points {
        text.push_str(&format!("v {x:?} {y:?} {z:?}\n"));
    }
    for [a, b, c] in faces {
        text.push_str(&format!("f {} {} {}\n", a + 1, b + 1, c + 1));
    }
    read(&text)
}

fn shape(name: &str) -> Mesh {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpora/meshes");
    read(&fs::read_to_string(format!("{folder}/{name}.obj")).unwrap())
}

/// The unit cube's corners by the bits of their number, and its faces, outwards.
const CUBE: [[usize; 3]; 12] = [
    [0, 2, 1],
    [1, 2, 3],
    [4, 5, 6],
    [5, 7, 6],
    [0, 1, 4],
    [1, 5, 4],
    [2, 6, 3],
    [3, 6, 7],
    [0, 4, 2],
    [2, 4, 6],
    [1, 3, 5],
    [3, 7, 5],
];

fn corner(number: usize) -> [f64; 3] {
    [number & 1, number >> 1 & 1, number >> 2].map(|bit| bit as f64)
}

fn cube() -> (Vec<[f64; 3]>, Vec<[usize; 3]>) {
    ((0..8).map(corner).collect(), CUBE.to_vec())
}

/// Counts of faces, edges and vertices by kind.
fn counts(topology: &Topology) -> ([u64; 5], [u64; 5], [u64; 4]) {
    (
        topology.faces.each_ref().map(|noted| noted.count),
        topology.edges.each_ref().map(|noted| noted.count),
        topology.vertices.each_ref().map(|noted| noted.count),
    )
}

#[test]
fn a_cube_is_a_closed_manifold_of_18_edges() {
    let (points, faces) = cube();
    let topology = Topology::of::<f32>(&mesh(&points, &faces));
    assert_eq!(
        counts(&topology),
        ([12, 0, 0, 0, 0], [18, 0, 0, 0, 0], [8, 0, 0, 0])
    );
    assert!(topology.is_closed_manifold());
    // Around each corner the faces follow each other over shared edges.
    let degrees: usize = (0..8).map(|fan| topology.fans.get(fan).1.len()).sum();
    assert_eq!(degrees, 36);
    for fan in 0..topology.fans.len() {
        let (centre, around) = topology.fans.get(fan);
        for i in 0..around.len() {
            let [one, other] = [i, (i + 1) % around.len()].map(|i| CUBE[around[i] as usize]);
            let common = one.iter().filter(|point| other.contains(point)).count();
            assert!(common == 2 && one.contains(&(centre as usize)));
        }
    }
}

#[test]
fn vertices_are_one_point_where_their_coordinates_are_equal() {
    // Each face has vertices of its own, and zeros of either sign.
    let mut own = Vec::new();
    for (number, face) in CUBE.iter().enumerate() {
        let minus = |x: f64| if x == 0.0 && number % 2 == 1 { -0.0 } else { x };
        own.extend(face.map(|point| corner(point).map(minus)));
    }
    let faces: Vec<[usize; 3]> = (0..12).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let topology = Topology::of::<f64>(&mesh(&own, &faces));
    assert_eq!(topology.points.len(), 36);
    assert_eq!(topology.used_points, 8);
    assert_eq!(
        counts(&topology),
        ([12, 0, 0, 0, 0], [18, 0, 0, 0, 0], [8, 0, 0, 0])
    );
    // A thousandth of an ulp of f32 apart: two points in f64, one in f32.
    own[0][0] += 1e-10;
    own[1][1] += 1e-10;
    let apart = mesh(&own, &faces);
    assert!(Topology::of::<f64>(&apart).edges[EdgeKind::Open as usize].count > 0);
    assert!(
        !Topology::of::<f32>(&apart).is_closed_manifold(),
        "1e-10 is not 0"
    );
    let mut near_one = cube().0;
    near_one[1][0] = 1.0 + 1e-10;
    near_one.push(corner(1));
    let mut faces = CUBE.to_vec();
    faces[0][2] = 8;
    let nearly = mesh(&near_one, &faces);
    assert!(Topology::of::<f32>(&nearly).is_closed_manifold());
    assert_eq!(
        Topology::of::<f64>(&nearly).edges[EdgeKind::Open as usize].count,
        4
    );
}

#[test]
fn an_open_sheet_has_a_boundary() {
    let points: Vec<[f64; 3]> = (0..9)
        .map(|i| [(i % 3) as f64, (i / 3) as f64, 0.0])
        .collect();
    let mut faces = Vec::new();
    for [x, y] in [[0, 0], [1, 0], [0, 1], [1, 1]] {
        let at = 3 * y + x;
        faces.extend([[at, at + 1, at + 4], [at, at + 4, at + 3]]);
    }
    let topology = Topology::of::<f32>(&mesh(&points, &faces));
    assert_eq!(
        counts(&topology),
        ([8, 0, 0, 0, 0], [8, 8, 0, 0, 0], [1, 8, 0, 0])
    );
    assert!(!topology.is_closed_manifold());
}

#[test]
fn a_moebius_strip_is_wound_inconsistently_somewhere() {
    // Seven quads; the last is closed with a half twist.
    let mut points = Vec::new();
    for i in 0..7 {
        let (x, y) = [
            (3, 0),
            (2, 2),
            (-1, 3),
            (-3, 1),
            (-3, -1),
            (-1, -3),
            (2, -2),
        ][i];
        points.push([f64::from(x), f64::from(y), i as f64]);
        points.push([f64::from(x) * 1.5, f64::from(y) * 1.5, 7.0 - i as f64]);
    }
    let at = |i: usize, side: usize| if i < 7 { 2 * i + side } else { 1 - side };
    let mut faces = Vec::new();
    for i in 0..7 {
        let [a, b, c, d] = [at(i, 0), at(i + 1, 0), at(i + 1, 1), at(i, 1)];
        faces.extend([[a, b, c], [a, c, d]]);
    }
    let topology = Topology::of::<f32>(&mesh(&points, &faces));
    assert_eq!(
        counts(&topology),
        ([14, 0, 0, 0, 0], [13, 14, 1, 0, 0], [0, 12, 0, 2])
    );
}

#[test]
fn three_faces_on_one_edge_are_not_manifold() {
    let points = [
        [0.0; 3],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-1.0, -1.0, 0.0],
    ];
    let topology = Topology::of::<f64>(&mesh(&points, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]));
    assert_eq!(
        counts(&topology),
        ([3, 0, 0, 0, 0], [0, 6, 0, 1, 0], [0, 3, 0, 2])
    );
    let noted = &topology.edges[EdgeKind::NonManifold as usize];
    assert_eq!(noted.first, Some((0, vec![0, 1])));
}

#[test]
fn two_solids_at_one_vertex_make_it_several_fans() {
    let mut points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    points.extend([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
    let solid = |a, b, c| [[0, b, a], [0, c, b], [0, a, c], [a, b, c]];
    let faces: Vec<[usize; 3]> = solid(1, 2, 3).into_iter().chain(solid(4, 6, 5)).collect();
    let topology = Topology::of::<f32>(&mesh(&points, &faces));
    assert_eq!(
        counts(&topology),
        ([8, 0, 0, 0, 0], [12, 0, 0, 0, 0], [6, 0, 1, 0])
    );
}

#[test]
fn duplicated_faces_are_found_whichever_way_round() {
    let (points, mut faces) = cube();
    faces.push([3, 2, 1]);
    faces.push([1, 2, 3]);
    let topology = Topology::of::<f32>(&mesh(&points, &faces));
    assert_eq!(topology.faces[FaceKind::Duplicated as usize].count, 3);
    assert_eq!(topology.duplicated_places, 1);
    assert_eq!(topology.edges[EdgeKind::Unsound as usize].count, 3);
    assert_eq!(topology.vertices[VertexKind::Irregular as usize].count, 3);
    assert_eq!(topology.shared.len(), 15);
}

#[test]
fn faces_without_area_are_told_from_thin_ones_exactly() {
    // On one line, as far as rounding can tell: 0.1, 0.2, 0.3 are not, 1, 2, 3 are.
    let on_line = |points: [f64; 3]| points.map(|x| [x, 3.0 * x, -x]);
    let kinds = |points: [[f64; 3]; 3]| {
        let topology = Topology::of::<f64>(&mesh(&points, &[[0, 1, 2]]));
        counts(&topology).0
    };
    assert_eq!(kinds(on_line([1.0, 2.0, 3.0])), [0, 0, 1, 0, 0]);
    assert_eq!(
        kinds([[0.0; 3], [0.1, 0.3, 0.0], [0.2, 0.6, 0.0]]),
        [0, 0, 1, 0, 0]
    );
    assert_eq!(
        kinds([[0.0; 3], [0.1, 0.3, 0.0], [0.3, 0.9, 0.0]]),
        [1, 0, 0, 0, 0]
    );
    assert_eq!(kinds(on_line([1.0, 1.0, 3.0])), [0, 1, 0, 0, 0]);
    // The pole of a sphere of quads: a collapsed face leaves its neighbours neighbours.
    let (mut points, mut faces) = cube();
    points.push([0.0, 0.0, 0.0]);
    faces.push([0, 8, 1]);
    let topology = Topology::of::<f32>(&mesh(&points, &faces));
    assert_eq!(
        counts(&topology),
        ([12, 1, 0, 0, 0], [18, 0, 0, 0, 0], [8, 0, 0, 0])
    );
    assert!(
        !topology.is_closed_manifold(),
        "it has a face that is not sound"
    );
}

#[test]
fn what_is_beyond_f32_is_out_of_its_range() {
    let (mut points, faces) = cube();
    points[7] = [1e39, 1.0, 1.0];
    let topology = Topology::of::<f32>(&mesh(&points, &faces));
    assert_eq!(counts(&topology).0, [9, 0, 0, 0, 3]);
    assert!(Topology::of::<f64>(&mesh(&points, &faces)).is_closed_manifold());
}

/// Twice the area vector is zero, in rationals.
fn has_no_area(points: [[i64; 3]; 3]) -> bool {
    let [a, b, c] = points;
    let [u, v]: [[i64; 3]; 2] = [b, c].map(|p| std::array::from_fn(|i| p[i] - a[i]));
    (0..3).all(|i| u[(i + 1) % 3] * v[(i + 2) % 3] == u[(i + 2) % 3] * v[(i + 1) % 3])
}

#[test]
fn random_meshes_are_sorted_as_by_brute_force() {
    let (mut seen_edges, mut seen_vertices) = ([0; 5], [0; 4]);
    for round in 0..600 {
        let mut draw = Draw::new("random-mesh", 1, round);
        let lattice: Vec<[i64; 3]> = (0..7).map(|_| draw.lattice_point(1)).collect();
        let points: Vec<[f64; 3]> = lattice.iter().map(|p| p.map(|x| x as f64)).collect();
        let faces: Vec<[usize; 3]> = (0..draw.integer(1, 9))
            .map(|_| std::array::from_fn(|_| draw.below(lattice.len())))
            .collect();
        let topology = Topology::of::<f32>(&mesh(&points, &faces));

        let corners: Vec<[[i64; 3]; 3]> = faces.iter().map(|f| f.map(|i| lattice[i])).collect();
        let set = |face: &[[i64; 3]; 3]| face.iter().copied().collect::<BTreeSet<_>>();
        let kind = |face: &[[i64; 3]; 3]| {
            if set(face).len() < 3 {
                FaceKind::Collapsed
            } else if has_no_area(*face) {
                FaceKind::WithoutArea
            } else if corners
                .iter()
                .filter(|other| set(other) == set(face))
                .count()
                > 1
            {
                FaceKind::Duplicated
            } else {
                FaceKind::Sound
            }
        };
        let mut expected = ([0; 5], [0; 5], [0; 4]);
        corners
            .iter()
            .for_each(|face| expected.0[kind(face) as usize] += 1);
        let real: Vec<&[[i64; 3]; 3]> = corners
            .iter()
            .filter(|face| kind(face) != FaceKind::Collapsed)
            .collect();
        let runs = |face: &[[i64; 3]; 3], from: [i64; 3], to: [i64; 3]| {
            (0..3).any(|i| face[i] == from && face[(i + 1) % 3] == to)
        };
        let different: BTreeSet<[i64; 3]> = real.iter().copied().flatten().copied().collect();
        let edge_kind = |p: [i64; 3], q: [i64; 3]| {
            let on: Vec<_> = real
                .iter()
                .filter(|f| set(f).contains(&p) && set(f).contains(&q))
                .collect();
            let forward = on.iter().filter(|face| runs(face, p, q)).count();
            match on.len() {
                0 => None,
                _ if on.iter().any(|face| kind(face) != FaceKind::Sound) => Some(EdgeKind::Unsound),
                1 => Some(EdgeKind::Open),
                2 if forward == 1 => Some(EdgeKind::Shared),
                2 => Some(EdgeKind::Inconsistent),
                _ => Some(EdgeKind::NonManifold),
            }
        };
        for p in &different {
            for q in different.iter().filter(|q| *q > p) {
                if let Some(kind) = edge_kind(*p, *q) {
                    expected.1[kind as usize] += 1;
                }
            }
            // Around the vertex, by joining faces over the edges that they share there.
            let around: Vec<_> = real.iter().filter(|face| face.contains(p)).collect();
            let spokes: BTreeSet<[i64; 3]> = around
                .iter()
                .flat_map(|face| face.iter().copied())
                .filter(|q| q != p)
                .collect();
            let kinds: Vec<_> = spokes.iter().filter_map(|q| edge_kind(*p, *q)).collect();
            let regular = kinds.iter().all(|kind| *kind <= EdgeKind::Open)
                && around.iter().all(|face| kind(face) == FaceKind::Sound);
            let mut group: Vec<usize> = (0..around.len()).collect();
            for (i, one) in around.iter().enumerate() {
                for (j, other) in around.iter().enumerate() {
                    if set(one).intersection(&set(other)).count() == 2 {
                        let (from, to) = (group[i], group[j]);
                        group
                            .iter_mut()
                            .filter(|g| **g == from)
                            .for_each(|g| *g = to);
                    }
                }
            }
            let groups = group.iter().collect::<BTreeSet<_>>().len();
            let vertex = match (regular, groups) {
                (false, _) => VertexKind::Irregular,
                (true, 1) if kinds.contains(&EdgeKind::Open) => VertexKind::Open,
                (true, 1) => VertexKind::Closed,
                _ => VertexKind::SeveralFans,
            };
            expected.2[vertex as usize] += 1;
        }
        assert_eq!(counts(&topology), expected, "round {round}: {corners:?}");
        (0..5).for_each(|i| seen_edges[i] += expected.1[i]);
        (0..4).for_each(|i| seen_vertices[i] += expected.2[i]);
    }
    assert!(seen_edges.iter().all(|count| *count > 10), "{seen_edges:?}");
    assert!(
        seen_vertices.iter().filter(|count| **count > 10).count() >= 3,
        "{seen_vertices:?}"
    );
}

fn row(kernel: &str) -> Vec<Row> {
    EpsilonChoice::Source
        .rows(&[find(kernel).unwrap()], None)
        .unwrap()
}

fn surface(mesh: &Mesh) -> Arc<Surface> {
    let family = MeshFamily::new(mesh.clone(), "test.obj");
    Arc::new(Surface::new(Arc::new(family), [true, true]))
}

/// By row, what was found at the edges and at the vertices of a mesh.
fn found<F: Scalar>(mesh: &Mesh, rows: &[Row], directions: u64) -> Vec<[Aimed; 2]> {
    let sources = Source::parts_of(&surface(mesh), &Parameters::default(), 1, directions).into();
    let scalars = F::NAME.alone();
    let plan = Plan {
        places: 9,
        ..Plan::new(rows.to_vec(), sources, scalars, 5)
    };
    let cells = run(&plan, &Unobserved).cells;
    let at = |row, part: AimedPart| {
        let is_at = |cell: &&SourceCell| (cell.row, cell.source) == (row, part as usize);
        cells.iter().find(is_at).unwrap().tally.aimed.clone()
    };
    (0..rows.len())
        .map(|row| AimedPart::ALL.map(|part| at(row, part)))
        .collect()
}

/// Cracks and doubles of crossings, wrong folds, in all classes: of one part.
fn sums(found: &[[Aimed; 2]], row: usize, part: AimedPart) -> [u64; 5] {
    let classes = &found[row][part as usize].classes;
    let mut sums = [0; 5];
    for class in classes {
        let groups = class;
        let counts = [
            groups.crossings,
            groups.cracks,
            groups.doubles,
            groups.folds,
            groups.odd_folds,
        ];
        sums = std::array::from_fn(|i| sums[i] + counts[i]);
    }
    sums
}

#[test]
fn woop_leaves_no_crack_and_others_do() {
    // On needles a rounded ray may pass into a neighbour: these are asked too.
    for name in ["icosphere", "torus", "far", "heightfield", "needles"] {
        let mesh = shape(name);
        let mut rows = row("woop-watertight");
        rows.extend(row("moller-trumbore"));
        let found = found::<f32>(&mesh, &rows, 8);
        for part in AimedPart::ALL {
            let [crossings, cracks, ..] = sums(&found, 0, part);
            assert!(
                crossings > 0 && cracks == 0,
                "{name}: {cracks} of {crossings}"
            );
        }
        assert_eq!(found[0].each_ref().map(Aimed::leaking), [0, 0]);
        assert!(sums(&found, 1, AimedPart::Edges)[1] > 0, "{name}");
        let first = &found[1][0].classes[0].first_cracks;
        assert!(first.windows(2).all(|pair| pair[0] < pair[1]));
    }
}

#[test]
fn a_hit_that_a_neighbour_reports_leaves_no_crack() {
    let mesh = shape("heightfield");
    let found = found::<f32>(&mesh, &row("woop-watertight"), 12);
    let (topology, parameters) = (Topology::of::<f32>(&mesh), Parameters::default());
    let targets = Targets::new(&mesh, &topology, &parameters, 1);
    let mut elsewhere = 0;
    for part in AimedPart::ALL {
        for class in &found[0][part as usize].classes {
            assert_eq!(class.cracks, 0);
            elsewhere += class.elsewhere;
            for index in &class.first_elsewhere {
                let mut cases = Vec::new();
                targets.make::<f32>(part, *index, &mut cases);
                let hits = |cases: &[Case<f32>]| {
                    let mut verdicts = vec![Verdict::miss(None); cases.len()];
                    let subject = f32::subject(find("woop-watertight").unwrap()).unwrap();
                    subject.run(cases, &row("woop-watertight")[0].epsilons(), &mut verdicts);
                    verdicts.iter().filter(|verdict| verdict.hit).count()
                };
                assert_eq!(hits(&cases), 0);
                // As often as the exact line crosses the whole mesh, up to an even number, it is hit.
                let all: Vec<Case<f32>> = (0..mesh.triangles.len())
                    .map(|face| {
                        let [o, d, ..] = cases[0].vectors();
                        Case::new(o, d, mesh.vertices::<f32>(face))
                    })
                    .collect();
                let is_met = |case: &&Case<f32>| {
                    signs(case).is_some_and(|(_, ahead, w)| ahead && w.iter().all(|w| *w > 0))
                };
                let met = all.iter().filter(is_met).count();
                assert_eq!(hits(&all) % 2, met % 2, "{part:?} {index}");
            }
        }
    }
    assert_eq!(elsewhere, 3);
    assert!(found.iter().flatten().all(|part| part.leaking() == 0));
}

#[test]
fn nobody_is_accused_where_the_neighbours_are_too_many_to_ask() {
    // A cone of very many triangles, and a kernel that reports no hit at all.
    let cone = |edges: usize| {
        let mut points = vec![[0.0, 0.0, 1.0]];
        points.extend((0..edges).map(|i| {
            let turn = std::f64::consts::TAU * i as f64 / edges as f64;
            [turn.cos(), turn.sin(), 0.0]
        }));
        let faces: Vec<[usize; 3]> = (0..edges)
            .map(|i| [0, 1 + i, 1 + (i + 1) % edges])
            .collect();
        let mut rows = row("moller-trumbore");
        rows[0] = EpsilonChoice::Given(vec![("parallel".to_owned(), "1e30".to_owned())])
            .rows(&[find("moller-trumbore").unwrap()], None)
            .unwrap()
            .remove(0);
        let found = found::<f64>(&mesh(&points, &faces), &rows, 1);
        let [crossings, cracks, ..] = sums(&found, 0, AimedPart::Edges);
        let classes = &found[0][AimedPart::Edges as usize].classes;
        (
            crossings,
            cracks,
            classes.iter().map(|class| class.elsewhere).sum::<u64>(),
        )
    };
    let (crossings, cracks, elsewhere) = cone(MOST_AROUND / 2);
    assert!(crossings > 0 && cracks > 0 && cracks + elsewhere == crossings);
    let (crossings, cracks, elsewhere) = cone(MOST_AROUND + 1);
    assert!(crossings > 0 && cracks == 0 && elsewhere == crossings);
}

#[test]
fn pluecker_coordinates_leave_no_crack_at_edges_but_at_vertices() {
    // Each edge has one sign for both its triangles, but around a vertex all signs may turn one way.
    let found = found::<f32>(&shape("icosphere"), &row("plucker"), 16);
    let [crossings, cracks, ..] = sums(&found, 0, AimedPart::Edges);
    assert!(crossings > 10_000);
    assert_eq!(cracks, 0);
    assert!(sums(&found, 0, AimedPart::Vertices)[1] > 0);
}

#[test]
fn nearly_all_rays_that_should_be_exact_are_so() {
    let mesh = shape("torus");
    let found = found::<f32>(&mesh, &row("woop-watertight"), 4);
    for (part, tally) in AimedPart::ALL.into_iter().zip(&found[0]) {
        let of = |class: &str| {
            let class = &tally.classes[CLASSES.iter().position(|name| *name == class).unwrap()];
            class.crossings + class.folds
        };
        // Grazing rays are often over folds, which ask nothing of fans.
        assert!(
            of("exact") * 10 > of("near") * 9,
            "{part:?}: {}, {}",
            of("exact"),
            of("near")
        );
        assert!(
            of("exact-grazing") * 10 > of("near-grazing") * 6,
            "{part:?}"
        );
    }
}

fn rational(x: impl Float) -> BigRational {
    BigRational::from_float(x.to_f64()).unwrap()
}

/// The sign of D, whether t > 0, and the signs of the weights of a, b, c (in units of D), straight from
/// the definition; none if D = 0.
fn signs<F: Float>(case: &Case<F>) -> Option<(bool, bool, [i32; 3])> {
    let [o, d, a, b, c] = case.vectors().map(|v| v.map(rational));
    type V = [BigRational; 3];
    let minus = |p: &V, q: &V| -> V { std::array::from_fn(|i| &p[i] - &q[i]) };
    let det = |u: &V, v: &V, w: &V| -> BigRational {
        (0..3)
            .map(|i| {
                let (j, k) = ((i + 1) % 3, (i + 2) % 3);
                &u[i] * (&v[j] * &w[k] - &v[k] * &w[j])
            })
            .sum()
    };
    let [pa, pb, pc] = [&a, &b, &c].map(|p| minus(p, &o));
    let normal_d = det(&d, &minus(&b, &a), &minus(&c, &a));
    if normal_d.is_zero() {
        return None;
    }
    let t = det(&pa, &minus(&b, &a), &minus(&c, &a)) / &normal_d;
    let sign = |x: BigRational| {
        let x = x / &normal_d;
        i32::from(x.is_positive()) - i32::from(x.is_negative())
    };
    // The sub-triangles' signed areas as seen along d: d·((b-o)×(c-o)) and so on; their sum is D.
    let weights = [det(&d, &pb, &pc), det(&d, &pc, &pa), det(&d, &pa, &pb)].map(sign);
    Some((normal_d.is_positive(), t.is_positive(), weights))
}

/// What is asked of a ray that is judged on any t > 0 from both sides: `Some(true)` a crossing,
/// `Some(false)` a fold with this parity.
fn asked<F: Float>(cases: &[Case<F>], part: AimedPart) -> Option<(bool, bool)> {
    let signs: Option<Vec<_>> = cases.iter().map(signs).collect();
    let signs = signs?;
    let met: Vec<_> = signs
        .iter()
        .filter(|(_, _, weights)| weights.iter().all(|w| *w >= 0))
        .collect();
    let zeros = |weights: &[i32; 3]| weights.iter().filter(|w| **w == 0).count();
    let on = |count: usize| met.iter().filter(|met| zeros(&met.2) == count).count();
    if met.is_empty() || met.iter().any(|met| !met.1) {
        return None;
    }
    let alike = signs.iter().all(|(side, ..)| *side == signs[0].0);
    let inside = (on(0), on(1), on(2));
    if alike {
        let once = match part {
            AimedPart::Edges => matches!(inside, (1, 0, 0) | (0, 2, 0)),
            AimedPart::Vertices => {
                matches!(inside, (1, 0, 0) | (0, 2, 0)) || inside == (0, 0, cases.len())
            }
        };
        return once.then_some((true, true));
    }
    match (part, inside) {
        (AimedPart::Edges, (interior, 0, 0)) => Some((false, interior % 2 == 1)),
        (AimedPart::Edges, (0, 2, 0)) => Some((false, false)),
        _ => None,
    }
}

/// Whether no face that has a point in common with a face of a group, and is not of it, is hit where the
/// exact line does not meet it, nor was a silhouette passed: by rationals, and by points instead of faces.
fn nothing_was_moved<F: Scalar>(
    mesh: &Mesh,
    group: &[u32],
    case: &Case<F>,
    entry: &'static Entry,
    row: &Row,
) -> bool {
    let corners = |face: u32| mesh.vertices::<F>(face as usize);
    let near: Vec<[F; 3]> = group.iter().flat_map(|face| corners(*face)).collect();
    let turned = |case: &Case<F>| signs(case).map(|(side, ..)| side);
    // By the points among which the line passes and the side: whether a face there is hit.
    let mut crossings: Vec<(Vec<[F; 3]>, bool, bool)> = Vec::new();
    for face in 0..mesh.triangles.len() as u32 {
        let points = corners(face);
        if group.contains(&face) || !points.iter().any(|point| near.contains(point)) {
            continue;
        }
        let [origin, direction, ..] = case.vectors();
        let other = Case::new(origin, direction, points);
        let mut verdict = [Verdict::miss(None)];
        F::subject(entry)
            .unwrap()
            .run(&[other], &row.epsilons::<F>(), &mut verdict);
        let hit = verdict[0].hit;
        let weights = signs(&other)
            .filter(|(_, ahead, _)| *ahead)
            .map(|(.., weights)| weights);
        let Some(weights) = weights.filter(|weights| weights.iter().all(|w| *w >= 0)) else {
            if hit {
                return false;
            }
            continue;
        };
        if exact_severity(&other, Extent::Ray).unwrap().in_space >= 1.0 / 1024.0 {
            continue;
        }
        let met = points
            .into_iter()
            .zip(weights)
            .filter(|(_, weight)| *weight > 0);
        let mut met: Vec<[F; 3]> = met.map(|(point, _)| point).collect();
        met.sort_by(|p, q| p.partial_cmp(q).unwrap());
        let from_behind = turned(&other) != turned(case);
        match crossings
            .iter_mut()
            .find(|known| known.0 == met && known.1 == from_behind)
        {
            Some(known) => known.2 |= hit,
            None => crossings.push((met, from_behind, hit)),
        }
    }
    let lost = crossings.iter().filter(|(.., hit)| !hit);
    let from_behind = lost.clone().any(|(_, from_behind, _)| *from_behind);
    !(from_behind && lost.count() % 2 == 1)
}

fn counts_are_those_of_the_definition<F: Scalar>(name: &str, kernels: &[&str], directions: u64) {
    let mesh = shape(name);
    for kernel in kernels {
        let entry = find(kernel).unwrap();
        let rows = EpsilonChoice::Source
            .rows(&[entry], Some("closed-ray"))
            .unwrap()[..1]
            .to_vec();
        let found = found::<F>(&mesh, &rows, directions);
        let topology = Topology::of::<F>(&mesh);
        let parameters = Parameters::default();
        let targets = Targets::new(&mesh, &topology, &parameters, 1);
        for part in AimedPart::ALL {
            let mut expected = [0; 5];
            let mut cracked = BTreeSet::new();
            for index in 0..targets.count(part) * directions {
                let mut cases = Vec::new();
                targets.make::<F>(part, index, &mut cases);
                let Some((crossing, odd)) = asked(&cases, part) else {
                    continue;
                };
                let mut verdicts = vec![Verdict::miss(None); cases.len()];
                let epsilons = rows[0].epsilons::<F>();
                F::subject(entry)
                    .unwrap()
                    .run(&cases, &epsilons, &mut verdicts);
                let hits = verdicts.iter().filter(|verdict| verdict.hit).count();
                if crossing {
                    expected[0] += 1;
                    let group = targets.faces(part, targets.place(part, index).0);
                    let crack =
                        hits == 0 && nothing_was_moved(&mesh, group, &cases[0], entry, &rows[0]);
                    expected[1] += u64::from(crack);
                    expected[2] += u64::from(hits > 1);
                    if crack {
                        cracked.insert(targets.place(part, index).0);
                    }
                } else {
                    expected[3] += 1;
                    expected[4] += u64::from((hits % 2 == 1) != odd);
                }
            }
            assert_eq!(sums(&found, 0, part), expected, "{name} {kernel} {part:?}");
            assert_eq!(found[0][part as usize].leaking(), cracked.len() as u64);
        }
    }
}

#[test]
fn counts_are_those_of_a_direct_evaluation_in_rationals() {
    counts_are_those_of_the_definition::<f32>("far", &["moller-trumbore", "half-space"], 8);
    counts_are_those_of_the_definition::<f64>("far", &["plane-inside-out"], 8);
    counts_are_those_of_the_definition::<f32>("icosphere", &["baldwin-weber"], 1);
}

#[test]
fn threads_do_not_change_anything() {
    let mesh = shape("torus");
    let mut rows = row("moller-trumbore");
    rows.extend(row("plucker"));
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| found::<f32>(&mesh, &rows, 5))
    };
    let one = with(1);
    assert!(one == with(3) && one == with(7));
}

#[test]
fn rays_of_fewer_directions_are_the_first_of_more() {
    let mesh = shape("far");
    let first = |directions| {
        let found = found::<f32>(&mesh, &row("moller-trumbore"), directions);
        found[0][0].classes[0].first_cracks.clone()
    };
    assert_eq!(first(4), first(8));
    let aims: BTreeMap<(bool, bool), u64> = (0..4)
        .map(|number| ((Aim::of(number).exact, Aim::of(number).grazing), number))
        .collect();
    assert_eq!(aims.len(), 4);
}

/// A fan around the origin whose ring goes around so many times, as seen along z.
fn fan_around(times: usize) -> Mesh {
    let ring = [
        [3.0, 0.0],
        [1.0, 3.0],
        [-2.0, 2.0],
        [-2.0, -2.0],
        [1.0, -3.0],
    ];
    let mut points = vec![[0.0; 3]];
    for i in 0..5 * times {
        // Farther out with each time around, so that no two points are one.
        let [x, y] = ring[i % 5].map(|x| x * (1.0 + (i / 5) as f64));
        points.push([x, y, 0.25 * (i % 2) as f64]);
    }
    let faces: Vec<[usize; 3]> = (0..5 * times)
        .map(|i| [0, 1 + i, 1 + (i + 1) % (5 * times)])
        .collect();
    mesh(&points, &faces)
}

#[test]
fn nothing_is_asked_at_the_centre_of_a_fan_that_goes_around_twice() {
    let at_centre = |times| {
        let mesh = fan_around(times);
        let found = found::<f32>(&mesh, &row("woop-watertight"), 400);
        assert_eq!(
            Topology::of::<f32>(&mesh).vertices[VertexKind::Closed as usize].count,
            1
        );
        let tally = &found[0][AimedPart::Vertices as usize];
        tally.classes[0].crossings
    };
    assert!(at_centre(1) > 50);
    assert_eq!(at_centre(2), 0);
}

fn at(feature: Feature, t_sign: Ordering, facing: Facing) -> Truth {
    let place = if t_sign == Ordering::Less {
        Place::Before
    } else {
        Place::Within
    };
    Truth::Transversal(Crossing {
        facing,
        place,
        t_sign,
        feature,
    })
}

/// Of a group that faces front, with neighbours whose boundary is so far from the line.
fn is_elsewhere(neighbours: &[(Truth, bool)], distance: f32) -> bool {
    is_elsewhere_under("closed-ray", neighbours, distance)
}

fn is_elsewhere_under(contract: &str, neighbours: &[(Truth, bool)], distance: f32) -> bool {
    let contract = NAMED
        .iter()
        .find(|named| named.name == contract)
        .unwrap()
        .contract;
    let corners = [
        [-1.0, -distance, 0.0],
        [1.0, -distance, 0.0],
        [0.0, 2.0, 0.0],
    ];
    let cases = vec![Case::<f32>::new([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], corners); 9];
    let truths: Vec<Truth> = neighbours.iter().map(|(truth, _)| *truth).collect();
    let verdict = |(_, hit): &(Truth, bool)| Verdict {
        hit: *hit,
        ..Verdict::miss(None)
    };
    let verdicts: Vec<_> = neighbours.iter().map(verdict).collect();
    may_be_elsewhere(Facing::Front, &cases, &truths, &verdicts, &contract)
}

#[test]
fn a_hit_is_elsewhere_where_a_neighbour_has_one_that_is_not_its_own() {
    let ahead = |feature| at(feature, Ordering::Greater, Facing::Front);
    let (outside, inside) = (ahead(Feature::Outside), ahead(Feature::Interior));
    let before = at(Feature::Interior, Ordering::Less, Facing::Front);
    let misses = [(outside, false), (Truth::Parallel, false), (before, false)];
    assert!(!is_elsewhere(&[], 0.0));
    assert!(!is_elsewhere(&misses, 0.0));
    for passed in [outside, before, Truth::Parallel, Truth::Invalid] {
        assert!(
            is_elsewhere(&[(outside, false), (passed, true)], 0.5),
            "{passed:?}"
        );
    }
    // What is met itself has a hit of its own.
    assert!(!is_elsewhere(&[(inside, true), (outside, false)], 0.0));
    assert!(!is_elsewhere(&[(inside, false), (outside, false)], 0.0));
}

#[test]
fn a_ray_may_pass_beside_a_silhouette() {
    let [inside, rim] = [Feature::Interior, Feature::EdgeAb]
        .map(|feature| at(feature, Ordering::Greater, Facing::Back));
    assert!(is_elsewhere(&[(inside, false)], 1e-4));
    assert!(
        !is_elsewhere(&[(inside, false)], 0.25),
        "the far side of a small mesh"
    );
    assert!(
        !is_elsewhere(&[(inside, true)], 1e-4),
        "the parity is wrong"
    );
    assert!(is_elsewhere(&[(rim, false), (rim, false)], 0.0));
    assert!(!is_elsewhere(&[(rim, false), (rim, true)], 0.0));
    // Beside several folds: what counts is whether as many hits are lost from either side.
    let front = at(Feature::Interior, Ordering::Greater, Facing::Front);
    assert!(is_elsewhere(&[(inside, false), (inside, true)], 1e-4));
    assert!(!is_elsewhere(&[(inside, false), (front, false)], 1e-4));
    assert!(is_elsewhere(
        &[(inside, false), (front, false), (inside, false)],
        1e-4
    ));
    assert!(!is_elsewhere(&[(front, false)], 1e-4), "no silhouette");
    // What one of the faces at an edge reports is not lost.
    assert!(!is_elsewhere(
        &[(rim, false), (rim, true), (front, false)],
        1e-4
    ));
    // Two edges are two crossings.
    let other_rim = at(Feature::EdgeBc, Ordering::Greater, Facing::Back);
    assert!(!is_elsewhere(&[(rim, false), (other_rim, false)], 0.0));
    assert!(is_elsewhere(
        &[(rim, false), (other_rim, false), (front, false)],
        0.0
    ));
    // Who culls reports none from behind.
    let culling =
        |neighbours: &[(Truth, bool)]| is_elsewhere_under("front-closed-ray", neighbours, 1e-4);
    assert!(culling(&[(inside, false)]) && culling(&[(inside, false), (inside, false)]));
    assert!(!culling(&[(front, false)]));
}

#[test]
fn what_lies_around_a_line_is_told_apart_by_distance_and_by_edge() {
    let back = |feature| at(feature, Ordering::Greater, Facing::Back);
    type Around = ([[f32; 2]; 3], Truth, Verdict<f32>);
    let ask = |neighbours: &[Around]| {
        let case = |(corners, ..): &Around| {
            let corners = corners.map(|[x, y]| [x, y, 0.0]);
            Case::new([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], corners)
        };
        let cases: Vec<Case<f32>> = neighbours.iter().map(case).collect();
        let truths: Vec<Truth> = neighbours.iter().map(|(_, truth, _)| *truth).collect();
        let verdicts: Vec<_> = neighbours.iter().map(|(.., verdict)| *verdict).collect();
        let closed = NAMED
            .iter()
            .find(|named| named.name == "closed-ray")
            .unwrap()
            .contract;
        may_be_elsewhere(Facing::Front, &cases, &truths, &verdicts, &closed)
    };
    let miss = Verdict::miss(None);
    // A 1024th of the longest edge is not near any more.
    let wide = |y: f32| [[-512.0, -y], [512.0, -y], [0.0, 200.0]];
    let inside = back(Feature::Interior);
    assert!(ask(&[(wide(1.0f32.next_down()), inside, miss)]));
    assert!(!ask(&[(wide(1.0), inside, miss)]));
    // Two faces have one crossing on their edge, which either may report; they go along it in two ways.
    let (one, other) = (
        [[-1.0, 0.0], [1.0, 0.0], [0.0, 2.0]],
        [[1.0, 0.0], [-1.0, 0.0], [0.0, -2.0]],
    );
    let rim = back(Feature::EdgeAb);
    let hit = Verdict { hit: true, ..miss };
    assert!(ask(&[(one, rim, miss), (other, rim, miss)]));
    assert!(!ask(&[(one, rim, miss), (other, rim, hit)]));
    assert!(!ask(&[(other, rim, hit), (one, rim, miss)]));
    // Lost inside, on an edge, and a third to make the number odd.
    let front = at(Feature::Interior, Ordering::Greater, Facing::Front);
    assert!(ask(&[
        (wide(0.5), inside, miss),
        (one, rim, miss),
        (wide(0.5), front, miss)
    ]));
    // Of a neighbour on which the kernel failed nothing is known.
    let outside = back(Feature::Outside);
    assert!(!ask(&[(wide(1.0), outside, miss)]));
    assert!(ask(&[
        (wide(1.0), outside, miss),
        (wide(1.0), outside, Verdict::failed(Failure::Panic))
    ]));
    assert!(ask(&[(
        wide(1.0),
        inside,
        Verdict::failed(Failure::Timeout)
    )]));
}
