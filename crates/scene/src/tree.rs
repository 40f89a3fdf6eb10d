//! The tree of boxes, and a ray's way through it.

use crate::aabb::{Boxes, LANES};
use crate::slab::TreeRay;
use arrayvec::ArrayVec;

/// Children with their boxes: two cache lines.
#[repr(align(64))]
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub bounds: Boxes,
    /// Leaves without faces where there are fewer.
    pub children: [Child; LANES],
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

/// The most children that wait: on each level all but the one that is visited.
const MOST_WAITING: usize = (LANES - 1) * DEEPEST;

/// A child whose box the ray enters.
#[derive(Clone, Copy)]
struct Waiting {
    child: Child,
    /// A lower bound on where it does.
    from: f32,
}

/// Calls `visit` for the place of each face whose box the ray meets, roughly from near to far. If `visit` gives a t, hits
/// beyond that t no longer count.
#[inline(always)]
pub fn walk(nodes: &[Node], ray: &mut TreeRay, mut visit: impl FnMut(u32) -> Option<f64>) {
    let mut waiting = ArrayVec::new();
    let mut next = (!nodes.is_empty()).then_some(Child::node(0));
    while let Some(child) = next {
        let nearest = match child.place() {
            Ok(place) => enter(&nodes[place], ray, &mut waiting),
            Err(faces) => {
                for face in faces {
                    if let Some(t) = visit(face) {
                        ray.shorten(t);
                    }
                }
                None
            }
        };
        next = nearest.or_else(|| {
            let mut waiting = std::iter::from_fn(|| waiting.pop());
            let met = waiting.find(|it| !ray.ends_before(it.from));
            met.map(|it| it.child)
        });
    }
}

/// Gives the nearest child of a node whose box the ray enters. The others wait, the nearest of them last.
#[inline(always)]
fn enter(
    node: &Node,
    ray: &TreeRay,
    waiting: &mut ArrayVec<Waiting, MOST_WAITING>,
) -> Option<Child> {
    let entries = ray.enters(&node.bounds);
    let from = entries.from;
    let mut entered = entries.map(|k| Waiting {
        child: node.children[k],
        from: from[k],
    });
    let mut nearest = entered.next()?;
    let first = waiting.len();
    for mut other in entered {
        if other.from < nearest.from {
            std::mem::swap(&mut other, &mut nearest);
        }
        let mut place = waiting.len();
        waiting.push(other);
        while first < place && waiting[place - 1].from < other.from {
            waiting.swap(place - 1, place);
            place -= 1;
        }
    }
    Some(nearest.child)
}
