//! Rays through 512 spheres, in an octree.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::clouds::SpheresOctree);
