//! Guards what a picture is made of: which way light goes, how often, how much of it is left, and
//! that no surface stands in its own light.

use std::cell::RefCell;

use kibiray::accel::{Naive, mailbox};
use kibiray::geom::{Aabb, Ray};
use kibiray::num::{Real, Vec3, Vector};
use kibiray::probe::Counters;
use kibiray::scene::{Camera, Light, Material, Paint, Scene, Shapes, Solids, Triangles, View};
use kibiray::shape::{AxisBox, Cone, Cylinder, Plane, ShapeError, Sphere, Triangle};
use kibiray::trace::{MOST_DEPTH, Secondary, Settings, Tracer};

fn v<R: Real>(x: f64, y: f64, z: f64) -> Vec3<R> {
    Vec3::<R>::from_f64([x, y, z])
}

fn ray<R: Real>(origin: [f64; 3], direction: [f64; 3]) -> Ray<R> {
    Ray::new(Vec3::<R>::from_f64(origin), Vec3::<R>::from_f64(direction)).unwrap()
}

fn deep<R: Real>(max_depth: u8) -> Settings<R> {
    Settings { max_depth, ..Settings::default() }
}

/// The colour that a ray sees, and what was counted on its way.
fn trace<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    ray: Ray<R>,
    settings: Settings<R>,
) -> ([f64; 3], Counters) {
    let (naive, mut counters) = (Naive::new(scene), Counters::default());
    let color = Tracer::new(scene, &naive, mailbox::Off, settings).color(ray, &mut counters);
    (color.to_array().map(R::to_f64), counters)
}

/// A set that notes every ray that is asked for.
struct Watched<'w, R: Real, S> {
    shapes: S,
    rays: &'w RefCell<Vec<Ray<R>>>,
}

impl<R: Real, S: Shapes<R>> Shapes<R> for Watched<'_, R, S> {
    type PerRay = S::PerRay;

    fn count(&self) -> usize {
        self.shapes.count()
    }
    fn bounded(&self) -> usize {
        self.shapes.bounded()
    }
    fn check(&self, id: usize) -> Result<(), ShapeError> {
        self.shapes.check(id)
    }
    fn bounds(&self, id: usize) -> Aabb<R> {
        self.shapes.bounds(id)
    }
    fn per_ray(&self, ray: &Ray<R>) -> S::PerRay {
        self.rays.borrow_mut().push(*ray);
        self.shapes.per_ray(ray)
    }
    fn hit(&self, id: usize, ray: &Ray<R>, per_ray: &S::PerRay, min: R, max: R) -> Option<R> {
        self.shapes.hit(id, ray, per_ray, min, max)
    }
    fn occludes(&self, id: usize, ray: &Ray<R>, per_ray: &S::PerRay, min: R, max: R) -> bool {
        self.shapes.occludes(id, ray, per_ray, min, max)
    }
    fn normal(&self, id: usize, ray: &Ray<R>, t: R) -> Vec3<R> {
        self.shapes.normal(id, ray, t)
    }
    fn shading_normal(&self, id: usize, ray: &Ray<R>, t: R) -> Option<Vec3<R>> {
        self.shapes.shading_normal(id, ray, t)
    }
}

/// Every ray that is followed, the first included, as origin and direction of length 1.
fn path<R: Real>(
    shapes: impl Shapes<R>,
    material: Material<R>,
    ray: Ray<R>,
    max_depth: u8,
) -> Vec<([f64; 3], [f64; 3])> {
    let rays = RefCell::new(Vec::new());
    let materials = [material];
    let watched = Watched { shapes, rays: &rays };
    let paint = [Paint { first: 0, material: 0 }];
    let scene = Scene::new(watched).unwrap().painted(&materials, &paint).unwrap();
    trace(&scene, ray, deep(max_depth));
    let rays = rays.borrow();
    let unit = |d: [f64; 3]| {
        let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
        d.map(|x| x / length)
    };
    let array = |v: Vec3<R>| v.to_array().map(R::to_f64);
    rays.iter().map(|ray| (array(ray.origin()), unit(array(ray.direction())))).collect()
}

fn glass<R: Real>(index: f64) -> Material<R> {
    let (zero, one) = (R::ZERO, R::ONE);
    let index = R::from_f64(index);
    Material { diffuse: zero, transmission: one, index, ..Material::default() }
}

