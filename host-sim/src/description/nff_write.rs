//! Writing the Neutral File Format, statement by statement.
//!
//! Statements come out in the order of the calls and repeat when a caller repeats them, as in the
//! files of the Standard Procedural Databases. Format: E. Haines, "NFF.TXT", in the Standard
//! Procedural Databases; numbers as C's `%g`, which those files use.

use std::io::{self, Write};

use super::{Material, Triple, View};

/// Digits that `%g` keeps.
const SIGNIFICANT: i32 = 6;

/// `value` as C's `printf("%g")` prints it: 6 significant digits, no trailing zeros, an exponent
/// of at least two digits below 1e-4 and from 1e6.
pub fn g(value: f64) -> String {
    if value.is_nan() {
        return if value.is_sign_negative() { "-nan" } else { "nan" }.into();
    }
    if value.is_infinite() {
        return if value < 0.0 { "-inf" } else { "inf" }.into();
    }
    if value == 0.0 {
        return if value.is_sign_negative() { "-0" } else { "0" }.into();
    }
    let scientific = format!("{value:.0$e}", SIGNIFICANT as usize - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..SIGNIFICANT).contains(&exponent) {
        let decimals = (SIGNIFICANT - 1 - exponent) as usize;
        trim(&format!("{value:.decimals$}")).into()
    } else {
        let sign = if exponent < 0 { '-' } else { '+' };
        format!("{}e{sign}{:02}", trim(mantissa), exponent.abs())
    }
}

/// `digits` without the zeros that end its fraction.
fn trim(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

/// Prints NFF statements.
pub struct NffWriter<'a> {
    out: &'a mut dyn Write,
}

impl std::fmt::Debug for NffWriter<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("NffWriter").finish_non_exhaustive()
    }
}

impl<'a> NffWriter<'a> {
    /// Prints to `out`; many small writes, so give a buffered one.
    pub fn new(out: &'a mut dyn Write) -> Self {
        Self { out }
    }

    fn line(&mut self, keyword: &str, groups: &[&[f64]]) -> io::Result<()> {
        self.out.write_all(keyword.as_bytes())?;
        let mut gap = if keyword.is_empty() { "" } else { " " };
        for number in groups.iter().copied().flatten() {
            write!(self.out, "{gap}{}", g(*number))?;
            gap = " ";
        }
        self.out.write_all(b"\n")
    }

    /// `b`.
    ///
    /// # Errors
    /// Whatever the writer below reports; so for all methods.
    pub fn background(&mut self, color: Triple) -> io::Result<()> {
        self.line("b", &[&color])
    }

    /// `v` and its six lines.
    ///
    /// # Errors
    /// As [`Self::background`].
    pub fn view(&mut self, view: &View) -> io::Result<()> {
        self.line("v", &[])?;
        self.line("from", &[&view.from])?;
        self.line("at", &[&view.at])?;
        self.line("up", &[&view.up])?;
        self.line("angle", &[&[view.angle]])?;
        self.line("hither", &[&[view.hither]])?;
        let [width, height] = view.resolution;
        writeln!(self.out, "resolution {width} {height}")
    }

    /// `l` without a colour.
    ///
    /// # Errors
    /// As [`Self::background`].
    pub fn light(&mut self, position: Triple) -> io::Result<()> {
        self.line("l", &[&position])
    }

    /// `f`.
    ///
    /// # Errors
    /// As [`Self::background`].
    pub fn fill(&mut self, m: &Material) -> io::Result<()> {
        let numbers = [m.diffuse, m.specular, m.shine, m.transmission, m.index];
        self.line("f", &[&m.color, &numbers])
    }

    /// `s`.
    ///
    /// # Errors
    /// As [`Self::background`].
    pub fn sphere(&mut self, center: Triple, radius: f64) -> io::Result<()> {
        self.line("s", &[&center, &[radius]])
    }

    /// `c`, on one line as the original generators print it.
    ///
    /// # Errors
    /// As [`Self::background`].
    pub fn cone(&mut self, base: (Triple, f64), apex: (Triple, f64)) -> io::Result<()> {
        self.line("c", &[&base.0, &[base.1], &apex.0, &[apex.1]])
    }

    /// `p` and its vertices.
    ///
    /// # Errors
    /// As [`Self::background`].
    pub fn polygon(&mut self, vertices: &[Triple]) -> io::Result<()> {
        writeln!(self.out, "p {}", vertices.len())?;
        vertices.iter().try_for_each(|vertex| self.line("", &[vertex]))
    }

    /// `pp` and its pairs of vertex and normal.
    ///
    /// # Errors
    /// As [`Self::background`].
    pub fn patch(&mut self, corners: &[(Triple, Triple)]) -> io::Result<()> {
        writeln!(self.out, "pp {}", corners.len())?;
        corners.iter().try_for_each(|(vertex, normal)| self.line("", &[vertex, normal]))
    }
}

#[cfg(test)]
mod tests {
    use super::g;

    #[test]
    fn numbers_print_as_percent_g() {
        // Expected strings from C's printf.
        let table = [
            (0.0, "0"),
            (-0.0, "-0"),
            (1.0, "1"),
            (-12.0, "-12"),
            (0.5, "0.5"),
            (1.0 / 3.0, "0.333333"),
            (2.0 / 3.0, "0.666667"),
            (1.022846, "1.02285"),
            (100_000.0, "100000"),
            (123_456.0, "123456"),
            (999_999.0, "999999"),
            (999_999.4, "999999"),
            (999_999.5, "1e+06"),
            (1_000_000.0, "1e+06"),
            (1_234_567.0, "1.23457e+06"),
            (0.0001, "0.0001"),
            (0.000_099_999_95, "0.0001"),
            (0.000_012_345_678, "1.23457e-05"),
            (-2.558_36e-17, "-2.55836e-17"),
            (1e100, "1e+100"),
            (1.5e-300, "1.5e-300"),
            (9.999_995, "10"),
            (9.999_999, "10"),
            (0.030_937_5, "0.0309375"),
            // Exact ties go to the even digit.
            (131_072.5, "131072"),
            (131_073.5, "131074"),
            (1.000_125, "1.00012"),
            (0.5 + 0.5_f64.powi(17), "0.500008"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
        ];
        for (value, expected) in table {
            assert_eq!(g(value), expected, "{value:e}");
        }
    }
}
