//! Wires: edges without faces, with a hole on either side.

use std::collections::BTreeMap;

use super::super::validate::{count, vertices};
use super::super::{EditError, Mesh, Vertex};
use super::{BuildError, DRAWN, Report, full, quote, vertex_name, warning};
use crate::stop::Stop;

/// Puts wires between vertices of a mesh that has its faces. At a vertex they stand in their order, behind its fans of
/// faces. Where one closed fan leaves no room, they get a duplicate of the vertex, which is appended to `duplicated`.
pub(super) fn join(
    mesh: &mut Mesh,
    wires: &[[u32; 2]],
    duplicated: &mut Vec<u32>,
    report: &mut Report,
    stop: &Stop,
) -> Result<(), BuildError> {
    if wires.is_empty() {
        return Ok(());
    }
    let wires = distinct(mesh, wires, report);
    let mut homes = BTreeMap::new();
    for &v in wires.iter().flatten() {
        stop.check()?;
        let Some(at) = Vertex::from_index(v as usize) else { return Err(full()) };
        let ring = mesh.ring(at);
        if !ring.slots().is_empty() && !ring.contains(None) && !homes.contains_key(&v) {
            let twin = mesh.create().map_err(|_| full())?;
            mesh.set_position(twin, mesh.position(at));
            mesh.set.add(twin);
            duplicated.push(v);
            homes.insert(v, twin);
        }
    }
    if !homes.is_empty() {
        let message = format!("lines end at {} inside of the surface; duplicated for them", vertices(homes.len()));
        let named: Vec<_> = homes.iter().collect();
        let diagnostic =
            quote(warning(message), named.len(), |i| format!("{} for {}", named[i].1, vertex_name(*named[i].0)));
        report.repairs.push(diagnostic.about(homes.values().copied().take(DRAWN)));
    }
    let home = |v: u32| homes.get(&v).copied().or_else(|| Vertex::from_index(v as usize));
    let mut halves: Vec<_> = wires.iter().flat_map(|&[a, b]| [(home(a), home(b)), (home(b), home(a))]).collect();
    halves.sort_by_key(|half| half.0); // stable
    let mut items = Vec::new();
    for group in halves.chunk_by(|g, h| g.0 == h.0) {
        stop.check()?;
        let Some(v) = group[0].0 else { return Err(full()) };
        items.clear();
        items.extend_from_slice(mesh.ring(v).slots());
        items.extend(group.iter().flat_map(|&(_, to)| [to, None]));
        match mesh.make(v, &items) {
            // Each edge is there once, and none of its ends twice.
            Ok(()) | Err(EditError::Twice(_) | EditError::OwnNeighbour(_)) => {}
            Err(EditError::Full(_)) => return Err(full()),
        }
    }
    Ok(())
}

/// The wires that are edges of their own, in order: each once, of two ends, and no side of a face.
fn distinct(mesh: &Mesh, wires: &[[u32; 2]], report: &mut Report) -> Vec<[u32; 2]> {
    let is_side = |[a, b]: [u32; 2]| {
        let (Some(a), Some(b)) = (Vertex::from_index(a as usize), Vertex::from_index(b as usize)) else { return false };
        let (a, b) = if mesh.ring(a).slots().len() <= mesh.ring(b).slots().len() { (a, b) } else { (b, a) };
        mesh.ring(a).slots().contains(&Some(b))
    };
    let mut by_ends: Vec<([u32; 2], usize)> =
        wires.iter().zip(0..).map(|(&[a, b], i)| ([a.min(b), a.max(b)], i)).collect();
    by_ends.sort_unstable();
    by_ends.dedup_by_key(|wire| wire.0);
    by_ends.retain(|&(ends, _)| ends[0] != ends[1] && !is_side(ends));
    by_ends.sort_unstable_by_key(|wire| wire.1);
    let dropped = wires.len() - by_ends.len();
    if dropped > 0 {
        let message = format!("{} of lines dropped, which was no edge or one that is there", count(dropped, "segment"));
        let mut kept = by_ends.iter().map(|wire| wire.1).peekable();
        let gone: Vec<_> = (0..wires.len()).filter(|i| kept.next_if_eq(i).is_none()).collect();
        report.remarks.push(quote(warning(message), gone.len(), |i| {
            let [a, b] = wires[gone[i]];
            format!("{}–{}", vertex_name(a), vertex_name(b))
        }));
    }
    by_ends.into_iter().map(|(_, i)| wires[i]).collect()
}
