//! Ray queries as CSV.

use kibiray::accel::Hit;
use kibiray::geom::{Interval, NotARay, Ray};
use kibiray::num::Real;

use crate::frame::{Frame, Way};

/// First line of a file of queries.
pub const QUERIES: &str = "ox,oy,oz,dx,dy,dz,tmin,tmax";

/// First line of a file of answers.
pub const ANSWERS: &str = "t,id,nx,ny,nz";

/// A ray and where along it a hit counts.
#[derive(Clone, Copy, Debug)]
pub struct Query<R: Real> {
    /// The ray, if the numbers make one.
    pub ray: Result<Ray<R>, NotARay>,
    /// Where a hit counts.
    pub interval: Interval<R>,
    /// How its parameters become those that were asked for.
    pub way: Way,
}

/// What a query finds.
#[derive(Clone, Copy, Debug)]
pub enum Answer<R> {
    /// It is no ray.
    Invalid,
    /// Nothing.
    Miss,
    /// The nearest hit.
    Hit(Hit<R>),
    /// Anything, when only that was asked.
    Blocked,
}

impl<R> Answer<R> {
    /// Whether something was hit.
    pub fn is_hit(&self) -> bool {
        matches!(self, Self::Hit(_) | Self::Blocked)
    }
}

/// Why a file is not one of queries.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CsvError {
    /// The line, from 1.
    pub line: usize,
    /// What is wrong with it.
    pub what: String,
}

/// Reads queries, for a scene in some frame.
///
/// # Errors
/// The first line that is not what it should be.
pub fn parse<R: Real>(bytes: &[u8], frame: &Frame) -> Result<Vec<Query<R>>, CsvError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        let line = 1 + before.iter().filter(|b| **b == b'\n').count();
        CsvError { line, what: "not text in UTF-8".into() }
    })?;
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line.trim_end()));
    if lines.next().is_none_or(|(_, header)| header != QUERIES) {
        return Err(CsvError { line: 1, what: format!("the header must be {QUERIES}") });
    }
    lines.map(|(line, row)| query(row, frame).map_err(|what| CsvError { line, what })).collect()
}

fn query<R: Real>(row: &str, frame: &Frame) -> Result<Query<R>, String> {
    let mut numbers = [0.0; 8];
    let mut fields = row.split(',');
    for (number, name) in numbers.iter_mut().zip(QUERIES.split(',')) {
        let field = fields.next().map(str::trim).filter(|field| !field.is_empty());
        let field = field.ok_or_else(|| format!("{name} is missing: a ray is {QUERIES}"))?;
        *number = field.parse().map_err(|_| {
            let field: String = field.chars().take(40).collect();
            format!("{name} is not a number: \"{}\"", field.escape_debug())
        })?;
    }
    if fields.next().is_some() {
        return Err(format!("more than 8 fields: a ray is {QUERIES}"));
    }
    let [ox, oy, oz, dx, dy, dz, min, max] = numbers;
    Ok(match frame.query([ox, oy, oz], [dx, dy, dz], (min, max)) {
        Ok((ray, interval, way)) => Query { ray: Ok(ray), interval, way },
        Err(not) => Query { ray: Err(not), interval: Interval::RAY, way: Way::STRAIGHT },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: Frame = Frame::FILE;

    #[test]
    fn rows_are_rays_or_say_why_not() {
        let file = |row: &str| format!("{QUERIES}\n{row}\n").into_bytes();
        let queries = parse::<f32>(&file("0,0,-5,0,0,1e0,0,inf\r"), &FILE).unwrap();
        assert!(queries[0].ray.is_ok() && queries[0].interval.max == f32::INFINITY);
        for no_ray in ["nan,0,0,0,0,1,0,inf", "0,0,0,0,-0,0,0,1", "0,0,0,0,INF,1,0,1"] {
            assert!(parse::<f32>(&file(no_ray), &FILE).unwrap()[0].ray.is_err(), "{no_ray}");
        }
        for bad in ["", "1,2,3", "0,0,0,0,0,1,0,x", "0,0,0,0,0,1,0,1,2", "0,0,,0,0,1,0,1"] {
            assert_eq!(parse::<f32>(&file(bad), &FILE).unwrap_err().line, 2, "{bad}");
        }
        assert_eq!(parse::<f32>(b"", &FILE).unwrap_err().line, 1);
        assert_eq!(parse::<f32>(b"ox,oy\n", &FILE).unwrap_err().line, 1);
        let mut binary = file("0,0,0,0,0,1,0,1");
        binary.extend([0xff, b'\n']);
        assert_eq!(parse::<f32>(&binary, &FILE).unwrap_err().line, 3);
    }
}
