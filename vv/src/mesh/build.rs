//! Polygons to a rotation system.
//!
//! In a face (…, a, v, c, …), counter-clockwise seen from outside, a follows c in the ring of v. So the corners at a
//! vertex link up to *fans*: a closed one around an interior vertex, open ones between two border edges.
//!
//! ```text
//!        c₁                     corner 0 leaves for c₀ and comes from a₀ = c₁,
//!        │ ╲                    corner 1 leaves for c₁ and comes from a₁ = c₂, …
//!   c₂───v───c₀                 the ring of v is (c₀ c₁ c₂ …), after an open fan a gap
//! ```
//!
//! A rotation system holds simple graphs on orientable surfaces. What else a file may hold is mended and reported, or
//! refused, see [`build`].

mod clean;
mod edges;
mod fans;
mod values;
mod wires;

use glam::DVec3;

use super::{Full, Mesh, Property, Value, Values, Vertex};
use crate::diagnostic::{Diagnostic, Severity};
use crate::stop::{Stop, Stopped};
use edges::Edges;

/// How many faces, edges or vertices a warning quotes.
const SHOWN: usize = 5;

/// How many vertices a warning names to be drawn.
const DRAWN: usize = 1000;

/// How many corners of a face are written out.
const CORNERS_SHOWN: usize = 12;

/// Polygons and wires over numbered vertices, as files hold them.
#[derive(Debug, Clone, Default)]
pub struct Polygons {
    /// Positions of the vertices.
    pub positions: Vec<DVec3>,
    corners: Vec<u32>,
    /// End of each face in `corners`.
    ends: Vec<u32>,
    /// For each face its number in the file, from 1, and its line, 0 if unknown.
    names: Vec<(u32, u32)>,
    /// Edges without faces.
    wires: Vec<[u32; 2]>,
    /// What else is said of vertices, edges and the whole.
    pub values: NamedValues,
    /// Once cleaned: for each vertex its number in the file.
    origins: Vec<u32>,
}

/// Values that come with polygons by name: they become properties of the mesh.
#[derive(Debug, Clone, Default)]
pub struct NamedValues {
    /// One value for each vertex.
    pub vertices: Vec<Property>,
    /// Values of some edges.
    pub edges: Vec<EdgeValues>,
    /// Values of the whole.
    pub mesh: Vec<(String, Value)>,
}

/// Values of some edges; an edge that is not named has the value zero ([`Value::zero`]).
#[derive(Debug, Clone)]
pub struct EdgeValues {
    /// What stands after `$`.
    pub name: String,
    /// The ends of each edge by their numbers, from 0, in any order; of an edge that is named twice the last counts.
    pub ends: Vec<[u32; 2]>,
    /// The value of each.
    pub values: Values,
}

impl Polygons {
    /// Polygons over these vertices, none yet.
    #[must_use]
    pub fn new(positions: Vec<DVec3>) -> Self {
        Self { positions, ..Self::default() }
    }

    /// Makes room for so many faces with so many corners.
    pub(crate) fn reserve(&mut self, faces: usize, corners: usize) {
        self.corners.reserve_exact(corners);
        self.ends.reserve_exact(faces);
        self.names.reserve_exact(faces);
    }

    /// Adds a face by the numbers of its corners, from 0, counter-clockwise seen from outside; `line` is the line of
    /// the file it stands in.
    ///
    /// # Errors
    /// The first corner that is no vertex; no face is added. More corners than a `u32` counts fail too, with the corner
    /// at which it happens.
    pub fn push(&mut self, corners: impl IntoIterator<Item = u32>, line: Option<u32>) -> Result<(), u32> {
        let start = self.corners.len();
        for corner in corners {
            if corner as usize >= self.positions.len() || self.corners.len() >= u32::MAX as usize - 1 {
                self.corners.truncate(start);
                return Err(corner);
            }
            self.corners.push(corner);
        }
        self.ends.push(self.corners.len() as u32);
        self.names.push((self.ends.len() as u32, line.unwrap_or(0)));
        Ok(())
    }

    /// Adds a wire from point to point by the numbers of vertices, from 0.
    ///
    /// # Errors
    /// The first point that is no vertex; nothing is added.
    pub fn push_wire(&mut self, points: &[u32]) -> Result<(), u32> {
        match points.iter().find(|&&point| point as usize >= self.positions.len()) {
            Some(&point) => Err(point),
            None => {
                self.wires.extend(points.windows(2).map(|ends| [ends[0], ends[1]]));
                Ok(())
            }
        }
    }

    /// How many faces.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no face.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The corners of face `f`.
    fn face(&self, f: usize) -> &[u32] {
        &self.corners[self.range(f)]
    }

    fn range(&self, f: usize) -> std::ops::Range<usize> {
        let start = if f == 0 { 0 } else { self.ends[f - 1] as usize };
        start..self.ends[f] as usize
    }

    /// `face 3`, `face 3 (line 12)`.
    fn name(&self, f: usize) -> String {
        match self.names[f] {
            (number, 0) => format!("face {number}"),
            (number, line) => format!("face {number} (line {line})"),
        }
    }

    fn line(&self, f: usize) -> Option<u32> {
        Some(self.names[f].1).filter(|&line| line > 0)
    }

