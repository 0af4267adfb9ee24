//! Subdivision of curves.

use std::collections::BTreeMap;

use super::{Refined, mask};
/// A curve as the neighbours of each of its points: one where it ends, two inside, more where several meet.
pub type Curve = Vec<Vec<usize>>;

/// The other neighbour of p than q where p has two.
fn beyond(curve: &Curve, p: usize, q: usize) -> Option<usize> {
    match curve[p][..] {
        [a, b] => Some(if a == q { b } else { a }),
        _ => None,
    }
}

/// Each edge gets a point.
fn bisect(curve: &Curve, vertex: impl Fn(usize) -> Vec<f64>, edge: impl Fn(usize, usize) -> Vec<f64>) -> Refined {
    let mut refined = Refined { masks: (0..curve.len()).map(vertex).collect(), ..Refined::default() };
    for (p, q) in (0..curve.len()).flat_map(|p| curve[p].iter().map(move |&q| (p, q))).filter(|(p, q)| p < q) {
        let x = refined.masks.len();
        refined.masks.push(edge(p, q));
        refined.edges.extend([(p, x), (q, x)]);
    }
    refined
}

/// The cubic B-spline (Lane and Riesenfeld 1980).
pub fn cubic(curve: &Curve) -> Refined {
    let n = curve.len();
    let vertex = |v: usize| match curve[v][..] {
        [a, b] => mask(n, [(a, 1.0 / 8.0), (v, 3.0 / 4.0), (b, 1.0 / 8.0)]),
        _ => mask(n, [(v, 1.0)]),
    };
    bisect(curve, vertex, |p, q| mask(n, [(p, 0.5), (q, 0.5)]))
}

/// Dyn, Gregory and Levin 1987.
pub fn four_point(curve: &Curve, w: f64) -> Refined {
    let n = curve.len();
    let edge = |p: usize, q: usize| {
        let mut weights = vec![(p, 0.5 + w), (q, 0.5 + w)];
        for (p, q) in [(p, q), (q, p)] {
            match beyond(curve, p, q) {
                Some(a) => weights.push((a, -w)),
                None => weights.extend([(p, -2.0 * w), (q, w)]),
            }
        }
        mask(n, weights)
    };
    bisect(curve, |v| mask(n, [(v, 1.0)]), edge)
}

/// Chaikin 1974.
pub fn chaikin(curve: &Curve) -> Refined {
    let n = curve.len();
    let mut refined = Refined::default();
    let mut number = BTreeMap::new(); // of the new point near p on the edge to q, and of old points
    for (p, neighbours) in curve.iter().enumerate() {
        for &q in neighbours {
            number.insert((p, Some(q)), refined.masks.len());
            refined.masks.push(mask(n, [(p, 0.75), (q, 0.25)]));
        }
        if neighbours.len() != 2 {
            number.insert((p, None), refined.masks.len());
            refined.masks.push(mask(n, [(p, 1.0)]));
        }
    }
    let mut join = |a: usize, b: usize| refined.edges.insert((a.min(b), a.max(b)));
    for (p, neighbours) in curve.iter().enumerate() {
        for &q in neighbours {
            join(number[&(p, Some(q))], number[&(q, Some(p))]);
            let inward = match number.get(&(p, None)) {
                Some(&old) => old,
                None => number[&(p, beyond(curve, p, q))],
            };
            join(number[&(p, Some(q))], inward);
        }
    }
    refined
}
