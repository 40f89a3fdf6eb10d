//! `hairline check` as CI runs it: exit codes, blessing, stale and unexpected disagreements, settings.

use crate::program;

use program::{ends, hairline_with, result_bytes, scratch};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const SETTINGS: &str = "kernel = [\"moller-trumbore\", \"woop-watertight\"]\nscalar = \"f32\"\n\
                        family = [\"interior\", \"tiny\", \"edge-near\"]\ncount = 1_000\n";

const FILE: &str = "hairline.expectations.toml";

/// A project with settings.
fn project(name: &str) -> PathBuf {
    let folder = scratch(name);
    fs::write(folder.join("hairline.toml"), SETTINGS).unwrap();
    folder
}

/// A project with settings and the expectations that it meets.
fn blessed(name: &str) -> PathBuf {
    let folder = project(name);
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    folder
}

fn edit(folder: &Path, change: impl Fn(&str) -> String) {
    let file = folder.join(FILE);
    let old = fs::read_to_string(&file).unwrap();
    let new = change(&old);
    assert_ne!(old, new);
    fs::write(file, new).unwrap();
}

/// The line of the file of expectations, counted from 1, that holds a text.
fn line_with(folder: &Path, text: &str) -> (usize, String) {
    let file = fs::read_to_string(folder.join(FILE)).unwrap();
    let (i, line) = file.lines().enumerate().find(|(_, line)| line.contains(text)).unwrap();
    (i + 1, line.to_owned())
}

#[test]
fn without_expectations_every_disagreement_fails_and_names_its_case_and_command() {
    let folder = project("check-none");
    let (out, _) = ends(&folder, &["check", "--quiet"], 1);
    for expected in [
        "nothing is expected: there is no file of expectations",
        "moller-trumbore (source) f32 tiny: false-miss of interior/front/within: ",
        ", expected none\n    hairline explain 'tiny@1/f32/-/1/",
        "\n    o=",
        "does not conform: ",
    ] {
        assert!(out.contains(expected), "{expected}: {out}");
    }
    assert!(!folder.join(FILE).exists());
}

#[test]
fn a_blessed_run_conforms_and_blessing_again_changes_nothing() {
    let folder = blessed("check-blessed");
    let (out, _) = ends(&folder, &["check", "--quiet"], 0);
    assert!(out.contains("\nconforms: 0 unexpected"), "{out}");
    let first = fs::read(folder.join(FILE)).unwrap();
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    assert_eq!(fs::read(folder.join(FILE)).unwrap(), first);
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 2, "nothing is left beside");
}

#[test]
fn a_removed_entry_is_an_unexpected_disagreement_by_name() {
    let folder = blessed("check-removed");
    let (_, line) = line_with(&folder, "\"tiny\", class = \"interior/back/within\"");
    edit(&folder, |text| text.replacen(&format!("{line}\n"), "", 1));
    let (out, _) = ends(&folder, &["check", "--quiet"], 1);
    let named = "moller-trumbore (source) f32 tiny: false-miss of interior/back/within: ";
    assert!(out.contains(named) && out.contains("does not conform: 1 unexpected"), "{out}");
}

#[test]
fn what_no_longer_happens_is_stale_with_its_line_and_its_reason() {
    let folder = blessed("check-stale");
    let new = "  { family = \"interior\", class = \"interior/front/within\", finding = \"false-hit\", \
               count = 7, why = \"an old bug\" },\n";
    edit(&folder, |text| text.replacen("findings = [\n", &format!("findings = [\n{new}"), 1));
    let (line, _) = line_with(&folder, "an old bug");
    let (out, _) = ends(&folder, &["check", "--quiet"], 3);
    assert!(
        out.contains(&format!("{FILE}:{line}: moller-trumbore (source) f32 interior")),
        "{out}"
    );
    assert!(out.contains("    an old bug\n") && out.contains("are stale: 0 unexpected"), "{out}");
    // An unexpected one beside it wins.
    let (_, line) = line_with(&folder, "tiny");
    edit(&folder, |text| text.replacen(&format!("{line}\n"), "", 1));
    ends(&folder, &["check", "--quiet"], 1);
    // Blessing removes what is stale, and takes what is new only if told so.
    let before = fs::read(folder.join(FILE)).unwrap();
    let (_, error) = ends(&folder, &["check", "--bless", "--quiet"], 1);
    let stays =
        format!("hairline: {FILE} stays as it is: 1 better, 0 worse, 1 new, 0 of other cases, ");
    assert!(
        error.starts_with(&stays) && error.ends_with("; --accept-worse writes it all the same\n"),
        "{error}"
    );
    assert_eq!(fs::read(folder.join(FILE)).unwrap(), before);
    let (_, said) = ends(&folder, &["check", "--bless", "--accept-worse"], 0);
    assert!(
        said.contains("known disagreements (1 better, 0 worse, 1 new, 0 of other cases, "),
        "{said}"
    );
    assert!(!fs::read_to_string(folder.join(FILE)).unwrap().contains("an old bug"));
}

