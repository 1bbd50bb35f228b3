//! What the readers of scene files share: errors with a line, lines of bytes, finite numbers.

use std::fmt;

/// Why a file is not a scene. Displays as one line; the caller puts the file's name before it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseError {
    /// Line of the file, from 1.
    pub line: usize,
    /// What is wrong there and what belongs there.
    pub message: String,
}

impl ParseError {
    pub(super) fn new(line: usize, message: impl Into<String>) -> Self {
        Self { line, message: message.into() }
    }
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}: {}", self.line, self.message)
    }
}

impl std::error::Error for ParseError {}

/// The text of a file, without the mark that some editors put before UTF-8.
pub(super) fn text(bytes: &[u8]) -> Result<&str, ParseError> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|b| **b == b'\n').count();
        ParseError::new(line, "not UTF-8 text: save the file as text in UTF-8 or ASCII")
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// A token for a message: quoted, control characters escaped, cut to a bearable length.
pub(super) fn quoted(token: &str) -> String {
    const LONGEST: usize = 24;
    let cut: String = token.chars().take(LONGEST).collect();
    let dots = if cut.len() < token.len() { "..." } else { "" };
    format!("\"{}{dots}\"", cut.escape_debug())
}

/// A finite number.
pub(super) fn number(token: &str, line: usize) -> Result<f64, ParseError> {
    match token.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value),
        Ok(_) => Err(ParseError::new(line, format!("{} is not a finite number", quoted(token)))),
        Err(_) => Err(ParseError::new(line, format!("{} is not a number", quoted(token)))),
    }
}

/// Words and their lines, without comments.
#[derive(Clone)]
pub(super) struct Tokens<'a> {
    lines: std::iter::Enumerate<std::str::Lines<'a>>,
    line: usize,
    words: std::str::SplitAsciiWhitespace<'a>,
    /// Bytes of the file from the current line on.
    left: usize,
    current: usize,
}

impl<'a> Tokens<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        let words = "".split_ascii_whitespace();
        Self { lines: text.lines().enumerate(), line: 0, words, left: text.len(), current: 0 }
    }

    /// No fewer than are left.
    pub(super) fn bytes_left(&self) -> usize {
        self.left
    }

    /// The next word, without taking it.
    pub(super) fn peek(&self) -> Option<&'a str> {
        self.clone().next().map(|(_, word)| word)
    }
}

impl<'a> Iterator for Tokens<'a> {
    type Item = (usize, &'a str);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            match self.words.next() {
                Some(word) if !word.starts_with('#') => return Some((self.line, word)),
                _ => {
                    let (index, line) = self.lines.next()?;
                    self.line = index + 1;
                    self.left = self.left.saturating_sub(self.current);
                    self.current = line.len() + 1;
                    self.words = line.split_ascii_whitespace();
                }
            }
        }
    }
}
