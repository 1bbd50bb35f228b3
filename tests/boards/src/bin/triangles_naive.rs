//! Rays through 512 triangles, every one tested.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::clouds::TrianglesNaive);
