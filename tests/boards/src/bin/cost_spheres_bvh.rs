//! Queries about spheres in a hierarchy of boxes.
#![no_std]
#![no_main]

use kibiray_boards::cost::{self, SPHERES};
use kibiray_scenes::structure::Bvh;

#[kibiray_boards::rt::entry]
fn main() -> ! {
    cost::exit(cost::query::<_, Bvh<4>>(&SPHERES[..]))
}
