//! Normals of the surface around vertices.

use glam::DVec3;
use rayon::prelude::*;
use vv::mesh::faces::Faces;
use vv::mesh::triangulate::newell;
use vv::stop::{Stop, Stopped};

use super::{Places, pack};

/// The normal around each vertex that has a place, packed; the zero word where no face is.
pub(super) fn vertex_normals(faces: &Faces, places: &Places, stop: &Stop) -> Result<Vec<u32>, Stopped> {
    let mut normals = vec![DVec3::ZERO; places.positions.len()];
    let (mut ends, mut points) = (Vec::new(), Vec::new());
    for face in faces.iter().filter(|face| face.len() > 2) {
        stop.check()?;
        if let [a, b, c] = *face {
            if let (Some(a), Some(b), Some(c)) = (places.get(a), places.get(b), places.get(c)) {
                add_triangle(&mut normals, [a, b, c], places);
            }
            continue;
        }
        ends.clear();
        ends.extend(face.iter().filter_map(|&v| places.get(v)));
        if ends.len() == face.len() {
            points.clear();
            points.extend(ends.iter().map(|&i| places.positions[i as usize]));
            add_polygon(&mut normals, &ends, &points);
        }
    }
    Ok(normals.par_iter().map(|normal| normal.try_normalize().map_or(0, |n| pack(n.as_vec3()))).collect())
}

fn add_triangle(normals: &mut [DVec3], ends: [u32; 3], places: &Places) {
    let [a, b, c] = ends.map(|i| places.positions[i as usize]);
    let (ab, bc, ca) = (b - a, c - b, a - c);
    let area = ca.cross(ab);
    let squares = [ab, bc, ca].map(DVec3::length_squared);
    let weights = [squares[2] * squares[0], squares[0] * squares[1], squares[1] * squares[2]];
    for (end, weight) in ends.into_iter().zip(weights) {
        add(&mut normals[end as usize], area, weight);
    }
}

fn add_polygon(normals: &mut [DVec3], ends: &[u32], points: &[DVec3]) {
    let normal = newell(points).normalize_or_zero();
    let n = points.len();
    for i in 0..n {
        let p = points[i];
        let (before, after) = (if i == 0 { n - 1 } else { i - 1 }, if i + 1 == n { 0 } else { i + 1 });
        let (a, b) = (points[before] - p, points[after] - p);
        add(&mut normals[ends[i] as usize], a.cross(b).length() * normal, a.length_squared() * b.length_squared());
    }
}

/// Adds the normal of a corner, weighted by `sin α / (|a| |b|)`, where `a` and `b` are the sides that meet there and α is
/// the angle between them. With these weights normals are exact on a sphere, however its faces are shaped (N. Max,
/// "Weights for computing vertex normals from facet normals", 1999). `product` is a normal as long as `a × b`, `squares`
/// is `|a|² |b|²`.
fn add(normal: &mut DVec3, product: DVec3, squares: f64) {
    let weight = squares.recip();
    if weight.is_finite() {
        *normal += weight * product;
    }
}
