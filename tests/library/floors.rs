//! DESIGN's picture is the code's: the `use` lines of each module name only floors below it and
//! neighbours, in no circle, and no two files of a folder import each other.

use proc_macro2::{Spacing, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// A crate as this test sees it.
struct Room {
    /// Its sources.
    source: &'static str,
    /// Its name as a module, if the floors inside it are its own business.
    alone: Option<&'static str>,
    /// Tokens of it, without tests and comments. A cut lowers its number. It is raised only with something new that was
    /// asked for (a kernel, a study, a format), in the same commit, with the reason.
    most_tokens: usize,
}

const fn room(source: &'static str, alone: Option<&'static str>, most_tokens: usize) -> Room {
    Room {
        source,
        alone,
        most_tokens,
    }
}

/// The crates, the lowest first.
const ROOMS: [Room; 19] = [
    // With the test whose margin is known before the ray: `exact`; the table of kernels that are one test (issue 61), and two
    // arithmetics of devices (issue 63). With ends of intervals compared in 256 bits (issue 61).
    room("crates/core/src", None, 90_620),
    room("crates/checker/src", Some("checker"), 31_000),
    room("crates/boxes/src", Some("boxes"), 31_700),
    // New with issue 62: where a ray meets a whole mesh; then instances, which matrices put into the world exactly.
    room("crates/scene/src", Some("scene"), 33_480),
    room("crates/files/src", Some("files"), 24_560),
    room("crates/cases/src", None, 46_060),
    // With chains of gates, which the run of a guarded kernel and its emitted code share (issue 64), and with what has to be known of a
    // gate before a sentence is said of it. With what a guarded kernel looks up once for all its cases (issue 61).
    room("crates/prove/src", Some("prove"), 74_020),
    // With the cases and the names of a source in files of their own: each has its imports.
    room("crates/study/src", None, 81_340),
    room("crates/advice/src", None, 41_900),
    room("crates/explore/src", Some("explore"), 29_100),
    room("crates/plugin/src", Some("plugin"), 20_400),
    // With a plan's part of a record, and its provenance, in files of their own.
    room("crates/record/src", Some("record"), 23_240),
    // With captions of drawings, rows of an explained case, the table and the words of `offset`, numbers and their meaning on a page of
    // epsilons, and a mesh's topology in files of their own: each has its imports. With what the exact test says of itself among kernels.
    room("crates/report/src", Some("report"), 102_600),
    // Of issue 62: answers of programs about whole meshes, read and judged, with pictures; most of it came out of src.
    // Then the scene that a program makes first, transforms of instances as a reason of lost hits, and rays in files with their ends.
    room("crates/rays/src", Some("rays"), 36_450),
    room("crates/expect/src", Some("expect"), 17_800),
    room("crates/vectors/src", Some("vectors"), 11_960),
    // With the names of numbers in a file of their own, and with one comparison for gates in a row (issue 64).
    room("crates/repair/src", Some("repair"), 18_120),
    // The parts that all commands share came out of src.
    room("crates/command/src", Some("command"), 12_100),
    // With issue 61: studies of one test that are reported under several names, and lines that say what slow commands do.
    // With the scene of a command line, and how a certificate is written, in files of their own: each has its imports.
    room("src", None, 100_320),
];

/// The crates' sources, the lowest first.
const CRATES: [&str; ROOMS.len()] = {
    let mut sources = [""; ROOMS.len()];
    let mut i = 0;
    while i < ROOMS.len() {
        sources[i] = ROOMS[i].source;
        i += 1;
    }
    sources
};

fn source(of_crate: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join(of_crate)
}

/// Every Rust file of a crate, and its place in it.
fn rust_files(of_crate: &str) -> Vec<(PathBuf, PathBuf)> {
    let source = source(of_crate);
    let all = files(&source)
        .into_iter()
        .filter(|file| file.extension().is_some_and(|e| e == "rs"));
    all.map(|file| (file.clone(), file.strip_prefix(&source).unwrap().to_owned()))
        .collect()
}

/// Every file under a folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    entries
        .flat_map(|path| {
            if path.is_dir() {
                files(&path)
            } else {
                vec![path]
            }
        })
        .collect()
}

/// A file's text without the tests at its end.
fn shipped(text: &str) -> &str {
    text.split("#[cfg(test)]\nmod tests {").next().unwrap()
}

/// A file's text without comments and without what only tests compile.
fn code(file: &Path) -> String {
    let text = fs::read_to_string(file).unwrap();
    let lines = shipped(&text)
        .lines()
        .map(|line| line.split("//").next().unwrap());
    lines.collect::<Vec<_>>().join("\n").replace("$crate::", "")
}

