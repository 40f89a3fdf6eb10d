//! From the sums of a mesh audit to its record.

use super::drawing::{self, DrawnRow, MeshDrawing};
use super::record::*;
use crate::arith::Float;
use crate::audit::mesh::{CLASSES, MeshFound, MeshPlan, MeshTally, RowFound};
use crate::audit::{GroupCount, Row, Trials, quoted};
use crate::corpus::mesh::Mesh;
use crate::mesh::{AimedPart, Noted, Surface, Targets, Topology};
use crate::report::build::{kernel_notes, provenance_of, row_part};
use crate::report::{Context, Rate, Record};
use std::collections::BTreeMap;
use std::marker::PhantomData;

const FACES: [&str; 5] = ["sound", "collapsed", "without_area", "duplicated", "out_of_range"];
const EDGES: [&str; 5] = ["shared", "open", "inconsistent", "non_manifold", "unsound"];
const VERTICES: [&str; 4] = ["closed_fan", "open_fan", "several_fans", "irregular"];

/// Makes the report of a mesh audit.
pub fn build(
    surface: &Surface,
    plan: &MeshPlan,
    found: &[MeshFound],
    context: &Context,
) -> MeshReport {
    let mut parts = MeshParts::default();
    let mesh = surface.mesh();
    let mut provenance = provenance_of(context);
    provenance.kernel_notes = kernel_notes(&plan.rows);
    for found in found {
        in_named_scalar!(found.scalar, F => add_scalar::<F>(surface, plan, found, &mut parts));
        let layers = found.layers.named().map(|(name, count)| (name.to_owned(), count));
        provenance.oracle_layers.insert(found.scalar.to_owned(), BTreeMap::from(layers));
        let time = |row: &RowFound| {
            let label = plan.rows[row.row].label();
            (label, row.nanoseconds as f64 / found.cases.max(1) as f64)
        };
        let times = found.rows.iter().map(time).collect();
        provenance.kernel_nanoseconds.insert(found.scalar.to_owned(), times);
    }
    let result = MeshResult {
        mesh: MeshPart {
            file: surface.family().path().to_owned(),
            digest: mesh.digest.clone(),
            triangles: mesh.triangles.len() as u64,
            vertices: mesh.positions_f64.len() as u64,
            notes: mesh.notes.iter().map(|note| note.to_string()).collect(),
        },
        rows: plan.rows.iter().map(row_part).collect(),
        directions: plan.directions,
        seed: plan.seed,
        unit_directions: plan.unit_direction,
        instance: plan.instance,
        scalars: parts.scalars,
    };
    MeshReport {
        record: Record::new(result, provenance).sealed(),
        drawing: (0 < plan.places).then(|| MeshDrawing::new(mesh, parts.rows)),
    }
}

/// The sums to which every scalar adds.
#[derive(Default)]
struct MeshParts {
    scalars: Vec<ScalarPart>,
    rows: Vec<DrawnRow>,
}

fn add_scalar<F: Float>(
    surface: &Surface,
    plan: &MeshPlan,
    found: &MeshFound,
    parts: &mut MeshParts,
) {
    let parameters = plan.parameters();
    let (Some(targets), Some(topology)) =
        (surface.targets::<F>(&parameters, plan.seed), surface.topology::<F>())
    else {
        return;
    };
    let builder = ReportBuilder::<F> { surface, plan, targets: &targets, scalar: PhantomData };
    let draw = |row| drawing::row::<F>(surface, &targets, topology, plan, row);
    parts.rows.extend(found.rows.iter().map(draw));
    parts.scalars.push(ScalarPart {
        scalar: F::NAME.to_owned(),
        topology: builder.topology(topology),
        spacing: F::from_f64(reach(surface.mesh())).ulp().to_f64(),
        smallest: smallest(surface.mesh()),
        rays: AimedPart::ALL.map(|part| targets.count(part) * plan.directions),
        cases: found.cases,
        results: found.rows.iter().map(|row| builder.row(&plan.rows[row.row], row)).collect(),
    });
}

/// The largest coordinate of a mesh.
fn reach(mesh: &Mesh) -> f64 {
    mesh.positions_f64.as_flattened().iter().fold(0.0, |most, x| f64::max(most, x.abs()))
}

/// The longest edge of the smallest triangle that has one.
fn smallest(mesh: &Mesh) -> f64 {
    let longest = |triangle: usize| {
        let [a, b, c] = mesh.vertices::<f64>(triangle);
        let length = |p: [f64; 3], q: [f64; 3]| {
            p.iter().zip(q).fold(0.0, |sum: f64, (p, q)| sum.hypot(p - q))
        };
        length(a, b).max(length(b, c)).max(length(c, a))
    };
    let all = (0..mesh.triangles.len()).map(longest).filter(|size| 0.0 < *size);
    all.fold(f64::INFINITY, f64::min)
}

