//! `hairline check` as CI runs it: exit codes, blessing, stale and unexpected disagreements, settings.

use crate::program;

use program::{ends_flat as ends, hairline_with, resealed, result_bytes, scratch};
use std::fs;
use std::path::{Path, PathBuf};

const SETTINGS: &str = "kernel = [\"moller-trumbore\", \"woop-watertight\"]\nscalar = \"f32\"\n\
                        family = [\"interior\", \"tiny\", \"edge-near\"]\ncount = 1_000\n";

const FILE: &str = "hairline.expectations.toml";

/// The cases behind the counts.
const LOCK: &str = "hairline.expectations.toml.lock";

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

fn edit_file(folder: &Path, file: &str, change: impl Fn(&str) -> String) {
    let file = folder.join(file);
    let old = fs::read_to_string(&file).unwrap();
    let new = change(&old);
    assert_ne!(old, new);
    fs::write(file, new).unwrap();
}

fn edit(folder: &Path, change: impl Fn(&str) -> String) {
    edit_file(folder, FILE, change);
}

/// The line of a file, counted from 1, that holds a text.
fn line_with(folder: &Path, file: &str, text: &str) -> (usize, String) {
    let file = fs::read_to_string(folder.join(file)).unwrap();
    let (i, line) = file
        .lines()
        .enumerate()
        .find(|(_, line)| line.contains(text))
        .unwrap();
    (i + 1, line.to_owned())
}

/// Goes on without the cases, by the counts alone.
fn forget_cases(folder: &Path) {
    fs::remove_file(folder.join(LOCK)).unwrap();
}

#[test]
fn cases_without_their_counts_are_a_mistake() {
    let folder = blessed("check-lock-alone");
    fs::remove_file(folder.join(FILE)).unwrap();
    for words in [&["check", "-q"][..], &["check", "-q", "--bless"]] {
        let error = ends(&folder, words, 65).1;
        let expected = format!("{LOCK}: {FILE}, whose cases these are, is missing: restore it");
        assert!(error.contains(&expected), "{error}");
    }
    fs::remove_file(folder.join(LOCK)).unwrap();
    ends(&folder, &["check", "-q", "--bless"], 0);
}

/// The count of the first family of a name among those that people review.
fn count_of(text: &str, family: &str) -> u64 {
    let after = text.split(&format!("{family} = ")).nth(1).unwrap();
    after.split([',', ' ']).next().unwrap().parse().unwrap()
}

/// Changes that count.
fn recount(folder: &Path, family: &str, change: impl Fn(u64) -> u64) {
    edit(folder, |text| {
        let count = count_of(text, family);
        text.replacen(
            &format!("{family} = {count}"),
            &format!("{family} = {}", change(count)),
            1,
        )
    });
}

#[test]
fn without_expectations_every_disagreement_fails_and_names_its_case_and_command() {
    let folder = project("check-none");
    let (out, _) = ends(&folder, &["check", "--quiet"], 1);
    for expected in [
        "nothing is expected: there is no file of expectations",
        "the same command with --bless takes the ",
        " disagreements below as known: it writes how many are wrong in each family into \
         hairline.expectations.toml, for people to review, and the cases into \
         hairline.expectations.toml.lock; commit both\n",
        "moller-trumbore (source) f32 tiny: false-miss of interior/front/within: ",
        ", expected none\n    hairline explain 'tiny@3/f32/-/1/",
        "\nA class, as interior/back/within: where the line meets the triangle, ",
        " wrong answers of moller-trumbore",
        ", and no file says which are known\n",
        "\nA short case: ",
    ] {
        assert!(out.contains(expected), "{expected}: {out}");
    }
    // The bits are for those who want all.
    let (details, _) = ends(&folder, &["check", "--quiet", "--details"], 1);
    assert!(
        !out.contains("\n    o=") && details.contains("\n    o="),
        "{details}"
    );
    assert!(!folder.join(FILE).exists());
}

#[test]
fn a_blessed_run_conforms_and_blessing_again_changes_nothing() {
    let folder = blessed("check-blessed");
    let (out, _) = ends(&folder, &["check", "--quiet"], 0);
    assert!(out.starts_with("Conforms: "), "{out}");
    assert!(
        out.contains(" wrong answers, all known, and none gone\n"),
        "{out}"
    );
    let both = || [FILE, LOCK].map(|file| fs::read_to_string(folder.join(file)).unwrap());
    let first = both();
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    assert_eq!(both(), first);
    assert_eq!(
        fs::read_dir(&folder).unwrap().count(),
        3,
        "nothing is left beside"
    );
    // A line for each finding in one file, a line for each class in the other, in order.
    assert_eq!(first[0].matches("scalar = ").count(), 4, "{}", first[0]);
    let lines: Vec<&str> = first[1].lines().skip(3).collect();
    let (rows, lines) = lines.split_at(2);
    let row = "moller-trumbore\tsource\tedge=0,parallel=1e-6\tline, both sides, closed, ";
    assert!(
        rows[0].starts_with(row) && rows[1].starts_with("woop-watertight\t"),
        "{rows:?}"
    );
    assert!(10 < lines.len() && lines.is_sorted() && lines.iter().all(|l| l.contains("\tf32\t")));
}

#[test]
fn a_family_without_its_count_is_an_unexpected_disagreement_by_name() {
    let folder = blessed("check-removed");
    forget_cases(&folder);
    let tiny = count_of(&fs::read_to_string(folder.join(FILE)).unwrap(), "tiny");
    edit(&folder, |text| {
        text.replacen(&format!("tiny = {tiny}, "), "", 1)
    });
    let (out, _) = ends(&folder, &["check", "--quiet"], 1);
    let named = "moller-trumbore (source) f32 tiny: false-miss of interior/front/within: ";
    let first = format!("Worse: moller-trumbore, {tiny} wrong answers more than known");
    assert!(
        out.contains(named) && out.starts_with(&first),
        "{first}{out}"
    );
    let (details, _) = ends(&folder, &["check", "--quiet", "--details"], 1);
    assert!(
        details.contains("Does not conform: 6 unexpected"),
        "{details}"
    );
    // Without the lock file, although what is new has a class.
    assert!(out.contains("compared family by family with "), "{out}");
    let net = format!("  +{tiny}  tiny +{tiny}\n");
    assert!(tiny < 1000 && out.contains(&net), "{net}{out}");
}

