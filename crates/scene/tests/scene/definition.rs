//! The fast answers are those of the definition.

use crate::drawn::{Met, compare_many};

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
    check(compare_many::<f32>(1, 3_000));
}

#[test]
fn hits_of_f64_scenes_are_those_of_the_definition() {
    check(compare_many::<f64>(1, 1_500));
}
