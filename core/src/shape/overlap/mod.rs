//! Which cells the surface of a shape passes through: more exact than its box.
//!
//! Every test here is on the safe side: it says no only where no hit can be claimed. Hits are
//! claimed in the region that the test stands for, grown by the ray's slack, as kernels that cannot
//! promise this by themselves are held to that region ([`settle_between`]). Cells come padded by
//! twice as much, so what remains allows for the rounding of both sides.

mod slabs;
mod surface;

pub(super) use slabs::{Slab, across_plane, flat, round, settle_between};
pub(super) use surface::{box_surface, sphere_surface};
