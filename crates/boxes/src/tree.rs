//! The boxes of a mesh: those of its faces, and those of the nodes of a simple hierarchy over them. Each node is cut at the
//! median of its faces' centres, on the axis where the centres lie farthest apart.

use crate::case::{BoxCase, each_axis};
use hairline_core::Float;
use hairline_core::case::Draw;
use std::collections::VecDeque;

type Point = [f64; 3];

/// The boxes of a mesh.
pub struct Tree {
    pub(crate) name: String,
    /// A box a face.
    faces: Vec<[Point; 2]>,
    /// A box a node with more than one face, the largest first.
    nodes: Vec<[Point; 2]>,
}

impl Tree {
    /// From a name and triangles. An error if there are none.
    pub fn new(name: String, triangles: &[[Point; 3]]) -> Result<Tree, String> {
        if triangles.is_empty() {
            return Err(format!("{name} has no triangles, so it has no boxes"));
        }
        let faces: Vec<[Point; 2]> = triangles.iter().map(|corners| around(corners)).collect();
        let mut order: Vec<usize> = (0..faces.len()).collect();
        let mut nodes = Vec::new();
        let mut waiting = VecDeque::new();
        waiting.push_back(0..faces.len());
        while let Some(range) = waiting.pop_front() {
            if range.len() < 2 {
                continue;
            }
            let members = &mut order[range.clone()];
            let corners: Vec<Point> = members.iter().flat_map(|face| faces[*face]).collect();
            nodes.push(around(&corners));
            let middle = range.start + cut(&faces, members);
            waiting.push_back(range.start..middle);
            waiting.push_back(middle..range.end);
        }
        Ok(Tree { name, faces, nodes })
    }

    /// Case `index` of a seed's set: a box of a face, or of a node, the large ones more often.
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
fn around(points: &[Point]) -> [Point; 2] {
    let mut min = points[0];
    let mut max = min;
    for point in points {
        min = each_axis(|i| min[i].min(point[i]));
        max = each_axis(|i| max[i].max(point[i]));
    }
    [min, max]
}

/// Puts the faces with the smaller centres first, half of them; how many these are.
fn cut(faces: &[[Point; 2]], members: &mut [usize]) -> usize {
    let centre = |face: &usize| {
        let [min, max] = faces[*face];
        each_axis(|axis| 0.5 * min[axis] + 0.5 * max[axis])
    };
    let centres: Vec<Point> = members.iter().map(centre).collect();
    let [min, max] = around(&centres);
    let size = |axis: &usize| max[*axis] - min[*axis];
    let longest = (0..3).max_by(|a, b| size(a).total_cmp(&size(b)));
    let axis = longest.unwrap_or(0);
    let middle = members.len() / 2;
    members.select_nth_unstable_by(middle, |a, b| {
        let order = centre(a)[axis].total_cmp(&centre(b)[axis]);
        order.then(a.cmp(b))
    });
    middle
}

/// A ray at a corner, an edge, a face or the inside of a box, from inside or from up to four sizes away, on some axes straight.
fn aimed<F: Float>(draw: &mut Draw, bounds: [Point; 2]) -> BoxCase<F> {
    let [min, max] = bounds;
    let size = each_axis(|i| max[i] - min[i]);
    let largest = size.into_iter().fold(0.0, f64::max);
    let is_inside = draw.below(3) == 0;
    // A bit an axis; never all three.
    let straight = if draw.coin() { 0 } else { draw.below(7) };
    let mut target = min;
    let mut origin = min;
    for i in 0..3 {
        target[i] = match draw.below(3) {
            0 => min[i],
            1 => max[i],
            _ => min[i] + draw.unit() * size[i],
        };
        let share = draw.unit();
        origin[i] = if straight >> i & 1 == 1 {
            target[i]
        } else if is_inside {
            min[i] + share * size[i]
        } else {
            min[i] + (8.0 * share - 4.0) * largest
        };
    }
    let rounded = |point: Point| point.map(F::from_f64);
    let at = rounded(target);
    let from = rounded(origin);
    let length = F::from_f64(0.25 + 3.75 * draw.unit());
    let direction = each_axis(|i| (at[i] - from[i]) * length);
    BoxCase::new(from, direction, bounds.map(rounded))
}
