//! Laws that need no definition, and larger scenes against a walk over all faces.

use crate::drawn::{Drawn, Met, Reference, Style, compare, ray, soup};
use hairline_core::Float;
use hairline_core::case::Draw;
use hairline_scene::{Hit, Ray, Scene};

fn faces_of(hits: &[Hit]) -> Vec<Vec<u32>> {
    hits.iter().map(|hit| hit.faces.clone()).collect()
}

/// A scene and a ray for each index, of every style.
fn each(name: &str, count: u64, check: impl Fn(&mut Draw, &Drawn<f64>, &Ray<f64>)) {
    let mut valid = 0;
    for index in 0..count {
        let mut draw = Draw::new(name, 1, index);
        let style = Style::draw::<f64>(&mut draw);
        let mesh = soup::<f64>(&mut draw, style);
        let ray = ray(&mut draw, style, &mesh);
        if mesh.scene().hits(&ray).is_ok() {
            check(&mut draw, &mesh, &ray);
            valid += 1;
        }
    }
    assert!(count / 2 < valid, "{valid}");
}

#[test]
fn the_order_of_faces_and_of_their_vertices_changes_no_hit() {
    each("order", 3000, |draw, mesh, ray| {
        let hits = faces_of(&mesh.scene().hits(ray).unwrap());
        let count = mesh.faces.len();
        let shift = draw.below(count);
        let other = Drawn {
            vertices: mesh.vertices.clone(),
            faces: (0..count)
                .map(|face| mesh.faces[(face + shift) % count])
                .map(|[a, b, c]| draw.pick(&[[a, b, c], [c, b, a], [b, a, c], [c, a, b]]))
                .collect(),
        };
        let mut found = faces_of(&other.scene().hits(ray).unwrap());
        for faces in &mut found {
            faces
                .iter_mut()
                .for_each(|face| *face = ((*face as usize + shift) % count) as u32);
            faces.sort();
        }
        assert_eq!(found, hits);
    });
}

#[test]
fn a_ray_turned_round_has_its_hits_in_the_opposite_order() {
    each("turned", 3000, |_, mesh, ray| {
        let scene = mesh.scene();
        let hits = scene.hits(ray).unwrap();
        let back = Ray::new(ray.origin, ray.direction.map(|x| -x)).on(-ray.t_max, -ray.t_min);
        let turned = scene.hits(&back).unwrap();
        // Segments are in the order of their first t, which is the last one of the ray turned round.
        let ends = |hits: &[Hit], faces: &[u32]| {
            let hit = hits.iter().find(|hit| hit.faces == faces).unwrap();
            [hit.from.lower, hit.from.upper, hit.to.lower, hit.to.upper]
        };
        assert_eq!(hits.len(), turned.len());
        for hit in &hits {
            let [a, b, c, d] = ends(&turned, &hit.faces);
            let overlaps =
                |low: f64, high: f64, with: [f64; 2]| -high <= with[1] && with[0] <= -low;
            assert!(overlaps(a, b, [hit.to.lower, hit.to.upper]));
            assert!(overlaps(c, d, [hit.from.lower, hit.from.upper]));
        }
        if hits.iter().all(|hit| !hit.is_segment) {
            let mut reversed = faces_of(&turned);
            reversed.reverse();
            assert_eq!(faces_of(&hits), reversed);
        }
    });
}

