//! Our extension of the Neutral File Format: closed solids, combinations, and maps.
//!
//! | statement | what it is |
//! |---|---|
//! | `box x y z x y z` | an axis-aligned box between two corners |
//! | `cone x y z radius x y z radius` | as `c`, closed by discs; a cylinder where the radii are equal |
//! | `polyhedron n`, then n times `x y z nx ny nz` | what is behind all of n planes: a point of each, and its normal out of the solid |
//! | `halfspace x y z nx ny nz` | what is behind one plane; only inside a combination |
//! | `plane x y z nx ny nz` | an infinite plane; no solid, so not inside a combination |
//! | `union` … `end`, `intersection` … `end`, `difference` … `end` | one object of all solids between, the balls `s` included; the difference is the first without all others |
//! | `translate x y z` … `end`, `scale x y z` … `end`, `rotate x y z degrees` … `end` | everything between is moved, stretched along the axes, turned around an axis through the origin (anticlockwise, seen from its end) |
//! | `transform` and 12 numbers … `end` | everything between goes where this says: the images of the directions x, y and z and of the origin |
//!
//! Blocks may be put into each other in any way; of several maps the innermost is done first. Every
//! solid outside of combinations, and every outermost combination, is a primitive and counts one id.
//! It has the surface of the last `f`; views, lights, fills and backgrounds stand outside of blocks,
//! `f` may stand inside of maps.

use super::nff::Reader;
use super::nff_write::g;
use super::parse::ParseError;
use super::solids::{Body, Map, Operator, Part, Step};
use super::{Solid, Triple};

/// A block that is not closed yet.
pub(super) struct Block {
    /// Where it began, and with which word.
    line: usize,
    keyword: &'static str,
    kind: Kind,
}

enum Kind {
    Combination {
        operator: Operator,
        operands: usize,
    },
    /// The map that holds outside of the block.
    Map(Map),
}

/// What blocks make of what stands in them.
pub(super) struct Blocks {
    open: Vec<Block>,
    map: Map,
    /// Of the combination that is being read.
    steps: Vec<Step>,
}

impl Blocks {
    pub(super) fn new() -> Self {
        Self { open: Vec::new(), map: Map::IDENTITY, steps: Vec::new() }
    }

    /// The innermost combination.
    fn combination(&mut self) -> Option<(&'static str, Operator, &mut usize)> {
        self.open.iter_mut().rev().find_map(|block| match &mut block.kind {
            Kind::Combination { operator, operands } => Some((block.keyword, *operator, operands)),
            Kind::Map(_) => None,
        })
    }

    /// Another operand of the innermost combination is complete.
    fn count(&mut self) {
        let Some((_, operator, operands)) = self.combination() else { return };
        *operands += 1;
        if *operands > 1 {
            self.steps.push(Step::Join(operator));
        }
    }

    /// Refuses what cannot stand in a combination.
    pub(super) fn outside_of_combinations(
        &mut self,
        line: usize,
        what: &str,
    ) -> Result<(), ParseError> {
        match self.combination() {
            None => Ok(()),
            Some((keyword, ..)) => {
                Err(ParseError::new(line, format!("{what} inside of a {keyword}")))
            }
        }
    }

    /// Refuses what cannot stand in a block.
    pub(super) fn outside(&self, line: usize, what: &str) -> Result<(), ParseError> {
        match self.open.last() {
            None => Ok(()),
            Some(block) => {
                let message = format!("{what} inside of a {}: close it by \"end\"", block.keyword);
                Err(ParseError::new(line, message))
            }
        }
    }

    /// At the end of the file.
    pub(super) fn check_closed(&self) -> Result<(), ParseError> {
        match self.open.last() {
            None => Ok(()),
            Some(Block { line, keyword, .. }) => {
                Err(ParseError::new(*line, format!("{keyword} is not closed: \"end\" is missing")))
            }
        }
    }
}

