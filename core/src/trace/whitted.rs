//! Shading, shadows, mirrors and glass.
//!
//! T. Whitted, "An improved illumination model for shaded display", CACM 23(6) (1980), with the
//! surfaces of the Neutral File Format. The tree of rays is walked depth first on a stack of fixed
//! size; what a ray adds to the pixel is known when it is spawned, so nothing has to return.

use crate::accel::{Accel, Mailbox};
use crate::geom::{Interval, Ray};
use crate::num::{Real, Vec3, Vector};
use crate::probe::{Probe, RayKind};
use crate::scene::{Light, Material, Scene, Shapes, Surface};
use heapless::Vec;

/// The greatest depth of recursion; a pending ray takes 36 bytes in `f32`.
pub const MOST_DEPTH: u8 = 16;

/// Which mirrored and refracted rays are shot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Secondary {
    /// Those that add something to the picture.
    Contributing,
    /// A mirrored ray from every surface that mirrors or transmits, whatever it adds: the rules by
    /// which the ray counts of the Standard Procedural Databases were made.
    All,
}

/// How rays are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    /// Depth at which no more rays are spawned; a ray from the eye has depth 1. From 1 to
    /// [`MOST_DEPTH`], other numbers count as the nearest of these.
    pub max_depth: u8,
    /// Which secondary rays are shot.
    pub secondary: Secondary,
}

impl Default for Settings {
    /// Depth 5, contributing rays only.
    fn default() -> Self {
        Self { max_depth: 5, secondary: Secondary::Contributing }
    }
}

/// A ray still to be followed.
#[derive(Clone, Copy, Debug)]
struct Pending<R: Real> {
    ray: Ray<R>,
    /// Share of its colour in the pixel's.
    weight: R,
    depth: u8,
}

/// Follows rays through a scene.
#[derive(Debug)]
pub struct Tracer<'a, R: Real, S, A, M> {
    scene: &'a Scene<'a, R, S>,
    accel: &'a A,
    mailbox: M,
    settings: Settings,
}

impl<'a, R: Real, S: Shapes<R>, A: Accel<R>, M: Mailbox> Tracer<'a, R, S, A, M> {
    /// A tracer over a structure and a mailbox made for that scene.
    pub fn new(scene: &'a Scene<'a, R, S>, accel: &'a A, mailbox: M, settings: Settings) -> Self {
        let max_depth = settings.max_depth.clamp(1, MOST_DEPTH);
        Self { scene, accel, mailbox, settings: Settings { max_depth, ..settings } }
    }

    /// The colour that a ray from the eye sees, not limited to 1.
    pub fn color<P: Probe>(&mut self, ray: Ray<R>, probe: &mut P) -> Vec3<R> {
        let mut color = Vec3::<R>::default();
        // Each level leaves at most one ray behind, so it never holds more than the depth.
        let mut pending = Vec::<Pending<R>, { MOST_DEPTH as usize }>::new();
        let mut next = Some(Pending { ray, weight: R::ONE, depth: 1 });
        while let Some(Pending { ray, weight, depth }) = next {
            next = None;
            let hit = self.accel.nearest(self.scene, &ray, Interval::RAY, &mut self.mailbox, probe);
            let kind = if depth == 1 { RayKind::Primary } else { RayKind::Secondary };
            probe.ray(kind, hit.is_some());
            let surface = hit.and_then(|hit| Some((self.scene.surface(&ray, &hit)?, hit.id)));
            match surface {
                None => color = color + self.scene.background() * weight,
                Some((surface, id)) => {
                    let bounce = Bounce::new(&ray, &surface, self.scene.material(id));
                    color = color + self.local(&bounce, probe) * weight;
                    if depth < self.settings.max_depth {
                        let depth = depth + 1;
                        let follow = |(ray, share)| Pending { ray, weight: weight * share, depth };
                        let (through, mirrored) = bounce.spawn(self.settings.secondary);
                        next = mirrored.map(follow);
                        if let Some(through) = through.map(follow)
                            && let Some(mirrored) = next.replace(through)
                        {
                            let _ = pending.push(mirrored);
                        }
                    }
                }
            }
            next = next.or_else(|| pending.pop());
        }
        color
    }

    /// Light that comes straight from the lamps.
    fn local<P: Probe>(&mut self, bounce: &Bounce<'_, R>, probe: &mut P) -> Vec3<R> {
        let mut color = Vec3::<R>::default();
        for light in self.scene.lights() {
            let Some((ray, distance)) = bounce.towards(light) else { continue };
            let between = Interval::new(R::ZERO, distance);
            let blocked = self.accel.occluded(self.scene, &ray, between, &mut self.mailbox, probe);
            probe.ray(RayKind::Shadow, blocked);
            if !blocked {
                color = color + bounce.reflected(ray.direction()).scale(light.color);
            }
        }
        color
    }
}

