//! The checker of certificates accepts what the prover writes and nothing that differs from it in a number.

use hairline::internals::arith::Real;
use hairline::internals::arith::recorded::Operation;
use hairline::internals::kernel::{self, Path, Scalar};
use hairline::internals::prove::certificate::{self, Claim, Heading};
use hairline::internals::prove::checker::{Number, check};
use hairline::internals::prove::{Domain, Dyadic, Format, Prover, Symmetry, is_impossible};
use num_traits::Signed;
use std::collections::BTreeSet;

/// The first path of a kernel that an input may take.
fn path<F: Scalar>(kernel: &str) -> Path {
    let entry = kernel::find(kernel).unwrap();
    let paths = F::subject(entry).unwrap().gated().unwrap().paths().unwrap();
    paths.into_iter().find(|path| !is_impossible(path)).unwrap()
}

/// A certificate of bounds of some numbers.
fn certificate_of(path: &Path, scalar: &str, domain: Domain, places: &[u32]) -> String {
    let format = if scalar == "f32" { Format::F32 } else { Format::F64 };
    let mut prover = Prover::new(path, domain, format);
    for place in places {
        prover.bound(*place).unwrap();
    }
    let claim = |place: &u32| Claim { gate: "gate", place: *place, symmetry: Symmetry::None };
    let claims: Vec<_> = places.iter().map(claim).collect();
    certificate::heading(&Heading { kernel: "kernel", scalar, format })
        + &certificate::domain(&domain)
        + &certificate::program(path, &prover.lemmas, &claims)
}

/// Everything that the gates of a kernel compare and that has a bound.
fn quantities<F: Scalar>(kernel: &str, scalar: &str) -> String {
    let path = path::<F>(kernel);
    let format = if scalar == "f32" { Format::F32 } else { Format::F64 };
    let mut prover = Prover::new(&path, Domain::UNIT, format);
    let all = path.compared.iter().flat_map(|compared| compared.quantities.clone());
    let places: Vec<u32> = all.filter(|place| prover.bound(*place).is_ok()).collect();
    certificate_of(&path, scalar, Domain::UNIT, &places)
}

/// The quotients of the edges ab and ac by one area, two along one axis and two along another.
fn rows_of(path: &Path) -> [u32; 4] {
    let text = certificate::program(path, &[], &[]);
    let operations = text.lines().filter_map(|line| line.strip_prefix("op "));
    let quotients = operations.filter(|line| line.split(' ').nth(1) == Some("div"));
    let of = |i: usize| -> u32 {
        let line = quotients.clone().nth(i).unwrap();
        line.split(' ').next().unwrap().parse().unwrap()
    };
    // Each row is divided one coefficient after the other, and the last ones are no edges.
    [of(0), of(3), of(1), of(4)]
}

