//! Names of octree cells.
//!
//! A. Glassner, "Space subdivision for fast ray tracing", IEEE CG&A 4(10) (1984), names a child by
//! appending a digit 1 to 8 to its parent's name, the root being 1. Here the digits are octal, which
//! hashes better and takes 3 bits a level: the root is 1, the children of `c` are `8c` to `8c + 7`.

/// The deepest level a name of 32 bits can hold.
pub const DEEPEST: u32 = 10;

/// The name of a cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Code(pub(super) u32);

impl Code {
    pub(super) const ROOT: Self = Self(1);

    /// The child in octant 0 to 7: bit 0 for the upper half along x, bit 1 y, bit 2 z.
    pub(super) fn child(self, octant: u32) -> Self {
        Self(self.0 << 3 | (octant & 7))
    }

    pub(super) fn level(self) -> u32 {
        // A third, as far as 31: small processors divide by a loop, of 300 bytes.
        (31_u32.saturating_sub(self.0.leading_zeros()) * 11) >> 5
    }

    /// The cell's least corner, in cells of level `deepest`, and its edge length there.
    pub(super) fn place(self, deepest: u32) -> ([i32; 3], i32) {
        let level = self.level();
        let (mut x, mut y, mut z) = (0, 0, 0);
        for digit in (0..level).rev() {
            let octant = (self.0 >> (3 * digit)) as i32;
            x = x << 1 | (octant & 1);
            y = y << 1 | (octant >> 1 & 1);
            z = z << 1 | (octant >> 2 & 1);
        }
        let shift = deepest.saturating_sub(level);
        ([x << shift, y << shift, z << shift], 1 << shift)
    }

    /// The next cell in depth-first order that is not below this one; `None` after the last.
    pub(super) fn next(self) -> Option<Self> {
        // Leaves as many trailing digits 7 as there are, then counts up.
        let mut code = self.0;
        while code & 7 == 7 && code > 7 {
            code >>= 3;
        }
        (code > 1).then_some(Self(code + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_level_is_three_bits() {
        for bits in 0..32 {
            assert_eq!(Code(1 << bits).level(), bits / 3, "{bits}");
        }
    }

    #[test]
    fn places_follow_the_octants() {
        let code = Code::ROOT.child(1).child(6);
        assert_eq!((code.0, code.level()), (0o116, 2));
        // Upper in x, then upper in y and z: 8 + 0, 0 + 4, 0 + 4 of 16.
        assert_eq!(code.place(4), ([8, 4, 4], 4));
        assert_eq!(Code::ROOT.place(4), ([0, 0, 0], 16));
        assert_eq!(Code(0o17777777777).level(), DEEPEST);
    }

    #[test]
    fn next_leaves_finished_families() {
        assert_eq!(Code(0o116).next(), Some(Code(0o117)));
        assert_eq!(Code(0o117).next(), Some(Code(0o12)));
        assert_eq!(Code(0o177).next(), None);
        assert_eq!(Code::ROOT.next(), None);
    }
}
