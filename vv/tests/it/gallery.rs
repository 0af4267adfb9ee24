//! The shipped programs that are for looking at: fractals, a tiling, a tissue, textures.
//!
//! Counts and sizes are compared with closed forms; what has none is held to its invariants at every step.

mod growth;
mod patterns;
mod remesh;

use std::path::Path;

use glam::DVec3;
use vv::engine::{Engine, Machine, Settings};
use vv::io::{Format, ReadOptions, read};
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::statistics::{Statistics, statistics};
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::Stop;

use crate::engines::compile_file;

/// A shipped program and what it has made so far.
pub struct Show {
    machine: Machine,
    settings: Settings,
    generation: u64,
    /// As it stands.
    pub mesh: Mesh,
}

impl Show {
    /// Runs the program's `start` on nothing.
    #[track_caller]
    pub fn new(file: &str, params: &[(&str, Value)]) -> Self {
        Self::on(Mesh::new(), file, params)
    }

    /// Runs the program's `start` on a shipped mesh.
    #[track_caller]
    pub fn on_mesh(mesh: &str, file: &str, params: &[(&str, Value)]) -> Self {
        let bytes = std::fs::read(assets().join("meshes").join(mesh)).unwrap();
        Self::on(read(&bytes, Format::Obj, &ReadOptions::default()).unwrap().0, file, params)
    }

    #[track_caller]
    fn on(mesh: Mesh, file: &str, params: &[(&str, Value)]) -> Self {
        let program = compile_file(&assets().join("programs").join(file));
        let param = |name: &str| program.params().find(|(_, global, _)| global.name == name).unwrap().0;
        let params = params.iter().map(|&(name, value)| (param(name), value)).collect();
        let settings = Settings { params, seed: 7, ..Settings::default() };
        let machine = Machine::new(program, Engine::Native);
        assert_eq!(machine.refusal(), None);
        let mut show = Self { machine, settings, generation: 0, mesh };
        show.run(show.machine.program().start.unwrap());
        show
    }

    /// One step of the default rule.
    #[track_caller]
    pub fn step(&mut self) {
        self.generation += 1;
        self.run(self.machine.program().default_rule().unwrap());
    }

    /// Several.
    #[track_caller]
    pub fn steps(mut self, count: usize) -> Self {
        (0..count).for_each(|_| self.step());
        self
    }

    #[track_caller]
    fn run(&mut self, function: vv::ir::FunctionId) {
        let result = self.machine.run(function, &self.mesh, self.generation, &self.settings, &mut Vec::new());
        self.mesh = result.unwrap_or_else(|failure| panic!("{:#?}", failure.diagnostic));
        let warnings = close(&mut self.mesh, &Stop::new()).unwrap();
        assert!(warnings.is_empty(), "step {}: {warnings:#?}", self.generation);
    }

    /// Counts and invariants.
    pub fn statistics(&self) -> Statistics {
        statistics(&self.mesh, &faces(&self.mesh, &Stop::new()).unwrap(), &Stop::new()).unwrap()
    }

    /// The corners of each face.
    pub fn faces(&self) -> Vec<Vec<DVec3>> {
        let faces = faces(&self.mesh, &Stop::new()).unwrap();
        faces.iter().map(|f| f.iter().map(|&v| self.mesh.position(v)).collect()).collect()
    }

    /// The area of all triangles.
    pub fn area(&self) -> f64 {
        self.faces().iter().map(|f| (f[1] - f[0]).cross(f[2] - f[0]).length() / 2.0).sum()
    }

    /// The volume within all triangles.
    pub fn volume(&self) -> f64 {
        self.faces().iter().map(|f| f[0].dot(f[1].cross(f[2])) / 6.0).sum()
    }

    /// A property of a vertex.
    #[track_caller]
    pub fn value(&self, name: &str, v: Vertex) -> Value {
        let properties = self.mesh.vertex_properties();
        self.mesh.vertex_value(properties.iter().position(|p| p.name == name).unwrap(), v).unwrap()
    }

    /// A number that belongs to a vertex.
    #[track_caller]
    pub fn double(&self, name: &str, v: Vertex) -> f64 {
        match self.value(name, v) {
            Value::Double(x) => x,
            other => panic!("{name} is {other:?}"),
        }
    }
}

fn assets() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets")
}

#[track_caller]
fn assert_near(got: f64, expected: f64) {
    assert!((got - expected).abs() < 1e-9 * expected.abs().max(1.0), "{got}, expected {expected}");
}
