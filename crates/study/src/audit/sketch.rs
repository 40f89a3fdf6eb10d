//! A sketch of a set of places: from those of two sets, places that only one of them has.

/// The first level has half of all places, the second a quarter, and so on.
const LEVELS: u32 = 16;

/// Cells a level.
const BUCKETS: u32 = 4;

const CELLS: usize = (LEVELS * BUCKETS) as usize;

/// A place in 48 bits: 40 of the index, 8 of the triangle. Places beyond are left out of every sketch.
const INDEX_BITS: u32 = 40;
const BITS: u32 = 48;
const MASK: u64 = (1 << BITS) - 1;

/// Odd, so that multiplying can be undone; and what sets the first place apart from nothing.
const FACTORS: [u64; 2] = [0x9e37_79b9_7f4b, 0xbf58_476d_1ce5];
const START: u64 = 0x5851_f42d_4c95;

/// The digits of the text, which needs neither quotes nor escapes anywhere.
const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";

/// A digit has six bits, so a cell has eight digits.
const DIGIT_BITS: u32 = 6;
const DIGITS_A_CELL: usize = (BITS / DIGIT_BITS) as usize;

/// Sums, modulo 2^48, of scrambled places, each in one of 64 cells that its own bits choose. Adding is
/// commutative, as for a digest. Where the cells of two sets differ by one place their difference is that
/// place, scrambled; the levels hold ever fewer places, so some cell is likely to, however many places
/// differ. If only new places came in, 99 of 100 pairs of sets show one (90 if it is exactly two), and
/// 95 if as many went (simulated, up to 250,000 places). A cell in which several differ is taken for a place of a set of n by
/// chance once in 2^48/n times at most.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Sketch {
    cells: [u64; CELLS],
}

impl Default for Sketch {
    fn default() -> Sketch {
        Sketch { cells: [0; CELLS] }
    }
}

impl Sketch {
    /// Adds a place: an index, and a triangle.
    pub fn add(&mut self, (index, triangle): (u64, u32)) {
        let is_beyond = index >> INDEX_BITS != 0 || triangle >> (BITS - INDEX_BITS) != 0;
        if is_beyond {
            return;
        }
        let key = scrambled(u64::from(triangle) << INDEX_BITS | index);
        let cell = &mut self.cells[cell_of(key)];
        *cell = (*cell + key) & MASK;
    }

    /// Adds another set, which has no place of this one.
    pub fn merge(&mut self, other: &Sketch) {
        for (cell, more) in self.cells.iter_mut().zip(other.cells) {
            *cell = (*cell + more) & MASK;
        }
    }

    /// Places of this set that another does not have: some of them, and perhaps none although there are.
    pub fn beyond(&self, other: &Sketch) -> impl Iterator<Item = (u64, u32)> {
        let pairs = self.cells.iter().zip(other.cells).enumerate();
        pairs.filter_map(|(i, (cell, old))| {
            let key = cell.wrapping_sub(old) & MASK;
            let may_be_one_place = key != 0 && cell_of(key) == i;
            if !may_be_one_place {
                return None;
            }
            let place = restored(key);
            let index = place & ((1 << INDEX_BITS) - 1);
            let triangle = (place >> INDEX_BITS) as u32;
            Some((index, triangle))
        })
    }

    /// The cells that are not 0: each its number, and its sum, the first digit first.
    pub fn text(&self) -> String {
        let mut text = String::new();
        for (i, cell) in self.cells.iter().enumerate() {
            if *cell == 0 {
                continue;
            }
            text.push(char::from(DIGITS[i]));
            for k in (0..DIGITS_A_CELL as u32).rev() {
                let digit = (cell >> (DIGIT_BITS * k)) as usize % DIGITS.len();
                text.push(char::from(DIGITS[digit]));
            }
        }
        text
    }

    /// Reads the text.
    pub fn read(text: &str) -> Option<Sketch> {
        let mut digits = Vec::with_capacity(text.len());
        for byte in text.bytes() {
            digits.push(DIGITS.iter().position(|digit| *digit == byte)?);
        }
        let mut sketch = Sketch::default();
        for cell in digits.chunks(1 + DIGITS_A_CELL) {
            let (place, sum_digits) = cell.split_first()?;
            if sum_digits.len() != DIGITS_A_CELL {
                return None;
            }
            let mut sum = 0;
            for digit in sum_digits {
                sum = sum << DIGIT_BITS | *digit as u64;
            }
            sketch.cells[*place] = sum;
        }
        Some(sketch)
    }
}

