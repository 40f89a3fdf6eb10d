//! Small scenes of instances that are hard: matrices that keep lattices, mirror, flatten, turn, and scale from one end of the
//! exponents to the other; and the comparison of the fast answers with the definition.

use crate::drawn::{Drawn, Reference, Style, ray, soup};
use hairline_core::Float;
use hairline_core::arith::scale_by_power_of_two;
use hairline_core::case::{Draw, Instance as CaseInstance};
use hairline_core::oracle::truths_of_instance;
use hairline_core::{Case, Layers, Truth};
use hairline_scene::{
    Bounds, DefinedHit, Instance, Instances, InvalidRay, Matrix, PlacedFace, Ray, Triangle,
    define_instances, nearest_of,
};
use num_rational::BigRational as Rational;

/// A matrix of one of many kinds.
fn matrix<F: Float>(draw: &mut Draw, style: Style) -> Matrix<F> {
    let lattice = |draw: &mut Draw, bound: i64| draw.integer(-bound, bound) as f64;
    let kind = draw.below(8);
    let mut rows = [[0.0f64; 4]; 3];
    match kind {
        // Axes that change places, and are turned round.
        0..3 => {
            let shift = draw.below(3);
            let order = draw.pick(&[[0, 1, 2], [0, 2, 1]]);
            for (row, axis) in rows.iter_mut().zip(order) {
                row[(axis + shift) % 3] = draw.pick(&[1.0, 1.0, -1.0]);
            }
        }
        // Any small integers: often singular.
        3 | 4 => rows = rows.map(|row| row.map(|_| lattice(draw, 2))),
        // All sizes side by side.
        5 => {
            let mut any = |_| {
                let exponent = draw.integer(-60, 60) as i32;
                draw.pick(&[0.0, 1.0, scale_by_power_of_two(1.0, exponent)])
            };
            rows = rows.map(|row| row.map(&mut any));
        }
        _ => rows = rows.map(|row| row.map(|_| draw.symmetric::<f64>())),
    }
    // Much of it at once: a flat mesh, a translation in units of the lattice, a scale.
    if draw.below(8) == 0 {
        rows[draw.below(3)] = [0.0; 4];
    }
    let unit = scale_by_power_of_two(1.0, style.exponent);
    let exponent = draw.integer(-400, 400) as i32;
    let exponent = draw.pick(&[0, 0, 0, 1, -1, exponent]);
    for row in &mut rows {
        for entry in &mut row[..3] {
            *entry = scale_by_power_of_two(*entry, exponent);
        }
        let whole = lattice(draw, 3);
        row[3] = draw.pick(&[0.0, whole, row[3]]) * unit;
    }
    rows.map(|row| row.map(F::from_f64))
}

/// Meshes and their instances.
pub struct Placement<F> {
    pub meshes: Vec<Vec<Triangle<F>>>,
    pub instances: Vec<Instance<F>>,
    /// The instances in the world, rounded.
    world: Drawn<F>,
}

impl<F: Float> Placement<F> {
    fn draw(draw: &mut Draw, style: Style) -> Placement<F> {
        let meshes = (0..1 + draw.below(2)).map(|_| soup::<F>(draw, style).triangles());
        let meshes: Vec<Vec<Triangle<F>>> = meshes.collect();
        let instances = (0..1 + draw.below(3)).map(|_| Instance {
            mesh: draw.below(meshes.len()) as u32,
            matrix: matrix(draw, style),
        });
        let instances: Vec<Instance<F>> = instances.collect();
        let mut vertices = Vec::new();
        for instance in &instances {
            for vertex in meshes[instance.mesh as usize].iter().flatten() {
                let moved = instance.matrix.map(|[a, b, c, moved]| {
                    let [x, y, z] = *vertex;
                    let sum = a * x + b * y + c * z + moved;
                    if sum.is_finite() { sum } else { F::zero() }
                });
                vertices.push(moved);
            }
        }
        let world = Drawn {
            vertices,
            faces: Vec::new(),
        };
        Placement {
            meshes,
            instances,
            world,
        }
    }
}

/// Counts of what a comparison met.
#[derive(Clone, Copy, Debug, Default)]
pub struct Placements {
    pub rays: u64,
    pub too_large: u64,
    pub invalid: u64,
    pub hits: u64,
    pub ties: u64,
    pub segments: u64,
}

/// True if a triangle in the world lies far to one side of a line, in floats.
fn is_far<F: Float>(matrix: &Matrix<F>, triangle: &Triangle<F>, ray: &Ray<F>) -> bool {
    let [o, d] = [ray.origin, ray.direction].map(|point| point.map(F::to_f64));
    let moved = triangle.map(|vertex| {
        let [x, y, z] = vertex.map(F::to_f64);
        let rows = matrix.map(|row| row.map(F::to_f64));
        let terms = rows.map(|[a, b, c, moved]| [a * x, b * y, c * z, moved]);
        [0, 1, 2].map(|i| {
            let sizes: f64 = terms[i].iter().map(|term| term.abs()).sum();
            (
                terms[i].iter().sum::<f64>() - o[i],
                sizes + o[i].abs() + 1e-290,
            )
        })
    });
    // Planes through the line: normal to it and to an axis.
    (0..3).any(|axis| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        let sides = moved.map(|vertex| {
            let (first, second) = (d[j] * vertex[i].0, d[i] * vertex[j].0);
            let error = 1e-12 * (d[j].abs() * vertex[i].1 + d[i].abs() * vertex[j].1);
            (first - second, error + 1e-290)
        });
        sides.iter().all(|(side, error)| error < side)
            || sides.iter().all(|(side, error)| *side < -error)
    })
}

