//! Shading, shadows, mirrors and glass.
//!
//! T. Whitted, "An improved illumination model for shaded display", CACM 23(6) (1980), with the
//! surfaces of the Neutral File Format. The tree of rays is walked depth first on a stack of fixed
//! size; what a ray adds to the pixel is known when it is spawned, so nothing has to return.

use crate::accel::{Accel, Hit, Mailbox};
use crate::geom::{Interval, Ray};
use crate::num::{Real, Vec3, Vector};
use crate::probe::{Probe, RayKind};
use crate::scene::{Light, Material, Scene, Shapes, Surface};
use heapless::{Vec, VecView};

/// The greatest depth of recursion; a pending ray takes 48 bytes in `f32`.
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

/// Work that is not done where it cannot change the picture; each kind can be done all the same, to
/// see what leaving it out gains. Only with the feature `switches`: without it all is left out, and a
/// build has no code for anything else.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Skips {
    /// From a surface that sends no light back, neither matt nor as a highlight, no shadow ray is shot.
    pub shadows: bool,
    /// In a scene where nothing mirrors or transmits, nothing is asked about rays that go on, and no
    /// stack is laid out for them.
    pub mirrors: bool,
    /// A surface that faces away from a light shoots no shadow ray to it.
    pub facing: bool,
}

impl Skips {
    /// As far as there is a choice.
    fn chosen(self) -> Self {
        if cfg!(feature = "switches") { self } else { Self::default() }
    }
}

impl Default for Skips {
    /// All of it is left out.
    fn default() -> Self {
        Self { shadows: true, mirrors: true, facing: true }
    }
}

/// How rays are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings<R> {
    /// Depth at which no more rays are spawned; a ray from the eye has depth 1. From 1 to
    /// [`MOST_DEPTH`], other numbers count as the nearest of these.
    pub max_depth: u8,
    /// Which secondary rays are shot.
    pub secondary: Secondary,
    /// Adaptive recursion: a ray whose share of the pixel, the product of the coefficients on its way,
    /// is less is not shot. 0 leaves none out; 1/512 leaves out what a display of 8 bits can hardly
    /// show. R. A. Hall, D. P. Greenberg, "A testbed for realistic image synthesis", IEEE CG&A 3(8)
    /// (1983). The same holds for shadow rays: light that may add less than that counts as half in
    /// shadow, whichever it is.
    pub cutoff: R,
    /// Whether a shadow ray tries the shape first that blocked the last ray to that light, if it was
    /// blocked. Pictures are the same; the work of a pixel then depends on the pixels before.
    pub shadow_cache: bool,
    /// What is left out.
    pub skips: Skips,
}

impl<R: Real> Default for Settings<R> {
    /// Depth 5, contributing rays only, none of them too faint, with a shadow cache, all left out that
    /// cannot change the picture.
    fn default() -> Self {
        let (secondary, skips) = (Secondary::Contributing, Skips::default());
        Self { max_depth: 5, secondary, cutoff: R::ZERO, shadow_cache: true, skips }
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
    settings: Settings<R>,
    /// What blocked the last ray to each of the first lights; [`UNBLOCKED`] where nothing did.
    blockers: [u32; CACHED_LIGHTS],
}

/// Lights with a shadow cache.
const CACHED_LIGHTS: usize = 8;

/// An id that no shape has.
const UNBLOCKED: u32 = u32::MAX;

impl<'a, R: Real, S: Shapes<R>, A: Accel<R>, M: Mailbox> Tracer<'a, R, S, A, M> {
    /// A tracer over a structure and a mailbox made for that scene.
    pub fn new(
        scene: &'a Scene<'a, R, S>,
        accel: &'a A,
        mailbox: M,
        settings: Settings<R>,
    ) -> Self {
        let goes_on = !settings.skips.chosen().mirrors || scene.mirrors();
        let max_depth = if goes_on { settings.max_depth.clamp(1, MOST_DEPTH) } else { 1 };
        Self {
            scene,
            accel,
            mailbox,
            settings: Settings { max_depth, ..settings },
            blockers: [UNBLOCKED; CACHED_LIGHTS],
        }
    }

    /// The colour that a ray from the eye sees, not limited to 1.
    pub fn color<P: Probe>(&mut self, ray: Ray<R>, probe: &mut P) -> Vec3<R> {
        self.color_from(&|| Some(ray), probe)
    }

