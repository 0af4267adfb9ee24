//! What makes a mesh invalid, with evidence.

use std::fmt::Write;

use super::twins::Finder;
use super::{Mesh, Vertex};
use crate::diagnostic::{Diagnostic, Severity};
use crate::stop::{Stop, Stopped};

/// How many findings of a kind are written out as evidence.
const SHOWN: usize = 3;

/// How many vertices a diagnostic names to be drawn.
const DRAWN: usize = 1000;

/// How many entries of a ring are written out.
const RING_SHOWN: usize = 12;

/// A fault of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Finding {
    /// `from` names `to`, but `to` does not name `from`: u ∈ v* without v ∈ u*.
    OneSided {
        /// The vertex whose ring has the entry.
        from: Vertex,
        /// The entry.
        to: Vertex,
    },
    /// A vertex of the set names one that is not in it.
    Outside {
        /// The vertex whose ring has the entry.
        from: Vertex,
        /// The entry.
        to: Vertex,
    },
    /// A walk along the boundary passes a corner that is no gap, as between the steps of a program; closing the step
    /// ([`super::close`]) mends it.
    Unclosed {
        /// The vertex at whose corner the gap is missing.
        at: Vertex,
        /// The neighbour after which it is missing.
        after: Vertex,
    },
    /// The position is infinite or not a number.
    NotFinite {
        /// The vertex.
        vertex: Vertex,
    },
    /// A ring breaks an invariant: it names a vertex twice or its own, has gaps side by side, or its first gap is not
    /// at the end. No edit leads there.
    Ring {
        /// The vertex whose ring it is.
        vertex: Vertex,
    },
    /// The set holds a vertex that the universe does not have. No edit leads there.
    Foreign {
        /// The vertex.
        vertex: Vertex,
    },
}

/// Everything that is wrong with a mesh; nothing if it is valid:
///
/// - every member of the set is a vertex of the universe ([`Finding::Foreign`]);
/// - every ring keeps its invariants ([`Finding::Ring`]);
/// - members have neighbours in the set only ([`Finding::Outside`]);
/// - u ∈ v* if and only if v ∈ u* ([`Finding::OneSided`]);
/// - a walk that meets a gap meets nothing but gaps ([`Finding::Unclosed`]), so that every orbit is a face or lies
///   along the boundary;
/// - positions are finite ([`Finding::NotFinite`]).
///
/// The findings are in this order, each kind in order of creation. Cost: linear, with O(log valence) in long rings.
///
/// # Errors
/// When stopped.
pub fn validate(mesh: &Mesh, stop: &Stop) -> Result<Vec<Finding>, Stopped> {
    let mut findings = Vec::new();
    let n = mesh.vertex_count();
    findings.extend(mesh.set.iter().filter(|v| v.index() >= n).map(|vertex| Finding::Foreign { vertex }));
    let member = membership(mesh);
    for v in mesh.vertices() {
        stop.check()?;
        if !ring_is_sound(mesh, v) {
            findings.push(Finding::Ring { vertex: v });
        }
    }
    for v in mesh.vertices().filter(|v| member[v.index()]) {
        let outside = mesh.ring(v).vertices().filter(|x| !member.get(x.index()).is_some_and(|&m| m));
        findings.extend(outside.map(|to| Finding::Outside { from: v, to }));
    }
    findings.extend(one_sided(mesh, &member, stop)?);
    findings.extend(open_corners(mesh, &member, stop)?);
    findings.extend(not_finite(mesh));
    Ok(findings)
}

