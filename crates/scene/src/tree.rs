//! The tree of boxes, and a ray's way through it.

use crate::aabb::Aabb;
use crate::slab::TreeRay;

/// Two children with their boxes: one cache line.
#[repr(align(64))]
#[derive(Clone, Copy, Debug)]
pub struct Node {
    pub bounds: [Aabb; 2],
    /// The node of each child, or the first place of a leaf's faces.
    pub child: [u32; 2],
    /// How many faces a leaf has, or [`IS_NODE`].
    pub count: [u32; 2],
}

/// Marks a child that is a node.
pub const IS_NODE: u32 = u32::MAX;

/// The depth below which no tree goes: the builder's own limit, and halves of 2^32 faces.
pub const DEEPEST: usize = 100;

/// Calls `visit` for the place of each face whose box the ray meets, roughly from near to far. If `visit` gives a t, hits
/// beyond that t no longer count.
#[inline(always)]
pub fn walk(nodes: &[Node], ray: &mut TreeRay, mut visit: impl FnMut(u32) -> Option<f64>) {
    if nodes.is_empty() {
        return;
    }
    let mut waiting = [(0u32, 0.0f64); DEEPEST];
    let mut depth = 0;
    let mut node = &nodes[0];
    loop {
        let entries = [ray.enters(&node.bounds[0]), ray.enters(&node.bounds[1])];
        let second_is_nearer = match entries {
            [Some(first), Some(second)] => second < first,
            _ => false,
        };
        let first = usize::from(second_is_nearer);
        // The farther child is pushed first, so that the nearer one comes out first. Leaves are visited at once.
        let mut nearer = None;
        let mut farther = None;
        for (place, k) in [(&mut nearer, first), (&mut farther, 1 - first)] {
            let Some(from) = entries[k] else {
                continue;
            };
            if node.count[k] == IS_NODE {
                *place = Some((node.child[k], from));
                continue;
            }
            if ray.ends_before(from) {
                continue;
            }
            for face in node.child[k]..node.child[k] + node.count[k] {
                if let Some(t) = visit(face) {
                    ray.shorten(t);
                }
            }
        }
        for next in [farther, nearer].into_iter().flatten() {
            waiting[depth] = next;
            depth += 1;
        }
        node = loop {
            if depth == 0 {
                return;
            }
            depth -= 1;
            let (next, from) = waiting[depth];
            if !ray.ends_before(from) {
                break &nodes[next as usize];
            }
        };
    }
}
