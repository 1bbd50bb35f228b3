//! Ray tracing in kibibytes: ray queries and images inside one fixed block of RAM.
//!
//! No allocator, no panic, no recursion: every byte that grows with a scene comes out of an
//! [`Arena`](memory::Arena) that the caller hands over, and how many bytes that will be can be
//! asked beforehand.
//!
//! # The way of the data
//! | module | what it is |
//! |---|---|
//! | [`num`] | number types: everything else computes in a type parameter, `f32` on devices |
//! | [`geom`] | rays, intervals of their parameter, boxes |
//! | [`memory`] | the arena, scratch that comes back, footprints |
//! | [`shape`] | elementary solids, one a file |
//! | [`bound`] | bodies around shapes, which a ray is tested against first |
//! | [`scene`] | borrowed tables of shapes, surfaces, lights; the camera |
//! | [`accel`] | structures: which shapes a ray has to be tested against; mailboxes |
//! | [`plan`] | scene + budget → structure and parameters, with the reason |
//! | [`trace`] | shading, shadows, mirrors, glass; pictures row by row |
//! | [`display`] | colours to pixels of any embedded-graphics display |
//! | [`probe`] | counters that cost nothing when they are not asked for |
//!
//! # How to use it
//! 1. Lay shapes into tables, in flash if you like: a slice of one kind, a tuple of slices, or
//!    [`scene::Solids`] for all kinds. Only code for the kinds you name is generated.
//! 2. [`scene::Scene::new`] checks them once.
//! 3. Build a structure into an arena: [`accel::Octree`], [`accel::Grid`], or none at all
//!    ([`accel::Naive`]). All answer through [`accel::Accel`].
//! 4. Ask for the [nearest](accel::Accel::nearest) hit or for [any](accel::Accel::occluded), or
//!    give a [`trace::Renderer`] a display.
//!
//! # Promises
//! * **Same answer with every structure.** Structures only cull: hits are bit for bit those of
//!   testing every shape. How that is kept is told in [`accel`].
//! * **Same bits on every target.** Which operations may touch a number is told in [`num`].
//! * **Bounded work.** Every loop is bounded by a count of shapes, cells or levels, never by a
//!   ray's parameter. Rays that are not rays cannot be made ([`geom::Ray::new`]).
//! * **Nothing is refused silently.** What can fail returns an error with the numbers needed to act.
#![no_std]
#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::unwrap_used,
        clippy::expect_used,
        clippy::panic,
        clippy::unreachable
    )
)]

pub mod accel;
pub mod bound;
pub mod display;
pub mod geom;
pub mod memory;
pub mod num;
pub mod plan;
pub mod probe;
pub mod scene;
pub mod shape;
pub mod trace;

/// The examples of the README are compiled and run.
#[cfg(doctest)]
#[doc = include_str!("../../README.md")]
struct Readme;
