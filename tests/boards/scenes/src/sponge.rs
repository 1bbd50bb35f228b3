//! K. Menger's sponge.

use crate::queries::{Around, Shot};
use crate::{Subject, structure};
use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Scene, SceneError, View};
use kibiray::shape::AxisBox;

type V = Vec3<f32>;

/// Divided twice: 400 boxes whose faces touch.
#[derive(Clone, Copy, Debug)]
pub struct Sponge;

const COUNT: usize = 400;

/// Whether a cell of the 9×9×9 belongs to it: at no level is it in the middle of two axes or more.
const fn solid([x, y, z]: [u8; 3]) -> bool {
    let fine = (x % 3 == 1) as u8 + (y % 3 == 1) as u8 + (z % 3 == 1) as u8;
    let coarse = (x / 3 == 1) as u8 + (y / 3 == 1) as u8 + (z / 3 == 1) as u8;
    fine < 2 && coarse < 2
}

static BOXES: [AxisBox<f32>; COUNT] = {
    let mut boxes = [AxisBox::new(V::ZERO, V::ZERO); COUNT];
    let (mut cell, mut i) = (0_u16, 0);
    while cell < 729 {
        let place = [(cell % 9) as u8, (cell / 9 % 9) as u8, (cell / 81) as u8];
        if solid(place) {
            let [x, y, z] = place;
            // Quarters: the faces of neighbours are the same numbers.
            let lo = V::new(wall(x), wall(y), wall(z));
            boxes[i] = AxisBox::new(lo, V::new(wall(x + 1), wall(y + 1), wall(z + 1)));
            i += 1;
        }
        cell += 1;
    }
    assert!(i == COUNT);
    boxes
};

const fn wall(n: u8) -> f32 {
    (n as f32 - 4.5) / 4.0
}

static MATERIALS: [Material<f32>; 1] =
    [Material { diffuse: 0.9, ..Material::matt(V::new(0.85, 0.7, 0.45)) }];

static PAINT: [Paint; 1] = [Paint { first: 0, material: 0 }];

static LIGHTS: [Light<f32>; 1] = [Light { position: V::new(2.0, 5.0, 4.0), color: V::ONE }];

impl Subject for Sponge {
    const NAME: &'static str = "sponge";
    const SIZE: (u16, u16) = (32, 24);
    const DEPTH: u8 = 1;
    type Number = f32;
    type Structure = structure::Octree<4, 4>;
    type Shapes = &'static [AxisBox<f32>];

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new(&BOXES[..])?.painted(&MATERIALS, &PAINT)?.lit(&LIGHTS, V::new(0.3, 0.4, 0.55))
    }

    fn view() -> View<f32> {
        View { from: V::new(1.75, 1.5, 3.0), at: V::ZERO, up: V::Y, angle: 0.75 }
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Around::new(400, 1.25)
    }
}