#[test]
fn counts_that_are_not_those_of_the_cases_are_refused_with_their_line() {
    let folder = blessed("check-agree");
    let (line, _) = line_with(&folder, FILE, "tiny = ");
    let tiny = count_of(&fs::read_to_string(folder.join(FILE)).unwrap(), "tiny");
    let advice = "put back what was there, or let `hairline check --bless` (in a test HAIRLINE_BLESS=1) write both \
                  files\n";
    // One more that no case is behind.
    edit(&folder, |text| {
        text.replacen("counts = { ", "counts = { interior = 1, ", 1)
    });
    let (_, error) = ends(&folder, &["check", "--quiet"], 65);
    assert!(
        error.contains(" f32 interior false-hit: 1 here, 0 in "),
        "{error}"
    );
    edit(&folder, |text| text.replacen("interior = 1, ", "", 1));
    recount(&folder, "tiny", |count| count - 1);
    let (out, error) = ends(&folder, &["check", "--quiet"], 65);
    let found = format!(
        "hairline: {FILE}:{line}: moller-trumbore (source) f32 tiny false-miss: {} here, {tiny} in {LOCK}: {advice}",
        tiny - 1
    );
    assert_eq!((out.as_str(), error), ("", found));
    edit(&folder, |text| {
        text.replacen(&format!("tiny = {}, ", tiny - 1), "", 1)
    });
    let (_, error) = ends(&folder, &["check", "--quiet"], 65);
    assert!(error.contains(&format!(
        "{FILE}: moller-trumbore (source) f32 tiny false-miss: 0 here, "
    )));
    // What a person took out is new.
    ends(&folder, &["check", "--quiet", "--bless"], 1);
    ends(
        &folder,
        &["check", "--quiet", "--bless", "--accept-worse"],
        0,
    );
    ends(&folder, &["check", "--quiet"], 0);
    edit(&folder, |text| {
        text.replacen("cases = \"", "cases = \"0", 1)
    });
    let (_, error) = ends(&folder, &["check", "--quiet"], 65);
    assert!(
        error.contains(&format!(", but {LOCK} has cases ")) && error.ends_with(advice),
        "{error}"
    );
    // A line of the cases that is none.
    ends(&folder, &["check", "--quiet", "--bless"], 0);
    edit_file(&folder, LOCK, |text| text.replacen("\tf32\t", " f32 ", 1));
    let (_, error) = ends(&folder, &["check", "--quiet"], 65);
    assert!(
        error.starts_with(&format!(
            "hairline: {LOCK}:6: expected 9 words between tabs: "
        )),
        "{error}"
    );
    assert!(
        error.ends_with(
            "; `hairline check --bless`, or HAIRLINE_BLESS=1 in a test, writes this file\n"
        ),
        "{error}"
    );
}

#[test]
fn a_target_without_cases_is_compared_by_counts_and_blesses_its_own() {
    let folder = blessed("check-targets");
    let target = format!("[{}-{}]", std::env::consts::ARCH, std::env::consts::OS);
    edit_file(&folder, LOCK, |text| text.replace(&target, "[pdp11-unix]"));
    let (out, _) = ends(&folder, &["check", "--quiet"], 0);
    let said = format!(
        "{LOCK} has no section of {}: counts by family are compared, not cases\n",
        target.trim_matches(['[', ']'])
    );
    assert!(out.contains(&said), "{out}");
    // The counts of people are those of the target that has the most: here one false miss more there.
    let (_, line) = line_with(
        &folder,
        LOCK,
        "\tedge-near\tinterior/back/within\tfalse-miss\t",
    );
    let (head, rest) = line.split_once("\tfalse-miss\t").unwrap();
    let (count, rest) = rest.split_once('\t').unwrap();
    let more = format!(
        "{head}\tfalse-miss\t{}\t{rest}",
        count.parse::<u64>().unwrap() + 1
    );
    edit_file(&folder, LOCK, |text| text.replacen(&line, &more, 1));
    let (_, of_people) = line_with(&folder, FILE, "false-miss");
    let count = count_of(&of_people, "edge-near");
    let with_more = of_people.replace(
        &format!("edge-near = {count}"),
        &format!("edge-near = {}", count + 1),
    );
    edit(&folder, |text| text.replacen(&of_people, &with_more, 1));
    let (out, _) = ends(&folder, &["check", "--quiet"], 3);
    assert!(
        out.starts_with("Better: moller-trumbore, 1 wrong answer fewer than known, none more"),
        "{out}"
    );
    let by_counts = format!("compared family by family with {FILE}\n");
    assert!(
        out.contains(&by_counts) && !out.contains("case by case"),
        "{out}"
    );
    let title = "\nWhat changed in moller-trumbore (source): wrong answers, by kind\n";
    let change = "  -1  edge-near -1\n";
    assert!(out.contains(title) && out.contains(change), "{out}");
    let reviewed = fs::read_to_string(folder.join(FILE)).unwrap();
    let (_, said) = ends(&folder, &["check", "--bless"], 0);
    assert!(
        said.contains("(1 better, 0 worse, 0 new, 0 of other cases, "),
        "{said}"
    );
    assert_eq!(fs::read_to_string(folder.join(FILE)).unwrap(), reviewed);
    let lock = fs::read_to_string(folder.join(LOCK)).unwrap();
    assert!(
        lock.contains(&more) && lock.contains(&line) && lock.contains(&target),
        "{lock}"
    );
    let (out, _) = ends(&folder, &["check", "--quiet"], 0);
    assert!(!out.contains("has no section"), "{out}");
    // Other cases are others everywhere.
    let (_, said) = ends(
        &folder,
        &["check", "--bless", "--accept-worse", "--seed", "3"],
        0,
    );
    assert!(
        said.contains(&format!(
            "{LOCK}: the counts of pdp11-unix were of other cases, and are gone\n"
        )),
        "{said}"
    );
}

#[test]
fn rates_are_bounds_that_need_no_counts() {
    let folder = project("check-rates");
    let with = |rate: &str, arguments: &[&str], code: i32| {
        let text = format!(
            "schema = \"hairline-expectations/2\"\n[[known]]\nkernel = \"moller-trumbore\"\nset = \"source\"\n\
             findings = [\n  {{ scalar = \"f32\", finding = \"false-miss\", why = \"det\", \
             rates = {{ edge-near = {rate}, tiny = 1.0 }} }},\n  {{ scalar = \"f32\", finding = \"false-hit\", \
             rates = {{ edge-near = 0.5 }} }},\n]\n"
        );
        fs::write(folder.join(FILE), text).unwrap();
        let _ = fs::remove_file(folder.join(LOCK));
        let all = [
            &["check", "--quiet", "--kernel", "moller-trumbore"],
            arguments,
        ]
        .concat();
        ends(&folder, &all, code).0
    };
    assert!(!with("0.5", &[], 0).contains("are compared"));
    with("0.5", &["--seed", "5"], 0);
    let out = with("0.001", &[], 1);
    assert!(
        out.contains("expected a share of at most 0.001, and not none; "),
        "{out}"
    );
    assert!(!out.contains("What changed"), "{out}");
    // Blessing keeps a bound that holds, and its reason, and writes the count where it does not.
    with("0.5", &["--bless"], 0);
    let (_, line) = line_with(&folder, FILE, "det");
    assert!(
        line.contains("rates = { tiny = 1.0, edge-near = 0.5 }, why = \"det\" }"),
        "{line}"
    );
    with("0.001", &["--bless"], 1);
    with("0.001", &["--bless", "--accept-worse"], 0);
    let (_, line) = line_with(&folder, FILE, "det");
    assert!(
        line.contains("counts = { edge-near = 49 }, rates = { tiny = 1.0 }, why = "),
        "{line}"
    );
    ends(
        &folder,
        &["check", "--quiet", "--kernel", "moller-trumbore"],
        0,
    );
}

