//! A picture of spheres in an octree, with shadows.
#![no_std]
#![no_main]

use kibiray_boards::cost::{self, SPHERES};
use kibiray_scenes::structure::Octree;

#[kibiray_boards::rt::entry]
fn main() -> ! {
    cost::exit(cost::shadows::<_, Octree<1, 4>>(&SPHERES[..]))
}
