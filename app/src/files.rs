//! Files in and out: programs with their includes, meshes, and writing whole or not at all.

mod writing;

use std::collections::{HashMap, HashSet};
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use vv::diagnostic::{Diagnostic, Severity};
use vv::io::{Format, Place, ReadError, ReadOptions};
use vv::mesh::Mesh;
use vv::stop::Stop;
use vv::{Compilation, Included};

pub use writing::{Prepared, abandon, check_writable, commit, place, prepare, write};

use crate::library;

/// The path that means standard input or output.
pub const STANDARD_STREAM: &str = "-";

/// Longest program read, in bytes.
pub const MAX_PROGRAM_BYTES: u64 = 16 << 20;

/// Longest mesh file read, in bytes: room for the vertices that the default budget allows.
pub const MAX_MESH_BYTES: u64 = 16 << 30;

const CLOSED_PIPE: &str = "nobody reads the output any more";

/// Why a file could not be used: the file, and a sentence that helps.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FileError {
    /// Which file.
    pub path: PathBuf,
    /// Where in it, where that is known.
    pub place: Option<Place>,
    /// What is wrong, as a diagnostic without span.
    pub diagnostic: Box<Diagnostic>,
}

impl FileError {
    fn new(path: &Path, message: impl Into<String>) -> Self {
        let diagnostic = Box::new(Diagnostic::new(Severity::Error, None, message));
        Self { path: path.to_owned(), place: None, diagnostic }
    }

    /// A mistake at a place of a file, with what there is instead.
    #[must_use]
    pub fn at(path: &Path, place: Option<Place>, message: impl Into<String>, evidence: Option<String>) -> Self {
        let mut error = Self { place, ..Self::new(path, message) };
        error.diagnostic.evidence.extend(evidence);
        error
    }

    /// Whether it was a pipe that nobody reads any more: a reader who has enough, no fault.
    #[must_use]
    pub fn is_closed_pipe(&self) -> bool {
        self.diagnostic.message == CLOSED_PIPE
    }

    fn hint(mut self, hint: impl Into<String>) -> Self {
        self.diagnostic = Box::new(self.diagnostic.hint(hint));
        self
    }

    /// The diagnostic with file and place in front of its message.
    #[must_use]
    pub fn located(&self) -> Diagnostic {
        located(&self.path, self.place, Diagnostic::clone(&self.diagnostic))
    }
}

/// A diagnostic about a file that is no program: file and place stand in front of its message.
#[must_use]
pub fn located(path: &Path, place: Option<Place>, mut diagnostic: Diagnostic) -> Diagnostic {
    let place = match place {
        None => String::new(),
        Some(place @ Place::Text { .. }) => format!(":{place}"),
        Some(place @ Place::Byte(_)) => format!(": at {place}"),
    };
    diagnostic.message = format!("{}{place}: {}", shown(path), diagnostic.message);
    diagnostic
}

/// Whether the path names something that can be opened and is no directory.
///
/// # Errors
/// What the file system says.
pub fn check_readable(path: &Path) -> Result<(), FileError> {
    open(path).map(drop)
}

/// What to call a file: its path as given, `<stdin>` for `-`.
#[must_use]
pub fn shown(path: &Path) -> String {
    if is_standard_stream(path) { "<stdin>".to_owned() } else { path.display().to_string() }
}

/// Whether the path is `-`.
#[must_use]
pub fn is_standard_stream(path: &Path) -> bool {
    path.as_os_str() == STANDARD_STREAM
}

/// Reads a program's text: UTF-8 with or without byte-order mark. `-` is standard input.
///
/// # Errors
/// What the file system says, that the text is not UTF-8, or that it is longer than [`MAX_PROGRAM_BYTES`].
pub fn read_program(path: &Path) -> Result<String, FileError> {
    let mut bytes = read(path, MAX_PROGRAM_BYTES, |_| true, &Stop::new())?;
    if bytes.starts_with(b"\xEF\xBB\xBF") {
        bytes.drain(..3);
    }
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.iter().filter(|&&b| b == b'\n').count() as u32 + 1;
        let byte = error.as_bytes().get(before.len()).copied().unwrap_or_default();
        let mut error = FileError::new(path, "the text is not in UTF-8").hint("save the program as UTF-8");
        error.diagnostic.evidence.push(format!("the byte 0x{byte:02X} begins no character"));
        error.place = Some(Place::Text { line, column: None });
        error
    })
}

