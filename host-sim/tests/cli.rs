//! The command line keeps its promises: exit status, one line an error, the report's fields, and
//! the same picture whatever the structure and the number of threads.

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// Runs `host-sim` in a folder of its own.
fn run_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_host-sim"));
    command.current_dir(folder).args(arguments).output().unwrap()
}

fn run(arguments: &str) -> Output {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &arguments.split_whitespace().collect::<Vec<_>>())
}

fn stdout(output: &Output) -> String {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn json(output: &Output) -> Value {
    serde_json::from_str(&stdout(output)).unwrap()
}

/// Two balls side by side, a triangle of no area and a quadrilateral behind them.
const SCENE: &str = "b 0.1 0.2 0.3
v
from 0 -10 0
at 0 0 0
up 0 0 1
angle 40
hither 1
resolution 64 48
l -5 -10 10
l 5 -10 10
f 1 0.5 0.2 0.8 0.2 10 0 0
s -1 0 0 1
s 1 0 0 1
p 3
0 0 0
1 0 0
2 0 0
p 4
-3 2 -3
3 2 -3
3 2 3
-3 2 3
";

/// A folder with the scene in `scene.nff`, and whatever else a test wants.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files.iter().chain(&[("scene.nff", SCENE)]) {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    folder
}

#[test]
fn wrong_usage_is_status_2() {
    let cases = [
        "nonsense",
        "render spd:tetra:1 --bogus",
        "render spd:tetra:1 --ram 64kb",
        "render spd:tetra:1 --ram -1",
        "render spd:tetra:1 --ram 17GiB",
        "render spd:tetra:1 --ram",
        "render spd:tetra:1 --size 640",
        "render spd:tetra:1 --size 0x10",
        "render spd:tetra:1 --size 65536x1",
        "render spd:tetra:1 --size 65535x65535",
        "render spd:tetra:1 --max-depth 0",
        "render spd:tetra:1 --max-depth 17",
        "render spd:tetra:1 --accel bsp",
        "render spd:tetra:1 --num f16",
        "sweep spd:tetra:1 --ram 4KiB",
        "sweep spd:tetra:1 --ram 4KiB..1KiB",
        "render spd:tetra:1 --aa 0",
        "render spd:tetra:1 --aa 17",
        "render spd:tetra:1 --aa adaptive:2",
        "render spd:tetra:1 --cutoff -1",
        "render spd:tetra:1 --mailbox huge",
        "render spd:tetra:1 --grid 4x4",
        "render spd:tetra:1 --grid 0x4x4",
        "render spd:tetra:1 --max-level 11",
        "render spd:tetra:1 --threads 0",
        "render spd:tetra:1 --threads 1000",
        "render spd:tetra:1 --repeat 0",
        "stats",
        "stats spd:tetra:1 --rays all",
        "trace spd:tetra:1",
        "trace spd:tetra:1 --rays in.csv",
        "scene",
    ];
    for case in cases {
        let output = run(case);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{case}: {error}");
        assert!(error.starts_with("error: "), "{case}: {error}");
        assert!(output.stdout.is_empty(), "{case}");
    }
}

/// Runs a case that must end with one line on standard error.
fn one_line(folder: &Path, arguments: &str, status: i32) -> String {
    let output = run_in(folder, &arguments.split_whitespace().collect::<Vec<_>>());
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(status), "{arguments}: {error}");
    assert_eq!(error.lines().count(), 1, "{arguments}: {error}");
    assert!(output.stdout.is_empty(), "{arguments}");
    error.trim_end().strip_prefix("error: ").expect("error: ").to_owned()
}

#[test]
fn options_that_mean_nothing_together_say_so() {
    let folder = folder(&[]);
    let cases = [
        (
            "stats scene.nff --accel octree --grid 1x1x1",
            "--grid and --macro-cells are only for --accel grid",
        ),
        (
            "stats scene.nff --accel grid --max-level 3",
            "--max-objects, --max-level, --store and --walk are only for --accel octree",
        ),
        (
            "stats scene.nff --grid 1x1x1 --max-objects 3",
            "--grid and --macro-cells are for grids, --max-objects, --max-level, --store and --walk are for octrees",
        ),
        (
            "trace scene.nff --rays in.csv --hits - --json -",
            "--hits - and --json - both want standard output",
        ),
        ("scene tetra:x", "tetra:x: the size is not a whole number"),
    ];
    for (arguments, message) in cases {
        assert_eq!(one_line(folder.path(), arguments, 2), message);
    }
}

