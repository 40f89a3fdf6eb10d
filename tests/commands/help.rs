//! `hairline help` knows the commands, and every word of a screen.

use super::program;
use std::fs;
use std::path::Path;
use std::process::Output;

fn hairline(arguments: &[&str]) -> Output {
    program::hairline(Path::new("."), arguments)
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

/// Heads of columns in what a command prints, without scalars, numbers and what stands behind a comma or a colon.
fn heads_of(arguments: &[&str]) -> Vec<String> {
    let output = hairline(&[arguments, &["--format", "markdown"]].concat());
    let printed = text(&output.stdout);
    let lines: Vec<&str> = printed.lines().collect();
    let is_head = |lines: &&[&str]| lines[1].starts_with("| ---");
    let heads = lines.windows(2).filter(is_head).map(|lines| lines[0]);
    let told = |head: &str| {
        let end = head.find([',', ':', '[', '(', '\\']).unwrap_or(head.len());
        let is_word = |word: &&str| {
            !word.contains(|c: char| c.is_ascii_digit()) && *word != "%" && *word != "all"
        };
        let words: Vec<&str> = head[..end].split_whitespace().filter(is_word).collect();
        words.join(" ")
    };
    let columns = heads.flat_map(|head| head.trim_matches('|').split(" | "));
    columns.map(told).filter(|head| head.len() > 1).collect()
}

#[test]
fn help_knows_the_heads_of_all_columns() {
    let mesh = concat!(env!("CARGO_MANIFEST_DIR"), "/corpora/meshes/torus.obj");
    let mut heads: Vec<String> = [
        &["audit", "-n", "20", "-q"][..],
        &[
            "audit",
            "-n",
            "20",
            "-q",
            "--kernel",
            "moller-trumbore",
            "--details",
        ],
        &["mesh", mesh, "-q", "--scalar", "f32", "--details"],
        &[
            "epsilon",
            "--scene",
            "room",
            "-n",
            "300",
            "-q",
            "--scalar",
            "f32",
            "--details",
        ],
        &[
            "offset",
            "--scene",
            "room",
            "-n",
            "300",
            "-q",
            "--scalar",
            "f32",
            "--details",
        ],
        &[
            "prove",
            "--kernel",
            "moller-trumbore",
            "--scalar",
            "f32",
            "--details",
        ],
        &["prove", "--scalar", "f32"],
        &[
            "explain",
            "tiny@3/f32/-/1/15467",
            "--kernel",
            "moller-trumbore",
        ],
        &["explain", "tiny@3/f32/-/1/15467"],
        &["boxes", "audit", "-n", "200"],
        &["boxes", "epsilon", "-n", "200"],
        &["boxes", "prove"],
    ]
    .into_iter()
    .flat_map(heads_of)
    .collect();
    heads.sort();
    heads.dedup();
    let is_unknown = |head: &&String| code(&hairline(&["help", head])) != 0;
    let unknown: Vec<&String> = heads.iter().filter(is_unknown).collect();
    assert!(70 < heads.len(), "{heads:?}");
    assert!(unknown.is_empty(), "{unknown:?}");
}

#[test]
fn help_knows_commands_and_the_words_of_the_screens() {
    let out = |arguments: &[&str]| {
        let output = hairline(arguments);
        assert_eq!(code(&output), 0, "{arguments:?}: {}", text(&output.stderr));
        text(&output.stdout)
    };
    assert_eq!(out(&["help"]), out(&["--help"]));
    assert_eq!(
        out(&["help", "fuzz", "triage"]),
        out(&["fuzz", "triage", "--help"])
    );
    let epsilon = out(&["help", "epsilon"]);
    assert!(
        epsilon.starts_with("Example: hairline epsilon --kernel "),
        "{epsilon}"
    );
    // Any case, number and hyphen; several names of one thing.
    let miss = out(&["help", "False-Misses"]);
    assert!(
        miss.starts_with("false miss: the contract demands a hit"),
        "{miss}"
    );
    assert_eq!(out(&["help", "leaks"]), out(&["help", "crack"]));
    let all = out(&["help", "words"]);
    let guide =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/guide/words.md"));
    let entries = guide
        .unwrap()
        .lines()
        .filter(|line| line.starts_with("- "))
        .count();
    let terms = all
        .lines()
        .filter(|line| line.contains("  ") && !line.starts_with(' '))
        .count();
    assert!(
        50 < entries && terms == entries,
        "{terms} of {entries}: {all}"
    );
    let shear = out(&["help", "edge"]);
    assert!(
        shear.contains("a gate, which refuses where ") && shear.contains("moller-trumbore"),
        "{shear}"
    );
    // The head of a column has the line of its longest part.
    assert_eq!(
        out(&["help", "past a wall at 0.01"]),
        out(&["help", "past a wall"])
    );
    let output = hairline(&["help", "foo"]);
    assert!(text(&output.stderr).contains("unknown word 'foo'; see `hairline help words`"));
    let output = hairline(&["help", "epslion"]);
    assert_eq!(code(&output), 2);
    assert!(text(&output.stderr).contains("unknown word 'epslion'; did you mean 'epsilon'?"));
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = out(&["completions", shell]);
        assert!(
            script.contains("--kernel") && script.contains("prove"),
            "{shell}"
        );
    }
    assert!(out(&["man"]).starts_with(".ie"), "roff");
    assert!(out(&["man", "offset"]).contains("\\-\\-scheme"));
    assert_eq!(
        out(&["spawn", "--help"]),
        out(&["offset", "--help"]),
        "its old name"
    );
    let output = hairline(&["man", "ofset"]);
    assert_eq!(code(&output), 2);
    assert!(
        text(&output.stderr).contains("did you mean 'offset'?"),
        "{}",
        text(&output.stderr)
    );
}

