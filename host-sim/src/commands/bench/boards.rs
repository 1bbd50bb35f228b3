//! What number formats and structures cost on boards: instructions a ray, as the firmware counted them
//! (`tests/boards/goldens.txt`).

use std::collections::BTreeMap;
use std::fmt::{self, Write as _};

use serde::Serialize;

/// Instructions of a query for the nearest hit, by board.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Row {
    /// As in `spheres_grid`.
    pub(super) program: String,
    pub(super) num: String,
    pub(super) instructions: BTreeMap<String, u64>,
}

/// Takes the programs that exist in both number formats from the firmware's table: program,
/// structure, board, two checksums, bytes of flash, of RAM and of stack, instructions a pixel, a
/// nearest hit and so on.
pub(super) fn rows(goldens: &str) -> Vec<Row> {
    let mut all: BTreeMap<(&str, &str), BTreeMap<String, u64>> = BTreeMap::new();
    for line in goldens.lines().filter(|line| !line.starts_with('#')) {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (Some(program), Some(board), Some(Ok(instructions))) =
            (words.first(), words.get(2), words.get(9).map(|word| word.parse()))
        else {
            continue;
        };
        let key = match program.strip_prefix("fixed_") {
            Some(program) => (program, "fixed"),
            None => (*program, "f32"),
        };
        all.entry(key).or_default().insert((*board).to_owned(), instructions);
    }
    all.iter()
        .filter(|((program, _), _)| {
            ["f32", "fixed"].iter().all(|n| all.contains_key(&(*program, *n)))
        })
        .map(|((program, num), instructions)| Row {
            program: (*program).to_owned(),
            num: (*num).to_owned(),
            instructions: instructions.clone(),
        })
        .collect()
}

pub(super) fn table(text: &mut String, rows: &[Row]) -> fmt::Result {
    let boards: Vec<&String> =
        rows.first().map_or_else(Vec::new, |row| row.instructions.keys().collect());
    if boards.is_empty() {
        return Ok(());
    }
    write!(text, "\n## Boards: instructions a ray, nearest hit\n\n| program | numbers |")?;
    boards.iter().try_for_each(|board| write!(text, " {board} |"))?;
    writeln!(text, "\n|---|---|{}", "---:|".repeat(boards.len()))?;
    for row in rows {
        write!(text, "| {} | {} |", row.program, row.num)?;
        for board in &boards {
            let of = row.instructions.get(*board).map_or_else(|| "-".into(), u64::to_string);
            write!(text, " {of} |")?;
        }
        writeln!(text)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_in_both_formats_are_compared() {
        let goldens = "# a line\nball grid m0 - 1f 1 2 3 - 400 5\nfixed_ball grid m0 - 1f 1 2 3 - 90 5\n\
                       alone grid m0 - 1f 1 2 3 - 7 5\nempty - m0 - - 1 2 - - - -\n";
        let rows = rows(goldens);
        let found: Vec<_> = rows
            .iter()
            .map(|row| (row.program.as_str(), row.num.as_str(), row.instructions["m0"]))
            .collect();
        assert_eq!(found, [("ball", "f32", 400), ("ball", "fixed", 90)]);
        let mut text = String::new();
        table(&mut text, &rows).unwrap();
        assert!(text.ends_with("| ball | f32 | 400 |\n| ball | fixed | 90 |\n"), "{text}");
    }
}