/// Compiles a text as if it stood in `path`; includes are looked for beside the file that names them, then among the
/// programs that ship with vv. Also returns the files to watch: `path` and every place where an include was looked
/// for, whether or not there is a file.
#[must_use]
pub fn compile(path: &Path, text: &str) -> (Compilation, Vec<PathBuf>) {
    let Compiled { compilation, looked_at, .. } = compile_with(path, text, &|_| None);
    (compilation, looked_at)
}

/// What became of a text and of where its files are.
#[derive(Debug)]
pub struct Compiled {
    /// What became of it.
    pub compilation: Compilation,
    /// Where each file is, by the name that diagnostics call it; those that ship with vv are nowhere.
    pub paths: HashMap<String, PathBuf>,
    /// The files to watch, as [`compile`] returns them.
    pub looked_at: Vec<PathBuf>,
}

/// As [`compile`], but of a file that `unsaved` has a text for that is read and not what is on disk.
#[must_use]
pub fn compile_with(path: &Path, text: &str, unsaved: &dyn Fn(&Path) -> Option<Arc<str>>) -> Compiled {
    let name = shown(path);
    let mut includes = Includes::new(path, &name);
    let compilation = vv::compile(&name, text, &mut |from, wanted| includes.find(from, wanted, unsaved));
    Compiled { compilation, paths: includes.paths, looked_at: includes.looked_at }
}

/// Finds included texts and remembers what they are called.
struct Includes {
    /// Path of each file by the name it was given.
    paths: HashMap<String, PathBuf>,
    /// Name of each file by its canonical path: one file has one name, so that cycles end.
    names: HashMap<PathBuf, String>,
    looked_at: Vec<PathBuf>,
    /// The same, to find them.
    known: HashSet<PathBuf>,
}

impl Includes {
    fn new(path: &Path, name: &str) -> Self {
        let base = if is_standard_stream(path) { Path::new("") } else { path };
        let mut names = HashMap::new();
        if let Ok(canonical) = base.canonicalize() {
            names.insert(canonical, name.to_owned());
        }
        let looked_at = if is_standard_stream(path) { Vec::new() } else { vec![path.to_owned()] };
        let known = looked_at.iter().cloned().collect();
        Self { paths: HashMap::from([(name.to_owned(), base.to_owned())]), names, looked_at, known }
    }

    fn find(
        &mut self,
        from: &str,
        wanted: &str,
        unsaved: &dyn Fn(&Path) -> Option<Arc<str>>,
    ) -> Result<Included, String> {
        // A shipped program includes shipped programs only: what it means must not depend on where it is used.
        let Some(from_path) = self.paths.get(from) else {
            return library::include(wanted).ok_or_else(|| format!("vv ships with no program `{wanted}`"));
        };
        let path = from_path.parent().unwrap_or(Path::new("")).join(wanted);
        if self.known.insert(path.clone()) {
            self.looked_at.push(path.clone());
        }
        if path.symlink_metadata().is_err_and(|e| matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory)) {
            return library::include(wanted).ok_or_else(|| {
                let why = match library::nearly(Path::new(wanted)) {
                    Some(shipped) => format!("but `{shipped}` comes with vv"),
                    None => "and vv ships with no program of this name".to_owned(),
                };
                format!("there is no file `{}`, {why}", path.display())
            });
        }
        let text = match unsaved(&path) {
            Some(text) => text.to_string(),
            None => read_program(&path).map_err(|error| error.located().message)?,
        };
        let canonical = path.canonicalize().unwrap_or_else(|_| path.clone());
        let name = self.names.entry(canonical).or_insert_with(|| path.display().to_string()).clone();
        self.paths.entry(name.clone()).or_insert(path);
        Ok(Included { name, text })
    }
}

