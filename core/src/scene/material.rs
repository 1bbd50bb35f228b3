//! Surfaces and lights, after the Neutral File Format (E. Haines, "A proposal for standard graphics
//! environments", IEEE CG&A 7(11), 1987).

use crate::num::{Real, Vec3, Vector};

/// A surface; 32 bytes in `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<R: Real> {
    /// Colour of diffusely reflected light, each component usually 0 to 1.
    pub color: Vec3<R>,
    /// Kd: share of light that is reflected diffusely.
    pub diffuse: R,
    /// Ks: share that is reflected like in a mirror, and strength of highlights.
    pub specular: R,
    /// Phong's cosine power of highlights.
    pub shine: R,
    /// T: share that goes through.
    pub transmission: R,
    /// Index of refraction; 0 or 1: light goes straight on.
    pub index: R,
}

impl<R: Real> Default for Material<R> {
    /// A matt white.
    fn default() -> Self {
        Self {
            color: Vec3::<R>::splat(R::ONE),
            diffuse: R::ONE,
            specular: R::ZERO,
            shine: R::ONE,
            transmission: R::ZERO,
            index: R::ONE,
        }
    }
}

impl<R: Real> Material<R> {
    pub(super) fn is_usable(&self) -> bool {
        let shares = [self.diffuse, self.specular, self.shine, self.transmission, self.index];
        self.color.is_finite() && shares.iter().all(|s| s.is_finite() && *s >= R::ZERO)
    }
}

/// A point light without fall-off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light<R: Real> {
    /// Where it stands.
    pub position: Vec3<R>,
    /// Its colour and strength.
    pub color: Vec3<R>,
}

/// The shapes from `first` on, up to where the next run begins, have one material.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Paint {
    /// Id of the first shape.
    pub first: usize,
    /// Place in the table of materials.
    pub material: u16,
}
