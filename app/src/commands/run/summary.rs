//! What `--summary json` writes.

use std::collections::BTreeMap;

use serde::Serialize;
use vv::mesh::Value;
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
    /// Most memory the process has taken so far, in bytes; null where the system does not tell.
    peak_memory_bytes: Option<u64>,
}

/// The summary of one of several.
#[derive(Debug, Serialize)]
pub struct Line {
    /// The mesh that was read.
    pub input: Option<String>,
    /// The values that parameters were given.
    pub parameters: BTreeMap<String, serde_json::Value>,
    /// How often the rule was applied.
    pub generation: u64,
    /// The rest.
    #[serde(flatten)]
    pub summary: Summary,
}

/// Where the time went, in seconds.
#[derive(Debug, Clone, Default, Serialize)]
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
            peak_memory_bytes: peak_memory(),
        }
    }
}

impl Line {
    /// On one line.
    pub fn text(&self) -> String {
        // As with [`crate::commands::info::json`], nothing in it can fail.
        serde_json::to_string(self).unwrap_or_default() + "\n"
    }
}

/// A value in JSON.
pub fn value(value: Value) -> serde_json::Value {
    match value {
        Value::Bool(b) => b.into(),
        Value::Int(i) => i.into(),
        Value::Double(x) => x.into(),
        Value::Vec(v) => v.to_array().to_vec().into(),
        Value::Vertex(_) => serde_json::Value::Null, // no parameter is one
    }
}

fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes * 1024)
}
