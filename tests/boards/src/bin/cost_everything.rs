//! Every shape, every structure, every mailbox, all of the light.
#![no_std]
#![no_main]

use kibiray_boards::cost;

#[kibiray_boards::rt::entry]
fn main() -> ! {
    cost::exit(cost::everything())
}
