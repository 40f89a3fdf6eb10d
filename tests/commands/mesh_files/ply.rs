//! What PLY can say: types, polygons, headers and their faults.

use super::*;

#[test]
fn ply_files_have_any_types_and_polygons() {
    let solid = solid();
    let expected = mesh_of("a.obj", &solid.obj()).digest;
    let integers = [
        "char", "uchar", "short", "ushort", "int", "uint", "int8", "uint16", "uint32",
    ];
    for encoding in ENCODINGS {
        for (count, index) in integers.iter().zip(integers.iter().cycle().skip(4)) {
            for coordinate in ["float", "double", "float32", "float64"] {
                let bytes = solid.ply(encoding, coordinate, count, index);
                assert_eq!(
                    mesh_of("a.ply", &bytes).digest,
                    expected,
                    "{encoding} {count} {index}"
                );
            }
        }
        // Faces before vertices, a square, and another quadrilateral.
        let mut ply = Ply::new(encoding);
        ply.header("element face 2\nproperty list uchar int vertex_index\nelement vertex 5");
        ply.header("property int x\nproperty short y\nproperty double z\nend_header");
        for face in [[0, 1, 2, 3], [1, 2, 4, 0]] {
            ply.number("uchar", 4.0);
            face.iter()
                .for_each(|corner| ply.number("int", f64::from(*corner)));
            ply.end();
        }
        for [x, y, z] in [
            [0.0, 0.0, 0.1],
            [1.0, 0.0, 0.1],
            [1.0, 1.0, 0.1],
            [0.0, 1.0, 0.1],
            [0.0, 3.0, 0.1],
        ] {
            ply.number("int", x);
            ply.number("short", y);
            ply.number("double", z);
            ply.end();
        }
        let mesh = mesh_of("a.ply", &ply.bytes);
        assert_eq!(
            mesh.triangles,
            [[0, 1, 2], [0, 2, 3], [1, 2, 4], [1, 4, 0]],
            "{encoding}"
        );
        assert_eq!(
            (mesh.positions_f64[2], mesh.positions_f32[2]),
            ([1.0, 1.0, 0.1], [1.0, 1.0, 0.1])
        );
    }
    let head = "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty double x\r\nproperty double y\r\n\
                property double z\r\nelement face 1\r\nproperty list uchar int vertex_indices\r\nend_header\r\n";
    let mesh = mesh_of(
        "a.ply",
        format!("{head}.5 -.5 1.\r\n\r\n1e300 +2 3.e-1\n0 0 0\n3 0 1 2").as_bytes(),
    );
    assert_eq!(
        mesh.positions_f64[..2],
        [[0.5, -0.5, 1.0], [1e300, 2.0, 0.3]]
    );
    let notes: Vec<String> = mesh.notes.iter().map(|note| note.to_string()).collect();
    assert_eq!(
        notes,
        ["f32 overflow: vertices with an infinite coordinate in f32: 1 (first at line 12)"]
    );
    assert_eq!(mesh.places, [14]);
}

