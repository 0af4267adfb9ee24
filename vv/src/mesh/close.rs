//! What happens when a step ends.

use super::members::Members;
use super::survey::Survey;
use super::validate::{self, Finding};
use super::{Mesh, Vertex};
use crate::diagnostic::{Diagnostic, Severity};
use crate::stop::{Stop, Stopped};

/// How many rings the warning about forgotten vertices quotes.
const SHOWN: usize = 3;

/// How many vertices it names to be drawn.
const DRAWN: usize = 1000;

/// Closes a step. Returns warnings, without spans, that name vertices by their new numbers.
///
/// 1. Vertices that are not in the set are forgotten and the others renumbered densely in order of creation. Entries
///    that name forgotten vertices become gaps; a warning counts those vertices.
/// 2. On every walk that has a gap at both ends, all corners become gaps: a vertex that was put on a boundary edge
///    becomes a boundary vertex. Walks that end at a neighbour which does not answer are left as they are, with a
///    warning that quotes the rings.
/// 3. Positions that are infinite or not a number get a warning.
///
/// None of these changes the set of faces, but for faces that had a forgotten corner. A mesh without gaps costs a scan
/// in order of memory, one with gaps the walks along its boundary besides.
///
/// # Errors
/// When stopped; drop the mesh then.
pub fn close(mesh: &mut Mesh, stop: &Stop) -> Result<Vec<Diagnostic>, Stopped> {
    let mut warnings = Vec::new();
    warnings.extend(forget(mesh, stop)?);
    let members = Members::new(&mesh.set, mesh.vertex_count());
    let survey = Survey::new(mesh, &members, stop)?;
    mesh.rings.tidy(survey.slots);
    open(mesh, &validate::open_corners(mesh, &members, &survey, stop)?, stop)?;
    let mut findings = validate::one_sided(mesh, &members, &survey, stop)?;
    findings.extend(validate::not_finite(&survey));
    warnings.extend(validate::diagnostics(&findings, mesh));
    Ok(warnings)
}

/// Forgets what is not in the set; a warning if rings that stay name it.
fn forget(mesh: &mut Mesh, stop: &Stop) -> Result<Option<Diagnostic>, Stopped> {
    if mesh.set.len() == mesh.vertex_count() {
        mesh.keep_only_set();
        return Ok(None);
    }
    let members = Members::new(&mesh.set, mesh.vertex_count());
    // One pass in order of memory tells of most meshes that none is named.
    let is_lost = |x: Option<Vertex>| x.is_some_and(|x| !members.contains(x));
    if !mesh.slots().iter().fold(false, |lost, &x| lost | is_lost(x)) {
        mesh.keep_only_set();
        return Ok(None);
    }
    let mut named = Vec::new();
    let mut torn = Vec::new(); // those that name them, by their new numbers
    let mut evidence = Vec::new();
    for (kept, v) in mesh.vertices().filter(|&v| members.contains(v)).enumerate() {
        stop.check()?;
        let lost = mesh.ring(v).vertices().filter(|&x| !members.contains(x));
        let before = named.len();
        named.extend(lost);
        if named.len() > before {
            torn.extend(Vertex::from_index(kept));
        }
    }
    mesh.keep_only_set();
    named.sort_unstable();
    named.dedup();
    let forgotten = named.len();
    if forgotten == 0 {
        return Ok(None);
    }
    for &v in torn.iter().take(SHOWN) {
        evidence.push(format!("now {}", validate::show_ring(mesh, v)));
    }
    if torn.len() > SHOWN {
        let more = torn.len() - SHOWN;
        evidence.push(format!("and {more} more ring{}", if more == 1 { "" } else { "s" }));
    }
    let (are, their) = if forgotten == 1 { ("is", "its") } else { ("are", "their") };
    let message = format!(
        "{} that rings of the mesh name {are} in no mesh at the end of the step; gaps took {their} places in the rings \
        of {}",
        validate::vertices(forgotten),
        validate::vertices(torn.len())
    );
    let mut warning = Diagnostic::new(Severity::Warning, None, message)
        .hint("is a `merge` or an `add` missing? what is deleted is to be erased from the rings of its neighbours")
        .about(torn.into_iter().take(DRAWN));
    warning.evidence = evidence;
    Ok(Some(warning))
}

/// Puts gaps into the corners, which are sorted by vertex. A ring is made anew at once, so that a vertex with many open
/// corners does not cost the square of their number.
fn open(mesh: &mut Mesh, corners: &[Finding], stop: &Stop) -> Result<(), Stopped> {
    let place = |f: &Finding| match *f {
        Finding::Unclosed { at, after } => Some((at, after)),
        _ => None,
    };
    for group in corners.chunk_by(|a, b| place(a).map(|p| p.0) == place(b).map(|p| p.0)) {
        stop.check()?;
        let Some((at, _)) = place(&group[0]) else { continue };
        let mut places = group.iter().filter_map(place).peekable();
        let mut items = Vec::with_capacity(mesh.ring(at).slots().len() + group.len());
        for &slot in mesh.ring(at).slots() {
            items.push(slot);
            if places.next_if(|&(_, after)| slot == Some(after)).is_some() {
                items.push(None);
            }
        }
        // The items stood in a ring, so none is there twice; only an arena of 4 billion slots has no room.
        let _ = mesh.make(at, &items);
    }
    Ok(())
}
