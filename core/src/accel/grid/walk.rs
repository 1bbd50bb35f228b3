//! The way of a ray through a grid.

use super::distance::{Slot, slot};
use super::{Grid, index};
use crate::accel::lattice::Track;
use crate::accel::{Accel, Id, Visitor, listing};
use crate::geom::{Ray, Slopes};
use crate::num::Real;
use crate::probe::Probe;

/// The walk along one axis.
struct Along<R: Real> {
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
        self.leap(1)
    }

    /// Moves on by so many cells and says how far that is in the order of cells; `None` when that
    /// leaves the grid.
    fn leap(&mut self, cells: i32) -> Option<isize> {
        self.cell += self.track.sign * cells;
        self.next = self.track.exit(self.cell, 1);
        let inside = self.track.sign != 0 && self.cell >= 0 && self.cell < self.count;
        inside.then_some(self.stride * cells as isize)
    }

    /// The parameter at which the ray has moved on by so many cells, or leaves the grid.
    fn after(&self, cells: i32) -> R {
        let last = self.cell + self.track.sign * (cells - 1);
        self.track.exit(last.max(0).min(self.count - 1), 1)
    }

    /// Moves on to where single steps would be, once all walls before `t` have been passed, and
    /// those at `t` if this axis comes first; says how far that is in the order of cells. `near` is
    /// about the right cell.
    fn follow(&mut self, t: R, first: bool, near: i32) -> isize {
        if self.track.sign == 0 {
            return 0;
        }
        let passed = |wall: R| wall < t || (first && wall == t);
        // As a number of steps from here; steps never go back.
        let mut steps = ((near - self.cell) * self.track.sign).max(0);
        for _ in 0..self.count {
            let cell = self.cell + self.track.sign * steps;
            if steps > 0 && !passed(self.track.exit(cell - self.track.sign, 1)) {
                steps -= 1;
            } else if passed(self.track.exit(cell, 1)) {
                steps += 1;
            } else {
                break;
            }
        }
        self.cell += self.track.sign * steps;
        self.next = self.track.exit(self.cell, 1);
        self.stride * steps as isize
    }
}

impl<R: Real, I: Id, O: Id> Accel<R> for Grid<'_, R, I, O> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        self.aside.visit(visitor);
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
        // Every step is at least one cell further along one axis, and none ever turns back.
        for _ in 0..nx + ny + nz {
            let found = slot(self.slots, cell);
            visitor.probe().step();
            visitor.probe().leaf(matches!(found, Slot::Empty(_)));
            let reach = match found {
                Slot::List(from, to) => {
                    listing::visit(self.references.get(from..to).unwrap_or_default(), visitor);
                    1
                }
                Slot::Empty(distance) => distance as i32,
            };
            // Of walls at the same parameter that along x comes first, then that along y.
            let stride = if reach == 1 {
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
                nearest.step()
            } else {
                let (ax, ay, az) = (x.after(reach), y.after(reach), z.after(reach));
                let t = ax.min(ay).min(az);
                if visitor.limit() <= t {
                    return;
                }
                let [px, py, pz] = self.lattice.cell_of(ray.at(t));
                if ax <= ay && ax <= az {
                    x.leap(reach).map(|s| s + y.follow(t, false, py) + z.follow(t, false, pz))
                } else if ay <= az {
                    y.leap(reach).map(|s| s + x.follow(t, true, px) + z.follow(t, false, pz))
                } else {
                    z.leap(reach).map(|s| s + x.follow(t, true, px) + y.follow(t, true, py))
                }
            };
            let Some(stride) = stride else { return };
            cell = cell.wrapping_add_signed(stride);
        }
    }
}
