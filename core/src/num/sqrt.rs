//! Square roots, correctly rounded on every target, hence the same bits.
//!
//! `libm` uses the processor's instruction on x86-64 and `AArch64` but computes in software on a
//! Cortex-M4F (45 instructions instead of 1). Calling the C symbol instead lets the compiler emit
//! `vsqrt.f32` there and `f32.sqrt` in wasm; where a core has neither, `compiler_builtins` brings
//! the software routine under that name.

#[cfg(any(target_os = "none", target_family = "wasm"))]
mod symbol {
    // The declaration is the only thing here that the compiler cannot check: the two symbols are
    // C's, always there, and take and return what is written.
    #[allow(unsafe_code)]
    unsafe extern "C" {
        pub(crate) safe fn sqrtf(x: f32) -> f32;
        pub(crate) safe fn sqrt(x: f64) -> f64;
    }
}

#[cfg(any(target_os = "none", target_family = "wasm"))]
pub(super) use symbol::{sqrt, sqrtf};

#[cfg(not(any(target_os = "none", target_family = "wasm")))]
pub(super) use libm::{sqrt, sqrtf};