/// Short certificates with every rule in them, and the domain's names that do not matter to each.
fn samples() -> Vec<(&'static str, String, &'static [&'static str])> {
    let first = |text: &str, word: &str, count: usize| -> Vec<u32> {
        let operations = text.lines().filter_map(|line| line.strip_prefix("op "));
        let found = operations.filter(|line| line.split(' ').nth(1) == Some(word));
        found.take(count).map(|line| line.split(' ').next().unwrap().parse().unwrap()).collect()
    };
    let program = |path: &Path| certificate::program(path, &[], &[]);
    // A determinant by differences, in f64.
    let triple = path::<f64>("scalar-triple");
    let triple_places = &triple.compared[0].quantities;
    // A unit vector, and a formula that is linear in it.
    let plane = path::<f32>("plane-unit-normal");
    let plane_places: Vec<u32> = first(&program(&plane), "abs", 1);
    // Quotients by the largest coordinate of the direction, and a shear of errors that grow with it.
    let woop = path::<f32>("woop-watertight");
    let woop_places = &first(&program(&woop), "div", 3)[..];
    let sheared: Vec<u32> = woop_places.iter().copied().chain([48]).collect();
    // Quotients of differences that are sums of variables.
    let baldwin = path::<f32>("baldwin-weber");
    let baldwin_places = first(&program(&baldwin), "div", 6);
    // Two of them along one axis, whose sum is a quotient of the third edge; beside that, the other axis.
    let mut rows = baldwin.clone();
    let [p, q, r, s] = rows_of(&baldwin);
    let last = rows.operations.len() as u32;
    rows.operations.extend([
        Operation::Add(p, q),
        Operation::Add(r, s),
        Operation::Add(last, last + 1),
    ]);
    let rows_places = [last + 2];
    // So low that the order of the direction's coordinates is needed.
    let low = Domain { floor: Dyadic::power(-8), quotient: Dyadic::power(2), ..Domain::UNIT };
    vec![
        (
            "triple",
            certificate_of(&triple, "f64", Domain::UNIT, triple_places),
            &["edge", "world", "extent", "direction-floor", "floor", "quotient"],
        ),
        (
            "plane",
            certificate_of(&plane, "f32", Domain::UNIT, &plane_places),
            &["reach", "world", "extent", "direction-floor", "quotient"],
        ),
        (
            "woop",
            certificate_of(&woop, "f32", low, &sheared),
            &["edge", "world", "extent", "floor", "quotient"],
        ),
        (
            "baldwin",
            certificate_of(&baldwin, "f32", Domain::UNIT, &baldwin_places),
            &["reach", "direction", "extent", "direction-floor"],
        ),
        (
            "rows",
            certificate_of(&rows, "f32", Domain::UNIT, &rows_places),
            &["reach", "world", "direction", "extent", "direction-floor"],
        ),
    ]
}

/// The operations that the claims of a certificate depend on.
fn used(text: &str) -> BTreeSet<usize> {
    let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(' ').collect()).collect();
    let number = |word: &str| word.parse::<usize>().unwrap();
    let claims = lines.iter().filter(|words| words[0] == "claim");
    let mut used: BTreeSet<usize> = claims.map(|words| number(words[2])).collect();
    for words in lines.iter().filter(|words| words[0] == "op").rev() {
        if used.contains(&number(words[1])) && !["input", "number"].contains(&words[2]) {
            used.extend(words[3..].iter().map(|word| number(word)));
        }
    }
    used
}

/// The text with each whole number one larger and one smaller: line, column and result.
fn mutants(text: &str) -> Vec<(usize, usize, String)> {
    let bytes = text.as_bytes();
    let (mut mutants, mut line, mut column, mut i) = (Vec::new(), 0, 0, 0);
    while i < bytes.len() {
        (line, column) = match bytes[i] {
            b'\n' => (line + 1, 0),
            b' ' => (line, column + 1),
            _ => (line, column),
        };
        if !bytes[i].is_ascii_digit() {
            i += 1;
            continue;
        }
        let start = if bytes[i - 1] == b'-' { i - 1 } else { i };
        while i < bytes.len() && bytes[i].is_ascii_digit() {
            i += 1;
        }
        let value: i128 = text[start..i].parse().unwrap();
        for changed in [value - 1, value + 1] {
            mutants.push((line, column, format!("{}{changed}{}", &text[..start], &text[i..])));
        }
    }
    mutants
}

#[test]
fn what_the_prover_writes_is_accepted() {
    for kernel in
        ["scalar-triple-two-sided", "moller-trumbore", "plucker", "baldwin-weber", "cramer"]
    {
        for text in [quantities::<f32>(kernel, "f32"), quantities::<f64>(kernel, "f64")] {
            let proved = check(&text).unwrap_or_else(|refusal| panic!("{kernel}: {refusal}"));
            assert_eq!(proved.len(), text.matches("\nclaim ").count());
        }
    }
    for (name, text, _) in samples() {
        check(&text).unwrap_or_else(|refusal| panic!("{name}: {refusal}"));
    }
}

