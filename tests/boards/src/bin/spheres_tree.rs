//! Rays through 512 spheres, in a tree of boxes into which they are inserted one by one.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::clouds::SpheresTree);
