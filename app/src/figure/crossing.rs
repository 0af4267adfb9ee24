//! Where faces pierce each other: lines that no mesh has.
//!
//! Two triangles pierce each other where each has corners strictly on both sides of the other's plane and the stretches
//! that they cut out of the common line of both planes overlap. Those that share an edge, or lie in one plane, or only
//! touch, do not.

use glam::{DVec3, Vec3Swizzles};
use rayon::prelude::*;

use vv::stop::{Stop, Stopped};

use super::Class;
use super::boxes::Boxes;
use super::hidden::SLACK;
use super::space::NONE;
use super::surface::{Edge, Triangle};

/// Shorter lines are none.
const SHORTEST: f64 = 1e-5;

/// More lines than this tell nothing: the mesh lies in itself.
const MOST: usize = 1_000_000;

/// All of them, in order of the triangles.
///
/// Cost: what lies before or behind each triangle, on all threads.
pub(super) fn crossings(triangles: &[Triangle], stop: &Stop) -> Result<Vec<Edge>, Stopped> {
    const CHUNK: usize = 4096;
    let boxes = Boxes::new(&triangles.iter().map(|t| t.corners).collect::<Vec<_>>());
    let of_triangle = |a: usize| {
        let mut found = Vec::new();
        let first = &triangles[a];
        let (low, high) = bounds(first);
        boxes.meeting(low.xy(), high.xy(), |b| {
            let second = &triangles[b as usize];
            let (l, h) = bounds(second);
            let shared = first.whole.iter().filter(|v| second.whole.contains(v)).count();
            if a < b as usize && l.z <= high.z && low.z <= h.z && shared < 2 {
                found.extend(crossing(&first.corners, &second.corners));
            }
            true
        });
        found
    };
    let mut all = Vec::new();
    for start in (0..triangles.len()).step_by(CHUNK) {
        stop.check()?;
        let end = (start + CHUNK).min(triangles.len());
        let found: Vec<_> = (start..end).into_par_iter().map(of_triangle).collect();
        let edge = |ends| Edge { ends, vertices: [NONE; 2], whole: [NONE; 2], class: Class::Intersection };
        all.extend(found.into_iter().flatten().map(edge));
        if all.len() > MOST {
            break;
        }
    }
    Ok(all)
}

fn bounds(t: &Triangle) -> (DVec3, DVec3) {
    let [a, b, c] = t.corners;
    (a.min(b).min(c), a.max(b).max(c))
}

/// The line in which two triangles pierce each other.
fn crossing(a: &[DVec3; 3], b: &[DVec3; 3]) -> Option<[DVec3; 2]> {
    let normal = |t: &[DVec3; 3]| (t[1] - t[0]).cross(t[2] - t[0]).try_normalize();
    let (of_a, of_b) = (normal(a)?, normal(b)?);
    let along = of_a.cross(of_b).try_normalize()?;
    let first = cut(a, b[0], of_b)?;
    let second = cut(b, a[0], of_a)?;
    // Both lie on the common line.
    let place = |p: DVec3| along.dot(p);
    let ordered = |[p, q]: [DVec3; 2]| if place(p) <= place(q) { [p, q] } else { [q, p] };
    let ([p, q], [r, s]) = (ordered(first), ordered(second));
    let low = if place(p) >= place(r) { p } else { r };
    let high = if place(q) <= place(s) { q } else { s };
    (place(high) - place(low) > SHORTEST).then_some([low, high])
}

/// Where a plane cuts a triangle that has corners on both sides of it.
fn cut(t: &[DVec3; 3], point: DVec3, normal: DVec3) -> Option<[DVec3; 2]> {
    let side = t.map(|p| normal.dot(p - point));
    let (least, most) = (side[0].min(side[1]).min(side[2]), side[0].max(side[1]).max(side[2]));
    if least > -SLACK || most < SLACK {
        return None;
    }
    let mut ends = (0..3).filter_map(|i| {
        let j = (i + 1) % 3;
        let crosses = (side[i] > 0.0) != (side[j] > 0.0);
        crosses.then(|| t[i].lerp(t[j], side[i] / (side[i] - side[j])))
    });
    Some([ends.next()?, ends.next()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(b: [[f64; 3]; 3], expected: Option<[[f64; 3]; 2]>) {
        let a = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]].map(DVec3::from);
        let b = b.map(DVec3::from);
        for (a, b) in [(a, b), (b, a)] {
            let found = crossing(&a, &b).map(|ends| {
                let mut ends = ends.map(|p| (p * 1e6).round() / 1e6 + 0.0);
                ends.sort_by(|p, q| p.x.total_cmp(&q.x));
                ends.map(|p| p.to_array())
            });
            assert_eq!(found, expected);
        }
    }

    #[test]
    fn triangles_cross_in_the_line_that_both_have() {
        check([[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 1.0, 0.0]], Some([[1.0, 1.0, 0.0], [3.0, 1.0, 0.0]]));
        // Beside it, in its plane, and on it.
        check([[5.0, 5.0, -1.0], [5.0, 5.0, 1.0], [9.0, 5.0, 0.0]], None);
        check([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 2.0, 0.0]], None);
        check([[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [1.0, 1.0, 3.0]], None);
    }
}
