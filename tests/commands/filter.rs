//! `generate … | kernel | judge`: every case answered exactly once, and nothing else taken for it.

use std::io::Write;
use std::process::{Command, Output, Stdio};

fn hairline(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A program that stops at a bad line does not read on.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn generated(arguments: &[&str]) -> String {
    let output = hairline(&[&["generate"][..], arguments].concat(), "");
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

/// What a kernel that says the same of every case writes.
fn answers(cases: &str, verdict: &str) -> String {
    let answer = |line: &str| match line.split(' ').collect::<Vec<_>>()[..] {
        ["case", id, ..] => format!("{id} {verdict}\n"),
        _ => format!("{line}\n"),
    };
    cases.lines().map(answer).collect()
}

fn judged(contract: &str, answers: &str) -> (i32, String, String) {
    let output = hairline(&["judge", "--details", "--contract", contract], answers);
    (output.status.code().unwrap(), text(&output.stdout), text(&output.stderr))
}

const FLAGS: [&str; 4] = ["--family", "interior,outside,fan", "-n", "1500"];

#[test]
fn right_answers_are_0_and_wrong_ones_1_with_the_tables_of_an_audit() {
    let interior = generated(&["--family", "interior", "-n", "1500"]);
    assert_eq!(interior.lines().count(), 3001);
    assert_eq!(interior.lines().last(), Some("end 3000"));
    let (code, table, error) = judged("closed-ray", &answers(&interior, "hit t=1"));
    assert_eq!((code, error.as_str()), (0, ""), "{table}");
    assert!(table.contains("f64, 1,500 cases for each kernel"), "{table}");
    // Who says that t is given has its errors measured.
    let f32 = generated(&["--family", "interior", "-n", "50", "--scalar", "f32"]);
    let hello = "hairline-kernel 1\nname mine\nscalars f32\ncontract closed-ray\ngives t\nready\n";
    let details = ["judge", "--details"];
    let output = hairline(&details, &(hello.to_owned() + &answers(&f32, "hit t=1")));
    assert!(text(&output.stdout).contains("values in ulps: t half within"), "{output:?}");
    let (code, table, _) = judged("closed-ray", &answers(&interior, "miss"));
    assert_eq!(code, 1);
    assert!(table.contains("false-miss interior/front/within"), "{table}");
    let shown = table.lines().find(|line| line.contains("hairline explain")).unwrap();
    let words: Vec<&str> =
        shown.split_whitespace().skip(1).map(|word| word.trim_matches('\'')).collect();
    let explained = text(&hairline(&words, "").stdout);
    assert!(explained.contains("truth transversal"), "{explained}");
}

#[test]
fn several_families_scalars_and_groups_go_through_in_their_order() {
    let cases = generated(&FLAGS);
    let output = hairline(
        &["judge", "--contract", "closed-ray", "--format", "json"],
        &answers(&cases, "hit"),
    );
    assert_eq!(output.status.code(), Some(1));
    let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let results = record["result"]["results"].as_array().unwrap();
    assert_eq!(results.len(), 6);
    for result in results {
        let total = &result["total"];
        assert_eq!(total["hits"], total["cases"]);
        assert_eq!(total["false_hits"]["count"], total["false_hits"]["of"]);
    }
    assert_eq!(record["result"]["plan"]["sources"].as_array().unwrap().len(), 3);
    let fan = results.iter().find(|result| result["family"] == "fan").unwrap();
    assert_eq!(fan["across"]["doubles"]["count"], fan["across"]["doubles"]["of"]);
}

#[test]
fn a_hello_states_the_contract_and_the_name() {
    let cases = generated(&["--family", "behind", "-n", "50", "--scalar", "f32"]);
    let hello = |contract: &str| {
        format!(
            "hairline-kernel 1\nname mine\nscalars f32\ncontract {contract}\nepsilon t 0 1 -1 signed\nready\n"
        )
    };
    let judge = |contract: &str, verdict: &str| {
        let output = hairline(&["judge"], &(hello(contract) + &answers(&cases, verdict)));
        (output.status.code().unwrap(), text(&output.stdout))
    };
    assert_eq!(judge("closed-ray", "miss").0, 0);
    let (code, table) = judge("closed-line", "miss");
    assert!(code == 1 && table.contains("mine (own)"), "{table}");
    // A contract on the command line goes before it.
    let output = hairline(
        &["judge", "--contract", "closed-ray"],
        &(hello("closed-line") + &answers(&cases, "miss")),
    );
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stdout));
}

