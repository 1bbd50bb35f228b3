//! From which rays a pixel's colour is made.
//!
//! The adaptive way is that of T. Whitted, "An improved illumination model for shaded display",
//! CACM 23(6) (1980): rays go through the corners of pixels, where up to four pixels share them;
//! where corners differ, the square between them is divided, and its parts again. A row of corners
//! is all that is remembered between pixels. Other than there, a pixel is divided once where its
//! neighbours in the row differ, too: what is small often falls between the corners of one pixel, seldom
//! between those of three.

use crate::memory::{Arena, Footprint, OutOfArena};
use crate::num::{Real, Vec3, Vector};
use heapless::Vec;

/// The most levels of division, so that a part is an eighth of a pixel wide.
pub const MOST_LEVELS: u8 = 3;

/// Parts of a pixel's edge at the deepest level.
const PARTS: i32 = 1 << MOST_LEVELS;

/// How a pixel is sampled: a type, so that a program has the code for the ways it uses only. Where
/// several rays make a pixel, what each sees is cut to 0 to 1 first: a single highlight would
/// outshine its neighbours otherwise.
pub trait Sampling<R: Real> {
    /// In how many parts an edge of a pixel is divided by the points that it looks at.
    fn parts(&self) -> i32;

    /// The colour of a pixel, from what is seen at points of the picture, counted in those parts.
    fn pixel(&mut self, x: u16, y: u16, see: &mut impl FnMut(i32, i32) -> Vec3<R>) -> Vec3<R>;
}

/// One ray through the middle.
#[derive(Clone, Copy, Debug, Default)]
pub struct Middle;

impl<R: Real> Sampling<R> for Middle {
    fn parts(&self) -> i32 {
        2
    }

    fn pixel(&mut self, x: u16, y: u16, see: &mut impl FnMut(i32, i32) -> Vec3<R>) -> Vec3<R> {
        see(2 * i32::from(x) + 1, 2 * i32::from(y) + 1)
    }
}

/// The mean of a square of rays, so many along each edge, through the middles of equal parts; 0
/// counts as 1.
#[derive(Clone, Copy, Debug)]
pub struct Uniform(pub u8);

impl<R: Real> Sampling<R> for Uniform {
    fn parts(&self) -> i32 {
        2 * i32::from(self.0.max(1))
    }

    fn pixel(&mut self, x: u16, y: u16, see: &mut impl FnMut(i32, i32) -> Vec3<R>) -> Vec3<R> {
        let n = i32::from(self.0.max(1));
        // Weighed before they are added: fixed point has no room for the sum of all.
        let (mut color, weight) = (Vec3::<R>::default(), R::fraction(1, n * n));
        for j in 0..n {
            for i in 0..n {
                let seen = see(2 * (i32::from(x) * n + i) + 1, 2 * (i32::from(y) * n + j) + 1);
                color = color + seen.map(|c| c.clamp(R::ZERO, R::ONE)) * weight;
            }
        }
        color
    }
}

/// Rays through the corners, and more where they differ; remembers the corners of one row.
///
/// Goes fastest along rows from left to right and from the top; pixels out of order cost all their
/// corners.
#[derive(Debug)]
pub struct Adaptive<'m, R: Real> {
    /// Corners of the row's upper line; left of the pixel that comes next, of its lower line.
    corners: &'m mut [Vec3<R>],
    /// Of the upper line, the corner to the left of the pixel that comes next; of the lower one, the
    /// corners at its left and at its right.
    before: Vec3<R>,
    left: Vec3<R>,
    right: Vec3<R>,
    /// The pixel that comes next.
    next: Option<(u16, u16)>,
    /// What is seen of a pixel at points an eighth of it apart, row by row, as far as is known.
    parts: &'m mut [Vec3<R>],
    known: [u16; EDGE],
    threshold: R,
    levels: u8,
}

/// Points along an edge of a pixel, both corners included.
const EDGE: usize = PARTS as usize + 1;

