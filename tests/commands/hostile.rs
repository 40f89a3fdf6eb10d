//! Strings of other people, fed to every command and written in every format: none is an order, an element or a link.

#![cfg(unix)]

use crate::plugin::MISSES;
use crate::program::{hairline, hairline_with, resealed, scratch};
use pulldown_cmark::{Event, Parser, Tag};
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;
use std::process::Output;

/// A terminal obeys a part of it, a browser another, a reader of Markdown a third.
const HOSTILE: &str =
    "a\x1b[2J\x1b]0;t\x07\u{202e}\u{9b}2J![x](javascript:1)<hostile>\"onhostile='1'b";

/// What is shown of it by whoever shows names as they are: markup without orders, as a name of a case may be.
const MARKUP: &str = "![x](javascript:1)<hostile>\"onhostile='1'b";

/// A string in JSON and TOML.
fn quoted(text: &str) -> String {
    let mut quoted = String::from("\"");
    for unit in text.encode_utf16() {
        quoted += &format!("\\u{unit:04x}");
    }
    quoted + "\""
}

/// Panics if a terminal would obey something.
fn is_shown(text: &str, whose: &str) {
    let order = text.chars().find(|c| {
        let turns = matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
        turns || c.is_control() && *c != '\n'
    });
    assert_eq!(order, None, "{whose}: {text:?}");
}

/// Panics if a browser would see an element or an attribute that is not ours.
fn has_no_markup(text: &str, whose: &str) {
    for markup in ["<hostile", "\"onhostile", "href=\"javascript"] {
        assert!(!text.contains(markup), "{whose}: {markup}: {text}");
    }
}

fn has_no_links(text: &str, whose: &str) {
    for event in Parser::new(text) {
        let acts = matches!(event, Event::Start(Tag::Link { .. } | Tag::Image { .. }));
        assert!(!acts, "{whose}: {event:?}: {text}");
        if let Event::Html(html) | Event::InlineHtml(html) = event {
            assert!(!html.contains("hostile>"), "{whose}: {html}: {text}");
        }
    }
}

/// Panics if a text in a format lets something of [`HOSTILE`] act.
fn holds(format: &str, text: &str, whose: &str) {
    is_shown(text, whose);
    match format {
        "markdown" => has_no_links(text, whose),
        "html" | "svg" => has_no_markup(text, whose),
        "junit" => {
            has_no_markup(text, whose);
            uppsala::parse(text).unwrap_or_else(|error| panic!("{whose}: {error}: {text}"));
        }
        "json" | "sarif" => drop(
            serde_json::from_str::<serde_json::Value>(text)
                .unwrap_or_else(|error| panic!("{whose}: {error}: {text}")),
        ),
        _ => {}
    }
}

fn streams_hold(format: &str, output: &Output, whose: &str) {
    let out = String::from_utf8_lossy(&output.stdout);
    if !out.is_empty() {
        holds(format, &out, whose);
    }
    is_shown(&String::from_utf8_lossy(&output.stderr), whose);
    assert_ne!(output.status.code(), Some(101), "{whose}");
}

/// A command that has no formats.
const ONE: &[&str] = &["as it is"];

