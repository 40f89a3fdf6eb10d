//! Rays from inside closed meshes.

use super::*;

/// The surface of the cube from 0 to 2 in all axes, each face of it four squares, each square two triangles.
fn cube(draw: &mut Draw) -> Vec<[[i64; 3]; 3]> {
    let mut triangles = Vec::new();
    for (axis, side, x, y) in (0..24).map(|i| (i % 3, i / 3 % 2, i / 6 % 2, i / 12)) {
        let at = |i: i64, j: i64| {
            let (axis, mut point) = (axis as usize, [0; 3]);
            (point[axis], point[(axis + 1) % 3], point[(axis + 2) % 3]) = (2 * side, x + i, y + j);
            point
        };
        let square = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
        let turn = draw.below(2);
        for corners in [[0, 1, 2], [0, 2, 3]] {
            let mut triangle = corners.map(|i| square[(i + turn) % 4]);
            triangle.rotate_left(draw.below(3));
            if side == 0 {
                triangle.swap(0, 1);
            }
            triangles.push(triangle);
        }
    }
    triangles
}

/// Rays from inside a closed mesh hit it once, wherever they pass: at vertices and edges too.
fn hits_once<F: Float, N: Number + From<F>>() {
    let mut asked = 0;
    for index in 0..400 {
        let mut draw = Draw::new("closed", 1, index);
        let mesh = cube(&mut draw);
        // Numbers that are no grid's, but a lattice's: the points of edges are exact.
        let scale = [3.0, 0.7, 1000.1][draw.below(3)];
        let number = |x: f64| F::from_f64(F::from_f64(scale).to_f64() * x);
        let point = |p: [i64; 3]| p.map(|x| number(x as f64));
        let of =
            |[a, b, c]: [[i64; 3]; 3]| PreparedTriangle::<F, N>::new(point(a), point(b), point(c));
        let triangles: Vec<_> = mesh.iter().map(|triangle| of(*triangle)).collect();
        let target = draw.pick(&mesh);
        // A vertex, the middle of an edge, a point inside, all on the lattice of eighths.
        let weights = draw.pick(&[[8, 0, 0], [4, 4, 0], [1, 7, 0], [2, 2, 4]]);
        let inside = [(); 3].map(|()| draw.integer(1, 15));
        let d = [0, 1, 2].map(|i| {
            let at = (0..3).map(|k| weights[k] * target[k][i]).sum::<i64>();
            number((at - inside[i]) as f64)
        });
        let ray = PreparedRay::<F, N>::new(inside.map(|x| number(x as f64 / 8.0)), d);
        let (zero, infinity) = (F::zero(), F::infinity());
        let hits = |edges| {
            let hit =
                |it: &&PreparedTriangle<F, N>| it.hit_with(&ray, zero, infinity, edges).is_some();
            triangles.iter().filter(hit).count()
        };
        assert_eq!(hits(Edges::Once), 1, "case {index}");
        asked += usize::from(hits(Edges::Closed) != hits(Edges::Open));
    }
    assert!(20 < asked, "{asked}");
}

#[test]
fn a_ray_from_inside_a_closed_mesh_hits_it_once() {
    hits_once::<f32, f64>();
    hits_once::<f64, f64>();
    hits_once::<f32, f32>();
}
