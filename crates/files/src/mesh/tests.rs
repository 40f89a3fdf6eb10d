//! OBJ files that are read: their triangles, their numbers in both scalars, and what is noted about them.

mod refused;

use super::*;
use crate::InputError;
use crate::case::Draw;
use std::fmt::Write as _;
use std::io::{self, BufRead, ErrorKind};

fn nothing_beside(_: &str, _: u64) -> io::Result<Vec<u8>> {
    Err(ErrorKind::NotFound.into())
}

fn read_obj(
    reader: impl BufRead,
    name: &str,
    progress: &mut dyn FnMut(u64),
) -> Result<Mesh, InputError> {
    super::read(reader, name, &mut nothing_beside, progress)
}

fn read(text: &str) -> Result<Mesh, InputError> {
    read_obj(text.as_bytes(), "teapot.obj", &mut |_| {})
}

fn mesh_of(text: &str) -> Mesh {
    read(text).unwrap_or_else(|error| panic!("{error}"))
}

/// The whole message, with file and line.
fn refusal(text: impl AsRef<[u8]>) -> String {
    read_obj(text.as_ref(), "teapot.obj", &mut |_| {})
        .expect_err("bad input")
        .to_string()
}

fn notes(mesh: &Mesh) -> Vec<String> {
    mesh.notes.iter().map(Note::to_string).collect()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn triangles_carry_their_vertices_and_lines() {
    let mesh = mesh_of(&format!("{SQUARE}# faces\nf 1 2 3\n\nf 1 3 4\n"));
    assert_eq!(mesh.name, "teapot.obj");
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.places, [6, 8]);
    assert_eq!((mesh.groups, mesh.notes.len()), (0, 0));
    assert_eq!(
        mesh.vertices::<f64>(1),
        [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]
    );
    assert_eq!(mesh.vertices::<f32>(0)[2], [1.0f32, 1.0, 0.0]);
    // sha256 of the little-endian bits, computed elsewhere.
    assert_eq!(mesh.digest, "0d7df2c9a8f49774");
}

#[test]
fn both_scalars_are_nearest_to_the_text() {
    let text = "1.000000059604644775390625001";
    let mesh = mesh_of(&format!("v {text} 0.1 -0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"));
    let wide = mesh.positions_f64[0];
    assert_eq!(wide, [1.0 + 2f64.powi(-24), 0.1, 0.0]);
    assert_eq!(wide[0] as f32, 1.0, "a cast rounds twice");
    assert_eq!(mesh.positions_f32[0], [1.0 + f32::EPSILON, 0.1f32, 0.0]);
    assert!(wide[2].is_sign_negative() && mesh.positions_f32[0][2].is_sign_negative());
    assert_eq!(mesh.vertices::<f32>(0)[0][0], 1.0 + f32::EPSILON);
    assert_eq!(mesh.vertices::<f64>(0)[0][1], 0.1);
}

#[test]
fn texture_and_normal_indices_are_dropped_and_need_not_exist() {
    let mesh = mesh_of(&format!(
        "mtllib missing.mtl\n{SQUARE}vt x\nvn\nvp 1\ns\nusemtl\nf 1/7 2/-8 3/9\nf 1//7 3//8 4//9\n\
         f 1/1/1 2/1/ 4//\n"
    ));
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3], [0, 1, 3]]);
    assert_eq!(mesh.places, [11, 12, 13]);
    assert_eq!(notes(&mesh), [""; 0]);
}

#[test]
fn negative_indices_count_back_from_their_face() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 1 1 1\nf -1 -2 -3\nf 1 -1 2\n";
    assert_eq!(mesh_of(text).triangles, [[0, 1, 2], [3, 2, 1], [0, 3, 1]]);
}

#[test]
fn faces_may_come_before_their_vertices_and_groups_in_between() {
    let mesh = mesh_of("g a\nf 1 2 3\ng b\nf 4 3 2\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n");
    assert_eq!(mesh.triangles, [[0, 1, 2], [3, 2, 1]]);
    assert_eq!((mesh.places, mesh.groups), (vec![2, 4], 2));
}

