//! Values for new vertices, of properties that whoever made them knows nothing of.

use glam::DVec3;
use rayon::prelude::*;

use super::{Mesh, Value, Vertex};
use crate::stop::{Stop, Stopped};

/// Gives the vertices that came after the first `old` what their neighbours have, for the vertex properties of these
/// indices: of doubles and vectors the mean, of all else, which may be a label, that of the oldest. First the neighbours of
/// old vertices, then the neighbours of those, and so on; a neighbour is who names the vertex, and of the old ones also whom
/// it names. So the middle of an edge lies between its ends. Who comes of one old vertex that is in the set no more, as a
/// corner of Doo and Sabin's, gets the mean of that and the corners beside it: else all of one old vertex would be alike
/// for ever. What hangs together with nothing old stays as it is.
///
/// To be called before the mesh is [closed](super::close::close), which forgets vertices. Cost: O(n log n) in the new
/// vertices and their neighbours, nothing without properties.
///
/// # Errors
/// When stopped; some of them may have their values then.
pub fn inherit(mesh: &mut Mesh, old: usize, properties: &[usize], stop: &Stop) -> Result<(), Stopped> {
    let n = mesh.vertex_count();
    if properties.is_empty() || old >= n {
        return Ok(());
    }
    let mut known = vec![false; n];
    known[..old].fill(true);
    // Whom they name: what they have goes there.
    let mut givers: Vec<Vertex> = mesh.vertices().take(old).collect();
    let mut corners: Vec<Vertex> = Vec::new();
    let mut pairs: Vec<(Vertex, Vertex)> = Vec::new();
    for x in mesh.vertices().skip(old) {
        stop.check()?;
        pairs.extend(mesh.ring(x).vertices().filter(|v| v.index() < old).map(|v| (x, v)));
    }
    while !givers.is_empty() {
        for &v in &givers {
            stop.check()?;
            pairs.extend(mesh.ring(v).vertices().filter(|x| !known[x.index()]).map(|x| (x, v)));
        }
        pairs.par_sort_unstable();
        pairs.dedup(); // most name each other
        givers.clear();
        for pairs in pairs.chunk_by(|a, b| a.0 == b.0) {
            stop.check()?;
            let x = pairs[0].0;
            for &property in properties {
                let values = pairs.iter().filter_map(|&(_, v)| mesh.vertex_value(property, v));
                if let Some(value) = common(values) {
                    mesh.set_vertex_value(property, x, value);
                }
            }
            known[x.index()] = true;
            givers.push(x);
            if let [(_, only)] = pairs
                && only.index() < old
                && !mesh.set.contains(*only)
            {
                corners.push(x);
            }
        }
        pairs.clear();
    }
    for &property in properties {
        let beside = |x| mesh.ring(x).vertices().filter(|v| v.index() >= old);
        let around = |x| std::iter::once(x).chain(beside(x)).filter(|v| known[v.index()]);
        let mixed = |x: &Vertex| match common(around(*x).filter_map(|v| mesh.vertex_value(property, v)))? {
            value @ (Value::Double(_) | Value::Vec(_)) => Some((*x, value)),
            _ => None,
        };
        stop.check()?;
        let values: Vec<(Vertex, Value)> = corners.iter().filter_map(mixed).collect();
        for (x, value) in values {
            mesh.set_vertex_value(property, x, value);
        }
    }
    Ok(())
}

/// The mean of numbers and of vectors, else the first.
fn common(mut values: impl Iterator<Item = Value>) -> Option<Value> {
    let (first, mut n) = (values.next()?, 1.0);
    let mut sum = match first {
        Value::Double(x) => DVec3::splat(x),
        Value::Vec(x) => x,
        _ => return Some(first),
    };
    for value in values {
        sum += match value {
            Value::Double(x) => DVec3::splat(x),
            Value::Vec(x) => x,
            _ => return None,
        };
        n += 1.0;
    }
    Some(if let Value::Double(_) = first { Value::Double(sum.x / n) } else { Value::Vec(sum / n) })
}
