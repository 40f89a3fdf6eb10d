//! Tests of the first lines of a plug-in.

use super::*;

fn read(text: &str) -> Result<Hello, String> {
    let mut start = HelloLines::default();
    for line in text.lines() {
        if let Some(hello) = start.take(line)? {
            return Ok(hello);
        }
    }
    Err("no 'ready'".to_owned())
}

const WHOLE: &str = "hairline-kernel 1\nname mine\nsource here and there\nscalars f64\n\
    contract closed-ray,invalid=free\ngives t facing\nencoding binary\n\
    epsilon parallel 1e-6 2 1 non-negative abs(det) < e\nepsilon edge -1e-3 0 0 signed\nready\n";

#[test]
fn a_whole_hello_is_a_row_of_the_table() {
    let hello = read(WHOLE).unwrap();
    let info = hello.info();
    assert_eq!((info.name, info.source), ("mine", "here and there"));
    assert_eq!((hello.scalars, hello.binary), ([false, true], true));
    assert_eq!(
        (info.gives.t, info.gives.uv, info.gives.facing),
        (true, false, true)
    );
    assert_eq!(info.contract, "closed-ray,invalid=free".parse().unwrap());
    assert_eq!(info.epsilon_sets[0].values, ["1e-6", "-1e-3"]);
    assert_eq!(info.gates[0].refuses, "abs(det) < e");
    assert_eq!(info.gates[0].dimension, Dimension::new(2, 1));
    assert_eq!(
        (info.gates[1].epsilon, info.gates[1].refuses),
        (Tunable::Signed, "not told")
    );
}

#[test]
fn a_role_is_given_or_follows_from_the_name() {
    let hello = WHOLE
        .replace("epsilon parallel", "epsilon det")
        .replace("epsilon edge", "epsilon eps")
        .replace(
            "signed\nready",
            "signed\nepsilon u 0 3 0 signed role=t s t >= e\nready",
        );
    let hello = read(&hello).unwrap();
    let gates = hello.info().gates;
    let roles: Vec<_> = gates.iter().map(|gate| (gate.name, gate.role)).collect();
    assert_eq!(
        roles,
        [
            ("det", Role::Parallel),
            ("eps", Role::Other),
            ("u", Role::T)
        ]
    );
    assert_eq!(gates[2].refuses, "s t >= e");
    let [note] = &hello.notes()[..] else {
        panic!("{:?}", hello.notes())
    };
    assert!(
        note.starts_with("what its epsilon 'eps' is there to refuse is not known"),
        "{note}"
    );
    assert_eq!(read(WHOLE).unwrap().info().gates[0].role, Role::Parallel);
}

#[test]
fn what_is_missing_twice_or_unknown_is_named() {
    for (old, new, message) in [
        (
            "hairline-kernel 1",
            "hello",
            "its first line is 'hello', expected 'hairline-kernel 1'",
        ),
        (
            "kernel 1",
            "kernel 2",
            "it speaks protocol '2', this program speaks 1",
        ),
        (
            "name mine\n",
            "",
            "its hello has no line 'name …' before 'ready'",
        ),
        (
            "scalars f64\n",
            "",
            "its hello has no line 'scalars …' before 'ready'",
        ),
        (
            "contract closed-ray,invalid=free\n",
            "",
            "its hello has no line 'contract …'",
        ),
        (
            "scalars f64",
            "scalars f16",
            "scalars: 'f16' is none of f32, f64",
        ),
        ("scalars f64", "scalars", "scalars: none is named"),
        ("name mine", "name mine\nname yours", "'name' is said twice"),
        (
            "gives t facing",
            "gives everything",
            "gives: 'everything' is none of t, uv, facing",
        ),
        (
            "encoding binary",
            "encoding morse",
            "encoding: 'morse' is none of text, binary",
        ),
        (
            "closed-ray,invalid=free",
            "closed-rai",
            "contract: 'closed-rai' is no contract",
        ),
        (
            "epsilon edge -1e-3",
            "epsilon parallel 1",
            "epsilon 'parallel' is announced twice",
        ),
        (
            "epsilon edge -1e-3 0 0 signed",
            "epsilon edge 0",
            "epsilon: 'edge 0' is not NAME",
        ),
        (
            "1e-6 2 1 non",
            "1e-6x 2 1 non",
            "epsilon parallel: '1e-6x' is no epsilon that it can take; write 1e-6, without a suffix",
        ),
        (
            "1e-6 2 1 non",
            "-1e-6 2 1 non",
            "epsilon parallel: '-1e-6' is no epsilon",
        ),
        (
            "signed\nready",
            "signed role=side\nready",
            "epsilon edge: 'role=side' is none of",
        ),
        (
            "1e-6 2 1 non",
            "1e-6 two 1 non",
            "epsilon: 'parallel 1e-6 two",
        ),
        (
            "source here",
            "floats 16\nsource",
            "floats: '16' is not 0 to 15",
        ),
        (
            "source here",
            "processes 0\nsource",
            "processes: '0' is not 1 or more",
        ),
        (
            "source here",
            "sauce here",
            "'sauce here and there' is none of name, source,",
        ),
        (
            "source here",
            "error three is not installed\nsource",
            "three is not installed",
        ),
    ] {
        let error = read(&WHOLE.replacen(old, new, 1)).unwrap_err();
        assert!(error.starts_with(message), "{old} -> {new}: {error}");
    }
}
