//! Rays through a knot of 1,024 triangles, in a grid with stamps.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::knot_rays::Knot1024Grid);
