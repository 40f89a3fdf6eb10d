//! Other names of the axes, and of the vertices a, b and c.

/// The axis in place of each axis, and the vertex in place of each vertex.
#[derive(Clone, Copy)]
pub struct Names {
    axes: [usize; 3],
    vertices: [usize; 3],
}

impl Names {
    pub const SAME: Names = Names { axes: [0, 1, 2], vertices: [0, 1, 2] };

    /// Two words, each with all three letters: the first is in place of x, or of a.
    pub fn parse(words: &[&str]) -> Option<Names> {
        let &[axes, vertices] = words else { return None };
        let places = |word: &str, letters: &str| {
            let places: Option<Vec<usize>> =
                word.chars().map(|letter| letters.find(letter)).collect();
            let places: [usize; 3] = places?.try_into().ok()?;
            (0..3).all(|i| places.contains(&i)).then_some(places)
        };
        Some(Names { axes: places(axes, "xyz")?, vertices: places(vertices, "abc")? })
    }

    /// The input in place of an input. The origin, the direction and the ends stay what they are.
    pub fn input(&self, i: usize) -> usize {
        match i {
            0..6 => i / 3 * 3 + self.axes[i % 3],
            6..15 => 6 + 3 * self.vertices[i / 3 - 2] + self.axes[i % 3],
            _ => i,
        }
    }
}
