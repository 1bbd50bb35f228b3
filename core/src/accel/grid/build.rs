//! Building a grid by counting, in the memory that it keeps.

use super::{Grid, Settings, Size, distance, index};
use crate::accel::lattice::{self, Lattice};
use crate::accel::listing::Aside;
use crate::accel::{BuildError, Huge, Id, Listing, Overlap};
use crate::geom::Aabb;
use crate::memory::Arena;
use crate::num::{Real, Vector};
use crate::scene::{Scene, Shapes};

/// The box that a grid divides, and what is left out of it.
///
/// The extra at the lower end is a little greater than at the upper: an even number of cells would
/// otherwise put a wall into the middle of the scene, where symmetric scenes like to have faces,
/// and each of these would be listed on both sides.
pub(super) fn room<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, huge: Huge) -> (Aabb<R>, Aside) {
    let (aside, bounds) = Aside::of(scene, huge);
    (lattice::root(bounds, scene.pad(), 33, 31), aside)
}

/// The shapes that a grid lists.
pub(super) fn listed<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    aside: &Aside,
) -> impl DoubleEndedIterator<Item = usize> {
    (0..scene.shapes().bounded()).filter(|id| !aside.contains(*id))
}

/// Counts the cells and list entries that a resolution gives. Time in proportion to the number of
/// shapes, or with [`Overlap::Exact`] to that of the cells that their boxes touch; no memory.
pub fn size<R: Real, S: Shapes<R>, L: Listing>(
    scene: &Scene<'_, R, S>,
    settings: impl Into<Settings<L>>,
) -> Size {
    let Settings { resolution, huge, overlap, shared, .. } = settings.into();
    let (root, aside) = room(scene, huge);
    let size = size_of_room(scene, &Lattice::new(root, resolution, scene.pad()), &aside, overlap);
    if shared { size.shared() } else { size }
}

pub(super) fn size_of_room<R: Real, S: Shapes<R>, L: Listing>(
    scene: &Scene<'_, R, S>,
    lattice: &Lattice<R>,
    aside: &Aside,
    overlap: L,
) -> Size {
    let product = |n: [i32; 3]| n.iter().fold(1_usize, |p, n| p.saturating_mul(*n as usize));
    let references = listed(scene, aside).fold(0_usize, |sum, id| {
        let ([x0, y0, z0], [x1, y1, z1]) = lattice.cells_of(scene.shapes().bounds(id));
        sum.saturating_add(match overlap.overlap() {
            Overlap::Box => product([x1 - x0 + 1, y1 - y0 + 1, z1 - z0 + 1]),
            Overlap::Exact => {
                let mut cells = 0_usize;
                for_cells(lattice, scene, overlap, id, |_| cells += 1);
                cells
            }
        })
    });
    Size { cells: product(lattice.count()), references }
}

/// The resolution with nearly cubic cells that has at most `cells` of them.
///
/// A. Woo's rule: the longest axis gets L cells, the others in proportion, at least one.
pub fn resolution_for<R: Real, S: Shapes<R>>(
    scene: &Scene<'_, R, S>,
    huge: Huge,
    cells: usize,
) -> [u32; 3] {
    let size = room(scene, huge).0.size();
    let longest = size.max_abs();
    let counts = |l: i32| {
        let per_axis = |s: R| s.proportion(longest, l).max(1) as u32;
        size.to_array().map(per_axis)
    };
    let fits = |n: [u32; 3]| n.iter().fold(1_usize, |p, n| p.saturating_mul(*n as usize)) <= cells;
    // Bisection: the number of cells grows with L.
    let (mut low, mut high) = (1, lattice::MOST_CELLS);
    while low < high {
        let middle = low + (high - low + 1) / 2;
        if fits(counts(middle)) { low = middle } else { high = middle - 1 }
    }
    counts(low)
}

/// From how many cells a shape on equal cells are hard to beat for a scene, if they are. Time in
/// proportion to the number of shapes; no memory.
///
/// * One, where shapes of much the same size lie everywhere in the box of the scene: nine in ten are
///   at least a quarter as long as the longest, and each of 64 equal parts of the box is touched.
/// * Six, where thousands of shapes are large and in each other: on an average the box of one touches
///   more than two and a half of the 64 parts. Boxes in boxes tell them apart badly, and small cells,
///   that only a surface passes through, tell them well.
pub fn suits<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, huge: Huge) -> Option<usize> {
    let (root, aside) = room(scene, huge);
    let lattice = Lattice::new(root, [4; 3], scene.pad());
    let (mut longest, mut touched, mut parts) = (R::ZERO, 0_u64, 0);
    // Lengths are looked at twice, the second time against the longest.
    let mut counts = [0_usize; 2];
    for pass in [false, true] {
        for id in listed(scene, &aside) {
            let bounds = scene.shapes().bounds(id);
            let length = bounds.size().max_abs();
            let [shapes, long] = &mut counts;
            if pass {
                *long += usize::from(length.times_int(4) >= longest);
                continue;
            }
            *shapes += 1;
            longest = longest.max(length);
            // Cell x, y, z is bit x + 4 y + 16 z.
            let ([x0, y0, z0], [x1, y1, z1]) = lattice.cells_of(bounds);
            let xs = (2_u64 << x1) - (1 << x0);
            let ys = (16_u64 << (4 * y1)) - (1 << (4 * y0));
            let zs = u64::MAX >> (48 - 16 * z1) & u64::MAX << (16 * z0);
            let cells = (xs * 0x1111_1111_1111_1111) & (ys * 0x0001_0001_0001_0001) & zs;
            parts += cells.count_ones() as usize;
            touched |= cells;
        }
    }
    let [shapes, long] = counts;
    // Of fewer shapes boxes reach that far even where none is in another.
    let are_large = shapes >= 4096 && 2 * parts > 5 * shapes;
    if shapes > 0 && long >= shapes - shapes / 10 && touched == u64::MAX {
        Some(1)
    } else {
        are_large.then_some(6)
    }
}

