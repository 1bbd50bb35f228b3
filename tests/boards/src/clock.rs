//! Counting instructions.
//!
//! The emulator runs with `-icount shift=0`: an instruction takes one nanosecond of its clock, so a
//! timer counts instructions, the same number in every run. On Arm that is `SysTick`; a tick is 6 to
//! 80 instructions, depending on the machine. On RISC-V the number of instructions retired is read.
//! Instructions are not cycles: no wait states, caches, or divisions that take longer.

use crate::machine::HERTZ;

/// Instructions in a second of the emulated clock.
const PER_SECOND: u64 = 1_000_000_000;

/// Starts the clock. Of no effect but the first time.
pub fn start() {
    imp::start();
}

/// Adds up what pieces of work take.
#[derive(Clone, Copy, Debug, Default)]
pub struct Stopwatch {
    ticks: u64,
}

impl Stopwatch {
    /// Does a piece of work. Reading the clock counts as part of it, with about 20 instructions;
    /// what a tick rounds off evens out over many pieces.
    #[inline(always)]
    pub fn time<T>(&mut self, work: impl FnOnce() -> T) -> T {
        let before = imp::ticks();
        let result = work();
        self.ticks += imp::ticks() - before;
        result
    }

    /// Instructions that all of it took.
    pub fn instructions(&self) -> u64 {
        // Whole seconds first, so that no product gets too great.
        self.ticks / HERTZ * PER_SECOND + self.ticks % HERTZ * PER_SECOND / HERTZ
    }
}

#[cfg(target_arch = "arm")]
mod imp {
    use core::sync::atomic::{AtomicU32, Ordering};
    use cortex_m::Peripherals;
    use cortex_m::peripheral::SYST;
    use cortex_m::peripheral::syst::SystClkSource;
    use cortex_m_rt::exception;

    /// The counter has 24 bits; this is how often it has gone round.
    static ROUNDS: AtomicU32 = AtomicU32::new(0);
    const LAST: u32 = 0x00ff_ffff;

    pub(super) fn start() {
        if let Some(Peripherals { SYST: mut timer, .. }) = Peripherals::take() {
            timer.set_clock_source(SystClkSource::Core);
            timer.set_reload(LAST);
            timer.clear_current();
            timer.enable_interrupt();
            timer.enable_counter();
        }
    }

    // The handler is found by its name.
    #[exception]
    fn SysTick() {
        // There is no other writer, and the smallest core has no read-modify-write.
        ROUNDS.store(ROUNDS.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
    }

    pub(super) fn ticks() -> u64 {
        loop {
            let rounds = ROUNDS.load(Ordering::Acquire);
            // Counts down.
            let ticks = LAST - (SYST::get_current() & LAST);
            if rounds == ROUNDS.load(Ordering::Acquire) {
                return u64::from(rounds) << 24 | u64::from(ticks);
            }
        }
    }
}

#[cfg(target_arch = "riscv32")]
mod imp {
    use riscv::register::{minstret, minstreth};

    pub(super) fn start() {}

    pub(super) fn ticks() -> u64 {
        loop {
            let high = minstreth::read();
            let low = minstret::read();
            if high == minstreth::read() {
                return (high as u64) << 32 | low as u64;
            }
        }
    }
}
