//! Other names of the axes and the vertices: "Other names" in the guide.

/// The axis in place of each axis, and the vertex in place of each vertex.
#[derive(Clone, Copy)]
pub struct Names {
    axes: [usize; 3],
    vertices: [usize; 3],
}

/// The place of each letter of a word that has all three of them.
pub fn places(word: &str, letters: &str) -> Option<[usize; 3]> {
    let mut places = Vec::new();
    for letter in word.chars() {
        places.push(letters.find(letter)?);
    }
    let places: [usize; 3] = places.try_into().ok()?;
    let has_all = (0..3).all(|place| places.contains(&place));
    has_all.then_some(places)
}

impl Names {
    pub const SAME: Names = Names {
        axes: [0, 1, 2],
        vertices: [0, 1, 2],
    };

    /// Two words, each with all three letters: the first is in place of x, or of a.
    pub fn parse(words: &[&str]) -> Option<Names> {
        let &[axes, vertices] = words else {
            return None;
        };
        Some(Names {
            axes: places(axes, "xyz")?,
            vertices: places(vertices, "abc")?,
        })
    }

    /// The input in place of an input. The origin, the direction and the ends stay what they are.
    ///
    /// The domain has one bound for all axes, and one for a, b and c, and rounding knows no names. So a proof also holds
    /// of the program with other names.
    pub fn input(&self, i: usize) -> usize {
        match i {
            0..6 => i / 3 * 3 + self.axes[i % 3],
            6..15 => 6 + 3 * self.vertices[i / 3 - 2] + self.axes[i % 3],
            _ => i,
        }
    }
}
