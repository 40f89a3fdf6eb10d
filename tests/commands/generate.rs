//! `hairline generate`: every case of every source, each once, in the text encoding of kernels.

use crate::program::{ends, scratch};

#[test]
fn every_source_is_written_as_lines_with_a_last_one() {
    let folder = scratch("generate");
    let here = |path: &str| format!("{}/{path}", env!("CARGO_MANIFEST_DIR"));
    let [corpus, mesh] = ["corpora/curated.jsonl", "corpora/meshes/torus.obj"].map(here);
    for (flags, case) in [
        (
            &["--family", "interior", "-n", "1500"][..],
            "case interior@2/f32/-/1/0 f32 ",
        ),
        (
            &["--family", "fan", "-n", "3", "--scalar", "f64"],
            "case fan@3/f64/-/1/0.0 f64 ",
        ),
        (
            &[
                "--family", "tiny", "-n", "9", "--scale", "2^-3", "--seed", "5",
            ],
            "case tiny@3/f32/",
        ),
        (&["--corpus", &corpus], "case "),
        (&["--mesh", &mesh, "-n", "20"], "case mesh@"),
    ] {
        let (out, _) = ends(&folder, &[&["generate"][..], flags].concat(), 0);
        assert!(
            out.starts_with(case),
            "{flags:?}: {}",
            out.lines().next().unwrap()
        );
        let (lines, end) = out.trim_end().rsplit_once('\n').unwrap();
        assert_eq!(end, format!("end {}", lines.lines().count()), "{flags:?}");
        for line in lines.lines() {
            assert_eq!(line.split(' ').count(), 20, "{line}");
        }
    }
}
