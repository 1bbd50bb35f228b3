//! Guards that work which is skipped is needless: with it, pictures are the same.

use std::process::Command;

use serde_json::Value;

/// A ball of glass that is seen by nothing but what it lets through, and a matt one behind it.
const GLASS: &str = "v
from 0 -10 2
at 0 0 0
up 0 0 1
angle 40
hither 1
resolution 32 32
l -5 -10 10
f 1 1 1 0 0 1 0.9 1.5
s 0 -2 0 1
f 1 0.5 0.2 1 0 1 0 0
s 0 2 0 1.5
";

fn report(arguments: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("glass.nff"), GLASS).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_host-sim"))
        .current_dir(folder.path())
        .args("render --json - -o x.png --size 40x40".split_whitespace())
        .args(arguments.split_whitespace())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn pictures_are_the_same_without_every_way_to_skip_work() {
    // What is skipped, where, and what there is more of without.
    let cases = [
        ("contribution", "spd:gears:1", "rays/secondary"),
        ("occluder", "spd:tetra:3 --accel naive", "work/primitive_tests"),
        ("shadows", "glass.nff", "rays/shadow"),
        ("facing", "spd:balls:2", "rays/shadow"),
        ("mirrors", "spd:tetra:3", ""),
        ("kinds", "spd:tetra:3", ""),
        ("kinds", "spd:gears:1", ""),
        // Without planes, queries tell in floats that a ray passes by.
        ("box", "chess --ram 0", "work/primitive_tests"),
        ("empty", "spd:teapot:2 --accel grid", "work/traversal_steps"),
        ("cells", "spd:tetra:3 --accel grid", "accel/references"),
        ("huge", "spd:balls:2 --accel grid", "accel/references"),
        ("tested", "spd:teapot:2 --accel grid", "work/primitive_tests"),
        ("lists", "spd:teapot:2 --accel grid --lists shared", "work/mailbox_skips"),
        ("lists", "spd:teapot:2 --accel octree --lists shared", "work/mailbox_skips"),
    ];
    for num in ["f32", "fixed"] {
        for (skip, scene, more) in cases {
            let with = report(&format!("{scene} --num {num}"));
            let without = report(&format!("{scene} --num {num} --no-skip {skip}"));
            assert_eq!(with["image"], without["image"], "{skip} {num}");
            let number =
                |report: &Value| report.pointer(&format!("/{more}")).and_then(Value::as_u64);
            assert!(more.is_empty() || number(&with) < number(&without), "{skip} {num}: {more}");
        }
    }
}
