//! Ray queries and their answers as bytes.

use crate::Subject;
use crate::lcg::Lcg;
use core::fmt;
use core::marker::PhantomData;
use kibiray::accel::{Accel, Mailbox};
use kibiray::geom::{Interval, Ray};
use kibiray::num::Vec3;
use kibiray::scene::Scene;

/// What one ray met: the bits of `t` and the id of the nearest hit, little end first (all ones for
/// a miss), then 1 or 0 for whether anything lies between the origin and parameter 1.
pub type Answer = [u8; 9];

/// Shoots a subject's rays, one at every call of `next`: every other one starts inside the
/// subject's reach, the rest mostly outside of it; directions are of any length.
pub struct Answers<'a, S: Subject, A, M> {
    scene: &'a Scene<'a, f32, S::Shapes>,
    accel: &'a A,
    mailbox: M,
    random: Lcg,
    left: u32,
    subject: PhantomData<S>,
}

impl<'a, S: Subject, A: Accel<f32>, M: Mailbox> Answers<'a, S, A, M> {
    /// The answers that a structure over the subject's scene gives.
    pub fn new(scene: &'a Scene<'a, f32, S::Shapes>, accel: &'a A, mailbox: M) -> Self {
        Self { scene, accel, mailbox, random: Lcg(1), left: S::RAYS, subject: PhantomData }
    }

    /// The next ray; `None` for a direction of zero.
    fn ray(&mut self) -> Option<Ray<f32>> {
        let r = &mut self.random;
        let inside = self.left.is_multiple_of(2);
        let reach = if inside { S::REACH } else { S::REACH * 4.0 };
        let origin = Vec3::<f32>::new(r.signed(), r.signed(), r.signed()) * reach;
        // Rays from far away would mostly miss: they aim at the middle, more or less.
        let towards = Vec3::<f32>::new(r.signed(), r.signed(), r.signed()) * S::REACH;
        let direction = if inside { towards } else { towards - origin };
        Ray::new(origin, direction).ok()
    }
}

impl<S: Subject, A: Accel<f32>, M: Mailbox> Iterator for Answers<'_, S, A, M> {
    type Item = Answer;

    fn next(&mut self) -> Option<Answer> {
        if self.left == 0 {
            return None;
        }
        let ray = self.ray();
        self.left -= 1;
        let mut answer = [0xff; 9];
        let Some(ray) = ray else { return Some(answer) };
        let (scene, mailbox) = (self.scene, &mut self.mailbox);
        let hit = self.accel.nearest(scene, &ray, Interval::RAY, mailbox, &mut ());
        let near = Interval::new(0.0, 1.0);
        let blocked = self.accel.occluded(scene, &ray, near, mailbox, &mut ());
        if let Some(hit) = hit {
            answer[..4].copy_from_slice(&hit.t.to_bits().to_le_bytes());
            answer[4..8].copy_from_slice(&(hit.id as u32).to_le_bytes());
        }
        answer[8] = blocked.into();
        Some(answer)
    }
}

impl<S: Subject, A, M> fmt::Debug for Answers<'_, S, A, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} answers about {}", self.left, S::NAME)
    }
}