#[test]
fn named_groups_that_hold_triangles_are_counted_once() {
    let text = format!(
        "{SQUARE}f 1 2 3\no empty\ng left wing\nf 1 2 3\ng\nf 1 2 4\n  g right\nf 1 3 4\nf 2 3 4\n\
         g left  wing\nf 1 2 4\no last\n"
    );
    let mesh = mesh_of(&text);
    assert_eq!(mesh.groups, 2);
    assert_eq!(mesh.places, [5, 8, 10, 12, 13, 15]);
}

#[test]
fn line_ends_blanks_comments_and_continuations_do_not_matter() {
    let plain = mesh_of(&format!("{SQUARE}f 1 2 3\nf 1 3 4\n"));
    for text in [
        format!("{SQUARE}f 1 2 3\nf 1 3 4\n").replace('\n', "\r\n"),
        format!("{SQUARE}f 1 2 3\nf 1 3 4\n").replace('\n', "\r\r\n"),
        format!("{SQUARE}f 1 2 3\nf 1 3 4")
            .replace(' ', " \t ")
            .replace('v', "  v"),
        format!("\u{feff}{SQUARE}f 1 2 3#\nf 1 3 4").replace("3#", "3 # 4"),
        format!("{SQUARE}f 1 2\\\n3\nf\\\r\n 1 \\  \n\\\n3 4\\"),
        format!("# C:\\\n{SQUARE}f 1 2 3 # C:\\\nf 1 3 4"),
        SQUARE.replace('1', "+1.0e0") + "f 1 2 3\nf 1 3 4",
    ] {
        let mesh = mesh_of(&text);
        assert_eq!(
            (mesh.digest, mesh.notes),
            (plain.digest.clone(), vec![]),
            "{text:?}"
        );
    }
    assert_eq!(
        mesh_of(&format!("{SQUARE}f 1 2\\\n3\nf 1 3\\\n\\\n4\\")).places,
        [5, 7]
    );
    let continued = format!("{SQUARE}f 1 2 \\\n3\n\nf 1 \\\n 3 9 \\\n");
    assert_eq!(
        refusal(continued),
        "teapot.obj:8: face names vertex 9 but the file has only 4 vertices"
    );
}

#[test]
fn what_is_skipped_or_suspect_is_noted_once_with_its_count_and_first_line() {
    let mesh = mesh_of(
        "v 0 0 0 1\nv 1 0 0 2\nv 1 1 0 0.5 0.25 0\nv 0 1 0 0\nl 1 2\np 1 2 3\nl 3 4\ncurv 0 1\n\
         f 1 2 2\nf 1 3 2\nf 1 1 2 3\nv 1e39 -1e39 0\nv 1e40 0 0\nf 5 1 2\nf 1 3 2 4\nf 2 1 3 4\n",
    );
    assert_eq!(
        notes(&mesh),
        [
            "weights (w) other than 1 ignored: 2 (first at line 2)",
            "lines and points (l, p) skipped: 3 (first at line 5)",
            "unknown statements skipped: 1 (first at line 8)",
            "f32 overflow: vertices with an infinite coordinate in f32: 2 (first at line 12)",
            "triangles without area, kept: 2 (first at line 9)",
            "polygons left out, because they cross themselves or fold over: 2 (first at line 15)",
        ]
    );
    assert_eq!(
        mesh.triangles,
        [[0, 1, 1], [0, 2, 1], [0, 0, 1], [0, 1, 2], [4, 0, 1]]
    );
    assert_eq!(mesh.places, [9, 10, 11, 11, 14]);
    assert_eq!(
        mesh.positions_f64[1],
        [1.0, 0.0, 0.0],
        "a weight does not scale"
    );
    assert_eq!(
        mesh.positions_f32[4],
        [f32::INFINITY, f32::NEG_INFINITY, 0.0]
    );
    assert_eq!(mesh.positions_f64[4], [1e39, -1e39, 0.0]);
}

