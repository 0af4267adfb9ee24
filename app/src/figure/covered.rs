//! Faces that others cover wholly, exactly: they need not be painted.
//!
//! From what is seen of a triangle each one that lies before it is taken away; what is left are convex pieces. A face of
//! which nothing is left is covered. Triangles that pierce it take nothing away, and a triangle that falls into very many
//! pieces counts as seen: so more may be painted than is seen, but never less.

use glam::{DVec2, Vec3Swizzles};
use rayon::prelude::*;

use vv::stop::{Stop, Stopped};

use super::boxes::Boxes;
use super::order::{AREA, area, compare};
use super::surface::Triangle;

/// More pieces than this are not followed.
const MOST_PIECES: usize = 96;

/// Whether each face is covered; `face_of` says which one a triangle is of.
///
/// Cost: what lies before each triangle, on all threads.
pub(super) fn covered(
    triangles: &[Triangle],
    face_of: &[u32],
    count: usize,
    stop: &Stop,
) -> Result<Vec<bool>, Stopped> {
    let boxes = Boxes::new(&triangles.iter().map(|t| t.corners).collect::<Vec<_>>());
    let is_seen = |number: usize| stop.check().is_err() || is_seen(triangles, face_of, &boxes, number);
    let seen: Vec<bool> = (0..triangles.len()).into_par_iter().map(is_seen).collect();
    stop.check()?;
    let mut covered = vec![true; count];
    for (face, _) in face_of.iter().zip(seen).filter(|(_, seen)| *seen) {
        if let Some(covered) = covered.get_mut(*face as usize) {
            *covered = false;
        }
    }
    Ok(covered)
}

fn is_seen(triangles: &[Triangle], face_of: &[u32], boxes: &Boxes, number: usize) -> bool {
    let corners = triangles[number].corners;
    let [low, high] = [corners[0].min(corners[1]).min(corners[2]), corners[0].max(corners[1]).max(corners[2])];
    let mut pieces = vec![corners.map(|p| p.xy()).to_vec()];
    if is_nothing(&pieces[0]) {
        return false;
    }
    boxes.meeting(low.xy(), high.xy(), |other| {
        let before = triangles[other as usize].corners;
        let reaches = before.iter().any(|p| p.z > low.z);
        if face_of[other as usize] != face_of[number] && reaches && compare(&before, &corners) == (true, false) {
            pieces = pieces.iter().flat_map(|piece| without(piece, before.map(|p| p.xy()))).collect();
        }
        !pieces.is_empty() && pieces.len() <= MOST_PIECES
    });
    !pieces.is_empty()
}

/// A convex polygon without a triangle: convex pieces.
fn without(polygon: &[DVec2], mut triangle: [DVec2; 3]) -> Vec<Vec<DVec2>> {
    if (triangle[1] - triangle[0]).perp_dot(triangle[2] - triangle[0]) < 0.0 {
        triangle.reverse();
    }
    let mut pieces = Vec::new();
    let mut rest = polygon.to_vec();
    for i in 0..3 {
        let (a, b) = (triangle[i], triangle[(i + 1) % 3]);
        let side = |p: DVec2| (b - a).perp_dot(p - a);
        let outside = half(&rest, |p| -side(p));
        if !is_nothing(&outside) {
            pieces.push(outside);
        }
        rest = half(&rest, side);
        if is_nothing(&rest) {
            // It lies beside the triangle: better whole than in pieces.
            return vec![polygon.to_vec()];
        }
    }
    pieces
}

/// What of a convex polygon is positive.
fn half(polygon: &[DVec2], side: impl Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut kept = Vec::with_capacity(polygon.len() + 1);
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (f, g) = (side(p), side(q));
        if f >= 0.0 {
            kept.push(p);
        }
        if (f >= 0.0) != (g >= 0.0) {
            kept.push(p + (q - p) * (f / (f - g)));
        }
    }
    kept
}

fn is_nothing(polygon: &[DVec2]) -> bool {
    polygon.len() < 3 || area(polygon).abs() <= AREA
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Twice the area of what is left of a square without triangles.
    #[track_caller]
    fn check(triangles: &[[(f64, f64); 3]], expected: f64) {
        let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(DVec2::from).to_vec();
        let mut pieces = vec![square];
        for triangle in triangles {
            pieces = pieces.iter().flat_map(|piece| without(piece, triangle.map(DVec2::from))).collect();
        }
        let left: f64 = pieces.iter().map(|piece| area(piece)).sum();
        assert!((left - expected).abs() < 1e-9, "{left}: {pieces:?}");
    }

    #[test]
    fn of_a_square_is_left_what_no_triangle_covers() {
        check(&[], 8.0);
        check(&[[(0.0, 0.0), (2.0, 0.0), (0.0, 2.0)]], 4.0);
        check(&[[(0.0, 2.0), (2.0, 0.0), (0.0, 0.0)], [(2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]], 0.0);
        check(&[[(0.5, 0.5), (1.5, 0.5), (0.5, 1.5)]], 7.0);
        check(&[[(5.0, 5.0), (6.0, 5.0), (5.0, 6.0)]], 8.0);
        check(&[[(-9.0, -9.0), (20.0, -9.0), (-9.0, 20.0)]], 0.0);
    }
}
