//! Counts and invariants of a mesh.

use super::Mesh;
use super::faces::{Degrees, degrees};
use super::finder::Finder;
use super::members::Members;
use super::survey::Survey;
use super::validate::{self, Finding};
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
    /// Handles of the surface, summed over its components: g in V − E + F = 2 − 2g − b for a component with b boundary
    /// loops, each of which a disk would close. Wires, edges without faces, are no part of it, however they cross.
    /// `None` if the mesh is not valid.
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

/// Counts; `faces` are those of `mesh`, or only their [`Degrees`]. Cost: linear.
///
/// # Errors
/// When stopped.
pub fn statistics(mesh: &Mesh, faces: impl Into<Degrees> + Send, stop: &Stop) -> Result<Statistics, Stopped> {
    let members = Members::new(&mesh.set, mesh.vertex_count());
    let survey = Survey::new(mesh, &members, stop)?;
    let findings = validate::findings(mesh, &members, &survey, stop)?;
    let valid = findings.is_empty();
    let one_sided = findings.iter().filter(|f| matches!(f, Finding::OneSided { .. })).count();
    let vertices = survey.valences.total();
    let edges = (survey.entries - one_sided) / 2 + one_sided;
    let isolated = survey.valences.zeros();
    let (merges, (Degrees(face_degrees), boundary_loops)) = rayon::join(
        || merges(mesh, &members, one_sided == 0, stop),
        || (faces.into(), boundary_loops(mesh, &members, &survey, stop)),
    );
    let faces = face_degrees.total();
    let (components, boundary_loops) = (vertices - merges?, boundary_loops?);
    let euler_characteristic = (vertices + faces + isolated) as i64 - edges as i64;
    let handles = 2 * components as i64 - euler_characteristic - boundary_loops as i64;
    let genus = match u64::try_from(handles / 2).ok().filter(|_| valid) {
        Some(genus) if genus > 0 => match without_wires(mesh, &survey, stop)? {
            Some(surface) => statistics(&surface, degrees(&surface, stop)?, stop)?.genus,
            None => Some(genus),
        },
        genus => genus,
    };
    Ok(Statistics {
        vertices,
        edges,
        faces,
        components,
        boundary_loops,
        euler_characteristic,
        genus,
        closed: one_sided == 0 && survey.with_gaps.is_empty(),
        valid,
        valences: survey.valences.into_pairs(),
        face_degrees: face_degrees.into_pairs(),
    })
}

/// Counts the orbits that meet a gap and go on behind it. Cost: the slots of vertices with gaps, and these walks.
fn boundary_loops(mesh: &Mesh, members: &Members, survey: &Survey, stop: &Stop) -> Result<usize, Stopped> {
    if survey.with_gaps.is_empty() {
        return Ok(0);
    }
    let finder = Finder::new(mesh);
    let mut visited = vec![false; finder.slot_count()];
    let mut loops = 0;
    for &v in &survey.with_gaps {
        stop.check()?;
        let ring = finder.ring(v);
        for i in 0..ring.len() {
            // Each loop is entered at one of its gaps: by the edge before it in the ring.
            if ring[i].is_some() {
                continue;
            }
            let start = (v, if i == 0 { ring.len() - 1 } else { i - 1 });
            let (mut u, mut slot) = start;
            while !std::mem::replace(&mut visited[finder.arena_slot(u, slot as u32)], true) {
                let Some(next) = finder.ring(u)[slot].filter(|&x| members.contains(x)) else { break };
                let Some(place) = finder.find(u, next) else { break };
                let ring = finder.ring(next);
                let before = |slot: usize| if slot == 0 { ring.len() - 1 } else { slot - 1 };
                (u, slot) = (next, before(place as usize));
                if ring[slot].is_none() {
                    slot = before(slot);
                }
                if (u, slot) == start {
                    loops += 1;
                }
            }
        }
    }
    Ok(loops)
}

/// A valid mesh without its wires, which have gaps on either side; `None` if it has none. Cost: the slots of vertices with
/// gaps.
fn without_wires(mesh: &Mesh, survey: &Survey, stop: &Stop) -> Result<Option<Mesh>, Stopped> {
    let mut surface = None;
    for &v in &survey.with_gaps {
        stop.check()?;
        let slots = mesh.ring(v).slots();
        let around = |i: usize| [slots[(i + slots.len() - 1) % slots.len()], slots[(i + 1) % slots.len()]];
        let is_wire = |i: usize| slots[i].is_some() && around(i) == [None, None];
        if (0..slots.len()).any(is_wire) {
            // It goes with the gap after it; a ring with gaps ends in one.
            let stays = |i: &usize| !is_wire(*i) && (slots[*i].is_some() || *i == 0 || !is_wire(i - 1));
            let rest: Vec<_> = (0..slots.len()).filter(stays).map(|i| slots[i]).collect();
            // The items stood in a ring, so that none is there twice, and there is room where more were.
            let _ = surface.get_or_insert_with(|| mesh.clone()).make(v, &rest);
        }
    }
    Ok(surface)
}

/// By how much neighbourhood brings the number of components below that of the vertices in the set. Where neighbours
/// `answer`, the younger ones speak for both.
fn merges(mesh: &Mesh, members: &Members, answer: bool, stop: &Stop) -> Result<usize, Stopped> {
    let mut components = Components::new(mesh.vertex_count());
    let mut merged = 0;
    for v in mesh.vertices().filter(|&v| members.contains(v)) {
        stop.check()?;
        let mut root = components.root(v.index() as u32);
        for x in mesh.ring(v).vertices() {
            if (x < v || !answer) && members.contains(x) {
                let joined = components.join(root, x.index() as u32);
                merged += usize::from(joined != root);
                root = root.min(joined);
            }
        }
    }
    Ok(merged)
}

/// Union-find with path halving. The oldest vertex of a component is its root: deterministic, and with halving still near
/// linear.
struct Components(Vec<u32>);

impl Components {
    fn new(n: usize) -> Self {
        Self((0..n as u32).collect())
    }

    /// Joins the component that has this `root` with that of `v`; returns what the root of `v` was.
    fn join(&mut self, root: u32, v: u32) -> u32 {
        if self.0[v as usize] == root {
            return root; // as almost always
        }
        let other = self.root(v);
        self.0[root.max(other) as usize] = root.min(other);
        other
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
