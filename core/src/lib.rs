//! Ray tracing in kibibytes.
#![no_std]

pub mod geom;
pub mod num;
pub mod shape;
