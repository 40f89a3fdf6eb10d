//! The drawing in a page: a small mesh whole, of a large one the triangles around the places where rows go wrong;
//! and those places, each with the ray that shows it.

use crate::audit::{Audit, PlaceFault, Plan, SourceCell};
use crate::files::mesh::Mesh;
use crate::kernel::Scalar;
use hairline_cases::mesh::{AimedPart, Surface};
use std::collections::{BTreeSet, HashMap};

/// A mesh of at most so many triangles is drawn whole, with every place.
const WHOLE: usize = 5_000;
/// Places of one row in one scalar, of a larger mesh.
pub const PLACES: usize = 300;
/// Triangles around one place.
pub const AROUND: usize = 64;
/// All triangles around places.
const TRIANGLES: usize = 20_000;

/// How many places of a row to keep for the drawing of a mesh.
pub fn places(mesh: &Mesh) -> usize {
    if mesh.triangles.len() <= WHOLE {
        usize::MAX
    } else {
        PLACES
    }
}

/// The drawing of a mesh.
#[derive(Clone, Debug, Default)]
pub struct MeshDrawing {
    /// True if it is the whole mesh.
    pub whole: bool,
    /// True if faces have lines in the file; else they are counted.
    pub has_lines: bool,
    /// The numbers of its vertices in the file, from 1, and where they are drawn: the longest side of the box
    /// around all of them goes from -10^6 to 10^6.
    pub points: Vec<(u32, [i32; 3])>,
    /// Its triangles, by three of the points.
    pub triangles: Vec<[u32; 3]>,
    /// Each row in each scalar, as in the record.
    pub rows: Vec<DrawnRow>,
}

/// Half of a drawing's longest side.
const UNIT: f64 = 1e6;

/// The places of a row in a scalar.
#[derive(Clone, Debug)]
pub struct DrawnRow {
    /// By [`AimedPart::ALL`]: what stands in a command before and after a ray's index.
    pub commands: [[String; 2]; 2],
    /// Cracks first; otherwise in no order, so that the first are spread over the mesh.
    pub marks: Vec<MeshMark>,
}

/// A place where a row goes wrong.
#[derive(Clone, Debug)]
pub struct MeshMark {
    /// The fault.
    pub wrong: PlaceFault,
    /// At an edge or a vertex.
    pub part: AimedPart,
    /// Its two ends, or its vertex twice: vertices of the mesh at first, then points of the drawing.
    pub ends: [u32; 2],
    /// The lines of the faces around it, or their numbers.
    pub lines: Vec<u32>,
    /// How many rays show it.
    pub rays: u32,
    /// The index of the first of them.
    pub index: u64,
    /// The triangles around it, if they alone are drawn.
    around: Vec<u32>,
}

/// The drawing of the mesh whose edges and vertices a plan asks about.
pub fn drawing(plan: &Plan, audit: &Audit) -> Option<MeshDrawing> {
    let surface = plan.surface()?;
    let [edges, vertices] = AimedPart::ALL.map(|part| {
        audit
            .cells
            .iter()
            .filter(move |cell| cell.source == part as usize)
    });
    let of_cells = |(edges, vertices): (&SourceCell, &SourceCell)| in_named_scalar!(edges.scalar, F => row::<F>(surface, plan, [edges, vertices]));
    let rows = edges.zip(vertices).filter_map(of_cells).collect();
    Some(MeshDrawing::new(surface.mesh(), rows))
}

/// The places of a row, of both parts.
fn row<F: Scalar>(surface: &Surface, plan: &Plan, cells: [&SourceCell; 2]) -> Option<DrawnRow> {
    let (mesh, topology) = (surface.mesh(), surface.topology::<F>()?);
    let mut marks = Vec::new();
    for (part, cell) in AimedPart::ALL.into_iter().zip(cells) {
        let targets = plan.sources[cell.source].targets::<F>()?;
        for (order, target, seen) in cell.tally.aimed.places.iter() {
            let (faces, points) = (
                targets.faces(part, target as usize),
                targets.points(part, target as usize),
            );
            let mut lines: Vec<u32> = faces
                .iter()
                .map(|face| mesh.places[*face as usize])
                .collect();
            lines.dedup();
            let mut around = Vec::new();
            if mesh.triangles.len() > WHOLE {
                let at = points
                    .iter()
                    .flat_map(|point| topology.incidence.at(*point as usize));
                around.extend(faces.iter().chain(at).copied().take(AROUND));
            }
            let ends = [points[0], points[points.len() - 1]];
            let (wrong, rays, index) = (order.0, seen.rays, seen.first);
            marks.push((
                order,
                MeshMark {
                    wrong,
                    part,
                    ends,
                    lines,
                    rays,
                    index,
                    around,
                },
            ));
        }
    }
    marks.sort_by_key(|(order, _)| *order);
    marks.truncate(plan.places);
    let command = |cell: &SourceCell| {
        let source = &plan.sources[cell.source];
        let id = source.id::<F>(0, None);
        let command = plan.rows[cell.row].explain_command(&source.explain_arguments::<F>(0, None));
        // The id ends with the index, 0.
        let (before, after) = command.split_once(&id).expect("the command holds the id");
        [format!("{before}{}", &id[..id.len() - 1]), after.to_owned()]
    };
    Some(DrawnRow {
        commands: cells.map(command),
        marks: marks.into_iter().map(|(_, mark)| mark).collect(),
    })
}

