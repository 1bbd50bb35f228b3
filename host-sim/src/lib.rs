//! The desktop simulator of kibiray.

pub mod description;