#[test]
fn a_refused_command_line_says_what_to_type() {
    let folder = program::scratch("misuse");
    fs::write(folder.join("mine.cpp"), "int mine;\n").unwrap();
    fs::write(folder.join("mine.py"), "pass\n").unwrap();
    for (arguments, expected) in [
        (
            &["epsilon", "room"][..],
            "hairline: 'room' stands behind a flag: --scene room",
        ),
        (
            &["audit", "cramer"],
            "hairline: 'cramer' stands behind a flag: --kernel cramer",
        ),
        (
            &["epsilon", "a.OBJ"],
            "hairline: 'a.OBJ' stands behind a flag: --mesh a.OBJ",
        ),
        (&["list"], "hairline: WHAT is one of kernels, families, "),
        (
            &["boxes", "list"],
            "hairline: WHAT is one of tests, families, ",
        ),
        (
            &["repair", "--kernel-lib", "mine.so"],
            "hairline: repair changes the source of kernels that hairline knows, ",
        ),
        (
            &["audit", "--scene", "extent=1000 edge=0.1..2"],
            "hairline: --scene: extent=1000 edge=0.1..2: '1000 edge=0.1..2' is not a finite number: a comma ",
        ),
        (
            &["audit", "--family", "edge"],
            "hairline: unknown family 'edge'; did you mean 'edge-exact', 'edge-near' or 'shared-edge'?",
        ),
        (
            &["audit", "--kernel-lib", "mine.cpp"],
            "hairline: --kernel-lib mine.cpp: this is source code, not a library; build one: c++ -O2 -shared ",
        ),
        (
            &["audit", "--kernel-lib", "mine.py"],
            "hairline: --kernel-lib mine.py: this is no library; a program answers over its pipes ",
        ),
        (
            &["audit", "-k", "scalar-triple", "--epsilon", "parallel=1"],
            "hairline: no selected kernel has a gate 'parallel'; there are: edge",
        ),
    ] {
        let (_, error) = program::ends(&folder, arguments, 2);
        assert!(
            error.lines().any(|line| line.starts_with(expected)),
            "{arguments:?}: {error}"
        );
    }
    // A command without the flag does not name it, and no word is an order to the terminal.
    let (_, error) = program::ends(&folder, &["boxes", "audit", "room"], 2);
    assert!(!error.contains("stands behind"), "{error}");
    let (_, error) = program::ends(&folder, &["audit", "\u{1b}[31m.obj"], 2);
    assert!(!error.contains('\u{1b}'), "{error:?}");
}