impl Reader<'_> {
    /// Reads a statement of the extension; `false` where it is none.
    pub(super) fn extension(&mut self, line: usize, keyword: &str) -> Result<bool, ParseError> {
        match keyword {
            "box" => {
                let [a, b, c, u, v, w] =
                    self.numbers(line, &"box needs 6 numbers \"box x y z x y z\"")?;
                let lo = [a.min(u), b.min(v), c.min(w)];
                self.part(Body::Box { lo, hi: [a.max(u), b.max(v), c.max(w)] });
            }
            "cone" => {
                let form = "cone needs 8 numbers \"cone x y z radius x y z radius\"";
                let [x, y, z, a, u, v, w, b] = self.numbers(line, &form)?;
                self.part(Body::Cone {
                    base: [x, y, z],
                    base_radius: a.abs(),
                    apex: [u, v, w],
                    apex_radius: b.abs(),
                });
            }
            "polyhedron" => self.polyhedron(line)?,
            "halfspace" => {
                let form = "halfspace needs 6 numbers \"halfspace x y z nx ny nz\"";
                let face = self.face(line, &form)?;
                if self.blocks.combination().is_none() {
                    let message =
                        "a halfspace has no end: put it into an intersection or difference";
                    return Err(ParseError::new(line, message));
                }
                self.part(Body::HalfSpace { face });
            }
            "plane" => {
                let form = "plane needs 6 numbers \"plane x y z nx ny nz\"";
                let [point, normal] = self.face(line, &form)?;
                let what = "plane is no solid: no place for it";
                self.blocks.outside_of_combinations(line, what)?;
                let map = self.blocks.map;
                self.add(Solid::Plane { point: map.point(point), normal: map.normal(normal) });
            }
            "union" => self.combine(line, "union", Operator::Union),
            "intersection" => self.combine(line, "intersection", Operator::Intersection),
            "difference" => self.combine(line, "difference", Operator::Difference),
            "translate" => {
                let by = self.numbers(line, &"translate needs 3 numbers \"translate x y z\"")?;
                self.map(line, "translate", &Map::translation(by))?;
            }
            "scale" => {
                let by = self.numbers(line, &"scale needs 3 numbers \"scale x y z\"")?;
                self.map(line, "scale", &Map::scaling(by))?;
            }
            "rotate" => {
                let form = "rotate needs 4 numbers \"rotate x y z degrees\"";
                let [x, y, z, degrees] = self.numbers(line, &form)?;
                let map = Map::rotation([x, y, z], degrees).ok_or_else(|| {
                    ParseError::new(line, "rotate needs an axis that is not 0 0 0")
                })?;
                self.map(line, "rotate", &map)?;
            }
            "transform" => {
                let form = "transform needs 12 numbers: the images of x, y, z and of the origin";
                let v: [f64; 12] = self.numbers(line, &form)?;
                let image = |i: usize| [v[i], v[i + 1], v[i + 2]];
                let map = Map { axes: [image(0), image(3), image(6)], origin: image(9) };
                self.map(line, "transform", &map)?;
            }
            "end" => self.close(line)?,
            _ => return Ok(false),
        }
        Ok(true)
    }

    /// A point and a normal.
    fn face(
        &mut self,
        line: usize,
        form: &dyn std::fmt::Display,
    ) -> Result<[Triple; 2], ParseError> {
        let [x, y, z, a, b, c] = self.numbers(line, form)?;
        check_normal(line, [a, b, c])?;
        Ok([[x, y, z], [a, b, c]])
    }

    fn polyhedron(&mut self, line: usize) -> Result<(), ParseError> {
        let form = "polyhedron needs its number of faces \"polyhedron n\"";
        let [count] = self.numbers(line, &form)?;
        let room = self.tokens.bytes_left() / 12 + 1;
        if count.fract() != 0.0 || count < 4.0 {
            let message =
                format!("a polyhedron has a whole number of faces, 4 or more, not {}", g(count));
            return Err(ParseError::new(line, message));
        }
        if count > room as f64 {
            let message =
                format!("a polyhedron of {} faces, more than the rest of the file holds", g(count));
            return Err(ParseError::new(line, message));
        }
        let count = count as usize;
        let form = format_args!("a polyhedron of {count} faces needs {} numbers", count * 6);
        let faces = (0..count).map(|i| {
            let [x, y, z, a, b, c] = self.more_numbers(line, &form, i * 6)?;
            check_normal(line, [a, b, c])?;
            Ok([[x, y, z], [a, b, c]])
        });
        let faces = faces.collect::<Result<_, ParseError>>()?;
        self.part(Body::Polyhedron { faces });
        Ok(())
    }

    /// A closed solid: an operand of the combination that is open, or a primitive.
    pub(super) fn part(&mut self, body: Body) {
        let part = Part::new(body, &self.blocks.map);
        if self.blocks.combination().is_none() {
            self.add(part.into_solid());
        } else {
            self.blocks.steps.push(Step::Part(part));
            self.blocks.count();
        }
    }

    /// NFF's open cone, in its place.
    pub(super) fn open_cone(
        &mut self,
        line: usize,
        (base, base_radius): (Triple, f64),
        (apex, apex_radius): (Triple, f64),
    ) -> Result<(), ParseError> {
        self.blocks
            .outside_of_combinations(line, "c is open, \"cone\" is closed: no place for c")?;
        let map = self.blocks.map;
        let Some(scale) = map.similarity() else {
            let message =
                "c can only be stretched the same in all directions; \"cone\" can be at will";
            return Err(ParseError::new(line, message));
        };
        self.add(Solid::Cone {
            base: map.point(base),
            base_radius: base_radius * scale,
            apex: map.point(apex),
            apex_radius: apex_radius * scale,
            capped: false,
        });
        Ok(())
    }

    /// A polygon, in its place.
    pub(super) fn placed_polygon(
        &mut self,
        line: usize,
        vertices: Vec<Triple>,
        normals: Vec<Triple>,
    ) -> Result<(), ParseError> {
        self.blocks.outside_of_combinations(line, "a polygon is no solid: no place for it")?;
        let map = self.blocks.map;
        let solid = if map == Map::IDENTITY {
            Solid::Polygon { vertices, normals }
        } else {
            Solid::Polygon {
                vertices: vertices.into_iter().map(|v| map.point(v)).collect(),
                normals: normals.into_iter().map(|n| map.normal(n)).collect(),
            }
        };
        self.add(solid);
        Ok(())
    }

    fn combine(&mut self, line: usize, keyword: &'static str, operator: Operator) {
        let kind = Kind::Combination { operator, operands: 0 };
        self.blocks.open.push(Block { line, keyword, kind });
    }

    fn map(&mut self, line: usize, keyword: &'static str, map: &Map) -> Result<(), ParseError> {
        if map.flattens() {
            return Err(ParseError::new(
                line,
                format!("{keyword} leaves no volume: a solid needs one"),
            ));
        }
        let kind = Kind::Map(self.blocks.map);
        self.blocks.map = self.blocks.map.after(map);
        self.blocks.open.push(Block { line, keyword, kind });
        Ok(())
    }

    fn close(&mut self, line: usize) -> Result<(), ParseError> {
        let Some(block) = self.blocks.open.pop() else {
            return Err(ParseError::new(line, "\"end\" where nothing is open"));
        };
        match block.kind {
            Kind::Map(outer) => self.blocks.map = outer,
            Kind::Combination { operands: 0, .. } => {
                let message = format!("{} of nothing: put solids into it", block.keyword);
                return Err(ParseError::new(block.line, message));
            }
            Kind::Combination { .. } if self.blocks.combination().is_some() => self.blocks.count(),
            Kind::Combination { .. } => {
                let steps = std::mem::take(&mut self.blocks.steps);
                self.add(Solid::Csg { steps });
            }
        }
        Ok(())
    }
}

