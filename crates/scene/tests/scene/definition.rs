//! The fast answers are those of the definition.

use crate::drawn::{Met, Reference, compare_many, compare_mesh};
use crate::spheres::{icosphere, matlab_sphere};

fn check(met: Met) {
    let few = met.rays / 50;
    assert!(
        few < met.hits && few < met.ties && few < met.segments,
        "{met:?}"
    );
    assert!(met.invalid < met.rays / 2, "{met:?}");
}

#[test]
fn hits_of_f32_scenes_are_those_of_the_definition() {
    check(compare_many::<f32>(1, 2_000, Reference::Definition));
}

#[test]
fn hits_of_f64_scenes_are_those_of_the_definition() {
    check(compare_many::<f64>(1, 1_000, Reference::Definition));
}

#[test]
fn more_hits_are_those_of_a_walk_over_all_faces() {
    check(compare_many::<f32>(2, 4_000, Reference::Walk));
    check(compare_many::<f64>(2, 4_000, Reference::Walk));
}

#[test]
fn hits_of_spheres_are_those_of_a_walk_over_all_faces() {
    // One is welded, the other has a seam, and faces without area.
    for met in [
        compare_mesh(&icosphere(2), 1, 600),
        compare_mesh(&matlab_sphere(12), 1, 600),
    ] {
        assert!(300 < met.hits && 100 < met.ties, "{met:?}");
    }
}