/// All hits of a ray, without the tree: of all faces, or of those that it meets by the exact inverse of their matrix.
fn expected<F: Float>(
    placement: &Placement<F>,
    ray: &Ray<F>,
    reference: Reference,
) -> Result<Vec<DefinedHit<PlacedFace>>, InvalidRay> {
    let Reference::Walk = reference else {
        return define_instances(&placement.meshes, &placement.instances, ray);
    };
    let (mut faces, mut meshes, mut instances) = (Vec::new(), Vec::new(), Vec::new());
    for (instance, it) in (0..).zip(&placement.instances) {
        let triangles = &placement.meshes[it.mesh as usize];
        let inverted = CaseInstance::checked(it.matrix);
        for (face, triangle) in (0..).zip(triangles) {
            if is_far(&it.matrix, triangle, ray) {
                continue;
            }
            let case = Case::<F>::new(ray.origin, ray.direction, *triangle);
            let mut truths: Vec<Truth> = Vec::new();
            if let Ok(inverted) = &inverted {
                let case = case.on(ray.t_min, ray.t_max);
                truths_of_instance(&[case], inverted, &mut truths, &mut Layers::default());
            }
            if truths.iter().all(|truth| truth.hits_closed() == Some(true)) {
                faces.push(PlacedFace { instance, face });
                instances.push(Instance {
                    mesh: meshes.len() as u32,
                    ..*it
                });
                meshes.push(vec![*triangle]);
            }
        }
    }
    let hits = define_instances(&meshes, &instances, ray)?.into_iter();
    let named = |hit: DefinedHit<PlacedFace>| DefinedHit {
        faces: hit
            .faces
            .iter()
            .map(|face| faces[face.instance as usize])
            .collect(),
        from: hit.from,
        to: hit.to,
    };
    Ok(hits.map(named).collect())
}

/// Compares the fast answers for a ray with others.
fn compare<F: Float>(
    placement: &Placement<F>,
    scene: &Instances<F>,
    ray: &Ray<F>,
    reference: Reference,
    met: &mut Placements,
) {
    let about = || format!("{ray:?} {:?} {:?}", placement.instances, placement.meshes);
    let defined = match expected(placement, ray, reference) {
        Ok(defined) => defined,
        Err(invalid) => {
            met.invalid += 1;
            assert_eq!(scene.nearest(ray), Err(invalid));
            assert_eq!(scene.hits(ray), Err(invalid));
            return;
        }
    };
    let found = scene.hits(ray).unwrap();
    let faces: Vec<&Vec<PlacedFace>> = found.iter().map(|hit| &hit.faces).collect();
    let expected: Vec<&Vec<PlacedFace>> = defined.iter().map(|hit| &hit.faces).collect();
    assert_eq!(faces, expected, "{}", about());
    for (hit, defined) in found.iter().zip(&defined) {
        assert!(holds(hit.from, &defined.from), "{hit:?} {}", about());
        assert!(holds(hit.to, &defined.to), "{hit:?} {}", about());
        assert_eq!(hit.is_segment, defined.from < defined.to, "{}", about());
        let ends = scene.fractions(ray, hit.faces[0]).unwrap();
        let expected = [defined.from.clone(), defined.to.clone()];
        assert_eq!(ends, Some(expected), "{}", about());
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

fn holds(bounds: Bounds, t: &Rational) -> bool {
    let is_above = Rational::from_float(bounds.lower).is_none_or(|lower| lower <= *t);
    let is_below = Rational::from_float(bounds.upper).is_none_or(|upper| *t <= upper);
    is_above && is_below && bounds.lower <= bounds.upper
}

/// Compares a number of rays, ten a scene.
pub fn compare_instances<F: Float>(seed: u64, rays: u64, reference: Reference) -> Placements {
    let mut met = Placements::default();
    for index in 0..rays.div_ceil(10) {
        let mut draw = Draw::new("instances", seed, index);
        let style = Style::draw::<F>(&mut draw);
        let placement = Placement::<F>::draw(&mut draw, style);
        let Ok(scene) = Instances::new(placement.meshes.clone(), &placement.instances) else {
            met.too_large += 1;
            continue;
        };
        for _ in 0..10 {
            let ray = ray(&mut draw, style, &placement.world);
            compare(&placement, &scene, &ray, reference, &mut met);
            met.rays += 1;
        }
    }
    met
}