#[test]
fn what_cannot_be_done_is_status_1_and_one_line() {
    let header = "ox,oy,oz,dx,dy,dz,tmin,tmax\n";
    let rays = |row: &str| format!("{header}0,0,0,0,0,1,0,inf\n{row}\n");
    let (short, word, long) = (rays("1,2,3"), rays("0,0,0,0,0,1,0,far"), rays("0,0,0,0,0,1,0,1,2"));
    let blank = rays("");
    let folder = folder(&[
        ("bad.nff", "s 0 0 0\n"),
        ("great.nff", "s 0 0 0 1\ns 1e30 0 0 1\n"),
        ("header.csv", "x,y,z\n"),
        ("empty.csv", ""),
        ("short.csv", &short),
        ("word.csv", &word),
        ("long.csv", &long),
        ("blank.csv", &blank),
        ("good.csv", header),
    ]);
    let cases = [
        ("render nowhere", "unknown scene \"nowhere\""),
        ("render nowhere.nff", "nowhere.nff: "),
        ("render spd:teacup", "no generator is named \"teacup\""),
        ("render spd:tetra:0", "spd:tetra:0: sizes begin at 1"),
        ("render spd:tetra:x", "spd:tetra:x: the size is not a whole number"),
        ("render bad.nff", "bad.nff:1: "),
        ("render great.nff", "great.nff: primitive 1: "),
        ("render scene.nff -o no/x.png", "cannot write no/x.png: there is no folder no"),
        ("render scene.nff -o .", "cannot write .: it is a folder"),
        ("render scene.nff --heatmap no/x.png", "cannot write no/x.png: "),
        ("stats scene.nff --json no/x.json", "cannot write no/x.json: "),
        ("stats spd:tetra:3 --accel octree --ram 0", "too little memory: "),
        ("stats spd:tetra:3 --accel grid --grid 9x9x9 --ram 100", "too little memory: "),
        ("stats spd:tetra:3 --mailbox stamp --ram 100 --threads 2", "too little memory: "),
        ("trace scene.nff --rays none.csv --hits out.csv", "none.csv: "),
        ("trace scene.nff --rays header.csv --hits out.csv", "header.csv:1: the header must be"),
        ("trace scene.nff --rays empty.csv --hits out.csv", "empty.csv:1: the header must be"),
        ("trace scene.nff --rays short.csv --hits out.csv", "short.csv:3: dx is missing"),
        (
            "trace scene.nff --rays word.csv --hits out.csv",
            "word.csv:3: tmax is not a number: \"far\"",
        ),
        ("trace scene.nff --rays long.csv --hits out.csv", "long.csv:3: more than 8 fields"),
        ("trace scene.nff --rays blank.csv --hits out.csv", "blank.csv:3: ox is missing"),
        ("trace scene.nff --rays good.csv --hits no/out.csv", "cannot write no/out.csv: "),
        ("scene teacup", "no generator is named \"teacup\""),
    ];
    for (arguments, start) in cases {
        let message = one_line(folder.path(), arguments, 1);
        assert!(message.starts_with(start), "{arguments}: {message}");
    }
    let left: Vec<_> =
        std::fs::read_dir(folder.path()).unwrap().map(|it| it.unwrap().path()).collect();
    let picture = |path: &&std::path::PathBuf| path.extension().is_some_and(|it| it == "png");
    assert_eq!(left.iter().find(picture), None);
}

#[test]
fn the_bytes_that_an_error_names_are_enough() {
    let folder = folder(&[]);
    for options in ["--accel octree", "--accel octree --mailbox stamp --threads 3", "--grid 5x5x5"]
    {
        let arguments = format!("stats spd:tetra:2 {options}");
        let message = one_line(folder.path(), &format!("{arguments} --ram 1"), 1);
        let needed = message.rsplit(' ').next().unwrap();
        let report = json(&run(&format!("{arguments} --ram {needed}")));
        assert_eq!(report["memory"]["capacity_bytes"].to_string(), needed);
        let less = needed.parse::<usize>().unwrap() - 1;
        one_line(folder.path(), &format!("{arguments} --ram {less}"), 1);
    }
}

