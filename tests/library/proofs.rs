//! The checker of certificates accepts what the prover writes and nothing that differs from it in a number.

use hairline::ScalarName;
use hairline::internals::arith::Real;
use hairline::internals::arith::recorded::Operation;
use hairline::internals::kernel::{self, Path, Scalar};
use hairline::internals::prove::certificate::{self, Claim};
use hairline::internals::prove::checker::{Number, check};
use hairline::internals::prove::{Domain, Dyadic, Format, Prover, Symmetry, is_impossible};
use num_traits::Signed;

/// The first path of a kernel that an input may take.
fn path<F: Scalar>(kernel: &str) -> Path {
    let entry = kernel::find(kernel).unwrap();
    let paths = F::subject(entry).unwrap().gated().unwrap().paths().unwrap();
    paths.into_iter().find(|path| !is_impossible(path)).unwrap()
}

/// A certificate of bounds of some numbers.
fn certificate_of(path: &Path, scalar: ScalarName, domain: Domain, places: &[u32]) -> String {
    let format = if scalar == ScalarName::F32 {
        Format::F32
    } else {
        Format::F64
    };
    let program = |place: &u32| {
        let mut prover = Prover::new(path, domain, format);
        prover.bound(*place).unwrap();
        let (symmetry, orders) = (Symmetry::None, prover.orders(*place));
        let claim = Claim {
            gate: "gate",
            place: *place,
            symmetry,
            orders: &orders,
            also: &[],
        };
        certificate::program(path, &prover.lemmas_of(*place), &claim)
    };
    certificate::heading("kernel", scalar, format)
        + &certificate::domain(&domain)
        + &places.iter().map(program).collect::<String>()
}

/// The first operations of a kind.
fn first(path: &Path, count: usize, is_kind: impl Fn(&Operation) -> bool) -> Vec<u32> {
    let all = (0..)
        .zip(&path.operations)
        .filter(|(_, operation)| is_kind(operation));
    all.take(count).map(|(place, _)| place).collect()
}

fn is_quotient(operation: &Operation) -> bool {
    matches!(operation, Operation::Div(..))
}

/// Everything that the gates of a kernel compare and that has a bound.
fn quantities<F: Scalar>(kernel: &str, scalar: ScalarName) -> String {
    let path = path::<F>(kernel);
    let format = if scalar == ScalarName::F32 {
        Format::F32
    } else {
        Format::F64
    };
    let mut prover = Prover::new(&path, Domain::UNIT, format);
    let all = path
        .compared
        .iter()
        .flat_map(|compared| compared.quantities.clone());
    let places: Vec<u32> = all.filter(|place| prover.bound(*place).is_ok()).collect();
    certificate_of(&path, scalar, Domain::UNIT, &places)
}

/// Short certificates with every rule in them, and the domain's names that do not matter to each.
fn samples() -> Vec<(&'static str, String, &'static [&'static str])> {
    // A determinant by differences, in f64.
    let triple = path::<f64>("scalar-triple");
    let triple_places = &triple.compared[0].quantities;
    // A unit vector, and a formula that is linear in it.
    let plane = path::<f32>("plane-unit-normal");
    let is_size = |operation: &Operation| match *operation {
        Operation::Abs(inner) => Some(inner),
        _ => None,
    };
    let plane_places = [plane.operations.iter().find_map(is_size).unwrap()];
    // Quotients by the largest coordinate of the direction, and a shear of errors that grow with it.
    let woop = path::<f32>("woop-watertight");
    let mut sheared = first(&woop, 3, is_quotient);
    sheared.push(48);
    // Quotients of differences that are sums of variables.
    let baldwin = path::<f32>("baldwin-weber");
    let baldwin_places = first(&baldwin, 6, is_quotient);
    // Two barycentric coordinates, and their sum.
    let weights = path::<f32>("moller-trumbore");
    let is_sum = |place: &u32| weights.operations[*place as usize];
    let last = *weights.compared.last().unwrap().quantities.last().unwrap();
    let Operation::Sub(_, both) = is_sum(&last) else {
        panic!("1 - (u + v)")
    };
    // So low that the order of the direction's coordinates is needed.
    let low = Domain {
        floor: Dyadic::power(-8),
        quotient: Dyadic::power(2),
        ..Domain::UNIT
    };
    vec![
        (
            "triple",
            certificate_of(&triple, ScalarName::F64, Domain::UNIT, triple_places),
            &[
                "edge",
                "world",
                "extent",
                "direction-floor",
                "floor",
                "quotient",
            ],
        ),
        (
            "plane",
            certificate_of(&plane, ScalarName::F32, Domain::UNIT, &plane_places),
            &["reach", "world", "extent", "direction-floor", "quotient"],
        ),
        (
            "woop",
            certificate_of(&woop, ScalarName::F32, low, &sheared),
            &["edge", "world", "extent", "floor", "quotient"],
        ),
        (
            "baldwin",
            certificate_of(&baldwin, ScalarName::F32, Domain::UNIT, &baldwin_places),
            &["reach", "direction", "extent", "direction-floor"],
        ),
        (
            "weights",
            certificate_of(&weights, ScalarName::F32, Domain::UNIT, &[both]),
            &["world", "extent", "direction-floor"],
        ),
    ]
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
            mutants.push((
                line,
                column,
                format!("{}{changed}{}", &text[..start], &text[i..]),
            ));
        }
    }
    mutants
}

