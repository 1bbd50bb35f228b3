//! What is in a linked program.

use anyhow::{Context, Result, ensure};
use object::{Object, ObjectSection, ObjectSymbol, SectionFlags, elf};
use std::fs;
use std::path::Path;

/// A linked program: its symbols and what it takes.
#[derive(Debug)]
pub(crate) struct Image {
    symbols: Vec<String>,
    /// Names of functions, inlined ones too, one after the other with zeros between.
    names: Vec<u8>,
    flash: u64,
    ram: u64,
}

impl Image {
    /// Reads an ELF file.
    pub(crate) fn read(path: &Path) -> Result<Self> {
        let bytes = fs::read(path).with_context(|| format!("{}", path.display()))?;
        let file = object::File::parse(&*bytes)?;
        let symbols: Vec<String> =
            file.symbols().filter_map(|s| s.name().ok()).map(String::from).collect();
        // Otherwise nothing would be found because nothing is told.
        ensure!(symbols.iter().any(|name| name == "main"), "no symbols in {}", path.display());
        let has = |section: &object::Section<'_, '_>, flag: u64| match section.flags() {
            SectionFlags::Elf { sh_flags, .. } => sh_flags.0 & flag != 0,
            _ => false,
        };
        let (mut flash, mut ram) = (0, 0);
        for section in file.sections().filter(|section| has(section, elf::SHF_ALLOC.0)) {
            flash += section.file_range().map_or(0, |(_, bytes)| bytes);
            // Where the stack may grow is not taken by anything.
            let free = matches!(section.name()?, ".heap" | ".stack");
            if has(&section, elf::SHF_WRITE.0) && !free {
                ram += section.size();
            }
        }
        let names = file.section_by_name(".debug_str").context("names for debuggers")?;
        Ok(Self { symbols, names: names.data()?.to_vec(), flash, ram })
    }

    /// Bytes of code, constants and initial values.
    pub(crate) fn flash(&self) -> u64 {
        self.flash
    }

    /// Bytes of all statics.
    pub(crate) fn ram(&self) -> u64 {
        self.ram
    }

    /// Symbols with one of these in their names.
    fn with(&self, parts: &[&str]) -> Vec<&String> {
        let contains = |name: &&String| parts.iter().any(|part| name.contains(part));
        self.symbols.iter().filter(contains).collect()
    }

    /// Whether there is code of a module of the library, such as `["shape", "triangle"]`: a function
    /// that is linked or has been inlined. Their mangled names say where they come from.
    pub(crate) fn has_code_of(&self, path: [&str; 2]) -> bool {
        let mangled = path.map(|name| format!("{}{name}", name.len())).concat();
        let contains =
            |name: &[u8], part: &[u8]| name.windows(part.len()).any(|bytes| bytes == part);
        self.names
            .split(|byte| *byte == 0)
            .any(|name| contains(name, b"7kibiray") && contains(name, mangled.as_bytes()))
    }

    /// The entry points of the allocator, which any use of `alloc` calls.
    pub(crate) fn allocates_nothing(&self) -> Result<()> {
        let found =
            self.with(&["__rust_alloc", "__rust_realloc", "__rust_no_alloc", "__rdl_", "__rg_"]);
        ensure!(found.is_empty(), "an allocator: {found:?}");
        Ok(())
    }

    /// Formatting takes kilobytes; panics with messages are how it usually gets in.
    pub(crate) fn formats_nothing(&self) -> Result<()> {
        let found = self.with(&["4core3fmt", "core::fmt"]);
        ensure!(found.is_empty(), "formatting: {found:?}");
        Ok(())
    }

    /// Nothing in the program can panic: what could would keep the handler linked.
    pub(crate) fn panics_nowhere(&self) -> Result<()> {
        let found = self.with(&["9panicking", "core::panicking", "panicked", "rust_begin_unwind"]);
        ensure!(found.is_empty(), "panics: {found:?}");
        Ok(())
    }
}
