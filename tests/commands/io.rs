//! What is read and written: bad files, names in a corpus, outputs that no failure destroys.

#![cfg(unix)]

use crate::program;

use program::{ends, hairline, scratch};
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{BufRead, BufReader, Read};
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{PermissionsExt, symlink};
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::{Duration, Instant};

const PROGRAM: &str = env!("CARGO_BIN_EXE_hairline");

/// A case on which every closed two-sided test hits.
const NUMBERS: &str =
    r#""origin":[1,1,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]"#;

fn case(name: &str, scalar: &str) -> String {
    let name = serde_json::Value::from(name);
    format!("{{\"name\":{name},\"scalar\":\"{scalar}\",{NUMBERS}}}\n")
}

fn unnamed() -> String {
    format!("{{\"scalar\":\"f32\",{NUMBERS}}}\n")
}

/// Runs a line in a shell, in which `hairline` is the program.
pub fn shell(folder: &Path, line: &str) -> (i32, String, String) {
    let line = format!("hairline() {{ '{PROGRAM}' \"$@\"; }}\n{line}");
    let output = Command::new("sh")
        .args(["-c", &line])
        .current_dir(folder)
        .env_remove("GITHUB_ACTIONS")
        .env_remove("GITHUB_STEP_SUMMARY")
        .output()
        .unwrap();
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    (
        output.status.code().unwrap(),
        text(&output.stdout),
        text(&output.stderr),
    )
}

/// Runs in a folder with a file as standard input. Whoever still runs after half a minute is killed.
pub fn in_time(folder: &Path, arguments: &[&str], input: &Path) -> Output {
    let mut child = Command::new(PROGRAM)
        .args(arguments)
        .current_dir(folder)
        .stdin(File::open(input).unwrap())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        if start.elapsed() > Duration::from_secs(30) {
            child.kill().unwrap();
            panic!("{arguments:?} does not end");
        }
        thread::sleep(Duration::from_millis(10));
    }
    child.wait_with_output().unwrap()
}

#[test]
fn a_line_that_is_too_long_is_refused_at_once_whatever_it_holds() {
    let folder = scratch("io-long");
    let blanks = " ".repeat(2 << 20);
    for (name, text, line) in [
        (
            "blanks",
            format!("{}{blanks}{}", case("x", "f32"), case("y", "f32")),
            2,
        ),
        ("only", format!("\n\n{blanks}\n{}", case("y", "f32")), 3),
    ] {
        let file = format!("{name}.jsonl");
        fs::write(folder.join(&file), text).unwrap();
        for command in [&["truth", &file][..], &["audit", "--corpus", &file]] {
            let (_, error) = ends(&folder, command, 65);
            let message = format!("{file}:{line}: a line of more than 1048576 bytes");
            assert!(error.contains(&message), "{error}");
        }
    }
    // An input without an end.
    let output = in_time(Path::new("."), &["truth", "-"], Path::new("/dev/zero"));
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(65), "{error}");
    assert!(
        error.starts_with("hairline: -:1: a line of more than "),
        "{error}"
    );
}

#[test]
fn two_cases_of_a_file_cannot_have_one_name() {
    let folder = scratch("io-twice");
    let (x, same) = (case("x", "f32"), case("x", "f64"));
    for (text, message) in [
        (
            format!("{x}{x}"),
            "a.jsonl:2: a second case called 'x', as that of line 1 is: ",
        ),
        (
            format!("{x}\n{same}"),
            "a.jsonl:3: a second case called 'x', as that of line 1 is: ",
        ),
        (
            format!("{}\n{}", case("line-3", "f32"), unnamed()),
            "a.jsonl:3: a second case called 'line-3', as that of line 1 is (a case without a name",
        ),
        (
            format!("{}{}", unnamed(), case("line-1", "f64")),
            "a.jsonl:2: a second case called",
        ),
    ] {
        fs::write(folder.join("a.jsonl"), text).unwrap();
        for command in [
            &["audit", "--corpus", "a.jsonl"][..],
            &["explain", "x", "--corpus", "a.jsonl"],
            &["corpus", "verify", "a.jsonl"],
        ] {
            let (_, error) = ends(&folder, command, 65);
            assert!(error.contains(message), "{error}");
        }
        // Truths are printed line by line, and name no command.
        ends(&folder, &["truth", "a.jsonl"], 0);
    }
    // In a folder the files tell two cases of a name apart, and a name alone does not.
    fs::write(folder.join("a.jsonl"), &x).unwrap();
    fs::write(folder.join("b.jsonl"), format!("{}{same}", unnamed())).unwrap();
    ends(&folder, &["audit", "--corpus", ".", "--quiet"], 0);
    let (_, error) = ends(&folder, &["explain", "x", "--corpus", "."], 2);
    let message = "2 cases are called 'x': ./a.jsonl:1, ./b.jsonl:2; name the file with --corpus";
    assert!(error.contains(message), "{error}");
    let (_, error) = ends(
        &folder,
        &["audit", "--corpus", ".", "--corpus", "a.jsonl"],
        2,
    );
    assert!(
        error.contains("--corpus: 'a.jsonl' is given twice"),
        "{error}"
    );
}