#[test]
fn what_the_prover_writes_is_accepted() {
    for kernel in [
        "scalar-triple-two-sided",
        "moller-trumbore",
        "plucker",
        "baldwin-weber",
        "cramer",
    ] {
        for text in [
            quantities::<f32>(kernel, ScalarName::F32),
            quantities::<f64>(kernel, ScalarName::F64),
        ] {
            let proved = check(&text).unwrap_or_else(|refusal| panic!("{kernel}: {refusal}"));
            assert_eq!(proved.len(), text.matches("\nclaim ").count());
        }
    }
    for (name, text, _) in samples() {
        check(&text).unwrap_or_else(|refusal| panic!("{name}: {refusal}"));
    }
    // A rest may be large, and its sum far below 0.
    let cramer = path::<f32>("cramer");
    let rest = *cramer.compared.last().unwrap().quantities.last().unwrap();
    let domain = Domain {
        quotient: Dyadic::power(3),
        ..Domain::UNIT
    };
    let text = certificate_of(&cramer, ScalarName::F32, domain, &[rest]);
    assert!(
        text.contains("rest-of-quotients") && text.contains("\ndown-to "),
        "{text}"
    );
    check(&text).unwrap();
}

/// The bounds of the first operation of a kernel that multiplies twice and subtracts in wider arithmetic.
fn wide_difference<F: Scalar>(scalar: ScalarName) -> String {
    let entry = kernel::find("woop-watertight").unwrap();
    let paths = F::subject(entry).unwrap().gated().unwrap().paths().unwrap();
    let place = |path: &Path| {
        let is_wide = |operation: &Operation| matches!(operation, Operation::Minor(..));
        path.operations.iter().position(is_wide)
    };
    let path = paths
        .iter()
        .find(|path| !is_impossible(path) && place(path).is_some())
        .unwrap();
    certificate_of(path, scalar, Domain::UNIT, &[place(path).unwrap() as u32])
}

