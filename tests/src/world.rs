//! Shapes of all kinds, before and after a number type is chosen.

use kibiray::num::{Real, Vec3, Vector};
use kibiray::scene::{Scene, Solids, Triangles};
use kibiray::shape::{AxisBox, Cone, Cylinder, Plane, Polygon, Shape, Sphere, Triangle};

/// Shapes of all kinds before a number type is chosen.
#[derive(Clone, Debug, Default)]
pub struct World {
    /// Centre and radius.
    pub spheres: Vec<([f64; 3], f64)>,
    /// Corners.
    pub triangles: Vec<[[f64; 3]; 3]>,
    /// Outlines.
    pub polygons: Vec<Vec<[f64; 3]>>,
    /// Least and greatest corner.
    pub boxes: Vec<[[f64; 3]; 2]>,
    /// Ends, radius, whether closed.
    pub cylinders: Vec<([[f64; 3]; 2], f64, bool)>,
    /// Ends, radii, whether closed.
    pub cones: Vec<([[f64; 3]; 2], [f64; 2], bool)>,
    /// Point and normal.
    pub planes: Vec<([f64; 3], [f64; 3])>,
}

impl World {
    /// So many solids of every kind, up to two fifths as large as the cube of edge `size` around
    /// `middle` that they lie in. No planes.
    pub fn random(rng: &mut fastrand::Rng, each: usize, middle: [f64; 3], size: f64) -> Self {
        let mut world = Self::default();
        for _ in 0..each {
            let center = [0, 1, 2].map(|a| middle[a] + size * (rng.f64() - 0.5));
            let mut near = || [0, 1, 2].map(|a| center[a] + size * 0.4 * (rng.f64() - 0.5));
            let [a, b, c, d] = [near(), near(), near(), near()];
            let length = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
            let sub = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|i| p[i] - q[i]);
            let r = length(sub(c, d)) * 0.3;
            world.spheres.push((a, r));
            world.triangles.push([a, b, c]);
            // A quadrilateral in the plane of three corners.
            let far = [0, 1, 2].map(|i| b[i] + 0.7 * (c[i] - a[i]));
            world.polygons.push(vec![a, b, far, c]);
            world
                .boxes
                .push([[0, 1, 2].map(|i| a[i].min(b[i])), [0, 1, 2].map(|i| a[i].max(b[i]))]);
            world.cylinders.push(([a, b], r, rng.bool()));
            let apex = if rng.bool() { 0.0 } else { r * 0.5 };
            world.cones.push(([c, d], [r, apex], rng.bool()));
        }
        world
    }

    /// Every shape `times` times, in another order: what ties are made of.
    #[must_use]
    pub fn repeated(&self, times: usize, rng: &mut fastrand::Rng) -> Self {
        fn shuffled<T: Clone>(table: &[T], times: usize, rng: &mut fastrand::Rng) -> Vec<T> {
            let mut all: Vec<T> = (0..times).flat_map(|_| table.iter().cloned()).collect();
            rng.shuffle(&mut all);
            all
        }
        Self {
            spheres: shuffled(&self.spheres, times, rng),
            triangles: shuffled(&self.triangles, times, rng),
            polygons: shuffled(&self.polygons, times, rng),
            boxes: shuffled(&self.boxes, times, rng),
            cylinders: shuffled(&self.cylinders, times, rng),
            cones: shuffled(&self.cones, times, rng),
            planes: shuffled(&self.planes, times, rng),
        }
    }

    /// Everything so many times as large.
    #[must_use]
    pub fn scaled(&self, by: f64) -> Self {
        let p = |p: &[f64; 3]| p.map(|x| x * by);
        Self {
            spheres: self.spheres.iter().map(|(c, r)| (p(c), r * by)).collect(),
            triangles: self.triangles.iter().map(|t| t.each_ref().map(p)).collect(),
            polygons: self.polygons.iter().map(|o| o.iter().map(p).collect()).collect(),
            boxes: self.boxes.iter().map(|b| b.each_ref().map(p)).collect(),
            cylinders: self
                .cylinders
                .iter()
                .map(|(ends, r, capped)| (ends.each_ref().map(p), r * by, *capped))
                .collect(),
            cones: self
                .cones
                .iter()
                .map(|(ends, radii, capped)| {
                    (ends.each_ref().map(p), radii.map(|r| r * by), *capped)
                })
                .collect(),
            planes: self.planes.iter().map(|(at, normal)| (p(at), *normal)).collect(),
        }
    }

    /// Rounds every number to one that `f32` holds, so that the shapes are the same in all types.
    pub fn round_to_f32(&mut self) {
        let round = |x: &mut f64| *x = f64::from(*x as f32);
        let spheres = self.spheres.iter_mut().flat_map(|(c, r)| c.iter_mut().chain([r]));
        let triangles = self.triangles.iter_mut().flatten().flatten();
        let polygons = self.polygons.iter_mut().flatten().flatten();
        let boxes = self.boxes.iter_mut().flatten().flatten();
        let cylinders = self.cylinders.iter_mut();
        let cylinders = cylinders.flat_map(|(ends, r, _)| ends.iter_mut().flatten().chain([r]));
        let cones = self.cones.iter_mut();
        let cones = cones.flat_map(|(ends, r, _)| ends.iter_mut().flatten().chain(r));
        let planes = self.planes.iter_mut().flat_map(|(p, n)| p.iter_mut().chain(n));
        spheres.for_each(round);
        triangles.chain(polygons).chain(boxes).for_each(round);
        cylinders.for_each(round);
        cones.chain(planes).for_each(round);
    }

    /// The shapes in a number type; what is no shape in it is left out.
    pub fn tables<R: Real>(&self) -> WorldTables<R> {
        fn all<R: Real, T, S: Shape<R>>(table: &[T], f: impl Fn(&T) -> S) -> Vec<S> {
            table.iter().map(f).filter(|shape| shape.check().is_ok()).collect()
        }
        let v = |p: [f64; 3]| Vec3::<R>::from_f64(p);
        let r = R::from_f64;
        WorldTables {
            spheres: all(&self.spheres, |(c, radius)| Sphere::new(v(*c), r(*radius))),
            triangles: all(&self.triangles, |[a, b, c]| Triangle::new(v(*a), v(*b), v(*c))),
            outlines: self.polygons.iter().map(|p| p.iter().map(|c| v(*c)).collect()).collect(),
            boxes: all(&self.boxes, |[lo, hi]| AxisBox::new(v(*lo), v(*hi))),
            cylinders: all(&self.cylinders, |([a, b], radius, capped)| {
                let cylinder = Cylinder::new(v(*a), v(*b), r(*radius));
                if *capped { cylinder.capped() } else { cylinder }
            }),
            cones: all(&self.cones, |([a, b], [base, apex], capped)| {
                let cone = Cone::new(v(*a), v(*b), r(*base), r(*apex));
                if *capped { cone.capped() } else { cone }
            }),
            planes: all(&self.planes, |(p, n)| Plane::new(v(*p), v(*n))),
        }
    }
}

