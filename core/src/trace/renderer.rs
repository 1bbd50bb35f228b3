//! Pictures, row by row.

use super::Tracer;
use super::sampling::{Middle, Sampling};
use crate::accel::{Accel, Mailbox};
use crate::display::rgb888;
use crate::num::{Real, Vec3};
use crate::probe::Probe;
use crate::scene::{Camera, Line, Shapes};
use embedded_graphics_core::draw_target::DrawTarget;
use embedded_graphics_core::pixelcolor::Rgb888;
use embedded_graphics_core::prelude::{Point, Size};
use embedded_graphics_core::primitives::Rectangle;

/// Renders a picture row by row, so that a main loop never waits longer than for one row. Keeps no
/// pixels, but for what its [`Sampling`] does.
#[derive(Debug)]
pub struct Renderer<'a, R: Real, S, A, M, P = Middle> {
    tracer: Tracer<'a, R, S, A, M>,
    camera: Camera<R>,
    width: u16,
    height: u16,
    next_row: u16,
    sampling: P,
    /// The line of the picture that was looked at last, and its place.
    line: (i32, Line<R>),
}

/// No line of any picture.
const NOWHERE: i32 = i32::MIN;

impl<'a, R: Real, S: Shapes<R>, A: Accel<R>, M: Mailbox> Renderer<'a, R, S, A, M> {
    /// A picture of so many pixels, not begun. The camera's aspect should be `width / height`.
    pub fn new(tracer: Tracer<'a, R, S, A, M>, camera: Camera<R>, width: u16, height: u16) -> Self {
        let line = (NOWHERE, Line::default());
        Self { tracer, camera, width, height, next_row: 0, sampling: Middle, line }
    }

    /// The same picture, each pixel made from other rays than the one through its middle.
    #[must_use]
    pub fn sampled<P: Sampling<R>>(self, sampling: P) -> Renderer<'a, R, S, A, M, P> {
        let Self { tracer, camera, width, height, next_row, .. } = self;
        let line = (NOWHERE, Line::default());
        Renderer { tracer, camera, width, height, next_row, sampling, line }
    }
}

impl<R: Real, S: Shapes<R>, A: Accel<R>, M: Mailbox, P: Sampling<R>> Renderer<'_, R, S, A, M, P> {
    /// The row that comes next, from the top; the height when the picture is done.
    pub fn next_row(&self) -> u16 {
        self.next_row
    }

    /// Goes on with another row: backwards to begin again, forwards to share the work.
    pub fn skip_to(&mut self, row: u16) {
        self.next_row = row.min(self.height);
    }

    /// The colour of a pixel. The pixel (0, 0) is at the upper left.
    pub fn pixel<C: Probe>(&mut self, x: u16, y: u16, probe: &mut C) -> Vec3<R> {
        let Self { tracer, camera, width, height, sampling, line, .. } = self;
        let parts = sampling.parts();
        // From points in parts of pixels to -1..1 across the picture.
        let across = |i: i32, n: u16| {
            let n = i32::from(n) * parts;
            R::fraction(2 * i - n, n)
        };
        let mut see = |x: i32, y: i32| {
            if line.0 != y {
                *line = (y, camera.line(-across(y, *height)));
            }
            let x = across(x, *width);
            tracer.color_from(&|| camera.ray_in(&line.1, x), probe)
        };
        sampling.pixel(x, y, &mut see)
    }

    /// Renders the next row into a display, in one call of
    /// [`fill_contiguous`](DrawTarget::fill_contiguous) with the pixels as they come to be. Returns
    /// whether there was a row left.
    ///
    /// # Errors
    /// Those of the display; the row then counts as not drawn.
    pub fn draw_row<D>(&mut self, display: &mut D, probe: &mut impl Probe) -> Result<bool, D::Error>
    where
        D: DrawTarget,
        D::Color: From<Rgb888>,
    {
        let y = self.next_row;
        if y >= self.height {
            return Ok(false);
        }
        let row = Rectangle::new(Point::new(0, i32::from(y)), Size::new(self.width.into(), 1));
        let pixels = (0..self.width).map(|x| rgb888::<R>(self.pixel(x, y, probe)).into());
        display.fill_contiguous(&row, pixels)?;
        self.next_row = y + 1;
        Ok(true)
    }

    /// Renders all rows that are left.
    ///
    /// # Errors
    /// Those of the display.
    pub fn draw<D>(&mut self, display: &mut D, probe: &mut impl Probe) -> Result<(), D::Error>
    where
        D: DrawTarget,
        D::Color: From<Rgb888>,
    {
        for _ in self.next_row..self.height {
            self.draw_row(display, probe)?;
        }
        Ok(())
    }
}
