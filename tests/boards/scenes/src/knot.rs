//! A knotted tube of triangles with normals at their corners.

use crate::queries::{Around, Shot};
use crate::{Subject, structure};
use kibiray::num::Vec3;
use kibiray::scene::{Light, Material, Paint, Scene, SceneError, Triangles, View};
use kibiray::shape::Triangle;

type V = Vec3<f32>;

/// The torus knot (2,3) as a tube of 1,024 triangles: 72 KiB of corners and normals.
#[derive(Clone, Copy, Debug)]
pub struct Knot;

/// Rings of the tube and corners of a ring.
const RINGS: usize = 64;
const CORNERS: usize = 8;
const COUNT: usize = 2 * RINGS * CORNERS;
const TUBE: f64 = 0.4;

/// The cosine and the sine of 1/128, 1/64, 1/16 and 1/8 of a turn: steps of rings and of corners.
pub(crate) const TURN_128: [f64; 2] = [0.998_795_456_205_172_4, 0.049_067_674_327_418_01];
const TURN_64: [f64; 2] = [0.995_184_726_672_196_9, 0.098_017_140_329_560_6];
pub(crate) const TURN_16: [f64; 2] = [0.923_879_532_511_286_7, 0.382_683_432_365_089_8];
const TURN_8: [f64; 2] = [core::f64::consts::FRAC_1_SQRT_2; 2];

/// The product of two complex numbers: of two turns, one after the other.
const fn turned([a, b]: [f64; 2], [c, d]: [f64; 2]) -> [f64; 2] {
    [a * c - b * d, a * d + b * c]
}

/// By Newton's iteration; in constants there is no other.
const fn root(x: f64) -> f64 {
    let mut y = x;
    let mut i = 0;
    while i < 40 {
        y = (y + x / y) / 2.0;
        i += 1;
    }
    y
}

const fn unit([x, y, z]: [f64; 3]) -> [f64; 3] {
    let length = root(x * x + y * y + z * z);
    [x / length, y / length, z / length]
}

const fn cross([a, b, c]: [f64; 3], [d, e, f]: [f64; 3]) -> [f64; 3] {
    [b * f - c * e, c * d - a * f, a * e - b * d]
}

/// A point of the tube and its normal, for turns along and around.
const fn point(along: [f64; 2], around: [f64; 2]) -> (V, V) {
    let [c2, s2] = turned(along, along);
    let [c3, s3] = turned([c2, s2], along);
    let radius = 2.0 + c3;
    let onwards =
        [-2.0 * radius * s2 - 3.0 * s3 * c2, 2.0 * radius * c2 - 3.0 * s3 * s2, -3.0 * c3];
    let onwards = unit(onwards);
    let across = unit(cross(onwards, [0.0, 0.0, 1.0]));
    let third = cross(onwards, across);
    let [c, s] = around;
    let normal =
        [across[0] * c + third[0] * s, across[1] * c + third[1] * s, across[2] * c + third[2] * s];
    let point = V::new(
        (radius * c2 + TUBE * normal[0]) as f32,
        (radius * s2 + TUBE * normal[1]) as f32,
        (-s3 + TUBE * normal[2]) as f32,
    );
    (point, V::new(normal[0] as f32, normal[1] as f32, normal[2] as f32))
}

/// Points and normals of a tube, ring by ring.
type Points<const CORNERS: usize, const RINGS: usize> = [[(V, V); CORNERS]; RINGS];

/// Those for steps along and around.
pub(crate) const fn points<const CORNERS: usize, const RINGS: usize>(
    ring_step: [f64; 2],
    corner_step: [f64; 2],
) -> Points<CORNERS, RINGS> {
    let mut points = [[(V::ZERO, V::ZERO); CORNERS]; RINGS];
    let mut along = [1.0, 0.0];
    let mut ring = 0;
    while ring < RINGS {
        let mut around = [1.0, 0.0];
        let mut corner = 0;
        while corner < CORNERS {
            points[ring][corner] = point(along, around);
            around = turned(around, corner_step);
            corner += 1;
        }
        along = turned(along, ring_step);
        ring += 1;
    }
    points
}

/// The three corners of a triangle and the normals there. Neighbours share corners to the bit, the
/// last ring those of the first.
const fn corners<const CORNERS: usize, const RINGS: usize>(
    points: &Points<CORNERS, RINGS>,
    triangle: usize,
) -> [(V, V); 3] {
    let (ring, corner) = (triangle / 2 / CORNERS, triangle / 2 % CORNERS);
    let (next, further) = ((ring + 1) % RINGS, (corner + 1) % CORNERS);
    let (a, c) = (points[ring][corner], points[next][further]);
    if triangle.is_multiple_of(2) {
        [a, points[next][corner], c]
    } else {
        [a, c, points[ring][further]]
    }
}

/// The triangles of a tube.
pub(crate) const fn triangles<const CORNERS: usize, const RINGS: usize, const COUNT: usize>(
    points: &Points<CORNERS, RINGS>,
) -> [Triangle<f32>; COUNT] {
    let mut triangles = [Triangle::new(V::ZERO, V::ZERO, V::ZERO); COUNT];
    let mut i = 0;
    while i < COUNT {
        let [(a, _), (b, _), (c, _)] = corners(points, i);
        triangles[i] = Triangle::new(a, b, c);
        i += 1;
    }
    triangles
}

const POINTS: Points<CORNERS, RINGS> = points(TURN_64, TURN_8);

pub(crate) static TRIANGLES: [Triangle<f32>; COUNT] = triangles(&POINTS);

static NORMALS: [[V; 3]; COUNT] = {
    let mut normals = [[V::ZERO; 3]; COUNT];
    let mut i = 0;
    while i < COUNT {
        let [(_, a), (_, b), (_, c)] = corners(&POINTS, i);
        normals[i] = [a, b, c];
        i += 1;
    }
    normals
};

static MATERIALS: [Material<f32>; 1] = [Material {
    diffuse: 0.75,
    specular: 0.25,
    shine: 40.0,
    ..Material::matt(V::new(0.9, 0.65, 0.25))
}];

static PAINT: [Paint; 1] = [Paint { first: 0, material: 0 }];

static LIGHTS: [Light<f32>; 1] = [Light { position: V::new(-4.0, 5.0, 9.0), color: V::ONE }];

impl Subject for Knot {
    const NAME: &'static str = "knot";
    const SIZE: (u16, u16) = (32, 24);
    const DEPTH: u8 = 2;
    type Number = f32;
    type Structure = structure::Octree<8, 7>;
    type Shapes = Triangles<'static, f32>;

    fn scene() -> Result<Scene<'static, f32, Self::Shapes>, SceneError> {
        Scene::new(Triangles { triangles: &TRIANGLES, normals: &NORMALS })?
            .painted(&MATERIALS, &PAINT)?
            .lit(&LIGHTS, V::new(0.1, 0.12, 0.16))
    }

    fn view() -> View<f32> {
        View { from: V::new(0.0, -4.0, 9.0), at: V::ZERO, up: V::Y, angle: 0.8 }
    }

    fn rays() -> impl Iterator<Item = Shot<f32>> {
        Around::new(200, 2.5)
    }
}