#[test]
fn polygons_become_fans_from_their_first_vertex_unless_they_fold() {
    let faces = "f 2 3 4 5 1\nf 1 2 6 4\nf 2 6 4 1\nf 1 3 2 4\n";
    let mesh = mesh_of(&format!("{SQUARE}v -1 0.5 0\nv 0.25 0.25 0\n{faces}"));
    let expected = [
        [1, 2, 3],
        [1, 3, 4],
        [1, 4, 0],
        [0, 1, 5],
        [0, 5, 3],
        [0, 1, 5],
        [5, 3, 0],
    ];
    assert_eq!(mesh.triangles, expected);
    assert_eq!(mesh.places, [7, 7, 7, 8, 8, 9, 9]);
    assert_eq!(notes(&mesh).len(), 1);
    assert_eq!(
        (mesh.notes[0].first, mesh.notes[0].count),
        (Some(FilePlace::Line(10)), 1)
    );
    assert_eq!(mesh.left_out(), Some(&mesh.notes[0]));
}

#[test]
fn a_mesh_of_two_hundred_thousand_triangles_reads_right() {
    const SIDE: usize = 317;
    let mut text = String::new();
    for row in 0..SIDE {
        for column in 0..SIDE {
            let height = (row * column) as f64 / 64.0;
            writeln!(text, "v {column} {row} {height}").unwrap();
        }
    }
    let mut expected = Vec::new();
    for row in 1..SIDE {
        writeln!(text, "g row{}", row % 100).unwrap();
        for column in 1..SIDE {
            let a = (row * SIDE + column) as u32;
            let (b, c, d) = (a - 1, a - 1 - SIDE as u32, a - SIDE as u32);
            writeln!(
                text,
                "f {}/1 {}/2 {}/3\nf {} {} {}",
                a + 1,
                b + 1,
                c + 1,
                a + 1,
                c + 1,
                d + 1
            )
            .unwrap();
            expected.extend([[a, b, c], [a, c, d]]);
        }
    }
    let mut reports = Vec::new();
    let mesh = read_obj(text.as_bytes(), "grid.obj", &mut |bytes| {
        reports.push(bytes)
    })
    .unwrap();
    assert!(expected.len() > 199_000);
    assert_eq!(mesh.triangles, expected);
    assert_eq!((mesh.groups, mesh.notes.len()), (100, 0));
    let first = SIDE * SIDE + 2;
    assert_eq!(
        (mesh.places[0], mesh.places[1]),
        (first as u32, first as u32 + 1)
    );
    assert_eq!(
        mesh.places.last().map(|line| *line as usize),
        Some(text.lines().count())
    );
    assert_eq!(mesh.positions_f64[SIDE * 3 + 5], [5.0, 3.0, 15.0 / 64.0]);
    assert_eq!(reports.last(), Some(&(text.len() as u64)));
    assert_eq!(reports.len(), text.len() / (1 << 20) + 1);
    assert!(reports.windows(2).all(|pair| pair[0] < pair[1]));
}

#[test]
fn no_text_makes_the_reader_panic_or_name_a_vertex_that_is_not() {
    let words = "v f f g o l # \\ 1 2 3 4 5 -1 -5 0 1/2 3//4 1e999 0.5 x".split(' ');
    let words: Vec<&str> = words
        .chain(["\n", "\n", "\n", "\r\n", "\nf", "\nf 1 2", "\nv 1"])
        .collect();
    let (mut good, mut bad) = (0, 0);
    for index in 0..20_000 {
        let mut draw = Draw::new("obj", 0, index);
        let text: Vec<&str> = (0..draw.below(20)).map(|_| draw.pick(&words)).collect();
        match read(&format!("{SQUARE}f 1 2 3\n{}\n", text.join(" "))) {
            Ok(mesh) => {
                good += 1;
                assert_eq!(mesh.places.len(), mesh.triangles.len());
                assert_eq!(mesh.positions_f32.len(), mesh.positions_f64.len());
                let count = mesh.positions_f64.len() as u32;
                assert!(
                    mesh.triangles
                        .as_flattened()
                        .iter()
                        .all(|vertex| *vertex < count)
                );
            }
            Err(error) => {
                bad += 1;
                assert!(error.line.is_some_and(|line| line > 5), "{error}");
            }
        }
    }
    assert!(good > 500 && bad > 500, "{good} good, {bad} bad");
}
