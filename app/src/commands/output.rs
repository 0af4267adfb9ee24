//! Files that commands write: meshes, pictures and figures.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::time::Instant;

use app::figure;
use app::files::{self, Prepared};
use app::viewpoint::Viewpoint;
use clap::Args;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use image::RgbaImage;
use vv::diagnostic::Diagnostic;
use vv::io::Format;

use super::look;
use super::picture::Shot;
use super::report::Reporter;
use super::{Exit, error, fail, input, picture, view};

/// What to write.
#[derive(Debug, Args)]
#[command(next_help_heading = "Output")]
pub struct OutputArguments {
    /// Write a mesh, a picture or a figure; `-` is stdout.
    ///
    /// The mesh as .obj, .off, .ply, .stl, .glb or .gltf, a picture of it as .png (.gif if it moves), or a figure for a
    /// paper, of lines and areas, as .svg, .eps or .pdf. May be repeated.
    #[arg(short, long = "output", value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// What `-o -` writes, and files whose extension does not say.
    #[arg(long, value_parser = kind())]
    format: Option<Kind>,
    /// Size of pictures in pixels.
    ///
    /// Default: that of the reference picture, else 1280x960.
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<Size>,
    /// From where pictures look.
    ///
    /// A viewpoint that was copied in the window (`vv view: eye … target … up … perspective …`), a file with one, or a
    /// side: front, back, left, right, top, bottom, isometric; `orthographic` and `z-up` may follow. Default: the whole
    /// mesh, a little from above.
    #[arg(long, value_name = "TEXT|FILE|SIDE")]
    view: Option<String>,
}

/// What a file is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// A mesh.
    Mesh(Format),
    /// A picture in pixels.
    Picture,
    /// A figure of lines and areas.
    Figure(figure::Format),
}

/// The extension and name of pictures.
const PICTURE: &str = "png";

/// The extension of pictures that move.
const FILM: &str = "gif";

fn kind() -> impl TypedValueParser<Value = Kind> {
    let figures = figure::Format::ALL.map(figure::Format::extension);
    let names = Format::ALL.map(Format::name).into_iter().chain([PICTURE]).chain(figures);
    PossibleValuesParser::new(names).map(|name| match Format::from_name(&name) {
        Some(format) => Kind::Mesh(format),
        None => figure::Format::from_extension(&name).map_or(Kind::Picture, Kind::Figure),
    })
}

/// Width and height in pixels.
pub type Size = (u32, u32);

/// Of pictures, when nobody says.
pub const DEFAULT_SIZE: Size = (1280, 960);

/// Most pixels of a picture: a gigabyte.
const MOST_PIXELS: u64 = 1 << 28;

/// A file to write.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Target {
    path: PathBuf,
    kind: Kind,
}

/// What was written, and how long it took.
#[derive(Debug, Default)]
pub struct Outputs {
    /// Ready to be put in their places.
    pub prepared: Vec<Prepared>,
    /// The picture, if one was drawn.
    pub picture: Option<RgbaImage>,
    /// Seconds for meshes.
    pub export_s: f64,
    /// Seconds for pictures.
    pub render_s: f64,
}

impl OutputArguments {
    /// Whether stdout is taken.
    pub fn to_stdout(&self) -> bool {
        self.output.iter().any(|path| files::is_standard_stream(path))
    }

    /// The size of pictures that was asked for.
    pub fn size(&self) -> Option<Size> {
        self.size
    }

    /// From where pictures look, if that was said.
    ///
    /// # Errors
    /// [`Exit::Usage`] or [`Exit::File`], reported.
    pub fn viewpoint(&self, reporter: &Reporter) -> Result<Option<Viewpoint>, Exit> {
        self.view.as_deref().map(|given| view::read(given, reporter)).transpose()
    }

    /// The file that says from where pictures look, if one does.
    pub fn view_file(&self) -> Option<PathBuf> {
        self.view.as_ref().map(PathBuf::from).filter(|path| path.is_file())
    }

