//! Reading the Neutral File Format.
//!
//! Format: E. Haines, "NFF.TXT", in the Standard Procedural Databases. Statements are read token by
//! token, so they may be broken into lines in any way; numbers must be finite. Where a rule only
//! matters to renderers that see one side of a surface it is not enforced: the sign of a radius is
//! dropped, a cone's apex may be the wider end.

use std::collections::HashMap;
use std::fmt::Display;

use super::nff_solids::Blocks;
use super::nff_write::g;
use super::parse::{ParseError, Tokens, number, quoted, text};
use super::solids::Body;
use super::{Description, Item, Light, Material, Solid, Triple, View};

/// What primitives look like before the first `f`.
pub(super) const DEFAULT_MATERIAL: Material = Material {
    color: [1.0; 3],
    diffuse: 0.8,
    specular: 0.0,
    shine: 0.0,
    transmission: 0.0,
    index: 1.0,
};

/// Reads the bytes of a file.
///
/// # Errors
/// As [`parse`], and text that is not UTF-8.
pub fn parse_bytes(bytes: &[u8]) -> Result<Description, ParseError> {
    parse(text(bytes)?)
}

/// Reads a scene; its name stays empty.
///
/// # Errors
/// The first statement that is unknown, incomplete or has a number that makes no sense.
pub fn parse(text: &str) -> Result<Description, ParseError> {
    let mut reader = Reader::new(text);
    while let Some((line, keyword)) = reader.tokens.next() {
        reader.statement(line, keyword)?;
    }
    reader.blocks.check_closed()?;
    Ok(reader.scene)
}

pub(super) struct Reader<'a> {
    pub(super) tokens: Tokens<'a>,
    /// What is open of our extension.
    pub(super) blocks: Blocks,
    scene: Description,
    has_background: bool,
    material: Option<usize>,
    /// Materials by the bits of their numbers.
    known: HashMap<[u64; 8], usize>,
}

impl<'a> Reader<'a> {
    fn new(text: &'a str) -> Self {
        Self {
            tokens: Tokens::new(text),
            blocks: Blocks::new(),
            scene: Description::default(),
            has_background: false,
            material: None,
            known: HashMap::new(),
        }
    }

    fn statement(&mut self, line: usize, keyword: &str) -> Result<(), ParseError> {
        match keyword {
            "b" => self.background(line),
            "v" => self.view(line),
            "l" => self.light(line),
            "f" => {
                self.blocks.outside_of_combinations(line, "one surface for the whole: no f")?;
                let form = "fill needs 8 numbers \"f r g b Kd Ks shine T ior\"";
                let numbers = self.numbers(line, &form)?;
                self.material = Some(self.intern(numbers));
                Ok(())
            }
            "s" => {
                let [x, y, z, r] =
                    self.numbers(line, &"sphere needs 4 numbers \"s x y z radius\"")?;
                self.part(Body::Sphere { center: [x, y, z], radius: r.abs() });
                Ok(())
            }
            "c" => {
                let form = "cone needs 8 numbers \"c x y z radius x y z radius\"";
                let [x, y, z, base_radius, u, v, w, apex_radius] = self.numbers(line, &form)?;
                let (base, apex) = ([x, y, z], [u, v, w]);
                self.open_cone(line, (base, base_radius.abs()), (apex, apex_radius.abs()))
            }
            "p" => self.polygon(line, false),
            "pp" => self.polygon(line, true),
            _ if keyword.parse::<f64>().is_ok() => Err(ParseError::new(
                line,
                format!(
                    "{} is one number too many: a statement was to begin here",
                    quoted(keyword)
                ),
            )),
            _ if self.extension(line, keyword)? => Ok(()),
            _ => Err(ParseError::new(
                line,
                format!(
                    "unknown statement {}: NFF has b v l f s c p pp and #, and there are box cone \
                     polyhedron halfspace plane, union intersection difference, translate rotate \
                     scale transform, end",
                    quoted(keyword)
                ),
            )),
        }
    }

