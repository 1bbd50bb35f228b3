//! From rays to pictures.

mod renderer;
mod whitted;

pub use renderer::Renderer;
pub use whitted::{MOST_DEPTH, Secondary, Settings, Tracer};
