//! Rays to ask about, and answers as bytes.

use crate::lcg::Lcg;
use kibiray::accel::Hit;
use kibiray::geom::{Interval, Ray};
use kibiray::num::{Real, Vec3};

/// What one ray met: the bits of `t` and the id of the nearest hit, little end first (all ones for
/// a miss), then 1 or 0 for whether anything blocks the way.
pub type Answer = [u8; 9];

/// An answer from what the two queries gave.
pub fn answer<R: Real>(hit: Option<Hit<R>>, blocked: bool) -> Answer {
    let mut answer = [0xff; 9];
    if let Some(hit) = hit {
        for (to, from) in answer[..4].iter_mut().zip(bytemuck::bytes_of(&hit.t)) {
            *to = *from;
        }
        answer[4..8].copy_from_slice(&(hit.id as u32).to_le_bytes());
    }
    answer[8] = blocked.into();
    answer
}

/// A ray, and the piece of it that may be blocked.
#[derive(Clone, Copy, Debug)]
pub struct Shot<R: Real> {
    /// Asked for its nearest hit.
    pub ray: Ray<R>,
    /// Asked for any hit.
    pub between: Interval<R>,
}

/// Rays with directions of any length: every other one starts near the origin, the rest mostly
/// farther away, towards the middle. Blocked is asked for up to where the ray aims.
#[derive(Clone, Debug)]
pub struct Around {
    reach: f32,
    random: Lcg,
    left: u32,
}

impl Around {
    /// So many rays, half of them from within `reach` of the origin along each axis.
    pub const fn new(rays: u32, reach: f32) -> Self {
        Self { reach, random: Lcg(1), left: rays }
    }
}

impl Iterator for Around {
    type Item = Shot<f32>;

    fn next(&mut self) -> Option<Shot<f32>> {
        // A direction of zero makes no ray; the next one is taken.
        while self.left > 0 {
            let r = &mut self.random;
            let inside = self.left.is_multiple_of(2);
            self.left -= 1;
            let reach = if inside { self.reach } else { self.reach * 4.0 };
            let origin = Vec3::<f32>::new(r.signed(), r.signed(), r.signed()) * reach;
            let towards = Vec3::<f32>::new(r.signed(), r.signed(), r.signed()) * self.reach;
            let direction = if inside { towards } else { towards - origin };
            if let Ok(ray) = Ray::new(origin, direction) {
                return Some(Shot { ray, between: Interval::new(0.0, 1.0) });
            }
        }
        None
    }
}
