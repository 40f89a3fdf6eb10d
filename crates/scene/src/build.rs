//! Builds the tree: the surface area heuristic with bins (Wald 2007, "On fast construction of SAH-based bounding volume
//! hierarchies").

use crate::aabb::{Aabb, Boxes, LANES};
use crate::tree::{Child, DEEPEST, Node};
use std::ops::Range;

const BINS: usize = 16;
/// A leaf has at most this many faces.
const MOST_IN_LEAF: usize = 8;
/// More than this many are always cut, if a cut helps at all.
const MOST_UNCUT: usize = 2;
/// Below this depth faces are halved, whatever it costs, so that no tree is deeper than [`DEEPEST`].
const DEEPEST_CUT: usize = DEEPEST - 34;

/// The nodes over some boxes, the root first, and the boxes' places in the order of the leaves.
pub fn build(boxes: &[Aabb]) -> (Vec<Node>, Vec<u32>) {
    let mut builder = Builder {
        boxes,
        order: (0..boxes.len() as u32).collect(),
        nodes: Vec::new(),
    };
    if !boxes.is_empty() {
        let all = builder.part(0..boxes.len(), 0);
        builder.add_node(&all, 0);
    }
    (builder.nodes, builder.order)
}

/// Faces that belong together.
#[derive(Clone)]
struct Part {
    faces: Range<usize>,
    bounds: Aabb,
    /// The place at which they are cut; none if they are a leaf.
    middle: Option<usize>,
}

struct Builder<'a> {
    boxes: &'a [Aabb],
    order: Vec<u32>,
    nodes: Vec<Node>,
}

/// The faces whose centres lie in one slice of the centres' extent.
#[derive(Clone, Copy)]
struct Bin {
    bounds: Aabb,
    count: usize,
}

impl Bin {
    const EMPTY: Bin = Bin {
        bounds: Aabb::EMPTY,
        count: 0,
    };

    fn join(&mut self, other: &Bin) {
        self.bounds.join(&other.bounds);
        self.count += other.count;
    }

    /// The cost of its faces: a box of no faces costs nothing.
    fn cost(&self) -> f32 {
        half_area(&self.bounds) * self.count as f32
    }
}

/// Slices of equal width along an axis.
#[derive(Clone, Copy)]
struct Slices {
    axis: usize,
    start: f32,
    per_length: f32,
}

impl Slices {
    /// None if the centres have no extent on the axis.
    fn new(centres: &Aabb, axis: usize) -> Option<Slices> {
        let width = centres.max[axis] - centres.min[axis];
        let per_length = BINS as f32 / width;
        (0.0 < width && per_length.is_finite()).then_some(Slices {
            axis,
            start: centres.min[axis],
            per_length,
        })
    }

    #[inline(always)]
    fn of(&self, bounds: &Aabb) -> usize {
        let from_start = centre(bounds)[self.axis] - self.start;
        ((from_start * self.per_length) as usize).min(BINS - 1)
    }
}

/// Half of a box's surface; 0 of an empty box.
fn half_area(bounds: &Aabb) -> f32 {
    let size = [0, 1, 2].map(|axis| (bounds.max[axis] - bounds.min[axis]).max(0.0));
    size[0] * size[1] + size[1] * size[2] + size[2] * size[0]
}

/// Twice a box's centre.
#[inline(always)]
fn centre(bounds: &Aabb) -> [f32; 3] {
    [0, 1, 2].map(|axis| bounds.min[axis] + bounds.max[axis])
}

/// The part with the largest box of those that are cut, and the place of the cut.
fn largest_cut(parts: &[Part]) -> Option<(usize, usize)> {
    let cuts = parts.iter().enumerate().filter_map(|(k, part)| {
        let area = half_area(&part.bounds);
        part.middle.map(|middle| (area, k, middle))
    });
    let largest = cuts.max_by(|a, b| a.0.total_cmp(&b.0));
    largest.map(|(_, k, middle)| (k, middle))
}

