//! The card by a plain program, without the library's tracing.
#![no_std]
#![no_main]

kibiray_boards::firmware!(work: kibiray_boards::run::plain, kibiray_scenes::Plain::SIZE.0);
