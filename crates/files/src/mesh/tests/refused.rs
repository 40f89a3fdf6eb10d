//! OBJ files that are refused, each with the line and the reason.

use super::*;
use crate::mesh::counted::{LIMITS, ReadLimits};
use crate::mesh::formats::read_within;
use std::io::Read;

#[test]
fn numbers_that_are_none_are_refused_with_their_line() {
    let vertex = |numbers: &str| refusal(format!("# a\nv {numbers}\nf 1 1 1\n"));
    assert_eq!(vertex("1 2"), "teapot.obj:2: vertex has 2 of 3 coordinates");
    assert_eq!(vertex(""), "teapot.obj:2: vertex has 0 of 3 coordinates");
    assert_eq!(
        vertex("1 x 3"),
        "teapot.obj:2: vertex has 'x', which is not a number"
    );
    assert_eq!(
        vertex("1 2 3 y"),
        "teapot.obj:2: vertex has 'y', which is not a number"
    );
    assert_eq!(
        vertex("1.#INF 0 0"),
        "teapot.obj:2: vertex has '1.#INF', which is not a number"
    );
    assert_eq!(
        vertex("1 nan 3"),
        "teapot.obj:2: vertex has 'nan', which is not finite"
    );
    assert_eq!(
        vertex("1 2 -inf"),
        "teapot.obj:2: vertex has '-inf', which is not finite"
    );
    assert_eq!(
        vertex("1e999 2 3"),
        "teapot.obj:2: vertex has '1e999', which overflows f64"
    );
    assert_eq!(
        vertex("1 2 3 4 5 6 7 8 9"),
        "teapot.obj:2: vertex has 9 numbers; x y z w r g b a are the most"
    );
    let long = format!("\u{1b}{}", "z".repeat(60));
    let shown = format!("\\u{{1b}}{}...", "z".repeat(39));
    assert_eq!(
        vertex(&format!("{long} 2 3")),
        format!("teapot.obj:2: vertex has '{shown}', which is not a number")
    );
}

#[test]
fn faces_that_name_no_vertex_are_refused_with_their_line() {
    let face = |face: &str| refusal(format!("{SQUARE}f {face}\nf 1 2 3\nv 5 5 5\n"));
    let zero = "teapot.obj:5: face names vertex 0, but vertices count from 1";
    assert_eq!(face("0 1 2"), zero);
    assert_eq!(face("1 2 -0"), zero);
    // Negative indices count back from the face, positive ones may look ahead.
    assert_eq!(
        face("1 2 -5"),
        "teapot.obj:5: face names vertex -5 but only 4 vertices precede it"
    );
    assert_eq!(
        face("1 2 6"),
        "teapot.obj:5: face names vertex 6 but the file has only 5 vertices"
    );
    assert_eq!(
        refusal(format!("f 1 2 3\nf 1 2 12\nf 12 1 9\n{SQUARE}")),
        "teapot.obj:2: face names vertex 12 but the file has only 4 vertices"
    );
    assert_eq!(
        refusal("v 1 2 3\nf -1 -2 -3\n"),
        "teapot.obj:2: face names vertex -2 but only 1 vertex precedes it"
    );
    assert_eq!(
        refusal("v 1 2 3\nf 1 1 2\n"),
        "teapot.obj:2: face names vertex 2 but the file has only 1 vertex"
    );
    let many = "99999999999999999999";
    assert_eq!(
        face(&format!("1 2 {many}/1")),
        format!("teapot.obj:5: face names vertex {many}, which no file has")
    );
}

#[test]
fn faces_that_are_none_are_refused_with_their_line() {
    let face = |face: &str| refusal(format!("{SQUARE}f {face}\n"));
    assert_eq!(face(""), "teapot.obj:5: face has 0 of at least 3 vertices");
    assert_eq!(
        face("1 2 # 3"),
        "teapot.obj:5: face has 2 of at least 3 vertices"
    );
    for bad in ["x", "1.0", "/1", "1/2/3/4", "1/x", "1//x", "1,2", "3#"] {
        let expected = format!("teapot.obj:5: face has '{bad}' for v, v/vt, v//vn or v/vt/vn");
        assert_eq!(face(&format!("1 2 {bad}")), expected);
    }
}