/// The bounds of the first operation of a kernel that multiplies twice and subtracts in wider arithmetic.
fn wide_difference<F: Scalar>(scalar: &str) -> String {
    let entry = kernel::find("woop-watertight").unwrap();
    let paths = F::subject(entry).unwrap().gated().unwrap().paths().unwrap();
    let place = |path: &Path| {
        let is_wide = |operation: &Operation| matches!(operation, Operation::Minor(..));
        path.operations.iter().position(is_wide)
    };
    let path = paths.iter().find(|path| !is_impossible(path) && place(path).is_some()).unwrap();
    certificate_of(path, scalar, Domain::UNIT, &[place(path).unwrap() as u32])
}

#[test]
fn a_difference_of_products_is_rounded_twice_in_f64() {
    let [single, double] = [wide_difference::<f32>("f32"), wide_difference::<f64>("f64")];
    let [single, double] = [check(&single), check(&double)];
    let [single, double] = [single, double].map(|proved| proved.unwrap().remove(0).bound.error);
    // Apart from that, the errors differ by 2^-29.
    assert!(double * Number::from_integer((1i64 << 29).into()) > single);
    // A result below 2 that is wrong by nearly 2u, twice what one rounding may cost.
    let exact = |x: f64| Number::from_float(x).unwrap();
    let digits = [0x13411b4d2cd965u64, 0x1f2bee19622db6, 0x1fba5f0d32f012, 0x16f08d216d65ac];
    let [a, b, c, d] = digits.map(|digits| digits as f64 / (1u64 << 53) as f64);
    let computed = f64::difference_of_products(&a, &b, &-c, &d);
    let error = exact(computed) - (exact(a) * exact(b) + exact(c) * exact(d));
    let hundredths = Number::from_integer((100i64 << 46).into()) * Number::from_integer(128.into());
    assert!(computed < 2.0 && Number::from_integer(199.into()) < error.abs() * hundredths);
}

#[test]
fn a_number_that_is_off_by_one_is_refused() {
    for (name, text, free) in samples() {
        let lines: Vec<Vec<&str>> = text.lines().map(|line| line.split(' ').collect()).collect();
        let used = used(&text);
        let mutants = mutants(&text);
        assert!(400 < mutants.len());
        for (line, column, mutant) in mutants.iter().filter(|(_, _, mutant)| check(mutant).is_ok())
        {
            let words = &lines[*line];
            // What remains is the true certificate of another statement.
            let is_other_statement = match words[0] {
                // A bound of the domain that no lemma uses.
                "domain" => free.contains(&words[column - 1]),
                // An operation that no claim depends on.
                "op" => !used.contains(&words[1].parse().unwrap()),
                // Another path of the same operations. The test below drops the decisions that matter.
                "decision" => true,
                // Another number with a lemma.
                "claim" => true,
                _ => false,
            };
            let changed = mutant.lines().nth(*line).unwrap();
            assert!(
                is_other_statement,
                "{name}, line {}: accepted {changed}, was {words:?}",
                line + 1
            );
        }
    }
}

#[test]
fn a_sign_of_the_corner_or_a_line_less_is_refused() {
    for (name, text, _) in samples() {
        let used = used(&text);
        let lines: Vec<&str> = text.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            if let Some(signs) = line.strip_prefix("corner ") {
                for v in 0..signs.len() {
                    let mut flipped = signs.as_bytes().to_vec();
                    flipped[v] = if flipped[v] == b'+' { b'-' } else { b'+' };
                    let mut changed: Vec<String> =
                        lines.iter().map(|line| line.to_string()).collect();
                    changed[i] = format!("corner {}", String::from_utf8(flipped).unwrap());
                    assert!(check(&changed.join("\n")).is_err(), "{name}: {}", changed[i]);
                }
            }
            let last_operation = lines.iter().rfind(|line| line.starts_with("op ")).unwrap();
            let is_free = line.starts_with("decision ")
                || line.starts_with("claim ")
                || line == last_operation && !used.contains(&(text.matches("\nop ").count() - 1));
            let rest: Vec<&str> = [&lines[..i], &lines[i + 1..]].concat();
            assert!(is_free || check(&rest.join("\n")).is_err(), "{name}: without {line}");
            // Cut off here.
            assert!(check(&lines[..i].join("\n")).is_err(), "{name}: up to line {i}");
        }
    }
}