/// Reads a mesh, its format by extension. Standard input (`-`) and files without extension are in the format that they
/// begin as, else OBJ.
///
/// # Errors
/// What the file system or the reader says, or that the mesh is empty. When `options.stop` was set the error says that.
pub fn read_mesh(path: &Path, options: &ReadOptions) -> Result<(Mesh, Vec<Diagnostic>), FileError> {
    let named = path.extension().map(|_| mesh_format(path)).transpose()?;
    let format_of = |bytes: &[u8]| named.or_else(|| Format::of_bytes(bytes)).unwrap_or(Format::Obj);
    let bytes = read(path, MAX_MESH_BYTES, |bytes| format_of(bytes).is_text(), &options.stop)?;
    if bytes.iter().all(u8::is_ascii_whitespace) {
        return Err(FileError::new(path, "is empty").hint("a mesh file lists vertices and faces"));
    }
    let format = format_of(&bytes);
    let (mesh, warnings) = vv::io::read(&bytes, format, options).map_err(|error| match error {
        ReadError::Invalid { place, diagnostic } => {
            let error = FileError { path: path.to_owned(), place, diagnostic };
            match misnamed(&bytes, format) {
                Some(other) => error.hint(format!("it looks like `.{other}`, which its name should end in")),
                None => error,
            }
        }
        ReadError::Stopped(stopped) => FileError::new(path, stopped.to_string()),
    })?;
    if mesh.set.is_empty() {
        let mut error = FileError::new(path, "no faces can be made of what is in it, so the mesh is empty");
        error.diagnostic.evidence.extend(warnings.into_iter().map(|warning| warning.message));
        return Err(error);
    }
    Ok((mesh, warnings))
}

/// The mesh format that a path's extension names.
fn mesh_format(path: &Path) -> Result<Format, FileError> {
    let extension = path.extension().unwrap_or_default().to_string_lossy();
    Format::from_extension(&extension).ok_or_else(|| {
        FileError::new(path, format!("`.{extension}` is no mesh format that vv reads"))
            .hint(format!("it reads {}", mesh_extensions("and")))
    })
}

/// The extensions of mesh files, for a sentence: `.obj`, `.off` and `.ply`.
#[must_use]
pub fn mesh_extensions(and: &str) -> String {
    let mut known: Vec<_> = Format::EXTENSIONS.iter().map(|extension| format!("`.{extension}`")).collect();
    let last = known.pop().unwrap_or_default();
    format!("{} {and} {last}", known.join(", "))
}

/// The extension that a mesh file should have if it is of another format than its name says.
fn misnamed(bytes: &[u8], format: Format) -> Option<&'static str> {
    let has_vertex = || bytes.split(|&b| b == b'\n').any(|line| line.starts_with(b"v "));
    let found = Format::of_bytes(bytes).or_else(|| has_vertex().then_some(Format::Obj))?;
    Some(found.extension()).filter(|&extension| extension != format.extension())
}

/// The bytes of a file or of standard input; `is_text` says of its beginning whether it should be text.
fn read(path: &Path, limit: u64, is_text: impl Fn(&[u8]) -> bool, stop: &Stop) -> Result<Vec<u8>, FileError> {
    const CHUNK: u64 = 1 << 20;
    let fail = |error: io::Error| FileError::new(path, sentence(&error));
    let mut bytes = Vec::new();
    let mut source: Box<dyn Read> = if is_standard_stream(path) {
        Box::new(io::stdin().lock())
    } else {
        let file = open(path)?;
        let length = file.metadata().map_or(0, |data| data.len().min(limit));
        // A little more: reading to the end asks once more.
        let _ = bytes.try_reserve_exact(length as usize + 64);
        Box::new(file)
    };
    loop {
        let count = source.by_ref().take(CHUNK).read_to_end(&mut bytes).map_err(fail)?;
        if count == 0 {
            return Ok(bytes);
        }
        if bytes.len() == count
            && let Some(error) = no_text(path, &bytes, is_text(&bytes))
        {
            return Err(error);
        }
        if bytes.len() as u64 > limit {
            return Err(FileError::new(path, format!("is longer than {} MiB", limit >> 20)));
        }
        stop.check().map_err(|stopped| FileError::new(path, stopped.to_string()))?;
    }
}

