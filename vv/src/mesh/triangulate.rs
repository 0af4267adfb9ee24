//! Polygons to triangles.

use glam::{DVec2, DVec3};

/// Concave polygons with more corners than this become fans. Cutting ears takes up to the square of their number, and
/// what has so many is hardly a polygon that somebody drew, but the work of a program gone astray.
const MOST_EARS: usize = 10_000;

/// Cuts polygons into triangles; keeps its memory from one polygon to the next.
#[derive(Default)]
pub struct Triangulator {
    earcut: earcut::Earcut<f64>,
    flat: Vec<[f64; 2]>,
    corners: Vec<u32>,
}

/// Twice the vector area of a polygon, by Newell's method: `Σ (pᵢ − c) × (pᵢ₊₁ − c)`. Its direction is the normal of
/// the plane that fits best, its length does not depend on where the polygon starts.
#[must_use]
pub fn newell(points: &[DVec3]) -> DVec3 {
    let (&[first, ..], Some(&last)) = (points, points.last()) else { return DVec3::ZERO };
    let mut sum = DVec3::ZERO;
    let mut before = last - first;
    for &p in points {
        let here = p - first; // relative to a corner, or far-away polygons would cancel
        sum += before.cross(here);
        before = here;
    }
    sum
}

impl Triangulator {
    /// The triangles of a polygon as indices into `points`, oriented as the polygon is. `normal` is [`newell`]'s.
    ///
    /// Convex polygons become fans (quadrilaterals are cut along the shorter diagonal), concave ones are cut by ears
    /// after projection on the plane that fits best. One that projects onto a line becomes a fan too: none of its
    /// triangulations is better than another; so does a concave one with more than 10,000 corners.
    pub fn triangles(&mut self, points: &[DVec3], normal: DVec3, out: &mut Vec<[u32; 3]>) {
        out.clear();
        match points {
            [] | [_] | [_, _] => return,
            [_, _, _] => return out.push([0, 1, 2]),
            _ => {}
        }
        let Some(normal) = normal.try_normalize() else { return fan(points.len(), out) };
        if let &[a, b, c, d] = points {
            let turns = [(d, a, b), (a, b, c), (b, c, d), (c, d, a)].map(|(p, q, r)| (q - p).cross(r - q).dot(normal));
            if turns.iter().all(|&turn| turn >= 0.0) {
                let second = a.distance_squared(c) > b.distance_squared(d);
                return out.extend(if second { [[1, 2, 3], [1, 3, 0]] } else { [[0, 1, 2], [0, 2, 3]] });
            }
        }
        let (x, y) = normal.any_orthonormal_pair();
        self.flat.clear();
        self.flat.extend(points.iter().map(|&p| [(p - points[0]).dot(x), (p - points[0]).dot(y)]));
        if points.len() > MOST_EARS || is_convex(&self.flat) {
            return fan(points.len(), out);
        }
        self.earcut.earcut_slice(&self.flat, &[], &mut self.corners);
        out.extend(self.corners.as_chunks::<3>().0.iter().copied());
        // Ears come out in either orientation; a polygon's plane was chosen so that it turns to the left.
        for [_, b, c] in out.iter_mut().filter(|t| turn(t.map(|i| DVec2::from(self.flat[i as usize]))) < 0.0) {
            std::mem::swap(b, c);
        }
        if out.is_empty() {
            fan(points.len(), out);
        }
    }
}

fn fan(corners: usize, out: &mut Vec<[u32; 3]>) {
    let corners = u32::try_from(corners).unwrap_or(u32::MAX);
    out.extend((2..corners).map(|i| [0, i - 1, i]));
}

/// Positive where `a b c` turns to the left.
fn turn([a, b, c]: [DVec2; 3]) -> f64 {
    (b - a).perp_dot(c - b)
}

