//! Text to the host, by semihosting.

use semihosting::sys::arm_compat::syscall::{OperationNumber, ParamRegR, syscall_readonly};

/// The host's standard output. Calls the host directly: the library's streams have checks that can
/// panic, and the programs here are to have none.
#[derive(Clone, Copy, Debug)]
pub struct Console {
    handle: usize,
}

/// Mode "w" of C's `fopen`.
const WRITE: usize = 4;

impl Console {
    /// Opens it; what cannot be written later is lost.
    pub fn open() -> Self {
        let name = c":tt";
        let block =
            [ParamRegR::c_str(name), ParamRegR::usize(WRITE), ParamRegR::usize(name.count_bytes())];
        // SAFETY: the host reads a block of name, mode and length, which outlive the call.
        let handle =
            unsafe { syscall_readonly(OperationNumber::SYS_OPEN, ParamRegR::block(&block)) };
        Self { handle: handle.usize() }
    }

    /// Writes text as it is.
    pub fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
    }

    /// Writes a number in decimal.
    pub fn number(&mut self, mut number: u64) {
        let mut digits = [b'0'; 20];
        let mut from = digits.len();
        for (place, digit) in digits.iter_mut().enumerate().rev() {
            *digit += (number % 10) as u8;
            number /= 10;
            from = place;
            if number == 0 {
                break;
            }
        }
        self.bytes(digits.get(from..).unwrap_or_default());
    }

    /// Writes a number as eight hexadecimal digits.
    pub fn hex(&mut self, number: u32) {
        let digit = |place: usize| match (number >> (28 - 4 * place) & 15) as u8 {
            low @ 0..=9 => b'0' + low,
            high => b'a' - 10 + high,
        };
        self.bytes(&core::array::from_fn::<u8, 8, _>(digit));
    }

    fn bytes(&mut self, bytes: &[u8]) {
        let block =
            [ParamRegR::usize(self.handle), ParamRegR::buf(bytes), ParamRegR::usize(bytes.len())];
        // SAFETY: the host reads a block of handle, address and length, and so many bytes from
        // there; all of them outlive the call.
        unsafe { syscall_readonly(OperationNumber::SYS_WRITE, ParamRegR::block(&block)) };
    }
}