/// What a file is that begins with these bytes, if it is packed, or no text and should be. Texts hold no NUL; what does
/// is binary or a device without end.
fn no_text(path: &Path, bytes: &[u8], should_be: bool) -> Option<FileError> {
    let is = |message: &str| Some(FileError::new(path, format!("is no text: {message}")));
    if bytes.starts_with(b"\x1F\x8B") {
        return is("it is compressed by gzip").map(|error| error.hint("unpack it first, with `gunzip`"));
    }
    if bytes.starts_with(b"PK\x03\x04") {
        return is("it is a zip archive").map(|error| error.hint("unpack it first, with `unzip`"));
    }
    if !should_be || !bytes.contains(&0) {
        return None;
    }
    if bytes.starts_with(b"\xFF\xFE") || bytes.starts_with(b"\xFE\xFF") {
        return is("it is in UTF-16").map(|error| error.hint("save it as UTF-8"));
    }
    if bytes.starts_with(b"OFF BINARY") {
        return is("it is binary OFF").map(|error| error.hint("vv reads OFF that is text"));
    }
    let error = is("it holds NUL bytes");
    match Format::of_bytes(bytes).filter(|format| !format.is_text()) {
        Some(format) => error.map(|e| e.hint(format!("it looks like `.{}`", format.extension()))),
        None => error,
    }
}

fn open(path: &Path) -> Result<File, FileError> {
    let fail = |error: io::Error| FileError::new(path, sentence(&error));
    let file = File::open(path).map_err(fail)?;
    if file.metadata().map_err(fail)?.is_dir() {
        return Err(FileError::new(path, "is a directory, not a file"));
    }
    Ok(file)
}

