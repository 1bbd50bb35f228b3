//! Tables of a scene in memory of fixed size: what lies in flash on a device.

use super::V;
use heapless::Vec;
use kibiray::scene::{Light, Material, Paint, Scene, SceneError, Shapes, Solids, Triangles};
use kibiray::shape::{AxisBox, Cone, Cylinder, Plane, Polygon, Sphere, Triangle};

/// How many triangles there may be, with and without normals.
const TRIANGLES: usize = 1536;

/// Tables that a scene is put into. What does not fit is left out.
#[derive(Debug)]
pub struct Store {
    spheres: Vec<Sphere<f32>, 256>,
    triangles: Vec<Triangle<f32>, TRIANGLES>,
    normals: Vec<[V; 3], TRIANGLES>,
    polygons: Vec<Polygon<'static, f32>, 4>,
    boxes: Vec<AxisBox<f32>, 80>,
    cylinders: Vec<Cylinder<f32>, 16>,
    cones: Vec<Cone<f32>, 16>,
    planes: Vec<Plane<f32>, 2>,
    lights: Vec<Light<f32>, 4>,
    materials: Vec<Material<f32>, 16>,
    /// Which kind of shape, in the order of ids, and from which of them on, has which material.
    runs: Vec<(u8, u16, u16), 32>,
    paint: Vec<Paint, 32>,
    background: V,
    overflowed: bool,
}

impl Store {
    /// Nothing in it.
    pub const EMPTY: Self = Self {
        spheres: Vec::new(),
        triangles: Vec::new(),
        normals: Vec::new(),
        polygons: Vec::new(),
        boxes: Vec::new(),
        cylinders: Vec::new(),
        cones: Vec::new(),
        planes: Vec::new(),
        lights: Vec::new(),
        materials: Vec::new(),
        runs: Vec::new(),
        paint: Vec::new(),
        background: V::ZERO,
        overflowed: false,
    };

    /// The scene in it, checked.
    ///
    /// # Errors
    /// Those of the core; none is expected of a scene from here.
    pub fn scene(&self) -> Result<Scene<'_, f32, Solids<'_, f32>>, SceneError> {
        Scene::new(self.solids())?
            .painted(&self.materials, &self.paint)?
            .lit(&self.lights, self.background)
    }

