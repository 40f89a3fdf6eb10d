//! The topology of a mesh in words: its faces, edges and vertices of each kind, and the edges through which no ray is aimed.

use hairline_record::*;

/// The edges of a mesh through which no ray is aimed, as the end of a sentence; empty if there are none.
pub(super) fn not_asked(mesh: &MeshPart) -> String {
    // In the scalar in which they are most.
    let of_scalar = |part: &MeshScalar| {
        let count = |key: &str| part.topology.edges.get(key).map_or(0, |noted| noted.count);
        (
            EDGE_WORDS[1..].iter().map(|(key, _)| count(key)).sum(),
            count("open"),
        )
    };
    match mesh.scalars.iter().map(of_scalar).max() {
        None | Some((0, _)) => String::new(),
        Some((others, open)) => {
            let edges = number_of(others, "edge is", "edges are");
            format!(
                "; {edges} not asked about, {} of them open",
                group_digits(open)
            )
        }
    }
}

/// The topology, and how many rays were aimed.
pub(super) fn topology_terms(part: &MeshScalar, rays: &[u64]) -> Vec<(&'static str, String)> {
    let mut terms = topology_lines(&part.topology);
    let rays = |i: usize| group_digits(rays.get(i).copied().unwrap_or(0));
    terms.push((
        "aimed",
        format!(
            "{} rays at edges, {} at vertices, in {} ({})",
            rays(0),
            rays(1),
            part.scalar,
            number_of(part.topology.points, "point", "points")
        ),
    ));
    terms
}

/// The topology of the mesh, and where it first is not what rays can be asked about: lines with their heads.
fn topology_lines(topology: &TopologyPart) -> Vec<(&'static str, String)> {
    let kinds = [
        ("faces", &topology.faces, FACE_WORDS),
        ("edges", &topology.edges, EDGE_WORDS),
        ("vertices", &topology.vertices, VERTEX_WORDS),
    ];
    let mut lines = Vec::new();
    for (name, kinds, words) in kinds {
        let count = |key: &&(&str, &str)| kinds.get(key.0).is_some_and(|noted| noted.count > 0);
        let mut parts: Vec<String> = Vec::new();
        for (i, (key, word)) in words.iter().filter(count).enumerate() {
            let noted = &kinds[*key];
            let first = match (noted.first_line, noted.first_face) {
                // The first of the regular ones tells nothing.
                _ if i == 0 && *key == words[0].0 => String::new(),
                (Some(line), _) => format!(" (first at line {line})"),
                (_, Some(face)) => format!(" (first at face {face})"),
                _ => String::new(),
            };
            parts.push(format!("{} {word}{first}", group_digits(noted.count)));
        }
        lines.push((
            name,
            if parts.is_empty() {
                "none".to_owned()
            } else {
                parts.join(", ")
            },
        ));
    }
    if topology.duplicated_places > 0 {
        let places = number_of(topology.duplicated_places, "place", "places");
        lines.push(("", format!("the duplicated faces lie in {places}")));
    }
    if topology.closed_manifold {
        lines.push(("", "a closed surface, wound consistently".to_owned()));
    }
    lines
}

const FACE_WORDS: &[(&str, &str)] = &[
    ("sound", "sound"),
    ("collapsed", "with two equal vertices"),
    ("without_area", "without area"),
    ("duplicated", "duplicated"),
    ("out_of_range", "out of range"),
    (
        "left_out",
        "left out, polygons that cross themselves or fold over",
    ),
];

const EDGE_WORDS: &[(&str, &str)] = &[
    ("shared", "between two faces"),
    ("open", "open"),
    ("inconsistent", "of two faces wound inconsistently"),
    ("non_manifold", "non-manifold"),
    ("unsound", "at faces that are not sound"),
];

const VERTEX_WORDS: &[(&str, &str)] = &[
    ("closed_fan", "inside a closed fan"),
    ("open_fan", "on the boundary"),
    ("several_fans", "of several fans"),
    ("irregular", "at edges or faces not asked about"),
];
