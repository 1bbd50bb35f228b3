//! How deep the stack gets, by painting: memory below the stack pointer is filled with a pattern,
//! and what has changed afterwards has been in use.

use core::ptr::{read_volatile, write_volatile};

const PAINT: u32 = 0xa5c3_96e1;

unsafe extern "C" {
    // Both come from the linker script: addresses, not values.
    /// The end of the stack's memory; the stack begins here and grows down.
    static _stack_start: u32;
    /// The beginning of the stack's memory, behind all statics.
    #[cfg_attr(target_arch = "riscv32", link_name = "__eheap")]
    static _stack_end: u32;
}

fn top() -> usize {
    &raw const _stack_start as usize
}

fn bottom() -> usize {
    &raw const _stack_end as usize
}

/// Bytes that the stack may take.
pub fn capacity() -> usize {
    top() - bottom()
}

/// Paints all that the stack has not reached yet.
#[inline(never)]
pub fn paint() {
    let here = 0_u32;
    // This function's own frame and, on Arm, a frame that an exception may push.
    let end = (&raw const here as usize).saturating_sub(256) & !3;
    for address in (bottom()..end).step_by(4) {
        // SAFETY: between the statics and the stack pointer lies memory that nobody owns, word by
        // word from an aligned address; an exception that uses it has returned before the next
        // write.
        unsafe { write_volatile(address as *mut u32, PAINT) };
    }
}

/// Most bytes that the stack has taken since it was painted.
///
/// # Errors
/// When it has taken all, and perhaps more.
pub fn checked() -> Result<usize, &'static str> {
    let bytes = high_water();
    if bytes + 4 > capacity() { Err("the stack ran into the statics") } else { Ok(bytes) }
}

#[inline(never)]
fn high_water() -> usize {
    let mut address = bottom();
    // SAFETY: the same memory as in `paint`; the loop ends at the top of the stack at the latest.
    while address < top() && unsafe { read_volatile(address as *const u32) } == PAINT {
        address += 4;
    }
    top() - address
}