#[test]
fn a_lemma_less_is_refused() {
    for (name, text, _) in samples() {
        let starts: Vec<usize> = text.match_indices("\nlemma ").map(|(at, _)| at).collect();
        for at in starts {
            let end =
                ["\nlemma ", "\nclaim "].iter().filter_map(|word| text[at + 1..].find(word)).min();
            let rest = text[..at].to_owned() + &text[at + 1 + end.unwrap()..];
            assert!(check(&rest).is_err(), "{name}: {}", &text[at..at + 20]);
        }
    }
}

fn sample(name: &str) -> String {
    samples().into_iter().find(|(known, _, _)| *known == name).unwrap().1
}

fn refusal(text: &str) -> String {
    check(text).expect_err("it is accepted").to_string()
}

#[test]
fn an_order_that_no_decision_states_is_refused() {
    let text = sample("woop");
    let without: Vec<&str> =
        text.lines().filter(|line| !line.starts_with("decision less")).collect();
    assert!(check(&without.join("\n")).is_err());
    // The answer counts, and that the sizes are compared.
    let opposite = text.replacen("decision less 18 19 no", "decision less 18 19 yes", 1);
    let unsized_inputs = text.replacen("decision less 18 19 no", "decision less 3 4 no", 1);
    for changed in [opposite, unsized_inputs] {
        assert_ne!(changed, text);
        assert!(check(&changed).is_err());
    }
}

#[test]
fn a_bound_whose_way_overflows_is_refused() {
    // A reciprocal overflows, though the product with it does not.
    let tiny = Dyadic::power(-130);
    let domain = Domain { direction: tiny, direction_floor: tiny, reach: tiny, ..Domain::UNIT };
    let path = path::<f32>("woop-watertight");
    let is_reciprocal = |place: u32| matches!(path.operations[place as usize], Operation::Div(one, _) if path.operations[one as usize] == Operation::Number(1));
    let is_product = |op: &Operation| matches!(op, Operation::Mul(a, _) if is_reciprocal(*a));
    let place = path.operations.iter().position(is_product).unwrap() as u32;
    // The prover may refuse it too.
    if Prover::new(&path, domain, Format::F32).bound(place).is_ok() {
        let text = certificate_of(&path, "f32", domain, &[place]);
        assert!(refusal(&text).ends_with("which may overflow"), "{}", refusal(&text));
    }
}

/// A certificate of the same in a format whose numbers are finite below 2^largest.
fn with_largest(text: &str, largest: i32) -> String {
    let line = |word: &str| text.lines().find(|line| line.starts_with(word)).unwrap();
    let (format, kernel) = (line("format "), line("kernel "));
    let (rest, _) = format.rsplit_once(' ').unwrap();
    let text = text.replacen(format, &format!("{rest} {largest}"), 1);
    text.replacen(kernel, "kernel k float", 1)
}