/// The files that other people made.
fn hostile_files(folder: &Path) {
    let mesh = format!(
        "o {HOSTILE}\ng {HOSTILE}\nusemtl {HOSTILE}\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 1\nf 1 2 3\nf 2 4 3\nf 1 1 2\n"
    );
    fs::write(folder.join(format!("{HOSTILE}.obj")), mesh).unwrap();
    let write = |name: &str, text: String| fs::write(folder.join(name), text).unwrap();
    write("unknown.toml", format!("{} = 1\n", quoted(HOSTILE)));
    write("value.toml", format!("kernel = {}\n", quoted(HOSTILE)));
    let case = |name: &str| {
        format!(
            "{{\"name\":{name},\"scalar\":\"f32\",\"origin\":[0.25,0.25,1],\"direction\":[0,0,-1],\"a\":[0,0,0],\"b\":[1,0,0],\"c\":[0,1,0],{}:1}}\n",
            quoted(HOSTILE)
        )
    };
    write(&format!("{HOSTILE}.jsonl"), case(&quoted(HOSTILE)));
    write("unknown.jsonl", case("\"x\""));
    write(
        "rays.csv",
        "0.25 0.25 5 0 0 -1\n0.25 0.25 5 0 0 1\n".to_owned(),
    );
    write("answers.csv", "2,7\n0,1\n".to_owned());
    write("hostile.csv", format!("# {HOSTILE}\n1,{HOSTILE}\n"));
    let named = "{\"name\":\"NAME\",\"scalar\":\"f32\",\"origin\":[0.25,0.25,1],\"direction\":[0,0,-1],\"a\":[0,0,0],\"b\":[1,0,0],\"c\":[0,1,0]}\n";
    write("markup.jsonl", named.replace("\"NAME\"", &quoted(MARKUP)));
    write("unknown.json", format!("{{{}:1}}", quoted(HOSTILE)));
    let digest =
        fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("vectors/sha256.txt"));
    let answers = |id: &str| {
        let (digest, name) = (digest.as_ref().unwrap().trim(), quoted(HOSTILE));
        format!("{{\"vectors\":\"{digest}\",\"product\":{name},\"results\":{{{id}}}}}")
    };
    write(
        "product.json",
        answers("\"front-interior-within-4e62c533e8d11a97\":{\"hit\":true}"),
    );
    write(
        "test.json",
        answers(&format!("{}:{{\"hit\":true}}", quoted(HOSTILE))),
    );
    write(
        "answer.json",
        answers(&format!(
            "\"front-interior-within-4e62c533e8d11a97\":{}",
            quoted(HOSTILE)
        )),
    );
    write("proof.txt", format!("hairline-proof 1\n{HOSTILE}\n"));
    fs::create_dir(folder.join("campaign")).unwrap();
    write(
        "campaign/campaign.json",
        format!("{{\"kernel_cmd\":[{0}],{0}:1}}", quoted(HOSTILE)),
    );
    let hello = "hairline-kernel 1\nname NAME\nscalars f64\ncontract closed-ray\n";
    write(
        "hello-name",
        format!("{}ready\n", hello.replace("NAME", HOSTILE)),
    );
    write("hello-word", format!("{hello}{HOSTILE} 1\n"));
    let gate = |meaning: &str| format!("epsilon parallel 1e-6 2 1 signed {meaning}\n");
    let answering = hello.replace("NAME", "mine") + &gate(HOSTILE);
    write("hello-mine", format!("{answering}source {MARKUP}\nready\n"));
    write("mine.sh", format!("cat hello-mine\n{MISSES}\n"));
    write("hello-answer", format!("{hello}ready\n{HOSTILE}\n"));
}

/// Expectations of a run at the mesh, whose reasons and addresses somebody else wrote.
fn hostile_expectations(folder: &Path) {
    let mesh = format!("{HOSTILE}.obj");
    let run =
        "check -q -n 50 --kernel cramer,moller-trumbore --bless --expectations known.toml --mesh";
    let arguments: Vec<&str> = run.split(' ').chain([mesh.as_str()]).collect();
    let blessed = hairline(folder, &arguments);
    assert_eq!(blessed.status.code(), Some(0), "{blessed:?}");
    let file = folder.join("known.toml");
    let known = fs::read_to_string(&file).unwrap();
    let name = quoted(HOSTILE);
    let reasons = format!(", why = {name}, url = {name} }},");
    let changed = known.replace(" },\n", &(reasons + "\n"));
    assert_ne!(known, changed);
    fs::write(file, changed).unwrap();
}

/// The digest of the mesh, which names its cases.
fn mesh_digest(folder: &Path) -> String {
    let mesh = format!("{HOSTILE}.obj");
    let output = hairline(folder, &["generate", "--mesh", &mesh, "-n", "1"]);
    let cases = String::from_utf8(output.stdout).unwrap();
    let (_, behind) = cases.split_once("mesh=").unwrap();
    behind[..16].to_owned()
}

