//! Counts and invariants of a mesh.

use std::collections::BTreeMap;

use super::faces::Faces;
use super::twins::{NONE, Twins};
use super::{Mesh, Vertex, validate};
use crate::stop::{Stop, Stopped};

/// What a mesh is made of. Counts are over its set.
#[derive(Debug, Clone, Default, PartialEq, Eq, serde::Serialize)]
pub struct Statistics {
    /// Vertices of the set.
    pub vertices: usize,
    /// Unordered pairs of neighbours.
    pub edges: usize,
    /// Edmonds' orbits without gaps.
    pub faces: usize,
    /// Connected components.
    pub components: usize,
    /// Closed walks along the boundary: the orbits that meet a gap, were the gaps taken out. A vertex with several gaps
    /// may be passed several times.
    pub boundary_loops: usize,
    /// V − E + F, where a vertex without neighbours counts as one face more: a sphere with one point.
    pub euler_characteristic: i64,
    /// Handles, summed over the components: g in V − E + F = 2 − 2g − b for a component with b boundary loops, each of
    /// which a disk would close. `None` if the mesh is not valid.
    pub genus: Option<u64>,
    /// No boundary: every edge has a face on either side.
    pub closed: bool,
    /// [`validate::validate`] finds nothing.
    pub valid: bool,
    /// How many vertices have each valence, ascending.
    pub valences: Vec<(usize, usize)>,
    /// How many faces have each number of corners, ascending.
    pub face_degrees: Vec<(usize, usize)>,
}

/// Counts; `faces` are those of `mesh`. Cost: linear.
///
/// # Errors
/// When stopped.
pub fn statistics(mesh: &Mesh, faces: &Faces, stop: &Stop) -> Result<Statistics, Stopped> {
    let valid = validate::validate(mesh, stop)?.is_empty();
    let links = Twins::new(mesh, &mesh.set, stop)?;
    let member = validate::membership(mesh);
    let members = || mesh.vertices().filter(|v| member[v.index()]);
    let mut half_edges = 0; // ends of edges that both name
    let mut one_sided = 0;
    let mut components = Components::new(mesh.vertex_count());
    let mut merged = 0;
    let mut isolated = 0;
    let mut valences = BTreeMap::new();
    for v in members() {
        stop.check()?;
        let valence = mesh.ring(v).valence();
        *valences.entry(valence).or_insert(0) += 1;
        isolated += usize::from(valence == 0);
        for s in links.slots(v) {
            let Some(x) = links.targets[s as usize].filter(|x| member.get(x.index()).is_some_and(|&m| m)) else {
                continue;
            };
            if links.twins[s as usize] == NONE {
                one_sided += 1;
            } else {
                half_edges += 1;
            }
            merged += usize::from(components.join(v, x));
        }
    }
    let mut face_degrees = BTreeMap::new();
    for face in faces.iter() {
        *face_degrees.entry(face.len()).or_insert(0) += 1;
    }
    let vertices = members().count();
    let edges = half_edges / 2 + one_sided;
    let components = vertices - merged;
    let boundary_loops = boundary_loops(mesh, &links, stop)?;
    let euler_characteristic = (vertices + faces.len() + isolated) as i64 - edges as i64;
    let handles = 2 * components as i64 - euler_characteristic - boundary_loops as i64;
    Ok(Statistics {
        vertices,
        edges,
        faces: faces.len(),
        components,
        boundary_loops,
        euler_characteristic,
        genus: if valid { u64::try_from(handles / 2).ok() } else { None },
        closed: one_sided == 0 && !links.targets.contains(&None),
        valid,
        valences: valences.into_iter().collect(),
        face_degrees: face_degrees.into_iter().collect(),
    })
}

/// Counts the orbits that meet a gap and go on behind it.
fn boundary_loops(mesh: &Mesh, links: &Twins, stop: &Stop) -> Result<usize, Stopped> {
    let mut visited = vec![false; links.targets.len()];
    let mut loops = 0;
    for v in mesh.vertices() {
        stop.check()?;
        for s in links.slots(v) {
            // Each loop is entered at one of its gaps: by the edge before it in the ring.
            if links.targets[s as usize].is_some() {
                continue;
            }
            let start = links.previous(s, v);
            let mut s = start;
            while !visited[s as usize] {
                visited[s as usize] = true;
                let (Some(next), twin) = (links.targets[s as usize], links.twins[s as usize]) else { break };
                if twin == NONE {
                    break;
                }
                s = links.previous(twin, next);
                if links.targets[s as usize].is_none() {
                    s = links.previous(s, next);
                }
                if s == start {
                    loops += 1;
                }
            }
        }
    }
    Ok(loops)
}

/// Union-find with path halving.
struct Components(Vec<u32>);

impl Components {
    fn new(n: usize) -> Self {
        Self((0..n as u32).collect())
    }

    /// Whether the two were apart.
    fn join(&mut self, u: Vertex, v: Vertex) -> bool {
        let (u, v) = (self.root(u.index() as u32), self.root(v.index() as u32));
        // The older one stays on top: deterministic, and with halving still near linear.
        self.0[u.max(v) as usize] = u.min(v);
        u != v
    }

    fn root(&mut self, mut v: u32) -> u32 {
        while self.0[v as usize] != v {
            let up = self.0[self.0[v as usize] as usize];
            self.0[v as usize] = up;
            v = up;
        }
        v
    }
}
