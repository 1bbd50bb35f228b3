//! The axes along which shapes lie.
//!
//! S. Gottschalk, M. Lin, D. Manocha, "OBBTree: a hierarchical structure for rapid interference
//! detection", SIGGRAPH 1996: the eigenvectors of the covariance of all points of the surface, each
//! piece weighted by its area. They are found by C. G. J. Jacobi's rotations (Journal für die reine
//! und angewandte Mathematik 30, 1846), so many sweeps and no more; each leaves the axes at right
//! angles, so any number of them gives axes to build with. All of it in doubles, whatever the number
//! type: only a choice depends on it.

use super::Region;
use crate::num::{Real, Vec3, Vector};

type Double = Vec3<f64>;

/// Sweeps of three rotations. The rest falls with its square from one to the next.
const SWEEPS: usize = 5;

/// The axes of the covariance, of length 1 and at right angles. Where all directions are alike, or
/// nothing can be computed with the numbers: those of the world.
pub(super) fn principal_axes<R: Real>(
    inside: impl Iterator<Item = Region<R>> + Clone,
) -> [Vec3<R>; 3] {
    // Counted from one of them, as what is far away has few digits for its own size.
    let from = inside.clone().next().map_or_else(Double::default, |region| middle(&region));
    let mut sum = Moments::default();
    inside.for_each(|region| sum.add(&region, from));
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(Double::from_array);
    let mut axes = [x, y, z];
    let [mut diagonal, mut beside] = sum.covariance();
    for _ in 0..3 * SWEEPS {
        axes = rotate(axes, &mut diagonal, &mut beside);
    }
    let found = axes.iter().all(|axis| axis.is_finite());
    (if found { axes } else { [x, y, z] }).map(|axis| Vec3::<R>::from_f64(axis.to_array()))
}

/// Turns the first two axes so that nothing of the covariance is left between them, and makes the
/// second axis the first. `beside` is what is between the first and second axis, and so on.
fn rotate([u, v, w]: [Double; 3], diagonal: &mut [f64; 3], beside: &mut [f64; 3]) -> [Double; 3] {
    let ([xx, yy, zz], [xy, yz, zx]) = (*diagonal, *beside);
    // The smaller angle. Between equal ones with nothing between them: none.
    let tangent = if xy == 0.0 {
        0.0
    } else {
        let cotangent = (yy - xx) / (xy + xy);
        let tangent = 1.0 / (Real::abs(cotangent) + Real::sqrt(cotangent * cotangent + 1.0));
        if cotangent < 0.0 { -tangent } else { tangent }
    };
    let cosine = 1.0 / Real::sqrt(tangent * tangent + 1.0);
    let sine = tangent * cosine;
    *diagonal = [yy + tangent * xy, zz, xx - tangent * xy];
    *beside = [sine * zx + cosine * yz, cosine * zx - sine * yz, 0.0];
    [u * sine + v * cosine, w, u * cosine - v * sine]
}

/// Sums over pieces of surface.
#[derive(Default)]
struct Moments {
    area: f64,
    first: Double,
    /// Of squares, and of products of one axis and the next.
    second: [Double; 2],
}

impl Moments {
    /// Adds a shape, places counted from `from`: a triangle as it is, another one as its box, a flat
    /// one as what its box is seen across the plane.
    fn add<R: Real>(&mut self, region: &Region<R>, from: Double) {
        let middle = middle(region) - from;
        let box_size = double::<R>(region.bounds().size());
        let [x, y, z] = box_size.to_array();
        let sides = Double::new(y * z, z * x, x * y);
        let thirds = 1.0 / 12.0;
        match *region {
            Region::Triangle { corners, .. } => {
                let [a, b, c] = corners.map(|corner| double::<R>(corner) - from);
                let area = (b - a).cross(c - a).length() * 0.5;
                self.add_points(area, middle, thirds, [a - middle, b - middle, c - middle]);
            }
            Region::Flat { normal, .. } => {
                let normal = double::<R>(normal);
                let area = sides.dot(normal.map(Real::abs));
                let flat = |edge: Double| edge - normal * edge.dot(normal);
                self.add_points(area, middle, thirds, edges(box_size).map(flat));
            }
            _ => {
                let area = sides.x() + sides.y() + sides.z();
                self.add_points(area, middle, thirds, edges(box_size));
            }
        }
    }

