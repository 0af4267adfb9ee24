//! Named values to properties of the mesh.

use super::super::property::declare;
use super::super::validate::count;
use super::super::{Mesh, Value};
use super::{EdgeValues, NamedValues, Report, quote, vertex_name, warning};
use crate::stop::{Stop, Stopped};

/// Gives `mesh` what was said of its vertices and edges; `origins` has the number in the file for each vertex.
pub(super) fn give(
    mesh: &mut Mesh,
    values: NamedValues,
    origins: &[u32],
    report: &mut Report,
    stop: &Stop,
) -> Result<(), Stopped> {
    let unchanged = origins.iter().copied().eq(0..origins.len() as u32);
    for mut property in values.vertices {
        stop.check()?;
        if !unchanged || property.values.len() != origins.len() {
            property.values = property.values.gather(origins, property.default);
        }
        mesh.vertex_properties.push(property);
    }
    for edges in values.edges {
        give_edges(mesh, edges, origins, report, stop)?;
    }
    mesh.mesh_properties.extend(values.mesh);
    Ok(())
}

fn give_edges(
    mesh: &mut Mesh,
    edges: EdgeValues,
    origins: &[u32],
    report: &mut Report,
    stop: &Stop,
) -> Result<(), Stopped> {
    let EdgeValues { name, ends, values } = edges;
    // Sorted, and each once: of those that are equal the last.
    let mut known: Vec<([u32; 2], u32)> = ends.iter().zip(0..).map(|(&[a, b], i)| ([a.min(b), a.max(b)], i)).collect();
    known.sort_unstable_by(|a, b| a.0.cmp(&b.0).then(b.1.cmp(&a.1)));
    known.dedup_by_key(|(edge, _)| *edge);
    let mut met = vec![false; known.len()];

    let zero = Value::zero(values.ty());
    let slot_count = mesh.rings.slot_count();
    let index = declare(&mut mesh.rings.properties, &name, zero, slot_count);
    for v in mesh.vertices() {
        stop.check()?;
        let start = mesh.heads()[v.index()].offset as usize;
        for i in 0..mesh.ring(v).slots().len() {
            let Some(x) = mesh.ring(v).slots()[i] else { continue };
            let (a, b) = (origins[v.index()], origins[x.index()]);
            let Ok(found) = known.binary_search_by_key(&[a.min(b), a.max(b)], |(edge, _)| *edge) else { continue };
            met[found] = true;
            if let Some(value) = values.get(known[found].1 as usize) {
                mesh.rings.properties[index].values.set(start + i, value);
            }
        }
    }
    let strangers: Vec<[u32; 2]> = known.iter().zip(&met).filter(|&(_, &met)| !met).map(|(k, _)| k.0).collect();
    if !strangers.is_empty() {
        let n = strangers.len();
        let are = if n == 1 { "is the side" } else { "are sides" };
        let message = format!("{} with a value of `{name}` {are} of no face; dropped", count(n, "edge"));
        report.remarks.push(quote(warning(message), n, |i| {
            format!("{}–{}", vertex_name(strangers[i][0]), vertex_name(strangers[i][1]))
        }));
    }
    Ok(())
}
