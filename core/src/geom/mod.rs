//! Rays, intervals of their parameter, and axis-aligned boxes.

mod aabb;
mod interval;
mod ray;

pub use aabb::Aabb;
pub use interval::Interval;
pub use ray::{NotARay, Ray, Slopes};
