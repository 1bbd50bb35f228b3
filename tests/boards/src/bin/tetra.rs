//! The tetrahedra: 256 triangles, in a grid.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::Tetra);