    /// `N` numbers of the statement that began at `line`; `form` says what it needs.
    pub(super) fn numbers<const N: usize>(
        &mut self,
        line: usize,
        form: &dyn Display,
    ) -> Result<[f64; N], ParseError> {
        self.more_numbers(line, form, 0)
    }

    /// The same where `before` numbers have been read.
    pub(super) fn more_numbers<const N: usize>(
        &mut self,
        line: usize,
        form: &dyn Display,
        before: usize,
    ) -> Result<[f64; N], ParseError> {
        let mut values = [0.0; N];
        for (i, value) in values.iter_mut().enumerate() {
            *value = self.number().map_err(|problem| match problem {
                Problem::NoNumber => ParseError::new(line, format!("{form}, found {}", before + i)),
                Problem::Bad(error) => error,
            })?;
        }
        Ok(values)
    }

    /// The next number. A word that begins like a statement ends the numbers and is not taken.
    fn number(&mut self) -> Result<f64, Problem> {
        let mut ahead = self.tokens.clone();
        let (line, word) = ahead.next().ok_or(Problem::NoNumber)?;
        if is_keyword(word) {
            return Err(Problem::NoNumber);
        }
        self.tokens = ahead;
        number(word, line).map_err(Problem::Bad)
    }

    fn background(&mut self, line: usize) -> Result<(), ParseError> {
        self.blocks.outside(line, "no background")?;
        if self.has_background {
            return Err(ParseError::new(line, "a second background: keep one b"));
        }
        self.scene.background = self.numbers(line, &"background needs 3 numbers \"b r g b\"")?;
        self.has_background = true;
        Ok(())
    }

    fn light(&mut self, line: usize) -> Result<(), ParseError> {
        self.blocks.outside(line, "no light")?;
        let form = "light needs 3 or 6 numbers \"l x y z [r g b]\"";
        let position = self.numbers(line, &form)?;
        let color = match self.tokens.peek() {
            Some(word) if !is_keyword(word) => {
                let form = "a light's colour needs 3 numbers \"l x y z r g b\"";
                Some(self.numbers(line, &form)?)
            }
            _ => None,
        };
        self.scene.lights.push(Light { position, color });
        Ok(())
    }

    fn view(&mut self, line: usize) -> Result<(), ParseError> {
        self.blocks.outside(line, "no view")?;
        if self.scene.view.is_some() {
            return Err(ParseError::new(line, "a second view: keep one v"));
        }
        let (mut from, mut at, mut up) = (None, None, None);
        let (mut angle, mut hither, mut resolution) = (None, None, None);
        while let Some(keyword @ ("from" | "at" | "up" | "angle" | "hither" | "resolution")) =
            self.tokens.peek()
        {
            let line = self.tokens.next().map_or(line, |(line, _)| line);
            let three = format_args!("{keyword} needs 3 numbers \"{keyword} x y z\"");
            match keyword {
                "from" => from = Some(self.numbers(line, &three)?),
                "at" => at = Some(self.numbers(line, &three)?),
                "up" => up = Some(self.numbers(line, &three)?),
                "angle" => {
                    let [degrees] = self.numbers(line, &"angle needs 1 number, in degrees")?;
                    if !(degrees > 0.0 && degrees < 180.0) {
                        let message =
                            format!("angle {} is not between 0 and 180 degrees", g(degrees));
                        return Err(ParseError::new(line, message));
                    }
                    angle = Some(degrees);
                }
                "hither" => hither = Some(self.numbers(line, &"hither needs 1 number")?),
                _ => {
                    let form = "resolution needs 2 whole numbers \"resolution width height\"";
                    let size: [f64; 2] = self.numbers(line, &form)?;
                    if size.iter().any(|n| n.fract() != 0.0 || !(1.0..=65_536.0).contains(n)) {
                        return Err(ParseError::new(line, format!("{form}, each 1 to 65536")));
                    }
                    resolution = Some(size.map(|n| n as u32));
                }
            }
        }
        let lacks = |what: &str| ParseError::new(line, format!("view lacks \"{what}\""));
        let view = View {
            from: from.ok_or_else(|| lacks("from x y z"))?,
            at: at.ok_or_else(|| lacks("at x y z"))?,
            up: up.ok_or_else(|| lacks("up x y z"))?,
            angle: angle.ok_or_else(|| lacks("angle degrees"))?,
            hither: hither.map(|[n]: [f64; 1]| n).ok_or_else(|| lacks("hither distance"))?,
            resolution: resolution.ok_or_else(|| lacks("resolution width height"))?,
        };
        check_directions(&view).map_err(|message| ParseError::new(line, message))?;
        self.scene.view = Some(view);
        Ok(())
    }

