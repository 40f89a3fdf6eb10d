//! A t that is known up to bounds.

/// Two numbers between which an exact t lies, in units of the ray's direction; equal if t is that number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// At most t.
    pub lower: f64,
    /// At least t.
    pub upper: f64,
}

impl Bounds {
    /// A t that is known exactly.
    pub(crate) fn at(t: f64) -> Bounds {
        Bounds { lower: t, upper: t }
    }

    /// True if t is known exactly.
    pub fn is_exact(&self) -> bool {
        self.lower == self.upper
    }
}
