//! Rays through 512 spheres, in a grid.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::clouds::SpheresGrid);
