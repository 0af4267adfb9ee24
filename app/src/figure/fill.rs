//! Faces as areas in their colours, from back to front.

use glam::{DVec2, DVec3, Vec3Swizzles};

use vv::mesh::triangulate::newell;
use vv::stop::{Stop, Stopped};

use super::Subject;
use super::covered::covered;
use super::light::{lit, own_color};
use super::order::{Order, Painted, order};
use super::space::{NONE, Space};
use super::surface::{Surface, Triangle};
use crate::scene::Style;

/// An area and its colour.
pub(super) type Area = (Vec<DVec2>, [u8; 3]);

/// What is known of a face.
#[derive(Debug, Clone, Default)]
struct Paint {
    /// By which corners of the scene it is coloured.
    corners: Vec<u32>,
    first: u32,
    /// Whether it cannot be painted as a whole: clipped, or seen from both sides.
    broken: bool,
    /// Whether its outside is seen.
    front: Option<bool>,
}

/// The areas, without those that others cover wholly, and whether some are ordered by distance only.
pub(super) fn fill(
    subject: Subject<'_>,
    surface: &Surface,
    space: &Space,
    style: &Style,
    stop: &Stop,
) -> Result<(Vec<Area>, bool), Stopped> {
    let Subject { scene, faces, tint, .. } = subject;
    let part = &scene.mesh;
    let mut paints = vec![Paint::default(); faces.len()];
    for ((triangle, &face), &front) in part.triangles.iter().zip(&part.triangle_faces).zip(&surface.fronts) {
        let Some(paint) = paints.get_mut(face as usize) else { continue };
        if paint.corners.is_empty() {
            paint.first = triangle[0];
        }
        paint.corners.extend(triangle);
        paint.broken |= paint.front.is_some_and(|other| other != front);
        paint.front = Some(front);
    }
    stop.check()?;
    let mut seen = vec![0u32; part.triangles.len()];
    let face_of: Vec<u32> =
        surface.triangles.iter().map(|t| part.triangle_faces.get(t.number as usize).copied().unwrap_or(0)).collect();
    for (triangle, &face) in surface.triangles.iter().zip(&face_of) {
        seen[triangle.number as usize] += 1;
        paints[face as usize].broken |= triangle.vertices.contains(&NONE);
    }
    for (&count, &face) in seen.iter().zip(&part.triangle_faces) {
        paints[face as usize].broken |= count != 1;
    }
    let broken: Vec<bool> = paints.iter().map(|paint| paint.broken).collect();
    let covered = covered(&surface.triangles, &face_of, faces.len(), stop)?;
    let seen = surface.triangles.iter().zip(&face_of).filter(|(_, face)| covered.get(**face as usize) == Some(&false));
    let (triangles, face_of): (Vec<Triangle>, Vec<u32>) = seen.map(|(triangle, face)| (*triangle, *face)).unzip();
    let Order { painted, is_exact } = order(&triangles, &face_of, &broken, stop)?;

    let polygon = |face: u32| {
        let corners =
            faces.get(face as usize).iter().map(|v| surface.corner_of.get(v.index()).copied().unwrap_or(NONE));
        corners.filter_map(|corner| surface.points.get(corner as usize).copied()).collect::<Vec<DVec3>>()
    };
    let color = |face: u32, front: bool| {
        let points = polygon(face);
        let normal = newell(&points).normalize_or_zero();
        let middle = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
        let eye = space.to_eye(middle).normalize_or_zero();
        let normal = if normal.dot(eye) < 0.0 { -normal } else { normal };
        let paint = &paints[face as usize];
        let mut corners: Vec<u32> = paint.corners.clone();
        // Several corners may stand for one vertex.
        corners.sort_unstable_by_key(|&c| (part.vertex(c), c));
        corners.dedup_by_key(|c| part.vertex(*c));
        let own = own_color(part, tint, style.colors, &corners, paint.first);
        lit(own, front, normal.as_vec3(), eye.as_vec3())
    };
    let area = |painted: Painted| match painted {
        Painted::Whole(face) => {
            let corners = polygon(face).into_iter().map(|p| space.project(p).xy()).collect();
            (corners, color(face, paints[face as usize].front.unwrap_or(true)))
        }
        Painted::Piece(corners, number) => {
            let triangle = triangles[number as usize].number;
            (corners, color(face_of[number as usize], surface.fronts[triangle as usize]))
        }
    };
    let areas = painted.into_iter().map(area).collect();
    Ok((areas, !is_exact))
}
