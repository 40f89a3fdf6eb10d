//! Tests of hairline.toml.

use super::*;

#[test]
fn the_higher_layer_wins_and_epsilons_are_one_subject() {
    let file = from_file(
        "count = 1_000\nseed = 2\nepsilon = \"edge=0\"\nscalar = \"f32\"\n",
        "c/h.toml",
    )
    .unwrap();
    let environment = |name: &str| match name {
        "HAIRLINE_SEED" => Some("3".to_owned()),
        "HAIRLINE_EPSILON_PRESET" => Some("bvh".to_owned()),
        "HAIRLINE_FAMILY" => Some(String::new()),
        _ => None,
    };
    let environment = from_environment(environment).unwrap();
    let taken = layered([environment, file], |key| key == "count").unwrap();
    let words: Vec<&str> = taken
        .iter()
        .flat_map(|g| &g.words)
        .map(String::as_str)
        .collect();
    assert_eq!(words, ["--epsilon-preset=bvh", "--seed=3", "--scalar=f32"]);
    assert_eq!(taken[2].place, "c/h.toml:4");
}

#[test]
fn paths_are_from_the_files_folder() {
    let given = from_file("mesh = [\"a.obj\", \"/b.obj\"]\n", "c/h.toml").unwrap();
    assert_eq!(given[0].words, ["--mesh=c/a.obj", "--mesh=/b.obj"]);
}

#[test]
fn a_command_is_one_word_whatever_is_in_it() {
    let text = "kernel-cmd = [\"node k.mjs --fast\", \"sh -c 'a, b'\"]\nrequire-ieee = true\n";
    let given = from_file(text, "c/h.toml").unwrap();
    let words: Vec<&str> = given
        .iter()
        .flat_map(|g| &g.words)
        .map(String::as_str)
        .collect();
    let commands = [
        "--kernel-cmd=node k.mjs --fast",
        "--kernel-cmd=sh -c 'a, b'",
    ];
    assert_eq!(words, [&commands[..], &["--require-ieee"]].concat());
}

#[test]
fn variables_that_are_no_settings_are_named() {
    let names = [
        "HAIRLINE_CUONT",
        "HAIRLINE_COUNT",
        "PATH",
        "HAIRLINE_",
        "HAIRLINE_CARGO",
        "HAIRLINE_BLESS",
    ];
    let notes = unknown_variables(names.into_iter().map(str::to_owned));
    assert_eq!(notes.len(), 4);
    assert!(
        notes[1].ends_with("; in `check` it is the flag --bless"),
        "{notes:?}"
    );
    assert!(
        notes[2].ends_with("HAIRLINE_CARGO is no setting, and is not used"),
        "{notes:?}"
    );
    let expected =
        "note: HAIRLINE_CUONT is no setting, and is not used; did you mean HAIRLINE_COUNT?";
    assert_eq!(notes[3], expected);
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    for (text, expected) in [
        (
            "\nkernal = \"x\"",
            "h.toml:2: unknown setting 'kernal'; did you mean 'kernel'?",
        ),
        (
            "zzzzzzzzzzz = 1",
            "h.toml:1: unknown setting 'zzzzzzzzzzz'; there are kernel, ",
        ),
        (
            "count = [1]",
            "h.toml:1: count: expected a string or a number",
        ),
        (
            "kernel = [true]",
            "h.toml:1: kernel: expected a string or a list of strings",
        ),
        ("family = []", "h.toml:1: family: the list is empty"),
        (
            "exhaustive = 1",
            "h.toml:1: exhaustive: expected true or false",
        ),
        ("seed = 1\nseed = 2", "h.toml:2: duplicate key"),
        ("seed = ", "h.toml:1: "),
    ] {
        let failure = from_file(text, "h.toml").unwrap_err();
        let message = failure.message().unwrap();
        assert!(message.starts_with(expected), "{message}");
        assert_eq!(failure.status(), crate::cli::exit::Status::Usage);
    }
}
