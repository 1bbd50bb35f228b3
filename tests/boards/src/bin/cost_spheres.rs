//! Queries about spheres, every one tested.
#![no_std]
#![no_main]

use kibiray_boards::cost::{self, SPHERES};
use kibiray_scenes::structure::Naive;

#[kibiray_boards::rt::entry]
fn main() -> ! {
    cost::exit(cost::query::<_, Naive>(&SPHERES[..]))
}
