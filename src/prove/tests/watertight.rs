//! What follows from the edge values of all paths together.

use super::{difference, recorded};
use crate::arith::recorded::{Comparison, Operation, Place, Recorded};
use crate::kernel::{Compared, Path};
use crate::prove::Symmetry;
use crate::prove::watertight::symmetry;

/// x(p)·y(q) - x(q)·y(p) of the coordinates relative to the origin along two axes, of the edges bc, ca and ab.
fn edges([x, y]: [u8; 2]) -> Recorded {
    let minor = |p: u8, q: u8| {
        difference(p, 0, x) * difference(q, 0, y) - difference(q, 0, x) * difference(p, 0, y)
    };
    // Only their operations are wanted.
    minor(2, 3) + minor(3, 1) + minor(1, 2) + Recorded::input(3) + Recorded::input(4)
}

/// What a path compares.
type Compares = fn(&Path) -> Comparison;

/// A path whose gate 0 compares edge values on a picture of these axes, after one decision, if it is given.
fn path(axes: [u8; 2], decision: Option<(Compares, bool)>) -> Path {
    let (mut path, _) = recorded(|| edges(axes));
    let is_minor = |(i, operation): (usize, &Operation)| match operation {
        Operation::Sub(a, _) => {
            let first = path.operations[*a as usize];
            matches!(first, Operation::Mul(..)).then_some(i as Place)
        }
        _ => None,
    };
    let quantities: Vec<Place> = path.operations.iter().enumerate().filter_map(is_minor).collect();
    assert_eq!(quantities.len(), 3);
    path.compared = vec![Compared { gate: 0, refuse: None, quantities, decisions: 0 }];
    path.decisions = decision.iter().map(|(of, answer)| (of(&path), *answer)).collect();
    path
}

/// The place of an input.
fn input(path: &Path, wanted: u8) -> Place {
    let found = path.operations.iter().position(|op| *op == Operation::Input(wanted));
    found.expect("it is used") as Place
}

#[test]
fn all_edges_that_one_ray_may_meet_must_be_of_the_same_picture() {
    let of = |paths: &[Path]| symmetry(paths, |gate| gate == 0);
    let by_ray: Compares = |path| Comparison::Less(input(path, 3), input(path, 4));
    let by_vertex: Compares = |path| Comparison::Negative(input(path, 6));
    let (one, other) = ([0, 1], [0, 2]);
    assert_eq!(of(&[path(one, None)]), Symmetry::ExactSigns);
    // The ray alone chooses the picture.
    let paths = [path(one, Some((by_ray, true))), path(other, Some((by_ray, false)))];
    assert_eq!(of(&paths), Symmetry::ExactSigns);
    // A vertex does: two triangles of an edge may have two pictures.
    let paths = [path(one, Some((by_vertex, true))), path(other, Some((by_vertex, false)))];
    assert_eq!(of(&paths), Symmetry::Negatives);
    let paths = [path(one, Some((by_vertex, true))), path(one, Some((by_vertex, false)))];
    assert_eq!(of(&paths), Symmetry::ExactSigns);
    // The mirrored picture is another one: signs are the other way round.
    let paths = [path(one, Some((by_vertex, true))), path([1, 0], Some((by_vertex, false)))];
    assert_eq!(of(&paths), Symmetry::Negatives);
    assert_eq!(symmetry(&[path(one, None)], |_| false), Symmetry::None);
}
