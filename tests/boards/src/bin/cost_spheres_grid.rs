//! Queries about spheres in a grid.
#![no_std]
#![no_main]

use kibiray_boards::cost::{self, SPHERES};
use kibiray_scenes::structure::Grid;

#[kibiray_boards::rt::entry]
fn main() -> ! {
    cost::exit(cost::query::<_, Grid<4, 4, 4>>(&SPHERES[..]))
}