/// Every command of the program with strings of other people, and the formats that it has.
fn commands(digest: &str) -> Vec<(Vec<String>, &'static [&'static str])> {
    const PAGE: &[&str] = &["text", "json", "markdown", "html"];
    const REPORT: &[&str] = &["text", "json", "markdown", "html", "junit", "sarif"];
    const PLAIN: &[&str] = &[];
    let mesh = format!("{HOSTILE}.obj");
    let corpus = format!("{HOSTILE}.jsonl");
    let on_mesh = "--kernel cramer,moller-trumbore -n 20 --mesh MESH";
    let lines: &[(&str, &'static [&'static str])] = &[
        (&format!("audit {on_mesh}"), REPORT),
        (&format!("audit --details {on_mesh}"), &["text", "markdown"]),
        (
            &format!("epsilon {on_mesh}"),
            &["text", "json", "markdown", "html", "svg"],
        ),
        (
            &format!("check {on_mesh} --expectations known.toml"),
            REPORT,
        ),
        ("offset -n 20 --mesh MESH", PAGE),
        ("mesh MESH --kernel cramer", REPORT),
        (
            "prove --mesh MESH --distance 9 --kernel cramer --scalar f32 -n 0",
            PAGE,
        ),
        ("repair --mesh MESH --kernel cramer -n 20", PLAIN),
        ("prove --check proof.txt", PLAIN),
        ("audit --corpus markup.jsonl --kernel cramer", REPORT),
        ("check --corpus markup.jsonl --kernel cramer", REPORT),
        ("rays MESH --ray 0.25,0.25,5,0,0,-1", PAGE),
        ("rays MESH --ray HOSTILE", PLAIN),
        (
            "rays MESH rays.csv",
            &["text", "json", "markdown", "html", "csv"],
        ),
        ("rays MESH rays.csv --answers answers.csv", PAGE),
        ("rays MESH rays.csv --answers hostile.csv", PLAIN),
        ("rays MESH hostile.csv", PLAIN),
        ("rays MESH unknown.jsonl", PLAIN),
        ("rays MESH --points hostile.csv", PLAIN),
        ("rays MESH --make 3 --kinds HOSTILE", PLAIN),
        ("rays HOSTILE HOSTILE", PLAIN),
        ("boxes audit -k HOSTILE", PLAIN),
        ("boxes audit -n 20 -k ize,bvh", PAGE),
        ("boxes audit -n 20 -k ize,bvh --mesh MESH", PAGE),
        ("boxes audit -n 20 --kernel-lib HOSTILE", PLAIN),
        ("boxes audit -n 20 --kernel-cmd HELLO-name", PLAIN),
        ("boxes epsilon -n 20 -k ize --epsilon HOSTILE", PLAIN),
        ("boxes check -n 20 -k ize --known unknown.toml", PLAIN),
        ("boxes check -n 20 -k ize --known HOSTILE", PLAIN),
        ("boxes prove", PAGE),
        ("boxes prove --least HOSTILE", PLAIN),
        ("boxes explain HOSTILE", PLAIN),
        ("boxes explain {HOSTILE", PLAIN),
        ("boxes explain @HOSTILE", PLAIN),
        ("explain HOSTILE", PLAIN),
        ("explain MARKUP --corpus markup.jsonl", PAGE),
        (
            "explain mesh-edges@2/f32/mesh=DIGEST/1/3 --mesh MESH --kernel cramer",
            PAGE,
        ),
        ("map HOSTILE", PLAIN),
        (
            "map MARKUP --corpus markup.jsonl --size 8 --kernel cramer",
            &["text", "svg"],
        ),
        (
            "map mesh-edges@2/f32/mesh=DIGEST/1/3.0 --mesh MESH --kernel cramer --size 8",
            &["text", "svg"],
        ),
        ("audit -n 10 --family interior --kernel-cmd SHELL", REPORT),
        ("check -n 10 --family interior --kernel-cmd SHELL", REPORT),
        ("epsilon -n 10 --family interior --kernel-cmd SHELL", PLAIN),
        ("list kernels --kernel-cmd SHELL", PLAIN),
        ("audit --corpus CORPUS", PLAIN),
        ("audit --corpus unknown.jsonl", PLAIN),
        ("audit --scene HOSTILE", PLAIN),
        ("audit --scene room,HOSTILE=1", PLAIN),
        ("audit --instance HOSTILE", PLAIN),
        ("audit --contract HOSTILE", PLAIN),
        ("audit --kernel HOSTILE", PLAIN),
        ("audit --family HOSTILE", PLAIN),
        ("audit --epsilon HOSTILE=1", PLAIN),
        ("audit --format HOSTILE", PLAIN),
        ("audit -n 10 --kernel cramer -o nowhere/HOSTILE.json", PLAIN),
        ("audit --HOSTILE", PLAIN),
        ("audit --kernel-lib HOSTILE", PLAIN),
        ("audit --kernel-cmd HOSTILE", PLAIN),
        ("audit -n 10 --kernel-cmd HELLO-name", PLAIN),
        ("audit -n 10 --kernel-cmd HELLO-word", PLAIN),
        ("audit -n 10 --kernel-cmd HELLO-answer", PLAIN),
        ("check --config unknown.toml", PLAIN),
        ("check --config value.toml", PLAIN),
        ("check --record MESH", PLAIN),
        ("list HOSTILE", PLAIN),
        ("fuzz triage CORPUS", PLAIN),
        ("fuzz triage markup.jsonl", PLAIN),
        ("fuzz campaign", PLAIN),
        ("fuzz HOSTILE -n 10 --kernel cramer", PLAIN),
        ("merge MESH HOSTILE", PLAIN),
        ("diff MESH HOSTILE", PLAIN),
        ("generate --family HOSTILE", PLAIN),
        ("generate --mesh MESH -n 3", PLAIN),
        ("truth CORPUS", PLAIN),
        ("truth unknown.jsonl", PLAIN),
        ("truth markup.jsonl", PLAIN),
        ("selfcheck --HOSTILE", PLAIN),
        ("corpus generate HOSTILE/x", PLAIN),
        ("vectors HOSTILE/x --product HOSTILE", PLAIN),
        ("verify product.json", PAGE),
        ("verify test.json", PLAIN),
        ("verify answer.json", PLAIN),
        ("verify unknown.json", PLAIN),
        ("help HOSTILE", PLAIN),
        ("completions HOSTILE", PLAIN),
        ("man HOSTILE", PLAIN),
        ("HOSTILE", PLAIN),
    ];
    let mut all = Vec::new();
    for (line, formats) in lines {
        let words = line.split(' ').map(|word| {
            let word = match word.strip_prefix("HELLO") {
                Some(which) => format!("sh -c 'cat hello{which}; cat > /dev/null'"),
                None => word.replace("SHELL", "sh mine.sh"),
            };
            word.replace("MESH", &mesh)
                .replace("CORPUS", &corpus)
                .replace("DIGEST", digest)
                .replace("MARKUP", MARKUP)
                .replace("HOSTILE", HOSTILE)
        });
        all.push((words.collect(), *formats));
    }
    all
}

