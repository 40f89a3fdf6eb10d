//! Tests of cases in JSON.

use super::*;
use crate::case::Draw;
use crate::corpus::lines::write_case;

const CASE: &str = r#""origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]"#;

fn f32_case(more: &str) -> Result<StoredCase, String> {
    parse(&format!(r#"{{"scalar":"f32",{CASE}{more}}}"#), 7)
}

#[test]
fn a_case_needs_its_scalar_and_five_vectors() {
    let plain = Case::new(
        [0., 0., 1.],
        [0., 0., -1.],
        [[0.; 3], [4., 0., 0.], [0., 4., 0.]],
    );
    let stored = f32_case("").unwrap();
    assert_eq!(stored.case, AnyCase::F32(plain));
    assert_eq!((stored.line, stored.name, stored.truth), (7, None, None));
    let all = format!(
        r#" {{ "name" : "x", "why":"y","url":"z", {CASE}, "t_min":"-inf", "t_max":"0x1p-149",
"truth":{{"feature":"vertex_a"}}, "scalar":"f32"}} "#
    );
    let stored = parse(&all.replace('\n', " "), 1).unwrap();
    assert_eq!(
        stored.case,
        AnyCase::F32(plain.on(f32::NEG_INFINITY, f32::from_bits(1)))
    );
    assert_eq!(
        [stored.name, stored.why, stored.url].map(Option::unwrap),
        ["x", "y", "z"]
    );
    assert_eq!(stored.truth.unwrap().to_json(), r#"{"feature":"vertex_a"}"#);
}

#[test]
fn numbers_are_read_from_their_text() {
    let text = r#"{"scalar":"f32","origin":[1.000000059604644775390626,-0,"0x1.8p-3"],"direction":["nan","-inf",1e-46],"a":[0,0,0],"b":[0,0,0],"c":[0,0,0]}"#;
    let AnyCase::F32(case) = parse(text, 1).unwrap().case else {
        panic!()
    };
    let [origin, direction, ..] = case.vectors();
    assert_eq!(origin.map(Float::hex), ["3f800001", "80000000", "3e400000"]);
    assert!(direction[0].is_nan());
    assert_eq!(direction[1..], [f32::NEG_INFINITY, 0.0]);
}

#[test]
fn bit_patterns_must_agree_and_give_a_nan_its_payload() {
    let zeros = r#""00000000","00000000""#;
    for (more, message) in [
        (
            format!(r#"[{zeros},"3f800001"]"#),
            "bits.origin[2] is 1.0000001192092896 (3f800001), but origin[2] is 1 (3f800000)",
        ),
        (
            format!(r#"["80000000",{zeros}]"#),
            "bits.origin[0] is -0.0 (80000000), but origin[0] is 0 (00000000)",
        ),
        (
            format!(r#"[{zeros},"7fc00000"]"#),
            "bits.origin[2] is nan (7fc00000), but origin[2] is 1 (3f800000)",
        ),
        (
            format!(r#"[{zeros},"3f80000"]"#),
            "bits.origin[2]: expected 8 hexadecimal digits, found '3f80000'",
        ),
        (
            format!(r#"[{zeros},"+3f80000"]"#),
            "bits.origin[2]: expected 8 hexadecimal digits, ",
        ),
        (
            format!(r#"[{zeros},0]"#),
            "bits.origin[2]: expected a string, found 0",
        ),
        (
            format!("[{zeros}]"),
            "bits.origin: expected 3 bit patterns, found 2",
        ),
    ] {
        let error = f32_case(&format!(r#","bits":{{"origin":{more}}}"#)).unwrap_err();
        assert!(error.starts_with(message), "{error}");
    }
    let error = f32_case(r#","t_max":"inf","bits":{"t_max":"00000000"}"#).unwrap_err();
    assert_eq!(
        error,
        "bits.t_max is 0 (00000000), but t_max is inf (7f800000)"
    );
    assert!(f32_case(r#","t_max":"inf","bits":{"t_min":"0x00000000","t_max":"7F800000"}"#).is_ok());
    let nan = f32_case(r#","t_min":"nan","bits":{"t_min":"ffc12345"}"#).unwrap();
    let AnyCase::F32(case) = nan.case else {
        panic!()
    };
    assert_eq!(case.ray.t_min.to_bits(), 0xffc1_2345);
}

fn random_case<F: Float>(draw: &mut Draw) -> Case<F> {
    let specials = [0.0, -0.0, f64::NAN, f64::INFINITY, -f64::INFINITY, 1.0];
    let fraction = (1 << (F::DIGITS - 1)) - 1;
    let mut number = || match draw.below(20) {
        0 => F::from_f64(draw.pick(&specials)),
        1..6 => F::from_bits(draw.bits() & (fraction | F::from_f64(-0.0).to_bits())),
        _ => F::from_bits(draw.bits()),
    };
    let mut vector = || [number(), number(), number()];
    let (origin, direction) = (vector(), vector());
    let case = Case::new(origin, direction, [vector(), vector(), vector()]);
    if draw.coin() {
        case
    } else {
        case.on(F::from_bits(draw.bits()), F::from_f64(1.0))
    }
}

fn check_round_trip<F: Float>(case: Case<F>, any: AnyCase, name: String) -> String {
    let truth = StoredTruth::parse(r#"{"facing":null,"u_exact":"1/3"}"#).ok();
    let (why, url) = (Some("tab\t\"quote\"".to_owned()), Some("ü\n".to_owned()));
    let stored = StoredCase {
        name: Some(name),
        truth,
        line: 7,
        why,
        url,
        ..StoredCase::of(any)
    };
    let stored = StoredCase {
        is_secondary: case.bits()[0] & 1 == 1,
        ..stored
    };
    let text = write_case(&stored);
    assert!(!text.contains('\n'));
    let read = parse(&text, 7).unwrap();
    let bits = match &read.case {
        AnyCase::F32(case) => case.bits(),
        AnyCase::F64(case) => case.bits(),
    };
    assert_eq!(bits, case.bits(), "{text}");
    // NaN is not equal to itself, but its text is.
    assert_eq!(format!("{read:?}"), format!("{stored:?}"), "{text}");
    text
}

#[test]
fn what_is_written_is_read_back_bit_by_bit() {
    let mut draw = Draw::new("corpus-cases", 1, 0);
    for i in 0..5_000 {
        let narrow = random_case::<f32>(&mut draw);
        check_round_trip(narrow, AnyCase::F32(narrow), format!("narrow {i}"));
        let wide = random_case::<f64>(&mut draw);
        check_round_trip(wide, AnyCase::F64(wide), format!("wide {i}"));
    }
}

#[test]
fn a_written_case_reads_like_this() {
    let case = Case::new(
        [0.5, -0.0, 1e-7],
        [0., 0., 1.],
        [[0.1; 3], [4., 0., 0.], [1.; 3]],
    );
    let case = case.on(0.0, f32::NAN);
    let stored = StoredCase {
        name: Some("x".to_owned()),
        is_secondary: true,
        truth: StoredTruth::parse(r#"{"class":"invalid"}"#).ok(),
        ..StoredCase::of(case)
    };
    let expected = concat!(
        r#"{"name":"x","scalar":"f32","origin":[0.5,-0.0,1.0000000116860974e-7],"#,
        r#""direction":[0,0,1],"a":[0.10000000149011612,0.10000000149011612,"#,
        r#"0.10000000149011612],"b":[4,0,0],"c":[1,1,1],"t_max":"nan","starts":"on-triangle","#,
        r#""truth":{"class":"invalid"},"bits":{"origin":["3f000000","80000000","33d6bf95"],"#,
        r#""direction":["00000000","00000000","3f800000"],"#,
        r#""a":["3dcccccd","3dcccccd","3dcccccd"],"b":["40800000","00000000","00000000"],"#,
        r#""c":["3f800000","3f800000","3f800000"],"t_max":"7fc00000"}}"#
    );
    assert_eq!(write_case(&stored), expected);
}
