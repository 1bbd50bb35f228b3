//! Reading Wavefront OBJ: vertices, normals and faces; everything about looks is passed over.
//!
//! Format: Wavefront, "Object Files (.obj)", Advanced Visualizer manual, appendix B. Not by crate
//! `tobj`: its errors name no line, it keeps positions in `f32` and splits the file into models,
//! while here a face's place in the file is its id.

use super::nff::DEFAULT_MATERIAL;
use super::parse::{ParseError, number, quoted, text};
use super::{Description, Item, Solid, Triple};

/// Statements that say nothing about shapes of surfaces.
const PASSED_OVER: [&str; 17] = [
    "vt",
    "o",
    "g",
    "s",
    "mg",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "l",
    "p",
    "lod",
    "bevel",
    "c_interp",
    "d_interp",
    "shadow_obj",
    "trace_obj",
];

/// Reads the bytes of a file.
///
/// # Errors
/// As [`parse`], and text that is not UTF-8.
pub fn parse_bytes(bytes: &[u8]) -> Result<Description, ParseError> {
    parse(text(bytes)?)
}

/// Reads a scene; its name stays empty, and there is neither view nor light.
///
/// # Errors
/// The first line that is not understood, or asks for a vertex or normal that is not there yet.
pub fn parse(text: &str) -> Result<Description, ParseError> {
    let mut reader = Reader::default();
    let mut lines = text.lines().enumerate();
    while let Some((index, line)) = lines.next() {
        let Some(begun) = continued(line) else {
            reader.statement(index + 1, line)?;
            continue;
        };
        let mut joined = String::from(begun);
        for (_, next) in lines.by_ref() {
            joined.push(' ');
            let Some(more) = continued(next) else {
                joined.push_str(next);
                break;
            };
            joined.push_str(more);
        }
        reader.statement(index + 1, &joined)?;
    }
    if !reader.scene.items.is_empty() {
        reader.scene.materials.push(DEFAULT_MATERIAL);
    }
    Ok(reader.scene)
}

/// The line without the backslash that joins the next one to it; one in a comment joins nothing.
fn continued(line: &str) -> Option<&str> {
    line.trim_end().strip_suffix('\\').filter(|begun| !begun.contains('#'))
}

#[derive(Default)]
struct Reader {
    scene: Description,
    positions: Vec<Triple>,
    normals: Vec<Triple>,
}

impl Reader {
    fn statement(&mut self, line: usize, text: &str) -> Result<(), ParseError> {
        let text = text.split('#').next().unwrap_or("");
        let mut words = text.split_ascii_whitespace();
        match words.next() {
            None => Ok(()),
            Some("v") => {
                self.positions.push(triple(words, line, "vertex needs 3 numbers \"v x y z\"")?);
                Ok(())
            }
            Some("vn") => {
                self.normals.push(triple(words, line, "normal needs 3 numbers \"vn x y z\"")?);
                Ok(())
            }
            Some("f" | "fo") => self.face(line, words),
            Some(word) if PASSED_OVER.contains(&word) => Ok(()),
            Some(word) => Err(ParseError::new(
                line,
                format!(
                    "unknown or unsupported statement {}: only polygons are read",
                    quoted(word)
                ),
            )),
        }
    }

    fn face<'a>(
        &mut self,
        line: usize,
        corners: impl Iterator<Item = &'a str>,
    ) -> Result<(), ParseError> {
        let mut vertices = Vec::new();
        let mut normals = Vec::new();
        for corner in corners {
            let mut parts = corner.split('/');
            let place = resolve(parts.next(), self.positions.len(), "vertex", line)?;
            vertices.push(self.positions[place]);
            // Texture coordinates are passed over, but not nonsense in their place.
            if let Some(texture) = parts.next().filter(|part| !part.is_empty()) {
                integer(texture, line)?;
            }
            if let Some(normal) = parts.next() {
                let place = resolve(Some(normal), self.normals.len(), "normal", line)?;
                normals.push(self.normals[place]);
            }
            if parts.next().is_some() {
                let message = format!("corner {} is not v, v/vt, v//vn or v/vt/vn", quoted(corner));
                return Err(ParseError::new(line, message));
            }
        }
        if vertices.len() < 3 {
            let message = format!("face needs 3 corners or more, found {}", vertices.len());
            return Err(ParseError::new(line, message));
        }
        if !normals.is_empty() && normals.len() != vertices.len() {
            let message = "either every corner of a face has a normal or none has";
            return Err(ParseError::new(line, message));
        }
        let solid = if vertices.len() == 3 {
            Solid::Polygon { vertices, normals }
        } else {
            Solid::Fan { vertices, normals }
        };
        self.scene.items.push(Item { material: 0, solid });
        Ok(())
    }
}

