//! Ray tracing in kibibytes.
#![no_std]