    /// `face 3 (line 12): v1 v2 v3`.
    fn quote(&self, f: usize) -> String {
        let corners = self.face(f);
        let mut text = format!("{}:", self.name(f));
        for &corner in corners.iter().take(CORNERS_SHOWN) {
            text += &format!(" {}", vertex_name(corner));
        }
        if corners.len() > CORNERS_SHOWN {
            text += &format!(" … ({} corners)", corners.len());
        }
        text
    }
}

/// Why polygons make no mesh.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BuildError {
    /// The surface cannot be represented, or may not be mended.
    Refused {
        /// Line of a face that shows it, if known.
        line: Option<u32>,
        /// What and why, without span.
        diagnostic: Box<Diagnostic>,
    },
    /// Stopped from outside.
    Stopped(Stopped),
}

impl From<Stopped> for BuildError {
    fn from(stopped: Stopped) -> Self {
        Self::Stopped(stopped)
    }
}

impl BuildError {
    fn refused(line: Option<u32>, diagnostic: Diagnostic) -> Self {
        Self::Refused { line, diagnostic: Box::new(diagnostic) }
    }
}

/// What is said about the input: what was changed, and what is only remarkable.
#[derive(Default)]
struct Report {
    repairs: Vec<Diagnostic>,
    remarks: Vec<Diagnostic>,
}

/// Makes a mesh whose faces are the polygons and whose other edges the wires, with a hole on either side. Its vertices
/// are those of the input in order, then duplicates; its set holds them all. The first face that names a vertex gives
/// the start of its ring: after (…, a, v, c, …) the ring of v begins with c, or where v lies on a border after the gap
/// before the fan of that face. Wires follow the fans.
///
/// What is no rotation system is mended, and what was done comes back as warnings without spans:
///
/// | input | done |
/// |---|---|
/// | a repeated consecutive corner, a face of fewer than three corners, a duplicate face | dropped |
/// | an isolated vertex | dropped |
/// | neighbouring faces that run along an edge in the same direction | the fewer faces of a component turned over |
/// | an edge with more than two faces, or two parallel edges | two faces stay together, others get duplicate vertices |
/// | several fans at a vertex, some closed | a vertex for each closed fan, one for all open ones |
/// | three or more open fans at a vertex | kept in the order of their first faces, as their cyclic order is not known |
/// | two faces back to back | kept |
/// | a wire at a vertex inside of the surface | a vertex for the wires there |
/// | a wire that runs along a side of a face or another wire | dropped |
/// | a surface that is not orientable | refused, with a cycle of faces that proves it |
///
/// Faces at an edge with more than two are paired where they run in opposite directions, those that are connected
/// elsewhere first. With `strict`, what would have to be changed is refused; what is kept still comes with a warning.
/// Named values go with their vertices and edges to duplicates too; values of an edge that is none are dropped.
/// Cost: linear but for sorting the edges of each vertex.
///
/// # Errors
/// See above, or when stopped.
pub fn build(polygons: Polygons, strict: bool, stop: &Stop) -> Result<(Mesh, Vec<Diagnostic>), BuildError> {
    let mut report = Report::default();
    let mut polygons = clean::clean(polygons, &mut report, stop)?;
    let mut edges = Edges::new(&polygons, stop)?;
    edges.orient(&mut polygons, &mut report, stop)?;
    let (mut mesh, mut duplicated) = fans::mesh(&polygons, &edges, &mut report, stop)?;
    wires::join(&mut mesh, &polygons.wires, &mut duplicated, &mut report, stop)?;
    let mut origins = std::mem::take(&mut polygons.origins);
    origins.extend(duplicated.iter().map(|&v| origins[v as usize]).collect::<Vec<_>>());
    values::give(&mut mesh, std::mem::take(&mut polygons.values), &origins, &mut report, stop)?;
    let Report { repairs, remarks } = report;
    if strict && !repairs.is_empty() {
        return Err(refuse(repairs));
    }
    Ok((mesh, repairs.into_iter().chain(remarks).collect()))
}

/// An error that names the repairs that would have been needed.
fn refuse(mut repairs: Vec<Diagnostic>) -> BuildError {
    let others = repairs.split_off(1);
    let mut error = repairs.swap_remove(0);
    error.severity = Severity::Error;
    error.message = format!("the mesh needs repair, which strict reading refuses: {}", error.message);
    error.evidence.extend(others.into_iter().map(|d| format!("also: {}", d.message)));
    error.vertices.clear(); // there is no mesh to show them on
    BuildError::refused(None, error)
}

fn full() -> BuildError {
    BuildError::refused(None, Diagnostic::new(Severity::Error, None, Full.to_string()))
}

fn warning(message: impl Into<String>) -> Diagnostic {
    Diagnostic::new(Severity::Warning, None, message)
}

/// Adds the first few facts and how many more there are.
fn quote(mut diagnostic: Diagnostic, total: usize, mut fact: impl FnMut(usize) -> String) -> Diagnostic {
    for i in 0..total.min(SHOWN) {
        diagnostic = diagnostic.evidence(fact(i));
    }
    if total > SHOWN {
        diagnostic = diagnostic.evidence(format!("and {} more", total - SHOWN));
    }
    diagnostic
}

fn vertex_name(index: u32) -> String {
    Vertex::from_index(index as usize).map_or_else(String::new, |v| v.to_string())
}
