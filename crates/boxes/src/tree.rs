//! The boxes of a mesh: those of its faces, and those of the nodes of a simple hierarchy over them. Each node is cut at the
//! median of its faces' centres, on the axis where the centres lie farthest apart.

use crate::case::{BoxCase, each_axis};
use hairline_core::Float;
use hairline_core::case::Draw;
use std::collections::VecDeque;
use std::fmt;

type Point = [f64; 3];

/// The boxes of a mesh.
pub struct Tree {
    name: String,
    /// A box a face.
    faces: Vec<[Point; 2]>,
    /// A box a node with more than one face, the largest first.
    nodes: Vec<[Point; 2]>,
}

/// How often the origin of a ray is drawn again if it is the target.
const TRIES: usize = 8;

impl Tree {
    /// From a name and triangles. An error if there are none.
    pub fn new(name: String, triangles: &[[Point; 3]]) -> Result<Tree, String> {
        if triangles.is_empty() {
            return Err(format!("{name} has no triangles, so it has no boxes"));
        }
        let faces: Vec<[Point; 2]> = triangles.iter().map(|corners| around(corners)).collect();
        let mut order: Vec<usize> = (0..faces.len()).collect();
        let mut nodes = Vec::new();
        let mut waiting = VecDeque::from([0..faces.len()]);
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
        let share = draw.unit();
        let bounds = match self.nodes.as_slice() {
            nodes if !nodes.is_empty() && draw.coin() => nodes[place(share * share, nodes.len())],
            _ => self.faces[place(share, self.faces.len())],
        };
        let mut sight = Sight::at(&mut draw, bounds);
        for _ in 0..TRIES {
            if sight.origin != sight.target {
                break;
            }
            sight = Sight::at(&mut draw, bounds);
        }
        sight.case(&mut draw)
    }
}

/// The place of a share of a list.
fn place(share: f64, length: usize) -> usize {
    let place = (share * length as f64) as usize;
    place.min(length - 1)
}

/// The box around some points.
fn around(points: &[Point]) -> [Point; 2] {
    let least = |axis: usize| points.iter().map(|x| x[axis]).fold(f64::INFINITY, f64::min);
    let most = |axis: usize| {
        points
            .iter()
            .map(|x| -x[axis])
            .fold(f64::INFINITY, f64::min)
    };
    [each_axis(least), each_axis(|axis| -most(axis))]
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

/// A ray from a point to another, and a box that it is aimed at.
struct Sight<F> {
    min: [F; 3],
    max: [F; 3],
    origin: [F; 3],
    target: [F; 3],
}

impl<F: Float> Sight<F> {
    /// At a corner, an edge, a face or the inside, from inside or from up to four sizes away, on some axes straight.
    fn at(draw: &mut Draw, [min, max]: [Point; 2]) -> Sight<F> {
        let size = each_axis(|i| max[i] - min[i]);
        let largest = size.into_iter().fold(0.0, f64::max);
        let is_inside = draw.below(3) == 0;
        let number = F::from_f64;
        let mut sight = Sight {
            min: min.map(number),
            max: max.map(number),
            origin: min.map(number),
            target: min.map(number),
        };
        for i in 0..3 {
            let within = number(min[i] + draw.unit() * size[i]);
            sight.target[i] = match draw.below(3) {
                0 => sight.min[i],
                1 => sight.max[i],
                _ => within,
            };
            let beside = 8.0 * draw.unit() - 4.0;
            let inside = number(min[i] + draw.unit() * size[i]);
            let outside = number(min[i] + beside * largest);
            sight.origin[i] = match draw.below(8) {
                0 => sight.target[i],
                _ if is_inside => inside,
                _ => outside,
            };
        }
        sight
    }

    fn case(&self, draw: &mut Draw) -> BoxCase<F> {
        let length = F::from_f64(0.25 + 3.75 * draw.unit());
        let direction = each_axis(|i| (self.target[i] - self.origin[i]) * length);
        BoxCase::new(self.origin, direction, [self.min, self.max])
    }
}

impl fmt::Display for Tree {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.name)
    }
}
