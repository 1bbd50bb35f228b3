//! Rays through 512 triangles in fixed point, in an octree.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::fixed::FixedTrianglesOctree);