impl MeshDrawing {
    /// The words before the numbers of faces.
    pub fn faces(&self) -> &'static str {
        if self.has_lines {
            "faces at lines"
        } else {
            "faces"
        }
    }

    /// The drawing of the rows' places on a mesh. Places whose triangles would be too many are left out, the last of
    /// every row first.
    pub fn new(mesh: &Mesh, mut rows: Vec<DrawnRow>) -> MeshDrawing {
        let whole = mesh.triangles.len() <= WHOLE;
        let faces: Vec<u32> = match whole {
            true => (0..mesh.triangles.len() as u32).collect(),
            false => faces_around(&mut rows),
        };
        let mut places: HashMap<u32, u32> = HashMap::new();
        let mut vertices = Vec::new();
        let mut place = |vertex: u32| {
            *places.entry(vertex).or_insert_with(|| {
                vertices.push(vertex);
                vertices.len() as u32 - 1
            })
        };
        let triangles = faces
            .iter()
            .map(|face| mesh.triangles[*face as usize].map(&mut place))
            .collect();
        for mark in rows.iter_mut().flat_map(|row| &mut row.marks) {
            mark.ends = mark.ends.map(&mut place);
        }
        let positions: Vec<[f64; 3]> = vertices
            .iter()
            .map(|vertex| mesh.positions_f64[*vertex as usize])
            .collect();
        let numbers = vertices.iter().map(|vertex| vertex + 1);
        let points = numbers.zip(drawn(&positions)).collect();
        MeshDrawing {
            whole,
            has_lines: mesh.has_lines,
            points,
            triangles,
            rows,
        }
    }
}

/// The faces around the rows' places, row by row in turn; places beyond the limit are dropped.
fn faces_around(rows: &mut [DrawnRow]) -> Vec<u32> {
    let mut faces = BTreeSet::new();
    let most = rows.iter().map(|row| row.marks.len()).max().unwrap_or(0);
    for turn in 0..most {
        for mark in rows.iter_mut().filter_map(|row| row.marks.get(turn)) {
            faces.extend(mark.around.iter().copied());
        }
        if TRIANGLES < faces.len() {
            rows.iter_mut().for_each(|row| row.marks.truncate(turn + 1));
            break;
        }
    }
    faces.into_iter().collect()
}

/// Where points are drawn. The largest finite numbers do not overflow.
fn drawn(positions: &[[f64; 3]]) -> Vec<[i32; 3]> {
    let largest = positions
        .as_flattened()
        .iter()
        .fold(0.0, |m: f64, x| m.max(x.abs()));
    let size = if largest == 0.0 { 1.0 } else { largest };
    let (mut low, mut high) = ([1.0f64; 3], [-1.0f64; 3]);
    for position in positions {
        low = std::array::from_fn(|i| low[i].min(position[i] / size));
        high = std::array::from_fn(|i| high[i].max(position[i] / size));
    }
    let half = (0..3).fold(0.0, |m: f64, i| m.max((high[i] - low[i]) / 2.0));
    let half = if half == 0.0 { 1.0 } else { half };
    let place = |position: &[f64; 3]| {
        std::array::from_fn(|i| {
            ((position[i] / size - (low[i] + high[i]) / 2.0) / half * UNIT).round() as i32
        })
    };
    positions.iter().map(place).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_longest_side_fills_the_drawing_whatever_the_size() {
        for scale in [1.0, 1e308, 5e-324, 1e-300] {
            let far = drawn(&[[scale, 0.0, 0.0], [-scale, 0.0, scale], [0.0; 3]]);
            assert_eq!(far[0], [1_000_000, 0, -500_000], "{scale}");
            assert_eq!(far[1], [-1_000_000, 0, 500_000], "{scale}");
        }
        assert_eq!(drawn(&[[0.0; 3]; 2]), [[0; 3]; 2]);
        assert_eq!(drawn(&[[7.0, 8.0, 9.0]]), [[0; 3]]);
        assert!(drawn(&[]).is_empty());
    }
}
