//! The scenes of the Standard Procedural Databases, generated.
//!
//! Each generator prints NFF text with numbers of six digits, as the original programs do; a scene
//! is what a reader of that text gets. So `spd:NAME` and the printed file are the same geometry.
//! Source: E. Haines, "A Proposal for Standard Graphics Environments", IEEE CG&A 7(11), 1987, and
//! his Standard Procedural Databases.

use std::fmt;
use std::io::{self, Write};

use super::nff_write::NffWriter;
use super::{Material, Triple, View};

mod balls;
mod gears;
mod jacks;
mod lattice;
mod matrix;
mod mount;
mod rings;
mod shells;
mod sombrero;
mod teapot;
mod tetra;
mod tree;

/// A scene of more primitives is refused.
pub const MOST_PRIMITIVES: u64 = 20_000_000;

/// One of the built-in generators.
#[derive(Clone, Copy)]
pub struct Generator {
    /// Its name, after `spd:`.
    pub name: &'static str,
    /// The size factor of published figures.
    pub default_size: u32,
    count: fn(u32) -> Option<u64>,
    write: fn(u32, &mut NffWriter<'_>) -> io::Result<()>,
}

impl fmt::Debug for Generator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Generator({}, {})", self.name, self.default_size)
    }
}

macro_rules! generators {
    ($($name:ident $size:literal),* $(,)?) => {
        &[$(Generator {
            name: stringify!($name),
            default_size: $size,
            count: $name::primitives,
            write: $name::generate,
        }),*]
    };
}

static GENERATORS: &[Generator] = generators![
    balls 4, gears 4, mount 6, rings 7, teapot 12, tetra 6, tree 11, lattice 12, shells 5,
    sombrero 1, jacks 1,
];

/// All generators.
pub fn generators() -> &'static [Generator] {
    GENERATORS
}

/// Why a scene cannot be generated.
#[derive(Debug)]
pub enum SpdError {
    /// No generator of this name.
    UnknownName(String),
    /// Size factors begin at 1.
    SizeZero(&'static str),
    /// More than [`MOST_PRIMITIVES`].
    TooLarge {
        /// The generator.
        name: &'static str,
        /// The size asked for.
        size: u32,
        /// Its primitives, if a `u64` holds the number.
        primitives: Option<u64>,
    },
    /// The writer failed.
    Io(io::Error),
}

impl fmt::Display for SpdError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownName(name) => {
                write!(f, "no generator is named \"{}\"; there are", name.escape_debug())?;
                GENERATORS.iter().try_for_each(|generator| write!(f, " {}", generator.name))
            }
            Self::SizeZero(name) => write!(f, "spd:{name}:0: sizes begin at 1"),
            Self::TooLarge { name, size, primitives } => {
                write!(f, "spd:{name}:{size} has ")?;
                match primitives {
                    Some(count) => write!(f, "{count}")?,
                    None => f.write_str("more than 2^64")?,
                }
                write!(f, " primitives, the limit is {MOST_PRIMITIVES}: ask for a smaller size")
            }
            Self::Io(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for SpdError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Io(error) => Some(error),
            _ => None,
        }
    }
}

impl From<io::Error> for SpdError {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

impl Generator {
    /// Primitives of a scene of this size, without generating it.
    ///
    /// # Errors
    /// A size of 0, or one of more than [`MOST_PRIMITIVES`].
    pub fn primitives(&self, size: u32) -> Result<u64, SpdError> {
        if size == 0 {
            return Err(SpdError::SizeZero(self.name));
        }
        match (self.count)(size) {
            Some(count) if count <= MOST_PRIMITIVES => Ok(count),
            primitives => Err(SpdError::TooLarge { name: self.name, size, primitives }),
        }
    }

    /// Prints the scene as NFF.
    ///
    /// # Errors
    /// As [`Self::primitives`], and a writer that fails.
    pub fn generate(&self, size: u32, out: &mut impl Write) -> Result<(), SpdError> {
        self.primitives(size)?;
        let mut buffered = io::BufWriter::new(out);
        (self.write)(size, &mut NffWriter::new(&mut buffered))?;
        Ok(buffered.flush()?)
    }
}

/// The generator of this name.
///
/// # Errors
/// An unknown name; the message lists the known ones.
pub fn find(name: &str) -> Result<&'static Generator, SpdError> {
    let mut all = GENERATORS.iter();
    all.find(|it| it.name == name).ok_or_else(|| SpdError::UnknownName(name.into()))
}

/// Primitives of `name` at `size`, without generating it.
///
/// # Errors
/// As [`find`] and [`Generator::primitives`].
pub fn primitives(name: &str, size: u32) -> Result<u64, SpdError> {
    find(name)?.primitives(size)
}

/// Prints scene `name` at `size` as NFF.
///
/// # Errors
/// As [`find`] and [`Generator::generate`].
pub fn generate(name: &str, size: u32, out: &mut impl Write) -> Result<(), SpdError> {
    find(name)?.generate(size, out)
}

/// Background of nearly all scenes.
const SKY: Triple = [0.078, 0.361, 0.753];

/// The view that most scenes share: z up, 45 degrees, 512 by 512.
fn looking(from: Triple, at: Triple, hither: f64) -> View {
    View { from, at, up: [0.0, 0.0, 1.0], angle: 45.0, hither, resolution: [512, 512] }
}

fn radians(degrees: f64) -> f64 {
    degrees * std::f64::consts::PI / 180.0
}

/// A surface as the generators give it.
#[derive(Clone, Copy)]
struct Surface {
    color: Triple,
    kd: f64,
    ks: f64,
    /// Angle off the mirror direction at which the highlight is half as bright, in degrees.
    highlight: f64,
    transmission: f64,
    ior: f64,
}

impl Surface {
    /// Diffuse only; black until a colour is given.
    const MATT: Self =
        Self { color: [0.0; 3], kd: 1.0, ks: 0.0, highlight: 0.0, transmission: 0.0, ior: 0.0 };

    /// With the highlight as Phong's power.
    fn material(&self) -> Material {
        let shine = if self.highlight == 0.0 {
            100_000.0
        } else {
            0.5_f64.ln() / radians(self.highlight).cos().ln()
        };
        Material {
            color: self.color,
            diffuse: self.kd,
            specular: self.ks,
            shine,
            transmission: self.transmission,
            index: self.ior,
        }
    }
}