#[test]
fn what_no_longer_happens_is_stale_with_its_line_and_its_reason() {
    let folder = blessed("check-stale");
    forget_cases(&folder);
    let new = "  { scalar = \"f32\", finding = \"false-hit\", counts = { interior = 7 }, why = \"an old bug\" },\n";
    edit(&folder, |text| {
        text.replacen("findings = [\n", &format!("findings = [\n{new}"), 1)
    });
    let (line, _) = line_with(&folder, FILE, "an old bug");
    let (out, _) = ends(&folder, &["check", "--quiet"], 3);
    assert!(
        out.contains(format!(
            "{FILE}:{line}: moller-trumbore (source) f32 interior"
        )),
        "{out}"
    );
    assert!(
        out.contains("    an old bug\n") && out.starts_with("Better: moller-trumbore, "),
        "{out}"
    );
    assert!(out.contains(format!(
        "{LOCK} is missing (--bless writes it): counts by family are compared, not cases"
    )));
    // An unexpected one beside it wins.
    let tiny = count_of(&fs::read_to_string(folder.join(FILE)).unwrap(), "tiny");
    edit(&folder, |text| {
        text.replacen(&format!("tiny = {tiny}, "), "", 1)
    });
    ends(&folder, &["check", "--quiet"], 1);
    // Blessing removes what is stale, and takes what is new only if told so.
    let before = fs::read(folder.join(FILE)).unwrap();
    let (_, error) = ends(&folder, &["check", "--bless", "--quiet"], 1);
    let stays =
        format!("hairline: {FILE} stays as it is: 1 better, 0 worse, 6 new, 0 of other cases, ");
    assert!(
        error.starts_with(&stays) && error.ends_with("; --accept-worse writes it all the same\n"),
        "{error}"
    );
    assert_eq!(fs::read(folder.join(FILE)).unwrap(), before);
    assert!(!folder.join(LOCK).exists());
    let (_, said) = ends(&folder, &["check", "--bless", "--accept-worse"], 0);
    assert!(
        said.contains("known disagreements (1 better, 0 worse, 6 new, 0 of other cases, "),
        "{said}"
    );
    // Entries are no cases.
    assert!(
        said.contains(
            " known findings (a disagreement is a kind of wrong answer in a family and a class)"
        ),
        "{said}"
    );
    assert!(
        !fs::read_to_string(folder.join(FILE))
            .unwrap()
            .contains("an old bug")
    );
}

#[test]
fn a_better_epsilon_makes_its_old_expectations_stale() {
    let folder = blessed("check-better");
    // No determinant of the family comes near 1000, and none is as small as 1e-6.
    let settings = "kernel = \"moller-trumbore\"\nfamily = \"interior\"\nscalar = \"f64\"\ncount = 500\n\
                    epsilon = \"parallel=1000\"\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    [FILE, LOCK]
        .iter()
        .for_each(|file| fs::remove_file(folder.join(file)).unwrap());
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    let better = settings.replace("1000", "1e-6");
    fs::write(folder.join("hairline.toml"), better).unwrap();
    let (out, _) = ends(&folder, &["check", "--quiet"], 3);
    // What changed is counted, although the epsilons have another name.
    assert!(
        out.contains("moller-trumbore (parallel=1e-6) f64 interior: false-miss of"),
        "{out}"
    );
    assert!(
        out.contains("its epsilon parallel is now 1e-6; blessed with 1000"),
        "{out}"
    );
    assert!(out.contains("  -500  interior -500\n"), "{out}");
    // Reasons are kept under the new name, and a change to the worse is one.
    edit(&folder, |text| {
        text.replacen(
            "finding = \"false-miss\"",
            "finding = \"false-miss\", why = \"mine\"",
            1,
        )
    });
    fs::write(
        folder.join("hairline.toml"),
        settings.replace("1000", "999"),
    )
    .unwrap();
    let (_, error) = ends(&folder, &["check", "--quiet", "--bless"], 0);
    assert_eq!(error, "");
    let written = fs::read_to_string(folder.join(FILE)).unwrap();
    assert!(
        written.contains("set = \"parallel=999\"") && written.contains("why = \"mine\""),
        "{written}"
    );
}

#[test]
fn one_case_more_or_another_one_is_noticed() {
    let folder = blessed("check-exact");
    // Another sum of the same cases: no case is new, and that is said.
    let (_, line) = line_with(&folder, LOCK, "\tedge-near\tinterior/front/within\t");
    let (head, digest) = line.rsplit_once('\t').unwrap();
    let digit = if digest.starts_with('0') { '1' } else { '0' };
    let other = format!("{head}\t{digit}{}", &digest[1..]);
    let old = fs::read_to_string(folder.join(LOCK)).unwrap();
    edit_file(&folder, LOCK, |text| text.replacen(&line, &other, 1));
    let (out, _) = ends(&folder, &["check", "--quiet"], 1);
    assert!(
        out.contains("edge-near: false-hit of interior/front/within")
            || out.contains("edge-near: false-miss of interior/front/within"),
        "{out}"
    );
    assert!(
        out.contains(" (other cases); the case shown may have failed before\n"),
        "{out}"
    );
    let first = "Changed: moller-trumbore, wrong as often as known, on other cases";
    assert!(out.starts_with(first), "{out}");
    assert!(
        out.contains(": as many wrong answers, on other cases (1 class)."),
        "{out}"
    );
    fs::write(folder.join(LOCK), old).unwrap();
    // By counts alone.
    forget_cases(&folder);
    recount(&folder, "edge-near", |count| count - 1);
    let (out, _) = ends(&folder, &["check", "--quiet"], 1);
    assert!(
        out.contains("; the case shown may have failed before\n"),
        "{out}"
    );
    let first = "Worse: moller-trumbore, 1 wrong answer more than known";
    assert!(out.starts_with(first), "{out}");
    recount(&folder, "edge-near", |count| count + 2);
    ends(&folder, &["check", "--quiet"], 3);
}

/// Raises the count of a class in both files, so that the run finds one case fewer than known.
fn know_one_more(folder: &Path, family: &str, class: &str) {
    let (_, line) = line_with(folder, LOCK, &format!("\t{family}\t{class}\tfalse-hit\t"));
    let (head, rest) = line.split_once("\tfalse-hit\t").unwrap();
    let (count, rest) = rest.split_once('\t').unwrap();
    let more = count.parse::<u64>().unwrap() + 1;
    edit_file(folder, LOCK, |text| {
        text.replacen(&line, &format!("{head}\tfalse-hit\t{more}\t{rest}"), 1)
    });
    recount(folder, family, |count| count + 1);
}

