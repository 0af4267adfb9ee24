//! The mask of one vertex: of what is far from it only whether it matters.

use glam::DVec3;

use super::{Fault, TOLERANCE, same_rings, scattered, step};
use crate::engine::{Failure, Machine, Settings};
use crate::ir::FunctionId;
use crate::mesh::{Mesh, Vertex};

/// Old vertices that one by one are looked at, at most.
const MOST: usize = 1536;
/// How many of them first. Whoever needs more needs four times as many.
const NEAREST: usize = 24;
/// Of a row of so many is first asked whether any matters.
const ROW: usize = 12;

/// With which weights a step makes a vertex of old ones.
#[derive(Debug, Clone)]
pub struct VertexMask {
    /// The new vertex, as it is called when the step is closed.
    pub vertex: Vertex,
    /// The old vertices that it is made of and their weights, the nearest one first. Where it is not affine, only which
    /// ones they are means something.
    pub weights: Vec<(Vertex, f64)>,
    /// What keeps these from being a mask.
    pub faults: Vec<Fault>,
}

/// Measures the mask of `vertex` in the generation that `rule` makes of `mesh`, which is the one of this number. Output is
/// thrown away.
///
/// Moves everything except the old vertices nearest to it: if it stays, it is made of these, and they are moved one by
/// one, three in a run. Cost: as many steps as it is made of vertices, and some ten; up to 500 for one that is made of
/// vertices from all over the mesh.
///
/// # Errors
/// As [`Machine::run`].
pub fn measure_vertex(
    machine: &Machine,
    rule: FunctionId,
    mesh: &Mesh,
    generation: u64,
    vertex: Vertex,
    settings: &Settings,
) -> Result<VertexMask, Failure> {
    let (result, _) = step(machine, rule, mesh, generation, settings)?;
    let mut mask = VertexMask { vertex, weights: Vec::new(), faults: Vec::new() };
    if vertex.index() >= result.vertex_count() {
        return Ok(mask);
    }
    let place = result.position(vertex);
    // As far as the mesh reaches; a power of two, so that nothing is lost.
    let reach = mesh.positions().iter().filter(|p| p.is_finite()).map(|p| p.abs().max_element()).fold(0.0, f64::max);
    let unit = if reach.is_normal() { reach.log2().ceil().exp2() } else { 1.0 };
    // Where the vertex comes to lie when some are moved; `None` when it has other neighbours then.
    let moved = |by: &mut dyn Iterator<Item = (Vertex, DVec3)>| -> Result<Option<DVec3>, Failure> {
        let mut moved = mesh.clone();
        by.for_each(|(v, to)| moved.set_position(v, to));
        let (moved, _) = step(machine, rule, &moved, generation, settings)?;
        Ok(same_rings(&result, &moved).then(|| moved.position(vertex)))
    };
    let away = |v: Vertex| (v, mesh.position(v) + unit * scattered(v));
    let near = |a: DVec3, b: DVec3, count: usize| a.distance(b) <= TOLERANCE * unit * (1.0 + count as f64);
    let mut old: Vec<Vertex> = mesh.vertices().collect();
    let distance = |v: &Vertex| mesh.position(*v).distance_squared(place);
    old.sort_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b)));

    let mut count = NEAREST.min(old.len());
    while count < old.len() {
        match moved(&mut old[count..].iter().copied().map(away))? {
            None => {
                mask.faults.push(Fault::Connectivity);
                return Ok(mask);
            }
            Some(at) if near(at, place, 0) => break,
            Some(_) if 4 * count > MOST => {
                mask.faults.push(Fault::Wide { vertex, most: count });
                return Ok(mask);
            }
            Some(_) => count = (4 * count).min(old.len()),
        }
    }
    let old = &old[..count];
    for row in old.chunks(ROW) {
        let matters = moved(&mut row.iter().copied().map(away))?;
        if matters.is_some_and(|at| near(at, place, 0)) {
            continue;
        }
        for three in row.chunks(3) {
            let axes = three.iter().zip(DVec3::AXES);
            match moved(&mut axes.map(|(&v, axis)| (v, mesh.position(v) + unit * axis)))? {
                None => mask.faults = vec![Fault::Connectivity],
                Some(at) => {
                    let by = ((at - place) / unit).to_array();
                    let weights = three.iter().copied().zip(by);
                    mask.weights.extend(weights.filter(|(_, w)| w.is_nan() || w.abs() > TOLERANCE));
                }
            }
        }
    }
    // All of them at once: what is affine is the sum of its weights there, too.
    let Some(there) = moved(&mut old.iter().copied().map(away))? else {
        mask.faults = vec![Fault::Connectivity];
        return Ok(mask);
    };
    let sum: f64 = mask.weights.iter().map(|(_, w)| w).sum();
    let expected: DVec3 = mask.weights.iter().map(|&(v, w)| w * away(v).1).sum();
    let count = mask.weights.len();
    if sum.is_nan() || (sum - 1.0).abs() > TOLERANCE * (1.0 + count as f64) {
        mask.faults.push(Fault::Sum { vertex, sum });
    }
    // A sum that is not 1 says it all, unless it is no sum.
    if !near(there, expected, 10 * count) {
        mask.faults.push(Fault::NotAffine { vertex, distance: there.distance(expected) });
    }
    Ok(mask)
}
