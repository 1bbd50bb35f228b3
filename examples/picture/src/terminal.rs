//! A terminal instead of a display: the stand-in for the driver of your panel.

use core::convert::Infallible;
use cortex_m_semihosting::hio::{self, HostStream};
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Size};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

pub const WIDTH: u16 = 80;
pub const HEIGHT: u16 = 50;

/// Two pixels, one above the other: the upper half block "▀" on a ground of the lower colour.
const CELL: [u8; 39] = *b"\x1b[38;2;000;000;000;48;2;000;000;000m\xe2\x96\x80";
/// Where the numbers of red, green and blue stand, of the block and of its ground.
const CHANNELS: [usize; 6] = [7, 11, 15, 24, 28, 32];

/// Shows 24-bit colours; rows have to come from the top.
pub struct Terminal {
    pub out: HostStream,
    /// The row above, until the one below it is known.
    upper: [Rgb888; WIDTH as usize],
}

impl Terminal {
    /// `None` when no debugger or emulator takes the output.
    pub fn open() -> Option<Self> {
        Some(Self { out: hio::hstdout().ok()?, upper: [Rgb888::BLACK; WIDTH as usize] })
    }
}

impl OriginDimensions for Terminal {
    fn size(&self) -> Size {
        Size::new(WIDTH.into(), HEIGHT.into())
    }
}

impl DrawTarget for Terminal {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        for Pixel(at, color) in pixels {
            let Some(upper) = self.upper.get_mut(at.x as usize) else { continue };
            if at.y % 2 == 0 {
                *upper = color;
                continue;
            }
            let mut cell = CELL;
            let colors = [upper.r(), upper.g(), upper.b(), color.r(), color.g(), color.b()];
            for (from, channel) in CHANNELS.into_iter().zip(colors) {
                if let Some([hundreds, tens, ones]) = cell.get_mut(from..from + 3) {
                    *hundreds += channel / 100;
                    *tens += channel / 10 % 10;
                    *ones += channel % 10;
                }
            }
            let _ = self.out.write_all(&cell);
            if at.x == i32::from(WIDTH) - 1 {
                let _ = self.out.write_all(b"\x1b[m\n");
            }
        }
        Ok(())
    }
}
