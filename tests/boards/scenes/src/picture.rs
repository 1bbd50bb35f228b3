//! A display that is one row high.

use embedded_graphics_core::Pixel;
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::geometry::{OriginDimensions, Point, Size};
use embedded_graphics_core::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics_core::primitives::Rectangle;

/// Something was drawn that is not the next row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfOrder;

/// Keeps the row drawn last, as 8-bit RGB, like the buffer that a display driver sends from: a
/// picture of any size in three bytes a column. Rows have to come from the top, each in one piece.
#[derive(Debug)]
pub struct Row<'m> {
    pixels: &'m mut [[u8; 3]],
    height: u16,
    next: u16,
}

impl<'m> Row<'m> {
    /// Of a picture of that height, as wide as the bytes suffice for.
    pub fn new(bytes: &'m mut [u8], height: u16) -> Self {
        Self { pixels: bytes.as_chunks_mut().0, height, next: 0 }
    }

    /// The row drawn last.
    pub fn bytes(&self) -> &[u8] {
        self.pixels.as_flattened()
    }

    fn place(&self) -> Rectangle {
        let origin = Point::new(0, i32::from(self.next));
        Rectangle::new(origin, Size::new(self.pixels.len() as u32, 1))
    }
}

impl OriginDimensions for Row<'_> {
    fn size(&self) -> Size {
        Size::new(self.pixels.len() as u32, self.height.into())
    }
}

impl DrawTarget for Row<'_> {
    type Color = Rgb888;
    type Error = OutOfOrder;

    fn draw_iter<I>(&mut self, _pixels: I) -> Result<(), OutOfOrder>
    where
        I: IntoIterator<Item = Pixel<Rgb888>>,
    {
        Err(OutOfOrder)
    }

    fn fill_contiguous<I>(&mut self, area: &Rectangle, colors: I) -> Result<(), OutOfOrder>
    where
        I: IntoIterator<Item = Rgb888>,
    {
        if self.next >= self.height || *area != self.place() {
            return Err(OutOfOrder);
        }
        self.next += 1;
        let mut colors = colors.into_iter();
        for pixel in &mut *self.pixels {
            let color = colors.next().ok_or(OutOfOrder)?;
            *pixel = [color.r(), color.g(), color.b()];
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_have_to_come_in_order_and_whole() {
        let mut bytes = [0; 6];
        let mut display = Row::new(&mut bytes, 2);
        let row = |y| Rectangle::new(Point::new(0, y), Size::new(2, 1));
        let colors = [Rgb888::new(1, 2, 3), Rgb888::new(4, 5, 6)];
        assert_eq!(display.fill_contiguous(&row(1), colors), Err(OutOfOrder));
        assert_eq!(display.fill_contiguous(&row(0), colors), Ok(()));
        assert_eq!(display.bytes(), [1, 2, 3, 4, 5, 6]);
        assert_eq!(display.fill_contiguous(&row(0), colors), Err(OutOfOrder));
        let short = [Rgb888::new(7, 8, 9)];
        assert_eq!(display.fill_contiguous(&row(1), short), Err(OutOfOrder));
        assert_eq!(display.fill_contiguous(&row(2), colors), Err(OutOfOrder));
    }
}