#[test]
fn other_cases_are_a_part_of_an_improvement_and_no_regression() {
    let folder = blessed("check-improved");
    // One class is wrong as often, on other cases.
    let (_, line) = line_with(&folder, LOCK, "\ttiny\tinterior/front/within\tfalse-miss\t");
    let (head, digest) = line.rsplit_once('\t').unwrap();
    let digit = if digest.starts_with('0') { '1' } else { '0' };
    let other = format!("{head}\t{digit}{}", &digest[1..]);
    edit_file(&folder, LOCK, |text| text.replacen(&line, &other, 1));
    let begins = |words: &str, code: i32| {
        let (out, _) = ends(&folder, &["check", "-q"], code);
        assert!(out.starts_with(words), "{words}: {out}");
    };
    begins(
        "Changed: moller-trumbore, wrong as often as known, on other cases",
        1,
    );
    know_one_more(&folder, "edge-near", "outside/back/within");
    begins(
        "Better: moller-trumbore, 1 wrong answer fewer than known, none more",
        3,
    );
    // Blessing needs no leave.
    ends(&folder, &["check", "-q", "--bless"], 0);
    begins("Conforms: ", 0);
}

#[test]
fn the_first_line_has_the_reason_and_a_short_case_shows_it() {
    let folder = blessed("check-short");
    let run = [
        "check",
        "-q",
        "--kernel",
        "moller-trumbore",
        "--epsilon",
        "parallel=0.5",
    ];
    let (out, _) = program::ends(&folder, &run, 1);
    let first = out.lines().next().unwrap();
    assert_eq!(
        first,
        "Worse: moller-trumbore has another epsilon parallel than known: 0.5, not 1e-6"
    );
    assert!(first.len() <= 80);
    let (_, short) = out.split_once("\nA short case: ").unwrap();
    let case = short.split('\'').nth(1).unwrap();
    let kernel = ["--kernel", "moller-trumbore", "--epsilon"];
    let explained = |epsilon: &str| {
        let words = [&["explain", case], &kernel[..], &[epsilon]].concat();
        ends(&folder, &words, 0).0
    };
    assert!(
        explained("parallel=0.5,edge=0").contains("FALSE-MISS"),
        "{case}"
    );
    assert!(
        explained("parallel=0,edge=0").contains("as it should"),
        "{case}"
    );
    // Its numbers have few digits: those of the case that was found have some nine each.
    let digits = case.matches(|c: char| c.is_ascii_digit()).count();
    assert!(digits < 60, "{digits}: {case}");
    assert!(
        out.contains(": put its epsilon parallel back, or, if it is"),
        "{out}"
    );
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
    ends(
        &folder,
        &["check", "--bless", "--quiet", "--accept-worse"],
        0,
    );
    // As many cases as expected, but of fewer: the rate is a hundred times higher.
    edit(&folder, |text| {
        text.replacen("cases = \"", "cases = \"0", 1)
    });
    edit_file(&folder, LOCK, |text| {
        let of = |line: &str| match line.rsplit_once('\t') {
            Some((head, digest)) => format!("{head}00\t{digest}\n"),
            None => line.replacen("cases ", "cases 0", 1) + "\n",
        };
        text.lines().map(of).collect()
    });
    let (_, said) = ends(&folder, &["check", "--bless", "--quiet"], 1);
    assert!(
        said.contains(", 0 new, 0 of other cases, ") && !said.contains(" 0 worse"),
        "{said}"
    );
}

#[test]
fn another_seed_conforms_by_intervals_and_another_kernel_does_not() {
    let folder = blessed("check-seed");
    let (out, _) = ends(&folder, &["check", "--quiet", "--seed", "5"], 0);
    assert!(out.contains("compared by intervals"), "{out}");
    // A tenth of a known count is far outside any interval.
    let (_, line) = line_with(&folder, LOCK, "\ttiny\tinterior/front/within\tfalse-miss\t");
    let (head, rest) = line.split_once("\tfalse-miss\t").unwrap();
    let (count, rest) = rest.split_once('\t').unwrap();
    let (count, tenth) = (
        count.parse::<u64>().unwrap(),
        count.parse::<u64>().unwrap() / 10,
    );
    let new = format!("{head}\tfalse-miss\t{tenth}\t{rest}");
    edit_file(&folder, LOCK, |text| text.replacen(&line, &new, 1));
    recount(&folder, "tiny", |all| all - count + tenth);
    ends(&folder, &["check", "--quiet", "--seed", "5"], 1);
    // Without cases there are no rates, and nothing is expected.
    forget_cases(&folder);
    let (out, _) = ends(&folder, &["check", "--quiet", "--seed", "5"], 1);
    assert!(out.contains(
        "the counts of hairline.expectations.toml are of other cases: they are not used"
    ));
    // A row that has no entry is expected to be right.
    ends(
        &folder,
        &["check", "--quiet", "--seed", "5", "--kernel", "cramer"],
        1,
    );
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
    assert!(
        out.starts_with("Conforms: wrong answers are as frequent as known, within their intervals"),
        "{out}"
    );
}

#[test]
fn a_family_that_is_not_known_conforms_only_without_wrong_answers() {
    let folder = scratch("check-other-family");
    let arguments = ["check", "--quiet", "--count", "100", "--kernel"];
    let check = |kernel_family: [&'static str; 2], more: &[&'static str], status| {
        let [kernel, family] = kernel_family;
        let row = [kernel, "--family", family];
        ends(&folder, &[&arguments[..], &row[..], more].concat(), status).0
    };
    check(["woop-watertight", "interior"], &["--bless"], 0);
    let out = check(["woop-watertight", "vertex-exact"], &[], 0);
    assert!(out.starts_with("Conforms: no wrong answer"), "{out}");
    let out = check(["moller-trumbore", "vertex-exact"], &[], 1);
    assert!(out.starts_with("Worse: moller-trumbore"), "{out}");
}