#[test]
fn a_difference_of_products_is_rounded_twice_in_f64() {
    let [single, double] = [
        wide_difference::<f32>(ScalarName::F32),
        wide_difference::<f64>(ScalarName::F64),
    ];
    let [single, double] = [check(&single), check(&double)];
    let [single, double] = [single, double].map(|proved| proved.unwrap().remove(0).bound.error);
    // Apart from that, the errors differ by 2^-29.
    assert!(double * Number::from_integer((1i64 << 29).into()) > single);
    // A result below 2 that is wrong by nearly 2u, twice what one rounding may cost.
    let exact = |x: f64| Number::from_float(x).unwrap();
    let digits = [
        0x13411b4d2cd965u64,
        0x1f2bee19622db6,
        0x1fba5f0d32f012,
        0x16f08d216d65ac,
    ];
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
        let mut mutants = mutants(&text);
        assert!(400 < mutants.len());
        if name == "weights" {
            // What stands before is of rules that the others have.
            let own = lines
                .iter()
                .position(|line| line.last() == Some(&OF_BOTH))
                .unwrap();
            mutants.retain(|(line, ..)| own <= *line || lines[*line][0] == "down-to");
            assert!(200 < mutants.len());
        }
        for (line, column, mutant) in mutants
            .iter()
            .filter(|(_, _, mutant)| check(mutant).is_ok())
        {
            let words = &lines[*line];
            // What remains is the true certificate of another statement: a bound of the domain that no lemma uses.
            let is_other_statement = words[0] == "domain" && free.contains(&words[column - 1]);
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
        let lines: Vec<&str> = text.lines().collect();
        for (i, line) in lines.iter().enumerate() {
            if let Some(signs) = line.strip_prefix("corner ") {
                for v in 0..signs.len() {
                    let mut flipped = signs.as_bytes().to_vec();
                    flipped[v] = if flipped[v] == b'+' { b'-' } else { b'+' };
                    let mut changed: Vec<String> =
                        lines.iter().map(|line| line.to_string()).collect();
                    changed[i] = format!("corner {}", String::from_utf8(flipped).unwrap());
                    assert!(
                        check(&changed.join("\n")).is_err(),
                        "{name}: {}",
                        changed[i]
                    );
                }
            }
            let rest: Vec<&str> = [&lines[..i], &lines[i + 1..]].concat();
            // Without an order less may be supposed. The test below drops those that matter.
            let is_free = line.starts_with("order ");
            assert!(
                is_free || check(&rest.join("\n")).is_err(),
                "{name}: without {line}"
            );
            // Cut off here: what is left is whole only before another program.
            let is_whole = *line == "program" && lines[i - 1] == "end";
            let is_refused = check(&lines[..i].join("\n")).is_err();
            assert!(is_whole != is_refused, "{name}: up to line {i}");
        }
    }
}

#[test]
fn a_lemma_less_is_refused() {
    for (name, text, _) in samples() {
        let starts: Vec<usize> = text.match_indices("\nlemma ").map(|(at, _)| at).collect();
        for at in starts {
            let end = ["\nlemma ", "\nclaim "]
                .iter()
                .filter_map(|word| text[at + 1..].find(word))
                .min();
            let rest = text[..at].to_owned() + &text[at + 1 + end.unwrap()..];
            assert!(check(&rest).is_err(), "{name}: {}", &text[at..at + 20]);
        }
    }
}

fn sample(name: &str) -> String {
    samples()
        .into_iter()
        .find(|(known, _, _)| *known == name)
        .unwrap()
        .1
}

fn refusal(text: &str) -> String {
    check(text).expect_err("it is accepted").to_string()
}

#[test]
fn an_order_that_is_not_stated_or_not_used_is_refused() {
    let text = sample("woop");
    let orders: Vec<&str> = text
        .lines()
        .filter(|line| line.starts_with("order "))
        .collect();
    assert!(
        orders.contains(&"order 5 3") && orders.contains(&"order 4 3"),
        "{orders:?}"
    );
    let without = text.replace("order 5 3\n", "");
    assert!(check(&without).is_err());
    let opposite = text.replace("order 5 3\n", "order 3 5\n");
    assert!(check(&opposite).is_err());
    for more in [
        "order 5 3\norder 5 3\n",
        "order 5 3\norder 4 5\n",
        "order 5 3\norder 6 7\n",
    ] {
        assert!(
            check(&text.replacen("order 5 3\n", more, 1)).is_err(),
            "{more}"
        );
    }
}

