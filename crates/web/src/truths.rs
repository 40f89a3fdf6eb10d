//! The truths of many cases, as numbers of four bytes.

use hairline::{Batch, Case, Contact, ContactKind, Feature, Float, Layers, Truth};

/// The truths of cases of 17 numbers: origin, direction, a, b, c, t_min, t_max; little-endian.
pub fn codes(numbers: &[f64], in_f32: bool) -> Vec<u8> {
    let codes = match in_f32 {
        true => codes_in::<f32>(numbers),
        false => codes_in::<f64>(numbers),
    };
    codes.into_iter().flat_map(u32::to_le_bytes).collect()
}

fn codes_in<F: Float>(numbers: &[f64]) -> Vec<u32> {
    let mut batch = Batch::new();
    for row in numbers.chunks_exact(17) {
        batch.push(&case_of::<F>(row));
    }
    let mut truths = Vec::new();
    batch.truths(&mut truths, &mut Layers::default());
    truths.iter().map(code).collect()
}

/// A case from 17 numbers.
fn case_of<F: Float>(row: &[f64]) -> Case<F> {
    let vector = |i: usize| [0, 1, 2].map(|k| F::from_f64(row[3 * i + k]));
    let [t_min, t_max] = [15, 16].map(|i| F::from_f64(row[i]));
    Case::new(vector(0), vector(1), [vector(2), vector(3), vector(4)]).on(t_min, t_max)
}

/// From the lowest bit: 3 bits of the class; of a crossing 1 of the facing, 3 of the place, 4 of the feature, 2 of the
/// sign of t; of a contact 2 of the kind, 4 of the feature, and whether ray and line meet the triangle.
fn code(truth: &Truth) -> u32 {
    let feature = |feature: Feature| {
        Feature::ALL
            .iter()
            .position(|other| *other == feature)
            .unwrap_or(0) as u32
    };
    let contact = |class: u32, contact: &Contact| {
        let (kind, at) = match contact.kind {
            ContactKind::None => (0, 0),
            ContactKind::Point(at) => (1, feature(at)),
            ContactKind::Segment => (2, 0),
        };
        let meets = u32::from(contact.meets_ray) | u32::from(contact.meets_line) << 1;
        class | kind << 3 | at << 5 | meets << 9
    };
    match truth {
        Truth::Transversal(crossing) => {
            let sign = (crossing.t_sign as i8 + 1) as u32;
            let place = crossing.place as u32;
            let facing = crossing.facing as u32;
            facing << 3 | place << 4 | feature(crossing.feature) << 7 | sign << 11
        }
        Truth::Parallel => 1,
        Truth::Coplanar(at) => contact(2, at),
        Truth::Degenerate(at) => contact(3, at),
        Truth::Invalid => 4,
    }
}
