//! Ray tracing in kibibytes.
#![no_std]
#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable
    )
)]

pub mod accel;
pub mod display;
pub mod geom;
pub mod memory;
pub mod num;
pub mod plan;
pub mod probe;
pub mod scene;
pub mod shape;
pub mod trace;
