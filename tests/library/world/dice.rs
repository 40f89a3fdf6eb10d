//! The second world's random numbers.

/// Xorshift with a multiplication at the end: Vigna, "An experimental exploration of Marsaglia's xorshift generators,
/// scrambled", 2016.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Dice {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1);
        (0..16).for_each(|_| _ = dice.roll());
        dice
    }

    fn roll(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// From 0 to 1, both excluded.
    pub fn share(&mut self) -> f64 {
        ((self.roll() >> 12) as f64 + 0.5) / (1u64 << 52) as f64
    }

    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.share()
    }

    pub fn one_of(&mut self, count: usize) -> usize {
        (self.share() * count as f64) as usize
    }

    pub fn coin(&mut self) -> bool {
        self.share() < 0.5
    }

    /// A unit vector, uniform on the sphere: its height is uniform.
    pub fn sphere(&mut self) -> [f64; 3] {
        let (height, turn) = (
            self.between(-1.0, 1.0),
            self.between(0.0, std::f64::consts::TAU),
        );
        let flat = (1.0 - height * height).sqrt();
        [flat * turn.cos(), height, flat * turn.sin()]
    }
}