    /// The colour that a ray sees which is made where it is followed from: made before, it would lie on
    /// the stack a second time. Without a ray, black.
    pub(super) fn color_from<P: Probe>(
        &mut self,
        ray: &impl Fn() -> Option<Ray<R>>,
        probe: &mut P,
    ) -> Vec3<R> {
        let depth = self.settings.max_depth;
        if depth <= 1 {
            self.color_within::<P, 1>(ray, probe)
        } else if depth <= 4 {
            self.color_within::<P, 4>(ray, probe)
        } else if depth <= 5 {
            self.color_within::<P, 5>(ray, probe)
        } else {
            self.color_within::<P, { MOST_DEPTH as usize }>(ray, probe)
        }
    }

    /// With as much stack as the depth needs: each level leaves at most one ray behind.
    #[inline(never)]
    fn color_within<P: Probe, const DEPTH: usize>(
        &mut self,
        ray: &impl Fn() -> Option<Ray<R>>,
        probe: &mut P,
    ) -> Vec3<R> {
        self.color_of_tree(&mut Vec::<_, DEPTH>::new(), ray, probe)
    }

    /// The sum over the tree of a ray, on a stack that is empty.
    #[inline(never)]
    fn color_of_tree<P: Probe>(
        &mut self,
        rays: &mut VecView<Pending<R>>,
        ray: &impl Fn() -> Option<Ray<R>>,
        probe: &mut P,
    ) -> Vec3<R> {
        self.begin(rays, ray);
        let mut color = Vec3::<R>::default();
        // The last one is under way, and lies where it is: a copy would take as much again.
        while let Some(now) = rays.last() {
            let Pending { weight, depth, .. } = *now;
            let seen = match self.meet(now, probe) {
                Some(hit) => self.follow(rays, hit, probe),
                None => {
                    rays.pop();
                    self.scene.background()
                }
            };
            color = if depth == 1 { seen } else { R::at(color, seen, weight) };
        }
        color
    }

    // What follows are functions of their own, so that what one of them needs is not on the stack
    // while another one is under way, and so that their variables lie together and not beyond the
    // pending rays: small processors reach a few hundred bytes of stack at once.
    // Where there is enough of it the calls are saved.

    /// Puts the first ray on the stack, if there is one.
    #[cfg_attr(all(target_arch = "arm", not(target_abi = "eabihf")), inline(never))]
    fn begin(&self, rays: &mut VecView<Pending<R>>, ray: &impl Fn() -> Option<Ray<R>>) {
        if let Some(ray) = ray() {
            let ray = ray.with_slack(self.scene.slack());
            let _ = rays.push(Pending { ray, weight: R::ONE, depth: 1 });
        }
    }

    /// Where a ray meets something.
    #[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
    fn meet<P: Probe>(&mut self, now: &Pending<R>, probe: &mut P) -> Option<Hit<R>> {
        let (scene, mailbox) = (self.scene, &mut self.mailbox);
        let hit = self.accel.nearest(scene, &now.ray, Interval::RAY, mailbox, probe);
        let kind = if now.depth == 1 { RayKind::Primary } else { RayKind::Secondary };
        probe.ray(kind, hit.is_some());
        hit
    }

    /// What the last one of some rays sees where it meets something, without what the rays that go on
    /// from there will see. These take its place.
    #[cfg_attr(all(target_pointer_width = "32", not(target_arch = "wasm32")), inline(never))]
    fn follow<P: Probe>(
        &mut self,
        rays: &mut VecView<Pending<R>>,
        hit: Hit<R>,
        probe: &mut P,
    ) -> Vec3<R> {
        let scene = self.scene;
        let Some(now) = rays.last() else { return Vec3::<R>::default() };
        // Borrowed where it is: taken out of the option it would be there twice.
        let surface = surface(scene, &now.ray, &hit);
        let Some(surface) = &surface else {
            rays.pop();
            return scene.background();
        };
        let material = scene.material(hit.id);
        let mirrors = material.mirrors();
        let arrival = Arrival::of(&now.ray, surface, material, mirrors);
        let color = self.local(now, &arrival, probe);
        if mirrors && now.depth < self.settings.max_depth {
            self.go_on(rays, &arrival);
        } else {
            rays.pop();
        }
        color
    }

