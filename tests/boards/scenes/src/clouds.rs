//! 512 spheres and 512 triangles with a thousand rays: the scenes of the published baselines, for
//! which figures of brute force and of parry3d are known (see the README of the boards).

use crate::queries::Shot;
use crate::structure::{Bvh, Grid, Naive, Octree, StampedGrid, Tree};
use crate::xorshift::Xorshift;
use crate::{Structure, Subject};
use core::marker::PhantomData;
use glam::Vec3;
use kibiray::geom::{Interval, Ray};
use kibiray::scene::{Scene, SceneError};
use kibiray::shape::{Sphere, Triangle};

/// Spheres in the cube from -1 to 1; queries only.
#[derive(Clone, Copy, Debug)]
pub struct Spheres<K>(PhantomData<K>);

/// Triangles in the cube from -1 to 1; queries only.
#[derive(Clone, Copy, Debug)]
pub struct Triangles<K>(PhantomData<K>);

/// Spheres, every one tested.
pub type SpheresNaive = Spheres<Naive>;
/// Spheres in the smallest grid that takes the fewest instructions a ray on a Cortex-M4F, give or
/// take 2.
pub type SpheresGrid = Spheres<Grid<9, 9, 9>>;
/// Spheres in the best octree, of those with 2 to 24 shapes a cell and 2 to 5 levels.
pub type SpheresOctree = Spheres<Octree<16, 3>>;
/// Spheres in the best hierarchy, of those with 48 to 255 nodes.
pub type SpheresBvh = Spheres<Bvh<48>>;
/// Spheres inserted one by one into a tree of boxes.
pub type SpheresTree = Spheres<Tree>;
/// Triangles, every one tested.
pub type TrianglesNaive = Triangles<Naive>;
/// Triangles in the best grid, as for spheres.
pub type TrianglesGrid = Triangles<Grid<10, 10, 10>>;
/// Triangles in a grid with stamps and exact lists, of fewer than 10 KB; for spheres stamps take more
/// than they save.
pub type TrianglesStampedGrid = Triangles<StampedGrid<14, 14, 14, true>>;
/// Triangles in the best octree.
pub type TrianglesOctree = Triangles<Octree<4, 3>>;
/// Triangles in the best hierarchy.
pub type TrianglesBvh = Triangles<Bvh<128>>;

pub(crate) const COUNT: usize = 512;
/// The square root of `COUNT`: sizes shrink with it, so that as much of the view is covered.
const ROOT: f32 = 22.627_417;

pub(crate) static SPHERES: [Sphere<f32>; COUNT] = {
    let mut random = Xorshift(0x1234_5678);
    let mut spheres = [Sphere::new(Vec3::ZERO, 1.0); COUNT];
    let mut i = 0;
    while i < COUNT {
        let center = Vec3::from_array(random.cube());
        spheres[i] = Sphere::new(center, 0.8 / ROOT * (0.5 + random.unit()));
        i += 1;
    }
    spheres
};

/// A corner near a point.
const fn near([x, y, z]: [f32; 3], random: &mut Xorshift) -> Vec3 {
    const SIZE: f32 = 2.0 / ROOT;
    let [a, b, c] = random.cube();
    Vec3::new(x + a * SIZE, y + b * SIZE, z + c * SIZE)
}

pub(crate) static TRIANGLES: [Triangle<f32>; COUNT] = {
    let mut random = Xorshift(0x2345_6789);
    let mut triangles = [Triangle::new(Vec3::ZERO, Vec3::ZERO, Vec3::ZERO); COUNT];
    let mut i = 0;
    while i < COUNT {
        let middle = random.cube();
        let a = near(middle, &mut random);
        let b = near(middle, &mut random);
        triangles[i] = Triangle::new(a, b, near(middle, &mut random));
        i += 1;
    }
    triangles
};

/// A thousand rays from a sphere to points of a box, both around the origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Inwards {
    random: Xorshift,
    radius: f32,
    half: Vec3,
    left: u32,
}

impl Inwards {
    /// From a sphere of radius 3 to the cube.
    pub(crate) const fn new() -> Self {
        Self::from(3.0, Vec3::ONE)
    }

    pub(crate) const fn from(radius: f32, half: Vec3) -> Self {
        Self { random: Xorshift(0x9e37_79b9), radius, half, left: 1000 }
    }

    fn cube(&mut self) -> Vec3 {
        Vec3::from_array(self.random.cube())
    }

    /// A direction. A try fails with a probability of a half.
    fn direction(&mut self) -> Vec3 {
        (0..64)
            .find_map(|_| {
                let v = self.cube();
                let squared = v.length_squared();
                (squared < 1.0 && squared > 1e-3).then(|| v.normalize())
            })
            .unwrap_or(Vec3::X)
    }
}

impl Iterator for Inwards {
    type Item = Shot<f32>;

    fn next(&mut self) -> Option<Shot<f32>> {
        self.left = self.left.checked_sub(1)?;
        let origin = self.direction() * self.radius;
        let direction = (self.cube() * self.half - origin).normalize();
        Some(Shot { ray: Ray::new(origin, direction).ok()?, between: Interval::RAY })
    }
}

impl<K: Structure<f32>> Subject for Spheres<K> {
    const NAME: &'static str = "spheres";
    type Number = f32;
    type Structure = K;
    type Shapes = &'static [Sphere<f32>];

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new(&SPHERES[..])
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Inwards::new()
    }
}

impl<K: Structure<f32>> Subject for Triangles<K> {
    const NAME: &'static str = "triangles";
    type Number = f32;
    type Structure = K;
    type Shapes = &'static [Triangle<f32>];

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new(&TRIANGLES[..])
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Inwards::new()
    }
}
