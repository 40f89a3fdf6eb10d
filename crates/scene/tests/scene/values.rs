//! The numbers of hits: known ones, and what they have to agree with.

use hairline_core::Facing;
use hairline_core::case::Draw;
use hairline_scene::{InvalidRay, MeshError, Ray, Scene, rounded, triangles};

#[test]
fn a_crossing_has_t_point_side_and_weights() {
    let vertices = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let scene = Scene::<f64>::new(&vertices, &[[0, 1, 2]]).unwrap();
    let ray = Ray::new([1.0, 1.0, 1.0], [0.0, 0.0, -3.0]);
    let values = scene.values(&ray, 0).unwrap().unwrap();
    assert_eq!(values.t, [1.0 / 3.0; 2]);
    assert_eq!(values.points, [[1.0, 1.0, 0.0]; 2]);
    assert_eq!(values.facing, Some(Facing::Front));
    assert_eq!(values.uv, Some([1.0 / 3.0; 2]));
    assert_eq!(scene.values(&ray, 1).unwrap(), None, "no such face");
    assert_eq!(scene.values(&ray.on(0.5, 1.0), 0).unwrap(), None);
    // In the plane: from the origin to the far edge.
    let along = Ray::new([1.0, 1.0, 0.0], [2.0, 0.0, 0.0]);
    let values = scene.values(&along, 0).unwrap().unwrap();
    assert_eq!(values.t, [0.0, 0.5]);
    assert_eq!(values.points, [[1.0, 1.0, 0.0], [2.0, 1.0, 0.0]]);
    assert_eq!((values.facing, values.uv), (None, None));
}

#[test]
fn the_point_of_t_is_the_point_of_the_weights() {
    let mut hits = 0;
    for index in 0..2000 {
        let mut draw = Draw::new("values", 1, index);
        let vertices: [[f64; 3]; 3] = [(); 3].map(|()| draw.point());
        let scene = Scene::new(&vertices, &[[0, 1, 2]]).unwrap();
        let origin: [f64; 3] = draw.point();
        let target = [0, 1, 2].map(|i| (vertices[0][i] + vertices[1][i]) / 2.0);
        let ray = Ray::new(origin, [0, 1, 2].map(|i| target[i] - origin[i]));
        let Some(exact) = scene.fractions(&ray, 0).unwrap() else {
            continue;
        };
        let rational = |x: f64| num_rational::BigRational::from_float(x).unwrap();
        let [u, v] = exact.uv.unwrap();
        for axis in 0..3 {
            let [a, b, c] = vertices.map(|vertex| rational(vertex[axis]));
            let point = &a + &u * (b - &a) + &v * (c - &a);
            assert_eq!(exact.points[0][axis], point);
        }
        let values = scene.values(&ray, 0).unwrap().unwrap();
        assert_eq!(values.t, exact.t.each_ref().map(rounded));
        hits += 1;
    }
    assert!(100 < hits);
}

#[test]
fn the_nearest_doubles_of_t_are_those_of_its_fractions() {
    let [mut crossings, mut segments] = [0, 0];
    for index in 0..4000 {
        let mut draw = Draw::new("nearest t", 1, index);
        let scale = draw.pick(&[1.0, 1e-300, 1e150, f64::from(2f32.powi(-90))]);
        let vertices: [[f64; 3]; 3] = [(); 3].map(|()| draw.point().map(|x: f64| x * scale));
        let scene = Scene::new(&vertices, &[[0, 1, 2]]).unwrap();
        let [a, b, c] = vertices;
        // At the middle of an edge from anywhere, or from one corner through another.
        let middle = [0, 1, 2].map(|i| (a[i] + b[i]) / 2.0);
        let anywhere: [f64; 3] = draw.point().map(|x: f64| x * scale);
        let (origin, target) = draw.pick(&[(anywhere, middle), (a, b), (c, a)]);
        let ray = Ray::new(origin, [0, 1, 2].map(|i| target[i] - origin[i]));
        let ray = draw.pick(&[ray, ray.on(0.0, 0.75), ray.on(1.0 / 3.0, 1e300)]);
        let exact = scene.fractions(&ray, 0).unwrap();
        let nearest = exact.as_ref().map(|exact| exact.t.each_ref().map(rounded));
        assert_eq!(scene.t(&ray, 0).unwrap(), nearest, "{ray:?}");
        crossings += u32::from(exact.as_ref().is_some_and(|it| it.facing.is_some()));
        segments += u32::from(exact.is_some_and(|it| it.t[0] != it.t[1]));
    }
    assert!(100 < crossings && 100 < segments, "{crossings} {segments}");
}

#[test]
fn what_is_no_mesh_and_no_ray_is_named() {
    let missing = MeshError::NoSuchVertex { face: 1, vertex: 2 };
    let vertices = [[0.0f32; 3]; 2];
    let faces = [[0, 1, 1], [1, 2, 0]];
    assert_eq!(triangles(&vertices, &faces), Err(missing));
    assert_eq!(Scene::new(&vertices, &faces).err(), Some(missing));
    let said = "face 1 names vertex 2, which does not exist";
    assert_eq!(missing.to_string(), said);
    let too_many = MeshError::TooManyFaces.to_string();
    assert_eq!(too_many, "a scene has at most 2^32 - 2 faces");
    let scene = Scene::<f32>::new(&vertices, &[[0, 1, 1]]).unwrap();
    let ray = Ray::new([0.0f32; 3], [1.0; 3]);
    for (wrong, invalid, word) in [
        (
            Ray::new([f32::NAN, 0.0, 0.0], [1.0; 3]),
            InvalidRay::NotFinite,
            "finite",
        ),
        (
            Ray::new([0.0; 3], [0.0, f32::INFINITY, 0.0]),
            InvalidRay::NotFinite,
            "finite",
        ),
        (
            Ray::new([0.0; 3], [0.0, -0.0, 0.0]),
            InvalidRay::NoDirection,
            "zero",
        ),
        (ray.on(1.0, 0.5), InvalidRay::Interval, "interval"),
        (ray.on(f32::NAN, 0.5), InvalidRay::Interval, "interval"),
        (ray.on(0.0, f32::NAN), InvalidRay::Interval, "interval"),
    ] {
        assert_eq!(scene.nearest(&wrong), Err(invalid), "{wrong:?}");
        assert_eq!(scene.hits(&wrong), Err(invalid));
        assert_eq!(scene.passages(&wrong), Err(invalid));
        assert!(invalid.to_string().contains(word), "{invalid}");
    }
}
