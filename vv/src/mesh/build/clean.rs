//! Drops what carries no surface: repeated corners, faces without area, duplicate faces, isolated vertices.

use std::hash::Hasher;

use rustc_hash::FxHasher;

use super::super::validate::{count, vertices};
use super::{Polygons, Report, quote, vertex_name, warning};
use crate::stop::{Stop, Stopped};

pub(super) fn clean(polygons: Polygons, report: &mut Report, stop: &Stop) -> Result<Polygons, Stopped> {
    let polygons = drop_degenerate(polygons, report, stop)?;
    let polygons = drop_duplicates(polygons, report, stop)?;
    drop_isolated(polygons, report, stop)
}

fn drop_degenerate(mut polygons: Polygons, report: &mut Report, stop: &Stop) -> Result<Polygons, Stopped> {
    let mut repeated = Vec::new();
    let mut dropped = Vec::new();
    let mut kept = Polygons::default();
    kept.reserve(polygons.len(), polygons.corners.len());
    for f in 0..polygons.len() {
        stop.check()?;
        let corners = polygons.face(f);
        let start = kept.corners.len();
        for &corner in corners {
            if kept.corners.len() == start || kept.corners.last() != Some(&corner) {
                kept.corners.push(corner);
            }
        }
        while kept.corners.len() > start + 1 && kept.corners.last() == kept.corners.get(start) {
            kept.corners.pop();
        }
        let len = kept.corners.len() - start;
        if len < 3 {
            kept.corners.truncate(start);
            dropped.push(f);
            continue;
        }
        if len < corners.len() {
            repeated.push(f);
        }
        kept.ends.push(kept.corners.len() as u32);
        kept.names.push(polygons.names[f]);
    }
    if !repeated.is_empty() {
        let message =
            format!("{} named a corner twice in succession; the second was dropped", count(repeated.len(), "face"));
        report.repairs.push(quote(warning(message), repeated.len(), |i| polygons.quote(repeated[i])));
    }
    if !dropped.is_empty() {
        let message = format!(
            "{} dropped",
            were(dropped.len(), "face of fewer than three corners", "faces of fewer than three corners")
        );
        report.repairs.push(quote(warning(message), dropped.len(), |i| polygons.quote(dropped[i])));
    }
    kept.positions = std::mem::take(&mut polygons.positions);
    kept.values = std::mem::take(&mut polygons.values);
    kept.wires = std::mem::take(&mut polygons.wires);
    Ok(kept)
}

fn drop_duplicates(polygons: Polygons, report: &mut Report, stop: &Stop) -> Result<Polygons, Stopped> {
    let mut hashed = Vec::with_capacity(polygons.len());
    for f in 0..polygons.len() {
        stop.check()?;
        let mut hasher = FxHasher::default();
        canonical(polygons.face(f)).for_each(|corner| hasher.write_u32(corner));
        hashed.push((hasher.finish(), f as u32));
    }
    hashed.sort_unstable();
    let mut original = vec![None; polygons.len()];
    for run in hashed.chunk_by(|a, b| a.0 == b.0).filter(|run| run.len() > 1) {
        stop.check()?;
        let mut distinct: Vec<u32> = Vec::new();
        for &(_, f) in run {
            let same = |&g: &u32| {
                polygons.face(g as usize).len() == polygons.face(f as usize).len()
                    && canonical(polygons.face(g as usize)).eq(canonical(polygons.face(f as usize)))
            };
            match distinct.iter().copied().find(same) {
                Some(g) => original[f as usize] = Some(g),
                None => distinct.push(f),
            }
        }
    }
    let dropped: Vec<usize> = (0..polygons.len()).filter(|&f| original[f].is_some()).collect();
    if dropped.is_empty() {
        return Ok(polygons);
    }
    let message = format!("{} dropped", were(dropped.len(), "duplicate face", "duplicate faces"));
    report.repairs.push(quote(warning(message), dropped.len(), |i| {
        let f = dropped[i];
        let first = original[f].map_or_else(String::new, |g| polygons.name(g as usize));
        format!("{}, as {first}", polygons.quote(f))
    }));
    let mut kept = Polygons::default();
    for f in (0..polygons.len()).filter(|&f| original[f].is_none()) {
        kept.corners.extend_from_slice(polygons.face(f));
        kept.ends.push(kept.corners.len() as u32);
        kept.names.push(polygons.names[f]);
    }
    kept.positions = polygons.positions;
    kept.values = polygons.values;
    kept.wires = polygons.wires;
    Ok(kept)
}

fn drop_isolated(mut polygons: Polygons, report: &mut Report, stop: &Stop) -> Result<Polygons, Stopped> {
    let mut used = vec![false; polygons.positions.len()];
    for &corner in polygons.corners.iter().chain(polygons.wires.iter().flatten()) {
        used[corner as usize] = true;
    }
    stop.check()?;
    let (kept, isolated): (Vec<u32>, Vec<u32>) = (0..used.len() as u32).partition(|&v| used[v as usize]);
    polygons.origins = kept;
    if isolated.is_empty() {
        return Ok(polygons);
    }
    let n = isolated.len();
    let message = format!("{} {} in no face; dropped", vertices(n), if n == 1 { "is" } else { "are" });
    let mut warning = quote(warning(message), n, |i| vertex_name(isolated[i]));
    if isolated.first().is_some_and(|&first| (first as usize) < polygons.positions.len() - n) {
        warning = warning.evidence("the vertices after them were renumbered");
    }
    report.repairs.push(warning);
    let mut number = vec![0; used.len()];
    let mut next = 0;
    for (v, &used) in used.iter().enumerate() {
        number[v] = next;
        next += u32::from(used);
    }
    for corner in polygons.corners.iter_mut().chain(polygons.wires.iter_mut().flatten()) {
        *corner = number[*corner as usize];
    }
    let mut v = 0;
    polygons.positions.retain(|_| {
        v += 1;
        used[v - 1]
    });
    Ok(polygons)
}

/// The corners of a face from a place that depends on the cycle alone.
fn canonical(corners: &[u32]) -> impl Iterator<Item = u32> {
    let start = least_rotation(corners);
    corners[start..].iter().chain(&corners[..start]).copied()
}

/// Where the lexicographically least rotation begins, in O(n): two candidates `i` and `j` are compared along `k`, and
/// the loser skips all it was compared over.
fn least_rotation(corners: &[u32]) -> usize {
    let n = corners.len();
    let (mut i, mut j, mut k) = (0, 1, 0);
    while i < n && j < n && k < n {
        match corners[(i + k) % n].cmp(&corners[(j + k) % n]) {
            std::cmp::Ordering::Equal => {
                k += 1;
                continue;
            }
            std::cmp::Ordering::Greater => i += k + 1,
            std::cmp::Ordering::Less => j += k + 1,
        }
        if i == j {
            j += 1;
        }
        k = 0;
    }
    i.min(j)
}

/// `1 face was`, `2 faces were`.
fn were(n: usize, one: &str, many: &str) -> String {
    if n == 1 { format!("1 {one} was") } else { format!("{n} {many} were") }
}
