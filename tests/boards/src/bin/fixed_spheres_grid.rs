//! Rays through 512 spheres in fixed point, in a grid.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::fixed::FixedSpheresGrid);