/// What the file system says, in words of one line.
#[must_use]
pub fn sentence(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such file or directory".to_owned(),
        ErrorKind::PermissionDenied => "the file system does not permit it".to_owned(),
        ErrorKind::IsADirectory => "is a directory, not a file".to_owned(),
        ErrorKind::NotADirectory => "a part of the path is no directory".to_owned(),
        ErrorKind::StorageFull => "no space is left on the device".to_owned(),
        ErrorKind::BrokenPipe => CLOSED_PIPE.to_owned(),
        _ => {
            let text = error.to_string();
            let text = text.split(" (os error").next().unwrap_or_default();
            let mut letters = text.chars();
            letters.next().map_or_else(String::new, |first| first.to_lowercase().chain(letters).collect())
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[track_caller]
    fn fails(result: Result<impl std::fmt::Debug, FileError>, line: Option<u32>, message: &str) {
        let error = result.unwrap_err();
        let place = line.map(|line| Place::Text { line, column: None });
        assert_eq!((error.place, error.diagnostic.message.as_str()), (place, message));
    }

    #[test]
    fn a_program_is_utf8_with_or_without_byte_order_mark() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.vv");
        fs::write(&path, "\u{FEFF}// ü").unwrap();
        assert_eq!(read_program(&path).unwrap(), "// ü");
        fs::write(&path, b"// a\n// \xFC").unwrap();
        fails(read_program(&path), Some(2), "the text is not in UTF-8");
        fs::write(&path, [0; 9]).unwrap();
        fails(read_program(&path), None, "is no text: it holds NUL bytes");
        fs::write(&path, vec![b' '; MAX_PROGRAM_BYTES as usize + 1]).unwrap();
        fails(read_program(&path), None, "is longer than 16 MiB");
    }

    #[test]
    fn what_is_no_text_is_named() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("m.off");
        for (bytes, is) in [
            (b"\x1F\x8B\x08\x00\x00".as_slice(), "is no text: it is compressed by gzip"),
            (b"PK\x03\x04\x00", "is no text: it is a zip archive"),
            (b"\xFF\xFEv\x00 \x00", "is no text: it is in UTF-16"),
            (b"OFF BINARY\n\x00\x00", "is no text: it is binary OFF"),
            (b"OFF\n\x00", "is no text: it holds NUL bytes"),
        ] {
            fs::write(&path, bytes).unwrap();
            fails(read_mesh(&path, &ReadOptions::default()), None, is);
        }
    }

    #[test]
    fn a_mesh_under_the_name_of_another_format_is_known() {
        let folder = tempfile::tempdir().unwrap();
        for (name, text, hint) in [
            (
                "m.obj",
                "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                "it looks like `.off`, which its name should end in",
            ),
            ("m.off", "# by hand\nv 0 0 0\nv 1 0 0\n", "it looks like `.obj`, which its name should end in"),
            ("m.stl", "ply\nformat ascii 1.0\n", "it looks like `.ply`, which its name should end in"),
        ] {
            fs::write(folder.path().join(name), text).unwrap();
            let error = read_mesh(&folder.path().join(name), &ReadOptions::default()).unwrap_err();
            assert_eq!(error.diagnostic.hints.last().map(|h| h.message.as_str()), Some(hint));
        }
    }

    #[test]
    fn a_path_that_is_no_file_says_what_it_is() {
        let folder = tempfile::tempdir().unwrap();
        fails(read_program(folder.path()), None, "is a directory, not a file");
        fails(read_program(&folder.path().join("none.vv")), None, "there is no such file or directory");
        fs::write(folder.path().join("file"), "").unwrap();
        fails(read_program(&folder.path().join("file/p.vv")), None, "a part of the path is no directory");
    }

    #[test]
    fn a_mesh_format_is_known_by_extension_of_any_case() {
        assert_eq!(mesh_format(Path::new("a.b/c.OFF")), Ok(Format::Off));
        fails(mesh_format(Path::new("a.stp")), None, "`.stp` is no mesh format that vv reads");
    }

    #[test]
    fn a_mesh_without_name_is_known_by_how_it_begins() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("mesh");
        let (mesh, _) =
            vv::io::read(b"OFF 3 1 0 0 0 0 1 0 0 0 1 0 3 0 1 2", Format::Off, &ReadOptions::default()).unwrap();
        let faces = vv::mesh::faces::faces(&mesh, &Stop::new()).unwrap();
        for format in Format::ALL {
            fs::write(&path, vv::io::write(&mesh, &faces, format).unwrap().0).unwrap();
            let (again, _) = read_mesh(&path, &ReadOptions::default()).unwrap();
            assert_eq!(again.positions(), mesh.positions(), "{format:?}");
        }
    }

    #[test]
    fn an_include_is_found_beside_its_includer_and_has_one_name() {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("sub")).unwrap();
        fs::write(folder.path().join("sub/b.vv"), "B").unwrap();
        fs::write(folder.path().join("sub/c.vv"), "C").unwrap();
        let main = folder.path().join("a.vv");
        fs::write(&main, "A").unwrap();
        let mut includes = Includes::new(&main, "a.vv");
        let b = includes.find("a.vv", "sub/b.vv", &|_| None).unwrap();
        assert_eq!(b.text, "B");
        let c = includes.find(&b.name, "c.vv", &|_| None).unwrap();
        assert_eq!(c.text, "C");
        assert_eq!(includes.find("a.vv", "sub/../sub/c.vv", &|_| None).unwrap().name, c.name);
        assert_eq!(includes.find(&b.name, "../a.vv", &|_| None).unwrap().name, "a.vv");
        assert!(includes.find("a.vv", "none.vv", &|_| None).unwrap_err().contains("none.vv"));
        assert!(includes.looked_at.contains(&folder.path().join("none.vv")));
    }
}
