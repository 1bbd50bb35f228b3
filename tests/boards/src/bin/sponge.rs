//! The sponge: 400 boxes, in an octree.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::Sponge);