    fn polygon(&mut self, line: usize, with_normals: bool) -> Result<(), ParseError> {
        let (keyword, each) = if with_normals { ("pp", 6) } else { ("p", 3) };
        let form = format_args!("polygon needs its number of vertices \"{keyword} n\"");
        let [count] = self.numbers(line, &form)?;
        if count.fract() != 0.0 || count < 3.0 {
            let message =
                format!("a polygon has a whole number of vertices, 3 or more, not {}", g(count));
            return Err(ParseError::new(line, message));
        }
        // Every number takes two bytes at least: do not believe, nor reserve, more than can be.
        let room = self.tokens.bytes_left() / (2 * each) + 1;
        if count > room as f64 {
            let message =
                format!("a polygon of {} vertices, more than the rest of the file holds", g(count));
            return Err(ParseError::new(line, message));
        }
        let count = count as usize;
        let mut vertices = Vec::with_capacity(count);
        let mut normals = Vec::with_capacity(if with_normals { count } else { 0 });
        let needed = count * each;
        let form = format_args!("a polygon of {count} vertices needs {needed} numbers");
        for i in 0..count {
            vertices.push(self.more_numbers(line, &form, i * each)?);
            if with_normals {
                normals.push(self.more_numbers(line, &form, i * each + 3)?);
            }
        }
        self.placed_polygon(line, vertices, normals)
    }

    pub(super) fn add(&mut self, solid: Solid) {
        let material = match self.material {
            Some(material) => material,
            None => {
                let m = DEFAULT_MATERIAL;
                let [r, g, b] = m.color;
                let material =
                    self.intern([r, g, b, m.diffuse, m.specular, m.shine, m.transmission, m.index]);
                *self.material.insert(material)
            }
        };
        self.scene.items.push(Item { material, solid });
    }

    /// The place of a material, the same for the same numbers.
    fn intern(&mut self, numbers: [f64; 8]) -> usize {
        let materials = &mut self.scene.materials;
        *self.known.entry(numbers.map(f64::to_bits)).or_insert_with(|| {
            let [r, g, b, diffuse, specular, shine, transmission, index] = numbers;
            let color = [r, g, b];
            materials.push(Material { color, diffuse, specular, shine, transmission, index });
            materials.len() - 1
        })
    }
}

/// Why there is no number.
enum Problem {
    NoNumber,
    Bad(ParseError),
}

/// Words that are no attempt at a number.
fn is_keyword(word: &str) -> bool {
    word.starts_with(|c: char| c.is_ascii_alphabetic()) && word.parse::<f64>().is_err()
}

