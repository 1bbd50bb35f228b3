//! From rays to pictures.

mod renderer;
mod sampling;
mod whitted;

pub use renderer::Renderer;
pub use sampling::{Adaptive, MOST_LEVELS, Middle, Sampling, Uniform};
pub use whitted::{MOST_DEPTH, Secondary, Settings, Skips, Tracer};