#[test]
fn a_name_that_no_command_could_repeat_is_refused() {
    let folder = scratch("io-names");
    for (name, message) in [
        ("", "'' cannot name a case: it is empty"),
        (
            "-x",
            "'-x' cannot name a case: it begins with '-', as a flag does",
        ),
        (
            "{x",
            "'{x' cannot name a case: it begins with '{', as a case that is written as JSON",
        ),
        (
            "a\nb",
            "'a\\nb' cannot name a case: it has a character that a terminal obeys",
        ),
        (
            "a\0",
            "cannot name a case: it has a character that a terminal obeys",
        ),
        (
            "x".repeat(1001).as_str(),
            "cannot name a case: it has more than 1000 bytes",
        ),
    ] {
        fs::write(folder.join("a.jsonl"), unnamed() + &case(name, "f32")).unwrap();
        let (_, error) = ends(&folder, &["audit", "--corpus", "a.jsonl"], 65);
        assert!(error.contains("hairline: a.jsonl:2: name: '"), "{error}");
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn the_printed_command_shows_the_very_case() {
    let folder = scratch("io-replay");
    let names = [
        "a b",
        "it's",
        " x",
        "x=1,y",
        "orient2d:near@1/f64/1/17",
        "$HOME",
        "é|`'\"",
        "#",
    ];
    // Each with a wrong truth of its own to tell: the ray starts at another height.
    let lines = names
        .iter()
        .enumerate()
        .map(|(i, name)| case(name, "f32").replacen("[1,1,1]", &format!("[1,1,{}]", i + 2), 1));
    fs::write(folder.join("-a b.jsonl"), lines.collect::<String>()).unwrap();
    let never = [
        "--kernel",
        "moller-trumbore",
        "--epsilon",
        "parallel=1e9",
        "--scalar",
        "f32",
    ];
    let plan = [
        &[
            "audit",
            "--corpus=-a b.jsonl",
            "--examples",
            "99",
            "--quiet",
        ],
        &never[..],
    ];
    let (json, _) = ends(
        &folder,
        &[&plan.concat()[..], &["--format", "json"]].concat(),
        0,
    );
    let record: serde_json::Value = serde_json::from_str(&json).unwrap();
    let finding = &record["result"]["results"][0]["findings"][0];
    let first = finding["first"].as_array().unwrap();
    assert_eq!(first.len(), names.len(), "{finding}");
    for (i, example) in first.iter().enumerate() {
        assert_eq!(example["case"], names[i]);
        let command = example["command"].as_str().unwrap();
        let (code, out, error) = shell(&folder, command);
        assert_eq!(code, 0, "{command}: {error}");
        let height = format!("; t = {}, ", i + 2);
        assert!(
            out.contains(&height) && out.contains("FALSE-MISS"),
            "{command}: {out}"
        );
        let map = command.replacen("explain", "map --drawing --format text", 1);
        assert_eq!(shell(&folder, &map).0, 0, "{map}");
    }
}

#[test]
fn a_name_breaks_no_column() {
    let folder = scratch("io-columns");
    let long = format!("{}.jsonl", "long".repeat(20));
    for file in ["a\tb\nc.jsonl", long.as_str()] {
        fs::write(folder.join(file), case("x", "f32")).unwrap();
        let plan = [
            "audit",
            "--corpus",
            file,
            "--kernel",
            "moller-trumbore",
            "--scalar",
            "f32",
        ];
        let (table, _) = ends(
            &folder,
            &[&plan[..], &["--epsilon", "parallel=1e9", "--details"]].concat(),
            0,
        );
        let lines: Vec<&str> = table.lines().collect();
        let head = lines
            .iter()
            .position(|line| line.starts_with("family "))
            .unwrap();
        // A long label stands on a line of its own.
        let row = lines[head + 1..]
            .iter()
            .find(|line| line.contains(" of "))
            .unwrap();
        assert_eq!(row.chars().count(), lines[head].chars().count(), "{table}");
        assert!(!row.contains('\t'), "{table}");
    }
}

#[test]
fn links_lead_to_no_case_twice() {
    let folder = scratch("io-links");
    fs::create_dir_all(folder.join("c/sub")).unwrap();
    fs::write(folder.join("c/sub/a.jsonl"), case("x", "f32")).unwrap();
    symlink(".", folder.join("c/loop")).unwrap();
    symlink("..", folder.join("c/sub/up")).unwrap();
    symlink("sub", folder.join("c/alias")).unwrap();
    symlink("sub/a.jsonl", folder.join("c/0.jsonl")).unwrap();
    let plan = [
        "audit", "--corpus", "c", "--kernel", "cramer", "--format", "json", "--quiet",
    ];
    let (json, _) = ends(&folder, &plan, 0);
    let record: serde_json::Value = serde_json::from_str(&json).unwrap();
    let sources = record["result"]["plan"]["sources"].as_array().unwrap();
    assert_eq!(sources.len(), 1, "{sources:?}");
    assert_eq!(sources[0]["family"], "corpus:c/sub/a.jsonl");
    // Nor does triage go round and round.
    let plan = [
        "fuzz",
        "triage",
        "c",
        "-o",
        "found",
        "--kernel",
        "moller-trumbore",
    ];
    let (out, _) = ends(
        &folder,
        &[&plan[..], &["--epsilon", "parallel=1e9"]].concat(),
        0,
    );
    assert!(out.starts_with("1 findings read; "), "{out}");
    // A link that leads nowhere is a file that cannot be read.
    symlink("nowhere", folder.join("c/b.jsonl")).unwrap();
    let (_, error) = ends(&folder, &["audit", "--corpus", "c"], 74);
    assert!(error.contains("c/b.jsonl: "), "{error}");
}

#[test]
fn what_cannot_be_read_ends_with_74_and_what_is_wrong_with_65() {
    let folder = scratch("io-unread");
    for arguments in [
        &["truth", "-"][..],
        &["mesh", "-"],
        &["audit", "--corpus", "-"],
        &["audit", "--mesh", "-"],
        &["explain", "x", "--corpus", "-"],
        &["corpus", "verify", "-"],
        &["fuzz", "worst", "--list", "--table", "-"],
        &["diff", "-", "-"],
        &["check", "--record", "-"],
    ] {
        let output = in_time(&folder, arguments, &folder);
        let error = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(74), "{arguments:?}: {error}");
        assert!(
            error.contains("hairline: -") && error.contains("directory"),
            "{error}"
        );
    }
    // A mesh that the manifest names and that is not there.
    fs::create_dir(folder.join("made")).unwrap();
    let mesh = r#"{"mesh":"torus.obj","about":"a torus","digest":"5c"}"#;
    fs::write(folder.join("made/manifest.jsonl"), mesh).unwrap();
    fs::write(folder.join("made/a.jsonl"), case("x", "f32")).unwrap();
    let (_, error) = ends(&folder, &["corpus", "verify", "made"], 74);
    assert!(error.contains("made/meshes/torus.obj: "), "{error}");
    for (bytes, message) in [
        (&b"\xff\xfe{\0"[..], "a.jsonl:1: not UTF-8 at byte 1"),
        (b"\0\0\0", "a.jsonl:1: expected an object"),
        (b"\xef\xbb\xbf{}", "a.jsonl:1: missing field 'scalar'"),
    ] {
        fs::write(folder.join("a.jsonl"), bytes).unwrap();
        let (_, error) = ends(&folder, &["truth", "a.jsonl"], 65);
        assert!(error.contains(message), "{error}");
    }
    let windows = format!("\r\n{}\r\n\r\n", case("x", "f32").trim());
    fs::write(folder.join("a.jsonl"), windows).unwrap();
    ends(&folder, &["truth", "a.jsonl"], 0);
    fs::write(folder.join("manifest.jsonl"), b"\xff\n").unwrap();
    ends(&folder, &["corpus", "verify", "."], 65);
}

/// What a folder holds, with the bytes of its files.
fn contents(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let read = |entry: fs::DirEntry| {
        let name = entry.file_name().into_string().unwrap();
        (name, fs::read(entry.path()).unwrap_or_default())
    };
    let mut contents: Vec<_> = entries.map(read).collect();
    contents.sort();
    contents
}

#[test]
fn no_failure_touches_an_output() {
    let folder = scratch("io-outputs");
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write("old", "what was there");
    write("empty.jsonl", "");
    write("half.jsonl", &(case("x", "f32") + "{"));
    write("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let audit = |family: &str, file: &str| {
        let plan = ["audit", "-n", "9", "--kernel", "cramer", "--family", family];
        ends(
            &folder,
            &[&plan[..], &["--format", "json", "-o", file]].concat(),
            0,
        );
    };
    audit("tiny", "tiny.json");
    audit("far", "far.json");
    write("finds.jsonl", "not json");
    let before = contents(&folder);
    let quick = ["audit", "-n", "9", "--kernel", "cramer", "--family", "tiny"];
    for (arguments, code) in [
        (&["truth", "/dev/null", "-o", "old"][..], 4),
        (&["truth", "empty.jsonl", "-o", "old"], 4),
        (&["truth", "half.jsonl", "-o", "old"], 65),
        (&["mesh", "open.obj", "--quiet", "-o", "old"], 4),
        (&["diff", "tiny.json", "far.json", "-o", "old"], 4),
        (
            &[
                "corpus", "generate", "--family", "tiny", "--scalar", "f16", "-o", "old",
            ],
            2,
        ),
        (
            &[
                &quick[..],
                &["--format", "text,json", "-o", "old", "-o", "no/where"],
            ]
            .concat(),
            74,
        ),
        (
            &[
                &quick[..],
                &["--format", "text,json", "-o", "old", "-o", "/dev/full"],
            ]
            .concat(),
            74,
        ),
        (
            &[
                "map", "--kernel", "cramer", "--size", "4", "-o", "old", "-o", "new.svg",
            ],
            2,
        ),
        (
            &[
                "map", "--kernel", "cramer", "--size", "4", "--format", "text,svg", "-o", "old",
                "-o", "no/where",
            ],
            74,
        ),
        (
            &[
                "fuzz",
                "worst",
                "--update",
                "finds.jsonl",
                "--kernel",
                "cramer",
                "-n",
                "9",
            ],
            65,
        ),
        (&["fuzz", "triage", "half.jsonl", "-o", "."], 65),
        (&[&quick[..], &["-o", "."]].concat(), 74),
        // What cannot be written is refused before a kernel starts.
        (
            &[
                &quick[..],
                &["--kernel-cmd", "sh -c 'touch ran'", "-o", "no/where"],
            ]
            .concat(),
            74,
        ),
    ] {
        // /dev/full is Linux's.
        if !cfg!(target_os = "linux") && arguments.contains(&"/dev/full") {
            continue;
        }
        ends(&folder, arguments, code);
        assert!(contents(&folder) == before, "{arguments:?}");
    }
}

/// A kernel that misses all, and breaks the protocol at the case of a number.
fn never(cases: u64) -> String {
    format!(
        "sh -c 'printf \"hairline-kernel 1\\nname never\\nscalars f32\\ncontract closed-ray\\nready\\n\"; \
         n=0; while read -r a b c; do case $a in \
         case) n=$((n+1)); if [ $n -gt {cases} ]; then echo nonsense; else echo \"$b miss\"; fi;; \
         end) echo \"end $b\";; esac; done'"
    )
}

#[test]
fn what_a_kernel_spoilt_that_is_given_up_replaces_nothing() {
    let folder = scratch("io-given-up");
    fs::write(folder.join("old.svg"), "old").unwrap();
    let kernel = never(5);
    let plan = [
        "map",
        "--kernel-cmd",
        &kernel,
        "--size",
        "8",
        "-o",
        "old.svg",
    ];
    let (_, error) = ends(&folder, &plan, 65);
    assert!(error.contains("kernel 'never'"), "{error}");
    assert_eq!(fs::read_to_string(folder.join("old.svg")).unwrap(), "old");
    assert_eq!(contents(&folder).len(), 1);
}

#[test]
fn the_rust_snippet_is_of_built_in_kernels() {
    let given = unnamed().replace(char::is_whitespace, "");
    let shrink = |flags: &[&str]| {
        ends(
            Path::new("."),
            &[&["fuzz", "shrink", &given], flags].concat(),
            0,
        )
        .0
    };
    let fails = ["--epsilon", "parallel=1e9", "--kernel"];
    for kernel in ["moller-trumbore", "moller-trumbore+fma"] {
        let text = shrink(&[&fails[..], &[kernel]].concat());
        assert!(text.contains(&format!("find(\"{kernel}\")")), "{text}");
    }
    let text = shrink(&["--kernel-cmd", &never(9_999_999)]);
    assert!(
        text.contains("JSON, a line") && text.contains("\nC\n"),
        "{text}"
    );
    assert!(!text.contains("Rust") && !text.contains("find("), "{text}");
}

#[test]
fn a_missing_newline_loses_no_find() {
    let folder = scratch("io-newline");
    fs::write(folder.join("a.jsonl"), case("x", "f32")).unwrap();
    let plan = [
        "fuzz",
        "triage",
        "a.jsonl",
        "-o",
        "found",
        "--kernel",
        "moller-trumbore",
        "--epsilon",
    ];
    ends(&folder, &[&plan[..], &["parallel=1e9"]].concat(), 0);
    let file = folder.join("found/moller-trumbore.jsonl");
    let whole = fs::read_to_string(&file).unwrap();
    fs::write(&file, whole.trim_end()).unwrap();
    let other = format!("{{\"scalar\":\"f64\",{NUMBERS}}}\n");
    fs::write(folder.join("a.jsonl"), other).unwrap();
    ends(&folder, &[&plan[..], &["parallel=1e9"]].concat(), 0);
    let found = fs::read_to_string(&file).unwrap();
    assert!(
        found.contains(whole.trim_end()) && found.lines().count() == 2,
        "{found}"
    );
}

#[test]
fn a_file_is_replaced_where_it_is_and_as_it_is() {
    let folder = scratch("io-place");
    fs::create_dir(folder.join("far")).unwrap();
    fs::write(folder.join("far/real"), "old").unwrap();
    fs::set_permissions(folder.join("far/real"), fs::Permissions::from_mode(0o640)).unwrap();
    symlink("far/real", folder.join("link")).unwrap();
    symlink("far/new", folder.join("hanging")).unwrap();
    let long = "x".repeat(250);
    for (output, file) in [
        ("link", "far/real"),
        ("hanging", "far/new"),
        (long.as_str(), long.as_str()),
    ] {
        let plan = [
            "corpus", "generate", "--family", "tiny", "-n", "3", "-o", output,
        ];
        ends(&folder, &plan, 0);
        assert_eq!(
            fs::read_to_string(folder.join(file))
                .unwrap()
                .lines()
                .count(),
            3
        );
    }
    assert!(folder.join("link").is_symlink() && folder.join("hanging").is_symlink());
    let mode = fs::metadata(folder.join("far/real"))
        .unwrap()
        .permissions()
        .mode();
    assert_eq!(mode & 0o777, 0o640);
    // What may not be written may not be replaced; root may write all.
    let locked = folder.join("far/real");
    fs::set_permissions(&locked, fs::Permissions::from_mode(0o440)).unwrap();
    if File::options().write(true).open(&locked).is_err() {
        let plan = [
            "corpus", "generate", "--family", "tiny", "-n", "4", "-o", "link",
        ];
        ends(&folder, &plan, 74);
        assert_eq!(fs::read_to_string(&locked).unwrap().lines().count(), 3);
    }
    assert_eq!(
        contents(&folder.join("far")).len(),
        2,
        "nothing is left beside them"
    );
}

#[test]
fn a_result_goes_to_a_pipe_or_an_open_file_too() {
    let folder = scratch("io-streams");
    // As /dev/stdout is one, which a mistake must not replace on the machine of who runs this.
    symlink("/dev/fd/1", folder.join("stdout")).unwrap();
    let make = "hairline corpus generate --family tiny -n 3 -o";
    for line in [
        format!("{{ echo first; {make} stdout; echo last; }} > f; cat f"),
        format!("echo first > f; {{ {make} stdout; echo last; }} >> f; cat f"),
        format!("{{ echo first; {make} stdout; echo last; }} | cat"),
        format!("{{ echo first; {make} /dev/fd/3 3>&1; echo last; }} | cat"),
        format!("echo first; mkfifo p; cat p & {make} p; wait; echo last"),
        format!("echo first > f; {make} /dev/fd/3 3>> f; cat f; echo last"),
    ] {
        let _ = fs::remove_file(folder.join("f"));
        let (code, out, error) = shell(&folder, &line);
        let lines: Vec<&str> = out.lines().collect();
        assert_eq!((code, lines.len()), (0, 5), "{line}: {out}{error}");
        assert_eq!((lines[0], lines[4]), ("first", "last"), "{line}: {out}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn closed_streams_are_errors_and_readers_who_leave_are_not() {
    let folder = scratch("io-closed");
    fs::write(folder.join("a.jsonl"), case("x", "f32")).unwrap();
    for line in [
        "truth a.jsonl",
        "list kernels",
        "check config",
        "check schema",
        "help ulp",
        "man",
        "completions bash",
        "--help",
        "--version",
        "explain x --corpus a.jsonl",
        "truth a.jsonl -o /dev/fd/1",
    ] {
        for redirection in [">&-", "1</dev/null"] {
            let (code, _, error) = shell(&folder, &format!("hairline {line} {redirection}"));
            assert_eq!(code, 74, "{line} {redirection}: {error}");
            assert!(
                error.contains("hairline: standard output: closed, or not open"),
                "{error}"
            );
        }
        assert_eq!(shell(&folder, &format!("hairline {line} >/dev/null")).0, 0);
    }
    assert_eq!(
        shell(&folder, "hairline truth a.jsonl -o b >&-; exit $?").0,
        0
    );
    let (code, _, error) = shell(&folder, "hairline truth - <&-");
    assert_eq!(code, 74, "{error}");
    // Nobody reads the messages.
    let audit = "hairline audit -n 9 --kernel cramer --family tiny";
    for redirection in ["2>/dev/full", "2>&-"] {
        let (code, out, _) = shell(&folder, &format!("{audit} {redirection}"));
        assert_eq!((code, out.is_empty()), (0, false), "{redirection}");
    }
    // Who leaves a pipe takes neither the exit code nor another output along.
    let (code, ..) = shell(
        &folder,
        "mkfifo p; : < p & \
         hairline check --config /dev/null --kernel moller-trumbore --family tiny -n 20000 --details \
         --format markdown,json -o p -o whole.json --quiet",
    );
    assert_eq!(code, 1);
    let mut whole = String::new();
    File::open(folder.join("whole.json"))
        .unwrap()
        .read_to_string(&mut whole)
        .unwrap();
    assert!(whole.ends_with("}\n"), "the other output is whole");
}

#[test]
fn a_thousand_files_are_read_one_after_the_other() {
    let folder = scratch("io-many");
    for i in 0..1500 {
        fs::write(folder.join(format!("{i}.jsonl")), case("x", "f32")).unwrap();
    }
    let line = "ulimit -n 64; hairline audit --corpus . --kernel cramer --scalar f32 --quiet";
    let (code, out, error) = shell(&folder, line);
    assert_eq!(code, 0, "{error}");
    assert!(out.contains("1,500 sources of cases"), "{out}");
    assert_eq!(
        hairline(&folder, &["explain", "x", "--corpus", "."])
            .status
            .code(),
        Some(2)
    );
}

#[test]
fn one_place_is_not_written_twice_and_one_name_is_not_two_meshes() {
    let folder = scratch("io-twice");
    let twice = [
        "audit",
        "-n",
        "1",
        "--format",
        "json,markdown",
        "-o",
        "a",
        "-o",
        "./a",
    ];
    let (_, error) = ends(&folder, &twice, 2);
    assert!(error.contains("'./a' is given twice"), "{error}");
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("a", folder.join("link")).unwrap();
        for [one, other] in [["a", "link"], ["-", "/dev/stdout"]] {
            let twice = [
                "audit",
                "-n",
                "1",
                "--format",
                "json,markdown",
                "-o",
                one,
                "-o",
                other,
            ];
            let (_, error) = ends(&folder, &twice, 2);
            assert!(
                error.contains(&format!("'{other}' is given twice")),
                "{error}"
            );
        }
    }
    assert!(!folder.join("a").exists());
    for part in ["d1", "d2"] {
        fs::create_dir(folder.join(part)).unwrap();
        fs::write(
            folder.join(part).join("m.obj"),
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        )
        .unwrap();
    }
    let meshes = [
        "audit", "--mesh", "d1/m.obj", "--mesh", "d2/m.obj", "-n", "5",
    ];
    let (_, error) = ends(&folder, &meshes, 2);
    assert!(
        error.contains("two files of the name of 'd2/m.obj'"),
        "{error}"
    );
}

#[test]
fn a_path_that_is_not_utf_8_is_named_with_what_to_do() {
    let folder = scratch("io-not-utf-8");
    fs::write(
        folder.join(OsStr::from_bytes(b"a\xff.obj")),
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    )
    .unwrap();
    let path = "$(printf 'a\\377.obj')";
    for command in ["mesh", "audit --mesh", "truth", "epsilon -k plucker --mesh"] {
        let (code, out, error) = shell(&folder, &format!("hairline {command} \"{path}\""));
        assert_eq!((code, out.as_str()), (2, ""), "{error}");
        let expected =
            "hairline: 'a\u{fffd}.obj' is not UTF-8: rename the file, or hand it in as - < FILE\n";
        assert_eq!(error, expected);
    }
    let (code, ..) = shell(
        &folder,
        &format!("hairline audit -q -n 10 --mesh - -k plucker < \"{path}\""),
    );
    assert_eq!(code, 0);
    // In a folder it is found by the way.
    fs::write(folder.join(OsStr::from_bytes(b"a\xff.jsonl")), unnamed()).unwrap();
    let (code, _, error) = shell(&folder, "hairline audit --corpus . -k plucker");
    assert_eq!(
        (code, error.as_str()),
        (65, "hairline: ./a\u{fffd}.jsonl: its name is not UTF-8\n")
    );
}

#[test]
fn what_a_killed_run_left_is_removed_by_the_next_that_writes_there() {
    let folder = scratch("io-abandoned");
    let left = folder.join(".hairline-1-0.tmp");
    let others = folder.join("1-0.tmp");
    for path in [&left, &others] {
        fs::write(path, "a part").unwrap();
    }
    let audit = [
        "audit", "-q", "--family", "interior", "-n", "10", "--format", "json", "-o", "a.json",
    ];
    // Whoever writes holds its lock.
    let held = File::open(&left).unwrap();
    held.lock().unwrap();
    ends(&folder, &audit, 0);
    assert!(left.exists());
    drop(held);
    ends(&folder, &audit, 0);
    assert!(!left.exists() && others.exists());
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2);
}

#[test]
fn a_long_run_says_how_long_it_takes_when_its_pace_is_steady() {
    let long = |flag: &str| {
        let mut command = Command::new(PROGRAM);
        command.args(["audit", "--family", "interior", "-n", "4294967296", flag]);
        command.stderr(Stdio::piped()).spawn().unwrap()
    };
    let mut told = long("--illustrate=never");
    let lines = BufReader::new(told.stderr.take().unwrap()).lines();
    let is_told =
        |line: &String| line.contains("rays take about ") && line.contains(" at the pace so far");
    assert!(lines.map(Result::unwrap).any(|line| is_told(&line)));
    told.kill().unwrap();
    told.wait().unwrap();
    let mut quiet = long("-q");
    std::thread::sleep(Duration::from_secs(3));
    quiet.kill().unwrap();
    assert!(quiet.wait_with_output().unwrap().stderr.is_empty());
}
