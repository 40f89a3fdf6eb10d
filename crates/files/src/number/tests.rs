//! Tests of numbers in text.

use super::*;
use crate::case::Draw;

fn check<F: Float>(text: &str, bits: u64) {
    let value: F = parse(text).unwrap();
    assert_eq!(
        value.hex(),
        F::from_bits(bits).hex(),
        "{text} as {}",
        F::NAME
    );
}

#[test]
fn a_decimal_is_rounded_once() {
    // A little above the middle of 1 and its neighbour: f64 holds the middle itself, and would
    // then round it to even.
    let text = "1.000000059604644775390626";
    assert_eq!(text.parse::<f64>().unwrap() as f32, 1.0);
    check::<f32>(text, 0x3f80_0001);
    check::<f32>("1.000000059604644775390625", 0x3f80_0000);
    check::<f64>("0.1", 0x3fb9_9999_9999_999a);
    check::<f32>("0.1", 0x3dcc_cccd);
    check::<f64>("-0", 0x8000_0000_0000_0000);
    check::<f32>("+1.5e-3", 0x3ac4_9ba6);
    check::<f32>("-1e-999", 0x8000_0000);
    check::<f64>("4.9e-324", 1);
    check::<f32>("3.4028235677973366e38", 0x7f7f_ffff);
}

#[test]
fn infinities_and_nans_are_read_as_programs_print_them() {
    for (text, bits) in [
        ("inf", 0x7f80_0000),
        ("+infinity", 0x7f80_0000),
        ("-inf", 0xff80_0000),
        ("-Infinity", 0xff80_0000),
        ("INF", 0x7f80_0000),
    ] {
        check::<f32>(text, bits);
    }
    for text in ["nan", "NaN", "-nan", "+NAN", "-nan(ind)", "nan(0x400000)"] {
        assert!(parse::<f32>(text).unwrap().is_nan(), "{text}");
    }
    for text in ["infinit", "--inf", "nano", "nan(", "inff"] {
        assert!(parse::<f32>(text).is_err(), "{text}");
    }
}

#[test]
fn literals_of_c_and_bit_patterns_are_read() {
    check::<f32>("0.2f", 0x3e4c_cccd);
    check::<f32>("-1.0e-05F", 0xb727_c5ac);
    check::<f32>(".2", 0x3e4c_cccd);
    check::<f32>("1.", 0x3f80_0000);
    check::<f32>("1.f", 0x3f80_0000);
    check::<f32>("0.2_f32", 0x3e4c_cccd);
    check::<f64>("1f64", 1f64.to_bits());
    assert!(parse::<f32>("0.2f64").is_err() && parse::<f64>("1e_f64").is_err());
    check::<f32>("0x3e4ccccd", 0x3e4c_cccd);
    check::<f32>("0xFF800000", 0xff80_0000);
    check::<f64>("0x3fc999999999999a", 0.2f64.to_bits());
    assert!(parse::<f32>("0x7fc00000").unwrap().is_nan());
    let message = parse::<f64>("0x3e4ccccd").unwrap_err();
    let expected = "'0x3e4ccccd' needs a binary exponent, as 0x1.8p-3, or 16 digits, as the bits of an f64 have";
    assert_eq!(message, expected);
}

#[test]
fn hexadecimal_floats_are_the_patterns_they_spell() {
    check::<f32>("0x1.8p-3", 0x3e40_0000);
    check::<f32>("-0x.8P+4", 0xc100_0000);
    check::<f32>("0X1P-149", 1);
    check::<f32>("0x1.fffffep127", 0x7f7f_ffff);
    check::<f32>("-0x0.0p0", 0x8000_0000);
    check::<f64>("0x1.921fb54442d18p+1", std::f64::consts::PI.to_bits());
    check::<f64>("0x0.0000000000001p-1022", 1);
    check::<f64>("0x1.fffffffffffffp1023", f64::MAX.to_bits());
    check::<f64>("0x8p-1077", 1);
    check::<f64>(&format!("0x1{}p-400", "0".repeat(100)), 1f64.to_bits());
    check::<f64>(&format!("0x.{}1p404", "0".repeat(100)), 1f64.to_bits());
    check::<f32>("0x0p99999999999999999999", 0);
    check::<f32>("0x1p-99999999999999999999", 0);
}

#[test]
fn hexadecimal_ties_go_to_even_and_nothing_else_does() {
    check::<f32>("0x1.000001p0", 0x3f80_0000);
    check::<f32>("0x1.000003p0", 0x3f80_0002);
    check::<f32>(
        "0x1.00000100000000000000000000000000000000001p0",
        0x3f80_0001,
    );
    check::<f32>("0x1.000000fffffffffffffffffffffffffffffffffp0", 0x3f80_0000);
    // Between subnormals, at half the smallest, and from the largest of them up.
    check::<f32>("0x1p-150", 0);
    check::<f32>("0x1.00000000000000000000000000000000000000001p-150", 1);
    check::<f32>("0x1.8p-149", 2);
    check::<f32>("0x2.8p-149", 2);
    check::<f32>("0x.ffffffp-126", 0x0080_0000);
    check::<f32>("0x.fffffdp-126", 0x007f_fffe);
    check::<f64>("0x1p-1075", 0);
    check::<f64>("0x1.0000000000001p-1075", 1);
    // A carry into the next binade, and the last one before infinity.
    check::<f32>("0x1.ffffffp0", 0x4000_0000);
    check::<f32>("0x1.fffffeffp127", 0x7f7f_ffff);
    check::<f64>("0x1.fffffffffffff7ffp1023", f64::MAX.to_bits());
}