#[test]
fn powers_of_two_change_no_hit() {
    let mut scaled_scenes = 0;
    for index in 0..3000 {
        let mut draw = Draw::new("scaled", 1, index);
        let style = Style::draw::<f32>(&mut draw);
        let narrow = soup::<f32>(&mut draw, style);
        let narrow_ray = ray(&mut draw, style, &narrow).on(0.0, f32::INFINITY);
        let power = |exponent: i64| 2f64.powi(exponent as i32);
        // f32 numbers have room to be scaled in f64, without overflow and underflow.
        let scale = power(draw.integer(-800, 800));
        let stretch = power(draw.integer(-700, 700));
        let wide = |point: &[f32; 3], by: f64| point.map(|x| f64::from(x) * by);
        let mesh = |by: f64| Drawn {
            vertices: narrow
                .vertices
                .iter()
                .map(|vertex| wide(vertex, by))
                .collect(),
            faces: narrow.faces.clone(),
        };
        let ray = |by: f64, stretch: f64| {
            Ray::new(
                wide(&narrow_ray.origin, by),
                wide(&narrow_ray.direction, stretch),
            )
        };
        let Ok(hits) = mesh(1.0).scene().hits(&ray(1.0, 1.0)) else {
            continue;
        };
        let scaled = mesh(scale).scene();
        assert_eq!(
            faces_of(&hits),
            faces_of(&scaled.hits(&ray(scale, stretch)).unwrap())
        );
        let nearest = mesh(1.0).scene().nearest(&ray(1.0, 1.0)).unwrap();
        let other = scaled.nearest(&ray(scale, stretch)).unwrap();
        assert_eq!(nearest.map(|hit| hit.faces), other.map(|hit| hit.faces));
        scaled_scenes += usize::from(!hits.is_empty());
    }
    assert!(500 < scaled_scenes, "{scaled_scenes}");
}

/// A soup of a few hundred faces, most of them between points that are near each other on one axis.
pub fn large_soup<F: Float>(draw: &mut Draw, style: Style) -> Drawn<F> {
    let mut vertices: Vec<[F; 3]> = (0..200).map(|_| style.point(draw)).collect();
    vertices.sort_by(|a, b| a.partial_cmp(b).expect("finite coordinates"));
    let mut faces = Vec::new();
    for _ in 0..400 {
        let reach = draw.pick(&[4, 12, 12, 200]);
        let first = draw.below(vertices.len() + 1 - reach);
        faces.push([(); 3].map(|()| (first + draw.below(reach)) as u32));
    }
    Drawn { vertices, faces }
}

fn check_large<F: Float>(count: u64) {
    let mut met = Met::default();
    for index in 0..count {
        let mut draw = Draw::new("large", 1, index);
        let mut style = Style::draw::<F>(&mut draw);
        // A larger lattice needs some room at the upper end of the exponents.
        style.exponent = style.exponent.min(F::MAX_EXPONENT - 6);
        style.reach = 10;
        let mesh = large_soup::<F>(&mut draw, style);
        let scene = mesh.scene();
        for _ in 0..4 {
            let ray = ray(&mut draw, style, &mesh);
            compare(&mesh, &scene, &ray, Reference::Walk, &mut met);
        }
    }
    assert!(2 * met.rays < met.hits, "{met:?}");
}

#[test]
fn larger_scenes_agree_with_a_walk_over_all_faces() {
    check_large::<f32>(150);
    check_large::<f64>(150);
}

#[test]
fn points_that_are_an_ulp_apart_are_two_hits() {
    // From (1, 0, 0) down to an edge, or to a vertex, that is one ulp higher in the second face.
    let low = [[0.0, 0.0, -1.0], [2.0, 0.0, -1.0], [1.0, 5.0, -9.0]];
    let high = [low[0], [2.0, 0.0, -1.0 + f64::EPSILON], low[2]];
    let down = Ray::new([1.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
    let at_vertex = Ray::new([2.0, 0.0, 0.0], [0.0, 0.0, -1.0]);
    for first in 0..3 {
        let turned = |face: [[f64; 3]; 3]| [0, 1, 2].map(|i| face[(first + i) % 3]);
        let vertices = [turned(low), turned(high)].concat();
        for faces in [[[0, 1, 2], [3, 4, 5]], [[0, 2, 1], [4, 5, 3]]] {
            let scene = Scene::new(&vertices, &faces).unwrap();
            for ray in [down, at_vertex] {
                assert_eq!(
                    faces_of(&scene.hits(&ray).unwrap()),
                    [[1], [0]],
                    "{faces:?}"
                );
                assert_eq!(scene.nearest(&ray).unwrap().unwrap().faces, [1]);
            }
        }
    }
}