    /// What to write, checked: formats are known and each place can be written to.
    ///
    /// # Errors
    /// [`Exit::Usage`] or [`Exit::File`], reported.
    pub fn targets(&self, reporter: &Reporter) -> Result<Vec<Target>, Exit> {
        let targets = self.formats(reporter)?;
        if let Some(film) = targets.iter().find(|target| target.is_film()) {
            let message = format!("`-o {}`: nothing moves here", film.path.display());
            return fail(
                reporter,
                Exit::Usage,
                error(message).hint("`vv render` goes around a mesh with `--turntable`"),
            );
        }
        check_places(&targets, reporter)?;
        Ok(targets)
    }

    /// What to write, without a look at the places.
    ///
    /// # Errors
    /// [`Exit::Usage`], reported.
    pub fn formats(&self, reporter: &Reporter) -> Result<Vec<Target>, Exit> {
        let mut targets: Vec<Target> = Vec::new();
        for path in &self.output {
            if let Some(other) =
                targets.iter().map(Target::path).find(|other| files::place(other) == files::place(path))
            {
                return fail(reporter, Exit::Usage, given_twice(other, path));
            }
            match self.kind_of(path) {
                Ok(kind) => targets.push(Target { path: path.clone(), kind }),
                Err(diagnostic) => return fail(reporter, Exit::Usage, *diagnostic),
            }
        }
        if targets.iter().any(|target| target.kind == Kind::Picture) {
            picture::keep_driver_quiet();
        }
        Ok(targets)
    }

    fn kind_of(&self, path: &Path) -> Result<Kind, Box<Diagnostic>> {
        let extension = path.extension().unwrap_or_default().to_string_lossy();
        if let Some(format) = Format::from_extension(&extension) {
            return Ok(match self.format {
                Some(Kind::Mesh(asked)) if asked.extension() == format.extension() => Kind::Mesh(asked),
                _ => Kind::Mesh(format),
            });
        }
        if let Some(format) = figure::Format::from_extension(&extension) {
            return Ok(Kind::Figure(format));
        }
        if [PICTURE, FILM].iter().any(|known| extension.eq_ignore_ascii_case(known)) {
            return Ok(Kind::Picture);
        }
        match self.format {
            Some(kind) => Ok(kind),
            None if files::is_standard_stream(path) => {
                Err(error("`-o -` does not say what to write").hint("add `--format obj`, `ply`, `png`, …").into())
            }
            None => Err(error(format!("`-o {}` has no extension that vv writes", path.display()))
                .hint(format!(
                    "write {}, a picture, `.png`, or a figure, `.svg`, `.eps` or `.pdf`, or say `--format`",
                    files::mesh_extensions("or")
                ))
                .into()),
        }
    }
}

impl Target {
    /// The same in another place.
    pub fn at(&self, path: PathBuf) -> Self {
        Self { path, ..*self }
    }

    /// Whether it is a mesh.
    pub fn is_mesh(&self) -> bool {
        matches!(self.kind, Kind::Mesh(_))
    }

    /// Whether it is a picture in pixels.
    pub fn is_picture(&self) -> bool {
        self.kind == Kind::Picture
    }

    /// Which figure it is, if it is one.
    pub fn figure(&self) -> Option<figure::Format> {
        match self.kind {
            Kind::Figure(format) => Some(format),
            _ => None,
        }
    }

    /// Whether it shows a mesh, so that it can show several.
    pub fn is_shown(&self) -> bool {
        self.is_picture() || self.figure().is_some()
    }

    /// Whether it is a picture that moves.
    pub fn is_film(&self) -> bool {
        self.is_picture() && self.path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(FILM))
    }

    /// Where.
    pub fn path(&self) -> &Path {
        &self.path
    }
}