    /// Puts those rays in the place of the last one that go on from where it has arrived.
    #[cfg_attr(target_arch = "arm", inline(never))]
    fn go_on(&self, rays: &mut VecView<Pending<R>>, arrival: &Arrival<'_, R>) {
        let Some(Pending { ray, weight, depth }) = rays.last() else { return };
        let Settings { secondary, cutoff, .. } = self.settings;
        let (through, mirrored) = arrival.spawn(ray, secondary);
        let (before, depth) = (*weight, depth + 1);
        rays.pop();
        let mut push = |spawned: Spawned<R>| {
            let Some((ray, share)) = spawned else { return };
            let weight = before * share;
            if weight >= cutoff {
                // Never refused: each level leaves at most one ray behind.
                let _ = rays.push(Pending { ray, weight, depth });
            }
        };
        // That which goes through is the next one.
        push(mirrored);
        push(through);
    }

    /// Light that comes straight from the lamps.
    fn local<P: Probe>(
        &mut self,
        now: &Pending<R>,
        arrival: &Arrival<'_, R>,
        probe: &mut P,
    ) -> Vec3<R> {
        let mut color = Vec3::<R>::default();
        for (i, light) in self.scene.lights().iter().enumerate() {
            let Settings { cutoff, skips, .. } = self.settings;
            let towards = arrival.towards(&now.ray, light, skips.chosen());
            let Some(Towards { ray, distance, faces }) = &towards else { continue };
            let at_most = |light| arrival.at_most(ray, light) * now.weight;
            let faint = *faces && cutoff > R::ZERO && at_most(light) < cutoff;
            let blocked = !faint && self.is_blocked(i, ray, *distance, probe);
            if blocked || !*faces {
                continue;
            }
            let light = if faint { light.color * R::HALF } else { light.color };
            color = color + arrival.reflected(&now.ray, ray.direction()).scale(light);
        }
        color
    }

    /// Shoots a shadow ray to a light.
    #[inline]
    fn is_blocked<P: Probe>(&mut self, i: usize, ray: &Ray<R>, light: R, probe: &mut P) -> bool {
        let guess = self.blockers.get(i).copied().filter(|id| *id != UNBLOCKED);
        let between = Interval::new(R::ZERO, light);
        let (scene, mailbox) = (self.scene, &mut self.mailbox);
        let blocker =
            self.accel.blocker(scene, ray, between, guess.map(|id| id as usize), mailbox, probe);
        let blocked = blocker.is_some();
        if let (true, Some(last)) = (self.settings.shadow_cache, self.blockers.get_mut(i)) {
            *last = blocker.and_then(|id| u32::try_from(id).ok()).unwrap_or(UNBLOCKED);
        }
        probe.ray(RayKind::Shadow, blocked);
        blocked
    }
}

#[cfg_attr(all(target_arch = "arm", not(target_abi = "eabihf")), inline(never))]
fn surface<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    ray: &Ray<R>,
    hit: &Hit<R>,
) -> Option<Surface<R>> {
    scene.surface(ray, hit)
}

/// A ray's direction mirrored by a surface.
#[inline]
fn mirrored<R: Real>(ray: &Ray<R>, surface: &Surface<R>) -> Vec3<R> {
    let mirrored = mirror(ray, surface.shading);
    if surface.smooth && mirrored.dot(surface.normal) < R::Wide::default() {
        return mirrored_flat(ray, surface.normal);
    }
    mirrored
}

#[inline(always)]
fn mirror<R: Real>(ray: &Ray<R>, normal: Vec3<R>) -> Vec3<R> {
    let along = R::narrow(ray.direction().dot(normal));
    // A direction is in range where the ray's reach is.
    R::along(ray.direction(), normal, (-along).way(along), ray.reach())
}

/// Where an interpolated normal would send the ray into the surface.
#[cold]
#[inline(never)]
fn mirrored_flat<R: Real>(ray: &Ray<R>, normal: Vec3<R>) -> Vec3<R> {
    mirror(ray, normal)
}

/// A ray's arrival at a surface.
struct Arrival<'a, R: Real> {
    surface: &'a Surface<R>,
    material: &'a Material<R>,
    /// Where rays on the near side start.
    origin: Vec3<R>,
    /// The mirrored direction, as long as the ray's; zero where nothing mirrors.
    mirrored: Vec3<R>,
}

/// A ray from a surface to a light, its direction of length 1.
struct Towards<R: Real> {
    ray: Ray<R>,
    /// The light's parameter.
    distance: R,
    /// Whether the surface faces the light.
    faces: bool,
}

/// A ray that goes on from a surface, and its share.
type Spawned<R> = Option<(Ray<R>, R)>;

