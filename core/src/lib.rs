//! Ray tracing in kibibytes.
#![no_std]

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
