//! `--style`: words, and files of what pictures look like.

use std::path::{Path, PathBuf};

use app::files::FileError;
use app::style_file::{Misfit, StyleFile, place_of};

use super::look::{self, Look, Word};
use super::report::Reporter;
use super::{Exit, input};

/// What was given.
#[derive(Debug, Clone)]
pub enum Given {
    /// One of the words.
    Word(Word),
    /// A file.
    File(PathBuf),
}

/// Reads what was given.
pub fn given(text: &str) -> Result<Given, String> {
    match look::word(text) {
        Ok(word) => Ok(Given::Word(word)),
        Err(_) if text.contains(['.', '/', std::path::MAIN_SEPARATOR]) => Ok(Given::File(text.into())),
        Err(message) => Err(format!("{message}; a file has an extension, such as look.json")),
    }
}

/// The files among them.
pub fn files(given: &[Given]) -> impl Iterator<Item = &PathBuf> {
    given.iter().filter_map(|given| match given {
        Given::File(path) => Some(path),
        Given::Word(_) => None,
    })
}

/// What the files say, then the words, wherever they stand.
///
/// # Errors
/// [`Exit::File`] if a file cannot be read or is wrong; reported at its place.
pub fn look(given: &[Given], reporter: &Reporter) -> Result<Look, Exit> {
    let mut look = Look::default();
    for path in files(given) {
        look = read(path).map_err(|error| input::file_failed(&error, reporter))?;
    }
    for given in given {
        if let Given::Word(word) = given {
            word.apply(&mut look.style);
        }
    }
    Ok(look)
}

fn read(path: &Path) -> Result<Look, FileError> {
    let (file, text) = StyleFile::read(path)?;
    let wrong = |mistake: Misfit| {
        let names: Vec<&str> = mistake.names.iter().map(String::as_str).collect();
        FileError::at(path, place_of(&text, &names), mistake.message, None)
    };
    let mut look = Look { style: file.style, annotations: file.annotations.clone(), ..Look::default() };
    look.notes.labels.clone_from(&look.annotations.labels);
    look.background = file.backdrop().map_err(wrong)?;
    look.figure = file.figures().map_err(wrong)?;
    look.has_page = file.page.is_some();
    Ok(look)
}
