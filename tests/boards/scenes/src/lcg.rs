//! Pseudo-random numbers that are exact in `f32`.

/// The linear congruential generator of W. H. Press et al., Numerical Recipes, 2nd edition (1992),
/// section 7.1 ("quick and dirty").
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lcg(pub(crate) u32);

impl Lcg {
    const fn next(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.0 >> 16
    }

    /// A number from 0 up to, not including, 1: a multiple of 2^-16.
    pub(crate) const fn unit(&mut self) -> f32 {
        self.next() as f32 / 65_536.0
    }

    /// A number from -1 up to, not including, 1: a multiple of 2^-15.
    pub(crate) const fn signed(&mut self) -> f32 {
        self.unit() * 2.0 - 1.0
    }
}
