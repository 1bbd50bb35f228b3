//! A display that keeps a checksum instead of pixels.

use crate::Crc32;
use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};

/// A pixel came that is not the next one, row by row from the upper left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfOrder;

/// Sums up the rows of 8-bit RGB. A picture of any size in 20 bytes.
#[derive(Clone, Debug)]
pub struct Checksum {
    size: Size,
    next: Point,
    crc: Crc32,
}

impl Checksum {
    /// Of a picture of so many pixels.
    pub const fn new((width, height): (u16, u16)) -> Self {
        let size = Size::new(width as u32, height as u32);
        Self { size, next: Point::new(0, 0), crc: Crc32::new() }
    }

    /// The checksum; `None` while pixels are missing.
    pub fn finish(&self) -> Option<u32> {
        let done = self.next == Point::new(0, self.size.height as i32);
        done.then(|| self.crc.finish())
    }
}

impl OriginDimensions for Checksum {
    fn size(&self) -> Size {
        self.size
    }
}

impl DrawTarget for Checksum {
    type Color = Rgb888;
    type Error = OutOfOrder;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), OutOfOrder>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        for Pixel(place, color) in pixels {
            if place != self.next || place.y >= self.size.height as i32 {
                return Err(OutOfOrder);
            }
            self.crc.update(&[color.r(), color.g(), color.b()]);
            self.next = if place.x + 1 == self.size.width as i32 {
                Point::new(0, place.y + 1)
            } else {
                Point::new(place.x + 1, place.y)
            };
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_have_to_come_in_order() {
        let pixel = |x, y| Pixel(Point::new(x, y), Rgb888::new(1, 2, 3));
        let mut sum = Checksum::new((2, 2));
        sum.draw_iter([pixel(0, 0), pixel(1, 0), pixel(0, 1)]).unwrap();
        assert_eq!(sum.finish(), None);
        assert_eq!(sum.clone().draw_iter([pixel(0, 1)]), Err(OutOfOrder));
        sum.draw_iter([pixel(1, 1)]).unwrap();
        let mut crc = Crc32::new();
        for _ in 0..4 {
            crc.update(&[1, 2, 3]);
        }
        assert_eq!(sum.finish(), Some(crc.finish()));
        assert_eq!(sum.draw_iter([pixel(0, 2)]), Err(OutOfOrder));
    }
}
