//! Rays through 512 triangles, in a hierarchy of boxes.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::clouds::TrianglesBvh);
