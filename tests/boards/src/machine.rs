//! The machines: what the emulator does not tell.

/// Its name in QEMU.
pub const NAME: &str = env!("MACHINE");

/// The target that the program was built for.
pub const TARGET: &str = if cfg!(target_arch = "riscv32") {
    "riscv32imc-unknown-none-elf"
} else if cfg!(machine = "microbit") {
    "thumbv6m-none-eabi"
} else if cfg!(machine = "lm3s6965evb") {
    "thumbv7m-none-eabi"
} else {
    "thumbv7em-none-eabihf"
};

/// The frequency that its timer counts, in hertz: a tick is `10^9 / HERTZ` instructions.
pub const HERTZ: u64 = if cfg!(machine = "microbit") {
    16_000_000
} else if cfg!(machine = "lm3s6965evb") {
    12_500_000
} else if cfg!(machine = "netduinoplus2") {
    168_000_000
} else if cfg!(machine = "mps2-an386") {
    25_000_000
} else {
    1_000_000_000
};

/// Bytes of the arena: about two thirds of a small memory, the rest is stack.
pub const ARENA: usize = if cfg!(machine = "microbit") {
    10 * 1024
} else if cfg!(any(machine = "lm3s6965evb", machine = "virt")) {
    40 * 1024
} else {
    64 * 1024
};
