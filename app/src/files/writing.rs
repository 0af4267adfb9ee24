//! Writing whole or not at all: into a temporary file beside the destination, then rename.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use tempfile::NamedTempFile;

use super::{FileError, is_standard_stream, sentence};

/// Bytes that are safely on their way: only the last, short part of writing is left. Dropped, nothing happened.
#[derive(Debug)]
pub struct Prepared {
    path: PathBuf,
    target: Target,
}

#[derive(Debug)]
enum Target {
    /// A file, already whole under another name.
    File { temporary: Temporary, destination: PathBuf },
    /// Standard output, a device or a pipe: cannot be renamed over.
    Stream(Vec<u8>),
}

/// Writes a file whole or not at all.
///
/// # Errors
/// What the file system says; the file is then as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    commit(vec![prepare(path, bytes)?])
}

/// Writes the bytes beside the file they are meant for, with its permissions; [`commit`] puts them in its place. `-` is
/// standard output.
///
/// # Errors
/// What the file system says: a directory that is missing or may not be written to, a file that may not be, no space.
pub fn prepare(path: &Path, bytes: &[u8]) -> Result<Prepared, FileError> {
    let target = if is_standard_stream(path) {
        Ok(Target::Stream(bytes.to_owned()))
    } else {
        target(path, bytes).map_err(|(place, error)| match error.kind() {
            // A file system that has no room for files of ours, as that of the kernel's processes, says so too.
            ErrorKind::NotFound if place.is_dir() => {
                let system = error.to_string();
                let system = system.split(" (os error").next().unwrap_or_default();
                let message = format!("no file can be made in `{}`; the system says \"{system}\"", place.display());
                FileError::new(path, message)
            }
            ErrorKind::NotFound => FileError::new(path, format!("there is no directory `{}`", place.display())),
            ErrorKind::PermissionDenied => FileError::new(path, format!("may not write to `{}`", place.display())),
            _ => FileError::new(path, sentence(&error)),
        })
    }?;
    Ok(Prepared { path: path.to_owned(), target })
}

/// Whether a file can be written here, as far as that is known before it is: its room is not.
///
/// # Errors
/// As [`prepare`].
pub fn check_writable(path: &Path) -> Result<(), FileError> {
    prepare(path, &[]).map(drop)
}

/// Puts prepared files in their places: streams first, because only they can fail for want of space or readers.
///
/// # Errors
/// What the file system says. If a stream fails no file is written.
pub fn commit(prepared: Vec<Prepared>) -> Result<(), FileError> {
    let (streams, files): (Vec<_>, Vec<_>) = prepared.into_iter().partition(|p| matches!(p.target, Target::Stream(_)));
    for Prepared { path, target } in streams.into_iter().chain(files) {
        let result = match target {
            Target::Stream(bytes) if is_standard_stream(&path) => {
                let mut out = io::stdout().lock();
                out.write_all(&bytes).and_then(|()| out.flush())
            }
            Target::Stream(bytes) => OpenOptions::new().write(true).open(&path).and_then(|mut f| f.write_all(&bytes)),
            Target::File { temporary, destination } => temporary.persist(&destination),
        };
        result.map_err(|error| {
            let path = if is_standard_stream(&path) { Path::new("<stdout>") } else { &path };
            FileError::new(path, sentence(&error))
        })?;
    }
    Ok(())
}

/// The temporary files that exist now.
static TEMPORARIES: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Takes away what is half written. For a process that is about to end and unwinds nothing: whoever writes a file from
/// now on waits for ever.
pub fn abandon() {
    let temporaries = temporaries();
    for path in &*temporaries {
        let _ = fs::remove_file(path);
    }
    std::mem::forget(temporaries);
}

fn temporaries() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    TEMPORARIES.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A temporary file that [`abandon`] knows of.
#[derive(Debug)]
struct Temporary(Option<NamedTempFile>);

impl Temporary {
    /// In a folder; becomes an ordinary file: with the permissions a new one gets.
    fn create(folder: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".vv-").suffix(".tmp");
        #[cfg(unix)]
        builder.permissions(<Permissions as std::os::unix::fs::PermissionsExt>::from_mode(0o666));
        let mut temporaries = temporaries();
        let file = builder.tempfile_in(folder)?;
        temporaries.insert(file.path().to_owned());
        Ok(Self(Some(file)))
    }

    fn file(&mut self) -> io::Result<&mut File> {
        self.0.as_mut().map(NamedTempFile::as_file_mut).ok_or_else(|| ErrorKind::NotFound.into())
    }

    fn persist(mut self, destination: &Path) -> io::Result<()> {
        let mut temporaries = temporaries();
        let Some(file) = self.0.take() else { return Ok(()) };
        temporaries.remove(file.path());
        file.persist(destination).map(drop).map_err(|error| error.error)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            // Held until the file is gone, which nobody else knows of then.
            let mut temporaries = temporaries();
            temporaries.remove(file.path());
            drop(file);
        }
    }
}

