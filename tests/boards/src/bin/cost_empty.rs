//! Nothing: what the other programs share.
#![no_std]
#![no_main]

use kibiray_boards::cost;

#[kibiray_boards::rt::entry]
fn main() -> ! {
    cost::exit(Some(()))
}
