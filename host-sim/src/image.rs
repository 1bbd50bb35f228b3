//! Pictures: PNG files, their check sum, and colours for amounts of work.

use anyhow::Context;

/// A picture of 8-bit RGB, rows from the top.
#[derive(Clone, Debug)]
pub struct Image {
    /// Pixels in a row.
    pub width: u16,
    /// Rows.
    pub height: u16,
    /// Three bytes a pixel.
    pub rgb: Vec<u8>,
}

impl Image {
    /// A black one.
    pub fn new(width: u16, height: u16) -> Self {
        let rgb = vec![0; usize::from(width) * usize::from(height) * 3];
        Self { width, height, rgb }
    }

    /// CRC-32 (IEEE) of the pixels.
    pub fn crc32(&self) -> u32 {
        crc32fast::hash(&self.rgb)
    }

    /// The content of a PNG file.
    ///
    /// # Errors
    /// None that depends on the picture.
    pub fn png(&self) -> anyhow::Result<Vec<u8>> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width.into(), self.height.into());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        let mut writer = encoder.write_header().context("cannot encode the picture")?;
        writer.write_image_data(&self.rgb).context("cannot encode the picture")?;
        writer.finish().context("cannot encode the picture")?;
        Ok(file)
    }
}

/// Stops of the colour map "inferno" of matplotlib (S. van der Walt, N. Smith, 2015; public domain):
/// lightness grows evenly, so more work is brighter in every kind of colour vision and in print.
const INFERNO: [[u8; 3]; 9] = [
    [0, 0, 4],
    [31, 12, 72],
    [85, 15, 109],
    [136, 34, 106],
    [186, 54, 85],
    [227, 89, 51],
    [249, 140, 10],
    [249, 201, 50],
    [252, 255, 164],
];

/// The colour of a part of 1.
pub fn heat(part: f64) -> [u8; 3] {
    let stops = INFERNO.len() - 1;
    let place = part.clamp(0.0, 1.0) * stops as f64;
    let stop = (place as usize).min(stops - 1);
    let blend = place - stop as f64;
    std::array::from_fn(|channel| {
        let (a, b) = (f64::from(INFERNO[stop][channel]), f64::from(INFERNO[stop + 1][channel]));
        (a + (b - a) * blend).round() as u8
    })
}

/// Work of every pixel as a picture, and what its colours mean.
#[derive(Clone, Debug)]
pub struct HeatMap {
    /// The picture.
    pub image: Image,
    /// Work of half of the pixels is no greater.
    pub median: u32,
    /// The brightest colour: work of 999 of 1000 pixels is no greater.
    pub brightest: u32,
    /// Work of the worst pixel.
    pub most: u32,
}

impl HeatMap {
    /// Of the work of every pixel, rows from the top.
    pub fn new(width: u16, height: u16, work: &[u32]) -> Self {
        let mut sorted = work.to_vec();
        sorted.sort_unstable();
        let at = |part: f64| {
            let place = (sorted.len() as f64 * part) as usize;
            sorted.get(place.min(sorted.len().saturating_sub(1))).copied().unwrap_or(0)
        };
        let (median, brightest, most) = (at(0.5), at(0.999), at(1.0));
        let mut image = Image::new(width, height);
        for (pixel, work) in image.rgb.chunks_exact_mut(3).zip(work) {
            pixel.copy_from_slice(&heat(f64::from(*work) / f64::from(brightest.max(1))));
        }
        Self { image, median, brightest, most }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_work_is_brighter() {
        let lightness = |part: f64| {
            let [r, g, b] = heat(part).map(f64::from);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        for i in 0..20 {
            let part = f64::from(i) / 20.0;
            assert!(lightness(part + 0.05) > lightness(part), "{part}");
        }
        assert_eq!(heat(2.0), [252, 255, 164]);
    }

    #[test]
    fn check_sum_is_that_of_the_rows() {
        let mut image = Image::new(3, 1);
        image.rgb.copy_from_slice(b"123456789");
        assert_eq!(image.crc32(), 0xcbf4_3926);
        assert!(image.png().unwrap().starts_with(b"\x89PNG"));
    }
}