#[test]
fn hexadecimal_floats_round_as_the_processor_does() {
    let mut draw = Draw::new("corpus-numbers", 2, 0);
    for _ in 0..100_000 {
        // Significands of 53 bits; every second one is half a unit of something, or next to it.
        let low = draw.integer(20, 51);
        let bits = match draw.below(2) {
            0 => (draw.bits() >> 11 >> low << low) + (1 << (low - 1)) + draw.below(3) as u64 - 1,
            _ => draw.bits() >> 11,
        };
        let power = draw.integer(-210, 80);
        let rounded = (bits as f64 * 2f64.powi(power as i32)) as f32;
        match parse::<f32>(&format!("0x{bits:x}p{power}")) {
            Ok(value) => assert_eq!(value.hex(), rounded.hex(), "{bits:x} {power}"),
            Err(_) => assert_eq!(rounded, f32::INFINITY),
        }
    }
}

#[test]
fn what_overflows_is_an_error() {
    for text in [
        "1e999",
        "-3.4028236e38",
        "0x1p128",
        "0x1.ffffffp127",
        "0x1p99999999999999",
    ] {
        let message = parse::<f32>(text).unwrap_err();
        assert_eq!(message, format!("'{text}' overflows f32"));
    }
    assert_eq!(
        parse::<f64>("-1e309").unwrap_err(),
        "'-1e309' overflows f64"
    );
}

#[test]
fn junk_is_refused() {
    for text in [
        "",
        " ",
        " 1",
        "1 ",
        "1_0",
        "1e",
        "1e+",
        "e5",
        ".",
        "-",
        "+-1",
        "1.2.3",
        "0x",
        "0x.p0",
        "0xp1",
        "0x1p",
        "0x1p+",
        "0x1.gp0",
        "0x1.1.1p0",
        "0x1p1.5",
        "0x1p-99999999999999999999zzz",
        "0x-1p0",
        "0x1pp1",
        "1,5",
        "١",
        "0x1é1p0",
        "1ff",
        "1ef",
        "f",
        ".f",
        "1.0d",
        "one",
        "\n1",
    ] {
        assert!(parse::<f64>(text).is_err(), "{text:?}");
    }
    let message = parse::<f32>("1_0").unwrap_err();
    assert!(
        message.starts_with("'1_0' is not a number: write a decimal"),
        "{message}"
    );
    let message = parse::<f32>("0x3f80").unwrap_err();
    assert!(
        message.starts_with("'0x3f80' needs a binary exponent, as 0x1.8p-3"),
        "{message}"
    );
    let message = parse::<f32>(&"1".repeat(5000)).unwrap_err();
    assert!(
        message.ends_with("...' has more than 4096 characters"),
        "{message}"
    );
    assert!(!parse::<f32>("1\n2").unwrap_err().contains('\n'));
}

#[test]
fn what_is_written_stays_short_and_keeps_zeros_apart() {
    for (value, text) in [
        (0.0, "0"),
        (-0.0, "-0.0"),
        (1.0, "1"),
        (-2.5, "-2.5"),
        (0.1, "0.1"),
        (1e-7, "1e-7"),
        (1e15, "1e15"),
        (f64::MAX, "1.7976931348623157e308"),
        (f64::INFINITY, "\"inf\""),
        (f64::NEG_INFINITY, "\"-inf\""),
        (f64::NAN, "\"nan\""),
    ] {
        assert_eq!(write(value), text);
    }
    assert_eq!(write(0.1f32), "0.10000000149011612");
}

/// Written and read back, by this reader and by a reader of doubles; and spelled in hexadecimal.
fn check_round_trip<F: Float>(value: F) {
    let text = write(value);
    assert_eq!(parse::<F>(&text).unwrap().hex(), value.hex(), "{text}");
    assert_eq!(
        F::from_f64(text.parse().unwrap()).hex(),
        value.hex(),
        "{text}"
    );
    assert!(text.len() < 26, "{text}");
    let fraction_bits = F::DIGITS - 1;
    let magnitude = value.abs().to_bits();
    let (field, fraction) = (
        magnitude >> fraction_bits,
        magnitude & ((1 << fraction_bits) - 1),
    );
    let hidden = u64::from(field > 0) << fraction_bits;
    let exponent = field.max(1) as i64 - 1 + i64::from(F::MIN_EXPONENT);
    let sign = if value.to_f64().is_sign_negative() {
        "-"
    } else {
        ""
    };
    let spelled = format!("{sign}0x{:x}p{exponent}", hidden | fraction);
    assert_eq!(
        parse::<F>(&spelled).unwrap().hex(),
        value.hex(),
        "{spelled}"
    );
}

#[test]
fn every_finite_pattern_survives_its_text() {
    let mut draw = Draw::new("corpus-numbers", 1, 0);
    for _ in 0..200_000 {
        let bits = draw.bits();
        let [narrow, wide] = [f64::from(f32::from_bits(bits as u32)), f64::from_bits(bits)];
        if narrow.is_finite() {
            check_round_trip(narrow as f32);
        }
        if wide.is_finite() {
            check_round_trip(wide);
        }
        check_round_trip(f32::from_bits(bits as u32 & 0x807f_ffff));
        check_round_trip(f64::from_bits(bits & 0x800f_ffff_ffff_ffff));
    }
    for value in [f32::MAX, -f32::MAX, f32::MIN_POSITIVE, 0.0, -0.0] {
        check_round_trip(value);
        check_round_trip(f64::from(value));
    }
    check_round_trip(f64::MAX);
}
