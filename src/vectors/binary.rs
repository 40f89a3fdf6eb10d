//! The binary format: a head of 16 bytes, then records of 184 bytes, all little-endian, a record a triangle.
//! docs/guide/vectors.md has the table.

use super::number::nearest;
use super::{Test, Triangle};
use crate::judge::Obligation;
use crate::truth::{Facing, Feature, Place};

/// The bytes of a record.
const RECORD: usize = 184;

/// The classes behind the features, in the order of their numbers.
const CLASSES: [&str; 4] = ["parallel", "coplanar", "degenerate", "invalid"];

/// The reasons in the order of their bits.
const REASONS: [&str; 5] = ["boundary", "ends", "coplanar", "degenerate", "invalid"];

/// The bytes before the records.
pub fn head() -> Vec<u8> {
    let mut bytes = b"RAYTRIV1".to_vec();
    bytes.extend((RECORD as u32).to_le_bytes());
    bytes.extend(0u32.to_le_bytes());
    bytes
}

/// The records of a test, which has this number in its set.
pub fn records(number: u64, test: &Test) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(RECORD * test.triangles.len());
    for (i, triangle) in test.triangles.iter().enumerate() {
        for number in test.ray.iter().chain(&triangle.numbers) {
            bytes.extend(number.pattern.to_le_bytes());
        }
        let value = |i: usize| triangle.values.as_ref().map_or(f64::NAN, |v| nearest(&v[i]));
        // One NaN on every machine.
        let pattern = |x: f64| if x.is_nan() { 0x7ff8 << 48 } else { x.to_bits() };
        for i in 0..4 {
            bytes.extend(pattern(value(i)).to_le_bytes());
        }
        bytes.extend((number as u32).to_le_bytes());
        bytes.extend([i as u8, test.triangles.len() as u8]);
        bytes.push(if test.scalar == "f32" { 32 } else { 64 });
        bytes.extend([triangle.result(), triangle.closed(), triangle.open()].map(code));
        bytes.extend(places(triangle));
        let group = match test.group.map(|group| group.result()) {
            None => 0,
            Some("exactly-one") => 1,
            Some("at-least-one") => 2,
            Some(_) => 3,
        };
        bytes.extend([group, 0]);
    }
    bytes
}

fn code(obligation: Obligation) -> u8 {
    match obligation {
        Obligation::MustMiss => 0,
        Obligation::MustHit => 1,
        Obligation::Free => 2,
    }
}

/// Where, place, facing, and the reasons of what is free.
fn places(triangle: &Triangle) -> [u8; 4] {
    let reasons = triangle.free_because();
    let bits =
        REASONS.iter().rev().fold(0, |bits, name| bits << 1 | u8::from(reasons.contains(name)));
    let at = |place: Option<usize>| place.map_or(u8::MAX, |place| place as u8);
    let Some(crossing) = triangle.truth.crossing() else {
        let class = CLASSES.iter().position(|name| *name == triangle.place());
        return [at(class.map(|class| Feature::ALL.len() + class)), u8::MAX, u8::MAX, bits];
    };
    let feature = Feature::ALL.iter().position(|feature| *feature == crossing.feature);
    let place = Place::ALL.iter().position(|place| *place == crossing.place);
    [at(feature), at(place), u8::from(crossing.facing == Facing::Back), bits]
}
