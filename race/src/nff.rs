//! Scenes of the Neutral File Format as POV-Ray 3.7 and Tachyon 0.99 read them.
//!
//! Shading as near as each comes: diffuse, Phong, mirrors, transparency, shadows, five levels. The
//! NFF reader of Tachyon will not do: it ignores the angle of view and makes each light a sphere
//! that rays hit. It has no cones: they become cylinders of the mean radius. Its polygons are cut
//! into triangles. Its pictures are mirrored.

use crate::mesh::{cross, dot, sub, unit};
use anyhow::{Context, Result, bail};
use std::fmt::Write;

type P = [f64; 3];

enum Thing {
    Sphere(P, f64),
    Cone(P, f64, P, f64),
    Polygon(Vec<P>),
    /// Corners and normals.
    Patch(Vec<(P, P)>),
}

/// A scene.
#[derive(Default)]
pub struct Nff {
    background: P,
    from: P,
    at: P,
    up: P,
    angle: f64,
    lights: Vec<P>,
    things: Vec<(usize, Thing)>,
    fills: Vec<[f64; 8]>,
}

fn point(a: &[f64]) -> Result<P> {
    a.get(..3).and_then(|a| a.try_into().ok()).context("three numbers expected")
}

impl Nff {
    /// Reads what `host-sim scene` writes.
    pub fn parse(text: &str) -> Result<Self> {
        let mut nff = Self::default();
        let mut lines = text.lines().filter(|line| !line.trim().is_empty());
        let numbers = |words: &str| -> Result<Vec<f64>> {
            Ok(words.split_whitespace().map(str::parse).collect::<Result<_, _>>()?)
        };
        while let Some(line) = lines.next() {
            let (key, rest) = line.split_once(' ').unwrap_or((line, ""));
            if key == "v" || key.starts_with('#') {
                continue;
            }
            let mut a = numbers(rest)?;
            let fill = nff.fills.len().wrapping_sub(1);
            match key {
                "b" => nff.background = point(&a)?,
                "from" => nff.from = point(&a)?,
                "at" => nff.at = point(&a)?,
                "up" => nff.up = point(&a)?,
                "angle" => nff.angle = *a.first().context("an angle expected")?,
                "hither" | "resolution" => {}
                "l" => nff.lights.push(point(&a)?),
                "f" => nff.fills.push(a.get(..8).context("a short fill")?.try_into()?),
                "s" => nff.things.push((fill, Thing::Sphere(point(&a)?, a[3]))),
                "c" => {
                    while a.len() < 8 {
                        a.extend(numbers(lines.next().context("a short cone")?)?);
                    }
                    nff.things.push((fill, Thing::Cone(point(&a)?, a[3], point(&a[4..])?, a[7])));
                }
                "p" | "pp" => {
                    let corners: Vec<_> = lines.by_ref().take(a[0] as usize).collect();
                    let corners = corners.into_iter().map(numbers).collect::<Result<Vec<_>>>()?;
                    let thing = if key == "p" {
                        Thing::Polygon(corners.iter().map(|c| point(c)).collect::<Result<_>>()?)
                    } else {
                        let both = |c: &Vec<f64>| Ok((point(c)?, point(&c[3..])?));
                        Thing::Patch(corners.iter().map(both).collect::<Result<_>>()?)
                    };
                    nff.things.push((fill, thing));
                }
                _ => bail!("what is {key:?}?"),
            }
        }
        Ok(nff)
    }

    /// Number of shapes.
    pub fn len(&self) -> usize {
        self.things.len()
    }

    /// Each light of so much.
    fn light(&self) -> f64 {
        1.0 / (self.lights.len() as f64).sqrt()
    }

    /// The scene for POV-Ray.
    pub fn povray(&self) -> String {
        let vec = |p: &P| format!("<{},{},{}>", p[0], p[1], p[2]);
        let forward = unit(sub(self.at, self.from));
        let right = unit(cross(forward, self.up));
        let half = 2.0 * (self.angle / 2.0).to_radians().tan();
        let scaled = |a: P| a.map(|x| half * x);
        let mut out = format!(
            "#version 3.7;\nglobal_settings {{ assumed_gamma 1 max_trace_level 5 }}\n\
             camera {{ perspective location {} direction {} right {} up {} }}\n\
             background {{ rgb {} }}\n",
            vec(&self.from),
            vec(&forward),
            vec(&scaled(right)),
            vec(&scaled(cross(right, forward))),
            vec(&self.background)
        );
        for at in &self.lights {
            let _ = writeln!(out, "light_source {{ {} rgb {} }}", vec(at), self.light());
        }
        for (fill, thing) in &self.things {
            let [r, g, b, kd, ks, shine, t, ior] = self.fills[*fill];
            let mut look = format!(
                " texture {{ pigment {{ rgbf <{r},{g},{b},{t}> }} finish {{ ambient 0 diffuse {kd} \
                 phong {ks} phong_size {} reflection {ks} }} }}",
                shine.min(1e4)
            );
            if t > 0.0 {
                let _ = write!(look, " interior {{ ior {ior} }}");
            }
            let list = |points: &[P]| points.iter().map(vec).collect::<Vec<_>>().join(", ");
            let _ = match thing {
                Thing::Sphere(c, r) => writeln!(out, "sphere {{ {}, {r}{look} }}", vec(c)),
                Thing::Cone(a, r, b, s) if (r - s).abs() < 1e-9 => {
                    writeln!(out, "cylinder {{ {}, {}, {r} open{look} }}", vec(a), vec(b))
                }
                Thing::Cone(a, r, b, s) => {
                    writeln!(out, "cone {{ {}, {r}, {}, {s} open{look} }}", vec(a), vec(b))
                }
                Thing::Polygon(p) if p.len() == 3 => {
                    writeln!(out, "triangle {{ {}{look} }}", list(p))
                }
                Thing::Polygon(p) => {
                    let (n, first) = (p.len() + 1, vec(&p[0]));
                    writeln!(out, "polygon {{ {n}, {}, {first}{look} }}", list(p))
                }
                Thing::Patch(p) => (1..p.len() - 1).try_for_each(|i| {
                    let corners = [p[0], p[i], p[i + 1]].map(|(c, n)| list(&[c, n]));
                    writeln!(out, "smooth_triangle {{ {}{look} }}", corners.join(", "))
                }),
            };
        }
        out
    }

