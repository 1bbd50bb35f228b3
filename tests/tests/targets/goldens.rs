//! Figures in a table that is kept in the repository: checksums to the bit, everything else to 2 %.

use crate::cross;
use anyhow::{Context, Result, bail, ensure};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::{env, fs};

/// The first columns name a row, then come checksums, then figures.
const COLUMNS: [&str; 14] = [
    "program",
    "structure",
    "board",
    "image",
    "hits",
    "flash",
    "ram",
    "stack",
    "pixel",
    "nearest",
    "any",
    "build",
    "kept",
    "peak",
];
const NAMES: usize = 3;
const SUMS: usize = 2;

const HEAD: &str = "\
# What every program takes on every board. Checked by the test `targets`: checksums have to be equal,
# other figures may move by 2 %. To accept new ones:
#     BLESS=1 cargo test --release -p kibiray-tests --test targets
#
# image, hits   CRC-32 of the picture and of the answers to ray queries
# flash         bytes of code, constants and initial values; of the module in wasm
# ram           bytes of all statics, the arena among them
# stack         most bytes of stack
# pixel         instructions a pixel
# nearest, any  instructions a ray for its nearest hit, and for whether its way is blocked
# build         instructions for the structure
# kept, peak    bytes of the arena that the structure takes, and that building it takes
#
# Instructions are counted by the emulator; they are not cycles.
";

type Cells = Vec<String>;

/// The rows of this run.
static FOUND: Mutex<BTreeMap<[String; NAMES], Cells>> = Mutex::new(BTreeMap::new());

/// What a program takes on a board.
#[derive(Debug)]
pub(crate) struct Row {
    names: [String; NAMES],
    cells: Cells,
}

impl Row {
    /// Nothing known yet.
    pub(crate) fn new(program: &str, structure: &str, board: &str) -> Self {
        let names = [program, structure, board].map(String::from);
        Self { names, cells: vec!["-".into(); COLUMNS.len() - NAMES] }
    }

    /// Fills in a column.
    pub(crate) fn with(mut self, column: &str, cell: impl ToString) -> Self {
        let place = COLUMNS.iter().position(|name| *name == column).expect("one of the columns");
        self.cells[place - NAMES] = cell.to_string();
        self
    }

    /// Compares with the table, unless the table is about to be replaced.
    pub(crate) fn check(self) -> Result<()> {
        let Self { names, cells } = self;
        let expected = table()?.remove(&names);
        let name = names.join(" ");
        FOUND.lock().unwrap_or_else(PoisonError::into_inner).insert(names, cells.clone());
        if blessing() {
            return Ok(());
        }
        let expected = expected.with_context(|| format!("no figures of {name}; {}", how()))?;
        let moved: Vec<_> = (NAMES..COLUMNS.len())
            .map(|column| (column, &expected[column - NAMES], &cells[column - NAMES]))
            .filter(|(column, old, new)| !agree(*column, old, new))
            .map(|(column, old, new)| format!("{}: {new} instead of {old}", COLUMNS[column]))
            .collect();
        ensure!(moved.is_empty(), "{name}: {}; {}", moved.join(", "), how());
        Ok(())
    }
}

/// Two ticks of the slowest clock, in instructions: a few of them are no figure.
const TICKS: u64 = 128;

fn agree(column: usize, old: &str, new: &str) -> bool {
    let allowed = |old: u64| match COLUMNS.get(column) {
        Some(&"build") => (old / 50).max(TICKS),
        _ => old / 50,
    };
    match (old.parse::<u64>(), new.parse::<u64>()) {
        (Ok(old), Ok(new)) if column >= NAMES + SUMS => old.abs_diff(new) <= allowed(old),
        _ => old == new,
    }
}

fn blessing() -> bool {
    env::var_os("BLESS").is_some()
}

fn how() -> &'static str {
    "if that is right: BLESS=1 cargo test --release -p kibiray-tests --test targets"
}

fn path() -> PathBuf {
    cross::source("boards").join("goldens.txt")
}

/// The table as it is kept.
fn table() -> Result<BTreeMap<[String; NAMES], Cells>> {
    let text = fs::read_to_string(path()).unwrap_or_default();
    let mut rows = BTreeMap::new();
    for line in text.lines().filter(|line| !line.starts_with('#') && !line.is_empty()).skip(1) {
        let mut cells: Cells = line.split_whitespace().map(String::from).collect();
        ensure!(cells.len() == COLUMNS.len(), "{}: {line:?}", path().display());
        let rest = cells.split_off(NAMES);
        let names = cells.try_into().ok().context("the columns that name a row")?;
        ensure!(rows.insert(names, rest).is_none(), "{}: twice: {line:?}", path().display());
    }
    Ok(rows)
}

/// After all checks: writes the table if it is to be replaced. `all` tells that nothing was left
/// out, so that a row which was not found is about nothing any more.
pub(crate) fn finish(all: bool) -> Result<()> {
    let found = std::mem::take(&mut *FOUND.lock().unwrap_or_else(PoisonError::into_inner));
    let kept = table()?;
    if !blessing() {
        let stale: Vec<_> = kept.keys().filter(|names| !found.contains_key(*names)).collect();
        if all && !stale.is_empty() {
            bail!("figures of nothing: {stale:?}; {}", how());
        }
        return Ok(());
    }
    let mut rows = if all { BTreeMap::new() } else { kept };
    rows.extend(found);
    fs::write(path(), format!("{HEAD}\n{}", aligned(rows)))?;
    Ok(())
}

fn aligned(rows: BTreeMap<[String; NAMES], Cells>) -> String {
    let lines: Vec<Cells> = std::iter::once(COLUMNS.map(String::from).to_vec())
        .chain(rows.into_iter().map(|(names, cells)| [&names[..], &cells].concat()))
        .collect();
    let width = |column: usize| lines.iter().map(|cells| cells[column].len()).max().unwrap_or(0);
    let widths: Vec<_> = (0..COLUMNS.len()).map(width).collect();
    let line = |cells: &Cells| {
        let padded = cells.iter().zip(&widths).enumerate().map(|(column, (cell, width))| {
            if column < NAMES + SUMS { format!("{cell:width$}") } else { format!("{cell:>width$}") }
        });
        padded.collect::<Vec<_>>().join(" ") + "\n"
    };
    lines.iter().map(line).collect()
}
