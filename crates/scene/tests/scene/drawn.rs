//! Small scenes and rays that are hard: lattices full of coincidences, repeated and degenerate faces, T-junctions, NaN,
//! every exponent; and the comparison of the fast answers with the definition.

use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::Draw;
use hairline_core::{Case, truth};
use hairline_scene::{
    Bounds, DefinedHit, InvalidRay, Ray, Scene, Triangle, define, nearest_of, triangles,
};
use num_rational::BigRational as Rational;

/// Vertices and faces.
pub struct Drawn<F> {
    pub vertices: Vec<[F; 3]>,
    pub faces: Vec<[u32; 3]>,
}

impl<F: Float> Drawn<F> {
    pub fn triangles(&self) -> Vec<Triangle<F>> {
        triangles(&self.vertices, &self.faces).unwrap()
    }

    pub fn scene(&self) -> Scene<F> {
        Scene::new(&self.vertices, &self.faces).unwrap()
    }
}

/// How the coordinates of a scene are drawn.
#[derive(Clone, Copy)]
pub struct Style {
    kind: usize,
    /// Lattices have this unit.
    pub exponent: i32,
    /// Lattice points have coordinates up to this many units.
    pub reach: i64,
}

impl Style {
    pub fn draw<F: Float>(draw: &mut Draw) -> Style {
        let (least, most) = (F::MIN_EXPONENT, F::MAX_EXPONENT - 3);
        let any = draw.integer(least.into(), most.into()) as i32;
        // Where cubes still fit, where they do not, at both ends.
        let exponents = [0, 0, 0, any, least, most, -500, 500];
        Style {
            kind: draw.below(8),
            exponent: draw.pick(&exponents).clamp(least, most),
            reach: 2,
        }
    }

    fn number<F: Float>(self, draw: &mut Draw) -> F {
        let lattice = draw.integer(-self.reach, self.reach) as f64;
        let scaled = |x: f64| F::from_f64(scale_by_power_of_two(x, self.exponent));
        match self.kind {
            // Coordinates of all sizes side by side.
            0 => {
                let any = draw.integer(F::MIN_EXPONENT.into(), (F::MAX_EXPONENT - 2).into());
                let other = draw.with_exponent(any as i32);
                draw.pick(&[F::zero(), scaled(lattice), other])
            }
            // Full significands.
            1 => F::from_f64(scale_by_power_of_two(draw.symmetric(), self.exponent)),
            // Next to the lattice.
            2 => scaled(lattice).offset_ulps(draw.integer(-1, 1)),
            // A lattice too fine for 128 bits.
            3 => {
                let fine = draw.integer(-(1 << 20), 1 << 20) as f64 + lattice * 2f64.powi(-25);
                let exponent = self.exponent.min(F::MAX_EXPONENT - 24);
                F::from_f64(scale_by_power_of_two(fine, exponent))
            }
            _ => scaled(lattice),
        }
    }

    pub fn point<F: Float>(self, draw: &mut Draw) -> [F; 3] {
        [(); 3].map(|()| self.number(draw))
    }
}

/// A soup of faces over few points, so that they share vertices and edges, and repeat.
pub fn soup<F: Float>(draw: &mut Draw, style: Style) -> Drawn<F> {
    let mut vertices: Vec<[F; 3]> = (0..3 + draw.below(8)).map(|_| style.point(draw)).collect();
    // Vertices that are not welded, and points between two others.
    for _ in 0..draw.below(3) {
        let (a, b) = (draw.pick(&vertices), draw.pick(&vertices));
        vertices.push(a);
        vertices.push(middle(a, b));
    }
    if draw.below(8) == 0 {
        let wrong = [F::infinity(), -F::infinity(), F::from_f64(f64::NAN)];
        let mut point = style.point(draw);
        point[draw.below(3)] = draw.pick(&wrong);
        vertices.push(point);
    }
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for _ in 0..1 + draw.below(24) {
        let corners = [(); 3].map(|()| draw.below(vertices.len()) as u32);
        let repeated = faces.get(draw.below(faces.len() + 1)).copied();
        faces.push(match (repeated, draw.below(4)) {
            (Some([a, b, c]), 0) => draw.pick(&[[a, b, c], [b, c, a], [b, a, c]]),
            _ => corners,
        });
    }
    Drawn { vertices, faces }
}

