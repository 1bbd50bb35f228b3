//! Values of options: numbers of bytes, sizes of pictures, resolutions of grids.

use std::path::Path;

use crate::options::Antialiasing;

/// An arena of more is not a microcontroller's, nor this host's.
const MOST_BYTES: usize = 16 << 30;

/// Most pixels of a picture.
const MOST_PIXELS: u32 = 100_000_000;

/// `12345`, `16KiB`, `1MiB`.
///
/// # Errors
/// One line that says what is expected.
pub fn bytes(text: &str) -> Result<usize, String> {
    let digits = text.bytes().take_while(u8::is_ascii_digit).count();
    let (number, unit) = text.split_at(digits);
    let factor: usize = match unit.to_ascii_lowercase().as_str() {
        "" | "b" => 1,
        "kib" => 1 << 10,
        "mib" => 1 << 20,
        "gib" => 1 << 30,
        _ => return Err("give a whole number of bytes, KiB, MiB or GiB, as in 16KiB".into()),
    };
    if number.is_empty() {
        return Err("give a whole number of bytes, KiB, MiB or GiB, as in 16KiB".into());
    }
    let bytes = number.parse::<usize>().ok().and_then(|number| number.checked_mul(factor));
    bytes.filter(|bytes| *bytes <= MOST_BYTES).ok_or_else(|| "at most 16GiB".into())
}

/// `1KiB..1MiB`.
///
/// # Errors
/// One line that says what is expected.
pub fn bytes_range(text: &str) -> Result<(usize, usize), String> {
    let wrong = || "give the least and the most memory, as in 1KiB..1MiB".to_owned();
    let (least, most) = text.split_once("..").ok_or_else(wrong)?;
    let (least, most) = (bytes(least)?, bytes(most)?);
    if least == 0 || least > most { Err(wrong()) } else { Ok((least, most)) }
}

/// `WxH`.
///
/// # Errors
/// One line that says what is expected.
pub fn size(text: &str) -> Result<(u16, u16), String> {
    let wrong = || "give width and height in pixels, 1 to 65535, as in 640x480".to_owned();
    let (width, height) = text.split_once(['x', 'X']).ok_or_else(wrong)?;
    let number = |text: &str| match natural(text) {
        Some(n @ 1..=65_535) => Ok(n as u16),
        _ => Err(wrong()),
    };
    let (width, height) = (number(width)?, number(height)?);
    if u32::from(width) * u32::from(height) > MOST_PIXELS {
        return Err(format!("at most {MOST_PIXELS} pixels"));
    }
    Ok((width, height))
}

/// `off`, `4`, `adaptive`, `adaptive:0.05`.
///
/// # Errors
/// One line that says what is expected.
pub fn antialiasing(text: &str) -> Result<Antialiasing, String> {
    let wrong = || "give off, 1 to 16, adaptive or adaptive:T, as in adaptive:0.05".to_owned();
    match text {
        "off" => Ok(Antialiasing::Off),
        "adaptive" => Ok(Antialiasing::Adaptive(0.1)),
        _ => match text.strip_prefix("adaptive:") {
            Some(threshold) => share(threshold).map(Antialiasing::Adaptive),
            None => match natural(text) {
                Some(n @ 1..=16) => Ok(Antialiasing::Uniform(n as u8)),
                _ => Err(wrong()),
            },
        },
    }
}

/// A part of 1.
///
/// # Errors
/// One line that says what is expected.
pub fn share(text: &str) -> Result<f64, String> {
    let number = text.parse().ok().filter(|share| (0.0..=1.0).contains(share));
    number.ok_or_else(|| "give a number from 0 to 1, as in 0.004".into())
}

/// `NXxNYxNZ`.
///
/// # Errors
/// One line that says what is expected.
pub fn resolution(text: &str) -> Result<[u32; 3], String> {
    let numbers: Option<Vec<u32>> = text.split(['x', 'X']).map(natural).collect();
    numbers
        .and_then(|numbers| <[u32; 3]>::try_from(numbers).ok())
        .filter(|numbers| numbers.iter().all(|n| (1..=1 << 20).contains(n)))
        .ok_or_else(|| "give three numbers of cells, 1 to 1048576, as in 16x16x8".into())
}

/// Digits and nothing else.
fn natural(text: &str) -> Option<u32> {
    if text.bytes().all(|b| b.is_ascii_digit()) { text.parse().ok() } else { None }
}

/// Whether a path stands for standard input or output.
pub fn is_dash(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// A number of bytes for people.
pub fn readable(bytes: usize) -> String {
    const UNITS: [&str; 4] = ["B", "KiB", "MiB", "GiB"];
    if bytes < 10_000 {
        return format!("{bytes} B");
    }
    let mut value = bytes as f64;
    let mut unit = 0;
    while value >= 1024.0 && unit + 1 < UNITS.len() {
        value /= 1024.0;
        unit += 1;
    }
    let text = format!("{value:.1}");
    format!("{} {}", text.strip_suffix(".0").unwrap_or(&text), UNITS[unit])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_have_binary_units() {
        assert_eq!(bytes("0"), Ok(0));
        assert_eq!(bytes("12345"), Ok(12345));
        assert_eq!(bytes("7B"), Ok(7));
        assert_eq!(bytes("16KiB"), Ok(16384));
        assert_eq!(bytes("16kib"), Ok(16384));
        assert_eq!(bytes("1MiB"), Ok(1 << 20));
        let bad = ["", "KiB", "64kb", "1K", "-1", "+1", "1.5KiB", "1 KiB", "0x10", "17GiB", "9e9"];
        for bad in bad {
            assert!(bytes(bad).is_err(), "{bad}");
        }
        assert!(bytes("99999999999999999999").is_err());
    }

    #[test]
    fn sizes_are_two_numbers_and_resolutions_three() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for bad in ["", "640", "640x", "x480", "0x1", "1x0", "65536x1", "-1x5", "1x2x3", "1.0x2"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        assert!(size("65535x65535").is_err());
        assert_eq!(resolution("1x2x3"), Ok([1, 2, 3]));
        for bad in ["", "1", "1x2", "1x2x3x4", "0x1x1", "1x1x1048577", "ax1x1", "+1x1x1"] {
            assert!(resolution(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bytes_are_readable() {
        assert_eq!(readable(0), "0 B");
        assert_eq!(readable(65536), "64 KiB");
        assert_eq!(readable(262_144 + 100), "256.1 KiB");
        assert_eq!(readable(16 << 20), "16 MiB");
    }
}
