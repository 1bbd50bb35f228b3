//! The way of a ray through a grid.

use super::distance::{Slot, between};
use super::{Grid, index, share};
use crate::accel::lattice::Way;
use crate::accel::{Accel, Id, Visitor};
use crate::geom::Ray;
use crate::num::{Axis, Progress, Real};
use crate::probe::Probe;

/// The walk along one axis.
#[derive(Clone, Copy)]
struct Along<R: Real> {
    /// Numbered in the order in which the ray meets them.
    walls: R::Progress,
    /// The number of the next wall.
    wall: <R::Progress as Progress<R>>::Count,
    /// Parameter of the next wall.
    next: R,
    /// What a step adds to the number of the cell; 0 if there is none.
    stride: isize,
}

impl<R: Real> Along<R> {
    #[inline(always)]
    fn new(Way { sign, walls, .. }: Way<R>, cell: i32, stride: isize) -> Self {
        let wall = R::Progress::count(cell * sign + sign.max(0));
        Self { walls, wall, next: walls.at_count(wall), stride: stride * sign as isize }
    }

    /// Moves on by a cell; says how far that is in the order of cells.
    #[inline(always)]
    fn step(&mut self) -> isize {
        self.wall = R::Progress::next(self.wall);
        self.next = self.walls.at_count(self.wall);
        self.stride
    }

    /// Moves on by so many cells; says how far that is in the order of cells.
    fn leap(&mut self, cells: i32) -> isize {
        self.wall = R::Progress::count(R::Progress::number(self.wall) + cells);
        self.next = self.walls.at_count(self.wall);
        self.stride * cells as isize
    }

    /// How many cells there are behind the next wall, of so many in a row.
    fn left(&self, count: i32) -> i32 {
        let wall = R::Progress::number(self.wall);
        match self.stride {
            0 => 0,
            1.. => count - wall,
            _ => -wall,
        }
    }

    /// The parameter at which the ray has moved on by so many cells, or leaves the grid.
    fn after(&self, cells: i32, count: i32) -> R {
        self.walls.at(R::Progress::number(self.wall) + (cells - 1).min(self.left(count)))
    }

    /// Moves on to where single steps would be, once all walls before `t` have been passed, and
    /// those at `t` if this axis comes first; says how far that is in the order of cells. `near` is
    /// about the right cell.
    fn follow(&mut self, t: R, first: bool, near: i32, count: i32) -> isize {
        if self.stride == 0 {
            return 0;
        }
        let from = R::Progress::number(self.wall);
        let near = if self.stride > 0 { near + 1 } else { -near };
        let passed = |wall: R| wall < t || (first && wall == t);
        // As a number of steps from here; steps never go back.
        let mut steps = (near - from).max(0);
        for _ in 0..=self.left(count) {
            if steps > 0 && !passed(self.walls.at(from + steps - 1)) {
                steps -= 1;
            } else if passed(self.walls.at(from + steps)) {
                steps += 1;
            } else {
                break;
            }
        }
        self.leap(steps)
    }
}

impl<R: Real, I: Id, O: Id, const SHARED: bool> Accel<R> for Grid<'_, R, I, O, SHARED> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        let [x, y, z] = Axis::ALL.map(|axis| self.lattice.way(ray, axis));
        let enter = visitor.start().max(x.enter).max(y.enter).max(z.enter);
        let mut limit = visitor.limit().min(x.leave).min(y.leave).min(z.leave);
        let (count @ [nx, ny, nz], [cx, cy, cz]) =
            (self.lattice.count(), self.lattice.cell_of(ray.at(enter)));
        // The first step leads to where the ray enters: over a wall behind it, from the cell before.
        let mut cell = index(count, cx, cy, cz).wrapping_add_signed(-x.sign as isize);
        let mut x = Along { next: -R::INFINITY, ..Along::new(x, cx - x.sign, 1) };
        let mut y = Along::new(y, cy, nx as isize);
        let mut z = Along::new(z, cz, nx as isize * ny as isize);
        let (_, ends) = self.slots.split_first().unwrap_or((&O::new(0), &[]));
        // Every step is at least one cell further along one axis, and none ever turns back.
        let mut steps = if limit < enter { 0 } else { nx + ny + nz + 1 };
        // The shapes kept aside come as the list of a cell before the first one: so there is one
        // place where shapes are tested, and that can be part of the loop.
        let mut list = self.aside.ids();
        loop {
            visitor.visit(list.iter().map(|id| id.get()));
            limit = limit.min(visitor.limit());
            // On to the next cell that lists something.
            list = loop {
                steps -= 1;
                if steps < 0 {
                    return;
                }
                // The ray leaves the grid where it comes to the limit. Of walls at the same
                // parameter that along x comes first, then that along y. Three branches, so that
                // nothing has to be looked up by axis.
                let stride = if x.next <= y.next && x.next <= z.next {
                    if limit <= x.next {
                        return;
                    }
                    x.step()
                } else if y.next <= z.next {
                    if limit <= y.next {
                        return;
                    }
                    y.step()
                } else {
                    if limit <= z.next {
                        return;
                    }
                    z.step()
                };
                cell = cell.wrapping_add_signed(stride);
                let mut found = self.look(ends, cell, visitor);
                while let Slot::Empty(reach @ 2..) = found {
                    steps -= 1;
                    // Copies: the others stay in registers, as no pointer leads to them.
                    let (copy, mut ways) = (*ray, [x, y, z]);
                    let Some(stride) = self.leap(&copy, &mut ways, reach as i32, limit) else {
                        return;
                    };
                    if steps < 0 {
                        return;
                    }
                    [x, y, z] = ways;
                    cell = cell.wrapping_add_signed(stride);
                    found = self.look(ends, cell, visitor);
                }
                if let Slot::List(from, to) = found
                    && let Some(list) = self.references.get(from..to)
                    // A shared list goes by its place.
                    && (!SHARED || visitor.admit_list(from))
                {
                    break list;
                }
            };
        }
    }
}

impl<R: Real, I: Id, O: Id, const SHARED: bool> Grid<'_, R, I, O, SHARED> {
    /// What is known of a cell that a ray comes to.
    #[inline(always)]
    fn look(&self, ends: &[O], cell: usize, visitor: &mut impl Visitor<R>) -> Slot {
        let found = if SHARED {
            share::slot(self.slots, self.references, cell)
        } else {
            between(self.slots, ends, cell)
        };
        visitor.probe().step();
        visitor.probe().leaf(matches!(found, Slot::Empty(_)));
        found
    }

    /// Over cells known to be empty. Apart, for the registers it takes.
    #[cfg_attr(target_pointer_width = "32", cold, inline(never))]
    #[cfg_attr(not(target_pointer_width = "32"), inline(always))]
    fn leap(
        &self,
        ray: &Ray<R>,
        [x, y, z]: &mut [Along<R>; 3],
        reach: i32,
        limit: R,
    ) -> Option<isize> {
        let [nx, ny, nz] = self.lattice.count();
        let (ax, ay, az) = (x.after(reach, nx), y.after(reach, ny), z.after(reach, nz));
        let t = ax.min(ay).min(az);
        if limit <= t {
            return None;
        }
        let [px, py, pz] = self.lattice.cell_of(ray.at(t));
        Some(if ax <= ay && ax <= az {
            x.leap(reach) + y.follow(t, false, py, ny) + z.follow(t, false, pz, nz)
        } else if ay <= az {
            y.leap(reach) + x.follow(t, true, px, nx) + z.follow(t, false, pz, nz)
        } else {
            z.leap(reach) + x.follow(t, true, px, nx) + y.follow(t, true, py, ny)
        })
    }
}