#[test]
fn reasons_are_kept_and_nothing_outside_the_plan_is_lost_by_blessing() {
    let folder = blessed("check-kept");
    edit(&folder, |text| {
        text.replacen(
            " },",
            ", why = \"a \\\"known\\\" gap\", url = \"https://a.b\" },",
            1,
        )
    });
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    let (_, line) = line_with(&folder, FILE, "https://a.b");
    assert!(line.contains("why = \"a \\\"known\\\" gap\""), "{line}");
    // A line that is split by families stays so where a part has a reason.
    let (_, line) = line_with(&folder, FILE, "false-miss");
    let tiny = format!("tiny = {}, ", count_of(&line, "tiny"));
    let (rest, part) = (
        line.replacen(&tiny, "", 1),
        format!(
            "  {{ scalar = \"f32\", finding = \"false-miss\", counts = {{ {} }}, why = \"det\" }},",
            tiny.trim_end_matches(", ")
        ),
    );
    edit(&folder, |text| {
        text.replacen(&line, &format!("{part}\n{rest}"), 1)
    });
    ends(&folder, &["check", "--quiet"], 0);
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    assert!(
        fs::read_to_string(folder.join(FILE))
            .unwrap()
            .contains(&format!("{rest}\n{part}\n"))
    );
    let before = fs::read(folder.join(FILE)).unwrap();
    let (_, error) = ends(
        &folder,
        &["check", "--bless", "--quiet", "--family", "tiny"],
        2,
    );
    assert!(
        error.contains("outside this plan, which would be lost"),
        "{error}"
    );
    assert_eq!(fs::read(folder.join(FILE)).unwrap(), before);
    // A kernel that is no longer there: its entries are taken out of the file for people, and the lock follows.
    let fewer = SETTINGS.replace(", \"woop-watertight\"", "");
    fs::write(folder.join("hairline.toml"), fewer).unwrap();
    let (_, error) = ends(&folder, &["check", "--bless", "--quiet"], 2);
    assert!(error.contains("or remove them first"), "{error}");
    edit_file(&folder, LOCK, |text| {
        let section = text.split_once("\n[").unwrap().1;
        format!(
            "{text}[pdp11-unix]\n{}",
            section.split_once('\n').unwrap().1
        )
    });
    edit(&folder, |text| {
        text.rsplit_once("[[known]]").unwrap().0.to_owned()
    });
    ends(&folder, &["check", "--bless", "--quiet"], 0);
    let lock = fs::read_to_string(folder.join(LOCK)).unwrap();
    assert!(
        lock.contains("[pdp11-unix]\nmoller") && !lock.contains("woop"),
        "{lock}"
    );
    ends(&folder, &["check", "--quiet"], 0);
}

#[test]
fn bad_expectations_are_refused_with_their_line() {
    let folder = blessed("check-bad");
    let (line, _) = line_with(&folder, FILE, "kernel = ");
    edit(&folder, |text| {
        text.replacen("moller-trumbore", "moler-trumbore", 1)
    });
    let (out, error) = ends(&folder, &["check", "--quiet"], 65);
    let expected = format!(
        "hairline: {FILE}:{line}: unknown kernel 'moler-trumbore': did you mean 'moller-trumbore'? \
         (of a renamed kernel, replace the name here and in the lock file)\n"
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
        error
            .split(": ")
            .nth(1)
            .unwrap()
            .split(' ')
            .next()
            .unwrap()
            .to_owned()
    };
    assert_eq!(indices(&[], &[]), "1,000");
    assert_eq!(indices(&[], &[("HAIRLINE_COUNT", "300")]), "300");
    assert_eq!(indices(&["-n", "40"], &[("HAIRLINE_COUNT", "300")]), "40");
    fs::remove_file(folder.join("hairline.toml")).unwrap();
    assert_eq!(indices(&["--scalar", "f32"], &[]), "20,000");
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
        (
            "\nseed = \"x\"\n",
            "hairline.toml:2: invalid value 'x' for '--seed <SEED>'",
        ),
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
        (
            "\nband = \"wide\"\n",
            "hairline.toml:2: --band: 'wide' is not a band",
        ),
        ("contract = \"own,ends=x\"\n", "hairline.toml:1: "),
    ] {
        fs::write(folder.join("hairline.toml"), text).unwrap();
        let (_, error) = ends(&folder, &["check", "--quiet"], 2);
        assert!(
            error.starts_with(&format!("hairline: {expected}")),
            "{expected}: {error}"
        );
    }
    fs::remove_file(folder.join("hairline.toml")).unwrap();
    let output = hairline_with(&folder, &["check"], &[("HAIRLINE_FAMILY", "tiyn")]);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(
        error,
        "hairline: HAIRLINE_FAMILY: unknown family 'tiyn'; did you mean 'tiny'?\n"
    );
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
        let words = record["provenance"]["plan_flags"]["kernels"]
            .as_str()
            .unwrap()
            .to_owned();
        (words, output.status.code())
    };
    let (words, code) = contract(settings, &[]);
    assert!(
        words.ends_with("--contract own,coplanar=free --band 64ulps"),
        "{words}"
    );
    assert_eq!(
        code,
        Some(0),
        "every false answer near an edge is within the band"
    );
    let (words, code) = contract(settings, &[("HAIRLINE_BAND", "1e-30")]);
    assert!(
        words.ends_with("--contract own,coplanar=free --band 1e-30"),
        "{words}"
    );
    assert_eq!(code, Some(1));
}

#[test]
fn expectations_stand_beside_the_configuration_wherever_check_runs() {
    let folder = scratch("check-elsewhere");
    let settings = "kernel = \"cramer\"\nfamily = \"edge-near\"\nscalar = \"f32\"\ncount = 300\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    ends(&folder, &["check", "-q", "--bless"], 0);
    let inside = folder.join("inside");
    fs::create_dir_all(&inside).unwrap();
    ends(&inside, &["check", "-q", "--config", "../hairline.toml"], 0);
    [FILE, LOCK]
        .iter()
        .for_each(|file| fs::remove_file(folder.join(file)).unwrap());
    ends(&inside, &["check", "-q", "--config", "../hairline.toml"], 1);
    // Blessing writes it there, too.
    ends(
        &inside,
        &[
            "check",
            "-q",
            "--config",
            "../hairline.toml",
            "--bless",
            "--accept-worse",
        ],
        0,
    );
    assert!(folder.join("hairline.expectations.toml").exists());
}

#[test]
fn a_scene_is_blessed_and_a_lock_that_is_cut_is_refused() {
    let folder = scratch("check-scene");
    let scene = [
        "check", "-q", "--scene", "room", "--kernel", "cramer", "--scalar", "f32",
    ];
    ends(
        &folder,
        &[&scene[..], &["-n", "300", "--bless"]].concat(),
        0,
    );
    ends(&folder, &[&scene[..], &["-n", "300"]].concat(), 0);
    let lock = folder.join("hairline.expectations.toml.lock");
    let text = fs::read_to_string(&lock).unwrap();
    fs::write(&lock, &text[..text.len() - 10]).unwrap();
    let (_, error) = ends(&folder, &[&scene[..], &["-n", "300"]].concat(), 65);
    assert!(error.contains("the last line is cut off"), "{error}");
}

