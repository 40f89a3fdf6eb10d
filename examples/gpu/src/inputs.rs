//! How a shader makes the numbers that its kernel is called with. A compiler may see through the operation that makes them, and compute
//! about other numbers than the rounded ones, which the kernel is asked about.

/// A case's 15 coordinates: origin, direction, a, b, c.
pub type Coordinates = [f32; 15];

/// Where the vertices a, b and c begin.
const A: usize = 6;
const B: usize = 9;
const C: usize = 12;

#[derive(Clone, Copy)]
pub enum Inputs {
    /// They are read.
    Stored,
    /// Each coordinate is a product with a factor of the case.
    Products,
    /// The vertices b and c are sums, a + e.
    Sums,
}

impl Inputs {
    /// Replaces coordinates so that the shader's operation, rounded, makes those that they were. Returns what the shader
    /// multiplies by, negative if b and c are sums.
    pub fn split(self, coordinates: &mut Coordinates) -> f32 {
        match self {
            Inputs::Stored => 1.0,
            Inputs::Products => split_into_products(coordinates),
            Inputs::Sums => split_into_sums(coordinates),
        }
    }

    /// What the hello says of them.
    pub fn told(self) -> &'static str {
        match self {
            Inputs::Stored => "",
            Inputs::Products => ", coordinates are products",
            Inputs::Sums => ", b and c are sums",
        }
    }
}

/// 1 where there is no other factor.
fn split_into_products(coordinates: &mut Coordinates) -> f32 {
    let factor = common_factor(coordinates);
    let found = coordinates.map(|product| other_factor(product, factor));
    if found.contains(&None) {
        return 1.0;
    }
    for (coordinate, x) in coordinates.iter_mut().zip(found) {
        *coordinate = x.expect("none is missing");
    }
    factor
}

/// Below 1, but above half of each significand: a quotient by it is then in the coordinate's own binade, where its products lie
/// closer than floats do, so each float is one.
fn common_factor(coordinates: &Coordinates) -> f32 {
    let significand = |x: &f32| f32::from_bits(x.to_bits() & 0x007f_ffff | 0x3f80_0000);
    let largest = coordinates.iter().map(significand).fold(1.0, f32::max);
    (largest / 2.0 + 1.0) / 2.0
}

/// The float next to `product / factor` whose rounded product it is.
fn other_factor(product: f32, factor: f32) -> Option<f32> {
    let quotient = product / factor;
    [quotient, quotient.next_down(), quotient.next_up()]
        .into_iter()
        .find(|x| (x * factor).to_bits() == product.to_bits())
}

/// -1, or 1 where there are no such sums.
fn split_into_sums(coordinates: &mut Coordinates) -> f32 {
    let mut found = *coordinates;
    for vertex in [B, C] {
        for axis in 0..3 {
            let Some(term) = other_term(coordinates[vertex + axis], coordinates[A + axis]) else {
                return 1.0;
            };
            found[vertex + axis] = term;
        }
    }
    *coordinates = found;
    -1.0
}

/// A float whose rounded sum with a term is a number: as far from the difference as sums are rounded.
fn other_term(sum: f32, term: f32) -> Option<f32> {
    let difference = sum - term;
    let bits = difference.to_bits();
    (0..23)
        .rev()
        .map(|digit| f32::from_bits(bits ^ 1 << digit))
        .chain([difference])
        .find(|x| (term + x).to_bits() == sum.to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Coordinates of either sign, with exponents around 0.
    fn drawn(spread: u32) -> impl Iterator<Item = Coordinates> {
        let mut bits = 1_u32;
        let mut next = move || {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            bits
        };
        std::iter::repeat_with(move || {
            std::array::from_fn(|_| {
                let exponent = 127 - spread + (next() >> 8) % (2 * spread + 1);
                f32::from_bits(next() & 0x807f_ffff | exponent << 23)
            })
        })
        .take(10_000)
    }

    #[test]
    fn nearly_all_coordinates_are_rounded_products() {
        let (mut split_cases, mut rounded) = (0, 0);
        for before in drawn(60) {
            let mut after = before;
            let factor = Inputs::Products.split(&mut after);
            split_cases += usize::from(factor != 1.0);
            for (x, product) in after.into_iter().zip(before) {
                assert_eq!((x * factor).to_bits(), product.to_bits());
                rounded += usize::from(f64::from(x) * f64::from(factor) != f64::from(product));
            }
        }
        assert!(
            split_cases > 9_900 && rounded > 140_000,
            "{split_cases} {rounded}"
        );
    }

    #[test]
    fn vertices_of_one_size_are_rounded_sums() {
        let (mut split_cases, mut rounded) = (0, 0);
        for before in drawn(0).map(|drawn| drawn.map(f32::abs)) {
            let mut after = before;
            if Inputs::Sums.split(&mut after) == 1.0 {
                assert_eq!(after, before);
                continue;
            }
            split_cases += 1;
            for place in B..15 {
                let a = before[A + place % 3];
                assert_eq!((a + after[place]).to_bits(), before[place].to_bits());
                let exact = f64::from(a) + f64::from(after[place]);
                rounded += usize::from(exact != f64::from(before[place]));
            }
            assert_eq!(after[..B], before[..B]);
        }
        assert!(
            split_cases > 9_900 && rounded > 40_000,
            "{split_cases} {rounded}"
        );
    }

    #[test]
    fn zeros_infinities_and_the_ends_of_the_range_are_kept() {
        let before = [
            0.0,
            -0.0,
            1.0,
            f32::MAX,
            f32::MIN,
            f32::MIN_POSITIVE,
            1e-45,
            -1e-45,
            f32::INFINITY,
            3.0,
            -7.0,
            0.1,
            1e30,
            1e-30,
            f32::EPSILON,
        ];
        let mut after = before;
        let factor = Inputs::Products.split(&mut after);
        assert_eq!(
            after.map(|x| (x * factor).to_bits()),
            before.map(f32::to_bits)
        );
        for inputs in [Inputs::Products, Inputs::Sums] {
            let mut with_nan = [f32::NAN; 15];
            inputs.split(&mut with_nan);
            assert!(with_nan[..B].iter().all(|x| x.is_nan()));
        }
    }
}