#[test]
fn a_unit_vector_whose_way_overflows_is_refused() {
    let path = path::<f32>("plane-unit-normal");
    let is_root = |operation: &Operation| matches!(operation, Operation::Sqrt(_));
    let root = path.operations.iter().position(is_root).unwrap() as u32;
    // The root, its reciprocal, and the first coordinate.
    let place = root + 2;
    let small = Domain { edge: Dyadic::power(-3), floor: Dyadic::power(-6), ..Domain::UNIT };
    // The squares of the normal are at most 12, of the small one much less; but its reciprocal may be above 64.
    for (domain, largest) in [(Domain::UNIT, 4), (small, 7)] {
        let text = certificate_of(&path, "f32", domain, &[place]);
        let accepted = check(&with_largest(&text, largest));
        assert!(accepted.is_ok(), "{accepted:?}");
        let message = refusal(&with_largest(&text, largest - 1));
        let lemma = format!("lemma {place} unit");
        let line = 1 + text.lines().position(|line| line == lemma).unwrap();
        assert!(message.starts_with(&format!("line {line}: ")), "{message}");
        assert!(message.ends_with("which may overflow"), "{message}");
    }
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let text = sample("triple");
    let line = |word: &str| 1 + text.lines().position(|line| line.starts_with(word)).unwrap();
    assert_eq!(refusal(""), "line 1: found the end of the file, expected `hairline proof 1`");
    let domain = line("domain");
    let cyclic = text.replacen(
        "\nvariable ",
        "\nvariable difference 1 0 0\nvariable difference 0 1 0\nvariable ",
        1,
    );
    assert!(refusal(&cyclic).contains("expected an independent one"), "{}", refusal(&cyclic));
    let first = text.lines().find(|line| line.starts_with("first ")).unwrap();
    let message = refusal(&text.replacen(first, "first 1*2^-60", 1));
    assert!(
        message.starts_with(&format!("line {}: found `first 1*2^-60`", line("first "))),
        "{message}"
    );
    let negative = text.replacen("edge 1", "edge -1", 1);
    assert!(refusal(&negative).starts_with(&format!("line {domain}: ")));
    let claimed = text.replace("\nclaim gate ", "\nclaim gate 0\nclaim gate ");
    assert!(refusal(&claimed).contains("expected one with a lemma above"));
    // A product of a number with itself is not affine in it.
    let square = "hairline proof 1\nkernel k f32\nformat 24 -149 127\ndomain edge 1 reach 1 world 1 \
        direction 1 extent 1 direction-floor 1 floor 1 quotient 1\nprogram\nop 0 input 3\nop 1 mul 0 0\n\
        lemma 1 sum\nvariable direction 0\nstep 0 variables +0\nstep 1 mul 0 0\n";
    assert_eq!(
        refusal(square),
        "line 11: found `step 1 mul 0 0`, expected factors without a variable in common"
    );
    let other = square.replace("mul 0 0\n", "add 0 0\n").replace("op 1 add", "op 1 mul");
    assert_eq!(
        refusal(&other),
        "line 11: found `step 1 add 0 0`, expected the operation of the program with its operands"
    );
}

#[test]
fn a_number_that_may_overflow_is_refused() {
    let text = sample("triple");
    // The number itself is at most 3.992.
    let with = |largest: i32| with_largest(&text, largest);
    assert!(check(&with(2)).is_ok());
    let message = refusal(&with(1));
    assert!(message.contains("which may overflow"), "{message}");
}

#[test]
fn a_direction_is_no_point() {
    let text = "hairline proof 1\nkernel k f32\nformat 24 -149 127\ndomain edge 1 reach 1 world 1 direction 1 \
        extent 1 direction-floor 1 floor 1 quotient 1\nprogram\nop 0 input 3\nop 1 input 0\nop 2 sub 0 1\n\
        lemma 2 sum\nvariable direction 0\nvariable point 0 0\nstep 2 variables +0 -1\n";
    let message = refusal(text);
    assert!(message.starts_with("line 12: found `step 2 variables +0 -1`"), "{message}");
}