#[test]
fn what_is_not_text_is_refused_with_its_line() {
    let number = b"v 0 0 0\nv 0 \xe9 0\n";
    assert_eq!(
        refusal(number),
        "teapot.obj:2: vertex has '\u{fffd}', which is not a number"
    );
    assert_eq!(
        refusal(b"v 0 0 0\n\0\0\n"),
        "teapot.obj:2: a zero byte: not a text file"
    );
    assert_eq!(
        refusal("v 0 0 0\rv 1 1 1\r"),
        "teapot.obj:1: a carriage return within a line: lines end in LF or CR LF"
    );
}

#[test]
fn endless_lines_are_refused_before_they_fill_the_memory() {
    let endless = io::BufReader::new(io::repeat(b'1'));
    let error = read_obj(endless, "zero.obj", &mut |_| {}).expect_err("endless");
    assert_eq!(
        error.to_string(),
        "zero.obj:1: a line of more than 1048576 bytes"
    );
    let continued = "v 1 2 3\n".to_owned() + &"f 1 \\\n".repeat(300_000);
    assert_eq!(
        refusal(continued),
        "teapot.obj:2: a line of more than 1048576 bytes"
    );
    let longest = format!("#{}\n", "x".repeat((1 << 20) - 2));
    assert_eq!(longest.len(), 1 << 20);
    assert_eq!(mesh_of(&format!("{longest}{SQUARE}f 1 2 3\n")).places, [6]);
    assert_eq!(
        refusal(format!("\n#{longest}")),
        "teapot.obj:2: a line of more than 1048576 bytes"
    );
}

/// Text, and then an error.
struct Broken<'a>(&'a [u8]);

impl Read for Broken<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        if self.0.is_empty() {
            return Err(io::Error::new(ErrorKind::BrokenPipe, "the disk is gone"));
        }
        self.0.read(buffer)
    }
}

#[test]
fn errors_of_the_reader_are_passed_on() {
    let broken = io::BufReader::new(Broken(SQUARE.as_bytes()));
    let error = read_obj(broken, "teapot.obj", &mut |_| {}).expect_err("broken");
    assert_eq!(
        error.to_string(),
        "teapot.obj:5: cannot read: the disk is gone"
    );
}

#[test]
fn files_without_vertices_faces_or_triangles_are_refused() {
    assert_eq!(refusal(""), "teapot.obj: the file has no vertices");
    assert_eq!(refusal("f 1 2 3\n"), "teapot.obj: the file has no vertices");
    assert_eq!(refusal(SQUARE), "teapot.obj: the file has no faces");
    assert_eq!(
        refusal(format!("{SQUARE}l 1 2\np 1\n")),
        "teapot.obj: the file has no faces"
    );
    assert_eq!(
        refusal(format!("{SQUARE}f 1 3 2 4\n")),
        "teapot.obj: the file has no triangles: polygons left out, because they cross themselves or \
         fold over: 1 (first at line 5)"
    );
}

#[test]
fn sizes_beyond_the_limits_are_refused_with_their_line() {
    let limited = |text: String| {
        let limits = ReadLimits {
            elements: 4,
            ..LIMITS
        };
        let result = read_within(
            text.as_bytes(),
            "teapot.obj",
            limits,
            &mut nothing_beside,
            &mut |_| {},
        );
        result
            .map(|mesh| mesh.triangles.len())
            .map_err(|error| error.to_string())
    };
    assert_eq!(limited(format!("{SQUARE}f 1 2 3 4\nf 1 2 3 4\n")), Ok(4));
    assert_eq!(
        limited(format!("{SQUARE}f 1 2 3 4\nf 1 2 3\nf 1 2 3 4\n")),
        Err("teapot.obj:7: more than 4 triangles".to_owned())
    );
    assert_eq!(
        limited(format!("{SQUARE}v 0 0 0\nf 1 2 3\n")),
        Err("teapot.obj:5: more than 4 vertices".to_owned())
    );
}

#[test]
fn errors_of_tobj_carry_the_line_that_it_reached() {
    let mut source = obj::ObjSource::default();
    (1..=3).for_each(|line| {
        source
            .mesh
            .vertex([0.0; 3], [0.0; 3], FilePlace::Line(line))
    });
    source.text = "g a\nf 1 2 3\nf 1 2 x\nf 1 2 3\n".to_owned();
    source.face_lines = vec![10, 20, 30];
    let error = source.models_by_tobj("teapot.obj").expect_err("bad face");
    assert_eq!(error.to_string(), "teapot.obj:20: tobj: face parse error");
}