/// Says findings to people: one warning for each kind, with a count, the first few as evidence, and vertices to draw.
#[must_use]
pub fn diagnostics(findings: &[Finding], mesh: &Mesh) -> Vec<Diagnostic> {
    let mut kinds: Vec<std::mem::Discriminant<Finding>> = Vec::new();
    for finding in findings {
        let kind = std::mem::discriminant(finding);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    let group = |kind| findings.iter().filter(|f| std::mem::discriminant(*f) == kind).copied().collect::<Vec<_>>();
    kinds.into_iter().map(|kind| describe(&group(kind), mesh)).collect()
}

fn describe(findings: &[Finding], mesh: &Mesh) -> Diagnostic {
    let n = findings.len();
    let mut hint = None;
    let message = match findings[0] {
        Finding::OneSided { from, to } => {
            hint = Some("an edge takes an entry in both rings: write both, as `insert` does".to_owned());
            match n {
                1 => format!("{from} names {to} as its neighbour, but {to} does not name {from}"),
                _ => format!("{n} neighbours do not name the vertex that names them"),
            }
        }
        Finding::Outside { .. } => {
            hint = Some("add the neighbours to the set, or erase them from the rings".to_owned());
            format!("{} in the rings of the mesh {} not in its set", count(n, "neighbour"), are(n))
        }
        Finding::Unclosed { .. } => {
            format!("{} of walks along the boundary {} no gap", count(n, "corner"), if n == 1 { "has" } else { "have" })
        }
        Finding::NotFinite { .. } => {
            let are = if n == 1 { "is infinite or not a number" } else { "are infinite or not numbers" };
            format!("the positions of {} {are}", vertices(n)).replace("the positions of 1", "the position of 1")
        }
        Finding::Ring { .. } => format!("the rings of {} are damaged", vertices(n)),
        Finding::Foreign { .. } => format!("the set holds {} that do not exist", vertices(n)),
    };
    let mut diagnostic = Diagnostic::new(Severity::Warning, None, message);
    for finding in findings.iter().take(SHOWN) {
        diagnostic = match *finding {
            Finding::OneSided { from, to } | Finding::Outside { from, to } => {
                diagnostic.evidence(show_ring(mesh, from)).evidence(show_ring(mesh, to))
            }
            Finding::Unclosed { at, after } => {
                diagnostic.evidence(format!("{}, without a gap after {after}", show_ring(mesh, at)))
            }
            Finding::NotFinite { vertex } => {
                let p = mesh.position(vertex);
                diagnostic.evidence(format!("{vertex} is at ({}, {}, {})", p.x, p.y, p.z))
            }
            Finding::Ring { vertex } => diagnostic.evidence(show_ring(mesh, vertex)),
            Finding::Foreign { vertex } => diagnostic.evidence(vertex.to_string()),
        };
    }
    if n > SHOWN {
        diagnostic = diagnostic.evidence(format!("and {} more", n - SHOWN));
    }
    if let Some(hint) = hint {
        diagnostic = diagnostic.hint(hint);
    }
    let mut about = Vec::new();
    for finding in findings.iter().take(DRAWN) {
        match *finding {
            Finding::OneSided { from, to } | Finding::Outside { from, to } => about.extend([from, to]),
            Finding::Unclosed { at, .. } => about.push(at),
            Finding::NotFinite { vertex } | Finding::Ring { vertex } | Finding::Foreign { vertex } => {
                about.push(vertex);
            }
        }
    }
    about.sort_unstable();
    about.dedup();
    diagnostic.about(about)
}

/// `1 vertex`, `2 vertices`.
pub(super) fn vertices(n: usize) -> String {
    if n == 1 { "1 vertex".to_owned() } else { format!("{n} vertices") }
}

/// `1 edge`, `2 edges`.
pub(super) fn count(n: usize, noun: &str) -> String {
    match n {
        1 => format!("1 {noun}"),
        _ => format!("{n} {noun}s"),
    }
}

/// `ring of v1: v2 v3 null`, long rings cut.
pub(super) fn show_ring(mesh: &Mesh, v: Vertex) -> String {
    let slots = mesh.ring(v).slots();
    let mut text = format!("ring of {v}:");
    if slots.is_empty() {
        text += " empty";
    }
    for slot in slots.iter().take(RING_SHOWN) {
        let _ = match slot {
            Some(x) => write!(text, " {x}"),
            None => write!(text, " null"),
        };
    }
    if slots.len() > RING_SHOWN {
        let _ = write!(text, " … ({} entries)", slots.len());
    }
    text
}

/// For each vertex of the universe whether it is in the set.
pub(super) fn membership(mesh: &Mesh) -> Vec<bool> {
    let mut member = vec![false; mesh.vertex_count()];
    for v in mesh.set.iter() {
        if let Some(m) = member.get_mut(v.index()) {
            *m = true;
        }
    }
    member
}

pub(super) fn not_finite(mesh: &Mesh) -> impl Iterator<Item = Finding> {
    let mut ordered: Vec<_> = mesh.set.iter().filter(|&v| !mesh.position(v).is_finite()).collect();
    ordered.sort_unstable();
    ordered.into_iter().map(|vertex| Finding::NotFinite { vertex })
}

/// The entries of members that name members which do not name them.
///
/// First asks whether there is any: an entry u→v counts +h(u, v) if u < v, else −h(v, u), for a mixing function h. As
/// no ring names a vertex twice, the sum is 0 where all pairs answer, and otherwise 0 by a chance of 2⁻⁶⁴. That takes
/// one pass in order of memory, where looking for each entry's twin jumps about.
pub(super) fn one_sided(mesh: &Mesh, member: &[bool], stop: &Stop) -> Result<Vec<Finding>, Stopped> {
    let is_member = |v: &Vertex| member.get(v.index()).is_some_and(|&m| m);
    let mut sum = 0u64;
    for v in mesh.vertices().filter(is_member) {
        stop.check()?;
        for x in mesh.ring(v).vertices().filter(is_member) {
            sum = if v < x { sum.wrapping_add(mix(v, x)) } else { sum.wrapping_sub(mix(x, v)) };
        }
    }
    let mut findings = Vec::new();
    if sum != 0 {
        let finder = Finder::new(mesh);
        for v in mesh.vertices().filter(is_member) {
            stop.check()?;
            let lonely = mesh.ring(v).vertices().filter(is_member).filter(|&x| finder.find(v, x).is_none());
            findings.extend(lonely.map(|to| Finding::OneSided { from: v, to }));
        }
    }
    Ok(findings)
}

/// The finalizer of splitmix64 over both numbers.
fn mix(u: Vertex, v: Vertex) -> u64 {
    let x = ((u.index() as u64) << 32 | v.index() as u64).wrapping_add(0x9E37_79B9_7F4A_7C15);
    let x = (x ^ (x >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    x ^ (x >> 31)
}

/// The corners that are no gaps on walks which have a gap at both ends, in order of creation of the vertices and then
/// along the rings. Cost: the slots of vertices with gaps, and the walks that begin there.
pub(super) fn open_corners(mesh: &Mesh, member: &[bool], stop: &Stop) -> Result<Vec<Finding>, Stopped> {
    let is_member = |v: &Vertex| member.get(v.index()).is_some_and(|&m| m);
    let mut corners = Vec::new();
    let mut finder = None;
    for v in mesh.vertices().filter(is_member) {
        stop.check()?;
        let slots = mesh.ring(v).slots();
        if !matches!(slots.last(), Some(None)) {
            continue;
        }
        let finder = finder.get_or_insert_with(|| Finder::new(mesh));
        for i in 0..slots.len() {
            let next = if i + 1 == slots.len() { 0 } else { i + 1 };
            let Some(to) = slots[i] else { continue };
            if slots[next].is_some() {
                continue;
            }
            let begin = corners.len();
            if !walk_to_gap(mesh, finder, &is_member, (v, to), &mut corners, stop)? {
                corners.truncate(begin);
            }
        }
    }
    // Walks go round; the rings are edited one after the other.
    corners.sort_unstable();
    Ok(corners.into_iter().map(|(at, _, after)| Finding::Unclosed { at, after }).collect())
}

/// Walks on from an edge that leaves a gap until the next gap, and lists the corners passed: vertex, slot and
/// neighbour after which a gap is missing. Whether a gap was reached, not an incomplete neighbour.
fn walk_to_gap(
    mesh: &Mesh,
    finder: &Finder<'_>,
    is_member: &dyn Fn(&Vertex) -> bool,
    (mut u, mut v): (Vertex, Vertex),
    corners: &mut Vec<(Vertex, usize, Vertex)>,
    stop: &Stop,
) -> Result<bool, Stopped> {
    loop {
        if corners.len().is_multiple_of(4096) {
            stop.check()?;
        }
        if !is_member(&v) {
            return Ok(false);
        }
        let Some(i) = finder.find(u, v) else { return Ok(false) };
        let slots = mesh.ring(v).slots();
        let before = if i == 0 { slots.len() - 1 } else { i - 1 };
        let Some(w) = slots[before] else { return Ok(true) };
        corners.push((v, before, w));
        (u, v) = (v, w);
    }
}

fn ring_is_sound(mesh: &Mesh, v: Vertex) -> bool {
    let slots = mesh.ring(v).slots();
    let mut names: Vec<Vertex> = slots.iter().copied().flatten().collect();
    let len = names.len();
    names.sort_unstable();
    names.dedup();
    let gaps_apart = (0..slots.len()).all(|i| slots[i].is_some() || slots[(i + 1) % slots.len()].is_some());
    let first_gap_at_end = !slots.contains(&None) || slots.last() == Some(&None);
    names.len() == len && !names.contains(&v) && gaps_apart && first_gap_at_end
}

fn are(n: usize) -> &'static str {
    if n == 1 { "is" } else { "are" }
}
