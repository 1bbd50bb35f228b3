//! The uniform grid, walked by a 3D DDA.
//!
//! A. Fujimoto, T. Tanaka, K. Iwata, "ARTS: accelerated ray-tracing system", IEEE CG&A 6(4) (1986);
//! J. Amanatides, A. Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987.
//! Lists as one array of references and one of offsets, built by counting: A. Lagae, P. Dutré,
//! "Compact, fast and robust grids for ray tracing", EGSR 2008.
//!
//! Instead of adding a cell's width to the parameter of the next wall, the parameter is computed
//! from the wall's number: one multiplication more, and wrong cells become 15 to 50 times rarer.

use super::lattice::{self, Lattice, Track};
use super::{Accel, BuildError, Id, Visitor};
use crate::geom::{Ray, Slopes};
use crate::memory::{Arena, Footprint};
use crate::num::{Real, Vector};
use crate::probe::Probe;
use crate::scene::{Scene, Shapes};

/// A grid. `I` stores ids of shapes, `O` offsets into the lists.
#[derive(Debug)]
pub struct Grid<'m, R: Real, I, O> {
    lattice: Lattice<R>,
    /// Where the list of each cell begins, and where the last one ends.
    offsets: &'m [O],
    references: &'m [I],
}

/// How large a grid of a resolution is: made by counting, before building.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Size {
    /// Cells, or the greatest number there is if they do not fit the address space.
    pub cells: usize,
    /// Entries of all lists.
    pub references: usize,
}

impl Size {
    /// Bytes of a grid of this size; building needs no more.
    pub fn footprint<I: Id, O: Id>(&self) -> Footprint {
        let offsets = Footprint::of::<O>(self.cells.saturating_add(1));
        offsets.then(Footprint::of::<I>(self.references))
    }
}

/// The extra at the lower end is a little greater than at the upper: an even number of cells would
/// otherwise put a wall into the middle of the scene, where symmetric scenes like to have faces,
/// and each of these would be listed on both sides.
fn lattice_of<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, resolution: [u32; 3]) -> Lattice<R> {
    Lattice::new(lattice::root(scene, 33, 31), resolution, scene.pad())
}

/// Counts the cells and list entries that a resolution gives. Time in proportion to the number of
/// shapes; no memory.
pub fn size<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, resolution: [u32; 3]) -> Size {
    let lattice = lattice_of(scene, resolution);
    let product = |n: [i32; 3]| n.iter().fold(1_usize, |p, n| p.saturating_mul(*n as usize));
    let references = (0..scene.shapes().bounded()).fold(0_usize, |sum, id| {
        let ([x0, y0, z0], [x1, y1, z1]) = lattice.cells_of(scene.shapes().bounds(id));
        sum.saturating_add(product([x1 - x0 + 1, y1 - y0 + 1, z1 - z0 + 1]))
    });
    Size { cells: product(lattice.count()), references }
}

/// The resolution with nearly cubic cells that has at most `cells` of them.
///
/// A. Woo's rule: the longest axis gets L cells, the others in proportion, at least one.
pub fn resolution_for<R: Real, S: Shapes<R>>(scene: &Scene<'_, R, S>, cells: usize) -> [u32; 3] {
    let size = lattice::root(scene, 33, 31).size();
    let longest = size.max_abs();
    let counts = |l: i32| {
        let per_axis = |s: R| (s / longest * R::from_i32(l)).to_i32().max(1) as u32;
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

impl<'m, R: Real, I: Id, O: Id> Grid<'m, R, I, O> {
    /// Builds a grid over the bounded shapes of a scene. Lists are in ascending order of ids.
    ///
    /// # Errors
    /// [`BuildError::Memory`] with the exact number of bytes; [`BuildError::TooMany`] when ids or
    /// offsets do not fit their types.
    pub fn build<S: Shapes<R>>(
        scene: &Scene<'_, R, S>,
        resolution: [u32; 3],
        arena: &mut Arena<'m>,
    ) -> Result<Self, BuildError> {
        let shapes = scene.shapes().bounded();
        BuildError::unless_fits::<I>("shapes", shapes.saturating_sub(1))?;
        let size = size(scene, resolution);
        BuildError::unless_fits::<O>("references", size.references)?;
        arena.require(size.footprint::<I, O>())?;
        let lattice = lattice_of(scene, resolution);
        let offsets: &mut [O] = arena.keep("grid offsets", size.cells.saturating_add(1))?;
        let references: &mut [I] = arena.keep("grid references", size.references)?;
        offsets.fill(O::new(0));
        for id in 0..shapes {
            for_cells(&lattice, scene, id, |cell| {
                if let Some(count) = offsets.get_mut(cell) {
                    *count = O::new(count.get() + 1);
                }
            });
        }
        let mut end = 0;
        for offset in offsets.iter_mut() {
            end += offset.get();
            *offset = O::new(end);
        }
        // Every offset is now the end of its list and moves to its beginning while the list is
        // filled from behind.
        for id in (0..shapes).rev() {
            for_cells(&lattice, scene, id, |cell| {
                if let Some(offset) = offsets.get_mut(cell) {
                    let place = offset.get().saturating_sub(1);
                    *offset = O::new(place);
                    if let Some(reference) = references.get_mut(place) {
                        *reference = I::new(id);
                    }
                }
            });
        }
        Ok(Self { lattice, offsets, references })
    }

    /// Cells along each axis.
    pub fn resolution(&self) -> [u32; 3] {
        self.lattice.count().map(|n| n as u32)
    }

    /// The lists of all cells, x running fastest.
    pub fn lists(&self) -> impl Iterator<Item = &'m [I]> {
        (0..self.offsets.len().saturating_sub(1)).map(|cell| self.list(cell))
    }

    fn list(&self, cell: usize) -> &'m [I] {
        match (self.offsets.get(cell), self.offsets.get(cell + 1)) {
            (Some(from), Some(to)) => self.references.get(from.get()..to.get()).unwrap_or_default(),
            _ => &[],
        }
    }
}