#[test]
fn a_better_epsilon_makes_its_old_expectations_stale() {
    let folder = blessed("check-better");
    // No determinant of the family comes near 1000, and none is as small as 1e-6.
    let settings = "kernel = \"moller-trumbore\"\nfamily = \"interior\"\nscalar = \"f64\"\ncount = 500\n\
                    epsilon = \"parallel=1000\"\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    fs::remove_file(folder.join(FILE)).unwrap();
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    let better = settings.replace("1000", "1e-6");
    fs::write(folder.join("hairline.toml"), better).unwrap();
    let (out, _) = ends(&folder, &["check", "--quiet"], 3);
    assert!(out.contains("moller-trumbore (parallel=1000) f64 interior: false-miss of"), "{out}");
}

#[test]
fn one_case_more_or_another_one_is_noticed() {
    let folder = blessed("check-exact");
    let (_, line) = line_with(&folder, "\"edge-near\", class = \"interior/front/within\"");
    let (head, digest) = line.split_once("digest = \"").unwrap();
    let count: u64 = count_of(&line).parse().unwrap();
    let with = |count: u64| {
        line.replace(&format!("count = {},", count_of(&line)), &format!("count = {count},"))
    };
    let digit = if digest.starts_with('0') { '1' } else { '0' };
    let other = format!("{head}digest = \"{digit}{}", &digest[1..]);
    for (new, code, others) in
        [(with(count - 1), 1, false), (with(count + 1), 3, false), (other, 1, true)]
    {
        let old = fs::read_to_string(folder.join(FILE)).unwrap();
        edit(&folder, |text| text.replacen(&line, &new, 1));
        let (out, _) = ends(&folder, &["check", "--quiet"], code);
        assert!(out.contains("edge-near: false-miss of interior/front/within"), "{out}");
        let said = "; the case shown may have failed before\n";
        assert_eq!(out.contains(said), code == 1, "{out}");
        assert_eq!(out.contains("(other cases)"), others, "{out}");
        fs::write(folder.join(FILE), old).unwrap();
    }
}

fn count_of(line: &str) -> &str {
    line.split("count = ").nth(1).unwrap().split(',').next().unwrap()
}

#[test]
fn blessing_another_plan_takes_no_higher_rate_and_nothing_new_unasked() {
    let folder = blessed("check-grows");
    let more = SETTINGS.replace("[\"moller", "[\"cramer\", \"moller");
    fs::write(folder.join("hairline.toml"), &more).unwrap();
    let before = fs::read_to_string(folder.join(FILE)).unwrap();
    let (_, said) = ends(&folder, &["check", "--bless", "--quiet"], 1);
    assert!(said.contains(": 0 better, 0 worse, "), "{said}");
    assert_eq!(fs::read_to_string(folder.join(FILE)).unwrap(), before);
    ends(&folder, &["check", "--bless", "--quiet", "--accept-worse"], 0);
    // As many cases as expected, but of fewer: the rate is a hundred times higher.
    edit(&folder, |text| {
        let of = |line: &str| match line.split_once("of = ") {
            Some((head, tail)) => format!("{head}of = {}", tail.replacen(',', "00,", 1)),
            None => line.to_owned(),
        };
        text.replacen("plan = \"", "plan = \"0", 1).lines().map(of).collect::<Vec<_>>().join("\n")
    });
    let (_, said) = ends(&folder, &["check", "--bless", "--quiet"], 1);
    assert!(said.contains(", 0 new, 0 of other cases, ") && !said.contains(" 0 worse"), "{said}");
}