/// What is wrong with two outputs that are the same file.
pub fn given_twice(one: &Path, other: &Path) -> Diagnostic {
    if one == other {
        return error(format!("`-o {}` is given twice", one.display()));
    }
    error(format!("`-o {}` and `-o {}` are the same file", one.display(), other.display()))
}

/// Whether each place can be written to, so that nobody waits for a result that cannot be kept. Of new files in one
/// folder only the first is looked at.
///
/// # Errors
/// [`Exit::File`], reported.
pub fn check_places(targets: &[Target], reporter: &Reporter) -> Result<(), Exit> {
    let mut folders = BTreeSet::new();
    for Target { path, .. } in targets {
        if folders.insert(path.parent()) || path.exists() {
            files::prepare(path, &[]).map_err(|error| input::file_failed(&error, reporter))?;
        }
    }
    Ok(())
}

/// Makes all outputs and writes them beside their places. All pictures of a run are the same one, which is also made
/// `with_picture`.
///
/// # Errors
/// [`Exit::File`] or [`Exit::NoRenderer`], reported.
pub fn prepare(
    targets: &[Target],
    shot: Shot<'_>,
    with_picture: bool,
    result: look::Result<'_>,
    reporter: &Reporter,
) -> Result<Outputs, Exit> {
    let mut outputs = Outputs::default();
    if with_picture || targets.iter().any(|target| target.kind == Kind::Picture) {
        reporter.progress("drawing the picture".to_owned());
        let began = Instant::now();
        outputs.picture = Some(picture::picture(result, shot, reporter)?);
        outputs.render_s = began.elapsed().as_secs_f64();
    }
    let mut drawing = None;
    for &Target { ref path, kind } in targets {
        reporter.progress(format!("writing {}", path.display()));
        let began = Instant::now();
        let bytes = match (kind, &outputs.picture) {
            (Kind::Mesh(format), _) => match vv::io::write(result.mesh, result.faces, format) {
                Ok((bytes, losses)) => {
                    losses.into_iter().for_each(|loss| reporter.report_once(loss));
                    bytes
                }
                Err(problem) => return fail(reporter, Exit::File, error(problem.to_string())),
            },
            (Kind::Figure(format), _) => {
                let drawing = match &mut drawing {
                    Some(drawing) => drawing,
                    None => drawing.insert(picture::figure(result, shot, reporter)?),
                };
                figure::write(drawing, format)
            }
            (Kind::Picture, Some(picture)) => picture::png(picture, reporter)?,
            (Kind::Picture, None) => Vec::new(),
        };
        outputs.prepared.push(files::prepare(path, &bytes).map_err(|error| input::file_failed(&error, reporter))?);
        let is_mesh = matches!(kind, Kind::Mesh(_));
        *if is_mesh { &mut outputs.export_s } else { &mut outputs.render_s } += began.elapsed().as_secs_f64();
    }
    Ok(outputs)
}

/// Puts them in their places.
///
/// # Errors
/// [`Exit::File`], reported; a closed pipe ends quietly.
pub fn commit(prepared: Vec<Prepared>, reporter: &Reporter) -> Result<(), Exit> {
    files::commit(prepared).map_err(|error| {
        if !error.is_closed_pipe() {
            input::file_failed(&error, reporter);
        }
        Exit::File
    })
}

fn size(text: &str) -> Result<Size, String> {
    let sides = text.split_once(['x', 'X', '×']).and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    let (w, h) = sides.filter(|&(w, h)| w > 0 && h > 0).ok_or("a size is width and height such as 1280x960")?;
    if u64::from(w) * u64::from(h) > MOST_PIXELS {
        return Err(format!("a picture has at most {MOST_PIXELS} pixels"));
    }
    Ok((w, h))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_two_positive_numbers() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for wrong in ["640", "0x480", "640x", "-1x1", "axb", "1x2x3", "99999x99999"] {
            assert!(size(wrong).is_err(), "{wrong}");
        }
    }
}
