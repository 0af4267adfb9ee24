//! What `--summary json` writes.

use serde::Serialize;
use vv::mesh::statistics::Statistics;

/// The result of a run as numbers.
#[derive(Debug, Serialize)]
pub struct Summary {
    vertices: usize,
    edges: usize,
    faces: usize,
    components: usize,
    boundary_loops: usize,
    euler_characteristic: i64,
    /// Null if the mesh is not valid.
    genus: Option<u64>,
    closed: bool,
    valid: bool,
    /// Messages of everything that was warned of: by the checker, on import, after steps.
    warnings: Vec<String>,
    timings: Timings,
}

/// Where the time went, in seconds.
#[derive(Debug, Default, Serialize)]
pub struct Timings {
    /// Reading the mesh.
    pub load_s: f64,
    /// Reading and checking the program.
    pub compile_s: f64,
    /// The program's part of each step.
    pub steps_s: Vec<f64>,
    /// Closing each step.
    pub closing_s: Vec<f64>,
    /// Finding the faces of the result.
    pub faces_s: f64,
    /// Writing meshes.
    pub export_s: f64,
    /// Drawing and writing pictures.
    pub render_s: f64,
    /// Since the process began.
    pub total_s: f64,
}

impl Summary {
    /// Of a mesh with these counts.
    pub fn new(statistics: Statistics, warnings: Vec<String>, timings: Timings) -> Self {
        let Statistics {
            vertices,
            edges,
            faces,
            components,
            boundary_loops,
            euler_characteristic,
            genus,
            closed,
            valid,
            valences: _,
            face_degrees: _,
        } = statistics;
        Self {
            vertices,
            edges,
            faces,
            components,
            boundary_loops,
            euler_characteristic,
            genus,
            closed,
            valid,
            warnings,
            timings,
        }
    }
}
