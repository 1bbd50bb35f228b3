//! The card: four balls over a checkered floor.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::Card);
