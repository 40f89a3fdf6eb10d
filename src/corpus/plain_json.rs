//! Lines as most are, numbers and perhaps a name, read in one pass: in half of the time that any other line takes.

use super::case_json::check_name;
use super::stored_case::{AnyCase, StoredCase};
use crate::arith::Float;
use crate::case::Case;
use serde::{Deserialize, Deserializer};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Numbers<'a, F> {
    #[serde(default, deserialize_with = "not_null")]
    name: Option<String>,
    scalar: &'a str,
    origin: [F; 3],
    direction: [F; 3],
    a: [F; 3],
    b: [F; 3],
    c: [F; 3],
}

/// The case, made of such a line; none of any other line, or of a wrong one.
pub fn read<'a, F: Float + Deserialize<'a>>(
    text: &'a str,
    case: fn(Case<F>) -> AnyCase,
) -> Option<StoredCase> {
    let Numbers { name, scalar, origin, direction, a, b, c } =
        serde_json::from_str::<Numbers<'a, F>>(text).ok()?;
    let name = name.map(check_name).transpose().ok()?;
    let case = case(Case::new(origin, direction, [a, b, c]));
    (scalar == F::NAME).then(|| StoredCase { name, ..StoredCase::of(case) })
}

fn not_null<'a, D: Deserializer<'a>>(value: D) -> Result<Option<String>, D::Error> {
    String::deserialize(value).map(Some)
}

#[cfg(test)]
mod tests {
    use super::super::case_json::{VECTORS, parse, parse_any};
    use super::super::number;
    use super::*;
    use crate::case::Draw;
    use serde::de::DeserializeOwned;

    #[test]
    fn a_line_of_numbers_is_read_as_any_other_is() {
        fn compare<F: Float + DeserializeOwned>(draw: &mut Draw, read: &mut usize) {
            let digits = |draw: &mut Draw, most: i64| {
                let count = draw.integer(1, most) as usize;
                (0..count).map(|_| char::from(b'0' + draw.below(10) as u8)).collect::<String>()
            };
            let mut number = || {
                let sign = draw.pick(&["", "-"]);
                match draw.below(4) {
                    0 => number::write(F::from_bits(draw.integer(0, i64::MAX) as u64)),
                    1 => format!("{sign}{}", draw.pick(&["0", "0.0", "1", "16777217", "1e-46"])),
                    2 => format!("{sign}1{}.{}", digits(draw, 25), digits(draw, 60)),
                    _ => format!("{sign}3.{}e{}", digits(draw, 30), draw.integer(-60, 50)),
                }
            };
            let mut vector = |name| {
                let numbers: [String; 3] = std::array::from_fn(|_| number());
                format!("\"{name}\":[{}]", numbers.join(","))
            };
            let vectors = VECTORS.map(|name| vector(name)).join(", ");
            let name = ["", ",\"name\":\"one \\u0041\"", ",\"name\":\"\""][vectors.len() % 3];
            let line = format!("{{\"scalar\":\"{}\",{vectors}{name}}}", F::NAME);
            let plain = serde_json::from_str::<Numbers<F>>(&line).is_ok();
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
        assert!(read.iter().all(|read| (400..4000).contains(read)), "{read:?}");
        for line in [
            r#"{"scalar":"f32","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0],"name":null}"#,
            r#"{"scalar":"f64","name":"f32","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]}"#,
            r#"{"scalar":"f16","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0]}"#,
            r#"{"scalar":"f32","origin":[0,0,1],"direction":[0,0,-1],"a":[0,0,0],"b":[4,0,0],"c":[0,4,0],"a":[0,0,0]}"#,
        ] {
            assert_eq!(parse(line, 1), parse_any(line, 1), "{line}");
        }
    }
}
