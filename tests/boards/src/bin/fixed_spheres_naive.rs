//! Rays through 512 spheres in fixed point, every one tested.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::fixed::FixedSpheresNaive);
