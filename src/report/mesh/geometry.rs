//! The offending edges and vertices as PLY and OBJ files, to open in a viewer.

use super::record::{MeshReport, Offender};
use crate::corpus::mesh::number_text;
use crate::report::Style;
use std::collections::HashMap;
use std::io::{self, Write};

impl Offender {
    /// The worst that it is, cracks first.
    fn kind(&self) -> usize {
        if self.cracks > 0 {
            0
        } else if self.doubles > 0 {
            1
        } else {
            2
        }
    }
}

/// By [`Offender::kind`]: the name of an OBJ group, and a colour.
const KINDS: [(&str, [u8; 3]); 3] =
    [("cracks", [230, 25, 25]), ("doubles", [40, 90, 255]), ("folds", [255, 165, 0])];

/// A point with its scalar and, if it offends itself, as whom.
struct Points<'a> {
    places: HashMap<(&'static str, [u64; 3]), usize>,
    all: Vec<(&'static str, [f64; 3], Option<&'a Offender>)>,
}

impl<'a> Points<'a> {
    /// The offending vertices, and the ends of the offending edges; each once.
    fn of(offenders: &'a [Offender]) -> Points<'a> {
        let mut points = Points { places: HashMap::new(), all: Vec::new() };
        for offender in offenders {
            for point in &offender.points {
                let place = points.place(offender.scalar, point);
                if offender.points.len() == 1 {
                    points.all[place].2 = Some(offender);
                }
            }
        }
        points
    }

    fn place(&mut self, scalar: &'static str, point: &[f64; 3]) -> usize {
        let key = (scalar, point.map(f64::to_bits));
        *self.places.entry(key).or_insert_with(|| {
            self.all.push((scalar, *point, None));
            self.all.len() - 1
        })
    }
}

/// ASCII PLY: points (grey, or in the colour of what happens there) and edges, each with its counts.
pub(super) fn write_ply(report: &MeshReport, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let mut points = Points::of(&report.offenders);
    let edges: Vec<&Offender> = edges(&report.offenders).collect();
    let result = &report.record.result;
    writeln!(out, "ply\nformat ascii 1.0")?;
    writeln!(out, "comment {}, mesh {}", report.record.provenance.tool, result.mesh.digest)?;
    writeln!(out, "comment red: cracks, blue: doubles, orange: folds of wrong parity, grey: ends")?;
    let counts = "property uint cracks\nproperty uint doubles\nproperty uint odd_folds";
    let colour = "property uchar red\nproperty uchar green\nproperty uchar blue";
    writeln!(out, "element vertex {}", points.all.len())?;
    writeln!(out, "property double x\nproperty double y\nproperty double z\n{colour}")?;
    writeln!(out, "{counts}\nproperty uchar bits")?;
    writeln!(out, "element edge {}", edges.len())?;
    writeln!(out, "property int vertex1\nproperty int vertex2\n{colour}\n{counts}")?;
    writeln!(out, "property uchar bits\nend_header")?;
    for (scalar, point, offender) in &points.all {
        let [x, y, z] = point.map(number_text);
        writeln!(out, "{x} {y} {z} {}", properties(*offender, scalar))?;
    }
    for edge in edges {
        let [from, to] = [0, 1].map(|end| points.place(edge.scalar, &edge.points[end]));
        writeln!(out, "{from} {to} {}", properties(Some(edge), edge.scalar))?;
    }
    Ok(())
}

fn edges(offenders: &[Offender]) -> impl Iterator<Item = &Offender> {
    offenders.iter().filter(|offender| offender.points.len() == 2)
}

/// Colour, counts and the scalar's width, as both elements have them.
fn properties(offender: Option<&Offender>, scalar: &str) -> String {
    let [red, green, blue] = offender.map_or([128; 3], |offender| KINDS[offender.kind()].1);
    let counts = |o: &Offender| [o.cracks, o.doubles, o.odd_folds];
    let [cracks, doubles, odd_folds] = offender.map_or([0; 3], counts);
    let bits = scalar.trim_start_matches('f');
    format!("{red} {green} {blue} {cracks} {doubles} {odd_folds} {bits}")
}

/// OBJ: a group of lines and points for each kind and scalar, the worst kind of each offender.
pub(super) fn write_obj(report: &MeshReport, _: Style, out: &mut dyn Write) -> io::Result<()> {
    let mut points = Points::of(&report.offenders);
    let digest = &report.record.result.mesh.digest;
    writeln!(out, "# {}, mesh {digest}", report.record.provenance.tool)?;
    for (_, point, _) in &points.all {
        let [x, y, z] = point.map(number_text);
        writeln!(out, "v {x} {y} {z}")?;
    }
    for scalar in ["f32", "f64"] {
        for (kind, (name, _)) in KINDS.iter().enumerate() {
            let of_kind = |o: &&Offender| o.scalar == scalar && o.kind() == kind;
            let mut offenders = report.offenders.iter().filter(of_kind).peekable();
            if offenders.peek().is_some() {
                writeln!(out, "g {name}_{scalar}")?;
            }
            for offender in offenders {
                let places: Vec<String> = offender
                    .points
                    .iter()
                    .map(|point| (points.place(scalar, point) + 1).to_string())
                    .collect();
                let element = if places.len() == 2 { 'l' } else { 'p' };
                writeln!(out, "{element} {}", places.join(" "))?;
            }
        }
    }
    Ok(())
}
