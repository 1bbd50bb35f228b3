//! Surfaces and lights, after the Neutral File Format (E. Haines, "A proposal for standard graphics
//! environments", IEEE CG&A 7(11), 1987).

use crate::num::{Real, Vec3, Vector};

/// How a surface's colour changes from place to place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Pattern<R: Real> {
    /// Not at all.
    #[default]
    Plain,
    /// Squares of this edge length take turns with another colour; across the two axes that the
    /// surface runs along most.
    Checker(R, Vec3<R>),
}

/// A surface; 48 bytes in `f32`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material<R: Real> {
    /// Colour of diffusely reflected light, each component usually 0 to 1.
    pub color: Vec3<R>,
    /// Kd: share of light that is reflected diffusely.
    pub diffuse: R,
    /// Ks: share that is reflected like in a mirror, and strength of highlights.
    pub specular: R,
    /// Phong's cosine power of highlights.
    pub shine: R::Exponent,
    /// T: share that goes through.
    pub transmission: R,
    /// Index of refraction; 0 or 1: light goes straight on.
    pub index: R,
    /// Where the colour is another one.
    pub pattern: Pattern<R>,
}

impl<R: Real> Default for Material<R> {
    /// A matt white.
    fn default() -> Self {
        *R::UNPAINTED
    }
}

impl<R: Real> Material<R> {
    /// A surface that only reflects diffusely: something to start from in constants.
    pub const fn matt(color: Vec3<R>) -> Self {
        Self {
            color,
            diffuse: R::ONE,
            specular: R::ZERO,
            shine: R::NO_POWER,
            transmission: R::ZERO,
            index: R::ONE,
            pattern: Pattern::Plain,
        }
    }

    pub(super) fn is_usable(&self) -> bool {
        let shares = [self.diffuse, self.specular, self.transmission, self.index];
        let pattern = match self.pattern {
            Pattern::Plain => true,
            Pattern::Checker(edge, color) => {
                edge > R::ZERO && R::ONE.floor_ratio(edge) < i32::MAX && color.is_finite()
            }
        };
        let shares = shares.iter().all(|s| s.is_finite() && *s >= R::ZERO);
        let shares = shares && R::is_power(self.shine);
        self.color.is_finite() && shares && pattern
    }

    /// Whether rays go on from it.
    pub(crate) fn mirrors(&self) -> bool {
        self.specular > R::ZERO || self.transmission > R::ZERO
    }

    /// The colour at a point of a surface with that normal.
    pub fn color_at(&self, point: Vec3<R>, normal: Vec3<R>) -> Vec3<R> {
        match self.pattern {
            Pattern::Plain => self.color,
            Pattern::Checker(edge, other) => {
                let (u, v) = normal.major_axis().others();
                let square = |axis| point.along(axis).floor_ratio(edge);
                if (square(u) ^ square(v)) & 1 == 0 { self.color } else { other }
            }
        }
    }
}

/// A point light without fall-off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light<R: Real> {
    /// Where it stands.
    pub position: R::FarPoint,
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, vec3};

    #[test]
    fn checkers_take_turns_across_zero() {
        let black = Vec3::ZERO;
        let floor =
            Material { pattern: Pattern::Checker(0.5, black), ..Material::<f32>::default() };
        // The height does not count, however rounding moves it.
        for (x, z, expected) in [
            (0.1, 0.1, Vec3::ONE),
            (-0.1, 0.1, black),
            (-0.1, -0.1, Vec3::ONE),
            (0.6, 0.1, black),
            (0.6, -0.1, Vec3::ONE),
        ] {
            for y in [-1e-7, 0.0, 1e-7] {
                assert_eq!(floor.color_at(vec3(x, y, z), Vec3::Y), expected, "{x} {z}");
            }
        }
    }

    #[test]
    fn unusable_numbers_are_told() {
        let usable = |m: Material<f32>| m.is_usable();
        assert!(usable(Material::default()));
        assert!(!usable(Material { diffuse: -1.0, ..Material::default() }));
        assert!(!usable(Material { index: f32::NAN, ..Material::default() }));
        for edge in [0.0, -1.0, f32::NAN, 1e-45] {
            let pattern = Pattern::Checker(edge, Vec3::ONE);
            assert!(!usable(Material { pattern, ..Material::default() }), "{edge}");
        }
    }
}