#[test]
fn the_place_of_a_stored_case_is_not_taken_for_its_name() {
    let folder = scratch("check-stored");
    let made = [
        "corpus",
        "generate",
        "--family",
        "edge-near",
        "-n",
        "400",
        "--scalar",
        "f32",
    ];
    let (made, _) = program::ends(&folder, &made, 0);
    // The names are ids, in another order.
    let reversed: Vec<&str> = made.lines().rev().collect();
    fs::write(folder.join("stored.jsonl"), reversed.join("\n") + "\n").unwrap();
    let check = [
        "check",
        "-q",
        "--corpus",
        "stored.jsonl",
        "--kernel",
        "cramer",
    ];
    ends(
        &folder,
        &[&check[..], &["--band", "1ulps", "--bless"]].concat(),
        0,
    );
    let (out, _) = ends(&folder, &check, 1);
    assert!(
        out.contains("may have failed before") && !out.contains("is new"),
        "{out}"
    );
}

#[test]
fn a_bound_of_what_does_not_occur_is_kept_by_blessing() {
    let folder = scratch("check-bound");
    let check = [
        "check",
        "-q",
        "--family",
        "interior,edge-near",
        "--kernel",
        "cramer",
        "-n",
        "200",
    ];
    let bless = [&check[..], &["--scalar", "f32", "--bless"]].concat();
    ends(&folder, &bless, 0);
    let line = "  { scalar = \"f32\", finding = \"false-miss\", rates = { interior = 0.001 }, why = \"ours\" },";
    edit(&folder, |text| {
        text.replacen("findings = [", &format!("findings = [\n{line}"), 1)
    });
    let before = fs::read_to_string(folder.join("hairline.expectations.toml")).unwrap();
    assert!(before.contains(line));
    ends(&folder, &[&check[..], &["--scalar", "f32"]].concat(), 0);
    ends(&folder, &bless, 0);
    let after = fs::read_to_string(folder.join("hairline.expectations.toml")).unwrap();
    assert!(after.contains(line), "{after}");
    // One expectation that the plan leaves out is one too many.
    let edges = [
        "check",
        "-q",
        "--family",
        "edge-near",
        "--kernel",
        "cramer",
        "-n",
        "200",
    ];
    let error = ends(
        &folder,
        &[&edges[..], &["--scalar", "f32", "--bless"]].concat(),
        2,
    )
    .1;
    assert!(error.contains("has 1 expectations of kernels"), "{error}");
    // What is surely better than its bound is stale, and goes.
    let old = "rates = { interior = 0.001 }";
    edit(&folder, |text| {
        text.replacen(old, "rates = { interior = 0.9 }", 1)
    });
    ends(&folder, &bless, 0);
    assert!(
        !fs::read_to_string(folder.join(FILE))
            .unwrap()
            .contains("interior = ")
    );
}

#[test]
fn files_of_which_one_is_older_are_refused_and_blessed_again() {
    let folder = scratch("check-half-written");
    let check = [
        "check",
        "-q",
        "--family",
        "edge-near",
        "--kernel",
        "cramer",
        "-n",
        "300",
    ];
    let run = |seed: &'static str, more: &[&'static str], code: i32| {
        let flags = ["--scalar", "f32", "--seed", seed];
        ends(&folder, &[&check[..], &flags, more].concat(), code)
    };
    // As if a run was killed after the first of the two files.
    run("1", &["--bless"], 0);
    let lock = folder.join("hairline.expectations.toml.lock");
    let old = fs::read(&lock).unwrap();
    run("2", &["--bless", "--accept-worse"], 0);
    fs::write(&lock, old).unwrap();
    let (_, error) = run("2", &[], 65);
    assert!(error.contains("has cases "), "{error}");
    run("2", &["--bless"], 0);
    run("2", &[], 0);
}

