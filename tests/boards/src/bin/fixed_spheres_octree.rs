//! Rays through 512 spheres in fixed point, in an octree.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::fixed::FixedSpheresOctree);