fn middle<F: Float>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    let half = F::from_f64(0.5);
    [0, 1, 2].map(|i| a[i] * half + b[i] * half)
}

/// A ray at a vertex, at an edge, in a plane, along an axis, or anywhere; from near, or from very far.
pub fn ray<F: Float>(draw: &mut Draw, style: Style, mesh: &Drawn<F>) -> Ray<F> {
    let vertex = |draw: &mut Draw| draw.pick(&mesh.vertices);
    let between = |draw: &mut Draw| {
        let (a, b) = (draw.pick(&mesh.vertices), draw.pick(&mesh.vertices));
        middle(a, b)
    };
    let mut origin: [F; 3] = match draw.below(4) {
        0 => vertex(draw),
        1 => between(draw),
        _ => style.point(draw),
    };
    let target: [F; 3] = match draw.below(4) {
        0 => vertex(draw),
        1 => between(draw),
        2 => {
            let (a, b) = (between(draw), vertex(draw));
            middle(a, b)
        }
        _ => style.point(draw),
    };
    let mut direction = [0, 1, 2].map(|i| target[i] - origin[i]);
    match draw.below(10) {
        // Along an axis, perhaps backwards, or along a diagonal.
        0 | 1 => {
            let kept = draw.below(6);
            for (axis, x) in direction.iter_mut().enumerate() {
                let zero = draw.pick(&[F::zero(), -F::zero()]);
                *x = if axis == kept % 3 || kept == 3 {
                    *x
                } else {
                    zero
                };
            }
        }
        // A component that is far smaller than the others, or far larger.
        2 => {
            let any = draw.integer(F::MIN_EXPONENT.into(), F::MAX_EXPONENT.into());
            direction[draw.below(3)] = draw.with_exponent(any as i32);
        }
        // From far away, towards the same point.
        3 => {
            let far = F::from_f64(draw.pick(&[1e3, 1e12, 1e30]));
            origin = [0, 1, 2].map(|i| target[i] - direction[i] * far);
        }
        // An edge's direction.
        4 => {
            let (a, b) = (vertex(draw), vertex(draw));
            direction = [0, 1, 2].map(|i| b[i] - a[i]);
        }
        // Any direction of small integers.
        5 => direction = draw.lattice_point(3).map(|x| F::from_f64(x as f64)),
        _ => {}
    }
    if direction.iter().all(F::is_zero) {
        direction[draw.below(3)] = draw.pick(&[F::one(), -F::one()]);
    }
    let power = draw.pick(&[0, 0, 0, 1, -1, 90, -90, 700, -700]);
    let scaled = direction.map(|x| F::from_f64(scale_by_power_of_two(x.to_f64(), power)));
    let is_usable = scaled.iter().all(F::is_finite) && !scaled.iter().all(F::is_zero);
    let ray = Ray::new(origin, if is_usable { scaled } else { direction });
    let (infinity, tiny) = (f64::INFINITY, 1e-300);
    let ends = [0.0, -0.0, 1.0, 0.5, 2.0, -1.0, infinity, -infinity, tiny];
    let [low, high] = [draw.pick(&ends), draw.pick(&ends)];
    match draw.below(12) {
        // Hits at the target are at the ends, if the direction is that to the target.
        0..4 => ray.on(F::from_f64(low.min(high)), F::from_f64(low.max(high))),
        4..8 => ray.on(-F::infinity(), F::infinity()),
        8 => ray.on(F::from_f64(low), F::from_f64(high)),
        _ => ray,
    }
}

/// Counts of what a comparison met.
#[derive(Clone, Copy, Debug, Default)]
pub struct Met {
    pub rays: u64,
    pub invalid: u64,
    pub hits: u64,
    pub ties: u64,
    pub segments: u64,
}

/// The answers with which fast ones are compared.
#[derive(Clone, Copy)]
pub enum Reference {
    /// The definition over all faces.
    Definition,
    /// The definition over the faces that the truths of single triangles say are met: much faster.
    Walk,
}

