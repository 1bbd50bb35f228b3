//! The knot: 1,024 triangles with normals, in an octree.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::Knot);
