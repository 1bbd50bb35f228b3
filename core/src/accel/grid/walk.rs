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
    /// The number of the next wall.
    wall: i32,
    /// How many cells there are behind it.
    left: i32,
    /// What a step adds to the number of the cell.
    stride: isize,
    /// Parameter of the next wall.
    next: R,
}

impl<R: Real> Along<R> {
    fn new(track: Track<R>, cell: i32, count: i32, stride: isize) -> Self {
        let wall = track.wall_behind(cell);
        let left = match track.sign {
            0 => 0,
            1 => count - 1 - cell,
            _ => cell,
        };
        let stride = stride * track.sign as isize;
        Self { track, wall, left, stride, next: track.crossing(wall) }
    }

    /// Moves on by so many cells and says how far that is in the order of cells; `None` when that
    /// leaves the grid.
    #[inline(always)]
    fn leap(&mut self, cells: i32) -> Option<isize> {
        self.left -= cells;
        if self.left < 0 {
            return None;
        }
        self.wall += self.track.sign * cells;
        self.next = self.track.crossing(self.wall);
        Some(self.stride * cells as isize)
    }

    /// The parameter at which the ray has moved on by so many cells, or leaves the grid.
    fn after(&self, cells: i32) -> R {
        self.track.crossing(self.wall + self.track.sign * (cells - 1).min(self.left))
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
        let mut steps = ((self.track.wall_behind(near) - self.wall) * self.track.sign).max(0);
        for _ in 0..=self.left {
            let wall = self.wall + self.track.sign * steps;
            if steps > 0 && !passed(self.track.crossing(wall - self.track.sign)) {
                steps -= 1;
            } else if passed(self.track.crossing(wall)) {
                steps += 1;
            } else {
                break;
            }
        }
        self.left -= steps;
        self.wall += self.track.sign * steps;
        self.next = self.track.crossing(self.wall);
        self.stride * steps as isize
    }
}

impl<R: Real, I: Id, O: Id> Accel<R> for Grid<'_, R, I, O> {
    fn walk<V: Visitor<R>>(&self, ray: &Ray<R>, visitor: &mut V) {
        self.aside.visit(visitor);
        let tracks = self.lattice.tracks(ray, &Slopes::of(ray));
        let start = self.lattice.enter(ray, &tracks, visitor.start(), visitor.limit());
        let Some(enter) = start else { return };
        let ([cx, cy, cz], count) = (self.lattice.cell_of(ray.at(enter)), self.lattice.count());
        let ([nx, ny, nz], [tx, ty, tz]) = (count, tracks);
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
            let limit = visitor.limit();
            // Of walls at the same parameter that along x comes first, then that along y.
            let stride = if reach == 1 {
                // Three branches, so that nothing has to be looked up by axis.
                if x.next <= y.next && x.next <= z.next {
                    if limit <= x.next { None } else { x.leap(1) }
                } else if y.next <= z.next {
                    if limit <= y.next { None } else { y.leap(1) }
                } else if limit <= z.next {
                    None
                } else {
                    z.leap(1)
                }
            } else {
                let (ax, ay, az) = (x.after(reach), y.after(reach), z.after(reach));
                let t = ax.min(ay).min(az);
                if limit <= t {
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