fn check_normal(line: usize, normal: Triple) -> Result<(), ParseError> {
    if normal == [0.0; 3] {
        return Err(ParseError::new(line, "a normal of 0 0 0 points nowhere"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::nff::parse;
    use super::*;
    use Operator::{Difference, Intersection, Union};

    /// The steps of the only primitive, spheres as their radii.
    fn steps(text: &str) -> String {
        let scene = parse(text).unwrap();
        let [item] = &scene.items[..] else { panic!("{} items", scene.items.len()) };
        let Solid::Csg { steps } = &item.solid else { panic!("{item:?}") };
        let name = |step: &Step| match step {
            Step::Part(Part { body: Body::Sphere { radius, .. }, map: None }) => radius.to_string(),
            Step::Part(part) => panic!("{part:?}"),
            Step::Join(Union) => "+".into(),
            Step::Join(Intersection) => "*".into(),
            Step::Join(Difference) => "-".into(),
        };
        steps.iter().map(name).collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn blocks_become_postfix() {
        let [a, b, c, d] = [1, 2, 3, 4].map(|r| format!("s 0 0 0 {r} "));
        assert_eq!(steps(&format!("union {a} end")), "1");
        assert_eq!(steps(&format!("difference {a}{b}{c}{d} end")), "1 2 - 3 - 4 -");
        let inner = format!("difference {a} union {b}{c} end {d} end");
        assert_eq!(steps(&inner), "1 2 3 + - 4 -");
        let first = format!("intersection union {a}{b} end difference {c}{d} end end");
        assert_eq!(steps(&first), "1 2 + 3 4 - *");
        // Solids in a map are operands of what is around it.
        let mapped = format!("difference {a} scale 2 2 2 {b} rotate 0 0 1 9 {c} end end {d} end");
        assert_eq!(steps(&mapped), "1 4 - 6 - 4 -");
    }

    #[test]
    fn maps_hold_for_everything_between() {
        let solids = |text: &str| -> Vec<Solid> {
            parse(text).unwrap().items.into_iter().map(|item| item.solid).collect()
        };
        let text = "translate 1 0 0 scale 2 2 2 s 1 0 0 1 f 1 0 0 1 0 0 0 1 c 0 0 0 1 0 0 1 0.5
                    end s 0 0 0 1 box 1 1 1 0 0 0 end plane 0 0 0 0 0 2";
        let sphere = |center, radius| Solid::Sphere { center, radius };
        let expected = [
            sphere([3.0, 0.0, 0.0], 2.0),
            Solid::Cone {
                base: [1.0, 0.0, 0.0],
                base_radius: 2.0,
                apex: [1.0, 0.0, 2.0],
                apex_radius: 1.0,
                capped: false,
            },
            sphere([1.0, 0.0, 0.0], 1.0),
            Solid::Box { lo: [1.0, 0.0, 0.0], hi: [2.0, 1.0, 1.0] },
            Solid::Plane { point: [0.0; 3], normal: [0.0, 0.0, 2.0] },
        ];
        assert_eq!(solids(text), expected);
        assert_eq!(parse(text).unwrap().materials.len(), 2);
        let text = "rotate 0 0 1 90 p 3 1 0 0 2 0 0 0 0 1 end transform 0 1 0 0 0 1 1 0 0 5 0 0
                    s 1 2 3 1 end";
        let vertices = vec![[0.0, 1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]];
        let polygon = Solid::Polygon { vertices, normals: vec![] };
        assert_eq!(solids(text), [polygon, sphere([8.0, 1.0, 2.0], 1.0)]);
    }

    #[test]
    fn scenes_that_are_built_in_are_scenes() {
        let texts: Vec<_> = super::super::demo::all().iter().filter_map(|it| it.text()).collect();
        assert_eq!(texts.len(), 3);
        for text in texts {
            let scene = parse(text).unwrap();
            assert!(scene.view.is_some() && scene.lights.len() > 1 && scene.items.len() > 5);
        }
    }
}
