//! W. Sierpinski's gasket in space, as in the Standard Procedural Databases (E. Haines, "A proposal
//! for standard graphics environments", IEEE CG&A 7(11), 1987).

use crate::queries::{Around, Shot};
use crate::{Subject, structure};
use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Scene, SceneError, View};
use kibiray::shape::Triangle;

type V = Vec3<f32>;

/// 64 tetrahedra, divided three times: 256 triangles that touch each other at corners.
#[derive(Clone, Copy, Debug)]
pub struct Tetra;

const LEVELS: u32 = 3;
const COUNT: usize = 4 << (2 * LEVELS);

/// Every other corner of a cube of edge 2.
const CORNERS: [[f32; 3]; 4] =
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];

/// Faces, anticlockwise from outside.
const FACES: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]];

/// A corner of one of the tetrahedra. Powers of two: without rounding.
const fn corner(tetrahedron: usize, corner: usize) -> V {
    let mut size = 1.0;
    let mut middle = [0.0; 3];
    let mut level = 0;
    while level < LEVELS {
        size *= 0.5;
        let towards = CORNERS[tetrahedron >> (2 * level) & 3];
        let mut axis = 0;
        while axis < 3 {
            middle[axis] += towards[axis] * size;
            axis += 1;
        }
        level += 1;
    }
    let [x, y, z] = CORNERS[corner];
    V::new(middle[0] + x * size, middle[1] + y * size, middle[2] + z * size)
}

static TRIANGLES: [Triangle<f32>; COUNT] = {
    let mut triangles = [Triangle::new(V::ZERO, V::ZERO, V::ZERO); COUNT];
    let mut i = 0;
    while i < COUNT {
        let [a, b, c] = FACES[i % 4];
        triangles[i] = Triangle::new(corner(i / 4, a), corner(i / 4, b), corner(i / 4, c));
        i += 1;
    }
    triangles
};

static MATERIALS: [Material<f32>; 1] =
    [Material { diffuse: 0.95, ..Material::matt(V::new(0.2, 0.7, 0.65)) }];

static PAINT: [Paint; 1] = [Paint { first: 0, material: 0 }];

static LIGHTS: [Light<f32>; 2] = [
    Light { position: V::new(5.0, 4.0, 3.0), color: V::new(0.7, 0.65, 0.6) },
    Light { position: V::new(-2.0, 5.0, 6.0), color: V::new(0.4, 0.45, 0.5) },
];

impl Subject for Tetra {
    const NAME: &'static str = "tetra";
    const SIZE: (u16, u16) = (32, 24);
    const DEPTH: u8 = 1;
    type Number = f32;
    type Structure = structure::Grid<8, 8, 8>;
    type Shapes = &'static [Triangle<f32>];

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new(&TRIANGLES[..])?
            .painted(&MATERIALS, &PAINT)?
            .lit(&LIGHTS, V::new(0.08, 0.1, 0.12))
    }

    fn view() -> View<f32> {
        View { from: V::new(2.0, 1.0, 3.0), at: V::ZERO, up: V::Y, angle: 0.75 }
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Around::new(400, 1.0)
    }
}