#[test]
fn no_string_of_other_people_acts_in_any_command_or_format() {
    let folder = scratch("hostile");
    hostile_files(&folder);
    hostile_expectations(&folder);
    let mut fed = BTreeSet::new();
    let mut silent = Vec::new();
    for (words, formats) in commands(&mesh_digest(&folder)) {
        fed.insert(words[0].clone());
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let formats = if formats.is_empty() { ONE } else { formats };
        for format in formats {
            let asked: &[&str] = if *format == "as it is" {
                &[]
            } else {
                &["--format", format]
            };
            let arguments = [&words[..], asked].concat();
            // On GitHub findings are also annotations, which are lines of their own.
            let on_github = [("GITHUB_ACTIONS", "true")];
            let variables = if *format == "json" {
                &[][..]
            } else {
                &on_github
            };
            let output = hairline_with(&folder, &arguments, variables);
            let whose = format!("{arguments:?}");
            streams_hold(format, &output, &whose);
            if !asked.is_empty() && output.stdout.is_empty() {
                silent.push(format!("{whose}: {output:?}"));
            }
        }
    }
    assert!(silent.is_empty(), "{silent:#?}");
    let help = String::from_utf8(hairline(&folder, &["--help"]).stdout).unwrap();
    let names = help.lines().filter_map(|line| line.strip_prefix("  "));
    for name in names.filter_map(|line| line.split(' ').next()) {
        let is_command = !name.is_empty() && !name.starts_with('-');
        assert!(!is_command || fed.contains(name), "{name} is not fed");
    }
}

/// A record with another string in one of its lines: the value of a key, or an element of a list.
fn with_string(record: &str, line: &str) -> String {
    let (key, value) = line.split_at(
        line.rfind(": \"")
            .map_or(line.len() - line.trim_start().len(), |at| at + 2),
    );
    let comma = if value.ends_with(',') { "," } else { "" };
    record.replacen(line, &format!("{key}{}{comma}", quoted(HOSTILE)), 1)
}

#[test]
fn no_string_of_a_record_acts_in_any_format() {
    let folder = scratch("hostile-record");
    let flags =
        "audit -q -n 60 --kernel cramer,moller-trumbore -f edge-near,tiny,vertex-exact -o r.json";
    let arguments: Vec<&str> = flags.split(' ').collect();
    assert_eq!(hairline(&folder, &arguments).status.code(), Some(0));
    let record = fs::read_to_string(folder.join("r.json")).unwrap();
    let mut kinds = BTreeSet::new();
    let mut shown = 0;
    for line in record.lines() {
        let is_string = line.trim_end_matches(',').ends_with('"');
        let place = line.split(": ").next().unwrap_or(line);
        let kind = if line.contains(": ") {
            place
        } else {
            "element"
        };
        if !is_string || !kinds.insert(kind.to_owned()) {
            continue;
        }
        let changed = with_string(&record, line);
        fs::write(folder.join("x.json"), resealed(&changed)).unwrap();
        for format in ["text", "json", "markdown", "html", "junit", "sarif"] {
            let arguments = ["check", "-q", "--record", "x.json", "--format", format];
            let output = hairline(&folder, &arguments);
            streams_hold(format, &output, line);
            shown += usize::from(!output.stdout.is_empty());
        }
        for arguments in [&["diff", "r.json", "x.json"][..], &["merge", "x.json"]] {
            streams_hold("text", &hairline(&folder, arguments), line);
        }
    }
    assert!(
        10 < kinds.len() && 12 < shown,
        "{} kinds, {shown} shown",
        kinds.len()
    );
}
