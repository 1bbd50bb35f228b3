//! The desktop simulator of kibiray.
//!
//! Runs the core as a device would: the scene in borrowed tables, everything else in one arena of
//! as many bytes as the user says; and tells what that took. In the order in which data flows:
//! [`description`] reads or generates a scene, [`tables`] sorts it for the core, [`engine`] builds
//! and shares work among threads, [`commands`] trace, [`report`] says what came of it.

pub mod commands;
pub mod costs;
pub mod description;
pub mod efficiency;
pub mod engine;
pub mod frame;
pub mod image;
pub mod options;
pub mod parts;
pub mod picture;
pub mod plot;
pub mod rays;
pub mod report;
pub mod structure;
pub mod tables;
pub mod terminal;
pub mod values;
pub mod view;
pub mod wasm;
