//! The generators print what the original programs of the Standard Procedural Databases print.

use std::path::Path;

use kibiray_host_sim::description::load::load;
use kibiray_host_sim::description::{Solid, nff, spd};

/// Numbers closer to zero than this come from the maths library's last bits; they count as 0.
const NOTHING: f64 = 1e-12;

fn generated(name: &str, size: u32) -> String {
    let mut text = Vec::new();
    spd::generate(name, size, &mut text).unwrap();
    String::from_utf8(text).unwrap()
}

/// Words separated by one space, numbers next to zero as `0`.
fn normalised(text: &str) -> String {
    let mut all = String::with_capacity(text.len());
    for line in text.lines() {
        let words = line.split_ascii_whitespace().map(|word| match word.parse::<f64>() {
            Ok(number) if number.abs() < NOTHING => "0",
            _ => word,
        });
        all.push_str(&words.collect::<Vec<_>>().join(" "));
        all.push('\n');
    }
    all
}

#[test]
fn small_scenes_equal_the_reference_files() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/spd");
    let mut compared = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "nff") {
            continue;
        }
        let stem = path.file_stem().unwrap().to_str().unwrap();
        let (name, size) = stem.split_once('-').unwrap();
        let size = size.parse().unwrap();
        let printed = std::fs::read_to_string(&path).unwrap();
        let (ours, theirs) = (normalised(&generated(name, size)), normalised(&printed));
        for (i, (ours, theirs)) in ours.lines().zip(theirs.lines()).enumerate() {
            assert_eq!(ours, theirs, "{stem}, line {}", i + 1);
        }
        assert_eq!(ours.lines().count(), theirs.lines().count(), "{stem}");

        let scene = load(&format!("spd:{name}:{size}")).unwrap();
        let count = spd::primitives(name, size).unwrap();
        assert_eq!(scene.items.len() as u64, count, "{stem}");
        assert_eq!(nff::parse(&printed).unwrap().items.len() as u64, count, "{stem}");
        compared += 1;
    }
    assert_eq!(compared, 8);
}

/// CRC-32 of the normalised files of the original programs.
const SUMS: [(&str, u32, u32); 16] = [
    ("balls", 1, 0xf6cb_0b05),
    ("balls", 3, 0xec8c_23d7),
    ("balls", 4, 0xf66b_faf8),
    ("gears", 2, 0xc787_2747),
    ("gears", 4, 0x1c3f_8e06),
    ("mount", 6, 0x58fa_309d),
    ("rings", 3, 0xd3dc_ab0d),
    ("rings", 7, 0x6bad_dd4b),
    ("teapot", 12, 0x2952_f7e0),
    ("tetra", 3, 0x8ba5_7cac),
    ("tetra", 6, 0x7c9f_2b96),
    ("tree", 7, 0x1820_fd48),
    ("tree", 11, 0x0a38_160c),
    ("lattice", 12, 0xbab0_460c),
    ("shells", 5, 0xab17_2292),
    ("sombrero", 1, 0x4165_ad20),
];

#[test]
fn larger_scenes_have_the_sums_of_the_original_output() {
    for (name, size, sum) in SUMS {
        let text = normalised(&generated(name, size));
        assert_eq!(crc32fast::hash(text.as_bytes()), sum, "{name} {size}");
    }
}

/// Spheres, cones and cylinders, polygons and patches, lights: as published for the default sizes.
const PUBLISHED: [(&str, u32, [usize; 4]); 11] = [
    ("balls", 4, [7381, 0, 1, 3]),
    ("gears", 4, [0, 0, 9345, 5]),
    ("mount", 6, [4, 0, 8192, 1]),
    ("rings", 7, [4200, 4200, 1, 3]),
    ("teapot", 12, [0, 0, 9264, 2]),
    ("tetra", 6, [0, 0, 4096, 1]),
    ("tree", 11, [4095, 4095, 1, 7]),
    ("lattice", 12, [2197, 6084, 0, 6]),
    ("shells", 5, [5761, 0, 0, 1]),
    ("sombrero", 1, [0, 0, 1922, 1]),
    ("jacks", 1, [6, 3, 0, 1]),
];

#[test]
fn default_scenes_have_the_published_counts() {
    for (generator, (name, size, expected)) in spd::generators().iter().zip(PUBLISHED) {
        assert_eq!((generator.name, generator.default_size), (name, size));
        let scene = load(&format!("spd:{name}")).unwrap();
        let mut counts = [0, 0, 0, scene.lights.len()];
        for item in &scene.items {
            match item.solid {
                Solid::Sphere { .. } => counts[0] += 1,
                Solid::Cone { .. } => counts[1] += 1,
                Solid::Polygon { .. } => counts[2] += 1,
                _ => panic!("{name}: {item:?}"),
            }
        }
        assert_eq!(counts, expected, "{name}");
        assert_eq!(generator.primitives(size).unwrap(), scene.items.len() as u64, "{name}");
        assert!(scene.view.is_some());
        assert_eq!(scene.name, format!("spd:{name}"));
    }
    assert_eq!(spd::generators().len(), PUBLISHED.len());
}

#[test]
fn counts_are_right_at_other_sizes() {
    for generator in spd::generators() {
        for size in 1..=3 {
            let scene = load(&format!("spd:{}:{size}", generator.name)).unwrap();
            let count = generator.primitives(size).unwrap();
            assert_eq!(scene.items.len() as u64, count, "{} {size}", generator.name);
        }
    }
}

#[test]
fn equal_surfaces_are_kept_once() {
    assert_eq!(load("spd:lattice").unwrap().materials.len(), 4);
    assert_eq!(load("spd:rings").unwrap().materials.len(), 7);
    assert!(load("spd:gears").unwrap().materials.len() <= 64);
}

#[test]
fn sizes_that_make_no_scene_are_refused() {
    for generator in spd::generators() {
        for size in [0, 1000, u32::MAX - 1, u32::MAX] {
            let mut text = Vec::new();
            let error = generator.generate(size, &mut text).unwrap_err().to_string();
            assert!(text.is_empty());
            assert!(error.starts_with(&format!("spd:{}:{size}", generator.name)), "{error}");
            assert!(!error.contains('\n'));
        }
    }
    let error = spd::primitives("teapots", 1).unwrap_err().to_string();
    assert!(error.contains("\"teapots\"") && error.contains(" teapot "), "{error}");
}
