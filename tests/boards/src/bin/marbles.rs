//! The marbles: a scene of 200 spheres and 2 triangles.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::Marbles);