#[test]
fn a_bound_whose_way_overflows_is_refused() {
    // A reciprocal overflows, though the product with it does not.
    let tiny = Dyadic::power(-130);
    let domain = Domain {
        direction: tiny,
        direction_floor: tiny,
        reach: tiny,
        ..Domain::UNIT
    };
    let path = path::<f32>("woop-watertight");
    let is_reciprocal = |place: u32| matches!(path.operations[place as usize], Operation::Div(one, _) if path.operations[one as usize] == Operation::Number(1));
    let is_product = |op: &Operation| matches!(op, Operation::Mul(a, _) if is_reciprocal(*a));
    let place = path.operations.iter().position(is_product).unwrap() as u32;
    // The prover may refuse it too.
    if Prover::new(&path, domain, Format::F32).bound(place).is_ok() {
        let text = certificate_of(&path, ScalarName::F32, domain, &[place]);
        assert!(
            refusal(&text).ends_with("which may overflow"),
            "{}",
            refusal(&text)
        );
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
    let small = Domain {
        edge: Dyadic::power(-3),
        floor: Dyadic::power(-6),
        ..Domain::UNIT
    };
    // The squares of the normal are at most 12, of the small one much less; but its reciprocal may be above 64.
    for (domain, largest) in [(Domain::UNIT, 4), (small, 7)] {
        let text = certificate_of(&path, ScalarName::F32, domain, &[place]);
        let accepted = check(&with_largest(&text, largest));
        assert!(accepted.is_ok(), "{accepted:?}");
        let message = refusal(&with_largest(&text, largest - 1));
        let line = 1 + text
            .lines()
            .position(|line| line.ends_with(" unit"))
            .unwrap();
        assert!(message.starts_with(&format!("line {line}: ")), "{message}");
        assert!(message.ends_with("which may overflow"), "{message}");
    }
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let text = sample("triple");
    let line = |word: &str| {
        1 + text
            .lines()
            .position(|line| line.starts_with(word))
            .unwrap()
    };
    assert_eq!(
        refusal(""),
        "line 1: found the end of the file, expected `hairline proof 3`"
    );
    let domain = line("domain");
    let cyclic = text.replacen(
        "\nvariable ",
        "\nvariable difference 1 0 0\nvariable difference 0 1 0\nvariable ",
        1,
    );
    assert!(
        refusal(&cyclic).contains("expected an independent one"),
        "{}",
        refusal(&cyclic)
    );
    let first = text
        .lines()
        .find(|line| line.starts_with("first "))
        .unwrap();
    let message = refusal(&text.replacen(first, "first 1*2^-60", 1));
    assert!(
        message.starts_with(&format!("line {}: found `first 1*2^-60`", line("first "))),
        "{message}"
    );
    let negative = text.replacen("edge 1", "edge -1", 1);
    assert!(refusal(&negative).starts_with(&format!("line {domain}: ")));
    let (program, claim) = (
        text.find("\nlemma ").unwrap(),
        text.find("\nclaim ").unwrap(),
    );
    let claimed = format!("{}{}", &text[..program], &text[claim..]);
    assert!(refusal(&claimed).contains("expected one with a lemma above"));
    // A product of a number with itself is not affine in it.
    let square = "hairline proof 3\nkernel k f32\nformat 24 -149 127\ndomain edge 1 reach 1 world 1 \
        direction 1 extent 1 direction-floor 1 floor 1 quotient 1\nprogram\nop 0 input 3\nop 1 mul 0 0\n\
        lemma 1 sum\nvariable direction 0\nstep 0 variables +0\nstep 1 mul 0 0\n";
    assert_eq!(
        refusal(square),
        "line 11: found `step 1 mul 0 0`, expected factors without a variable in common"
    );
    let other = square
        .replace("mul 0 0\n", "add 0 0\n")
        .replace("op 1 add", "op 1 mul");
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
    let text = "hairline proof 3\nkernel k f32\nformat 24 -149 127\ndomain edge 1 reach 1 world 1 direction 1 \
        extent 1 direction-floor 1 floor 1 quotient 1\nprogram\nop 0 input 3\nop 1 input 0\nop 2 sub 0 1\n\
        lemma 2 sum\nvariable direction 0\nvariable point 0 0\nstep 2 variables +0 -1\n";
    let message = refusal(text);
    assert!(
        message.starts_with("line 12: found `step 2 variables +0 -1`"),
        "{message}"
    );
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
        ("op 0 input 10", "op 0 input 18446744073709551615"),
        ("op 0 input 10", "op 18446744073709551616 input 10"),
        ("step 2 variables +0", "step 2 variables"),
        ("step 2 variables +0", "step 2 variables é"),
        ("step 2 variables +0", "step"),
        ("corner ", "corner \u{0}"),
        ("size ", &long),
    ] {
        assert!(text.contains(from), "{from}");
        assert!(check(&text.replacen(from, to, 1)).is_err(), "{to}");
    }
    let many = "variable quotient\n".repeat(40);
    let message = refusal(&sample("woop").replacen("variable quotient\n", &many, 1));
    assert!(
        message.contains("found more than 32 variables"),
        "{message}"
    );
    assert!(check(&"\n".repeat(1 << 23)).is_err());
    // Any byte may change to any other, and any piece may be missing: never a panic.
    let mut state = 1u64;
    let mut random = |end: usize| {
        state = state
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
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
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../..")
        .join("corpora/proofs");
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
    assert!(
        5 < accepted && 5 < numbers,
        "{accepted} with {numbers} numbers"
    );
}

#[test]
fn a_length_that_may_be_rounded_to_zero_is_refused() {
    let text = sample("plane");
    let domain = text
        .lines()
        .find(|line| line.starts_with("domain "))
        .unwrap();
    let mut words: Vec<&str> = domain.split(' ').collect();
    let floor = words.iter().position(|word| *word == "floor").unwrap() + 1;
    // Less than the length's own error, which is about 2^-22.
    words[floor] = "1*2^-60";
    let error = refusal(&text.replacen(domain, &words.join(" "), 1));
    assert!(
        error.contains("found a length that may be rounded to zero"),
        "{error}"
    );
}

#[test]
fn a_root_of_more_or_less_than_three_squares_is_no_length() {
    let text = sample("plane");
    let program = ["op 14 mul 12 12", "op 23 mul 22 22", "op 29 add 24 28"];
    for changed in [
        // Of three squares and the number 1; of four; of two.
        [
            "op 14 fma 12 12 13",
            "op 23 fma 22 22 14",
            "op 29 fma 27 27 23",
        ],
        ["op 14 mul 12 12", "op 23 fma 22 22 14", "op 29 add 23 24"],
        ["op 14 mul 12 12", "op 23 mul 22 22", "op 29 add 14 23"],
    ] {
        let mut other = text.clone();
        for (from, to) in program.iter().zip(changed) {
            assert!(other.contains(from), "{from}");
            other = other.replacen(from, to, 1);
        }
        let message = refusal(&other);
        assert!(
            message.contains("expected a part of a vector by its length"),
            "{message}"
        );
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
    refused(&[("variable part 35\n", "variable part 32\n")], of_vector);
    refused(&[("variable part 35\n", "variable part 12\n")], of_vector);
    // A sum of a term with a part and one without, a product of two, and a result without any.
    let linear = "expected terms that are all linear in parts, or all without one";
    refused(
        &[
            ("op 38 add 34 37", "op 38 add 34 36"),
            ("step 38 add 2 5", "step 38 add 2 4"),
        ],
        linear,
    );
    refused(
        &[
            ("op 37 mul 35 36", "op 37 mul 35 32"),
            ("step 37 mul 3 4", "step 37 mul 3 0"),
        ],
        linear,
    );
    let without =
        "lemma 17 sum\nvariable difference 3 1 0\nvariable part 32\nstep 17 variables +0\n";
    refused(
        &[("claim ", &format!("{without}claim "))],
        "found a last step without a part",
    );
}

/// The rule of u + v.
const OF_BOTH: &str = "sum-of-quotients-by-reciprocal";

#[test]
fn the_rules_of_two_quotients_and_of_points_in_a_box_keep_their_conditions() {
    let text = sample("weights");
    let refused = |from: &str, to: &str, expected: &str| {
        assert!(text.contains(from), "{from}");
        let message = refusal(&text.replacen(from, to, 1));
        assert!(message.contains(expected), "{message}");
    };
    // A point where it is, beside points that were moved; and a step that is one of these.
    let mixed = "found points in a box and points as they are";
    refused("variable boxed 0 0\n", "variable point 0 0\n", mixed);
    let of_point = text
        .lines()
        .find(|line| line.starts_with("op 0 input "))
        .unwrap();
    assert_eq!(of_point, "op 0 input 0");
    let moved = "lemma 0 sum\nvariable boxed 0 0\nstep 0 variables +0\n";
    refused(
        "lemma ",
        &format!("{moved}lemma "),
        "expected a difference of points in a box",
    );
    refused(
        "variable boxed 1 0\n",
        "variable boxed 1 0\nvariable boxed 1 0\n",
        "independent",
    );
    // Another rule, other divisors, one quotient twice.
    let unfit = "found a rule that does not fit its operation";
    refused(OF_BOTH, "rest-of-quotients-by-reciprocal", unfit);
    refused(OF_BOTH, "sum-of-quotients", unfit);
    refused(OF_BOTH, "quotient-by-reciprocal", unfit);
    let last = text.lines().rfind(|line| line.starts_with("op ")).unwrap();
    let [.., u, v] = last.split(' ').collect::<Vec<_>>()[..] else {
        panic!("{last}")
    };
    refused(
        last,
        &last.replacen(&format!(" {v}"), &format!(" {u}"), 1),
        unfit,
    );
    // Nothing but a size is supposed of one of them.
    for down_to in text.lines().filter(|line| line.starts_with("down-to ")) {
        let message = refusal(&text.replacen(&format!("{down_to}\n"), "", 1));
        assert!(
            message.contains("found `corner") || message.contains("found `first"),
            "{message}"
        );
    }
}

/// The stored certificate of a kernel in f32.
fn stored(kernel: &str) -> String {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../corpora/proofs");
    std::fs::read_to_string(format!("{folder}/{kernel}-f32.proof")).unwrap()
}

#[test]
fn values_of_an_edge_that_are_no_exact_negatives_or_have_other_signs_are_refused() {
    let signs = |text: &str| {
        check(text)
            .unwrap()
            .iter()
            .filter(|claim| claim.has_signs)
            .count()
    };
    let (woop, plucker) = (stored("woop-watertight"), stored("plucker"));
    assert_eq!((signs(&woop), signs(&plucker)), (2, 0));
    // Plücker's signs need not be those of one picture, and the t of both is no edge's value.
    let message = "found `signs` of operation";
    let claimed = |text: &str, from: &str, to: &str| {
        assert!(text.contains(from), "{from}");
        refusal(&text.replacen(from, to, 1))
    };
    let opposite = plucker
        .lines()
        .find(|line| line.ends_with(" opposite"))
        .unwrap();
    let claim = opposite.strip_suffix(" opposite").unwrap();
    let refused = claimed(&plucker, opposite, &format!("{claim} signs"));
    assert!(
        refused.contains(message) && refused.ends_with("x(p)*y(q) - x(q)*y(p) of two vertices")
    );
    // Less may be said than is true.
    assert_eq!(
        check(&plucker.replacen(opposite, claim, 1))
            .map(|all| all.len())
            .ok(),
        Some(6)
    );
    // Numbers of three vertices, quotients and fused products are no exact negatives.
    for text in [
        &woop,
        &plucker,
        &stored("moller-trumbore"),
        &stored("woop-watertight+fma"),
    ] {
        for (at, end) in text.match_indices("\nend\n") {
            let (start, claim) = text[..at].rsplit_once('\n').unwrap();
            if claim.split(' ').count() == 2 {
                let refused = refusal(&format!("{start}\n{claim} opposite{end}"));
                assert!(
                    refused.contains("found `opposite` of operation"),
                    "{claim}: {refused}"
                );
            }
        }
    }
    let claim = woop.lines().find(|line| line.ends_with(" signs")).unwrap();
    assert!(claimed(&woop, claim, "claim edge sign").contains("and opposite or signs"));
    // |x| is not x, and what is no picture of single vertices is no determinant: both are 0 where their claims say
    // otherwise, or have the sign of nothing.
    let not_negative = refusal(&difference(true, "opposite"));
    assert!(not_negative.ends_with("its negative where the vertices are exchanged"));
    assert!(
        refusal(&difference(false, "signs")).ends_with("x(p)*y(q) - x(q)*y(p) of two vertices")
    );
    assert!(check(&difference(false, "opposite")).is_ok());
}

/// A certificate of a_x·d_x - b_x·d_x, or of |a_x|·d_x - b_x·d_x.
fn difference(is_size: bool, word: &str) -> String {
    let (operations, cut) = match is_size {
        true => (
            "op 3 abs 0\nop 4 mul 3 2\nop 5 mul 1 2\nop 6 sub 4 5\n",
            "cut 3",
        ),
        false => ("op 3 mul 0 2\nop 4 mul 1 2\nop 5 sub 3 4\n", "point 1 0"),
    };
    let [first, product, other, last] = if is_size { [3, 4, 5, 6] } else { [0, 3, 4, 5] };
    format!(
        "hairline proof 3\nkernel mine f32\nformat 24 -149 127\ndomain edge 1 reach 1 world 1 direction 1 extent 1 \
         direction-floor 1*2^-1 floor 1*2^-1 quotient 1\nprogram\nop 0 input 6\nop 1 input 9\nop 2 input 3\n\
         {operations}\
         lemma 0 sum\nvariable point 1 0\nstep 0 variables +0\ncorner +\nfirst 0\nrest 0\nsize 1\ncomputed 1\nerror 0\n\
         lemma {last} sum\nvariable {cut}\nvariable point 2 0\nvariable direction 0\nstep {first} variables +0\n\
         step 1 variables +1\nstep 2 variables +2\nstep {product} mul 0 2\nstep {other} mul 1 2\nstep {last} sub 3 4\n\
         corner +++\nfirst 1*2^-23\nrest 0\nsize 1*2^1\ncomputed 1*2^1\nerror 1*2^-23\nclaim edge {word}\nend\n"
    )
}

/// The checker says that it demands exactly the numbers; so it demands the one way to write each.
#[test]
fn a_number_that_is_written_in_another_way_is_refused() {
    let text = sample("triple");
    check(&text).unwrap();
    for (from, to) in [
        ("size 4089*2^-10", "size +4089*2^-10"),
        ("size 4089*2^-10", "size 8178*2^-11"),
        ("size 4089*2^-10", "size 04089*2^-10"),
        ("size 4089*2^-10", "size 4089*2^-010"),
        ("size 4089*2^-10", "size 4089*2^-10 "),
        ("extent 1 ", "extent 2*2^-1 "),
        ("extent 1 ", "extent 1*2^0 "),
        ("format 53", "format +53"),
        ("op 1 input", "op +1 input"),
        ("op 1 input ", "op 1 input 0"),
        ("op 3 sub 1 2", "op 3 sub 01 2"),
        ("\nstep 0 ", "\nstep 00 "),
    ] {
        assert!(text.contains(from), "{from}: {text}");
        assert!(check(&text.replacen(from, to, 1)).is_err(), "{to}");
    }
}

/// What is claimed of one program is claimed under other names of axes and vertices, and of no other program.
#[test]
fn other_names_are_permutations_of_the_axes_and_of_the_vertices() {
    let text = sample("triple");
    let with = |also: &str| check(&text.replacen("\nlemma ", &format!("\n{also}\nlemma "), 1));
    let proved = with("also yzx cab").unwrap().remove(0);
    let [here, there] = &proved.programs[..] else {
        panic!("{proved:?}")
    };
    // y in place of x, and c in place of a; the origin and the direction keep theirs.
    let input = |i: usize| -> usize {
        let axis = (i % 3 + 1) % 3;
        let point = [0, 1, 4, 2, 3][i / 3];
        3 * point + axis
    };
    let renamed = here
        .operations
        .lines()
        .map(|line| match line.split_once(" input ") {
            Some((op, i)) => format!("{op} input {}\n", input(i.parse().unwrap())),
            None => format!("{line}\n"),
        });
    assert_eq!(there.operations, renamed.collect::<String>());
    for wrong in [
        "also xyz abc",
        "also yzx cab\nalso yzx cab",
        "also yyx abc",
        "also yz abc",
        "also yzxx abc",
        "also oxy abc",
        "also yzx abo",
        "also yzx",
        "also yzx bca xyz",
        "also abc xyz",
    ] {
        assert!(with(wrong).is_err(), "{wrong}");
    }
}
