//! The card in fixed point.
#![no_std]
#![no_main]

kibiray_boards::firmware!(kibiray_scenes::fixed::FixedCard);
