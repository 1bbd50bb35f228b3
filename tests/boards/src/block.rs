//! Static memory that is handed out once.

use core::cell::{Cell, UnsafeCell};

/// `N` bytes at a multiple of 8, all zero at first.
#[repr(C, align(8))]
pub struct Block<const N: usize> {
    bytes: UnsafeCell<[u8; N]>,
    taken: Cell<bool>,
}

// SAFETY: there is one core, and no interrupt handler of these programs touches a block.
unsafe impl<const N: usize> Sync for Block<N> {}

impl<const N: usize> Block<N> {
    /// Bytes that nobody has yet.
    #[expect(clippy::new_without_default, reason = "made for statics, where Default is no help")]
    pub const fn new() -> Self {
        Self { bytes: UnsafeCell::new([0; N]), taken: Cell::new(false) }
    }

    /// The bytes, the first time; nothing afterwards.
    pub fn take(&'static self) -> Option<&'static mut [u8]> {
        if self.taken.replace(true) {
            return None;
        }
        // SAFETY: only the first call gets here, so this is the only borrow there ever is.
        Some(unsafe { &mut *self.bytes.get() })
    }
}