/// The names that stand after `prefix`, one or several in braces.
fn names_after(text: &str, prefix: &str) -> BTreeSet<String> {
    let word = |text: &str| -> String {
        text.chars()
            .take_while(|c| c.is_ascii_lowercase() || "_0123456789".contains(*c))
            .collect()
    };
    let mut names = BTreeSet::new();
    for rest in text.split(prefix).skip(1) {
        let Some(list) = rest.strip_prefix('{') else {
            names.insert(word(rest));
            continue;
        };
        let (mut depth, mut start) = (0, true);
        for (i, c) in list.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => start = true,
                c if start && !c.is_whitespace() => {
                    names.insert(word(&list[i..]));
                    start = false;
                }
                _ => {}
            }
        }
    }
    names.remove("");
    names
}

/// The `mod` lines of a crate's `lib.rs`, in blocks between blank lines.
fn floors_within(of_crate: &str) -> Vec<BTreeSet<String>> {
    let module = |line: &str| {
        let line = line.strip_prefix("pub ").unwrap_or(line);
        Some(line.strip_prefix("mod ")?.strip_suffix(';')?.to_owned())
    };
    let text = code(&source(of_crate).join("lib.rs"));
    text.split("\n\n")
        .map(|block| block.lines().filter_map(module).collect())
        .collect()
}

/// The floors, the lowest first: those of the crates. A crate that is seen alone is one module with its name.
fn floors() -> Vec<BTreeSet<String>> {
    let mut floors = Vec::new();
    for Room { source, alone, .. } in ROOMS {
        match alone {
            Some(name) => floors.push(BTreeSet::from([name.to_owned()])),
            None => floors.extend(floors_within(source)),
        }
    }
    floors
        .iter_mut()
        .for_each(|floor| floor.retain(|name| name != "internals"));
    floors.retain(|floor| !floor.is_empty());
    floors
}

/// What each module of some crates uses of the others.
fn uses_within(crates: &[&str]) -> BTreeMap<String, BTreeSet<String>> {
    let mut uses: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (file, place) in crates.iter().copied().flat_map(rust_files) {
        let module = place
            .iter()
            .next()
            .unwrap()
            .to_str()
            .unwrap()
            .trim_end_matches(".rs");
        if ["lib", "main", "internals"].contains(&module) || place.ends_with("tests.rs") {
            continue;
        }
        uses.entry(module.to_owned())
            .or_default()
            .extend(names_after(&code(&file), "crate::"));
    }
    for (module, used) in &mut uses {
        used.remove(module);
    }
    uses
}

/// What each module uses of the others.
fn uses() -> BTreeMap<String, BTreeSet<String>> {
    let open = ROOMS.iter().filter(|room| room.alone.is_none());
    let sources: Vec<&str> = open.map(|room| room.source).collect();
    let mut uses = uses_within(&sources);
    let crates: BTreeSet<String> = alone().map(|(name, _)| name.to_owned()).collect();
    for (name, source) in alone() {
        let mut used = BTreeSet::new();
        for (file, _) in rust_files(source) {
            let code = code(&file);
            used.extend(names_after(&code, "hairline_core::"));
            used.extend(names_after(&code, "hairline_study::"));
            let others = names_after(&code, "hairline_");
            used.extend(others.intersection(&crates).cloned());
        }
        used.remove(name);
        uses.insert(name.to_owned(), used);
    }
    uses
}

/// The crates that are seen alone, by name, and their sources.
fn alone() -> impl Iterator<Item = (&'static str, &'static str)> {
    ROOMS
        .iter()
        .filter_map(|room| Some((room.alone?, room.source)))
}

#[test]
fn every_module_uses_only_floors_below_it_and_neighbours_that_do_not_use_it() {
    let (floors, uses) = (floors(), uses());
    assert!(
        floors.len() > 5 && floors[0].contains("arith"),
        "{floors:?}"
    );
    assert_eq!(
        floors.iter().map(BTreeSet::len).sum::<usize>(),
        uses.len(),
        "{floors:?}"
    );
    check_floors(&floors, &uses);
}

#[test]
fn crates_that_say_so_have_floors_of_their_own() {
    for source in [
        "crates/boxes/src",
        "crates/command/src",
        "crates/files/src",
        "crates/explore/src",
        "crates/record/src",
        "crates/report/src",
        "crates/scene/src",
        "crates/repair/src",
        "crates/vectors/src",
    ] {
        let (floors, mut uses) = (floors_within(source), uses_within(&[source]));
        assert!(5 < uses.len(), "{source}: {uses:?}");
        // The crates below have floors of their own.
        let lib = code(&self::source(source).join("lib.rs"));
        let below = names_of_other_crates(&lib);
        for used in uses.values_mut() {
            used.retain(|name| !below.contains(name));
        }
        check_floors(&floors, &uses);
    }
}

