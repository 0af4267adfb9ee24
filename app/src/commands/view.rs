//! `--view`: from where pictures, and the window, look.

use std::path::Path;

use app::files;
use app::viewpoint::{self, Viewpoint};
use vv::diagnostic::Diagnostic;
use vv::source::{Sources, Span};

use super::report::Reporter;
use super::{Exit, input};

/// Reads what was given: a viewpoint, or a file with one.
///
/// # Errors
/// [`Exit::Usage`] if it is no viewpoint, [`Exit::File`] if the file cannot be read; reported at the place of the text.
pub fn read(given: &str, reporter: &Reporter) -> Result<Viewpoint, Exit> {
    let mistake = match viewpoint::parse(given) {
        Ok(viewpoint) => return Ok(viewpoint),
        Err(mistake) => mistake,
    };
    let path = Path::new(given);
    if !path.is_file() {
        return Err(report(mistake, "--view", given, reporter));
    }
    let text = files::read_program(path).map_err(|error| input::file_failed(&error, reporter))?;
    viewpoint::parse(&text).map_err(|mistake| report(mistake, &files::shown(path), &text, reporter))
}

fn report(mistake: viewpoint::Mistake, name: &str, text: &str, reporter: &Reporter) -> Exit {
    let mut sources = Sources::default();
    let file = sources.add(name, text);
    let span = Span::new(file, mistake.range.start as u32, mistake.range.end as u32);
    let diagnostic = Diagnostic::error(span, mistake.message);
    let diagnostic = match mistake.hint {
        Some(hint) => diagnostic.hint(hint),
        None => diagnostic,
    };
    reporter.report(&[diagnostic], &sources);
    Exit::Usage
}