#[test]
fn the_case_of_what_got_better_is_right_now() {
    let folder = scratch("check-better");
    let check = [
        "check",
        "-q",
        "--family",
        "edge-near",
        "--kernel",
        "cramer",
        "--scalar",
        "f32",
    ];
    let run = |more: &[&'static str], code| ends(&folder, &[&check[..], more].concat(), code).0;
    run(&["-n", "400", "--bless"], 0);
    let out = run(&["-n", "400", "--band", "1ulps", "--details"], 3);
    let better: Vec<&str> = out
        .split("; the case shown no longer shows it")
        .skip(1)
        .collect();
    assert!(!better.is_empty(), "{out}");
    for text in better {
        let id = text.split('\'').nth(1).unwrap();
        let all = ["explain", id, "--kernel", "cramer", "--band", "1ulps"];
        let (shown, _) = ends(&folder, &all, 0);
        assert!(!shown.contains("FALSE-"), "{shown}");
    }
    // A record has its numbers too.
    let out = run(&["-n", "400", "--band", "1ulps", "--format", "json"], 3);
    let record: serde_json::Value = serde_json::from_str(&out).unwrap();
    let stale = record["conformance"]["stale"].as_array().unwrap();
    for found in stale {
        let is_told = found["expected"]
            .as_str()
            .unwrap()
            .contains("nothing is demanded");
        assert_eq!(is_told, found["found"]["of"] == 0, "{found}");
    }
    let better = stale.iter().filter(|found| found["case"].is_string());
    let mut shown = 0;
    for found in better {
        let id = found["case"].as_str().unwrap();
        let (text, _) = ends(
            &folder,
            &["explain", id, "--kernel", "cramer", "--details"],
            0,
        );
        let bits = found["bits"].as_str().unwrap().split([' ', '=', ',']);
        bits.filter(|word| word.len() == 8)
            .for_each(|word| assert!(text.contains(word), "{text}"));
        shown += 1;
    }
    assert_eq!(record["conformance"]["change"]["better"], stale.len());
    assert!(0 < shown);
    // Nothing is demanded any more.
    let out = run(&["-n", "400", "--band", "1e9"], 3);
    assert!(
        out.contains("nothing is demanded there now: has the contract changed?"),
        "{out}"
    );
}

#[test]
fn the_same_cases_among_more_trials_are_the_same() {
    let folder = scratch("check-hits");
    let check = [
        "check",
        "-q",
        "--family",
        "range-ends",
        "--kernel",
        "moller-trumbore",
    ];
    let run = |more: &[&'static str], code: i32| {
        ends(
            &folder,
            &[&check[..], &["--scalar", "f32", "-n", "500"], more].concat(),
            code,
        )
        .0
    };
    run(&["--bless"], 0);
    let lock = folder.join("hairline.expectations.toml.lock");
    let blessed = fs::read_to_string(&lock).unwrap();
    // One more of which they are, as if the kernel had lost a hit, or crashed, on another case since.
    for finding in ["bad-value", "false-miss"] {
        let line = blessed
            .lines()
            .find(|line| line.contains(&format!("\t{finding}\t")))
            .unwrap();
        let mut words: Vec<String> = line.split('\t').map(str::to_owned).collect();
        words[7] = (words[7].parse::<u64>().unwrap() + 1).to_string();
        fs::write(&lock, blessed.replacen(line, &words.join("\t"), 1)).unwrap();
        run(&[], 0);
    }
}

#[test]
fn the_other_exit_codes_come_from_real_commands() {
    let folder = blessed("check-codes");
    let case = "{\"scalar\":\"f32\",\"origin\":[1,0,1],\"direction\":[0,0,-1],\"a\":[0,0,0],\"b\":[2,0,0],\"c\":[0,2,0]}\n";
    fs::write(folder.join("c.jsonl"), case).unwrap();
    let nothing = [
        "check",
        "-q",
        "--config",
        "none.toml",
        "--corpus",
        "c.jsonl",
        "--scalar",
        "f64",
    ];
    fs::write(folder.join("none.toml"), "").unwrap();
    ends(&folder, &nothing, 4);
    let error = ends(
        &folder,
        &["check", "-q", "--expectations", "missing.toml"],
        74,
    )
    .1;
    assert!(
        error.ends_with("; with --bless this command writes it\n"),
        "{error}"
    );
    ends(&folder, &["check", "-q", "--config", "missing.toml"], 74);
    ends(&folder, &["check", "-q", "-o", "no/such/folder.txt"], 74);
    ends(
        &folder,
        &["check", "-q", "--format", "json", "-o", "r.json"],
        0,
    );
    ends(&folder, &["check", "-q", "--record", "r.json"], 0);
    let record = fs::read_to_string(folder.join("r.json")).unwrap();
    let spoiled = |from: &str, to: &str| {
        let spoiled = record.replacen(from, to, 1);
        assert_ne!(spoiled, record);
        spoiled
    };
    let judge = ["check", "-q", "--record", "spoiled.json"];
    let broken = resealed(&spoiled("\"promise_broken\": 0", "\"promise_broken\": 1"));
    fs::write(folder.join("spoiled.json"), broken).unwrap();
    let (_, error) = ends(&folder, &judge, 70);
    assert!(
        error.contains("self-check: family 'interior' breaks its promise"),
        "{error}"
    );
    let other = spoiled("hairline-record/2", "hairline-record/9");
    fs::write(folder.join("spoiled.json"), other).unwrap();
    let (_, error) = ends(&folder, &judge, 65);
    assert!(
        error.contains("schema 'hairline-record/9', expected 'hairline-record/2'"),
        "{error}"
    );
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
            let arguments = [
                "check",
                "-q",
                "--threads",
                threads,
                "--format",
                "json",
                "-o",
                &file,
            ];
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
    forget_cases(&folder);
    recount(&folder, "tiny", |count| count - 1);
    let summary = folder.join("summary.md");
    fs::write(&summary, "before\n").unwrap();
    let variables = [
        ("GITHUB_ACTIONS", "true"),
        ("GITHUB_STEP_SUMMARY", summary.to_str().unwrap()),
    ];
    let output = hairline_with(&folder, &["check", "-q", "--format", "json"], &variables);
    assert_eq!(output.status.code(), Some(1));
    assert!(serde_json::from_slice::<serde_json::Value>(&output.stdout).is_ok());
    let error = String::from_utf8(output.stderr).unwrap();
    assert!(
        error.starts_with(&format!(
            "::error title=hairline::Worse: moller-trumbore, 1 wrong answer more than known\n::error \
             file={FILE},line=15,title=hairline%3A unexpected disagreement::moller-trumbore"
        )),
        "{error}"
    );
    assert_eq!(error.lines().count(), 2, "{error}");
    let text = fs::read_to_string(&summary).unwrap();
    assert!(
        text.starts_with("before\n## Worse: moller-trumbore, 1 wrong answer more than known\n"),
        "{text}"
    );
    // A summary that is all but full is not overrun.
    fs::write(&summary, "x".repeat((1 << 20) - 1300)).unwrap();
    hairline_with(&folder, &["check", "-q"], &variables);
    let text = fs::read_to_string(&summary).unwrap();
    assert!(
        text.len() < 1 << 20 && text.ends_with("has everything.\n"),
        "{}",
        text.len()
    );
}

#[test]
fn this_repositorys_own_expectations_are_of_its_default_plan() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    // Few cases, which are others, so rates are compared. CI compares the whole plan case by case.
    ends(
        root,
        &[
            "check",
            "-q",
            "--count",
            "200",
            "--family",
            "tiny,edge-exact",
        ],
        0,
    );
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
    assert!(
        out.contains("polygon: polygon-false-miss of polygon: "),
        "{out}"
    );
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
        results
            .iter()
            .map(|part| part["across"]["cracks"]["of"].as_u64().unwrap())
            .collect()
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
    let mut lines = text
        .lines()
        .skip_while(|line| !line.contains("f32 polygon-false-miss in polygon: "));
    assert!(lines.next().is_some(), "{text}");
    let command = lines.next().unwrap().trim();
    let words: Vec<String> = command
        .split(' ')
        .map(|word| word.replace('\'', ""))
        .collect();
    assert_eq!(words[..2], ["hairline", "explain"]);
    let words: Vec<&str> = words[1..].iter().map(String::as_str).collect();
    let (shown, _) = ends(&folder, &words, 0);
    let whole = " corners as a whole: miss; its contract asks a hit: FALSE-MISS";
    assert!(shown.contains(whole), "{shown}");
    let html = fs::read_to_string(folder.join("html")).unwrap();
    assert!(
        html.contains("polygon-false-miss") && html.contains(&words[1].to_owned()),
        "{command}"
    );
}

#[test]
fn a_scene_is_a_setting_and_a_run_of_none_of_the_expected_cases_is_one_error() {
    let folder = scratch("check-scene-setting");
    let settings = "kernel = \"moller-trumbore\"\nscalar = \"f32\"\ncount = 300\n";
    fs::write(folder.join("hairline.toml"), settings).unwrap();
    ends(&folder, &["check", "-q", "--bless", "--scene", "room"], 0);
    let bare = hairline_with(&folder, &["check", "-q"], &[]);
    let error = String::from_utf8(bare.stderr).unwrap();
    assert_eq!(
        (bare.status.code(), bare.stdout.len()),
        (Some(65), 0),
        "{error}"
    );
    let of =
        "hairline.expectations.toml: its cases are of `--scalar f32 --scene room -n 300` (scene-";
    assert!(error.contains(of), "{error}");
    assert!(error.ends_with(
        ": run `hairline check --scalar f32 --scene room -n 300`, or put it into hairline.toml\n"
    ));
    assert_eq!(error.lines().count(), 1, "{error}");
    // A variable, and the file.
    let code = |words: &[&str], variables| {
        hairline_with(&folder, words, variables)
            .status
            .code()
            .unwrap()
    };
    assert_eq!(code(&["check", "-q"], &[("HAIRLINE_SCENE", "room")]), 0);
    fs::write(
        folder.join("hairline.toml"),
        format!("{settings}scene = \"room\"\n"),
    )
    .unwrap();
    assert_eq!(code(&["check", "-q"], &[]), 0);
    // A family runs besides the scene; nothing of it is known yet.
    let (more, _) = ends(&folder, &["check", "-q", "--family", "tiny"], 1);
    assert!(
        more.contains("moller-trumbore (source) f32 tiny: false-miss"),
        "{more}"
    );
}

