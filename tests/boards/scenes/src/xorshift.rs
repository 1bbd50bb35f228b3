//! The random numbers of the published baselines.

/// 32 bits of xorshift (G. Marsaglia, "Xorshift RNGs", Journal of Statistical Software 8(14), 2003).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Xorshift(pub(crate) u32);

impl Xorshift {
    /// A number from 0 up to, not including, 1: a multiple of 2^-24.
    pub(crate) const fn unit(&mut self) -> f32 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 17;
        self.0 ^= self.0 << 5;
        (self.0 >> 8) as f32 / 16_777_216.0
    }

    const fn signed(&mut self) -> f32 {
        self.unit() * 2.0 - 1.0
    }

    /// A point of the cube from -1 to 1.
    pub(crate) const fn cube(&mut self) -> [f32; 3] {
        [self.signed(), self.signed(), self.signed()]
    }
}