impl<'m, R: Real> Adaptive<'m, R> {
    /// For pictures of so many columns. A pixel is divided where one of the channels differs by more
    /// than `threshold` (0 to 1) between its corners and those of the pixels at its left and right, at
    /// most `levels` times (up to [`MOST_LEVELS`]). A part of it, a fourth of the area, has to differ by four times as much, and
    /// so on: what counts is how much of the pixel's colour is in doubt.
    ///
    /// # Errors
    /// The arena has no room for [`Adaptive::footprint`].
    pub fn new(
        width: u16,
        threshold: R,
        levels: u8,
        arena: &mut Arena<'m>,
    ) -> Result<Self, OutOfArena> {
        arena.require(Self::footprint(width))?;
        let corners = arena.keep("corner samples", usize::from(width) + 1)?;
        let parts = arena.keep("samples of a pixel", EDGE * EDGE)?;
        let levels = levels.min(MOST_LEVELS);
        let (black, known) = (Vec3::<R>::default(), [0; EDGE]);
        let (before, left, right) = (black, black, black);
        Ok(Self { corners, before, left, right, next: None, parts, known, threshold, levels })
    }

    /// The bytes it takes: 12 a column in `f32`, and 984 or up to 8 more.
    pub fn footprint(width: u16) -> Footprint {
        Footprint::of::<Vec3<R>>(usize::from(width) + 1).then(Footprint::of::<Vec3<R>>(EDGE * EDGE))
    }

    /// What is seen at a point of a pixel, in its parts; shot only once.
    fn seen(&mut self, x: i32, y: i32, shoot: impl FnOnce() -> Vec3<R>) -> Vec3<R> {
        let (x, y) = (x as usize, y as usize);
        let row = self.known.get_mut(y).filter(|_| x < EDGE);
        let (Some(row), Some(part)) = (row, self.parts.get_mut(y * EDGE + x)) else {
            return shoot();
        };
        if *row & 1 << x == 0 {
            *row |= 1 << x;
            *part = shoot();
        }
        *part
    }

    /// Goes on to the pixel to the right: its left edge is known as far as the right one is.
    fn shift(&mut self) {
        for (row, parts) in self.known.iter_mut().zip(self.parts.chunks_exact_mut(EDGE)) {
            *row >>= PARTS;
            if let [first, .., last] = parts {
                *first = *last;
            }
        }
    }

    /// The colour of a pixel, divided where that is in doubt, and its parts where their corners differ.
    #[inline(never)]
    fn divide(
        &mut self,
        pixel: Square<R>,
        in_doubt: bool,
        see: &mut impl FnMut(i32, i32) -> Vec3<R>,
    ) -> Vec3<R> {
        let least = PARTS >> self.levels;
        let (column, row) = (pixel.x, pixel.y);
        let mut see = |it: &mut Self, x: i32, y: i32| it.seen(x - column, y - row, || see(x, y));
        let mut color = Vec3::<R>::default();
        // A divided square leaves its three brothers behind at every level.
        let mut squares = Vec::<Square<R>, { 3 * MOST_LEVELS as usize + 1 }>::new();
        let _ = squares.push(pixel);
        while let Some(Square { x, y, size, corners }) = squares.pop() {
            let [a, b, c, d] = corners;
            let (mut threshold, mut edge) = (self.threshold, size);
            while edge < PARTS {
                threshold = (threshold.min(R::ONE)).times_int(4);
                edge += edge;
            }
            let differs =
                if size == PARTS { in_doubt } else { spread::<R, 2>([a, b], [c, d]) > threshold };
            if !(differs && size > least) {
                let area = R::fraction(size * size, 4 * PARTS * PARTS);
                color = color + (a + b + (c + d)) * area;
                continue;
            }
            let half = size / 2;
            let (top, left) = (see(self, x + half, y), see(self, x, y + half));
            let middle = see(self, x + half, y + half);
            let right = see(self, x + size, y + half);
            let bottom = see(self, x + half, y + size);
            for (x, y, corners) in [
                (x, y, [a, top, left, middle]),
                (x + half, y, [top, b, middle, right]),
                (x, y + half, [left, middle, c, bottom]),
                (x + half, y + half, [middle, right, bottom, d]),
            ] {
                let _ = squares.push(Square { x, y, size: half, corners });
            }
        }
        color
    }
}

