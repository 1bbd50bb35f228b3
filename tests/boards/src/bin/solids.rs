//! Every kind of shape, in a grid.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::AllSolids);
