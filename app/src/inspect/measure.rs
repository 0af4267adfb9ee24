//! Lengths, angles, areas.

use glam::DVec3;
use vv::mesh::triangulate::newell;
use vv::mesh::{Mesh, Vertex};

use super::walk::face_left_of;

/// What is told of a face.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FaceMeasure {
    /// Of the polygon projected on the plane that fits best: half the length of its vector area.
    pub area: f64,
    /// The sum of its sides.
    pub perimeter: f64,
    /// How far a corner lies from the plane that fits best, at most.
    pub off_plane: f64,
    /// Half its width: from the middle of the corners to the farthest one.
    pub radius: f64,
    /// The longest of its sides.
    pub longest: f64,
    /// The middle of its corners.
    pub center: DVec3,
    /// Of length one; zero for a face without area.
    pub normal: DVec3,
}

impl FaceMeasure {
    /// Of a polygon.
    #[must_use]
    pub fn of(points: &[DVec3]) -> Self {
        let vector = newell(points);
        let normal = vector.normalize_or_zero();
        let center = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
        let most = |f: &dyn Fn(DVec3) -> f64| points.iter().map(|&p| f(p)).fold(0.0, f64::max);
        let sides = points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| a.distance(*b));
        let (perimeter, longest) = sides.fold((0.0, 0.0), |(sum, most): (f64, f64), l| (sum + l, most.max(l)));
        Self {
            area: vector.length() / 2.0,
            perimeter,
            off_plane: most(&|p| (p - center).dot(normal).abs()),
            radius: most(&|p| p.distance(center)),
            longest,
            center,
            normal,
        }
    }

    /// How far from plane, as a part of its width: 0 for a plane face.
    #[must_use]
    pub fn warp(&self) -> f64 {
        if self.radius > 0.0 { self.off_plane / (2.0 * self.radius) } else { 0.0 }
    }
}

/// The angle at `b` between `a` and `c`, in degrees; `None` if two of them lie at the same place.
#[must_use]
pub fn angle(a: DVec3, b: DVec3, c: DVec3) -> Option<f64> {
    let (u, v) = ((a - b).try_normalize()?, (c - b).try_normalize()?);
    // Precise also near 0° and 180°, where the cosine is flat. W. Kahan, "How futile are mindless assessments of
    // roundoff", 2006.
    Some((2.0 * (u - v).length().atan2((u + v).length())).to_degrees())
}

/// The angle between the two faces at an edge, inside the surface, in degrees: 180 where it is flat, less at a ridge, more
/// in a valley. `None` at the boundary, and beside faces without area.
#[must_use]
pub fn dihedral(mesh: &Mesh, [p, q]: [Vertex; 2]) -> Option<f64> {
    let normal = |edge| {
        let corners = face_left_of(mesh, edge)?;
        let points: Vec<DVec3> = corners.iter().map(|&v| mesh.position(v)).collect();
        newell(&points).try_normalize()
    };
    let (left, right) = (normal([p, q])?, normal([q, p])?);
    let along = (mesh.position(q) - mesh.position(p)).try_normalize()?;
    // Positive at a ridge, where the normals of the two faces lean apart.
    let bend = left.cross(right).dot(along).atan2(left.dot(right));
    Some(180.0 - bend.to_degrees())
}

/// The direction in which the surface faces at a vertex; `None` where nothing says so.
#[must_use]
pub fn normal_at(mesh: &Mesh, v: Vertex) -> Option<DVec3> {
    const ENOUGH: usize = 64;
    let slots = mesh.ring(v).slots();
    let at = mesh.position(v);
    let around = slots.iter().zip(slots.iter().cycle().skip(1)).take(ENOUGH);
    let sum: DVec3 = around
        .filter_map(|(&a, &b)| Some((mesh.position(a?) - at).cross(mesh.position(b?) - at)))
        .filter(|n| n.is_finite())
        .sum();
    sum.try_normalize()
}

/// A number as people read it: six digits that count.
#[must_use]
pub fn short(x: f64) -> String {
    let size = x.abs();
    if !size.is_finite() {
        return x.to_string();
    }
    if size != 0.0 && !(1e-4..1e7).contains(&size) {
        let text = format!("{x:.5e}");
        let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        return format!("{}e{exponent}", trim_zeros(digits));
    }
    let before = if size < 1.0 { 1 } else { size.log10().floor() as usize + 1 };
    let text = format!("{x:.*}", 6usize.saturating_sub(before));
    let text = trim_zeros(&text);
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

fn trim_zeros(digits: &str) -> &str {
    if digits.contains('.') { digits.trim_end_matches('0').trim_end_matches('.') } else { digits }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let check = |x: f64, expected: &str| assert_eq!(short(x), expected);
        check(0.0, "0");
        check(-1e-9, "-1e-9");
        check(1.0 / 3.0, "0.33333");
        check(2.5, "2.5");
        check(1234.5678, "1234.57");
        check(-60.000_000_01, "-60");
        check(1e12, "1e12");
        check(1.5e-7, "1.5e-7");
        check(f64::INFINITY, "inf");
    }

    #[test]
    fn angles_are_those_of_school() {
        let at = |a: [f64; 3], b: [f64; 3], c: [f64; 3]| angle(a.into(), b.into(), c.into());
        assert_eq!(at([1.0, 0.0, 0.0], [0.0; 3], [0.0, 2.0, 0.0]).map(|x| x.round()), Some(90.0));
        assert_eq!(at([1.0, 0.0, 0.0], [0.0; 3], [-3.0, 0.0, 0.0]), Some(180.0));
        assert_eq!(at([0.0; 3], [0.0; 3], [1.0, 0.0, 0.0]), None);
    }

    #[test]
    fn a_square_is_measured_and_a_bent_one_is_not_plane() {
        let square = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0]].map(DVec3::from);
        let m = FaceMeasure::of(&square);
        assert_eq!((m.area, m.perimeter, m.off_plane, m.normal), (4.0, 8.0, 0.0, DVec3::Z));
        let mut bent = square;
        bent[2].z = 1.0;
        assert!(FaceMeasure::of(&bent).warp() > 0.05);
    }

    #[test]
    fn a_ridge_is_sharper_than_a_plane_and_a_valley_blunter() {
        let angle = |z: f64| {
            let roof = format!("v 0 0 0\nv 0 1 0\nv -1 0 {z}\nv 1 0 {z}\nf 2 1 4\nf 1 2 3\n");
            let (mesh, _) = vv::io::read(roof.as_bytes(), vv::io::Format::Obj, &Default::default()).unwrap();
            let ends: Vec<Vertex> = mesh.vertices().take(2).collect();
            dihedral(&mesh, [ends[0], ends[1]]).map(|x| x.round())
        };
        // Outside is above: sides that go down make a ridge.
        let [down, flat, up] = [-1.0, 0.0, 1.0].map(angle);
        assert_eq!(flat, Some(180.0));
        assert_eq!([down, up], [Some(90.0), Some(270.0)]);
    }
}