/// The number of a cell.
fn index([nx, ny, _]: [i32; 3], x: i32, y: i32, z: i32) -> usize {
    (z as usize * ny as usize + y as usize) * nx as usize + x as usize
}

/// Calls `f` with the number of every cell that a shape touches.
fn for_cells<R: Real, S: Shapes<R>>(
    lattice: &Lattice<R>,
    scene: &Scene<'_, R, S>,
    id: usize,
    mut f: impl FnMut(usize),
) {
    let ([x0, y0, z0], [x1, y1, z1]) = lattice.cells_of(scene.shapes().bounds(id));
    for z in z0..=z1 {
        for y in y0..=y1 {
            for x in x0..=x1 {
                f(index(lattice.count(), x, y, z));
            }
        }
    }
}

/// The walk along one axis.
struct Along<R> {
    track: Track<R>,
    cell: i32,
    count: i32,
    /// What a step adds to the number of the cell.
    stride: isize,
    /// Parameter of the next wall.
    next: R,
}

impl<R: Real> Along<R> {
    fn new(track: Track<R>, cell: i32, count: i32, stride: isize) -> Self {
        let stride = stride * track.sign as isize;
        Self { track, cell, count, stride, next: track.exit(cell, 1) }
    }

    /// Moves on by a cell; `None` when that leaves the grid.
    fn step(&mut self) -> Option<isize> {
        self.cell += self.track.sign;
        self.next = self.track.exit(self.cell, 1);
        (self.track.sign != 0 && self.cell >= 0 && self.cell < self.count).then_some(self.stride)
    }
}

impl<R: Real, I: Id, O: Id> Accel<R> for Grid<'_, R, I, O> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let slopes = Slopes::of(ray);
        let Some((enter, _)) = self.lattice.clip(&slopes, visitor.start(), visitor.limit()) else {
            return;
        };
        let [tx, ty, tz] = self.lattice.tracks(ray, &slopes);
        let ([cx, cy, cz], count) = (self.lattice.cell_of(ray.at(enter)), self.lattice.count());
        let [nx, ny, nz] = count;
        let mut cell = index(count, cx, cy, cz);
        let mut x = Along::new(tx, cx, nx, 1);
        let mut y = Along::new(ty, cy, ny, nx as isize);
        let mut z = Along::new(tz, cz, nz, nx as isize * ny as isize);
        // Every step is one cell further along one axis, and none ever turns back.
        for _ in 0..nx + ny + nz {
            let list = self.list(cell);
            visitor.probe().step();
            visitor.probe().leaf(list.is_empty());
            if !list.is_empty() {
                visitor.visit(list.iter().map(|id| id.get()));
            }
            let nearest = if x.next <= y.next && x.next <= z.next {
                &mut x
            } else if y.next <= z.next {
                &mut y
            } else {
                &mut z
            };
            if visitor.limit() <= nearest.next {
                return;
            }
            let Some(stride) = nearest.step() else { return };
            cell = cell.wrapping_add_signed(stride);
        }
    }
}
