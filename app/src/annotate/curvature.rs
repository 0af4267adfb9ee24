//! Discrete curvature at vertices.
//!
//! With the angles θ, and the angles α, β opposite to an edge, of the triangles around a vertex x of area A:
//!
//! ```text
//!   Gauss   K = (2π − Σ θ) / A
//!   mean    H = n · Σ (cot α + cot β) (x − y) / 4A        n the normal outwards, y the neighbours
//! ```
//!
//! A is the mixed area: that of the points of a triangle that are nearer to x than to its other corners, or, for obtuse
//! triangles, half or a quarter of the triangle. M. Meyer et al., "Discrete differential-geometry operators for
//! triangulated 2-manifolds", 2003, equations 5, 8, 9 and figure 4. A ball of radius r has H = 1/r, K = 1/r².
//!
//! Polygons are taken as the triangles they are drawn as.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;
use vv::stop::{Stop, Stopped};

use super::Subject;

/// Which curvature.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Curvature {
    /// The product of the principal curvatures.
    Gauss,
    /// Their mean; positive where the surface is convex seen from outside.
    Mean,
}

/// What the triangles around a vertex add up to.
#[derive(Clone, Copy, Default)]
struct Sums {
    angle: f64,
    area: f64,
    /// Σ (cot α + cot β) (x − y)
    laplace: DVec3,
    /// Of the triangles, weighted by their angles.
    normal: DVec3,
}

/// The curvature at each vertex; not a number at the boundary, where it has no meaning, and without faces.
///
/// # Errors
/// When stopped.
pub fn curvature(subject: &Subject<'_>, which: Curvature, stop: &Stop) -> Result<Vec<f64>, Stopped> {
    let (mesh, part) = (subject.mesh, &subject.scene.mesh);
    let mut sums = vec![Sums::default(); mesh.vertex_count()];
    for (i, triangle) in part.triangles.iter().enumerate() {
        if i % 4096 == 0 {
            stop.check()?;
        }
        let Some(vertices) = triangle_vertices(part.owners.as_slice(), *triangle) else { continue };
        let points = vertices.map(|v| mesh.positions().get(v).copied().unwrap_or(DVec3::NAN));
        add_triangle(&mut sums, vertices, points);
    }
    Ok(mesh
        .vertices()
        .zip(&sums)
        .map(|(v, s)| match which {
            _ if mesh.ring(v).gaps() > 0 || s.area <= 0.0 => f64::NAN,
            Curvature::Gauss => (2.0 * PI - s.angle) / s.area,
            Curvature::Mean => s.laplace.dot(s.normal.normalize_or_zero()) / (4.0 * s.area),
        })
        .collect())
}

fn triangle_vertices(owners: &[vv::mesh::Vertex], triangle: [u32; 3]) -> Option<[usize; 3]> {
    let at = |corner: u32| owners.get(corner as usize).map(|v| v.index());
    Some([at(triangle[0])?, at(triangle[1])?, at(triangle[2])?])
}

fn add_triangle(sums: &mut [Sums], vertices: [usize; 3], points: [DVec3; 3]) {
    let normal = (points[1] - points[0]).cross(points[2] - points[0]);
    let area = normal.length() / 2.0;
    if area.is_nan() || area <= 0.0 {
        return; // no surface
    }
    let angles = [0, 1, 2].map(|i| {
        let (a, b) = (points[(i + 1) % 3] - points[i], points[(i + 2) % 3] - points[i]);
        (2.0 * area).atan2(a.dot(b))
    });
    let cotangents = angles.map(|angle| angle.cos() / angle.sin());
    let obtuse = angles.iter().position(|&angle| angle > FRAC_PI_2);
    for i in 0..3 {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        let (to_j, to_k) = (points[i] - points[j], points[i] - points[k]);
        let Some(s) = sums.get_mut(vertices[i]) else { continue };
        s.angle += angles[i];
        s.normal += normal / (2.0 * area) * angles[i];
        // The angle at k is opposite to the edge from i to j.
        s.laplace += cotangents[k] * to_j + cotangents[j] * to_k;
        s.area += match obtuse {
            None => (cotangents[k] * to_j.length_squared() + cotangents[j] * to_k.length_squared()) / 8.0,
            Some(at) if at == i => area / 2.0,
            Some(_) => area / 4.0,
        };
    }
}