impl<R: Real> Sampling<R> for Adaptive<'_, R> {
    fn parts(&self) -> i32 {
        PARTS
    }

    fn pixel(&mut self, x: u16, y: u16, see: &mut impl FnMut(i32, i32) -> Vec3<R>) -> Vec3<R> {
        let (column, row) = (i32::from(x) * PARTS, i32::from(y) * PARTS);
        let mut see = |x, y| see(x, y).map(|c| c.clamp(R::ZERO, R::ONE));
        let i = usize::from(x);
        let in_order = self.next == Some((x, y));
        let lower = row + PARTS;
        // The columns of corners left of the pixel and right of its right neighbour, where there are any.
        let last = (i + 2).min(self.corners.len().saturating_sub(1));
        let first = i.saturating_sub(1);
        if !in_order {
            // The beginning of a row sees all of its corners, another pixel only its own and the next.
            let end = if x == 0 { usize::MAX } else { last + 1 };
            for (i, corner) in self.corners.iter_mut().enumerate().take(end).skip(first) {
                *corner = see(i as i32 * PARTS, row);
            }
        }
        if in_order && x > 0 {
            self.shift();
        } else {
            if let (true, Some(before)) = (x > 0, self.corners.get_mut(first)) {
                self.before = *before;
                *before = see(column - PARTS, lower);
            }
            self.left = see(column, lower);
            self.right = see(column + PARTS, lower);
            self.known = [0; EDGE];
        }
        let ahead = if last > i + 1 { see(last as i32 * PARTS, lower) } else { self.right };
        let lower_before = self.corners.get(first).filter(|_| x > 0).copied();
        let upper_ahead = self.corners.get(last).copied();
        let is_last = i + 2 >= self.corners.len();
        let Some([upper_left, upper_right]) = self.corners.get_mut(i..i + 2) else {
            return Vec3::<R>::default();
        };
        let corners = [*upper_left, *upper_right, self.left, self.right];
        let [a, b, c, d] = corners;
        let (before, upper_ahead) = (if x > 0 { self.before } else { a }, upper_ahead.unwrap_or(b));
        let lower_before = lower_before.unwrap_or(c);
        let spread = spread::<R, 4>([before, a, b, upper_ahead], [lower_before, c, d, ahead]);
        self.before = *upper_left;
        *upper_left = self.left;
        (self.left, self.right) = (self.right, ahead);
        self.next = if is_last {
            *upper_right = self.left;
            y.checked_add(1).map(|y| (0, y))
        } else {
            x.checked_add(1).map(|x| (x, y))
        };
        if !in_order && x > 0 {
            self.next = None;
        }
        let pixel = Square { x: column, y: row, size: PARTS, corners };
        self.divide(pixel, spread > self.threshold, &mut see)
    }
}

/// How much colours differ, in the channel that does most.
fn spread<R: Real, const N: usize>(upper: [Vec3<R>; N], lower: [Vec3<R>; N]) -> R {
    let mut all = upper.into_iter().chain(lower);
    let first = all.next().unwrap_or_default();
    let (least, most) = all.fold((first, first), |(least, most), c| (least.min(c), most.max(c)));
    (most - least).max_abs()
}