#[test]
fn hostile_text_is_refused_at_once() {
    let text = sample("plane");
    let long = "9".repeat(1 << 16);
    for (from, to) in [
        ("edge 1", "edge 1*2^999999999"),
        ("edge 1", "edge 1*2^4096"),
        ("edge 1", "edge é"),
        ("format 24 -149 127", "format 60 -2048 2048"),
        ("op 0 input 0", "op 0 input 18446744073709551615"),
        ("op 0 input 0", "op 18446744073709551616 input 0"),
        ("step 18 variables +0", "step 18 variables"),
        ("step 18 variables +0", "step 18 variables é"),
        ("step 18 variables +0", "step"),
        ("corner ", "corner \u{0}"),
        ("size ", &long),
    ] {
        assert!(text.contains(from), "{from}");
        assert!(check(&text.replacen(from, to, 1)).is_err(), "{to}");
    }
    let many = "variable quotient\n".repeat(40);
    let message = refusal(&sample("woop").replacen("variable quotient\n", &many, 1));
    assert!(message.contains("found more than 32 variables"), "{message}");
    assert!(check(&"\n".repeat(1 << 23)).is_err());
    // Any byte may change to any other, and any piece may be missing: never a panic.
    let mut state = 1u64;
    let mut random = |end: usize| {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 33) as usize % end
    };
    for _ in 0..400 {
        let mut bytes = text.clone().into_bytes();
        let at = random(bytes.len());
        match random(3) {
            0 => bytes[at] = b" \n+-*^0123456789quv"[random(19)],
            1 => drop(bytes.drain(at..(at + random(40)).min(text.len()))),
            _ => bytes.insert(at, bytes[random(text.len())]),
        }
        let _ = check(&String::from_utf8_lossy(&bytes));
    }
}

#[test]
fn the_stored_certificates_in_f32_are_accepted() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("corpora/proofs");
    let (mut accepted, mut numbers) = (0, 0);
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if name.ends_with("-f32.proof") && !name.contains('+') {
            let text = std::fs::read_to_string(&path).unwrap();
            check(&text).unwrap_or_else(|refusal| panic!("{name}: {refusal}"));
            accepted += 1;
            let is_number = |line: &&str| line.starts_with("step ") && line.contains(" number ");
            numbers += text.lines().filter(is_number).count();
        }
    }
    // The samples above have no step that is a number.
    assert!(5 < accepted && 5 < numbers, "{accepted} with {numbers} numbers");
}

#[test]
fn a_length_that_may_be_rounded_to_zero_is_refused() {
    let text = sample("plane");
    let domain = text.lines().find(|line| line.starts_with("domain ")).unwrap();
    let mut words: Vec<&str> = domain.split(' ').collect();
    let floor = words.iter().position(|word| *word == "floor").unwrap() + 1;
    // Less than the length's own error, which is about 2^-22.
    words[floor] = "1*2^-60";
    let error = refusal(&text.replacen(domain, &words.join(" "), 1));
    assert!(error.contains("found a length that may be rounded to zero"), "{error}");
}

#[test]
fn a_root_of_more_or_less_than_three_squares_is_no_length() {
    let text = sample("plane");
    let program = ["op 33 mul 25 25", "op 34 mul 28 28", "op 37 add 35 36"];
    for changed in [
        // Of three squares and the number 1; of four; of two.
        ["op 33 fma 25 25 32", "op 34 fma 28 28 33", "op 37 fma 31 31 34"],
        ["op 33 mul 25 25", "op 34 fma 28 28 33", "op 37 add 34 35"],
        ["op 33 mul 25 25", "op 34 mul 28 28", "op 37 add 33 34"],
    ] {
        let mut other = text.clone();
        for (from, to) in program.iter().zip(changed) {
            assert!(other.contains(from), "{from}");
            other = other.replacen(from, to, 1);
        }
        let message = refusal(&other);
        assert!(message.contains("expected a part of a vector by its length"), "{message}");
    }
}

#[test]
fn parts_are_coordinates_of_one_unit_vector_in_which_the_formula_is_linear() {
    let text = sample("plane");
    let refused = |changes: &[(&str, &str)], expected: &str| {
        let mut changed = text.clone();
        for (from, to) in changes {
            assert!(changed.contains(from), "{from}");
            changed = changed.replacen(from, to, 1);
        }
        let message = refusal(&changed);
        assert!(message.contains(expected), "{message}");
    };
    let of_vector = "expected different coordinates of one unit vector";
    refused(&[("variable part 41\n", "variable part 40\n")], of_vector);
    refused(&[("variable part 41\n", "variable part 25\n")], of_vector);
    // A sum of a term with a part and one without, a product of two, and a result without any.
    let linear = "expected terms that are all linear in parts, or all without one";
    refused(
        &[("op 45 add 43 44", "op 45 add 43 4"), ("step 45 add 2 5", "step 45 add 2 4")],
        linear,
    );
    refused(
        &[("op 44 mul 41 4", "op 44 mul 41 40"), ("step 44 mul 3 4", "step 44 mul 3 0")],
        linear,
    );
    let without =
        "lemma 17 sum\nvariable difference 2 1 0\nvariable part 40\nstep 17 variables +0\n";
    refused(&[("claim ", &format!("{without}claim "))], "found a last step without a part");
}