/// A view must look somewhere, with up not along the line of sight.
fn check_directions(view: &View) -> Result<(), &'static str> {
    let gaze: Triple = std::array::from_fn(|i| view.at[i] - view.from[i]);
    if gaze == [0.0; 3] {
        return Err("view looks nowhere: \"from\" and \"at\" are the same point");
    }
    let [a, b, c] = gaze;
    let [x, y, z] = view.up;
    if [b * z - c * y, c * x - a * z, a * y - b * x] == [0.0; 3] {
        return Err("view has its \"up\" along the line of sight: tilt one of them");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const VIEW: &str =
        "v\nfrom 1 2 3\nat 0 0 0\nup 0 0 1\nangle 45\nhither 1\nresolution 512 256\n";

    #[test]
    fn every_statement_is_read() {
        let text = format!(
            "# a scene\nb 0.1 0.2 0.3  \n{VIEW}l 1 1 1\nl 2 2 2 1 0.5 0\n\nf 1 0 0 .5 0.5 3 0 1.5\n\
             s 0 0 0 -2 # inside visible\nc 0 0 0 1 0 0 1 2\np 3\n0 0 0\n1 0 0\n0 1 0\n\
             pp 3\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1"
        );
        let scene = parse(&text).unwrap();
        assert_eq!(scene.background, [0.1, 0.2, 0.3]);
        let view = scene.view.unwrap();
        assert_eq!((view.from, view.at, view.up), ([1.0, 2.0, 3.0], [0.0; 3], [0.0, 0.0, 1.0]));
        assert_eq!((view.angle, view.hither, view.resolution), (45.0, 1.0, [512, 256]));
        assert_eq!(scene.lights[0], Light { position: [1.0; 3], color: None });
        assert_eq!(scene.lights[1], Light { position: [2.0; 3], color: Some([1.0, 0.5, 0.0]) });
        assert_eq!(scene.materials.len(), 1);
        assert_eq!((scene.materials[0].diffuse, scene.materials[0].index), (0.5, 1.5));
        let triangle = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let up = vec![[0.0, 0.0, 1.0]; 3];
        let solids: Vec<_> = scene.items.into_iter().map(|item| item.solid).collect();
        assert_eq!(
            solids,
            [
                Solid::Sphere { center: [0.0; 3], radius: 2.0 },
                Solid::Cone {
                    base: [0.0; 3],
                    base_radius: 1.0,
                    apex: [0.0, 0.0, 1.0],
                    apex_radius: 2.0,
                    capped: false,
                },
                Solid::Polygon { vertices: triangle.clone(), normals: vec![] },
                Solid::Polygon { vertices: triangle, normals: up },
            ]
        );
    }

    #[test]
    fn line_ends_and_breaks_do_not_matter() {
        let text = format!("{VIEW}l 1 1 1\nf 1 1 1 1 0 0 0 1\nc 0 0 0 1\n0 0 1 1\ns 0 0 0 1\n");
        let scene = parse(&text).unwrap();
        assert_eq!(scene.items.len(), 2);
        assert_eq!(parse(&text.replace('\n', "\r\n")).unwrap(), scene);
        assert_eq!(parse(&text.replace('\n', " \n\t\n")).unwrap(), scene);
        assert_eq!(parse(&text.replace(' ', "\n")).unwrap(), scene);
        assert_eq!(parse(&text.replace(' ', " # why\n")).unwrap(), scene);
        assert_eq!(parse_bytes(format!("\u{feff}{text}").as_bytes()).unwrap(), scene);
    }

    #[test]
    fn the_same_surface_is_kept_once() {
        let (a, b) = ("f 1 0 0 1 0 0 0 1\n", "f 0 1 0 1 0 0 0 1\n");
        let s = "s 0 0 0 1\n";
        let scene = parse(&[s, a, s, b, s, a, s, s].concat()).unwrap();
        assert_eq!(scene.materials.len(), 3);
        assert_eq!(scene.materials[0], DEFAULT_MATERIAL);
        let used: Vec<_> = scene.items.iter().map(|item| item.material).collect();
        assert_eq!(used, [0, 1, 2, 1, 1]);
    }

    #[test]
    fn nothing_is_a_scene_too() {
        assert_eq!(parse("").unwrap(), Description::default());
        assert_eq!(parse("# nothing").unwrap(), Description::default());
    }
}