/// Errors come with the place they are about.
fn target(path: &Path, bytes: &[u8]) -> Result<Target, (PathBuf, io::Error)> {
    let destination = behind_links(path).map_err(|error| (path.to_owned(), error))?;
    let at_file = |error| (destination.clone(), error);
    let existing = match fs::metadata(&destination) {
        Ok(metadata) if metadata.is_dir() => return Err(at_file(ErrorKind::IsADirectory.into())),
        Ok(metadata) if !metadata.is_file() => return Ok(Target::Stream(bytes.to_owned())),
        Ok(metadata) => {
            // A rename would replace a file that its owner protected from writing.
            OpenOptions::new().write(true).open(&destination).map_err(at_file)?;
            Some(metadata.permissions())
        }
        Err(error) if error.kind() == ErrorKind::NotFound => None,
        Err(error) => return Err(at_file(error)),
    };
    let folder = match destination.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    };
    let at_folder = |error| (folder.to_owned(), error);
    let mut temporary = Temporary::create(folder).map_err(at_folder)?;
    let file = temporary.file().map_err(at_folder)?;
    file.write_all(bytes).map_err(at_file)?;
    if let Some(permissions) = existing {
        file.set_permissions(permissions).map_err(at_file)?;
    }
    // Some file systems tell only now that there is no room.
    file.sync_all().map_err(at_file)?;
    Ok(Target::File { temporary, destination })
}

/// Where a file is, or would be: the same for whatever it is called by, and for links to it.
#[must_use]
pub fn place(path: &Path) -> PathBuf {
    let file = behind_links(path).unwrap_or_else(|_| path.to_owned());
    let folder = file.parent().map(|folder| if folder == Path::new("") { Path::new(".") } else { folder });
    match (folder.and_then(|folder| folder.canonicalize().ok()), file.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => std::path::absolute(&file).unwrap_or(file),
    }
}

/// Follows links to what they name, there or not: a rename over a link would replace the link.
fn behind_links(path: &Path) -> io::Result<PathBuf> {
    const MAX_LINKS: u32 = 40;
    // Links of the kernel (`/dev/stdout` to a pipe) name nothing that could be followed by its text.
    if fs::metadata(path).is_ok_and(|m| !m.is_file()) {
        return Ok(path.to_owned());
    }
    let mut path = path.to_owned();
    for _ in 0..MAX_LINKS {
        if !path.symlink_metadata().is_ok_and(|m| m.is_symlink()) {
            return Ok(path);
        }
        let link = fs::read_link(&path)?;
        path = path.parent().unwrap_or(Path::new("")).join(link);
    }
    Err(io::Error::other("too many links lead on from each other"))
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use super::*;
    use std::os::unix::fs::{PermissionsExt, symlink};

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[track_caller]
    fn fails(path: &Path, message: &str) {
        assert_eq!(write(path, b"new").unwrap_err().diagnostic.message, message);
    }

    #[test]
    fn an_old_file_is_replaced_and_keeps_its_permissions() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "old and longer").unwrap();
        fs::set_permissions(&path, Permissions::from_mode(0o640)).unwrap();
        write(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        assert_eq!(names(folder.path()), ["a"]);
    }

    #[test]
    fn a_new_file_has_the_permissions_of_any_new_file() {
        let folder = tempfile::tempdir().unwrap();
        write(&folder.path().join("a"), b"new").unwrap();
        fs::write(folder.path().join("b"), "").unwrap();
        let mode = |name| fs::metadata(folder.path().join(name)).unwrap().permissions().mode();
        assert_eq!(mode("a"), mode("b"));
    }

    #[test]
    fn a_file_has_one_place_whatever_it_is_called_by() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| place(&folder.path().join(name));
        fs::create_dir(folder.path().join("sub")).unwrap();
        symlink("a", folder.path().join("link")).unwrap();
        symlink("sub", folder.path().join("folder")).unwrap();
        for (one, other) in [("a", "./a"), ("a", "sub/../a"), ("a", "link"), ("sub/a", "folder/a"), ("no/a", "no/./a")]
        {
            assert_eq!(at(one), at(other), "{one} {other}");
        }
        assert_ne!(at("a"), at("sub/a"));
    }

    #[test]
    fn a_link_stays_a_link() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        symlink("file", &link).unwrap();
        for _ in 0..2 {
            write(&link, b"new").unwrap();
            assert!(link.symlink_metadata().unwrap().is_symlink());
            assert_eq!(fs::read(&file).unwrap(), b"new");
        }
        symlink("loop", folder.path().join("loop")).unwrap();
        fails(&folder.path().join("loop"), "too many links lead on from each other");
    }

    #[test]
    fn a_place_that_cannot_be_written_says_why() {
        let folder = tempfile::tempdir().unwrap();
        fails(folder.path(), "is a directory, not a file");
        let missing = folder.path().join("no");
        fails(&missing.join("a"), &format!("there is no directory `{}`", missing.display()));
        #[cfg(target_os = "linux")]
        fails(Path::new("/proc/a"), "no file can be made in `/proc`; the system says \"No such file or directory\"");
    }

    #[test]
    fn nothing_happens_before_commit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        fs::write(&path, "old").unwrap();
        drop(prepare(&path, b"new").unwrap());
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a"]);
    }

    #[test]
    fn a_full_device_fails_before_any_file_is_renamed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a");
        let prepared = vec![prepare(&path, b"new").unwrap(), prepare(Path::new("/dev/full"), b"new").unwrap()];
        assert_eq!(commit(prepared).unwrap_err().diagnostic.message, "no space is left on the device");
        assert!(names(folder.path()).is_empty());
    }
}