#[test]
fn a_third_edge_needs_both_alternatives_and_an_area() {
    let text = sample("rows");
    check(&text).unwrap();
    let (start, rest) = text.rsplit_once("\nlemma ").unwrap();
    let (first, second) = rest.split_once("or\n").unwrap();
    let (_, first_formula) = first.split_once('\n').unwrap();
    let tail = &second[second.find("size ").unwrap()..];
    // The same alternative twice.
    let twice = format!("{start}\nlemma {first}or\n{first_formula}{tail}");
    assert!(refusal(&twice).contains("expected it along the other one"), "{}", refusal(&twice));
    let alone = format!("{start}\nlemma {first}{tail}");
    assert!(refusal(&alone).contains("expected `or`"), "{}", refusal(&alone));
    // An area of other edges, or none: a sum of two products.
    let area = text.lines().find(|line| line.starts_with("op 31 sub ")).unwrap();
    let sum = text.replacen(area, &area.replacen("sub", "add", 1), 1);
    assert!(check(&sum).is_err());
    // Edges and quotients whose product is not below 1.
    let wide = text.replacen("domain edge 1023*2^-10", "domain edge 1", 1);
    assert!(check(&wide).is_err());
}

/// (b-a)·(b-a)'·(b-a)'' over a coordinate of the direction, along three axes, and each of them over it.
#[test]
fn an_error_whose_effect_is_no_share_of_the_divisor_is_refused() {
    use Operation::{Div, Input, Mul, Sub};
    let mut operations: Vec<Operation> = [3, 6, 7, 8, 9, 10, 11].map(Input).to_vec();
    operations.extend([Sub(4, 1), Sub(5, 2), Sub(6, 3), Mul(7, 8), Mul(10, 9), Div(11, 0)]);
    operations.extend([Div(7, 0), Div(8, 0), Div(9, 0)]);
    let path = Path { operations, decisions: vec![], compared: vec![], hits: true };
    let text = certificate_of(&path, "f32", Domain::UNIT, &[0, 7, 8, 9, 12]);
    check(&text).unwrap();
    assert!(!text.contains(" over "), "{text}");
    // The second product's first factor is linear in two of them.
    let (start, end) = text.rsplit_once("\nlemma 12 ").unwrap();
    let narrow = |axes: &[usize]| {
        let mut end = end.to_owned();
        for axis in axes {
            let line = format!("variable difference 2 1 {axis}");
            assert!(end.contains(&line), "{text}");
            end = end.replacen(&line, &format!("{line} over {}", 13 + axis), 1);
        }
        let lines = end.lines().filter(|line| !line.starts_with("relative"));
        refusal(&format!("{start}\nlemma 12 {}", lines.collect::<Vec<_>>().join("\n")))
    };
    assert!(narrow(&[0, 1, 2]).contains("no share of the divisor"), "{}", narrow(&[0, 1, 2]));
    let one = narrow(&[0]);
    assert!(!one.contains("share"), "{one}");
    // Another number over the divisor.
    let wrong = format!(
        "{start}\nlemma 12 {}",
        end.replacen("variable difference 2 1 0", "variable difference 2 1 0 over 14", 1)
    );
    assert!(
        refusal(&wrong).contains("expected the variable over the divisor"),
        "{}",
        refusal(&wrong)
    );
}

/// The stored certificate of a kernel in f32.
fn stored(kernel: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/corpora/proofs");
    std::fs::read_to_string(format!("{folder}/{kernel}-f32.proof")).unwrap()
}