struct ReportBuilder<'a, F> {
    surface: &'a Surface,
    plan: &'a MeshPlan,
    targets: &'a Targets<'a>,
    scalar: PhantomData<F>,
}

impl<F: Float> ReportBuilder<'_, F> {
    fn points(&self, points: &[u32]) -> Vec<[f64; 3]> {
        points.iter().map(|point| self.targets.position::<F>(*point)).collect()
    }

    fn finite(&self, points: &[u32]) -> Vec<[Option<f64>; 3]> {
        let finite = |point: [f64; 3]| point.map(|x| Some(x).filter(|x| x.is_finite()));
        self.points(points).into_iter().map(finite).collect()
    }

    fn topology(&self, topology: &Topology) -> TopologyPart {
        let mesh = self.surface.mesh();
        let noted = |noted: &Noted| {
            let place = noted.first.as_ref().map(|(face, _)| mesh.places[*face as usize]);
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
            names.iter().map(|name| (*name).to_owned()).zip(of.iter().map(noted)).collect()
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

    fn row(&self, row: &Row, found: &RowFound) -> MeshRowResult {
        let part = |part: AimedPart| {
            let number = part as usize;
            self.part(row, part, &found.tallies[number], found.cracked[number])
        };
        MeshRowResult {
            kernel: row.entry.info.name.to_owned(),
            set: row.set.clone(),
            promised: row.contract.across.into(),
            edges: part(AimedPart::Edges),
            vertices: part(AimedPart::Vertices),
        }
    }

    fn part(&self, row: &Row, part: AimedPart, tally: &MeshTally, cracked: u64) -> MeshPartResult {
        let class = |sums: &GroupCount| MeshClassResult {
            rates: rates(std::slice::from_ref(sums)),
            first_cracks: self.examples(row, part, &sums.first_cracks),
            first_doubles: self.examples(row, part, &sums.first_doubles),
            first_odd_folds: self.examples(row, part, &sums.first_odd_folds),
            first_elsewhere: self.examples(row, part, &sums.first_elsewhere),
            crack_digest: sums.crack_digest.to_string(),
            double_digest: sums.double_digest.to_string(),
        };
        MeshPartResult {
            cracked,
            of: self.targets.count(part),
            total: rates(&tally.classes),
            classes: CLASSES
                .map(str::to_owned)
                .into_iter()
                .zip(tally.classes.iter().map(class))
                .collect(),
            failures: tally.failures,
            first_failures: self.examples(row, part, &tally.first_failures),
        }
    }

    fn examples(&self, row: &Row, part: AimedPart, indices: &[u64]) -> Vec<MeshExample> {
        let example = |index: &u64| {
            let MeshPlan { seed, .. } = *self.plan;
            let id = self.surface.id::<F>(part, &self.plan.parameters(), seed, *index).to_string();
            let (target, _) = self.targets.place(part, *index);
            let mesh = self.surface.mesh();
            let faces = self.targets.faces(part, target).iter();
            let places: Vec<u32> = faces.map(|face| mesh.places[*face as usize]).collect();
            let (lines, faces) =
                if mesh.has_lines { (places, Vec::new()) } else { (Vec::new(), places) };
            let arguments =
                format!("{} --mesh {}", quoted(&id), quoted(self.surface.family().path()));
            MeshExample {
                points: self.points(&self.targets.points(part, target)),
                lines,
                faces,
                command: row.explain_command(&arguments),
                id,
            }
        };
        indices.iter().map(example).collect()
    }
}

/// The rates of some classes together.
fn rates(classes: &[GroupCount]) -> AcrossRates {
    let sum = |count: fn(&GroupCount) -> u64| -> u64 { classes.iter().map(count).sum() };
    let crossings = sum(|sums| sums.crossings);
    let folds = sum(|sums| sums.folds);
    let rate = |count: u64, of: u64| Rate::new(Trials::independent(count, of), true);
    AcrossRates {
        cracks: rate(sum(|sums| sums.cracks), crossings),
        elsewhere: rate(sum(|sums| sums.elsewhere), crossings),
        doubles: rate(sum(|sums| sums.doubles), crossings),
        even_crossings: rate(sum(|sums| sums.even), crossings),
        odd_folds: rate(sum(|sums| sums.odd_folds), folds),
        missed_folds: rate(sum(|sums| sums.missed_folds), folds),
    }
}
