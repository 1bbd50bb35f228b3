//! From colours to pixels.

use crate::num::{Real, Vec3, Vector};
use embedded_graphics_core::pixelcolor::Rgb888;

/// A colour as 8 bits a channel: cut to 0 to 1, rounded to the nearest; not-a-number is black.
/// Displays of other formats convert from here.
pub fn rgb888<R: Real>(color: Vec3<R>) -> Rgb888 {
    Rgb888::new(color.x().to_byte(), color.y().to_byte(), color.z().to_byte())
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec3;

    #[test]
    fn colours_are_cut_and_rounded() {
        assert_eq!(rgb888::<f32>(vec3(-1.0, 0.5, 2.0)), Rgb888::new(0, 128, 255));
        assert_eq!(rgb888::<f32>(vec3(f32::NAN, 0.001, 0.999)), Rgb888::new(0, 0, 255));
    }
}
