//! What makes a mesh invalid, with evidence.

use std::fmt::Write;

use super::finder::Finder;
use super::members::Members;
use super::survey::{Survey, in_pieces};
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
    let members = Members::new(&mesh.set, mesh.vertex_count());
    let survey = Survey::new(mesh, &members, stop)?;
    findings(mesh, &members, &survey, stop)
}

/// As [`validate`].
pub(super) fn findings(mesh: &Mesh, members: &Members, survey: &Survey, stop: &Stop) -> Result<Vec<Finding>, Stopped> {
    let n = mesh.vertex_count();
    let mut findings = Vec::new();
    if let Members::Some(_) = members {
        findings.extend(mesh.set.iter().filter(|v| v.index() >= n).map(|vertex| Finding::Foreign { vertex }));
    }
    let unsound = |range: std::ops::Range<usize>| {
        let damaged = range.filter_map(Vertex::from_index).filter(|&v| !ring_is_sound(mesh.ring(v).slots(), v));
        damaged.map(|vertex| Finding::Ring { vertex }).collect::<Vec<_>>()
    };
    findings.extend(in_pieces(mesh, stop, unsound)?.into_iter().flatten());
    for &v in &survey.torn {
        let outside = mesh.ring(v).vertices().filter(|&x| !members.contains(x));
        findings.extend(outside.map(|to| Finding::Outside { from: v, to }));
    }
    findings.extend(one_sided(mesh, members, survey, stop)?);
    findings.extend(open_corners(mesh, members, survey, stop)?);
    findings.extend(not_finite(survey));
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
            let (positions, are) = match n {
                1 => ("position", "is infinite or not a number"),
                _ => ("positions", "are infinite or not numbers"),
            };
            format!("the {positions} of {} {are}", vertices(n))
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

pub(super) fn not_finite(survey: &Survey) -> impl Iterator<Item = Finding> {
    survey.not_finite.iter().map(|&vertex| Finding::NotFinite { vertex })
}

/// The entries of members that name members which do not name them.
pub(super) fn one_sided(mesh: &Mesh, members: &Members, survey: &Survey, stop: &Stop) -> Result<Vec<Finding>, Stopped> {
    let mut findings = Vec::new();
    if survey.balance != 0 {
        let finder = Finder::new(mesh);
        for v in mesh.vertices().filter(|&v| members.contains(v)) {
            stop.check()?;
            let answered = |&x: &Vertex| !members.contains(x) || finder.find(v, x).is_some();
            let lonely = mesh.ring(v).vertices().filter(|x| !answered(x));
            findings.extend(lonely.map(|to| Finding::OneSided { from: v, to }));
        }
    }
    Ok(findings)
}

/// The corners that are no gaps on walks which have a gap at both ends, in order of creation of the vertices and then
/// along the rings. Cost: the slots of vertices with gaps, and the walks that begin there.
pub(super) fn open_corners(
    mesh: &Mesh,
    members: &Members,
    survey: &Survey,
    stop: &Stop,
) -> Result<Vec<Finding>, Stopped> {
    if survey.with_gaps.is_empty() {
        return Ok(Vec::new());
    }
    let finder = Finder::new(mesh);
    let mut corners = Vec::new();
    for &v in &survey.with_gaps {
        stop.check()?;
        let slots = mesh.ring(v).slots();
        for i in 0..slots.len() {
            let next = if i + 1 == slots.len() { 0 } else { i + 1 };
            let Some(to) = slots[i] else { continue };
            if slots[next].is_some() {
                continue;
            }
            let begin = corners.len();
            if !walk_to_gap(&finder, members, (v, to), &mut corners, stop)? {
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
    finder: &Finder<'_>,
    members: &Members,
    (mut u, mut v): (Vertex, Vertex),
    corners: &mut Vec<(Vertex, usize, Vertex)>,
    stop: &Stop,
) -> Result<bool, Stopped> {
    loop {
        if corners.len().is_multiple_of(4096) {
            stop.check()?;
        }
        if !members.contains(v) {
            return Ok(false);
        }
        let Some(i) = finder.find(u, v) else { return Ok(false) };
        let slots = finder.ring(v);
        let before = if i == 0 { slots.len() - 1 } else { i as usize - 1 };
        let Some(w) = slots[before] else { return Ok(true) };
        corners.push((v, before, w));
        (u, v) = (v, w);
    }
}

fn ring_is_sound(slots: &[Option<Vertex>], v: Vertex) -> bool {
    if slots.contains(&Some(v)) || names_twice(slots) {
        return false;
    }
    if !slots.contains(&None) {
        return true;
    }
    let gaps_apart = (0..slots.len()).all(|i| slots[i].is_some() || slots[(i + 1) % slots.len()].is_some());
    gaps_apart && slots.last() == Some(&None)
}

/// Whether a vertex is there twice.
fn names_twice(slots: &[Option<Vertex>]) -> bool {
    // Most rings tell that they have none by the last bits of their vertices.
    let names = || slots.iter().copied().flatten();
    let bits = names().fold(0u64, |bits, x| bits | 1 << (x.index() % 64));
    if bits.count_ones() as usize == names().count() {
        return false;
    }
    if slots.len() <= 16 {
        return (1..slots.len()).any(|i| slots[i].is_some() && slots[..i].contains(&slots[i]));
    }
    let mut names: Vec<Vertex> = names().collect();
    names.sort_unstable();
    !names.is_sorted_by(|a, b| a < b)
}

fn are(n: usize) -> &'static str {
    if n == 1 { "is" } else { "are" }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// No edit makes such a ring, so it is tried here.
    #[test]
    fn a_ring_that_names_a_vertex_twice_is_damaged_however_long_it_is() {
        for n in [2, 16, 17, 200] {
            let mut slots: Vec<_> = (1..=n).map(Vertex::from_index).collect();
            let Some(v) = Vertex::from_index(0) else { unreachable!() };
            assert!(ring_is_sound(&slots, v), "{n}");
            slots[n - 1] = slots[0];
            assert!(!ring_is_sound(&slots, v), "{n}");
            slots[n - 1] = Some(v);
            assert!(!ring_is_sound(&slots, v), "{n}: its own neighbour");
        }
    }
}