#[test]
fn another_seed_conforms_by_intervals_and_another_kernel_does_not() {
    let folder = blessed("check-seed");
    let (out, _) = ends(&folder, &["check", "--quiet", "--seed", "5"], 0);
    assert!(out.contains("compared by intervals"), "{out}");
    // A tenth of a known count is far outside any interval.
    let (_, line) = line_with(&folder, "\"tiny\", class = \"interior/front/within\"");
    let tenth = count_of(&line).parse::<u64>().unwrap() / 10;
    let new = line.replace(&format!("count = {},", count_of(&line)), &format!("count = {tenth},"));
    edit(&folder, |text| text.replacen(&line, &new, 1));
    ends(&folder, &["check", "--quiet", "--seed", "5"], 1);
    // A row that has no entry is expected to be right.
    ends(&folder, &["check", "--quiet", "--seed", "5", "--kernel", "cramer"], 1);
}

#[test]
fn another_seed_conforms_where_triangles_of_one_ray_are_wrong_together() {
    let folder = scratch("check-rays");
    let settings = "kernel = \"plane-unit-normal\"\nepsilon = \"edge=1e-6\"\nscalar = \"f32\"\n\
                    family = \"polygon\"\ncount = 400\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    ends(&folder, &["check", "--bless", "--quiet", "--seed", "77"], 0);
    // As independent trials, 162 of 166 false misses at a vertex are more than the expected 122 of 145.
    let (out, _) = ends(&folder, &["check", "--quiet", "--seed", "27"], 0);
    assert!(out.contains("\nconforms: 0 unexpected"), "{out}");
}

#[test]
fn reasons_are_kept_and_nothing_outside_the_plan_is_lost_by_blessing() {
    let folder = blessed("check-kept");
    edit(&folder, |text| {
        text.replacen(" },", ", why = \"a \\\"known\\\" gap\", url = \"https://a.b\" },", 1)
    });
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    let (_, line) = line_with(&folder, "https://a.b");
    assert!(line.contains("why = \"a \\\"known\\\" gap\""), "{line}");
    let before = fs::read(folder.join(FILE)).unwrap();
    let (_, error) = ends(&folder, &["check", "--bless", "--quiet", "--family", "tiny"], 2);
    assert!(error.contains("outside this plan, which would be lost"), "{error}");
    assert_eq!(fs::read(folder.join(FILE)).unwrap(), before);
}

#[test]
fn bad_expectations_are_refused_with_their_line() {
    let folder = blessed("check-bad");
    let (line, _) = line_with(&folder, "kernel = ");
    edit(&folder, |text| text.replacen("moller-trumbore", "moler-trumbore", 1));
    let (out, error) = ends(&folder, &["check", "--quiet"], 65);
    let expected = format!(
        "hairline: {FILE}:{line}: unknown kernel 'moler-trumbore': did you mean 'moller-trumbore'?\n"
    );
    assert_eq!((out.as_str(), error), ("", expected));
}

#[test]
fn settings_come_from_the_command_line_then_the_environment_then_the_file() {
    let folder = project("check-settings");
    let indices = |arguments: &[&str], variables: &[(&str, &str)]| {
        let all = [&["check", "--family", "tiny"], arguments].concat();
        let output = hairline_with(&folder, &all, variables);
        let error = String::from_utf8(output.stderr).unwrap();
        error.split(": ").nth(1).unwrap().split(' ').next().unwrap().to_owned()
    };
    assert_eq!(indices(&[], &[]), "1000");
    assert_eq!(indices(&[], &[("HAIRLINE_COUNT", "300")]), "300");
    assert_eq!(indices(&["-n", "40"], &[("HAIRLINE_COUNT", "300")]), "40");
    fs::remove_file(folder.join("hairline.toml")).unwrap();
    assert_eq!(indices(&["--scalar", "f32"], &[]), "20000");
}

/// The script of the action's step that checks.
fn script_of_the_action() -> String {
    let action = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/action.yml")).unwrap();
    let step = action.split("      id: check\n").nth(1).unwrap();
    let script = step.split("      run: |\n").nth(1).unwrap();
    let lines = script.lines().take_while(|line| line.starts_with("        "));
    lines.map(|line| format!("{}\n", &line[8..])).collect()
}

