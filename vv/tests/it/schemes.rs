//! The shipped schemes against what was published about them.
//!
//! A scheme's **masks** are measured by running the program itself: one old vertex is moved by a unit, and how far each
//! new vertex goes is its weight there (three at once, along three axes). Masks and faces are compared with those of
//! [`published`], closed forms written down by hand, up to the numbering of the vertices. Everything runs on both
//! engines, which must agree to the bit.

mod assets;
mod faults;
mod four_eight;
mod laws;
mod masks;
mod published;
mod surface;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::DVec3;
use vv::engine::{Engine, Machine, Settings};
use vv::ir::Program;
use vv::mesh::close::close;
use vv::mesh::faces::faces;
use vv::mesh::{Mesh, Value, Vertex};
use vv::stop::Stop;

use published::Refined;

/// How far a weight may be off.
const TOLERANCE: f64 = 1e-12;

fn assets_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../assets")
}

/// A rule of a shipped program, ready to run on both engines.
pub struct Scheme {
    native: Machine,
    rule: &'static str,
    params: Vec<(&'static str, Value)>,
}

impl Scheme {
    /// The rule `rule` of the shipped program `file`.
    #[track_caller]
    pub fn new(file: &str, rule: &'static str) -> Self {
        Self::changed(file, rule, "", "")
    }

    /// With a fault: the first `from` in its text or in one that it includes, which must be there, becomes `to`.
    #[track_caller]
    pub fn changed(file: &str, rule: &'static str, from: &str, to: &str) -> Self {
        let text = std::fs::read_to_string(assets_folder().join("programs").join(file)).unwrap();
        let program = compile_changed(file, &text, from, to);
        assert!(program.rule(rule).is_some(), "{file} has no rule {rule}");
        let native = Machine::new(program, Engine::Native);
        assert_eq!(native.refusal(), None, "{file}");
        Self { native, rule, params: Vec::new() }
    }

    /// With another value of a `param`.
    #[track_caller]
    pub fn with(mut self, param: &'static str, value: Value) -> Self {
        assert!(self.native.program().params().any(|(_, global, _)| global.name == param), "no param {param}");
        self.params.push((param, value));
        self
    }

    /// Several steps.
    #[track_caller]
    pub fn steps(&self, mesh: &Mesh, count: usize) -> Mesh {
        (0..count).fold(mesh.clone(), |mesh, _| self.step(&mesh).unwrap())
    }

    /// One step, closed, as generation 1; both engines must give the same, and no warning.
    ///
    /// # Errors
    /// What went wrong.
    pub fn step(&self, mesh: &Mesh) -> Result<Mesh, String> {
        let program = self.native.program();
        let rule = program.rule(self.rule).unwrap();
        let value = |name: &str| self.params.iter().find(|p| p.0 == name).map(|p| p.1);
        let params = program.params().filter_map(|(id, global, _)| Some((id, value(&global.name)?))).collect();
        let settings = Settings { params, seed: 7, ..Settings::default() };
        let failed = |failure: vv::engine::Failure| format!("{:?}", failure.diagnostic);
        let interpreted = vv::engine::run(program, rule, mesh, 1, &settings, &mut Vec::new()).map_err(failed)?;
        let mut result = self.native.run(rule, mesh, 1, &settings, &mut Vec::new()).map_err(failed)?;
        if interpreted.positions() != result.positions()
            || interpreted.vertices().any(|v| interpreted.ring(v).slots() != result.ring(v).slots())
        {
            return Err("the engines differ".to_owned());
        }
        let warnings = close(&mut result, &Stop::new()).unwrap();
        if warnings.is_empty() { Ok(result) } else { Err(format!("{warnings:?}")) }
    }