#[test]
#[cfg(unix)]
fn of_two_programs_that_bless_at_once_one_waits() {
    let folder = project("check-two");
    let lock = fs::File::open(&folder).unwrap();
    lock.lock().unwrap();
    let mut blesses = std::process::Command::new(env!("CARGO_BIN_EXE_hairline"))
        .args(["check", "-q", "--bless", "-n", "20"])
        .current_dir(&folder)
        .stdout(std::process::Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_secs(2));
    assert!(blesses.try_wait().unwrap().is_none() && !folder.join(FILE).exists());
    drop(lock);
    assert_eq!(blesses.wait().unwrap().code(), Some(0));
    assert!(folder.join(FILE).exists() && folder.join(LOCK).exists());
}

#[test]
fn another_scene_is_one_error_with_the_numbers_that_changed() {
    let folder = scratch("check-other-scene");
    let settings = "kernel = \"moller-trumbore\"\nscalar = \"f32\"\ncount = 300\n";
    let with = |scene: &str| {
        fs::write(
            folder.join("hairline.toml"),
            format!("{settings}scene = \"{scene}\"\n"),
        )
        .unwrap();
    };
    with("extent=5,edge=0.01..3,distance=0..10");
    ends(&folder, &["check", "-q", "--bless"], 0);
    // The same numbers by name, and other cases of the scene.
    with("room");
    ends(&folder, &["check", "-q"], 0);
    ends(&folder, &["check", "-q", "--seed", "2", "-n", "200"], 0);
    with("extent=5,edge=0.002..3,distance=0..40");
    let (out, error) = ends(&folder, &["check", "-q"], 65);
    assert_eq!(
        (out.as_str(), error.as_str()),
        (
            "",
            "hairline: hairline.expectations.toml: its cases are of a scene with edge=0.01..3,distance=0..10, and \
             this run's scene has edge=0.002..3,distance=0..40: how many are wrong in one says nothing about the \
             other; give that scene, or let `hairline check --bless --accept-worse` write what is wrong in this \
             one\n"
        )
    );
    ends(&folder, &["check", "-q", "--bless", "--accept-worse"], 0);
    ends(&folder, &["check", "-q"], 0);
}

/// The lines before the first list.
fn head(out: &str) -> &str {
    out.split(" What changed in ").next().unwrap()
}

#[test]
fn what_a_row_is_set_to_since_it_was_blessed_is_told() {
    let folder = scratch("check-row-changes");
    let with = |settings: &str| {
        let text =
            format!("family = [\"edge-near\", \"fan\"]\nscalar = \"f32\"\ncount = 500\n{settings}");
        fs::write(folder.join("hairline.toml"), text).unwrap();
    };
    let kernels = "kernel = [\"moller-trumbore\", \"woop-watertight\"]\n";
    with(kernels);
    ends(&folder, &["check", "-q", "--bless"], 0);
    assert!(
        !ends(&folder, &["check", "-q"], 0)
            .0
            .contains("blessed with")
    );
    // Kernels that are fewer are no other kernels.
    with("kernel = \"woop-watertight\"\n");
    assert!(
        !ends(&folder, &["check", "-q"], 0)
            .0
            .contains("blessed with")
    );
    with(&format!("{kernels}band = \"4ulps\"\n"));
    let out = ends(&folder, &["check", "-q"], 3).0;
    let line = "\nwoop-watertight (source): its contract is now free within 4ulps of the boundary; blessed with \
                nothing of it";
    assert!(out.contains(line), "{out}");
    assert_eq!(head(&out).matches("blessed with").count(), 2, "{out}");
    with(&format!("{kernels}contract = \"own,boundary=open\"\n"));
    let out = hairline_with(&folder, &["check", "-q"], &[]).stdout;
    let line = " moller-trumbore (source): its contract is now open; blessed with closed ";
    assert!(program::flat(&String::from_utf8_lossy(&out)).contains(line));
    with("kernel = \"moller-trumbore\"\nepsilon = \"parallel=1e-3,edge=0\"\n");
    let out = ends(&folder, &["check", "-q"], 0).0;
    let line = "moller-trumbore (parallel=1e-3,edge=0): its epsilon parallel is now 1e-3; blessed with 1e-6";
    assert!(head(&out).contains(line), "{out}");
}

#[test]
fn a_record_counts_what_was_compared_left_out_and_too_rare() {
    let folder = blessed("check-counts");
    let told = |more: &[&'static str]| {
        let (out, _) = ends(
            &folder,
            &[&["check", "--quiet", "--format", "json"], more].concat(),
            0,
        );
        let record: serde_json::Value = serde_json::from_str(&out).unwrap();
        record["conformance"].clone()
    };
    let lock = fs::read_to_string(folder.join(LOCK)).unwrap();
    let classes = |of_family: fn(&str) -> bool| {
        let words = lock
            .lines()
            .map(|line| line.split('\t').collect::<Vec<_>>());
        words
            .filter(|words| words.len() == 9 && of_family(words[3]))
            .count()
    };
    let tiny = told(&["--family", "tiny"]);
    assert_eq!(tiny["outside_the_plan"], classes(|family| family != "tiny"));
    assert_eq!(
        tiny["change"]["unchanged"],
        classes(|family| family == "tiny")
    );
    assert_eq!(
        [&tiny["change"]["better"], &tiny["too_rare_to_tell"]],
        [0, 0]
    );
    for known in tiny["known"].as_array().unwrap() {
        assert!(
            known["case"].is_null() && known["command"].is_null(),
            "{known}"
        );
    }
    // Of few in 300 cases another seed shows as few, which is not surely more than none: front and back.
    let place = "woop-watertight\tsource\tf32\ttiny\t";
    edit_file(&folder, LOCK, |text| {
        let is_few = |line: &&str| line.starts_with(place) && line.contains("\tfalse-miss\t");
        text.lines()
            .filter(|line| !is_few(line))
            .map(|line| format!("{line}\n"))
            .collect()
    });
    edit(&folder, |text| {
        let (head, woop) = text.split_once("woop-watertight").unwrap();
        let (_, line) = woop.split_once("\"false-miss\"").unwrap();
        let few = format!(", tiny = {}", count_of(line, "tiny"));
        format!("{head}woop-watertight{}", woop.replacen(&few, "", 1))
    });
    let seed = told(&["--seed", "5"]);
    assert_eq!(
        [&seed["too_rare_to_tell"], &seed["change"]["unchanged"]],
        [3, 23]
    );
}
