//! Causes of wrong answers as `hairline explain` names them. What they are is tested in tests/library.

#[test]
fn the_examples_of_the_documentation_replay() {
    let text = std::fs::read_to_string("docs/guide/attribution.md").unwrap();
    let mut lines = text.lines();
    let mut causes = Vec::new();
    while let Some(line) = lines.next() {
        let Some(command) = line.strip_prefix("$ hairline explain '") else {
            continue;
        };
        let (case, flags) = command.split_once("' ").unwrap();
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_hairline"))
            .args(["explain", case])
            .args(flags.split(' '))
            .output()
            .unwrap();
        let told = String::from_utf8(output.stdout).unwrap();
        let expected = lines.next().unwrap();
        assert!(told.contains(expected), "{line}\n{told}");
        causes.push(expected.rsplit(' ').next().unwrap().to_owned());
    }
    let all = ["convention", "epsilon", "rounding", "range"];
    assert_eq!(causes, all, "one example each");
}