impl Builder<'_> {
    /// Some faces, ordered for the cut through them.
    fn part(&mut self, faces: Range<usize>, depth: usize) -> Part {
        Part {
            bounds: self.around(faces.start, faces.end),
            middle: self.cut(faces.start, faces.end, depth),
            faces,
        }
    }

    /// Adds the node over a part, and all below it. Its children are what cuts of the largest ones leave.
    fn add_node(&mut self, part: &Part, depth: usize) -> u32 {
        let place = self.nodes.len();
        self.nodes.push(Node {
            bounds: Boxes::EMPTY,
            children: [Child::leaf(0, 0); LANES],
        });
        let mut parts = vec![part.clone()];
        let mut depth = depth;
        while parts.len() < LANES {
            let Some((largest, middle)) = largest_cut(&parts) else {
                break;
            };
            let faces = parts.swap_remove(largest).faces;
            depth += 1;
            parts.push(self.part(faces.start..middle, depth));
            parts.push(self.part(middle..faces.end, depth));
        }
        for (k, part) in parts.iter().enumerate() {
            self.nodes[place].bounds.set(k, &part.bounds);
            self.nodes[place].children[k] = match part.middle {
                Some(_) => Child::node(self.add_node(part, depth)),
                None => Child::leaf(part.faces.start as u32, part.faces.len() as u32),
            };
        }
        place as u32
    }

    fn around(&self, start: usize, end: usize) -> Aabb {
        let mut bounds = Aabb::EMPTY;
        for face in &self.order[start..end] {
            bounds.join(&self.boxes[*face as usize]);
        }
        bounds
    }

    /// Orders faces so that those before the place that it gives belong together, and those after it. None for a leaf.
    fn cut(&mut self, start: usize, end: usize, depth: usize) -> Option<usize> {
        let count = end - start;
        let halves = (MOST_IN_LEAF < count).then_some(start + count / 2);
        if count <= 2 || DEEPEST_CUT <= depth {
            return halves;
        }
        let mut centres = Aabb::EMPTY;
        for face in &self.order[start..end] {
            let centre = centre(&self.boxes[*face as usize]);
            centres.join(&Aabb {
                min: centre,
                max: centre,
            });
        }
        let axes = (0..3).filter_map(|axis| Slices::new(&centres, axis));
        let cuts = axes.filter_map(|slices| self.cheapest_cut(start, end, slices));
        let Some((cost, slices, first)) = cuts.min_by(|a, b| a.0.total_cmp(&b.0)) else {
            return halves;
        };
        let area = half_area(&self.around(start, end));
        let is_cheaper = cost + area < area * count as f32;
        if count <= MOST_UNCUT && !is_cheaper {
            return None;
        }
        let boxes = self.boxes;
        let members = &mut self.order[start..end];
        let mut before = 0;
        for i in 0..members.len() {
            if slices.of(&boxes[members[i] as usize]) < first {
                members.swap(i, before);
                before += 1;
            }
        }
        Some(start + before)
    }

    /// The cost of the cheapest cut between two slices, and the first slice after it; none if one side is always empty.
    fn cheapest_cut(
        &self,
        start: usize,
        end: usize,
        slices: Slices,
    ) -> Option<(f32, Slices, usize)> {
        let mut bins = [Bin::EMPTY; BINS];
        for face in &self.order[start..end] {
            let bounds = self.boxes[*face as usize];
            bins[slices.of(&bounds)].join(&Bin { bounds, count: 1 });
        }
        let mut after = [Bin::EMPTY; BINS + 1];
        for k in (0..BINS).rev() {
            after[k] = after[k + 1];
            after[k].join(&bins[k]);
        }
        let mut before = Bin::EMPTY;
        let mut best: Option<(f32, Slices, usize)> = None;
        for k in 1..BINS {
            before.join(&bins[k - 1]);
            let cost = before.cost() + after[k].cost();
            let cuts = 0 < before.count && 0 < after[k].count;
            if cuts && best.is_none_or(|(least, ..)| cost < least) {
                best = Some((cost, slices, k));
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use hairline_core::case::Draw;

    fn depth(nodes: &[Node], place: usize) -> usize {
        let node = &nodes[place];
        let places = node.children.iter().filter_map(|child| child.place().ok());
        1 + places.map(|place| depth(nodes, place)).max().unwrap_or(0)
    }

    #[test]
    fn every_box_is_in_one_leaf_and_in_all_boxes_above_it() {
        for (count, spread) in [
            (0, 0),
            (1, 0),
            (2, 0),
            (9, 0),
            (3000, 0),
            (3000, 1),
            (3000, 140),
        ] {
            let mut draw = Draw::new("boxes", 1, count);
            let boxes: Vec<Aabb> = (0..count)
                .map(|_| {
                    let exponent = -draw.integer(0, spread) as i32;
                    let corner = [(); 3].map(|()| draw.with_exponent::<f32>(exponent));
                    let mut bounds = Aabb::EMPTY;
                    let other = corner.map(|x| x * 1.25);
                    for point in [corner, other] {
                        bounds.join(&Aabb {
                            min: point,
                            max: point,
                        });
                    }
                    bounds
                })
                .collect();
            let (nodes, order) = build(&boxes);
            let mut sorted = order.clone();
            sorted.sort();
            assert!(sorted.into_iter().eq(0..count as u32));
            let mut covered = vec![0; boxes.len()];
            for node in &nodes {
                for k in 0..LANES {
                    let mut bounds = node.bounds.get(k);
                    let places = match node.children[k].place() {
                        Err(places) => places,
                        Ok(place) => {
                            for below in 0..LANES {
                                bounds.join(&nodes[place].bounds.get(below));
                            }
                            assert_eq!(bounds, node.bounds.get(k));
                            continue;
                        }
                    };
                    assert!(places.len() <= MOST_IN_LEAF);
                    for place in places {
                        covered[place as usize] += 1;
                        bounds.join(&boxes[order[place as usize] as usize]);
                    }
                    assert_eq!(bounds, node.bounds.get(k));
                }
            }
            assert!(covered.iter().all(|times| *times == 1), "{count}");
            assert!(nodes.is_empty() || depth(&nodes, 0) < DEEPEST, "{count}");
        }
    }

    #[test]
    fn a_tree_over_points_that_halve_their_distance_is_not_too_deep() {
        let point = |k: i32| [2f32.powi(-k); 3];
        let boxes: Vec<Aabb> = (0..4000)
            .map(|k| point(k % 149))
            .map(|min| Aabb { min, max: min })
            .collect();
        let (nodes, _) = build(&boxes);
        assert!(depth(&nodes, 0) < DEEPEST);
    }
}