impl<'a, R: Real> Arrival<'a, R> {
    /// Of a ray.
    // Apart where registers are few: what is on the stack meanwhile is not below a shadow ray.
    #[cfg_attr(all(target_arch = "arm", not(target_has_atomic = "32")), inline(never))]
    fn of(ray: &Ray<R>, surface: &'a Surface<R>, material: &'a Material<R>, mirrors: bool) -> Self {
        let Surface { point, normal, error, reach, .. } = *surface;
        let origin = R::beside(point, normal, error, reach);
        let mirrored = if mirrors { mirrored(ray, surface) } else { Vec3::<R>::default() };
        Self { surface, material, origin, mirrored }
    }

    /// The ray to a light; `None` where it can be left out.
    #[cfg_attr(all(target_arch = "arm", not(target_abi = "eabihf")), inline(never))]
    fn towards(&self, ray: &Ray<R>, light: &Light<R>, skips: Skips) -> Option<Towards<R>> {
        let towards = R::towards(self.origin, light.position);
        let zero = R::Wide::default();
        let faces = |n: Vec3<R>| n.dot(towards) > zero;
        let Surface { normal, shading, smooth, .. } = *self.surface;
        let faces = faces(normal) && (!smooth || faces(shading));
        if !faces && skips.facing {
            return None;
        }
        let Material { diffuse, specular, .. } = *self.material;
        if skips.shadows && !(diffuse > R::ZERO || specular > R::ZERO) {
            return None;
        }
        let unit = towards.unit()?;
        let Surface { reach, left, .. } = *self.surface;
        let ray = ray.turned(self.origin, unit, R::ONE, reach, left)?;
        let distance = R::distance_to(light.position, R::narrow(towards.dot(unit)));
        Some(Towards { ray, distance, faces })
    }

    /// What a light adds at most, in any channel. Apart, as only adaptive recursion asks.
    #[inline(never)]
    fn at_most(&self, ray: &Ray<R>, light: &Light<R>) -> R {
        let cosine = R::narrow(self.surface.shading.dot(ray.direction()));
        (self.material.diffuse * cosine + self.material.specular) * light.color.max_abs()
    }

    /// What the surface sends back of white light from a direction of length 1.
    #[cfg_attr(
        not(any(target_pointer_width = "64", target_arch = "wasm32", target_abi = "eabihf")),
        inline(never)
    )]
    fn reflected(&self, ray: &Ray<R>, towards: Vec3<R>) -> Vec3<R> {
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
        let is_unit = ray.is_unit();
        let highlight = if is_unit { highlight } else { highlight / ray.squared().sqrt() };
        let highlight = highlight.min(R::ONE);
        matt + Vec3::<R>::splat(specular * highlight.powf(shine))
    }

    /// The rays that go on from here: the one that goes through, and the mirrored one.
    fn spawn(&self, ray: &Ray<R>, secondary: Secondary) -> (Spawned<R>, Spawned<R>) {
        let Material { specular, transmission, .. } = *self.material;
        let through = if transmission > R::ZERO { self.through(ray) } else { None };
        // Where nothing can leave, everything is mirrored.
        let total = transmission > R::ZERO && through.is_none();
        let share = if total { specular + transmission } else { specular };
        let mirrors = match secondary {
            Secondary::Contributing => share > R::ZERO,
            Secondary::All => specular > R::ZERO || transmission > R::ZERO,
        };
        let mirrored = if mirrors {
            let Surface { reach, left, .. } = *self.surface;
            ray.turned(self.origin, self.mirrored, ray.squared(), reach, left)
        } else {
            None
        };
        (through.map(|ray| (ray, transmission)), mirrored.map(|ray| (ray, share)))
    }

    /// The ray behind the surface, after Snell; `None` for total reflection.
    #[inline(never)]
    fn through(&self, ray: &Ray<R>) -> Option<Ray<R>> {
        let Surface { point, normal, shading, front, error, reach, left, .. } = *self.surface;
        let origin = point - normal * error;
        let index = self.material.index;
        if !(index > R::ZERO) || index == R::ONE {
            return ray.turned(origin, ray.direction(), ray.squared(), reach, left);
        }
        let direction = ray.direction().unit()?;
        let ratio = if front { R::ONE / index } else { index };
        let cosine = -R::narrow(direction.dot(shading));
        let under_root = R::ONE - ratio * ratio * (R::ONE - cosine * cosine);
        if !(under_root >= R::ZERO) {
            return None;
        }
        let bent = direction * ratio + shading * (ratio * cosine - under_root.sqrt());
        // An interpolated normal may send the ray back to where it comes from: then straight on.
        let straight = bent.dot(normal) >= R::Wide::default();
        ray.turned(origin, if straight { direction } else { bent }, R::ONE, reach, left)
    }
}