#[test]
fn the_report_has_the_fields_that_scripts_rely_on() {
    let common = [
        "scene/name scene/primitives scene/bytes scene/lights scene/skipped num accel/kind",
        "memory/capacity_bytes memory/used_bytes memory/high_water_bytes memory/parts",
        "rays/total rays/hits",
        "work/primitive_tests work/mailbox_skips work/traversal_steps work/leaves_visited",
        "work/empty_leaves_visited",
        "time/load_s time/build_s time/build_cpu_s time/trace_s time/trace_cpu_s time/rays_per_s",
    ];
    let kinds = "rays/primary rays/primary_hits rays/shadow rays/shadow_hits rays/secondary \
                 rays/secondary_hits";
    let cells = "accel/leaves accel/empty_leaves accel/references accel/distinct_lists";
    let octree = "accel/interior_nodes accel/max_level accel/stopped_by";
    let tree = "accel/interior_nodes accel/leaves accel/references accel/max_level \
                accel/shapes_per_leaf accel/largest_leaf";
    let image = "image/width image/height image/crc32";
    let cases = [
        ("stats spd:tetra:2 --accel octree", vec![kinds, cells, octree], vec!["image"]),
        ("stats spd:tetra:2 --accel grid", vec![kinds, cells, "accel/resolution"], vec![octree]),
        ("stats spd:tetra:2 --accel naive", vec![kinds], vec![cells, octree, "accel/resolution"]),
        ("stats spd:tetra:2 --accel bvh", vec![kinds, tree], vec!["accel/empty_leaves"]),
        ("render spd:tetra:2 --size 8x8 --json -", vec![kinds, image, tree], vec![]),
    ];
    for (arguments, there, not_there) in cases {
        let report = json(&run(arguments));
        let at = |field: &str| report.pointer(&format!("/{field}"));
        for field in common.iter().chain(&there).flat_map(|fields| fields.split_whitespace()) {
            assert!(at(field).is_some(), "{arguments}: {field}");
        }
        for field in not_there.iter().flat_map(|fields| fields.split_whitespace()) {
            assert_eq!(at(field), None, "{arguments}: {field}");
        }
    }
}

#[test]
fn the_published_ray_set_is_shot() {
    let report = json(&run("stats spd:tetra:1"));
    assert_eq!(report["rays"]["primary"], 513 * 513);
    let sum = |names: [&str; 3]| names.iter().map(|it| report["rays"][it].as_u64().unwrap()).sum();
    assert_eq!(report["rays"]["total"].as_u64(), Some(sum(["primary", "shadow", "secondary"])));
    let hits = sum(["primary_hits", "shadow_hits", "secondary_hits"]);
    assert_eq!(report["rays"]["hits"].as_u64(), Some(hits));
}

/// Hits of the scene that can be told in the head.
const RAYS: &str = "ox,oy,oz,dx,dy,dz,tmin,tmax
-1,-10,0,0,2,0,0,inf
1,-10,0,0,1,0,9.5,INF
1,-10,0,0,1,0,9.5,10
0,-10,0,0,-1,0,0,Infinity
2.5,10,2.5,0,-4,0,0,100
nan,0,0,0,1,0,0,1
0,0,0,0,0,0,0,1
-1,-10,0,0,1,0,0,9
";

const HITS: &str = "t,id,nx,ny,nz
4.5,0,0.0,-1.0,0.0
11.0,1,0.0,-1.0,0.0
inf,-1,0,0,0
inf,-1,0,0,0
2.0,3,0.0,1.0,0.0
nan,-1,0,0,0
nan,-1,0,0,0
inf,-1,0,0,0
";

#[test]
fn queries_come_back_as_computed_by_hand() {
    let folder = folder(&[("in.csv", RAYS)]);
    let grid = "grid --num f64 --repeat 2";
    for options in ["naive", "grid", "octree", "bvh", "octree --threads 2", grid, "bvh --num f64"] {
        let arguments = format!("trace scene.nff --rays in.csv --hits - --accel {options}");
        let output = run_in(folder.path(), &arguments.split_whitespace().collect::<Vec<_>>());
        assert_eq!(
            stdout(&output).replace("-0.0", "0.0"),
            HITS.replace("-0.0", "0.0"),
            "{options}"
        );
    }
    let arguments = "trace scene.nff --rays in.csv --hits out.csv --any --json -";
    let output = run_in(folder.path(), &arguments.split_whitespace().collect::<Vec<_>>());
    let report = json(&output);
    assert_eq!((&report["rays"]["total"], &report["rays"]["hits"]), (&6.into(), &3.into()));
    assert_eq!(report["scene"]["skipped"], 1);
    assert_eq!(report["rays"].get("primary"), None);
    let any = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    assert_eq!(any, "occluded\n1\n1\n0\n0\n1\n0\n0\n0\n");
}

