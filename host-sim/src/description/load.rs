//! Loading what a user calls a scene: a built-in one, a generator's name or a file.

use std::fmt;
use std::io;
use std::path::Path;

use super::Description;
use super::parse::ParseError;
use super::spd::{self, SpdError};
use super::{demo, nff, obj};

/// Why a scene could not be loaded. Displays as one line.
#[derive(Debug)]
pub enum LoadError {
    /// Neither a generator nor a file of a known kind.
    UnknownScene(String),
    /// `spd:` with a name or size that does not work.
    Spd(SpdError),
    /// `spd:NAME:` with a size that is not a number.
    Size(String),
    /// The file cannot be read.
    Io {
        /// The file as the user gave it.
        path: String,
        /// What the system says.
        error: io::Error,
    },
    /// The file is not a scene.
    Parse {
        /// The file as the user gave it.
        path: String,
        /// Where and why.
        error: ParseError,
    },
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownScene(name) => write!(
                f,
                "unknown scene \"{}\": give spd:NAME[:SIZE], a file that ends in .nff or .obj, \
                 or the name of a built-in scene (host-sim scenes lists them)",
                name.escape_debug()
            ),
            Self::Spd(error) => error.fmt(f),
            Self::Size(scene) => write!(
                f,
                "{}: the size is not a whole number: give spd:NAME or spd:NAME:SIZE",
                scene.escape_debug()
            ),
            Self::Io { path, error } => write!(f, "{}: {error}", path.escape_debug()),
            Self::Parse { path, error } => {
                write!(f, "{}:{}: {}", path.escape_debug(), error.line, error.message)
            }
        }
    }
}

impl std::error::Error for LoadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Spd(error) => Some(error),
            Self::Io { error, .. } => Some(error),
            // Its line and reason are in the message already.
            Self::Parse { .. } | Self::UnknownScene(_) | Self::Size(_) => None,
        }
    }
}

/// The scene that `scene` names: `spd:NAME`, `spd:NAME:SIZE`, a built-in scene, or the path of an
/// NFF or OBJ file.
///
/// # Errors
/// [`LoadError::UnknownScene`] for any other name; a size, file or text that does not work.
pub fn load(scene: &str) -> Result<Description, LoadError> {
    let description = if let Some(spec) = scene.strip_prefix("spd:") {
        generated(scene, spec)?
    } else if let Some(demo) = demo::find(scene) {
        demo.describe()
    } else {
        let extension = Path::new(scene).extension().and_then(|it| it.to_str()).unwrap_or("");
        let parse = match extension.to_ascii_lowercase().as_str() {
            "nff" => nff::parse_bytes,
            "obj" => obj::parse_bytes,
            _ => return Err(LoadError::UnknownScene(scene.into())),
        };
        let bytes =
            std::fs::read(scene).map_err(|error| LoadError::Io { path: scene.into(), error })?;
        parse(&bytes).map_err(|error| LoadError::Parse { path: scene.into(), error })?
    };
    Ok(Description { name: scene.into(), ..description })
}

/// Generates `NAME[:SIZE]`, through the very text that would be printed.
fn generated(scene: &str, spec: &str) -> Result<Description, LoadError> {
    let (name, size) = match spec.split_once(':') {
        Some((name, size)) => (name, Some(size)),
        None => (spec, None),
    };
    let generator = spd::find(name).map_err(LoadError::Spd)?;
    let size = match size {
        Some(size) => size.parse().map_err(|_| LoadError::Size(scene.into()))?,
        None => generator.default_size,
    };
    let mut text = Vec::new();
    generator.generate(size, &mut text).map_err(LoadError::Spd)?;
    nff::parse_bytes(&text).map_err(|error| LoadError::Parse { path: scene.into(), error })
}
