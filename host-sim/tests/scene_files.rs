//! Bad scene files, names and sizes give one line that says where and why; none makes a panic.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use kibiray_host_sim::description::load::{LoadError, load};
use kibiray_host_sim::description::{nff, obj};

fn data(folder: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(folder)
}

/// Files of a folder that are scenes.
fn scenes(folder: &str) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(data(folder)).unwrap();
    let mut paths: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|it| it == "nff" || it == "obj"));
    paths.sort();
    paths
}

#[test]
fn bad_files_are_refused_with_line_and_reason() {
    // One line a file: `name:line: reason`.
    let expected = include_str!("data/bad/expected.txt");
    let expected: BTreeMap<_, _> =
        expected.lines().map(|line| (line.split(':').next().unwrap(), line)).collect();
    let paths = scenes("bad");
    assert!(paths.len() >= 25);
    assert_eq!(paths.len(), expected.len());
    let folder = format!("{}{}", data("bad").display(), std::path::MAIN_SEPARATOR);
    for path in paths {
        let name = path.file_name().unwrap().to_str().unwrap();
        let error = load(path.to_str().unwrap()).unwrap_err();
        assert!(matches!(error, LoadError::Parse { .. }), "{name}: {error:?}");
        let message = error.to_string();
        assert!(!message.contains(char::is_control), "{message:?}");
        assert_eq!(message.strip_prefix(&folder), Some(expected[name]));
    }
}

#[test]
fn names_that_are_no_scene_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    std::fs::create_dir(inside("folder.nff")).unwrap();
    for (name, fragment) in [
        ("", "unknown scene \"\""),
        ("tetra", "give spd:NAME[:SIZE]"),
        ("scene.ply", ".nff or .obj"),
        ("a\nb", "\"a\\nb\""),
        ("spd:", "no generator is named \"\""),
        ("spd:cube", "balls gears mount rings teapot"),
        ("spd:tetra:", "size is not a whole number"),
        ("spd:tetra:six", "size is not a whole number"),
        ("spd:tetra:-1", "size is not a whole number"),
        ("spd:tetra:6:6", "size is not a whole number"),
        ("spd:tetra:99999999999", "size is not a whole number"),
        ("spd:tetra:0", "sizes begin at 1"),
        ("spd:tetra:20", "the limit is 20000000"),
        (inside("missing.nff").as_str(), "missing.nff: "),
        (inside("missing.OBJ").as_str(), "missing.OBJ: "),
        (inside("folder.nff").as_str(), "folder.nff: "),
    ] {
        let message = load(name).unwrap_err().to_string();
        assert!(message.contains(fragment), "{message}");
        assert!(!message.contains('\n'), "{message:?}");
    }
}

#[test]
fn an_empty_file_is_an_empty_scene() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["empty.nff", "empty.OBJ", "Empty.Nff"] {
        let path = folder.path().join(name);
        std::fs::write(&path, "").unwrap();
        let scene = load(path.to_str().unwrap()).unwrap();
        assert!(scene.items.is_empty());
        assert_eq!(scene.name, path.to_str().unwrap());
    }
}

/// Files cut off or damaged anywhere: read or refused, within bounds of memory and without a panic.
#[test]
fn damaged_files_do_not_panic() {
    const NOISE: &[u8] = b"0-9.e+ \n#/\\pfvsclbn\xff\x00";
    let mut state = 1_u32;
    let mut random = move |below: usize| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as usize % below
    };
    let mut texts: Vec<Vec<u8>> =
        scenes("spd").iter().map(|it| std::fs::read(it).unwrap()).collect();
    texts.push(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf -1 -2 -3\n".to_vec());
    for text in texts {
        let text = &text[..text.len().min(4000)];
        for _ in 0..300 {
            let mut damaged = text[..random(text.len() + 1)].to_vec();
            for _ in 0..random(4) {
                if !damaged.is_empty() {
                    let place = random(damaged.len());
                    damaged[place] = NOISE[random(NOISE.len())];
                }
            }
            for result in [nff::parse_bytes(&damaged), obj::parse_bytes(&damaged)] {
                if let Err(error) = result {
                    let lines = damaged.iter().filter(|byte| **byte == b'\n').count() + 1;
                    assert!((1..=lines).contains(&error.line), "{error}");
                    assert!(!error.to_string().contains(char::is_control), "{error:?}");
                }
            }
        }
    }
}
