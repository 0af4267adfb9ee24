//! Masks as the paper draws them (right-hand sides of its Figures 7, 8 and 10): the old mesh around a new vertex, with the
//! weights beside the old vertices that it is made of.

use std::collections::BTreeMap;

use glam::{DVec2, DVec3};

use vv::masks::shown;
use vv::mesh::triangulate::newell;
use vv::mesh::{Mesh, Vertex};

use super::notes::{Inks, widest_gap};
use super::page::{Dots, Note, Sketch, Strokes};
use super::{Dash, Line};

/// Of edges that lead away from the vertices of the mask so much is drawn.
const STUB: f64 = 0.25;

/// How much farther off a weight may stand to be clear of edges, over the height of letters.
const FAR: f64 = 2.2;

/// The mask of a vertex. Its old vertices lie where `place` puts them in the plane; those that it does not place are left
/// out. The new vertex is a circle, around a dot where it lies on an old one. `letters` is the height of the weights in
/// points.
#[must_use]
pub fn mask(mesh: &Mesh, weights: &[(Vertex, f64)], place: impl Fn(Vertex) -> Option<DVec2>, letters: f64) -> Sketch {
    let placed: BTreeMap<Vertex, (DVec2, f64)> =
        weights.iter().filter_map(|&(v, weight)| Some((v, (place(v).filter(|p| p.is_finite())?, weight)))).collect();
    let (mut edges, mut stubs) = (Vec::new(), Vec::new());
    let mut around: BTreeMap<Vertex, Vec<DVec2>> = BTreeMap::new();
    for (&v, &(at, _)) in &placed {
        for u in mesh.ring(v).vertices() {
            match (placed.get(&u), place(u).filter(|p| p.is_finite())) {
                (Some((to, _)), _) => {
                    around.entry(v).or_default().push(to - at);
                    if v < u {
                        edges.push([at, *to]);
                    }
                }
                (None, Some(to)) => stubs.push([at, at.lerp(to, STUB)]),
                (None, None) => {}
            }
        }
    }
    let new: DVec2 = placed.values().map(|(at, weight)| at * *weight).sum();
    let size = placed.values().map(|(at, _)| at.distance(new)).fold(0.0, f64::max);
    let clearance = |at: DVec2| if at.distance(new) < 1e-6 * size { 0.62 * letters } else { 0.45 * letters };
    let note = |(v, (at, weight)): (&Vertex, &(DVec2, f64))| {
        let (toward, gap) = widest_gap(around.get(v).map_or(&[], |lines| lines));
        let (text, color) = (weight_text(*weight), Inks::PAPER.text);
        let (clearance, gap) = (clearance(*at), (gap, FAR * letters));
        Note { name: "weights", at: *at, toward, clearance, gap, text, size: letters, color }
    };
    let line = |width, color| Line { width: width * letters, color, dash: Dash::Solid };
    let strokes = |name, line, pieces| Strokes { name, line, pieces, heads: Vec::new() };
    let dots = |name, diameter, color, places| Dots { name, diameter: diameter * letters, color, places };
    let around_new = if new.is_finite() { vec![new] } else { Vec::new() };
    Sketch {
        strokes: vec![
            strokes("old-edges-away", line(0.05, [0x99; 3]), stubs),
            strokes("old-edges", line(0.075, [0; 3]), edges),
        ],
        dots: vec![
            dots("new-vertex", 0.95, [0; 3], around_new.clone()),
            dots("new-vertex-inside", 0.78, [0xff; 3], around_new),
            dots("old-vertices", 0.4, [0; 3], placed.values().map(|(at, _)| *at).collect()),
        ],
        notes: placed.iter().map(note).collect(),
        ..Sketch::default()
    }
    .centered()
}

/// The mask of a vertex, its old vertices where they are seen to lie on the mesh from outside.
#[must_use]
pub fn mask_on(mesh: &Mesh, weights: &[(Vertex, f64)], letters: f64) -> Sketch {
    let normal = |v: Vertex| {
        let around: Vec<DVec3> = mesh.ring(v).vertices().map(|u| mesh.position(u)).collect();
        newell(&around).normalize_or_zero()
    };
    let normal: DVec3 = weights.iter().map(|&(v, w)| normal(v) * w.abs()).sum();
    let normal = normal.try_normalize().unwrap_or(DVec3::Z);
    // What is up in the world is up on the page.
    let up = if normal.y.abs() < 0.99 { DVec3::Y } else { DVec3::NEG_Z };
    let across = up.cross(normal).normalize_or(DVec3::X);
    let up = normal.cross(across);
    let place = |v: Vertex| Some(DVec2::new(mesh.position(v).dot(across), mesh.position(v).dot(up)));
    mask(mesh, weights, place, letters)
}

/// As a fraction if it is one, with a minus sign.
fn weight_text(weight: f64) -> String {
    shown(weight, 4).replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_are_fractions_or_short_numbers() {
        let texts = [0.375, -0.0625, 1.0, 0.420_655_3, -0.5 * 2f64.sqrt()].map(weight_text);
        assert_eq!(texts, ["3/8", "−1/16", "1", "0.4207", "−0.7071"]);
    }
}
