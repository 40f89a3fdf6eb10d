//! How a program's numbers were read, in words: rounded, moved and scaled, or with t as a length.

use crate::arith::ScalarName;
use crate::record::{group_digits, number_of};
use crate::result::RaysResult;

impl RaysResult {
    /// How the numbers were read, if not as they are written.
    pub(crate) fn reading(&self) -> Option<String> {
        if self.given.is_none()
            && let Some(as_given) = self.right_as_given
        {
            return Some(format!(
                "By the scene of --given no more hits are right, or more answers are wrong ({}). Judged by mesh and rays as written{}.",
                number_of(as_given, "answer is right", "answers are right"),
                match self.scalar {
                    ScalarName::F32 => ", rounded to f32",
                    ScalarName::F64 => "",
                }
            ));
        }
        let as_written = self.right_as_written?;
        let flag = match (self.scalar, &self.given) {
            (ScalarName::F32, None) => " (--scalar f64)",
            _ => "",
        };
        Some(format!(
            "Judged {}: {} right that way, and {} by the numbers as written{flag}.",
            self.reading_in_words(),
            number_of(self.right_count(), "answer is", "answers are"),
            group_digits(as_written)
        ))
    }

    fn reading_in_words(&self) -> String {
        let in_f32 = self.scalar == ScalarName::F32;
        if let Some(given) = &self.given {
            let rounded = match (in_f32, given.computed_in) {
                (false, _) => "",
                (true, ScalarName::F64) => ", then rounded to f32",
                (true, ScalarName::F32) => " in f32",
            };
            let t = match (self.has_unit_directions, given.has_written_t) {
                (false, false) => "",
                (false, true) => ", with t as in the written scene",
                (true, false) => ", with directions made of length 1, so that t is a length there",
                (true, true) => ", with t as a length in the written scene",
            };
            return format!("by mesh and rays after {}{rounded}{t}", given.steps);
        }
        let words = match (in_f32, self.has_unit_directions) {
            (true, true) => {
                "by mesh and rays rounded to f32, with directions made of length 1, so that t is a length"
            }
            (true, false) => {
                "by mesh and rays rounded to f32, in which the program seems to compute"
            }
            (false, _) => {
                "with directions made of length 1, so that t is a length, as the program seems to do"
            }
        };
        words.to_owned()
    }
}