#[test]
fn ply_files_that_are_wrong_say_where() {
    let file = |lines: &str| {
        let head = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
                    property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
        refusal("a.ply", format!("{head}{lines}"))
    };
    for (lines, message) in [
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
            "a.ply:13: face names vertex 3, counted from 0, of 3 vertices",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
            "a.ply:13: face 1 of 1: names vertex -1, which no file has",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n2 0 1\n",
            "a.ply:13: face 1 of 1: 2 of at least 3 vertices",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
            "a.ply:13: face 1 of 1: 3 of 4 numbers",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n",
            "a.ply:12: the file ends before face 1 of 1",
        ),
        (
            "0 0 0\n1 0\n0 1 0\n3 0 1 2\n",
            "a.ply:11: vertex 2 of 3: 2 of 3 numbers",
        ),
        (
            "0 0 0\n1 0 0 4\n",
            "a.ply:11: vertex 2 of 3: 4 of 3 numbers",
        ),
        ("0 nan 0\n", "a.ply:10: vertex 1 of 3: 'nan' is not finite"),
        ("0 1e39 0\n", "a.ply:10: vertex 1 of 3: inf is not finite"),
        ("0 x 0\n", "a.ply:10: vertex 1 of 3: 'x' is not a number"),
        (
            "0 0 0\n1 0 0\n0 1 0\n3 0 1 2.5\n",
            "a.ply:13: face 1 of 1: ",
        ),
        (
            "0 0 0\n1 0 0\n0 1 0\n300 0 1 2\n",
            "a.ply:13: face 1 of 1: 4 of 301 numbers",
        ),
    ] {
        let said = file(lines);
        assert!(
            said.starts_with(message) && !said.contains('\n'),
            "{said}\n{message}"
        );
    }
    let header = |lines: &str| refusal("a.ply", format!("ply\n{lines}"));
    let vertex = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    let face = "element face 1\nproperty list uchar int vertex_indices\n";
    for (lines, message) in [
        (String::new(), "a.ply:2: header: Unexpected end of file"),
        (
            "format ascii 2\n".to_owned(),
            "a.ply:2: header: expected one line 'format ascii 1.0', or binary_little_endian or binary_big_endian, \
             found 'format ascii 2'",
        ),
        (
            "format ascii 1.0\nelement vertex three\n".to_owned(),
            "a.ply:3: header: expected 'element NAME COUNT', found 'element vertex three'",
        ),
        (
            "format ascii 1.0\nproperty float x\n".to_owned(),
            "a.ply:3: header: expected 'property TYPE NAME' or 'property list TYPE TYPE NAME' below an element, with a \
             TYPE as float or int, found 'property float x'",
        ),
        (
            format!("format ascii 1.0\n{vertex}property half \"w\u{7}\n"),
            "a.ply:7: header: expected 'property TYPE NAME' or 'property list TYPE TYPE NAME' below an element, with a \
             TYPE as float or int, found 'property half \"w\\u{7}'",
        ),
        (
            format!("format ascii 1.0\nhello it's me{}\n", "!".repeat(99)),
            "a.ply:3: header: expected format, element, property, comment, obj_info or end_header, found 'hello it's \
             me!!!!!!!!!!!!!!!!!!!!!!!!!!!...'",
        ),
        (
            format!("{vertex}{face}end_header\n"),
            "a.ply: header: No format line",
        ),
        (
            format!("format ascii 1.0\n{vertex}end_header\n"),
            "a.ply: the file has no elements 'face'",
        ),
        (
            format!("format ascii 1.0\n{face}end_header\n"),
            "a.ply: the file has no elements 'vertex'",
        ),
        (
            format!(
                "format ascii 1.0\n{face}{}end_header\n",
                vertex.replace(" z", " w")
            ),
            "a.ply: element 'vertex' has no number 'z'",
        ),
        (
            format!(
                "format ascii 1.0\n{vertex}{}end_header\n",
                face.replace(" int", " float")
            ),
            "a.ply: element 'face' has no list of integers 'vertex_indices'",
        ),
        (
            format!(
                "format ascii 1.0\n{}{face}end_header\n",
                vertex.replace(" 3", " 1000000000000")
            ),
            "a.ply: more than 100000000 vertices",
        ),
        (
            format!(
                "format ascii 1.0\n{vertex}{}end_header\n",
                face.replace(" 1\n", " 999999999999\n")
            ),
            "a.ply: more than 100000000 triangles",
        ),
        (
            format!("format ascii 1.0\ncomment {}", "x".repeat(2 << 20)),
            "a.ply: a header of more than 1048576 bytes",
        ),
        // Nothing of the file is an element of that many, and nothing at all is one without properties.
        (
            format!(
                "format binary_little_endian 1.0\nelement none 1000000000000\n\
                 element more 1000000000000\nproperty int n\n{vertex}{face}end_header\n12345678"
            ),
            "a.ply: the file ends in more 3 of 1000000000000",
        ),
    ] {
        let said = header(&lines);
        assert!(
            said.starts_with(message) && !said.contains('\n'),
            "{said}\n{message}"
        );
    }
    let said = refusal("a.ply", "plx\nformat ascii 1.0\n");
    assert_eq!(said, "a.ply:1: header: expected 'ply', found 'plx'");
    let long = "1 ".repeat(1 << 20);
    let (folder, format) = (scratch("ply-codes"), "format ascii 1.0");
    fs::write(
        folder.join("a.ply"),
        format!("ply\n{format}\n{vertex}{face}end_header\n{long}\n"),
    )
    .unwrap();
    let (_, error) = ends(&folder, &["mesh", "a.ply"], 65);
    assert!(
        error.contains("a.ply:10: a line of more than 1048576 bytes"),
        "{error}"
    );
    ends(&folder, &["mesh", "missing.ply"], 74);
    ends(&folder, &["audit", "--mesh", "missing.glb"], 74);
}