#[test]
fn the_picture_is_the_same_with_every_structure_and_any_threads() {
    let folder = folder(&[]);
    let picture = |options: &str| {
        let arguments = format!("render scene.nff --json - {options}");
        let output = run_in(folder.path(), &arguments.split_whitespace().collect::<Vec<_>>());
        let report = json(&output);
        assert_eq!(
            (&report["image"]["width"], &report["image"]["height"]),
            (&64.into(), &48.into())
        );
        let file = std::fs::read(folder.path().join("scene.png")).unwrap();
        (report["image"]["crc32"].as_str().unwrap().to_owned(), file)
    };
    let naive = picture("--accel naive");
    for options in [
        "--accel grid",
        "--accel octree",
        "--accel octree --threads 2",
        "--accel grid --threads 3 --mailbox cache",
        "--accel octree --mailbox off --repeat 2",
        "--accel bvh --mailbox cache",
        "--ram 0",
    ] {
        assert_eq!(picture(options), naive, "{options}");
    }
}

#[test]
fn smooth_pictures_are_the_same_with_any_threads_and_cost_more_rays() {
    let folder = folder(&[]);
    let report = |options: &str| {
        let arguments = format!("render scene.nff --accel naive --json - {options}");
        json(&run_in(folder.path(), &arguments.split_whitespace().collect::<Vec<_>>()))
    };
    let rays = |report: &Value| report["rays"]["primary"].as_u64().unwrap();
    let off = report("");
    for n in [1, 2, 3] {
        assert_eq!(rays(&report(&format!("--aa {n}"))), n * n * rays(&off), "{n}");
    }
    assert_eq!(report("--aa 1")["image"], off["image"]);
    let adaptive = report("--aa adaptive");
    assert!(rays(&adaptive) > 65 * 49 && rays(&adaptive) < 9 * rays(&off), "{adaptive}");
    assert_eq!(adaptive["image"], report("--aa adaptive --threads 3")["image"]);
    let part = &adaptive["memory"]["parts"][0];
    assert_eq!(
        (part["name"].as_str(), part["bytes"].as_u64()),
        (Some("corner samples"), Some(784))
    );
    let message = one_line(folder.path(), "render scene.nff --aa adaptive --ram 1759", 1);
    assert_eq!(message, "too little memory: 1760 bytes needed, 1759 bytes there; give --ram 1760");
    let faint = report("--cutoff 1");
    assert_eq!(faint["rays"]["secondary"].as_u64(), Some(0));
}

#[test]
fn a_sweep_says_how_much_memory_is_worth_having() {
    let folder = folder(&[]);
    let swept = |options: &str| {
        let arguments = format!("sweep spd:tetra:4 --size 16x16 --json - {options}");
        json(&run_in(folder.path(), &arguments.split_whitespace().collect::<Vec<_>>()))
    };
    let all = swept("--ram 1KiB..16KiB");
    let rows = all["rows"].as_array().unwrap();
    let rams: Vec<_> = rows.iter().map(|row| row["ram"].as_u64().unwrap()).collect();
    assert_eq!(rams, [1024, 2048, 4096, 8192, 16384]);
    assert!(rams.contains(&all["knee_ram"].as_u64().unwrap()));
    let tests = |row: &Value| row["work"]["primitive_tests"].as_u64().unwrap();
    assert!(tests(&rows[4]) < tests(&rows[0]) / 2);
    for row in rows {
        assert!(row["memory"]["high_water_bytes"].as_u64() <= row["ram"].as_u64());
        assert_eq!(row["rays"], rows[0]["rays"]);
    }
    let plot = std::fs::read_to_string(folder.path().join("tetra.svg")).unwrap();
    assert!(plot.starts_with("<svg") && plot.contains("knee"));
    // What has no room is a row without a report.
    let octree = swept("--ram 64..8192 --accel octree");
    let rows = octree["rows"].as_array().unwrap();
    assert!(rows[0].get("work").is_none() && rows[7].get("work").is_some(), "{octree}");
}

#[test]
fn work_does_not_depend_on_threads() {
    let work = |threads: u32| {
        let report = json(&run(&format!(
            "stats spd:balls:2 --threads {threads} --mailbox stamp \
             --accel octree --max-level 3"
        )));
        (report["work"].clone(), report["rays"].clone())
    };
    assert_eq!(work(1), work(2));
}