/// Runs it as GitHub does: the exit code, and the kernels of the record that it keeps.
fn run_action(folder: &Path, arguments: &str) -> (Option<i32>, Vec<String>) {
    let temporary = folder.join("runner");
    let _ = fs::remove_dir_all(&temporary);
    fs::create_dir_all(temporary.join("hairline/bin")).unwrap();
    let program = temporary.join("hairline/bin/hairline");
    fs::copy(env!("CARGO_BIN_EXE_hairline"), program).unwrap();
    let status = Command::new("bash")
        .args(["--noprofile", "--norc", "-eo", "pipefail", "-c", &script_of_the_action()])
        .current_dir(folder)
        .env("ARGUMENTS", arguments)
        .env("RUNNER_TEMP", &temporary)
        .env("GITHUB_OUTPUT", temporary.join("output"))
        .output()
        .unwrap()
        .status;
    let record = fs::read_to_string(temporary.join("hairline-report/check.json"));
    let kernels = record.map_or(Vec::new(), |text| {
        let record: serde_json::Value = serde_json::from_str(&text).unwrap();
        let rows = record["result"]["plan"]["rows"].as_array().unwrap().clone();
        rows.iter().map(|row| row["kernel"].as_str().unwrap().to_owned()).collect()
    });
    if !kernels.is_empty() {
        let said = fs::read_to_string(temporary.join("output")).unwrap();
        assert_eq!(said, format!("exit-code={}\n", status.code().unwrap()));
    }
    (status.code(), kernels)
}