/// A ray's arrival at a surface.
struct Bounce<'s, R: Real> {
    surface: &'s Surface<R>,
    material: &'s Material<R>,
    /// Direction of arrival.
    direction: Vec3<R>,
    /// The mirrored direction, as long; zero where nothing mirrors.
    mirrored: Vec3<R>,
    /// Its squared length.
    squared: R,
    /// From the surface to where rays on the near side start.
    off: Vec3<R>,
}

/// A ray that goes on from a surface, and its share.
type Spawned<R> = Option<(Ray<R>, R)>;

impl<'s, R: Real> Bounce<'s, R> {
    fn new(ray: &Ray<R>, surface: &'s Surface<R>, material: &'s Material<R>) -> Self {
        let direction = ray.direction();
        let mirror = |n: Vec3<R>| {
            let along = R::narrow(direction.dot(n));
            direction - n * (along + along)
        };
        let mut mirrored = Vec3::<R>::default();
        if material.specular > R::ZERO || material.transmission > R::ZERO {
            mirrored = mirror(surface.shading);
            if mirrored.dot(surface.normal) < R::Wide::default() {
                // An interpolated normal would send the ray into the surface.
                mirrored = mirror(surface.normal);
            }
        }
        let off = surface.normal * surface.error;
        Self { surface, material, direction, mirrored, squared: ray.squared(), off }
    }

    /// The ray to a light, its direction of length 1, and the light's parameter; `None` when the
    /// surface faces away.
    fn towards(&self, light: &Light<R>) -> Option<(Ray<R>, R)> {
        let origin = self.surface.point + self.off;
        let towards = light.position - origin;
        let zero = R::Wide::default();
        let faces = |n: Vec3<R>| n.dot(towards) > zero;
        if !(faces(self.surface.shading) && faces(self.surface.normal)) {
            return None;
        }
        let unit = towards.unit()?;
        let ray = Ray::from(origin, unit, self.surface.reach)?;
        Some((ray, R::narrow(towards.dot(unit))))
    }

    /// What the surface sends back of white light from a direction of length 1.
    fn reflected(&self, towards: Vec3<R>) -> Vec3<R> {
        let Material { diffuse, specular, shine, .. } = *self.material;
        let color = self.material.color_at(self.surface.point, self.surface.normal);
        let cosine = R::narrow(self.surface.shading.dot(towards));
        let matt = color * (diffuse * cosine);
        if !(specular > R::ZERO) {
            return matt;
        }
        let highlight = R::narrow(self.mirrored.dot(towards));
        if !(highlight > R::ZERO) {
            return matt;
        }
        let highlight = (highlight / self.squared.sqrt()).min(R::ONE);
        matt + Vec3::<R>::splat(specular * highlight.powf(shine))
    }

    /// The rays that go on from here: the one that goes through, and the mirrored one.
    fn spawn(&self, secondary: Secondary) -> (Spawned<R>, Spawned<R>) {
        let Material { specular, transmission, .. } = *self.material;
        let through = if transmission > R::ZERO { self.refracted() } else { None };
        // Where nothing can leave, everything is mirrored.
        let total = transmission > R::ZERO && through.is_none();
        let share = if total { specular + transmission } else { specular };
        let mirrors = match secondary {
            Secondary::Contributing => share > R::ZERO,
            Secondary::All => specular > R::ZERO || transmission > R::ZERO,
        };
        let Surface { point, reach, .. } = *self.surface;
        let ray = |origin, direction, share| Some((Ray::from(origin, direction, reach)?, share));
        let mirrored = if mirrors { ray(point + self.off, self.mirrored, share) } else { None };
        (through.and_then(|d| ray(point - self.off, d, transmission)), mirrored)
    }

    /// Direction behind the surface, after Snell; `None` for total reflection.
    fn refracted(&self) -> Option<Vec3<R>> {
        let index = self.material.index;
        if !(index > R::ZERO) || index == R::ONE {
            return Some(self.direction);
        }
        let direction = self.direction.unit()?;
        let ratio = if self.surface.front { R::ONE / index } else { index };
        let Surface { normal, shading, .. } = *self.surface;
        let cosine = -R::narrow(direction.dot(shading));
        let under_root = R::ONE - ratio * ratio * (R::ONE - cosine * cosine);
        if !(under_root >= R::ZERO) {
            return None;
        }
        let bent = direction * ratio + shading * (ratio * cosine - under_root.sqrt());
        // An interpolated normal may send the ray back to where it comes from: then straight on.
        Some(if bent.dot(normal) < R::Wide::default() { bent } else { direction })
    }
}