/// The tables of a [`World`].
#[derive(Clone, Debug)]
pub struct WorldTables<R: Real> {
    spheres: Vec<Sphere<R>>,
    triangles: Vec<Triangle<R>>,
    outlines: Vec<Vec<Vec3<R>>>,
    boxes: Vec<AxisBox<R>>,
    cylinders: Vec<Cylinder<R>>,
    cones: Vec<Cone<R>>,
    planes: Vec<Plane<R>>,
}

impl<R: Real> WorldTables<R> {
    /// The polygons, which borrow their corners.
    pub fn polygons(&self) -> Vec<Polygon<'_, R>> {
        let polygons = self.outlines.iter().map(|corners| Polygon::new(corners));
        polygons.filter(|polygon| polygon.check().is_ok()).collect()
    }

    /// The scene of all of them.
    pub fn scene<'a>(&'a self, polygons: &'a [Polygon<'a, R>]) -> Scene<'a, R, Solids<'a, R>> {
        let shapes = Solids {
            spheres: &self.spheres,
            triangles: Triangles { triangles: &self.triangles, normals: &[] },
            polygons,
            boxes: &self.boxes,
            cylinders: &self.cylinders,
            cones: &self.cones,
            planes: &self.planes,
        };
        Scene::new(shapes).unwrap()
    }
}