/// A part of the picture: its upper left corner and its edge in eighths of pixels, and what is seen
/// at the upper left, upper right, lower left and lower right.
struct Square<R: Real> {
    x: i32,
    y: i32,
    size: i32,
    corners: [Vec3<R>; 4],
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, vec3};

    /// White left of a slanted edge, black right of it, with a note of every point.
    struct Edge {
        seen: std::vec::Vec<(i32, i32)>,
    }

    extern crate std;

    impl Edge {
        fn see(&mut self, x: i32, y: i32) -> Vec3 {
            self.seen.push((x, y));
            if x * 3 + y < 40 * PARTS { Vec3::ONE } else { Vec3::ZERO }
        }
    }

    fn picture(
        levels: u8,
        order: &mut dyn FnMut(u16) -> std::vec::Vec<u16>,
    ) -> (std::vec::Vec<Vec3>, usize) {
        let mut bytes = [0_u64; 160];
        let mut arena = Arena::new(bytemuck::cast_slice_mut(&mut bytes));
        let mut adaptive = Adaptive::<f32>::new(20, 0.05, levels, &mut arena).unwrap();
        let mut edge = Edge { seen: std::vec::Vec::new() };
        let mut pixels = std::vec![Vec3::ZERO; 20 * 15];
        for y in 0..15 {
            for x in order(y) {
                let pixel = adaptive.pixel(x, y, &mut |x, y| edge.see(x, y));
                pixels[usize::from(y) * 20 + usize::from(x)] = pixel;
            }
        }
        (pixels, edge.seen.len())
    }

    #[test]
    fn corners_are_shared_and_the_order_does_not_matter() {
        let (pixels, rays) = picture(0, &mut |_| (0..20).collect());
        assert_eq!(rays, 21 * 16, "a ray a corner");
        let (_, more) = picture(0, &mut |_| (0..20).rev().collect());
        assert!(more > 3 * rays);
        for levels in [0, 1, 3] {
            let (pixels, _) = picture(levels, &mut |_| (0..20).collect());
            let (backwards, _) = picture(levels, &mut |_| (0..20).rev().collect());
            assert_eq!(pixels, backwards, "{levels}");
            let (skipping, _) = picture(levels, &mut |_| (5..20).chain(0..5).collect());
            assert_eq!(pixels, skipping, "{levels}");
        }
        assert_eq!(
            pixels,
            picture(0, &mut |y| if y % 3 == 0 {
                (9..20).chain(0..9).collect()
            } else {
                (0..20).collect()
            })
            .0
        );
    }

    #[test]
    fn what_falls_between_the_corners_is_seen_where_a_neighbour_differs() {
        // A square within the pixel (5, 5), and a point at a corner of the pixel before.
        let seen = |point: bool, levels: u8| {
            let mut bytes = [0_u64; 160];
            let mut arena = Arena::new(bytemuck::cast_slice_mut(&mut bytes));
            let mut adaptive = Adaptive::<f32>::new(20, 0.05, levels, &mut arena).unwrap();
            let inside = |x: i32| (5 * PARTS + 2..=5 * PARTS + 6).contains(&x);
            let mut see = |x: i32, y: i32| {
                let lit = (inside(x) && inside(y)) || (point && (x, y) == (4 * PARTS, 5 * PARTS));
                if lit { Vec3::ONE } else { Vec3::ZERO }
            };
            adaptive.pixel(5, 5, &mut see).x
        };
        assert_eq!(seen(false, 3), 0.0);
        assert_eq!(seen(true, 0), 0.0);
        assert_eq!(seen(true, 1), 0.25);
        assert!((seen(true, 3) - 25.0 / 64.0).abs() < 0.05, "{}", seen(true, 3));
    }

    #[test]
    fn an_edge_is_as_smooth_as_its_levels() {
        // The share of white that the slanted edge leaves in the pixels that it crosses.
        let exact = |x: usize, y: usize| {
            let mut white = 0.0;
            for j in 0..64 {
                let fy = y as f32 + (j as f32 + 0.5) / 64.0;
                white += ((40.0 - fy) / 3.0 - x as f32).clamp(0.0, 1.0) / 64.0;
            }
            white
        };
        let mut before = f32::INFINITY;
        for (levels, bound) in [(0, 0.5), (1, 0.25), (2, 0.13), (3, 0.07)] {
            let (pixels, rays) = picture(levels, &mut |_| (0..20).collect());
            let mut worst = 0.0_f32;
            for (i, pixel) in pixels.iter().enumerate() {
                worst = worst.max((pixel.x - exact(i % 20, i / 20)).abs());
            }
            assert!(worst < bound && worst < before, "{levels}: {worst}");
            assert!(rays < 21 * 16 + 15 * 3 * 5 * 4_usize.pow(levels.into()), "{rays}");
            before = worst;
        }
    }

    #[test]
    fn a_uniform_grid_is_cut_and_averaged() {
        let mut seen = std::vec::Vec::new();
        let color: Vec3 = Sampling::<f32>::pixel(&mut Uniform(2), 3, 1, &mut |x, y| {
            seen.push((x, y));
            vec3(9.0, 0.5, -1.0)
        });
        assert_eq!(color, vec3(1.0, 0.5, 0.0));
        assert_eq!(seen, [(13, 5), (15, 5), (13, 7), (15, 7)]);
    }

    #[test]
    fn too_small_an_arena_is_told() {
        let mut bytes = [0_u64; 2];
        let mut arena = Arena::new(bytemuck::cast_slice_mut(&mut bytes));
        let error = Adaptive::<f32>::new(20, 0.1, 3, &mut arena).map(|_| ()).unwrap_err();
        assert_eq!((error.needed, error.available), (21 * 12 + 4 + 81 * 12 + 4, 16));
    }
}
