//! Lines as most are, numbers and perhaps a name, read in one pass, which is faster than the way of any other line.

use super::stored_case::{StoredCase, check_name};
use crate::arith::Float;
use crate::case::{AnyCase, Case};
use serde::de::{Error, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::marker::PhantomData;

/// Longer lines are not read here: they may have a number that is refused for its length.
const LONGEST: usize = 4096;

#[derive(Deserialize)]
#[serde(deny_unknown_fields, bound = "F: Float")]
struct PlainLine<'a, F> {
    #[serde(default, deserialize_with = "not_null")]
    name: Option<String>,
    scalar: &'a str,
    origin: [RoundedOnce<F>; 3],
    direction: [RoundedOnce<F>; 3],
    a: [RoundedOnce<F>; 3],
    b: [RoundedOnce<F>; 3],
    c: [RoundedOnce<F>; 3],
}

/// The case, made of such a line; none of any other line, or of a wrong one.
pub fn read<F: Float>(text: &str, case: fn(Case<F>) -> AnyCase) -> Option<StoredCase> {
    // An array would be read as a struct.
    if text.len() > LONGEST || !text.starts_with('{') {
        return None;
    }
    let PlainLine {
        name,
        scalar,
        origin,
        direction,
        a,
        b,
        c,
    } = serde_json::from_str::<PlainLine<F>>(text).ok()?;
    let name = name.map(check_name).transpose().ok()?;
    let [origin, direction, a, b, c] =
        [origin, direction, a, b, c].map(|vector| vector.map(|RoundedOnce(number)| number));
    let case = case(Case::new(origin, direction, [a, b, c]));
    (scalar == F::NAME.name()).then(|| StoredCase {
        name,
        ..StoredCase::of(case)
    })
}

/// A number that is rounded once, from its text; an error if `serde_json` may have rounded it before.
#[derive(Clone, Copy)]
struct RoundedOnce<F>(F);

impl<'a, F: Float> Deserialize<'a> for RoundedOnce<F> {
    fn deserialize<D: Deserializer<'a>>(value: D) -> Result<RoundedOnce<F>, D::Error> {
        // Tells it how to round.
        match F::NAME == f32::NAME {
            true => value.deserialize_f32(Once(PhantomData)),
            false => value.deserialize_f64(Once(PhantomData)),
        }
    }
}

struct Once<F>(PhantomData<F>);

impl<F: Float> Once<F> {
    fn exactly<E: Error>(value: f64) -> Result<RoundedOnce<F>, E> {
        let number = F::from_f64(value);
        match number.to_f64() == value {
            true => Ok(RoundedOnce(number)),
            false => Err(E::custom("rounded twice")),
        }
    }
}

impl<F: Float> Visitor<'_> for Once<F> {
    type Value = RoundedOnce<F>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number")
    }

    /// An integer of 2^64 and more comes in `f64`, whatever was asked for.
    fn visit_f64<E: Error>(self, value: f64) -> Result<RoundedOnce<F>, E> {
        Once::exactly(value)
    }

    fn visit_u64<E: Error>(self, value: u64) -> Result<RoundedOnce<F>, E> {
        u32::try_from(value)
            .map_err(E::custom)
            .map(|value| RoundedOnce(F::from_f64(value.into())))
    }

    fn visit_i64<E: Error>(self, value: i64) -> Result<RoundedOnce<F>, E> {
        i32::try_from(value)
            .map_err(E::custom)
            .map(|value| RoundedOnce(F::from_f64(value.into())))
    }
}

fn not_null<'a, D: Deserializer<'a>>(value: D) -> Result<Option<String>, D::Error> {
    String::deserialize(value).map(Some)
}

#[cfg(test)]
mod tests {
    use super::super::case_json::{VECTORS, parse, parse_any};
    use super::*;
    use crate::case::Draw;
    use crate::files::number;

    #[test]
    fn a_line_of_numbers_is_read_as_any_other_is() {
        fn compare<F: Float>(draw: &mut Draw, read: &mut usize) {
            let digits = |draw: &mut Draw, most: i64| {
                let count = draw.integer(1, most) as usize;
                (0..count)
                    .map(|_| char::from(b'0' + draw.below(10) as u8))
                    .collect::<String>()
            };
            let mut number = || {
                let sign = draw.pick(&["", "-"]);
                match draw.below(40) {
                    0 => format!("{sign}{}", draw.integer(1, i64::MAX)),
                    1 => format!("{sign}{}{}", draw.integer(1, i64::MAX), digits(draw, 3)),
                    2..=11 => number::write(F::from_bits(draw.integer(0, i64::MAX) as u64)),
                    12..=20 => {
                        format!(
                            "{sign}{}",
                            draw.pick(&["0", "0.0", "1", "16777217", "1e-46"])
                        )
                    }
                    21..=30 => format!("{sign}1{}.{}", digits(draw, 25), digits(draw, 60)),
                    _ => format!("{sign}3.{}e{}", digits(draw, 30), draw.integer(-60, 50)),
                }
            };
            let mut vector = |name| {
                let numbers: [String; 3] = std::array::from_fn(|_| number());
                format!("\"{name}\":[{}]", numbers.join(","))
            };
            let vectors = VECTORS.map(&mut vector).join(", ");
            let name = ["", ",\"name\":\"one \\u0041\"", ",\"name\":\"\""][vectors.len() % 3];
            let line = format!("{{\"scalar\":\"{}\",{vectors}{name}}}", F::NAME);
            let plain = serde_json::from_str::<PlainLine<F>>(&line).is_ok();
            *read += usize::from(plain);
            let show = |read: Result<StoredCase, String>| read.map(|stored| format!("{stored:?}"));
            assert_eq!(show(parse(&line, 3)), show(parse_any(&line, 3)), "{line}");
        }
        let mut draw = Draw::new("lines", 1, 0);
        let mut read = [0; 2];
        for _ in 0..4000 {
            compare::<f32>(&mut draw, &mut read[0]);
            compare::<f64>(&mut draw, &mut read[1]);
        }
        assert!(
            read.iter().all(|read| (400..4000).contains(read)),
            "{read:?}"
        );
        let long = format!("0.{}1", "0".repeat(4096));
        let long = format!(
            r#"{{"scalar":"f32","origin":[0,0,{long}],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]}}"#
        );
        for line in [
            &long,
            r#"{"scalar":"f32","origin":[0,0,-9223372586610589697],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]}"#,
            r#"["one","f32",[0,0,1],[0,0,-1],[0,0,0],[4,0,0],[0,4,0]]"#,
            r#"{"scalar":"f32","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0],"name":null}"#,
            r#"{"scalar":"f64","name":"f32","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]}"#,
            r#"{"scalar":"f16","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]}"#,
            r#"{"scalar":"f32","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0],"a":[0,0,0]}"#,
        ] {
            assert_eq!(parse(line, 1), parse_any(line, 1), "{line}");
        }
    }
}
