//! Pictures, bit for bit: the CRC-32 of every built-in scene at a small size, in a table. To accept
//! new ones after looking at them: `BLESS=1 cargo test --release -p kibiray-host-sim --test golden`.

use serde_json::Value;
use std::path::Path;
use std::process::Command;

const SCENES: [&str; 14] = [
    "still-life",
    "room",
    "helix",
    "spd:balls:2",
    "spd:gears:1",
    "spd:mount:4",
    "spd:rings:2",
    "spd:teapot:3",
    "spd:tetra:4",
    "spd:tree:5",
    "spd:lattice:3",
    "spd:shells:1",
    "spd:sombrero:1",
    "spd:jacks:1",
];

fn crc(scene: &str, size: &str, options: &[&str]) -> String {
    let file = std::env::temp_dir().join(format!("kibiray-golden-{}.png", std::process::id()));
    let output = Command::new(env!("CARGO_BIN_EXE_host-sim"))
        .args(["render", scene, "--size", size, "--json", "-", "-o"])
        .arg(&file)
        .args(options)
        .output()
        .unwrap();
    let _ = std::fs::remove_file(&file);
    assert!(output.status.success(), "{scene}: {}", String::from_utf8_lossy(&output.stderr));
    let report: Value = serde_json::from_slice(&output.stdout).unwrap();
    report["image"]["crc32"].as_str().unwrap().to_owned()
}

#[test]
fn pictures_are_those_that_were_looked_at() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden.txt");
    let found: String =
        SCENES.iter().map(|scene| format!("{scene} {}\n", crc(scene, "160x120", &[]))).collect();
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&path, &found).unwrap();
    }
    let expected = std::fs::read_to_string(&path).unwrap();
    assert_eq!(found, expected, "pictures changed; look at them, then run with BLESS=1");
}

#[test]
fn pictures_do_not_depend_on_structure_budget_or_threads() {
    for scene in ["still-life", "spd:teapot:3"] {
        let expected = crc(scene, "96x72", &["--accel", "naive"]);
        for options in [
            &["--accel", "octree", "--ram", "8KiB"][..],
            &["--accel", "octree", "--ram", "1MiB", "--mailbox", "cache"],
            &["--accel", "grid", "--ram", "1MiB", "--threads", "2"],
        ] {
            assert_eq!(crc(scene, "96x72", options), expected, "{scene} {options:?}");
        }
    }
}

#[test]
fn the_picture_of_the_readme_is_what_the_program_renders() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("pictures/still-life.png");
    let decoder = png::Decoder::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    let size = format!("{}x{}", info.width, info.height);
    let kept = format!("{:08x}", crc32fast::hash(&pixels[..info.buffer_size()]));
    assert_eq!(crc("still-life", &size, &["--ram", "64KiB"]), kept);
}