/// Whether a polygon turns to the left at every corner, and once around in all: every edge direction goes from the
/// lower to the upper half plane once.
fn is_convex(points: &[[f64; 2]]) -> bool {
    let n = points.len();
    let at = |i: usize| DVec2::from(points[i % n]);
    let upper = |v: DVec2| v.y > 0.0 || (v.y == 0.0 && v.x > 0.0);
    let mut starts = 0;
    for i in 0..n {
        let (a, b, c) = (at(i), at(i + 1), at(i + 2));
        if turn([a, b, c]) < 0.0 || a == b {
            return false;
        }
        starts += usize::from(!upper(b - a) && upper(c - b));
    }
    starts == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The triangles cover the polygon: their areas, all of one orientation, add up to its.
    #[track_caller]
    fn check(points: &[[f64; 3]]) -> Vec<[u32; 3]> {
        let points: Vec<DVec3> = points.iter().map(|&p| p.into()).collect();
        let normal = newell(&points);
        let mut triangles = Vec::new();
        Triangulator::default().triangles(&points, normal, &mut triangles);
        let mut area = 0.0;
        for t in &triangles {
            let doubled = newell(&t.map(|i| points[i as usize])).dot(normal.normalize());
            assert!(doubled >= 0.0, "{t:?} is turned around");
            area += doubled;
        }
        assert!((area - normal.length()).abs() < 1e-9 * normal.length(), "{area} of {}", normal.length());
        triangles
    }

    #[test]
    fn a_triangle_is_itself() {
        assert_eq!(check(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]), [[0, 1, 2]]);
    }

    #[test]
    fn a_quadrilateral_is_cut_along_the_shorter_diagonal() {
        assert_eq!(
            check(&[[-2.0, 0.0, 0.0], [0.0, -1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]),
            [[1, 2, 3], [1, 3, 0]]
        );
        assert_eq!(
            check(&[[-1.0, 0.0, 0.0], [0.0, -2.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]),
            [[0, 1, 2], [0, 2, 3]]
        );
    }

    #[test]
    fn a_dart_is_cut_at_its_notch_wherever_it_starts() {
        let dart = [[0.0, 0.0, 5.0], [2.0, -1.0, 5.0], [1.0, 0.0, 5.0], [2.0, 1.0, 5.0]];
        for start in 0..4 {
            let mut dart = dart;
            dart.rotate_left(start);
            check(&dart);
            dart.reverse();
            check(&dart);
        }
    }

    #[test]
    fn a_regular_polygon_is_a_fan() {
        let angles = (0..6).map(|i| f64::from(i) / 6.0 * std::f64::consts::TAU);
        let points: Vec<_> = angles.map(|t| [t.cos(), t.sin(), 0.0]).collect();
        assert_eq!(check(&points), [[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]);
    }

    #[test]
    fn a_tilted_concave_comb_far_away_is_covered() {
        let mut comb = Vec::new();
        for i in 0..20 {
            let x = f64::from(i);
            comb.push([1e6 + x, 1e6 + if i % 2 == 0 { 0.0 } else { 9.0 }, 1e6 + x / 2.0]);
        }
        comb.push([1e6 + 19.0, 1e6 + 10.0, 1e6 + 9.5]);
        comb.push([1e6, 1e6 + 10.0, 1e6]);
        check(&comb);
    }

    #[test]
    fn a_star_that_winds_twice_is_no_fan() {
        let flat: Vec<_> =
            (0..5).map(|i| f64::from(i * 2) * std::f64::consts::TAU / 5.0).map(|t| [t.cos(), t.sin()]).collect();
        assert!(!is_convex(&flat));
    }

    #[test]
    fn a_saddle_without_a_best_plane_and_a_collapsed_polygon_become_fans() {
        let points = |p: [[f64; 3]; 4]| p.map(DVec3::from);
        for p in [points([[0.0; 3]; 4]), points([[0.0; 3], [1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])] {
            let mut triangles = Vec::new();
            Triangulator::default().triangles(&p, newell(&p), &mut triangles);
            assert_eq!(triangles, [[0, 1, 2], [0, 2, 3]]);
        }
    }

    #[test]
    fn ten_thousand_spikes_are_cut_in_time() {
        let n = 10_000;
        let spikes: Vec<_> = (0..n)
            .map(|i| {
                let angle = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
                let r = if i % 2 == 0 { 1.0 } else { 1.1 };
                [r * angle.cos(), r * angle.sin(), 0.0]
            })
            .collect();
        check(&spikes);
    }

    #[test]
    fn a_tangle_of_many_corners_takes_no_time() {
        let tangle: Vec<_> =
            (0..200_000i64).map(|i| DVec3::new((i * 7919 % 1009) as f64, (i % 997) as f64, 0.0)).collect();
        let mut triangles = Vec::new();
        Triangulator::default().triangles(&tangle, newell(&tangle), &mut triangles);
        assert_eq!(triangles.len(), 199_998);
    }
}
