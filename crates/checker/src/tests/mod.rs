//! Certificates by hand, each of which breaks one condition of the checkers, and why it is refused.
//!
//! The files beside this one are accepted. A row of a table changes one of them as little as it can, so that one
//! condition does not hold and all others do. With that condition gone from the checker the certificate would pass, or
//! be refused for another reason.

mod formulas;
mod frame;
mod guarded;
mod quotients;
mod symmetry;
mod units;

use super::{check, check_guarded};

/// (a_x - o_x) · d_x.
const SUM: &str = include_str!("sum.proof");
/// (a_x - o_x) + (b_x - o_x), of points in a box.
const BOXED: &str = include_str!("boxed.proof");
/// (a_x - o_x) · d_x / (b_y - o_y).
const QUOTIENT: &str = include_str!("quotient.proof");
/// The same in a format whose numbers are finite below 4, with larger errors.
const LARGE: &str = include_str!("large.proof");
/// n / (n · d_x), n being a_x - o_x: the formula has the numerator twice, so its rounding is not left out.
const SHARED: &str = include_str!("shared.proof");
/// The same of o_x - a_x, computed as -(a_x - o_x).
const TURNED: &str = include_str!("turned.proof");
/// -((a_x - o_x) · d_x) / (b_y - o_y).
const NEGATED: &str = include_str!("negated.proof");
/// ((a_x - o_x) + (b_x - o_x)) / d_x.
const ADDED: &str = include_str!("added.proof");
/// The quotient above, with a divisor whose rounding counts as a share of its exact value.
const RELATIVE: &str = include_str!("relative.proof");
/// In f64 d_x·a_x - d_y·a_y, in wider arithmetic, over the length of the vector of it, d_x and d_y.
const WIDE: &str = include_str!("wide.proof");
/// d_y / d_x, where d_x is the largest coordinate of the direction.
const ORDERED: &str = include_str!("ordered.proof");
/// (a_x - o_x) · d_y / d_x, where d_x is the largest coordinate of the direction.
const SHEAR: &str = include_str!("shear.proof");
/// a_x · (1 / d_x).
const RECIPROCAL: &str = include_str!("reciprocal.proof");
/// 1 / d_x.
const INVERSE: &str = include_str!("inverse.proof");
/// a_x / d_x + a_y / d_x.
const BOTH: &str = include_str!("both.proof");
/// (1 - a_x / d_x) - a_y / d_x.
const REST: &str = include_str!("rest.proof");
/// a_x · d_x / |d| + a_y · d_y / |d|.
const UNIT: &str = include_str!("unit.proof");
/// A guarded kernel of an interval and both sides. 39 is the determinant, 44 is N·(a-o), 46 and 48 are what t_min and t_max
/// leave of it; -62, 67 and 69 are the weights of b, c and a.
const GUARDED: &str = include_str!("guarded.proof");
/// A guarded kernel of lines and the front.
const FRONT: &str = include_str!("front.proof");

/// A condition, the texts of a certificate that are replaced so that it does not hold, and words of the refusal.
type Broken<'a> = (&'a str, &'a [(&'a str, &'a str)], &'a str);

/// A certificate with the first occurrence of each text replaced.
fn changed(certificate: &str, changes: &[(&str, &str)]) -> String {
    let mut text = certificate.to_owned();
    for (from, to) in changes {
        assert!(
            text.contains(from),
            "the certificate has no {from:?}:\n{text}"
        );
        text = text.replacen(from, to, 1);
    }
    text
}

/// Why a certificate is refused.
fn refusal(text: &str) -> Option<String> {
    let is_guarded = text.contains("\nguarded ");
    let refused = if is_guarded {
        check_guarded(text).err()
    } else {
        check(text).err()
    };
    refused.map(|refusal| refusal.to_string())
}

/// Asserts that a certificate is accepted, and that each row's changes have it refused with the row's words.
fn assert_each_is_refused(certificate: &str, rows: &[Broken]) {
    assert_eq!(refusal(certificate), None);
    for (condition, changes, words) in rows {
        let found = refusal(&changed(certificate, changes));
        let found = found.unwrap_or_else(|| panic!("{condition}: it is accepted"));
        assert!(found.contains(words), "{condition}: {found}");
    }
}
