//! The tree of boxes, and a ray's way through it.

use crate::aabb::Aabb;
use crate::slab::TreeRay;

/// Two children with their boxes: one cache line.
#[repr(align(64))]
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub bounds: [Aabb; 2],
    pub children: [Child; 2],
}

/// Another node, or a leaf with some faces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Child {
    /// The place of the node, or of the leaf's first face.
    first: u32,
    /// The number of the leaf's faces, or [`IS_NODE`].
    count: u32,
}

/// Marks a child that is a node.
const IS_NODE: u32 = u32::MAX;

impl Child {
    pub const fn node(place: u32) -> Child {
        Child {
            first: place,
            count: IS_NODE,
        }
    }

    pub const fn leaf(first: u32, count: u32) -> Child {
        Child { first, count }
    }

    /// The place of the node; an error with the places of the faces if it is a leaf.
    #[inline(always)]
    pub fn place(self) -> Result<usize, std::ops::Range<u32>> {
        if self.count == IS_NODE {
            return Ok(self.first as usize);
        }
        Err(self.first..self.first + self.count)
    }
}

/// The depth below which no tree goes: the builder's own limit, and halves of 2^32 faces.
pub const DEEPEST: usize = 100;

/// Calls `visit` for the place of each face whose box the ray meets, roughly from near to far. If `visit` gives a t, hits
/// beyond that t no longer count.
#[inline(always)]
pub fn walk(nodes: &[Node], ray: &mut TreeRay, mut visit: impl FnMut(u32) -> Option<f64>) {
    if nodes.is_empty() {
        return;
    }
    let root = (Child::node(0), f64::NEG_INFINITY);
    let mut waiting = [root; DEEPEST];
    let mut count = 1;
    while count != 0 {
        count -= 1;
        let (child, from) = waiting[count];
        if ray.ends_before(from) {
            continue;
        }
        let node = match child.place() {
            Ok(place) => &nodes[place],
            Err(faces) => {
                for face in faces {
                    if let Some(t) = visit(face) {
                        ray.shorten(t);
                    }
                }
                continue;
            }
        };
        let first = ray.enters(&node.bounds[0]);
        let second = ray.enters(&node.bounds[1]);
        // What is pushed last comes out first: the nearer child.
        let second_is_nearer = match (first, second) {
            (Some(first), Some(second)) => second < first,
            _ => false,
        };
        let [far, near] = if second_is_nearer { [0, 1] } else { [1, 0] };
        let entries = [first, second];
        for k in [far, near] {
            if let Some(from) = entries[k] {
                waiting[count] = (node.children[k], from);
                count += 1;
            }
        }
    }
}