/// The names under which a crate's `lib.rs` knows other crates of the house, and their modules.
fn names_of_other_crates(lib: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for rest in lib.split("use hairline_").skip(1) {
        let line = rest.split(';').next().unwrap();
        match (line.split_once(" as "), line.split_once("::")) {
            (Some((_, name)), _) => names.extend([name.to_owned()]),
            (None, Some((krate, _))) => names.extend(names_after(line, &format!("{krate}::"))),
            (None, None) => {}
        }
    }
    names
}

fn check_floors(floors: &[BTreeSet<String>], uses: &BTreeMap<String, BTreeSet<String>>) {
    let floor = |name: &str| floors.iter().position(|floor| floor.contains(name));
    for (module, used) in uses {
        for other in used {
            assert!(
                floor(other).is_some(),
                "{module} uses crate::{other}, which is no module"
            );
            assert!(
                floor(other) <= floor(module),
                "{module} uses {other}, which is above it"
            );
        }
    }
    // Whatever a module reaches does not reach it.
    for module in uses.keys() {
        let mut reached = BTreeSet::new();
        let mut next: Vec<&String> = uses[module].iter().collect();
        while let Some(other) = next.pop() {
            if reached.insert(other) {
                next.extend(&uses[other]);
            }
        }
        assert!(
            !reached.contains(module),
            "{module} uses itself by way of others"
        );
    }
}

/// How far below its number a crate may be before the number has to follow.
const SLACK: usize = 1_000;

/// How many tokens a text has: words, literals, and operators of one or several characters.
fn tokens(text: &str) -> usize {
    let stream: TokenStream = text.parse().expect("Rust");
    count(stream)
}

fn count(stream: TokenStream) -> usize {
    let mut all = 0;
    let mut trees = stream.into_iter().peekable();
    while let Some(tree) = trees.next() {
        match tree {
            // A doc comment is an attribute here: `#[doc = "…"]`, or `#![doc = "…"]`.
            TokenTree::Punct(mark) if mark.as_char() == '#' => {
                let inner = trees.next_if(|next| next.to_string() == "!");
                if trees.next_if(is_doc_comment).is_none() {
                    all += 1 + usize::from(inner.is_some());
                }
            }
            TokenTree::Punct(mark) if mark.spacing() == Spacing::Joint => {}
            TokenTree::Punct(_) | TokenTree::Ident(_) | TokenTree::Literal(_) => all += 1,
            TokenTree::Group(group) => all += 2 + count(group.stream()),
        }
    }
    all
}

fn is_doc_comment(tree: &TokenTree) -> bool {
    let TokenTree::Group(group) = tree else {
        return false;
    };
    let mut inside = group.stream().into_iter();
    inside.next().is_some_and(|word| word.to_string() == "doc")
        && inside.next().is_some_and(|mark| mark.to_string() == "=")
}

#[test]
fn tokens_are_counted_without_comments() {
    let text = "//! Of `a`.\n/// Of `b`.\n#[inline]\nfn f(x: f64) -> bool { x >= 1.0 /* all */ }";
    // # [ inline ] fn f ( x : f64 ) -> bool { x >= 1.0 }
    assert_eq!(tokens(text), 18);
}

#[test]
fn no_crate_grows() {
    let mut wrong = Vec::new();
    for room in ROOMS {
        let (of_crate, most) = (room.source, room.most_tokens);
        let is_test = |place: &Path| {
            place
                .iter()
                .any(|part| part == "tests" || part == "tests.rs")
        };
        let mut all = 0;
        for (file, place) in rust_files(of_crate) {
            if !is_test(&place) {
                all += tokens(shipped(&fs::read_to_string(file).unwrap()));
            }
        }
        if most < all {
            wrong.push(format!("{of_crate}: {all} tokens, more than {most}"));
        } else if all + SLACK <= most {
            wrong.push(format!(
                "{of_crate}: {all} tokens: lower its number, {most}"
            ));
        }
    }
    assert_eq!(wrong, [""; 0]);
}