#[cfg(unix)]
#[test]
fn the_action_takes_a_command_with_spaces_or_all_from_the_file() {
    if Command::new("bash").arg("--version").output().is_err() {
        return;
    }
    let folder = scratch("check-action");
    let misses = "printf 'hairline-kernel 1\\nname never\\nscalars f64\\ncontract closed-ray\\nready\\n'\n\
                  while read -r word id rest; do\n\
                  case $word in case) echo $id miss;; end) echo end $id;; esac\ndone\n";
    fs::write(folder.join("never.sh"), misses).unwrap();
    let settings = "family = \"interior\"\nscalar = \"f64\"\ncount = 50\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    let never = || vec!["never".to_owned()];
    assert_eq!(run_action(&folder, "--kernel-cmd 'sh never.sh' --seed 7"), (Some(1), never()));
    assert_eq!(run_action(&folder, "--kernel-cmd \"sh never.sh"), (Some(1), vec![]));
    // All from the file, before and after what is known is written down.
    let all = format!("{settings}kernel-cmd = \"sh never.sh\"\n");
    fs::write(folder.join("hairline.toml"), all).unwrap();
    assert_eq!(run_action(&folder, ""), (Some(1), never()));
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    assert_eq!(run_action(&folder, ""), (Some(0), never()));
    let output = hairline_with(&folder, &["check"], &[("HAIRLINE_CUONT", "9")]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(error.starts_with("note: HAIRLINE_CUONT is no setting, and is not used; did you mean"));
}

#[test]
fn bad_settings_are_refused_with_their_line_or_variable() {
    let folder = scratch("check-bad-settings");
    for (text, expected) in [
        (
            "count = 5\nkernal = \"cramer\"\n",
            "hairline.toml:2: unknown setting 'kernal'; did you mean 'kernel'?",
        ),
        (
            "count = 0\n",
            "hairline.toml:1: invalid value '0' for '--count <N>': not a number of cases from 1 to",
        ),
        ("\nseed = \"x\"\n", "hairline.toml:2: invalid value 'x' for '--seed <SEED>'"),
        (
            "count = 5\nkernel = \"cramr\"\n",
            "hairline.toml:2: unknown kernel 'cramr'; did you mean 'cramer'?",
        ),
        (
            "kernel = \"cramer\"\nepsilon = \"paralel=1\"\n",
            "hairline.toml:2: no selected kernel has a gate",
        ),
        (
            "epsilon = \"edge=0\"\nepsilon-preset = \"bvh\"\n",
            "hairline.toml:2: epsilon-preset cannot be used with epsilon (hairline.toml:1)",
        ),
        ("\nband = \"wide\"\n", "hairline.toml:2: --band: 'wide' is not a band"),
        ("contract = \"own,ends=x\"\n", "hairline.toml:1: "),
    ] {
        fs::write(folder.join("hairline.toml"), text).unwrap();
        let (_, error) = ends(&folder, &["check", "--quiet"], 2);
        assert!(error.starts_with(&format!("hairline: {expected}")), "{expected}: {error}");
    }
    fs::remove_file(folder.join("hairline.toml")).unwrap();
    let output = hairline_with(&folder, &["check"], &[("HAIRLINE_FAMILY", "tyni")]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(error, "hairline: HAIRLINE_FAMILY: unknown family 'tyni'; did you mean 'tiny'?\n");
}

#[test]
fn the_contract_and_the_band_of_a_project_are_settings() {
    let folder = scratch("check-band");
    let settings = "kernel = \"moller-trumbore\"\nfamily = [\"edge-near\"]\nscalar = \"f32\"\ncount = 500\n\
                    band = \"64ulps\"\ncontract = \"own,coplanar=free\"\n";
    let contract = |text: &str, variables: &[(&str, &str)]| {
        fs::write(folder.join("hairline.toml"), text).unwrap();
        let output = hairline_with(&folder, &["check", "-q", "--format", "json"], variables);
        let record: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let words = record["provenance"]["plan_flags"]["kernels"].as_str().unwrap().to_owned();
        (words, output.status.code())
    };
    let (words, code) = contract(settings, &[]);
    assert!(words.ends_with("--contract own,coplanar=free --band 64ulps"), "{words}");
    assert_eq!(code, Some(0), "every false answer near an edge is within the band");
    let (words, code) = contract(settings, &[("HAIRLINE_BAND", "1e-30")]);
    assert!(words.ends_with("--contract own,coplanar=free --band 1e-30"), "{words}");
    assert_eq!(code, Some(1));
}

#[test]
fn the_other_exit_codes_come_from_real_commands() {
    let folder = blessed("check-codes");
    let case = "{\"scalar\":\"f32\",\"origin\":[1,0,1],\"direction\":[0,0,-1],\"a\":[0,0,0],\"b\":[2,0,0],\"c\":[0,2,0]}\n";
    fs::write(folder.join("c.jsonl"), case).unwrap();
    let nothing =
        ["check", "-q", "--config", "none.toml", "--corpus", "c.jsonl", "--scalar", "f64"];
    fs::write(folder.join("none.toml"), "").unwrap();
    ends(&folder, &nothing, 4);
    ends(&folder, &["check", "-q", "--expectations", "missing.toml"], 74);
    ends(&folder, &["check", "-q", "--config", "missing.toml"], 74);
    ends(&folder, &["check", "-q", "-o", "no/such/folder.txt"], 74);
    ends(&folder, &["check", "-q", "--format", "json", "-o", "r.json"], 0);
    ends(&folder, &["check", "-q", "--record", "r.json"], 0);
    let record = fs::read_to_string(folder.join("r.json")).unwrap();
    let spoil = |from: &str, to: &str| {
        let spoiled = record.replacen(from, to, 1);
        assert_ne!(spoiled, record);
        fs::write(folder.join("spoiled.json"), spoiled).unwrap();
        folder.clone()
    };
    let judge = ["check", "-q", "--record", "spoiled.json"];
    let (_, error) = ends(&spoil("\"promise_broken\": 0", "\"promise_broken\": 1"), &judge, 70);
    assert!(error.contains("self-check: family 'interior' breaks its promise"), "{error}");
    let (_, error) = ends(&spoil("hairline-record/1", "hairline-record/9"), &judge, 65);
    assert!(error.contains("schema 'hairline-record/9', expected 'hairline-record/1'"), "{error}");
    fs::write(folder.join("spoiled.json"), &record[..record.len() / 2]).unwrap();
    let (_, error) = ends(&folder, &judge, 65);
    assert!(error.starts_with("hairline: spoiled.json:"), "{error}");
}

#[test]
fn the_result_and_the_verdict_do_not_depend_on_the_number_of_threads() {
    let folder = blessed("check-threads");
    let results: Vec<String> = ["1", "2", "7"]
        .iter()
        .map(|threads| {
            let file = format!("{threads}.json");
            let arguments = ["check", "-q", "--threads", threads, "--format", "json", "-o", &file];
            ends(&folder, &arguments, 0);
            result_bytes(&folder.join(file))
        })
        .collect();
    assert!(results[0].contains("\"digest\""));
    assert!(results.iter().all(|result| *result == results[0]));
}

#[test]
fn on_github_deviations_are_annotated_and_the_summary_is_appended() {
    let folder = blessed("check-github");
    let (_, line) = line_with(&folder, "tiny");
    edit(&folder, |text| text.replacen(&format!("{line}\n"), "", 1));
    let summary = folder.join("summary.md");
    fs::write(&summary, "before\n").unwrap();
    let variables =
        [("GITHUB_ACTIONS", "true"), ("GITHUB_STEP_SUMMARY", summary.to_str().unwrap())];
    let output = hairline_with(&folder, &["check", "-q", "--format", "json"], &variables);
    assert_eq!(output.status.code(), Some(1));
    assert!(serde_json::from_slice::<serde_json::Value>(&output.stdout).is_ok());
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(
        error.starts_with("::error title=hairline%3A unexpected disagreement::moller-trumbore"),
        "{error}"
    );
    assert_eq!(error.lines().count(), 1, "{error}");
    let text = fs::read_to_string(&summary).unwrap();
    assert!(text.starts_with("before\n## hairline does not conform: 1 unexpected"), "{text}");
    // A summary that is all but full is not overrun.
    fs::write(&summary, "x".repeat((1 << 20) - 1300)).unwrap();
    hairline_with(&folder, &["check", "-q"], &variables);
    let text = fs::read_to_string(&summary).unwrap();
    assert!(text.len() < 1 << 20 && text.ends_with("has everything.\n"), "{}", text.len());
}

#[test]
fn this_repositorys_own_expectations_are_of_its_default_plan() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // Few cases: the plan is another, so rates are compared. CI compares the whole plan case by case.
    ends(root, &["check", "-q", "--count", "200", "--family", "tiny,edge-exact"], 0);
}

#[test]
fn a_band_frees_polygons_and_groups_as_it_frees_cases() {
    let folder = scratch("check-band");
    let with = |arguments: &str, code: i32| {
        let arguments: Vec<&str> = arguments.split(' ').collect();
        ends(&folder, &arguments, code)
    };
    // Every ray through the inside passes within a longest edge of the outline.
    let polygons = "check --quiet --kernel convex-polygon --epsilon parallel=1000 \
                    --family polygon --scalar f32 -n 2000";
    let (out, _) = with(polygons, 1);
    assert!(out.contains("polygon: polygon-false-miss of polygon: "), "{out}");
    with(&format!("{polygons} --band 1"), 0);
    // Within a thousandth of a longest edge hardly any lattice ray passes that is not on the outline.
    with(&format!("{polygons} --band 1e-3"), 1);
    let groups = "audit --quiet --kernel moller-trumbore --epsilon edge=0.1 --scalar f32 \
                  --family shared-edge,fan -n 500 --format json -o";
    let crossings = |band: &str| -> Vec<u64> {
        with(&format!("{groups} record.json{band}"), 0);
        let record: serde_json::Value =
            serde_json::from_slice(&fs::read(folder.join("record.json")).unwrap()).unwrap();
        let results = record["result"]["results"].as_array().unwrap();
        results.iter().map(|part| part["across"]["cracks"]["of"].as_u64().unwrap()).collect()
    };
    assert!(crossings("").iter().all(|of| 100 < *of));
    assert_eq!(crossings(" --band 1"), [0, 0]);
}

#[test]
fn a_polygons_finding_has_a_command_that_shows_the_polygon_as_a_whole() {
    let folder = scratch("check-polygon");
    let run = "audit --quiet --kernel convex-polygon --epsilon parallel=1000 --family polygon \
               --scalar f32 -n 50 --details --format text,html -o text -o html";
    ends(&folder, &run.split_whitespace().collect::<Vec<_>>(), 0);
    let text = fs::read_to_string(folder.join("text")).unwrap();
    let mut lines = text.lines().skip_while(|line| !line.contains("polygon-false-miss: "));
    assert!(lines.next().is_some_and(|line| line.ends_with(" whole polygons")), "{text}");
    let command = lines.next().unwrap().trim();
    let words: Vec<String> = command.split(' ').map(|word| word.replace('\'', "")).collect();
    assert_eq!(words[..2], ["hairline", "explain"]);
    let words: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    let (shown, _) = ends(&folder, &words, 0);
    let whole = shown.lines().find(|line| line.contains(" corners as a whole: ")).expect(&shown);
    assert!(whole.ends_with(" as a whole: miss; its contract asks a hit: FALSE-MISS"), "{whole}");
    let html = fs::read_to_string(folder.join("html")).unwrap();
    assert!(
        html.contains("polygon-false-miss") && html.contains(&words[1].to_owned()),
        "{command}"
    );
}
