//! The lamps: glass and mirrors, in a grid.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::Lamps);