fn mirror<R: Real>() -> Material<R> {
    Material { diffuse: R::ZERO, specular: R::ONE, ..Material::default() }
}

/// About ten operations lead from a direction to the refracted one and twenty from a ray to the
/// next one's origin, each rounded by at most half a unit in the last place of numbers up to 4.
fn close<R: Real>(found: [f64; 3], expected: [f64; 3], what: &str) {
    let bound = 40.0 * R::EPSILON.to_f64();
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= bound, "{what}: {found:?} for {expected:?}");
    }
}

/// n = 3/2, 45°: sin 45° / n = √2 / 3, and the cosine to that is √7 / 3.
fn slab<R: Real>() {
    let slab = [AxisBox::<R>::new(v::<R>(-9.0, -1.0, -9.0), v::<R>(9.0, 0.0, 9.0))];
    let (s, half) = (2.0_f64.sqrt() / 3.0, 0.5_f64.sqrt());
    let c = 7.0_f64.sqrt() / 3.0;
    let rays = path::<R>(&slab[..], glass(1.5), ray::<R>([-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]), 9);
    let [_, (enter, inside), (leave, outside)] = rays[..] else { panic!("{rays:?}") };
    close::<R>(enter, [0.0; 3], "where it enters");
    close::<R>(inside, [s, -c, 0.0], "refracted");
    // One unit deep.
    close::<R>(leave, [s / c, -1.0, 0.0], "where it leaves");
    close::<R>(outside, [half, -half, 0.0], "parallel to what it was");
    // Index 1, and index 0 for the same: straight on.
    for index in [0.0, 1.0] {
        let rays =
            path::<R>(&slab[..], glass(index), ray::<R>([-1.0, 1.0, 0.0], [1.0, -1.0, 0.0]), 9);
        assert_eq!(rays.len(), 3);
        close::<R>(rays[2].0, [1.0, -1.0, 0.0], "straight on");
        close::<R>(rays[2].1, [half, -half, 0.0], "straight on");
    }
}

#[test]
fn a_slab_refracts_after_snell() {
    slab::<f32>();
    slab::<f64>();
}

/// A ray 0.6 beside the centre of the unit sphere: sin i = 3/5, cos i = 4/5, n = 3/2: sin r = 2/5,
/// cos r = √21 / 5. It is bent by i - r twice.
fn sphere<R: Real>() {
    let sphere = [Sphere::<R>::new(v::<R>(0.0, 0.0, 0.0), R::ONE)];
    let rays = path::<R>(&sphere[..], glass(1.5), ray::<R>([-3.0, 0.6, 0.0], [1.0, 0.0, 0.0]), 9);
    let [_, (enter, inside), (_, outside)] = rays[..] else { panic!("{rays:?}") };
    let root = 21.0_f64.sqrt();
    let (sine, cosine) = ((3.0 * root - 8.0) / 25.0, (4.0 * root + 6.0) / 25.0);
    close::<R>(enter, [-0.8, 0.6, 0.0], "where it enters");
    close::<R>(inside, [cosine, -sine, 0.0], "bent once");
    close::<R>(outside, [1.0 - 2.0 * sine * sine, -2.0 * sine * cosine, 0.0], "bent twice");
}

#[test]
fn a_sphere_refracts_after_snell() {
    sphere::<f32>();
    sphere::<f64>();
}

/// sin c = 2/3 for n = 3/2: beyond 41.810° nothing leaves, before that something does.
fn total<R: Real>() {
    let block = [AxisBox::<R>::new(v::<R>(-9.0, -1.0, -9.0), v::<R>(9.0, 0.0, 9.0))];
    let inside = |degrees: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        path::<R>(&block[..], glass(1.5), ray::<R>([0.0, -0.5, 0.0], [s, c, 0.0]), 2)
    };
    for (degrees, leaves) in
        [(0.0, true), (30.0, true), (41.8, true), (41.82, false), (60.0, false)]
    {
        let rays = inside(degrees);
        assert_eq!(rays.len(), 2, "{degrees}");
        assert_eq!(rays[1].1[1] > 0.0, leaves, "{degrees}: {rays:?}");
    }
    let (s, c) = 60.0_f64.to_radians().sin_cos();
    close::<R>(inside(60.0)[1].1, [s, -c, 0.0], "mirrored");
    let (s, c) = 30.0_f64.to_radians().sin_cos();
    let bent = 1.5 * s;
    assert!(c > 0.0);
    close::<R>(inside(30.0)[1].1, [bent, (1.0 - bent * bent).sqrt(), 0.0], "refracted outwards");
    // It keeps its whole share: at 45° in a square, for ever.
    let materials = [glass(1.5)];
    let paint = [Paint { first: 0, material: 0 }];
    let scene = Scene::new(&block[..]).unwrap().painted(&materials, &paint).unwrap();
    let scene = scene.lit(&[], v::<R>(1.0, 1.0, 1.0)).unwrap();
    let (_, counters) = trace(&scene, ray::<R>([0.0, -0.5, 0.0], [1.0, 1.0, 0.0]), deep(16));
    assert_eq!((counters.secondary.shot, counters.secondary.hit), (15, 15));
}