    /// Bytes of the tables: shapes, surfaces, lights.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.spheres)
            + size_of_val(&*self.triangles)
            + size_of_val(&*self.normals)
            + size_of_val(&*self.polygons)
            + self.polygons.iter().map(|polygon| size_of_val(polygon.vertices())).sum::<usize>()
            + size_of_val(&*self.boxes)
            + size_of_val(&*self.cylinders)
            + size_of_val(&*self.cones)
            + size_of_val(&*self.planes)
            + size_of_val(&*self.lights)
            + size_of_val(&*self.materials)
            + size_of_val(&*self.paint)
    }

    /// Whether something did not fit.
    pub fn overflowed(&self) -> bool {
        self.overflowed
    }

    fn solids(&self) -> Solids<'_, f32> {
        Solids {
            spheres: &self.spheres,
            triangles: Triangles { triangles: &self.triangles, normals: &self.normals },
            polygons: &self.polygons,
            boxes: &self.boxes,
            cylinders: &self.cylinders,
            cones: &self.cones,
            planes: &self.planes,
        }
    }

    pub(crate) fn clear(&mut self) {
        self.spheres.clear();
        self.triangles.clear();
        self.normals.clear();
        self.polygons.clear();
        self.boxes.clear();
        self.cylinders.clear();
        self.cones.clear();
        self.planes.clear();
        self.lights.clear();
        self.materials.clear();
        self.runs.clear();
        self.paint.clear();
        self.background = V::ZERO;
        self.overflowed = false;
    }

    /// Turns runs by kind into paint by id.
    pub(crate) fn finish(&mut self) {
        let counts = [
            self.spheres.len(),
            self.triangles.len(),
            self.polygons.len(),
            self.boxes.len(),
            self.cylinders.len(),
            self.cones.len(),
            self.planes.len(),
        ];
        let mut first = 0;
        for (kind, count) in counts.iter().enumerate() {
            for (of, from, material) in &self.runs {
                if usize::from(*of) == kind {
                    let paint = Paint { first: first + usize::from(*from), material: *material };
                    self.overflowed |= self.paint.push(paint).is_err();
                }
            }
            first += count;
        }
        debug_assert_eq!(first, self.solids().count());
    }

    /// The colour where nothing is hit.
    pub(crate) fn background(&mut self, r: f32, g: f32, b: f32) {
        self.background = V::new(r, g, b);
    }

    pub(crate) fn light(&mut self, position: V, color: V) {
        self.overflowed |= self.lights.push(Light { position, color }).is_err();
    }

    /// The surface of the shapes that follow: colour, Kd, Ks and Phong's power.
    pub(crate) fn surface(&mut self, color: V, diffuse: f32, specular: f32, shine: f32) {
        self.material(Material { color, diffuse, specular, shine, ..Material::default() });
    }

    pub(crate) fn glass(&mut self) {
        self.material(Material {
            color: V::new(0.9, 0.95, 0.95),
            diffuse: 0.04,
            specular: 0.12,
            shine: 250.0,
            transmission: 0.84,
            index: 1.5,
            ..Material::default()
        });
    }

    fn material(&mut self, material: Material<f32>) {
        self.overflowed |= self.materials.push(material).is_err();
    }

    /// Notes the material of the shape of a kind that comes next.
    fn run(&mut self, kind: u8, next: usize) {
        let material = self.materials.len().saturating_sub(1) as u16;
        let last = self.runs.iter().rev().find(|(of, _, _)| *of == kind);
        if last.is_none_or(|(_, _, of)| *of != material) {
            self.overflowed |= self.runs.push((kind, next as u16, material)).is_err();
        }
    }

    pub(crate) fn sphere(&mut self, center: V, radius: f32) {
        self.run(0, self.spheres.len());
        self.overflowed |= self.spheres.push(Sphere::new(center, radius)).is_err();
    }

    pub(crate) fn triangle(&mut self, [a, b, c]: [V; 3]) {
        self.run(1, self.triangles.len());
        self.overflowed |= self.triangles.push(Triangle::new(a, b, c)).is_err();
    }

    /// Corners, each with its normal. Before all triangles without.
    pub(crate) fn smooth(&mut self, corners: [(V, V); 3]) {
        self.overflowed |= self.normals.push(corners.map(|(_, normal)| normal)).is_err();
        self.triangle(corners.map(|(corner, _)| corner));
    }

    pub(crate) fn polygon(&mut self, vertices: &'static [V]) {
        self.run(2, self.polygons.len());
        self.overflowed |= self.polygons.push(Polygon::new(vertices)).is_err();
    }

    pub(crate) fn block(&mut self, lo: V, hi: V) {
        self.run(3, self.boxes.len());
        self.overflowed |= self.boxes.push(AxisBox::new(lo, hi)).is_err();
    }

    pub(crate) fn cylinder(&mut self, base: V, apex: V, radius: f32) {
        self.run(4, self.cylinders.len());
        let cylinder = Cylinder::new(base, apex, radius).capped();
        self.overflowed |= self.cylinders.push(cylinder).is_err();
    }

    pub(crate) fn cone(&mut self, (base, base_radius): (V, f32), (apex, apex_radius): (V, f32)) {
        self.run(5, self.cones.len());
        let cone = Cone::new(base, apex, base_radius, apex_radius).capped();
        self.overflowed |= self.cones.push(cone).is_err();
    }

    /// A floor.
    pub(crate) fn floor(&mut self, height: f32) {
        self.run(6, self.planes.len());
        let plane = Plane::new(V::new(0.0, height, 0.0), V::new(0.0, 1.0, 0.0));
        self.overflowed |= self.planes.push(plane).is_err();
    }

    /// Tiles of edge 1 around the origin, in two colours by turns.
    pub(crate) fn tiles(&mut self, across: i8, [light, dark]: [V; 2]) {
        for (odd, color) in [(false, light), (true, dark)] {
            self.surface(color, 0.85, 0.12, 40.0);
            for x in -across..across {
                for z in -across..across {
                    if ((x + z) & 1 != 0) == odd {
                        let (x, z) = (f32::from(x), f32::from(z));
                        self.block(V::new(x, -0.125, z), V::new(x + 1.0, 0.0, z + 1.0));
                    }
                }
            }
        }
    }
}