/// Three finite numbers; more (weight, vertex colour) must be numbers and are passed over.
fn triple<'a>(
    words: impl Iterator<Item = &'a str>,
    line: usize,
    form: &str,
) -> Result<Triple, ParseError> {
    let mut values = [0.0; 3];
    let mut found = 0;
    for word in words {
        let value = number(word, line)?;
        if let Some(slot) = values.get_mut(found) {
            *slot = value;
        }
        found += 1;
    }
    if found < 3 {
        return Err(ParseError::new(line, format!("{form}, found {found}")));
    }
    Ok(values)
}

fn integer(word: &str, line: usize) -> Result<i64, ParseError> {
    let message = || format!("{} is not a whole number: a face takes indices", quoted(word));
    word.parse().map_err(|_| ParseError::new(line, message()))
}

/// The place in a list of `count` that an index means: from 1 on, or backwards from -1.
fn resolve(word: Option<&str>, count: usize, what: &str, line: usize) -> Result<usize, ParseError> {
    let index = integer(word.unwrap_or(""), line)?;
    let place = match index {
        1.. => usize::try_from(index - 1).ok(),
        0 => None,
        _ => usize::try_from(index.unsigned_abs()).ok().and_then(|back| count.checked_sub(back)),
    };
    place.filter(|place| *place < count).ok_or_else(|| {
        ParseError::new(line, format!("{what} {index} is not there: {count} are known, from 1 on"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Triple; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    #[test]
    fn all_ways_to_write_a_corner_mean_the_same() {
        let head = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";
        for (face, normals) in [
            ("f 1 2 3", 0),
            ("f 1/1 2/1 3/1", 0),
            ("f 1//1 2//1 3//1", 3),
            ("f 1/1/1 2/1/1 3/1/1", 3),
            ("f -3 -2 -1", 0),
            ("f -3//-1 -2//-1 -1//-1 # comment", 3),
            ("f 1 \\\n 2 \\\n 3", 0),
            ("# C:\\\nf 1 2 3\r", 0),
        ] {
            let scene = parse(&format!("{head}{face}\n")).unwrap();
            let normals = vec![[0.0, 0.0, 1.0]; normals];
            let solid = Solid::Polygon { vertices: TRIANGLE.to_vec(), normals };
            assert_eq!(scene.items, [Item { material: 0, solid }], "{face}");
            assert_eq!(scene.view, None);
        }
    }

    #[test]
    fn a_face_is_one_primitive_however_many_corners_it_has() {
        let text = "mtllib a.mtl\no box\nv 0 0 0 1\nv 1 0 0 0.5 0.5 0.5\nv 1 1 0\nv 0 1 0\n\
                    g side\nusemtl red\ns off\nf 1 2 3 4\nf 4 3 2\nf -4 -3 -2 -1 1\n";
        let scene = parse(text).unwrap();
        let corners = scene.items.iter().map(|item| match &item.solid {
            Solid::Fan { vertices, .. } => vertices.len(),
            Solid::Polygon { vertices, .. } => vertices.len() + 100,
            other => panic!("{other:?}"),
        });
        assert_eq!(corners.collect::<Vec<_>>(), [4, 103, 5]);
        assert_eq!(scene.materials.len(), 1);
    }

    #[test]
    fn nothing_is_a_scene_too() {
        assert_eq!(parse("").unwrap(), Description::default());
        assert_eq!(parse_bytes(b"\xef\xbb\xbf# empty\n").unwrap(), Description::default());
    }
}