    /// Adds a piece with its middle, and points around that of which so much makes its covariance.
    fn add_points(&mut self, area: f64, middle: Double, part: f64, points: [Double; 3]) {
        self.area += area;
        self.first += middle * area;
        let weighted = points.map(|point| (point, area * part));
        for (point, weight) in weighted.into_iter().chain([(middle, area)]) {
            let [x, y, z] = point.to_array();
            let [squares, products] = self.second;
            self.second = [
                squares + Double::new(x * x, y * y, z * z) * weight,
                products + Double::new(x * y, y * z, z * x) * weight,
            ];
        }
    }

    /// Of squares, and of products of one axis and the next; times any number.
    fn covariance(&self) -> [[f64; 3]; 2] {
        let [x, y, z] = self.first.to_array();
        let [squares, products] = self.second.map(|sum| sum * self.area);
        let squares = squares - Double::new(x * x, y * y, z * z);
        let products = products - Double::new(x * y, y * z, z * x);
        [squares.to_array(), products.to_array()]
    }
}

fn double<R: Real>(v: Vec3<R>) -> Double {
    Double::from_array(v.to_array().map(R::to_f64))
}

/// Of a triangle the middle of its corners, of others that of the box.
fn middle<R: Real>(region: &Region<R>) -> Double {
    if let Region::Triangle { corners: [a, b, c], .. } = *region {
        return (double::<R>(a) + double::<R>(b) + double::<R>(c)) * (1.0 / 3.0);
    }
    let bounds = region.bounds();
    (double::<R>(bounds.lo) + double::<R>(bounds.hi)) * 0.5
}

/// Of a box.
fn edges(size: Double) -> [Double; 3] {
    let [x, y, z] = size.to_array();
    [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]].map(Double::from_array)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, vec3};

    /// The length of the part of an axis that runs along one of those that were found.
    fn along(axes: [Vec3; 3], axis: Vec3) -> f32 {
        axes.iter().fold(0.0, |most, found| most.max(found.dot(axis.normalize()).abs()))
    }

    fn triangle(a: Vec3, b: Vec3, c: Vec3) -> Region<f32> {
        Region::triangle([a, b, c], (b - a).cross(c - b))
    }

    #[test]
    fn axes_run_as_shapes_do() {
        let (long, wide) = (vec3(1.0, 2.0, 3.0), vec3(-2.0, 1.0, 0.0));
        let across = long.cross(wide);
        for at in [Vec3::ZERO, vec3(900.0, -800.0, 700.0)] {
            let (a, b) = (at - long - wide * 0.3, at + long - wide * 0.3);
            let (c, d) = (at + long + wide * 0.3, at - long + wide * 0.3);
            let axes = principal_axes([triangle(a, b, c), triangle(a, c, d)].into_iter());
            for axis in [long, wide, across] {
                assert!(along(axes, axis) > 0.999, "{at} {axis} {axes:?}");
            }
            assert!(axes[0].dot(axes[1]).abs() + axes[1].dot(axes[2]).abs() < 1e-6);
        }
    }

    #[test]
    fn where_no_axis_is_better_they_are_the_worlds() {
        let world = [Vec3::X, Vec3::Y, Vec3::Z];
        let none: [Region<f32>; 0] = [];
        assert_eq!(principal_axes(none.into_iter()), world);
        let balls = [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z];
        let balls = balls.map(|center| Region::<f32>::Ball { center, radius: 0.1 });
        let axes = principal_axes(balls.into_iter());
        assert!(world.into_iter().all(|axis| along(axes, axis) == 1.0), "{axes:?}");
        // What cannot be computed with in doubles.
        let huge = [glam::DVec3::X, glam::DVec3::Y, glam::DVec3::Z].map(|corner| corner * 1e200);
        let far = Region::<f64>::triangle(huge, glam::DVec3::ONE);
        let world = [glam::DVec3::X, glam::DVec3::Y, glam::DVec3::Z];
        assert_eq!(principal_axes([far].into_iter()), world);
    }
}
