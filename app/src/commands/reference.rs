//! `--reference`: the result compared with an earlier one.

use std::path::{Path, PathBuf};

use app::compare::meshes::compare_meshes;
use app::compare::pictures::compare_pictures;
use app::evaluation::within;
use app::files;
use image::{ImageFormat, ImageReader, Limits, RgbaImage};
use vv::mesh::Mesh;
use vv::mesh::faces::{Faces, faces};

use super::output::Size;
use super::report::Reporter;
use super::{Exit, Importing, error, fail, input};

/// Positions may be off by this much if nobody says.
const MESH_TOLERANCE: f64 = 1e-9;

/// Channels from 0 to 1 may be off by this much if nobody says: a driver draws the same picture every time.
const PICTURE_TOLERANCE: f64 = 0.0;

/// An earlier result.
pub struct Reference {
    path: PathBuf,
    what: What,
}

enum What {
    Mesh(Mesh, Faces),
    Picture(RgbaImage),
}

impl Reference {
    /// Reads it; before the run, which may write to the same file.
    ///
    /// # Errors
    /// [`Exit::File`] or [`Exit::Budget`], reported.
    pub fn read(path: &Path, options: &Importing, reporter: &Reporter) -> Result<Self, Exit> {
        let what = if is_picture(path) { read_picture(path, reporter)? } else { read_mesh(path, options, reporter)? };
        Ok(Self { path: path.to_owned(), what })
    }

    /// The size of the picture.
    pub fn size(&self) -> Option<Size> {
        match &self.what {
            What::Mesh(..) => None,
            What::Picture(reference) => Some(reference.dimensions()),
        }
    }

    /// Whether a picture is needed to compare with.
    pub fn is_picture(&self) -> bool {
        self.size().is_some()
    }

    /// Compares.
    ///
    /// # Errors
    /// [`Exit::Different`], reported with the greatest difference and where it is.
    pub fn compare(
        &self,
        (mesh, faces): (&Mesh, &Faces),
        picture: Option<&RgbaImage>,
        tolerance: Option<f64>,
        reporter: &Reporter,
    ) -> Result<(), Exit> {
        let path = self.path.display();
        let difference = match (&self.what, picture) {
            (What::Mesh(reference, reference_faces), _) => {
                let tolerance = tolerance.unwrap_or(MESH_TOLERANCE);
                let result = compare_meshes((mesh, faces), (reference, reference_faces), tolerance);
                result.err().map(|difference| format!("the mesh is not that of {path}: {difference}"))
            }
            (What::Picture(reference), Some(picture)) => {
                let result = compare_pictures(picture, reference, tolerance.unwrap_or(PICTURE_TOLERANCE));
                result.err().map(|difference| format!("the picture is not {path}: {difference}"))
            }
            (What::Picture(_), None) => Some(format!("there is no picture to compare with {path}")),
        };
        difference.map_or(Ok(()), |difference| fail(reporter, Exit::Different, error(difference)))
    }
}

/// Whether a path names a picture.
pub fn is_picture(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"))
}

fn read_mesh(path: &Path, options: &Importing, reporter: &Reporter) -> Result<What, Exit> {
    let (mesh, _) = input::mesh(path, options, reporter)?;
    match within(options.timeout.0, |stop| faces(&mesh, stop)) {
        Ok(faces) => Ok(What::Mesh(mesh, faces)),
        Err(stopped) => fail(reporter, Exit::Budget, error(stopped.to_string())),
    }
}

fn read_picture(path: &Path, reporter: &Reporter) -> Result<What, Exit> {
    files::check_readable(path).map_err(|error| input::file_failed(&error, reporter))?;
    let mut limits = Limits::default();
    limits.max_alloc = Some(4 << 30);
    let picture = ImageReader::open(path).map_err(image::ImageError::IoError).and_then(|mut reader| {
        reader.set_format(ImageFormat::Png);
        reader.limits(limits);
        reader.decode()
    });
    match picture {
        Ok(picture) => Ok(What::Picture(picture.into_rgba8())),
        Err(problem) => {
            let message = format!("{}: is no PNG picture that can be read: {problem}", path.display());
            fail(reporter, Exit::File, error(message))
        }
    }
}