#[test]
fn no_two_files_of_a_folder_import_each_other() {
    let mut uses: BTreeMap<(PathBuf, String), BTreeSet<String>> = BTreeMap::new();
    for (file, _) in CRATES.into_iter().flat_map(rust_files) {
        let (folder, stem) = (
            file.parent().unwrap(),
            file.file_stem().unwrap().to_str().unwrap(),
        );
        if !["mod", "tests", "lib", "main"].contains(&stem) {
            uses.insert(
                (folder.to_owned(), stem.to_owned()),
                names_after(&code(&file), "super::"),
            );
        }
    }
    let mutual: Vec<String> = uses
        .iter()
        .flat_map(|((folder, one), used)| {
            let both = used.iter().filter(move |other| one < *other);
            let both = both.filter(|other| {
                uses.get(&(folder.clone(), (*other).clone()))
                    .is_some_and(|back| back.contains(one))
            });
            both.map(|other| format!("{}: {one} and {other}", folder.display()))
                .collect::<Vec<_>>()
        })
        .collect();
    assert!(uses.len() > 150);
    assert_eq!(mutual, Vec::<String>::new());
}

#[test]
fn names_are_found_alone_and_in_braces() {
    let text = "use crate::one::Two;\nuse crate::{three, four::{Five, six}, seven::Eight};";
    let names: Vec<String> = names_after(text, "crate::").into_iter().collect();
    assert_eq!(names, ["four", "one", "seven", "three"]);
}

#[test]
fn below_the_command_line_nothing_prints_opens_files_or_reads_a_clock() {
    let forbidden = [
        "println!",
        "print!(",
        "eprint",
        "File::open",
        "File::create",
        "fs::",
        "Instant::now",
        "SystemTime",
    ];
    for (file, place) in CRATES.into_iter().flat_map(rust_files) {
        // The parts that commands share are of the command line. A kernel's process is a kernel: it has pipes, patience and a
        // clock. A user's test has its files.
        let is_test = place.components().any(|part| part.as_os_str() == "tests");
        let may = place.starts_with("cli") || is_test || file.starts_with(source("crates/plugin"));
        let may = may || file.starts_with(source("crates/command"));
        let may = may || place.ends_with("conformance/expectations.rs");
        if may || place.ends_with("main.rs") {
            continue;
        }
        let code = code(&file);
        for word in forbidden {
            assert!(!code.contains(word), "{}: {word}", place.display());
        }
    }
}

/// No job without Node.js notices when a file moves that the lab is made of.
#[test]
fn files_that_the_lab_takes_from_the_crates_are_there() {
    let web = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../web");
    let mut taken = 0;
    for name in ["lab.css", "bundle.mjs"] {
        let text = fs::read_to_string(web.join(name)).unwrap();
        for word in text.split('"').filter(|word| word.starts_with("../")) {
            assert!(web.join(word).is_file(), "web/{name} takes {word}");
            taken += 1;
        }
    }
    assert_eq!(taken, 3);
}

/// The languages of code in comments that rustdoc would test: none is named, or Rust.
fn has_doc_tests(text: &str) -> bool {
    let mut is_inside = false;
    for line in text.lines() {
        let comment = line
            .trim_start()
            .trim_start_matches("//")
            .trim_start_matches(['/', '!']);
        let Some(language) = comment.trim_start().strip_prefix("```") else {
            continue;
        };
        if !is_inside && matches!(language.trim(), "" | "rust" | "no_run" | "should_panic") {
            return true;
        }
        is_inside = !is_inside;
    }
    false
}

/// Manifests turn off what takes time to build and runs nothing.
#[test]
fn a_crate_whose_tests_are_turned_off_has_none() {
    let mut turned_off = 0;
    for folder in CRATES {
        let manifest = fs::read_to_string(source(folder).join("../Cargo.toml")).unwrap();
        let library = manifest.split("\n[lib]\n").nth(1).unwrap_or_default();
        let library = library.split("\n[").next().unwrap();
        let is_off = |what: &str| {
            library
                .lines()
                .any(|line| line == format!("{what} = false"))
        };
        for (file, _) in rust_files(folder) {
            let text = fs::read_to_string(&file).unwrap();
            let has_tests = text.contains("#[test]") || text.contains("proptest! {");
            assert!(!(is_off("test") && has_tests), "{}", file.display());
            assert!(
                !(is_off("doctest") && has_doc_tests(&text)),
                "{}",
                file.display()
            );
        }
        turned_off += usize::from(is_off("test")) + usize::from(is_off("doctest"));
    }
    assert!(0 < turned_off);
}

#[test]
fn code_in_comments_is_a_test_unless_it_says_otherwise() {
    assert!(has_doc_tests("/// ```\n/// f();\n/// ```"));
    assert!(has_doc_tests(
        "//! ```text\n//! x\n//! ```\n//! ```rust\n//! ```"
    ));
    assert!(!has_doc_tests(
        "//! ```text\n//! x\n//! ```\nlet text = \"```\";"
    ));
}