#[test]
fn what_is_missing_twice_out_of_order_or_no_verdict_is_an_error_with_its_line() {
    let all = answers(&generated(&["--family", "fan", "-n", "3", "--scalar", "f32"]), "miss");
    let lines: Vec<&str> = all.lines().collect();
    let joined = |lines: &[&str]| lines.join("\n") + "\n";
    let without = |k: usize| {
        let mut fewer = lines.clone();
        fewer.remove(k);
        joined(&fewer)
    };
    let swapped = {
        let mut swapped = lines.clone();
        swapped.swap(1, 2);
        joined(&swapped)
    };
    let second_group = lines.iter().position(|line| line.starts_with("fan@2/f32/-/1/1.0")).unwrap();
    let end = lines.len() - 1;
    for (answers, message) in [
        (String::new(), "no verdicts in it"),
        (all.clone(), "-:1: there is no hello that states a contract"),
        ("end 0\n".to_owned(), "no verdicts in it"),
        (
            without(0),
            "-:1: expected the verdict on the first case of a set, found 'fan@2/f32/-/1/0.1'",
        ),
        (without(1), "-:2: expected the verdict on fan@2/f32/-/1/0.1, or "),
        (without(second_group), "expected the verdict on fan@2/f32/-/1/1.0, or "),
        (without(end - 1), "after "),
        (
            without(end - 1).replace(lines[end], &format!("end {}", end - 1)),
            "the verdict on fan@2/f32/-/1/2.",
        ),
        (without(end), "the kernel stopped after "),
        (swapped, "-:2: expected the verdict on fan@2/f32/-/1/0.1, or "),
        (format!("{0}\n{1}", lines[0], all), "-:2: expected the verdict on fan@2/f32/-/1/0.1, or "),
        (
            joined(&[&lines[..end], &lines[..]].concat()),
            "expected the verdict on fan@2/f32/-/1/3.0, or ",
        ),
        (format!("{all}more\n"), "'more' stands behind the last 'end'"),
        (all.replace("0.2 miss", "0.2 maybe"), "-:3: expected 'ID miss', "),
        (all.replace("fan@2", "fan@9"), "-:1: 'fan@9/f32/-/1/0.0' is of version 9"),
        (all.replace("fan@2", "fun@2"), "-:1: unknown family 'fun'; did you mean 'fan'?"),
        (all.replace("/f32/", "/f16/"), "-:1: unknown scalar 'f16'"),
        (all.replace("end ", "end 1"), "after "),
        ("x".repeat(70_000), "-:1: a line of more than 65536 bytes"),
    ] {
        let needs_hello = message.contains("no hello");
        let arguments: &[&str] =
            if needs_hello { &["judge"] } else { &["judge", "--contract", "closed-ray"] };
        let output = hairline(arguments, &answers);
        let error = text(&output.stderr);
        let expected = if message == "no verdicts in it" { 4 } else { 65 };
        assert_eq!(output.status.code(), Some(expected), "{message}: {error}");
        assert_eq!(text(&output.stdout), "");
        assert!(error.starts_with("hairline: ") && error.contains(message), "{message}: {error}");
    }
}

#[test]
fn only_what_an_id_makes_again_is_generated() {
    for arguments in [
        &["--corpus", "corpora/curated.jsonl"][..],
        &["--mesh", "corpora/meshes/torus.obj"],
        &["--family", "lattice", "--exhaustive"],
    ] {
        let output = hairline(&[&["generate"][..], arguments].concat(), "");
        assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
        assert!(text(&output.stderr).contains("families only"));
    }
    let scaled =
        ["--family", "tiny", "-n", "9", "--scale", "2^-3", "--offset", "1:0:0", "--seed", "5"];
    let (code, _, error) = judged("closed-ray", &answers(&generated(&scaled), "hit"));
    assert!(code < 2, "{error}");
}

#[test]
fn printed_commands_name_the_whole_contract_since_no_flag_chooses_the_kernel() {
    let cases = answers(&generated(&["--family", "interior", "-n", "20"]), "miss");
    for (contract, printed) in [
        ("closed-ray", " --contract closed-ray"),
        ("closed-ray,across=at-least-one", " --contract closed-ray,across=at-least-one"),
    ] {
        let (code, table, _) = judged(contract, &cases);
        assert_eq!(code, 1);
        let commands = table.lines().filter(|line| line.contains("hairline explain "));
        let commands: Vec<&str> = commands.collect();
        assert!(!commands.is_empty(), "{table}");
        assert!(commands.iter().all(|command| command.ends_with(printed)), "{commands:?}");
    }
}