/// The cell of a scrambled place.
fn cell_of(key: u64) -> usize {
    let level = key.trailing_zeros().min(LEVELS - 1);
    let bucket = key >> (BITS - 2);
    (level * BUCKETS) as usize + bucket as usize
}

/// One 48-bit number for another, so that every bit depends on every bit.
fn scrambled(place: u64) -> u64 {
    let mut x = folded(place ^ START);
    for factor in FACTORS {
        x = folded(x.wrapping_mul(factor) & MASK);
    }
    x
}

/// The number that is scrambled to this one.
fn restored(key: u64) -> u64 {
    let mut x = key;
    for factor in FACTORS.into_iter().rev() {
        x = folded(x).wrapping_mul(inverse(factor)) & MASK;
    }
    folded(x) ^ START
}

/// The upper half of 48 bits, added to the lower half without carries: its own inverse.
fn folded(x: u64) -> u64 {
    x ^ x >> (BITS / 2)
}

/// The inverse of an odd number, modulo 2^64, by Newton's iteration: right bits double from three.
fn inverse(odd: u64) -> u64 {
    let mut x = odd;
    for _ in 0..5 {
        let correction = 2u64.wrapping_sub(odd.wrapping_mul(x));
        x = x.wrapping_mul(correction);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    fn sketch(places: impl IntoIterator<Item = (u64, u32)>) -> Sketch {
        let mut sketch = Sketch::default();
        places.into_iter().for_each(|place| sketch.add(place));
        sketch
    }

    #[test]
    fn scrambling_is_undone() {
        for place in [0, 1, 2, 12_345, MASK, MASK - 1, 1 << 47, 3 << 40 | 19_999] {
            assert_eq!(restored(scrambled(place)), place);
            assert!(scrambled(place) <= MASK);
        }
    }

    #[test]
    fn one_place_more_is_found_among_thousands_whichever_it_is() {
        let old: Vec<(u64, u32)> = (0..3000).map(|i| (i * 7, (i % 5) as u32)).collect();
        for more in [(1, 0), (6, 4), (20_000, 1), (1 << 39, 255)] {
            let new = sketch(old.iter().copied().chain([more]));
            let found: Vec<(u64, u32)> = new.beyond(&sketch(old.clone())).collect();
            assert_eq!(found, [more]);
            assert_eq!(sketch(old.clone()).beyond(&new).count(), 0);
        }
        assert_eq!(
            sketch([(0, 0)]).beyond(&Sketch::default()).count(),
            1,
            "the first place counts"
        );
    }

    /// How often a place is found of 200 pairs of sets, with `new` places in one and `gone` in the other.
    /// Whatever is found must be right.
    fn found(new: u64, gone: u64) -> usize {
        let found = |seed: u64| {
            let start = seed * 1_000_003;
            let known = (0..500).map(|i| (start + i * 3, 0));
            let (new, gone) = (
                start + 2000..start + 2000 + new,
                start + 5_000_000..start + 5_000_000 + gone,
            );
            let now = sketch(known.clone().chain(new.clone().map(|i| (i, 0))));
            let before = sketch(known.chain(gone.map(|i| (i, 0))));
            let in_reach = |place: &(u64, u32)| place.0 < 1 << 32 && place.1 == 0;
            let found: Vec<(u64, u32)> = now.beyond(&before).filter(in_reach).collect();
            assert!(found.iter().all(|place| new.contains(&place.0)));
            !found.is_empty()
        };
        (0..200).filter(|seed| found(*seed)).count()
    }

    #[test]
    fn of_many_differences_some_are_found() {
        for new in [1, 2, 3, 10, 300, 5000] {
            assert!(176 <= found(new, 0), "{new}: {}", found(new, 0));
        }
        for new in [1, 10, 300, 5000] {
            assert!(170 <= found(new, new), "{new}: {}", found(new, new));
        }
        assert_eq!(found(0, 300), 0);
    }

    #[test]
    fn the_text_is_read_back_and_nothing_else_is() {
        let whole = sketch((0..1000).map(|i| (i, 0)));
        assert_eq!(Sketch::read(&whole.text()), Some(whole.clone()));
        assert_eq!(Sketch::default().text(), "");
        let cells: BTreeSet<char> = whole.text().chars().step_by(9).collect();
        assert!(30 < cells.len());
        for bad in ["A", "AAAAAAAA", "A=AAAAAAA", "AAAAAAAAAA", "Aäaaaaaa"] {
            assert_eq!(Sketch::read(bad), None, "{bad}");
        }
    }
}
