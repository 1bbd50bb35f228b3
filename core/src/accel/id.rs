//! Numbers of shapes in lists: 2 bytes while they suffice, 4 beyond.

use bytemuck::Pod;

/// An unsigned number as it is stored in a structure's lists.
pub trait Id: Pod + core::fmt::Debug {
    /// How many different numbers there are, less one: the greatest number that fits.
    const MAX: usize;
    /// Stores a number; beyond [`Id::MAX`] it is cut off, so builders ask first.
    fn new(n: usize) -> Self;
    /// Reads it.
    fn get(self) -> usize;
}

impl Id for u8 {
    const MAX: usize = Self::MAX as usize;
    fn new(n: usize) -> Self {
        n as Self
    }
    fn get(self) -> usize {
        self as usize
    }
}

impl Id for u16 {
    const MAX: usize = Self::MAX as usize;
    fn new(n: usize) -> Self {
        n as Self
    }
    fn get(self) -> usize {
        self as usize
    }
}

impl Id for u32 {
    const MAX: usize = Self::MAX as usize;
    fn new(n: usize) -> Self {
        n as Self
    }
    fn get(self) -> usize {
        self as usize
    }
}