/// All hits of a ray, without the tree.
fn expected<F: Float>(
    triangles: &[Triangle<F>],
    ray: &Ray<F>,
    reference: Reference,
) -> Result<Vec<DefinedHit>, InvalidRay> {
    let is_met = |face: &u32| {
        let case = Case::<F>::new(ray.origin, ray.direction, triangles[*face as usize]);
        truth(&case.on(ray.t_min, ray.t_max)).hits_closed() == Some(true)
    };
    let all = 0..triangles.len() as u32;
    let faces: Vec<u32> = match reference {
        Reference::Definition => all.collect(),
        Reference::Walk => all.filter(is_met).collect(),
    };
    let some: Vec<Triangle<F>> = faces.iter().map(|face| triangles[*face as usize]).collect();
    let mut hits = define(&some, ray)?;
    for face in hits.iter_mut().flat_map(|hit| &mut hit.faces) {
        *face = faces[*face as usize];
    }
    Ok(hits)
}

/// Compares the fast answers for a ray with others.
pub fn compare<F: Float>(
    mesh: &Drawn<F>,
    scene: &Scene<F>,
    ray: &Ray<F>,
    reference: Reference,
    met: &mut Met,
) {
    met.rays += 1;
    let about = || format!("{ray:?} {:?} {:?}", mesh.vertices, mesh.faces);
    let defined = match expected(&mesh.triangles(), ray, reference) {
        Ok(defined) => defined,
        Err(invalid) => {
            met.invalid += 1;
            assert_eq!(scene.nearest(ray), Err(invalid), "{}", about());
            assert_eq!(scene.hits(ray), Err(invalid), "{}", about());
            return;
        }
    };
    let found = scene.hits(ray).unwrap();
    let faces: Vec<&Vec<u32>> = found.iter().map(|hit| &hit.faces).collect();
    let expected: Vec<&Vec<u32>> = defined.iter().map(|hit| &hit.faces).collect();
    assert_eq!(faces, expected, "{}", about());
    for (hit, defined) in found.iter().zip(&defined) {
        assert!(holds(hit.from, &defined.from), "{hit:?} {}", about());
        assert!(holds(hit.to, &defined.to), "{hit:?} {}", about());
        assert_eq!(hit.is_segment, defined.from < defined.to, "{}", about());
        let values = scene.fractions(ray, hit.faces[0]).unwrap().unwrap();
        assert_eq!(
            values.t,
            [defined.from.clone(), defined.to.clone()],
            "{}",
            about()
        );
        met.hits += 1;
        met.ties += u64::from(1 < hit.faces.len());
        met.segments += u64::from(hit.is_segment);
    }
    let nearest = scene.nearest(ray).unwrap();
    let expected = nearest_of(&defined);
    assert_eq!(
        nearest.as_ref().map(|nearest| &nearest.faces),
        expected.as_ref().map(|(_, faces)| faces),
        "{}",
        about()
    );
    if let (Some(nearest), Some((t, _))) = (nearest, expected) {
        assert!(holds(nearest.t, &t), "{nearest:?} {}", about());
    }
}

/// True if bounds hold a number, which they name if they are one float.
fn holds(bounds: Bounds, t: &Rational) -> bool {
    let is_above = Rational::from_float(bounds.lower).is_none_or(|lower| lower <= *t);
    let is_below = Rational::from_float(bounds.upper).is_none_or(|upper| *t <= upper);
    is_above && is_below && bounds.lower <= bounds.upper
}

/// Compares a number of rays, ten a scene.
pub fn compare_many<F: Float>(seed: u64, rays: u64, reference: Reference) -> Met {
    let mut met = Met::default();
    for index in 0..rays.div_ceil(10) {
        let mut draw = Draw::new("scenes", seed, index);
        let style = Style::draw::<F>(&mut draw);
        let mesh = soup::<F>(&mut draw, style);
        let scene = mesh.scene();
        for _ in 0..10 {
            let ray = ray(&mut draw, style, &mesh);
            compare(&mesh, &scene, &ray, reference, &mut met);
        }
    }
    met
}

/// Compares a number of rays with a mesh of any size, by a walk over its faces.
pub fn compare_mesh<F: Float>(mesh: &Drawn<F>, seed: u64, rays: u64) -> Met {
    let mut met = Met::default();
    let scene = mesh.scene();
    for index in 0..rays {
        let mut draw = Draw::new("mesh", seed, index);
        let style = Style {
            kind: draw.below(8),
            exponent: 0,
            reach: 2,
        };
        let ray = ray(&mut draw, style, mesh);
        compare(mesh, &scene, &ray, Reference::Walk, &mut met);
    }
    met
}
