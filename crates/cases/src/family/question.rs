//! The questions that families put to a kernel: the columns of the audit's screen.

named! {
    pub names
    /// One question, which several families put together, with the head of its column.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    pub enum Question {
        /// Hits and misses that are clear.
        Inside = "inside",
        /// On an edge, or some ulps from it.
        Edges = "edges",
        /// On a vertex, or some ulps from it.
        Vertices = "vertex",
        /// The ray is nearly or exactly parallel to the plane, or the triangle has no area.
        Flat = "flat",
        /// The hit is at, near or beyond the start of the ray or an end of the interval.
        Ends = "ends",
        /// Coordinates with many zeros: rays along an axis, points of a small integer grid.
        Grid = "grid",
        /// Tiny, huge, far and thin triangles; short and long directions.
        Sizes = "sizes",
        /// Exponents that have nothing to do with each other, or at the ends of the range; noise next to 1.
        Range = "range",
        /// NaN, infinities, a zero direction, an impossible interval.
        Invalid = "invalid",
    }
}

impl Question {
    /// The contents of the column, where its head does not say them.
    pub fn contents(self) -> &'static str {
        match self {
            Question::Inside | Question::Edges | Question::Vertices => "",
            Question::Flat => "in or near the plane",
            Question::Ends => "of the ray",
            Question::Grid => "small integers",
            Question::Sizes => "tiny, huge, far, thin",
            Question::Range => "extreme exponents",
            Question::Invalid => "NaN, infinities",
        }
    }

    /// True if its cases are of ordinary sizes: magnitudes from 2^-60 to 2^60, not mixed at random.
    pub fn is_ordinary(self) -> bool {
        !matches!(self, Question::Range | Question::Invalid)
    }
}
