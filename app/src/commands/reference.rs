//! `--reference`: the result compared with an earlier one.

use std::path::{Path, PathBuf};

use app::compare::meshes::compare_meshes;
use app::evaluation::within;
use vv::mesh::Mesh;
use vv::mesh::faces::{Faces, faces};

use super::output::Size;
use super::report::Reporter;
use super::{Exit, Importing, error, fail, input};

/// Positions may be off by this much if nobody says.
const MESH_TOLERANCE: f64 = 1e-9;

/// An earlier result.
pub struct Reference {
    path: PathBuf,
    what: What,
}

enum What {
    Mesh(Mesh, Faces),
}

impl Reference {
    /// Reads it; before the run, which may write to the same file.
    ///
    /// # Errors
    /// [`Exit::File`] or [`Exit::Budget`], reported.
    pub fn read(path: &Path, options: &Importing, reporter: &Reporter) -> Result<Self, Exit> {
        let (mesh, _) = input::mesh(path, options, reporter)?;
        let what = match within(options.timeout.0, |stop| faces(&mesh, stop)) {
            Ok(faces) => What::Mesh(mesh, faces),
            Err(stopped) => return fail(reporter, Exit::Budget, error(stopped.to_string())),
        };
        Ok(Self { path: path.to_owned(), what })
    }

    /// Compares.
    ///
    /// # Errors
    /// [`Exit::Different`], reported with the greatest difference and where it is.
    pub fn compare(
        &self,
        mesh: &Mesh,
        faces: &Faces,
        _size: Option<Size>,
        tolerance: Option<f64>,
        reporter: &Reporter,
    ) -> Result<(), Exit> {
        let difference = match &self.what {
            What::Mesh(reference, reference_faces) => {
                let tolerance = tolerance.unwrap_or(MESH_TOLERANCE);
                let result = compare_meshes((mesh, faces), (reference, reference_faces), tolerance);
                result.err().map(|difference| format!("the mesh is not that of {}: {difference}", self.path.display()))
            }
        };
        difference.map_or(Ok(()), |difference| fail(reporter, Exit::Different, error(difference)))
    }
}
