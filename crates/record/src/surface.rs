//! From the plan of an audit of a mesh's edges and vertices to what its record says of the mesh.

use crate::arith::Float;
use crate::audit::{Audit, GroupCount, Plan, SourceCell, Stock};
use crate::files::mesh::Mesh;
use crate::kernel::Scalar;
use crate::mesh::{MeshPart, MeshScalar, NotedPart, PlacePart, TopologyPart};
use hairline_cases::mesh::{Noted, Surface, Targets, Topology};
use std::collections::BTreeMap;
use std::marker::PhantomData;

const FACES: [&str; 5] = [
    "sound",
    "collapsed",
    "without_area",
    "duplicated",
    "out_of_range",
];
const EDGES: [&str; 5] = ["shared", "open", "inconsistent", "non_manifold", "unsound"];
const VERTICES: [&str; 4] = ["closed_fan", "open_fan", "several_fans", "irregular"];

/// The mesh of such a plan, with the places of all groups that are examples.
pub fn mesh_part(plan: &Plan, audit: &Audit) -> Option<MeshPart> {
    let (surface, edges) = (plan.surface()?, plan.sources.first()?);
    let mesh = surface.mesh();
    let mut places = BTreeMap::new();
    for cell in &audit.cells {
        in_named_scalar!(cell.scalar, F => add_places::<F>(plan, cell, &mut places));
    }
    let scalars = [scalar::<f32>(surface, plan), scalar::<f64>(surface, plan)];
    Some(MeshPart {
        file: surface.family().path().to_owned(),
        digest: mesh.digest.clone(),
        triangles: mesh.triangles.len() as u64,
        vertices: mesh.positions_f64.len() as u64,
        notes: mesh.notes.iter().map(|note| note.to_string()).collect(),
        directions: edges.count,
        seed: edges.seed,
        scalars: scalars.into_iter().flatten().collect(),
        places,
    })
}

/// Adds the places of the groups that a cell has as examples.
fn add_places<F: Scalar>(plan: &Plan, cell: &SourceCell, places: &mut BTreeMap<String, PlacePart>) {
    let source = &plan.sources[cell.source];
    let (Stock::MeshPart(surface, part), Some(targets)) = (&source.stock, source.targets::<F>())
    else {
        return;
    };
    let mesh = surface.mesh();
    let first = |groups: &'_ GroupCount| {
        let GroupCount {
            first_cracks,
            first_doubles,
            first_odd_folds,
            first_elsewhere,
            ..
        } = groups;
        [
            first_cracks,
            first_doubles,
            first_odd_folds,
            first_elsewhere,
        ]
        .map(Vec::clone)
        .concat()
    };
    for index in cell.tally.aimed.classes.iter().flat_map(first) {
        let (target, _) = targets.place(*part, index);
        let faces = targets.faces(*part, target).iter();
        let numbers: Vec<u32> = faces.map(|face| mesh.places[*face as usize]).collect();
        let (lines, faces) = if mesh.has_lines {
            (numbers, Vec::new())
        } else {
            (Vec::new(), numbers)
        };
        let points = targets.points(*part, target).into_iter();
        let points = points.map(|point| targets.position::<F>(point)).collect();
        places.insert(
            source.id::<F>(index, None),
            PlacePart {
                points,
                lines,
                faces,
            },
        );
    }
}

/// A mesh in a scalar; none if the plan does not run in it.
fn scalar<F: Scalar>(surface: &Surface, plan: &Plan) -> Option<MeshScalar> {
    let (targets, topology) = (plan.sources[0].targets::<F>()?, surface.topology::<F>()?);
    let builder = TopologyBuilder::<F> {
        surface,
        targets: &targets,
        scalar: PhantomData,
    };
    Some(MeshScalar {
        scalar: F::NAME,
        topology: builder.topology(topology),
        spacing: F::from_f64(reach(surface.mesh())).ulp().to_f64(),
        smallest: smallest(surface.mesh()),
    })
}

/// The largest coordinate of a mesh.
fn reach(mesh: &Mesh) -> f64 {
    mesh.positions_f64
        .as_flattened()
        .iter()
        .fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// The longest edge of the smallest triangle that has one.
fn smallest(mesh: &Mesh) -> f64 {
    let longest = |triangle: usize| {
        let [a, b, c] = mesh.vertices::<f64>(triangle);
        let length = |p: [f64; 3], q: [f64; 3]| {
            p.iter()
                .zip(q)
                .fold(0.0, |sum: f64, (p, q)| sum.hypot(p - q))
        };
        length(a, b).max(length(b, c)).max(length(c, a))
    };
    let all = (0..mesh.triangles.len())
        .map(longest)
        .filter(|size| 0.0 < *size);
    all.fold(f64::INFINITY, f64::min)
}

struct TopologyBuilder<'a, F> {
    surface: &'a Surface,
    targets: &'a Targets<'a>,
    scalar: PhantomData<F>,
}

impl<F: Float> TopologyBuilder<'_, F> {
    fn finite(&self, points: &[u32]) -> Vec<[Option<f64>; 3]> {
        let finite = |point: &u32| {
            self.targets
                .position::<F>(*point)
                .map(|x| Some(x).filter(|x| x.is_finite()))
        };
        points.iter().map(finite).collect()
    }

    fn topology(&self, topology: &Topology) -> TopologyPart {
        let mesh = self.surface.mesh();
        let noted = |noted: &Noted| {
            let place = noted
                .first
                .as_ref()
                .map(|(face, _)| mesh.places[*face as usize]);
            NotedPart {
                count: noted.count,
                first_line: place.filter(|_| mesh.has_lines),
                first_face: place.filter(|_| !mesh.has_lines),
                first_points: noted
                    .first
                    .as_ref()
                    .map_or_else(Vec::new, |(_, points)| self.finite(points)),
            }
        };
        let named = |names: &[&str], of: &[Noted]| -> BTreeMap<String, NotedPart> {
            names
                .iter()
                .map(|name| (*name).to_owned())
                .zip(of.iter().map(noted))
                .collect()
        };
        let mut faces = named(&FACES, &topology.faces);
        if let Some(note) = mesh.left_out() {
            let place = note.first.map(|place| place.number() as u32);
            let left_out = NotedPart {
                count: note.count as u64,
                first_line: place.filter(|_| mesh.has_lines),
                first_face: place.filter(|_| !mesh.has_lines),
                first_points: Vec::new(),
            };
            faces.insert("left_out".to_owned(), left_out);
        }
        TopologyPart {
            closed_manifold: topology.is_closed_manifold(),
            points: topology.used_points,
            duplicated_places: topology.duplicated_places,
            faces,
            edges: named(&EDGES, &topology.edges),
            vertices: named(&VERTICES, &topology.vertices),
        }
    }
}