#[test]
fn beyond_the_critical_angle_everything_is_mirrored() {
    total::<f32>();
    total::<f64>();
}

#[test]
fn shares_of_mirrored_and_transmitted_light_add_up_exactly() {
    let half_glass = Material { specular: 0.25, transmission: 0.5, ..glass::<f64>(1.5) };
    let sphere = [Sphere::new(v::<f64>(0.0, 0.0, 0.0), 1.0)];
    let (materials, paint) = ([half_glass], [Paint { first: 0, material: 0 }]);
    let scene = Scene::new(&sphere[..]).unwrap().painted(&materials, &paint).unwrap();
    let scene = scene.lit(&[], v::<f64>(1.0, 0.5, 2.0)).unwrap();
    for depth in 1..=16 {
        // Through the centre: 1/4 is mirrored, 1/2 gets in. There, at each further level, half of
        // it gets out and a quarter stays. All are powers of two, so the sum is exact in f64.
        let inside = (3..=depth).map(|level| 0.5 * 0.5 * 0.25_f64.powi(i32::from(level) - 3));
        let share = if depth > 1 { 0.25 + inside.sum::<f64>() } else { 0.0 };
        let (color, _) = trace(&scene, ray::<f64>([-3.0, 0.0, 0.0], [1.0, 0.0, 0.0]), deep(depth));
        assert_eq!(color, [share, share * 0.5, share * 2.0], "{depth}");
    }
}

/// Closed convex solids around a place, each within 1.8 sizes of it. The last two are meshes, the
/// very last with normals at the corners.
fn convex<R: Real>(center: [f64; 3], size: f64, mut f: impl FnMut(&str, Solids<'_, R>)) {
    let at = |x: f64, y: f64, z: f64| {
        v::<R>(center[0] + size * x, center[1] + size * y, center[2] + size * z)
    };
    let r = |x: f64| R::from_f64(size * x);
    f("sphere", Solids { spheres: &[Sphere::new(at(0.0, 0.0, 0.0), r(1.0))], ..Solids::default() });
    let boxes = [AxisBox::new(at(-1.0, -0.7, -0.9), at(1.0, 0.8, 0.6))];
    f("box", Solids { boxes: &boxes, ..Solids::default() });
    let cylinders = [Cylinder::new(at(-0.3, -0.9, 0.2), at(0.4, 0.8, -0.1), r(0.7)).capped()];
    f("cylinder", Solids { cylinders: &cylinders, ..Solids::default() });
    for (name, apex) in [("cone", 0.0), ("truncated cone", 0.3)] {
        let cones = [Cone::new(at(-0.3, -0.9, 0.2), at(0.4, 0.8, -0.1), r(0.9), r(apex)).capped()];
        f(name, Solids { cones: &cones, ..Solids::default() });
    }
    let (mut triangles, mut normals) = (Vec::new(), Vec::new());
    let point = |i: u32, j: u32| {
        let (u, w) = (f64::from(i % 12) / 12.0, f64::from(j) / 6.0);
        let (phi, theta) = (std::f64::consts::TAU * u, std::f64::consts::PI * w);
        let ring = if j == 0 || j == 6 { 0.0 } else { theta.sin() };
        [ring * phi.cos(), theta.cos(), ring * phi.sin()]
    };
    for i in 0..12 {
        for j in 0..6 {
            let [a, b, c, d] = [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)];
            // Triangles, not quadrangles whose corners are not quite in a plane, and none at the
            // poles that has no area. Outside is the front.
            for [p, q, s] in [[a, c, d], [a, b, c]] {
                let triangle =
                    Triangle::new(at(p[0], p[1], p[2]), at(q[0], q[1], q[2]), at(s[0], s[1], s[2]));
                if [p, q, s].iter().filter(|x| x[0] == 0.0 && x[2] == 0.0).count() < 2 {
                    triangles.push(triangle);
                    normals.push([p, q, s].map(|n| v::<R>(n[0], n[1], n[2])));
                }
            }
        }
    }
    let mesh = |normals| Triangles { triangles: &triangles, normals };
    f("mesh", Solids { triangles: mesh(&[]), ..Solids::default() });
    f("smooth mesh", Solids { triangles: mesh(&normals), ..Solids::default() });
}

