//! The boxes of a mesh: those of its faces, and those of the nodes of a simple hierarchy over them. Each node is cut at the
//! median of its faces' centres, on the axis where the centres lie farthest apart.

use crate::case::{BoxCase, each_axis};
use hairline_core::Float;
use hairline_core::case::Draw;
use std::collections::VecDeque;

type Point = [f64; 3];

/// The least and the greatest corner of a box.
type Bounds = [Point; 2];

/// The boxes of a mesh.
pub struct Tree {
    pub(crate) name: String,
    /// A box a face.
    faces: Vec<Bounds>,
    /// A box a node with more than one face; a node stands before those below it.
    nodes: Vec<Bounds>,
}

impl Tree {
    /// The boxes of triangles. An error if there are none.
    pub fn new(name: String, triangles: &[[Point; 3]]) -> Result<Tree, String> {
        if triangles.is_empty() {
            return Err(format!("{name} has no triangles, so it has no boxes"));
        }
        let faces: Vec<Bounds> = triangles.iter().map(|corners| around(corners)).collect();
        let mut order: Vec<usize> = (0..faces.len()).collect();
        let mut nodes = Vec::new();
        let mut waiting = VecDeque::from([&mut order[..]]);
        while let Some(members) = waiting.pop_front() {
            if members.len() < 2 {
                continue;
            }
            let corners: Vec<Point> = members.iter().flat_map(|face| faces[*face]).collect();
            nodes.push(around(&corners));
            let (smaller, larger) = cut(&faces, members);
            waiting.push_back(smaller);
            waiting.push_back(larger);
        }
        Ok(Tree { name, faces, nodes })
    }

    /// Case `index` of a seed's set: a box of a face, or of a node, of one near the root more often.
    pub fn case<F: Float>(&self, seed: u64, index: u64) -> BoxCase<F> {
        let mut draw = Draw::new("boxes of a mesh", seed, index);
        let bounds = if draw.coin() || self.nodes.is_empty() {
            self.faces[draw.below(self.faces.len())]
        } else {
            let share = draw.unit() * draw.unit();
            self.nodes[(share * self.nodes.len() as f64) as usize]
        };
        aimed(&mut draw, bounds)
    }
}

/// The box around some points, one at least.
fn around(points: &[Point]) -> Bounds {
    let mut min = points[0];
    let mut max = min;
    for point in points {
        min = each_axis(|i| min[i].min(point[i]));
        max = each_axis(|i| max[i].max(point[i]));
    }
    [min, max]
}

/// Cuts faces into two halves, those with the smaller centres first, on the axis where their centres lie farthest apart.
fn cut<'a>(faces: &[Bounds], members: &'a mut [usize]) -> (&'a mut [usize], &'a mut [usize]) {
    let centres: Vec<Point> = members.iter().map(|face| centre(faces[*face])).collect();
    let [min, max] = around(&centres);
    let spread = each_axis(|axis| max[axis] - min[axis]);
    let longest = (0..3).max_by(|a, b| spread[*a].total_cmp(&spread[*b]));
    let axis = longest.unwrap_or(0);
    let middle = members.len() / 2;
    members.select_nth_unstable_by(middle, |a, b| {
        let centre_a = centre(faces[*a])[axis];
        let centre_b = centre(faces[*b])[axis];
        // Equal centres are ordered too, so that the tree is the same everywhere.
        centre_a.total_cmp(&centre_b).then(a.cmp(b))
    });
    members.split_at_mut(middle)
}

fn centre([min, max]: Bounds) -> Point {
    each_axis(|axis| 0.5 * min[axis] + 0.5 * max[axis])
}

/// A ray at a corner, an edge, a face or the inside of a box, from inside or from up to four sizes away. On some axes it
/// is straight: its direction is 0 there.
fn aimed<F: Float>(draw: &mut Draw, bounds: Bounds) -> BoxCase<F> {
    let [min, max] = bounds;
    let size = each_axis(|axis| max[axis] - min[axis]);
    let largest = size.into_iter().fold(0.0, f64::max);
    let is_inside = draw.below(3) == 0;
    // A bit an axis; never all three.
    let straight = if draw.coin() { 0 } else { draw.below(7) };
    let mut target = min;
    let mut origin = min;
    for axis in 0..3 {
        target[axis] = match draw.below(3) {
            0 => min[axis],
            1 => max[axis],
            _ => min[axis] + draw.unit() * size[axis],
        };
        let share = draw.unit();
        let is_straight = straight >> axis & 1 == 1;
        origin[axis] = if is_straight {
            target[axis]
        } else if is_inside {
            min[axis] + share * size[axis]
        } else {
            min[axis] + (8.0 * share - 4.0) * largest
        };
    }
    let [from, to] = [rounded(origin), rounded(target)];
    let length = F::from_f64(0.25 + 3.75 * draw.unit());
    let direction = each_axis(|axis| (to[axis] - from[axis]) * length);
    BoxCase::new(from, direction, bounds.map(rounded))
}

fn rounded<F: Float>(point: Point) -> [F; 3] {
    point.map(F::from_f64)
}
