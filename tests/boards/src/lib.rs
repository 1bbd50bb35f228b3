//! What all firmware here shares: the machine it runs on, a console, an instruction counter, the
//! depth of the stack, and the run of a subject with its report.
//!
//! A program is a file in `src/bin` that names a subject from `kibiray_scenes`:
//! ```ignore
//! #![no_std]
//! #![no_main]
//! kibiray_boards::firmware!(kibiray_scenes::Marbles);
//! ```
//! It prints one line of JSON by semihosting and leaves with status 0, or a line with the key
//! `error` and status 1. Nothing formats: what `core::fmt` there is in the linked program, the core
//! of kibiray has brought in.
#![no_std]

pub mod block;
pub mod clock;
pub mod console;
pub mod cost;
pub mod machine;
pub mod report;
pub mod run;
pub mod stack;

#[cfg(target_arch = "arm")]
#[doc(hidden)]
pub use cortex_m_rt as rt;
#[doc(hidden)]
pub use kibiray_scenes::Subject;
#[cfg(target_arch = "riscv32")]
#[doc(hidden)]
pub use riscv_rt as rt;

/// The whole of a firmware program: an arena of the machine's size, room for a row of pixels, and
/// some work done in them.
#[macro_export]
macro_rules! firmware {
    (work: $work:expr, $columns:expr) => {
        static ARENA: $crate::block::Block<{ $crate::machine::ARENA }> =
            $crate::block::Block::new();
        static ROW: $crate::block::Block<{ 3 * $columns as usize }> = $crate::block::Block::new();

        #[$crate::rt::entry]
        fn main() -> ! {
            $crate::run::run(&ARENA, &ROW, $work)
        }
    };
    ($subject:ty) => {
        $crate::firmware!(
            work: $crate::run::subject::<$subject>,
            <$subject as $crate::Subject>::SIZE.0
        );
    };
}

/// Ends the program. The message is not printed: to format it would link code that the tests hold
/// the core not to need. This function is in the linked program only if something there can panic,
/// and the tests look for its name.
#[panic_handler]
fn kibiray_boards_panicked(_: &core::panic::PanicInfo<'_>) -> ! {
    report::fail("panic", 101)
}