const SIZES: [f64; 3] = [1.0e-6, 1.0, 1.0e6];
/// In sizes; the second makes rounding errors those of a place beside the origin.
const CENTERS: [[f64; 3]; 2] = [[0.0; 3], [3.0, -2.0, 5.0]];
const ROW: u16 = 60;

/// Every convex solid from several sides: `f` gets a scene without material and light, and the rays
/// of a picture.
fn pictures<R: Real>(mut f: impl FnMut(&str, f64, [f64; 3], Solids<'_, R>, &[Ray<R>])) {
    for size in SIZES {
        for center in CENTERS.map(|c| c.map(|x| x * size)) {
            convex::<R>(center, size, |name, solids| {
                let name = format!("{name} of size {size:e} around {center:?}");
                for from in [[3.0, 1.0, 2.0], [-2.0, 2.5, 1.0], [0.4, -3.0, -1.0]] {
                    let eye = [0, 1, 2].map(|a| center[a] + size * from[a]);
                    let view = View {
                        from: Vec3::<R>::from_f64(eye),
                        at: Vec3::<R>::from_f64(center),
                        up: v::<R>(0.0, 1.0, 0.0),
                        angle: R::from_f64(0.6),
                    };
                    let camera = Camera::new(&view, R::ONE).unwrap();
                    let at = |i: u16| R::from_f64(f64::from(2 * i + 1) / f64::from(ROW) - 1.0);
                    let pixels = (0..ROW).flat_map(|y| (0..ROW).map(move |x| (x, y)));
                    let rays: Vec<_> =
                        pixels.map(|(x, y)| camera.ray(at(x), at(y)).unwrap()).collect();
                    f(&name, size, center, solids, &rays);
                }
            });
        }
    }
}

/// The furnace: in light that is the same from everywhere, a mirror that takes nothing away cannot
/// be seen. Convex, it meets no mirrored ray again, so not a bit is lost.
fn furnace<R: Real>() {
    let (mut rays_in_all, mut hits) = (0, 0);
    pictures::<R>(|name, _, _, solids, rays| {
        let (materials, paint) = ([mirror()], [Paint { first: 0, material: 0 }]);
        let scene = Scene::new(solids).unwrap().painted(&materials, &paint).unwrap();
        let scene = scene.lit(&[], v::<R>(1.0, 0.3, 0.7)).unwrap();
        let background = scene.background().to_array().map(R::to_f64);
        for ray in rays {
            let (color, counters) = trace(&scene, *ray, deep(2));
            assert_eq!(counters.secondary.hit, 0, "{name}: mirrored into itself, {ray:?}");
            assert_eq!(color, background, "{name}: {ray:?}");
            hits += counters.primary.hit;
            rays_in_all += 1;
        }
    });
    println!("{rays_in_all} rays, {hits} mirrored");
    assert!(hits > rays_in_all / 5);
}

#[test]
fn a_convex_mirror_in_even_light_is_invisible_and_never_meets_itself() {
    furnace::<f32>();
    furnace::<f64>();
}

/// A ball of clear glass in even light cannot be seen either: what enters it leaves it, after one
/// way through.
#[test]
fn a_glass_ball_in_even_light_is_invisible() {
    pictures::<f32>(|name, _, _, solids, rays| {
        if solids.spheres.is_empty() {
            return;
        }
        let (materials, paint) = ([glass(1.5)], [Paint { first: 0, material: 0 }]);
        let scene = Scene::new(solids).unwrap().painted(&materials, &paint).unwrap();
        let scene = scene.lit(&[], v::<f32>(1.0, 0.3, 0.7)).unwrap();
        let background = scene.background().to_array().map(f64::from);
        for ray in rays {
            let (color, counters) = trace(&scene, *ray, deep(3));
            assert_eq!(color, background, "{name}: {ray:?}");
            let inside = counters.primary.hit;
            assert_eq!((counters.secondary.shot, counters.secondary.hit), (2 * inside, inside));
        }
    });
}

/// What faces a light and is convex is lit by it.
fn acne<R: Real>() {
    let (mut shot, mut lit) = (0, 0);
    pictures::<R>(|name, size, center, solids, rays| {
        let light = |x: f64, y: f64, z: f64| Light {
            position: R::far_point([
                center[0] + size * x,
                center[1] + size * y,
                center[2] + size * z,
            ]),
            color: v::<R>(1.0, 1.0, 1.0),
        };
        let lights = [light(4.0, 3.0, 5.0), light(-300.0, 0.0, 10.0), light(1.9, -1.9, 0.0)];
        let scene = Scene::new(solids).unwrap().lit(&lights, v::<R>(0.0, 0.0, 0.0)).unwrap();
        for ray in rays {
            let (color, counters) = trace(&scene, *ray, deep(1));
            assert_eq!(counters.shadow.hit, 0, "{name}: in its own shadow, {ray:?}");
            assert_eq!(color[0] > 0.0, counters.shadow.shot > 0, "{name}: {ray:?}");
            shot += counters.shadow.shot;
            lit += u64::from(color[0] > 0.0);
        }
    });
    println!("{shot} rays to lights, {lit} lit");
    assert!(lit > 10_000);
}

#[test]
fn no_convex_solid_shades_what_faces_the_light() {
    acne::<f32>();
    acne::<f64>();
}

/// A ball of radius 1 at height 3 over a ground at 0 and under a ceiling at 6, a lamp above one and
/// below the other in turn: the shadow of a lamp at distance 2 from the ball's middle, seen at the
/// angle asin(1/2) = 30°, is a disc of radius 5 tan 30° where it falls.
#[test]
fn shadows_fall_behind_what_stands_in_the_light_and_nowhere_else() {
    let planes = [(0.0, 1.0), (6.0, -1.0)]
        .map(|(y, up)| Plane::<f32>::new(v::<f32>(0.0, y, 0.0), v::<f32>(0.0, up, 0.0)));
    let spheres = [Sphere::new(v::<f32>(0.0, 3.0, 0.0), 1.0)];
    let solids = Solids { spheres: &spheres, planes: &planes, ..Solids::default() };
    let radius = 5.0 * 30.0_f64.to_radians().tan();
    for (lamp, (shaded, bright)) in [(5.0, (0.0, 6.0)), (1.0, (6.0, 0.0))] {
        let lights = [Light { position: v::<f32>(0.0, lamp, 0.0), color: v::<f32>(1.0, 1.0, 1.0) }];
        let scene = Scene::new(solids).unwrap().lit(&lights, v::<f32>(0.0, 0.0, 0.0)).unwrap();
        let (mut dark, mut lit) = (0, 0);
        for i in 0..100 {
            let (x, z) = (f64::from(i) * 0.1 - 5.0, f64::from(i * 37 % 100) * 0.1 - 5.0);
            for y in [shaded, bright] {
                // Down or up from just beside the ground or ceiling.
                let down = if y == 0.0 { -1.0 } else { 1.0 };
                let (color, counters) =
                    trace(&scene, ray::<f32>([x, y - down * 0.5, z], [0.0, down, 0.0]), deep(1));
                assert_eq!((counters.primary.hit, counters.shadow.shot), (1, 1));
                let beside = x.hypot(z) - radius;
                // The rim itself belongs to either side.
                if beside.abs() < 1.0e-4 {
                    continue;
                }
                let shadow = y == shaded && beside < 0.0;
                assert_eq!(color[0] == 0.0, shadow, "lamp at {lamp}: {x} {y} {z}");
                assert_eq!(counters.shadow.hit, u64::from(shadow));
                *(if shadow { &mut dark } else { &mut lit }) += 1;
            }
        }
        println!("lamp at {lamp}: {dark} dark, {lit} lit");
        assert!(dark > 10 && lit > 100);
    }
}

/// From 10^6 sizes on, moving a light further away along the same line turns its direction by less
/// than 2 · 10^-6, so the colour stays within that of what it is at 10^6, highlight included (whose
/// power of 8 makes 8 of it).
fn distant<R: Real>(distances: &[f64]) {
    let shiny = Material { specular: R::HALF, shine: R::exponent(8.0), ..Material::default() };
    let (materials, paint) = ([shiny], [Paint { first: 0, material: 0 }]);
    let sphere = [Sphere::<R>::new(v::<R>(0.0, 0.0, 0.0), R::ONE)];
    let look = ray::<R>([0.2, 0.1, 5.0], [0.0, 0.0, -1.0]);
    for direction in [[0.0, 0.0, 1.0], [0.3, 0.9, 0.5], [0.57, -0.57, 0.59]] {
        let color = |distance: f64| {
            let position = R::far_point(direction.map(|x| x * distance));
            let lights = [Light { position, color: v::<R>(1.0, 1.0, 1.0) }];
            let scene = Scene::new(&sphere[..]).unwrap().painted(&materials, &paint).unwrap();
            let scene = scene.lit(&lights, v::<R>(0.0, 0.0, 0.0)).unwrap();
            trace(&scene, look, deep(1)).0[0]
        };
        let reference = color(1.0e6);
        assert!(reference > 0.1);
        for distance in distances {
            let found = color(*distance);
            assert!((found - reference).abs() < 2.0e-5, "{distance:e}: {found} for {reference}");
        }
    }
}

#[test]
fn light_from_as_far_as_numbers_go_is_light() {
    // The fourth of what the type holds is allowed, and no product of it overflows.
    distant::<f32>(&[1.0e7, 1.0e10, 1.0e18, 1.0e19, 2.0e19, 1.0e20, 1.0e30, 8.0e37]);
    distant::<f64>(&[1.0e7, 1.0e18, 1.0e20, 1.0e100, 1.0e154, 1.0e155, 1.0e300, 4.0e307]);
}

#[test]
fn depth_says_how_often_light_is_mirrored() {
    let planes =
        [0.0, 1.0].map(|y| Plane::<f32>::new(v::<f32>(0.0, y, 0.0), v::<f32>(0.0, 1.0, 0.0)));
    let boxes = [-1.0, 1.0]
        .map(|y| AxisBox::<f32>::new(v::<f32>(-900.0, y, -900.0), v::<f32>(900.0, y + 1.0, 900.0)));
    let (materials, paint) = ([mirror()], [Paint { first: 0, material: 0 }]);
    for solids in [
        Solids { planes: &planes, ..Solids::default() },
        Solids { boxes: &boxes, ..Solids::default() },
    ] {
        let scene = Scene::new(solids).unwrap().painted(&materials, &paint).unwrap();
        let scene = scene.lit(&[], v::<f32>(1.0, 1.0, 1.0)).unwrap();
        for depth in 0..=u8::MAX {
            for secondary in [Secondary::Contributing, Secondary::All] {
                let settings = Settings { max_depth: depth, secondary, ..Settings::default() };
                let (color, counters) =
                    trace(&scene, ray::<f32>([0.0, 0.5, 0.0], [1.0, -1.0, 0.1]), settings);
                let rays = u64::from(depth.clamp(1, MOST_DEPTH));
                assert_eq!((counters.primary.shot, counters.primary.hit), (1, 1));
                let expected = (rays - 1, rays - 1);
                assert_eq!((counters.secondary.shot, counters.secondary.hit), expected, "{depth}");
                assert_eq!(color, [0.0; 3], "what is cut off is black");
            }
        }
    }
}

/// Between panes that mirror and transmit, every ray begets two, at every level, down to the last:
/// a stack that is too small would lose some. 40 panes, so that none gets out in 16 levels.
#[test]
fn no_ray_is_lost_between_panes_of_glass() {
    let mut panes = Vec::new();
    for i in 0..40 {
        panes.push(Plane::<f32>::new(v::<f32>(0.0, 0.0, f64::from(i)), v::<f32>(0.0, 0.0, 1.0)));
    }
    for index in [1.0, 1.5] {
        let pane = Material { specular: 0.5, transmission: 0.5, ..glass(index) };
        let (materials, paint) = ([pane], [Paint { first: 0, material: 0 }]);
        let solids = Solids { planes: &panes, ..Solids::default() };
        let scene = Scene::new(solids).unwrap().painted(&materials, &paint).unwrap();
        for depth in 1..=MOST_DEPTH {
            let (_, counters) =
                trace(&scene, ray::<f32>([0.0, 0.0, 19.5], [0.0, 0.0, 1.0]), deep(depth));
            let expected = (1_u64 << depth) - 2;
            assert_eq!((counters.secondary.shot, counters.secondary.hit), (expected, expected));
        }
    }
}