    /// The scene for Tachyon.
    pub fn tachyon(&self) -> String {
        let vec = |p: &P| format!("{:.9} {:.9} {:.9}", p[0], p[1], p[2]);
        let mut out = format!(
            "Begin_Scene\nResolution 512 512\nCamera\n  Zoom {:.9}\n  Aspectratio 1.0\n  \
             Antialiasing 0\n  Raydepth 5\n  Center {}\n  Viewdir {}\n  Updir {}\nEnd_Camera\n\
             Background {}\n",
            0.5 / (self.angle / 2.0).to_radians().tan(),
            vec(&self.from),
            vec(&sub(self.at, self.from)),
            vec(&self.up),
            vec(&self.background)
        );
        for at in &self.lights {
            let color = vec(&[self.light(); 3]);
            let _ = writeln!(out, "Light Center {} Rad 0.000001 Color {color}", vec(at));
        }
        for (i, [r, g, b, kd, ks, shine, t, _]) in self.fills.iter().enumerate() {
            let _ = writeln!(
                out,
                "TexDef F{i} Ambient 0.0 Diffuse {kd} Specular {ks} Opacity {} Phong Plastic {ks} \
                 Phong_size {} Color {r} {g} {b} TexFunc 0",
                1.0 - t,
                shine.clamp(1.0, 1e4)
            );
        }
        for (f, thing) in &self.things {
            let _ = match thing {
                Thing::Sphere(c, r) => writeln!(out, "Sphere Center {} Rad {r:.9} F{f}", vec(c)),
                Thing::Cone(a, r, b, s) => {
                    let (a, b, r) = (vec(a), vec(b), (r + s) / 2.0);
                    writeln!(out, "FCylinder Base {a} Apex {b} Rad {r:.9} F{f}")
                }
                Thing::Polygon(p) => ears(p).iter().try_for_each(|t| {
                    let [a, b, c] = t.map(|p| vec(&p));
                    writeln!(out, "Tri V0 {a} V1 {b} V2 {c} F{f}")
                }),
                Thing::Patch(p) => (1..p.len() - 1).try_for_each(|i| {
                    let c = [p[0], p[i], p[i + 1]].map(|(c, _)| vec(&c));
                    let n = [p[0], p[i], p[i + 1]].map(|(_, n)| vec(&n));
                    write!(out, "STri V0 {} V1 {} V2 {} ", c[0], c[1], c[2])?;
                    writeln!(out, "N0 {} N1 {} N2 {} F{f}", n[0], n[1], n[2])
                }),
            };
        }
        out + "End_Scene\n"
    }
}

/// A plane polygon as triangles: one ear after the other is clipped.
fn ears(polygon: &[P]) -> Vec<[P; 3]> {
    let mut left = polygon.to_vec();
    let mut normal = [0.0; 3];
    for (i, p) in left.iter().enumerate() {
        let n = cross(left[(i + left.len() - 1) % left.len()], *p);
        normal = [0, 1, 2].map(|k| normal[k] + n[k]);
    }
    // Positive where c is to the left of a to b, as the polygon turns.
    let side = |a: P, b: P, c: P| dot(cross(sub(b, a), sub(c, a)), normal);
    let mut out = vec![];
    while left.len() > 3 {
        let n = left.len();
        let corner = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
        let is_ear = |&i: &usize| {
            let [a, b, c] = corner(i);
            let inside = |p: &P| {
                ![a, b, c].contains(p)
                    && side(a, b, *p) >= 0.0
                    && side(b, c, *p) >= 0.0
                    && side(c, a, *p) >= 0.0
            };
            side(a, b, c) > 0.0 && !left.iter().any(inside)
        };
        // A degenerate polygon may have none: then any will do.
        let i = (0..n).find(is_ear).unwrap_or(0);
        out.push(corner(i));
        left.remove(i);
    }
    if let [a, b, c] = left[..] {
        out.push([a, b, c]);
    }
    out
}
