//! Rays through 512 spheres in fixed point, in a hierarchy.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::fixed::FixedSpheresBvh);