    /// What [`Scheme::step`] makes of a mesh, as weights of its vertices.
    ///
    /// # Errors
    /// What went wrong in a run.
    pub fn measure(&self, mesh: &Mesh) -> Result<Refined, String> {
        let n = mesh.vertex_count();
        let mut refined = Refined::default();
        for first in (0..n).step_by(3) {
            let mut moved = mesh.clone();
            for v in mesh.vertices() {
                let axis = [DVec3::X, DVec3::Y, DVec3::Z].get(v.index().wrapping_sub(first)).copied();
                moved.set_position(v, axis.unwrap_or_default());
            }
            let result = self.step(&moved)?;
            refined.masks.resize(result.vertex_count(), Vec::new());
            for (mask, p) in refined.masks.iter_mut().zip(result.positions()) {
                mask.extend(p.to_array().into_iter().take(n - first));
            }
            if first == 0 {
                let shape = shape(&result);
                (refined.edges, refined.faces) = (shape.edges, shape.faces);
            }
        }
        Ok(refined)
    }
}

/// A mesh with positions in place of weights.
fn shape(mesh: &Mesh) -> Refined {
    let found = faces(mesh, &Stop::new()).unwrap();
    let neighbours = |p: Vertex| mesh.ring(p).vertices().map(move |q| (p.index(), q.index()));
    Refined {
        masks: mesh.positions().iter().map(|p| p.to_array().to_vec()).collect(),
        edges: mesh.vertices().flat_map(neighbours).filter(|(p, q)| p < q).collect(),
        faces: found.iter().map(|f| f.iter().map(|v| v.index()).collect()).collect(),
    }
}

#[track_caller]
fn compile(name: &str, text: &str) -> Arc<Program> {
    compile_changed(name, text, "", "")
}

#[track_caller]
fn compile_changed(name: &str, text: &str, from: &str, to: &str) -> Arc<Program> {
    let folder = assets_folder().join("programs");
    let mut changed = text.contains(from);
    let text = text.replacen(from, to, 1);
    let mut include = |_: &str, path: &str| {
        let mut text = std::fs::read_to_string(folder.join(path)).map_err(|e| e.to_string())?;
        if !changed {
            changed = text.contains(from);
            text = text.replacen(from, to, 1);
        }
        Ok(vv::Included { name: path.to_owned(), text })
    };
    let compilation = vv::compile(name, &text, &mut include);
    assert!(changed, "`{from}` is not in {name}");
    assert!(compilation.diagnostics.is_empty(), "{name}: {:#?}", compilation.diagnostics);
    compilation.program.unwrap()
}

/// Compares weights, which must sum to one, edges and faces, up to the numbering of the new vertices.
///
/// # Errors
/// The first difference.
pub fn compare(measured: &Refined, expected: &Refined) -> Result<(), String> {
    for mask in &measured.masks {
        let sum: f64 = mask.iter().sum();
        if (sum - 1.0).abs() > TOLERANCE {
            return Err(format!("the weights {} sum to {sum}", show(mask)));
        }
    }
    isomorphic(measured, expected, TOLERANCE)
}

/// Finds each expected vertex by its numbers, and then compares edges and faces.
fn isomorphic(measured: &Refined, expected: &Refined, tolerance: f64) -> Result<(), String> {
    let off = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let mut free: BTreeSet<usize> = (0..measured.masks.len()).collect();
    let mut number = Vec::new(); // of the expected vertices among those measured
    for mask in &expected.masks {
        let Some(&v) = free.iter().find(|&&v| off(&measured.masks[v], mask) <= tolerance) else {
            let near =
                free.iter().min_by(|&&a, &&b| off(&measured.masks[a], mask).total_cmp(&off(&measured.masks[b], mask)));
            let near = near.map_or(String::new(), |&v| show(&measured.masks[v]));
            return Err(format!("no vertex is {}\nthe nearest is {near}", show(mask)));
        };
        free.remove(&v);
        number.push(v);
    }
    if let Some(&v) = free.first() {
        return Err(format!("{} vertices too many, such as {}", free.len(), show(&measured.masks[v])));
    }
    let faces = expected.faces.iter().map(|f| f.iter().map(|&v| number[v]).collect::<Vec<_>>());
    difference("faces", &measured.faces.iter().map(|f| rotated(f)).collect(), &faces.map(|f| rotated(&f)).collect())?;
    let edges = expected.edges.iter().map(|&(p, q)| (number[p].min(number[q]), number[p].max(number[q])));
    difference("edges", &measured.edges, &edges.collect())
}

/// `0.5 v1 + 0.5 v2`
fn show(mask: &[f64]) -> String {
    let parts = mask.iter().enumerate().filter(|(_, w)| w.abs() > TOLERANCE);
    parts.map(|(v, w)| format!("{w:.6} v{}", v + 1)).collect::<Vec<_>>().join(" + ")
}

fn difference<T: Ord + std::fmt::Debug>(what: &str, a: &BTreeSet<T>, b: &BTreeSet<T>) -> Result<(), String> {
    match (a.difference(b).next(), b.difference(a).next()) {
        (None, None) => Ok(()),
        (extra, missing) => Err(format!("{what}: {extra:?} should not be there, {missing:?} should")),
    }
}

/// A face beginning with its smallest corner.
fn rotated(face: &[usize]) -> Vec<usize> {
    let first = (0..face.len()).min_by_key(|&i| face[i]).unwrap_or(0);
    (0..face.len()).map(|i| face[(first + i) % face.len()]).collect()
}
