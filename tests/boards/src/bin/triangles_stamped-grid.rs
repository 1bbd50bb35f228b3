//! Rays through 512 triangles, in a grid with a mailbox.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::clouds::TrianglesStampedGrid);
