//! Rays through knots of 1,024 and 4,096 triangles: the meshes of the published baselines (see the
//! README of the boards).

use crate::clouds::Inwards;
use crate::knot::{self, TURN_16, TURN_128, points, triangles};
use crate::queries::Shot;
use crate::structure::{Bvh, StampedGrid};
use crate::{Structure, Subject};
use core::marker::PhantomData;
use glam::Vec3;
use kibiray::scene::{Scene, SceneError};
use kibiray::shape::Triangle;

/// The knot of [`Knot`](crate::Knot), queries only.
#[derive(Clone, Copy, Debug)]
pub struct Knot1024<K>(PhantomData<K>);

/// The same knot of four times as many triangles, 144 KiB of them.
#[derive(Clone, Copy, Debug)]
pub struct Knot4096<K>(PhantomData<K>);

/// In a hierarchy with a node for every ten triangles: 9 KiB.
pub type Knot1024Bvh = Knot1024<Bvh<103>>;
/// The same: 36 KiB.
pub type Knot4096Bvh = Knot4096<Bvh<410>>;

/// In a grid with stamps and exact lists, as fine as 12 KiB allow.
pub type Knot1024Grid = Knot1024<StampedGrid<13, 13, 9, true>>;
/// As fine as 48 KiB allow.
pub type Knot4096Grid = Knot4096<StampedGrid<24, 24, 13, true>>;

static FINE: [Triangle<f32>; 4096] = triangles(&points::<16, 128>(TURN_128, TURN_16));

/// From a sphere of radius 6 to points of the box around the knots.
fn inwards() -> Inwards {
    Inwards::from(6.0, Vec3::new(3.4, 3.4, 1.4))
}

impl<K: Structure<f32>> Subject for Knot1024<K> {
    const NAME: &'static str = "knot_1024";
    type Number = f32;
    type Structure = K;
    type Shapes = &'static [Triangle<f32>];

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new(&knot::TRIANGLES[..])
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        inwards()
    }
}

impl<K: Structure<f32>> Subject for Knot4096<K> {
    const NAME: &'static str = "knot_4096";
    type Number = f32;
    type Structure = K;
    type Shapes = &'static [Triangle<f32>];

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new(&FINE[..])
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        inwards()
    }
}