impl<'m, R: Real, I: Id, O: Id> Grid<'m, R, I, O> {
    /// Builds a grid over the bounded shapes of a scene. Lists are in ascending order of ids.
    ///
    /// # Errors
    /// [`BuildError::Memory`] with the exact number of bytes; [`BuildError::TooMany`] when ids or
    /// offsets do not fit their types.
    pub fn build<S: Shapes<R>, L: Listing>(
        scene: &Scene<'_, R, S>,
        settings: impl Into<Settings<L>>,
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let Settings { resolution, huge, overlap, macro_cells, .. } = settings.into();
        let (root, aside) = room(scene, huge);
        let lattice = Lattice::new(root, resolution, scene.pad());
        let shapes = scene.shapes().bounded();
        BuildError::unless_fits::<I>("shapes", shapes.saturating_sub(1))?;
        let size = size_of_room(scene, &lattice, &aside, overlap);
        BuildError::unless_above("references", size.references, distance::most_offset::<O>())?;
        arena.require(size.footprint::<I, O>())?;
        let slots: &mut [O] = arena.keep("grid cells", size.cells.saturating_add(1))?;
        let references: &mut [I] = arena.keep("grid references", size.references)?;
        slots.fill(O::new(0));
        for id in listed(scene, &aside) {
            for_cells(&lattice, scene, overlap, id, |cell| {
                if let Some(count) = slots.get_mut(cell) {
                    *count = O::new(count.get() + 1);
                }
            });
        }
        let mut end = 0;
        for slot in slots.iter_mut() {
            end += slot.get();
            *slot = O::new(end);
        }
        // Every offset is now the end of its list and moves to its beginning while the list is
        // filled from behind.
        for id in listed(scene, &aside).rev() {
            for_cells(&lattice, scene, overlap, id, |cell| {
                if let Some(slot) = slots.get_mut(cell) {
                    let place = slot.get().saturating_sub(1);
                    *slot = O::new(place);
                    if let Some(reference) = references.get_mut(place) {
                        *reference = I::new(id);
                    }
                }
            });
        }
        if macro_cells {
            distance::mark::<O, false>(slots, lattice.count());
        }
        Ok(Self { lattice, slots, references, aside: aside.stored() })
    }
}

/// Calls `f` with the number of every cell that lists a shape.
pub(super) fn for_cells<R: Real, S: Shapes<R>, L: Listing>(
    lattice: &Lattice<R>,
    scene: &Scene<'_, R, S>,
    overlap: L,
    id: usize,
    mut f: impl FnMut(usize),
) {
    let ([x0, y0, z0], [x1, y1, z1]) = lattice.cells_of(scene.shapes().bounds(id));
    for z in z0..=z1 {
        for y in y0..=y1 {
            for x in x0..=x1 {
                let cell = || lattice.room([x, y, z], [1; 3]);
                if overlap.overlap() == Overlap::Box || scene.shapes().overlaps(id, &cell()) {
                    f(index(lattice.count(), x, y, z));
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::Sphere;
    use glam::vec3;

    #[test]
    fn a_grid_suits_shapes_of_one_size_everywhere() {
        let mut balls: [Sphere<f32>; 216] = core::array::from_fn(|i| {
            Sphere::new(vec3((i % 6) as f32, (i / 6 % 6) as f32, (i / 36) as f32), 0.3)
        });
        let suited = |balls: &[Sphere<f32>]| suits(&Scene::new(balls).unwrap(), Huge::Aside);
        assert_eq!(suited(&balls), Some(1));
        assert_eq!(suited(&[]), None);
        // A corner is empty.
        let cut = balls.map(|ball| if ball.center.element_sum() > 9.0 { balls[0] } else { ball });
        assert_eq!(suited(&cut), None);
        // One in five is much larger.
        for ball in balls.iter_mut().step_by(5) {
            *ball = Sphere::new(vec3(2.5, 2.5, 2.5), 2.0);
        }
        assert_eq!(suited(&balls), None);
        // Thousands around a few places.
        let shells: [Sphere<f32>; 5000] = core::array::from_fn(|i| {
            let (place, size) = (vec3((i % 7) as f32, (i % 3) as f32, 0.0), i as f32 / 5000.0);
            Sphere::new(place, 0.1 + 4.0 * size * size)
        });
        assert_eq!(suited(&shells), Some(6));
    }
}