#[test]
fn values_of_an_edge_that_are_no_exact_negatives_or_have_other_signs_are_refused() {
    let signs = |text: &str| check(text).unwrap().iter().filter(|claim| claim.has_signs).count();
    let (woop, plucker) = (stored("woop-watertight"), stored("plucker"));
    assert_eq!((signs(&woop), signs(&plucker)), (2, 0));
    // Plücker's signs need not be those of one picture, and the t of both is no edge's value.
    let message = "found `signs` of operation";
    let claimed = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        refusal(&text.replacen(from, to, 1))
    };
    let opposite = plucker.lines().find(|line| line.ends_with(" opposite")).unwrap();
    let claim = opposite.strip_suffix(" opposite").unwrap();
    let refused = claimed(&plucker, opposite, &format!("{claim} signs"));
    assert!(
        refused.contains(message) && refused.ends_with("x(p)*y(q) - x(q)*y(p) of two vertices")
    );
    // Less may be said than is true.
    assert_eq!(check(&plucker.replacen(opposite, claim, 1)).map(|all| all.len()).ok(), Some(6));
    // Numbers of three vertices, quotients and fused products are no exact negatives.
    for text in [&woop, &plucker, &stored("moller-trumbore"), &stored("woop-watertight+fma")] {
        let is_plain = |line: &&str| line.starts_with("claim ") && line.split(' ').count() == 3;
        for line in text.lines().filter(is_plain) {
            let (from, to) = (format!("{line}\nend"), format!("{line} opposite\nend"));
            let refused = claimed(text, &from, &to);
            assert!(refused.contains("found `opposite` of operation"), "{line}: {refused}");
        }
    }
    let claim = woop.lines().find(|line| line.ends_with(" signs")).unwrap();
    assert!(claimed(&woop, claim, "claim edge 48 sign").contains("and opposite or signs"));
    // |x| is not x, and what is no picture of single vertices is no determinant: both are 0 where their claims say
    // otherwise, or have the sign of nothing.
    for (operations, word, message) in [
        (
            ["abs 0", "mul 3 2", "mul 1 2"],
            "opposite",
            "its negative where the vertices are exchanged",
        ),
        (["abs 0", "mul 0 2", "mul 1 2"], "signs", "x(p)*y(q) - x(q)*y(p) of two vertices"),
    ] {
        let refused = refusal(&difference(operations, word));
        assert!(refused.ends_with(message), "{refused}");
    }
    assert!(check(&difference(["abs 0", "mul 0 2", "mul 1 2"], "opposite")).is_ok());
}

/// A certificate of the difference of two numbers, made from a_x, b_x and d_x: operations 3 to 5 are given.
fn difference(operations: [&str; 3], word: &str) -> String {
    let [third, fourth, fifth] = operations;
    let (cut, first) = match fourth {
        "mul 3 2" => ("cut 3", "step 3 variables +0"),
        _ => ("point 1 0", "step 0 variables +0"),
    };
    format!(
        "hairline proof 1\nkernel mine f32\nformat 24 -149 127\ndomain edge 1 reach 1 world 1 direction 1 extent 1 \
         direction-floor 1*2^-1 floor 1*2^-1 quotient 1\nprogram\nop 0 input 6\nop 1 input 9\nop 2 input 3\n\
         op 3 {third}\nop 4 {fourth}\nop 5 {fifth}\nop 6 sub 4 5\n\
         lemma 0 sum\nvariable point 1 0\nstep 0 variables +0\ncorner +\nfirst 0\nrest 0\nsize 1\ncomputed 1\nerror 0\n\
         lemma 6 sum\nvariable {cut}\nvariable point 2 0\nvariable direction 0\n{first}\nstep 1 variables +1\n\
         step 2 variables +2\nstep 4 mul 0 2\nstep 5 mul 1 2\nstep 6 sub 3 4\ncorner +++\nfirst 1*2^-23\nrest 0\n\
         size 1*2^1\ncomputed 1*2^1\nerror 1*2^-23\nclaim edge 6 {word}\nend\n"
    )
}