#[test]
fn a_shape_without_surface_is_left_out_with_a_warning() {
    let folder = folder(&[]);
    let output = run_in(folder.path(), &["render", "scene.nff", "--heatmap", "heat.png"]);
    let warning = String::from_utf8(output.stderr.clone()).unwrap();
    assert!(warning.ends_with(": 1 of the shapes\n") && warning.lines().count() == 1, "{warning}");
    let table = stdout(&output);
    for word in ["scene.nff", "plan", "high water", "shadow", "a ray takes", "CRC-32", "heat map"] {
        assert!(table.contains(word), "{word}: {table}");
    }
    assert!(folder.path().join("heat.png").is_file());
}

#[test]
fn without_arguments_the_demo_scene_is_rendered_in_64_kib() {
    let folder = tempfile::tempdir().unwrap();
    let table = stdout(&run_in(folder.path(), &[]));
    assert!(table.contains("64 KiB in the arena") && table.contains("kibiray.png, 640x480"));
    let file = std::fs::read(folder.path().join("kibiray.png")).unwrap();
    assert!(file.starts_with(b"\x89PNG"));
}

#[test]
fn every_built_in_scene_is_listed_and_loads() {
    let list = stdout(&run("scenes"));
    let names: Vec<_> = list.lines().skip(1).take_while(|line| !line.is_empty()).collect();
    assert!(names.len() >= 14);
    for line in names {
        let mut words = line.split_whitespace();
        let name = words.next().unwrap();
        let name = if name.starts_with("spd:") { format!("{name}:1") } else { name.to_owned() };
        let report = json(&run(&format!("render {name} --size 48x36 --json -")));
        assert!(report["rays"]["primary_hits"].as_u64() > Some(0), "{name}");
    }
    let printed = stdout(&run("scene spd:tetra:1"));
    assert_eq!(printed, stdout(&run("scene tetra:1")));
}

#[test]
fn an_object_file_gets_a_view_and_a_light() {
    let cube = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let folder = folder(&[("quad.obj", cube)]);
    let output = run_in(folder.path(), &["render", "quad.obj", "--size", "16x16", "--json", "-"]);
    let report = json(&output);
    assert_eq!(
        (&report["scene"]["primitives"], &report["scene"]["lights"]),
        (&1.into(), &1.into())
    );
    assert!(report["rays"]["primary_hits"].as_u64() > Some(20));
    assert!(report["rays"]["shadow"].as_u64() > Some(20));
}

#[test]
#[cfg(unix)]
fn a_reader_that_has_seen_enough_is_no_error() {
    use std::process::Stdio;
    for arguments in ["scene balls:4", "stats spd:tetra:1", "scenes"] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_host-sim"))
            .args(arguments.split_whitespace())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(output.status.success(), "{arguments}");
        assert!(output.stderr.is_empty(), "{arguments}");
    }
}

#[test]
fn bench_writes_table_json_and_plots() {
    let folder = tempfile::tempdir().unwrap();
    let line = "bench spd:tetra:2 --size 12x12 --rays 9 --aa off,4,adaptive --cutoff 0 --repeat 1 \
                --accel bvh,grid --ram 16KiB,16 -o out";
    let line: Vec<&str> = line.split_whitespace().collect();
    let text = String::from_utf8(run_in(folder.path(), &line).stdout).unwrap();
    assert_eq!(text, std::fs::read_to_string(folder.path().join("out.md")).unwrap());
    let report: Value =
        serde_json::from_slice(&std::fs::read(folder.path().join("out.json")).unwrap()).unwrap();
    let scene = &report["scenes"][0];
    // Every number format, structure and arena; every number format and way to sample.
    let rows = |key: &str| scene[key].as_array().unwrap().clone();
    let (queries, pictures) = (rows("queries"), rows("pictures"));
    let formats = rows("findings").len();
    assert!(formats >= 3);
    assert_eq!((queries.len(), pictures.len()), (formats * 4, formats * 3));
    for row in &queries {
        assert_eq!(row["rays"].is_null(), row["ram"] == 16, "{row}");
        assert_eq!(row["wrong_ids"], row["explained"], "{row}");
    }
    assert!(pictures.iter().any(|row| row["best"] == true));
    for end in ["svg", "png"] {
        assert!(folder.path().join(format!("out-tetra.{end}")).metadata().unwrap().len() > 1000);
    }
}
