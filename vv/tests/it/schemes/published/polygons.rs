//! Subdivision of polygons.

use std::f64::consts::TAU;

use super::{Numbers, Refined, blend, compose, creased_edge, creased_vertex, mask, middle, one, operators::kis};
use crate::schemes::surface::Surface;

/// Midedge (Peters and Reif 1997): the ambo of the mesh, without faces of boundary vertices.
pub fn midedge(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let edges = surface.edges();
    let number: Numbers = edges.iter().enumerate().map(|(i, &e)| (e, i)).collect();
    let middle = |p: usize, q: usize| number[&(p.min(q), p.max(q))];
    let masks = edges.iter().map(|&(p, q)| mask(n, [(p, 0.5), (q, 0.5)])).collect();
    let around = |f: &Vec<usize>| (0..f.len()).map(|i| middle(f[i], f[(i + 1) % f.len()])).collect();
    let mut faces: Vec<Vec<usize>> = surface.faces.iter().map(around).collect();
    let inner = (0..n).filter(|&v| surface.boundary(v).is_none());
    faces.extend(inner.map(|v| surface.neighbours(v).into_iter().map(|q| middle(v, q)).collect()));
    Refined::of(masks, faces)
}

/// Velho and Zorin 2001. The first step puts a point into each face; in others, triangles are halved at the edge across
/// their newest vertex, that of the greatest number.
pub fn four_eight(surface: &Surface, first: bool) -> Refined {
    let n = surface.points.len();
    let apex = |p: usize, q: usize| surface.across(p, q).filter(|&a| a > p && a > q);
    let halved = |p: usize, q: usize| !first && (apex(p, q).is_some() || apex(q, p).is_some());
    let vertex = |v: usize| match surface.boundary(v) {
        Some([a, b]) if halved(v, a) => mask(n, [(a, 1.0 / 8.0), (v, 3.0 / 4.0), (b, 1.0 / 8.0)]),
        Some(_) => one(n, v),
        None => {
            let kept: Vec<_> = surface.neighbours(v).into_iter().filter(|&q| !halved(v, q)).collect();
            let w = 0.5 / kept.len() as f64;
            mask(n, kept.into_iter().map(|q| (q, w)).chain([(v, 0.5)]))
        }
    };
    let mut refined = if first { kis(surface) } else { Refined::default() };
    if !first {
        refined.masks.resize(n, Vec::new());
        for (p, q) in surface.edges().into_iter().filter(|&(p, q)| halved(p, q)) {
            let x = refined.masks.len();
            let around: Vec<_> = [p, q].into_iter().chain(apex(p, q)).chain(apex(q, p)).collect();
            let corners = if around.len() == 4 { &around[..] } else { &around[..2] };
            refined.masks.push(middle(n, corners));
            for (p, q) in [(p, q), (q, p)] {
                refined.faces.extend(apex(p, q).into_iter().flat_map(|a| [vec![p, x, a], vec![x, q, a]]));
            }
        }
    }
    (0..n).for_each(|v| refined.masks[v] = vertex(v));
    Refined::of(refined.masks, refined.faces)
}

/// Each face of n corners becomes n quads: old vertices, then those of edges, then those of faces. Triangles may become
/// four triangles instead.
fn split(
    surface: &Surface,
    vertex: impl Fn(usize) -> Vec<f64>,
    edge: impl Fn(usize, usize) -> Vec<f64>,
    triangles_too: bool,
) -> Refined {
    let n = surface.points.len();
    let edges = surface.edges();
    let number: Numbers = edges.iter().enumerate().map(|(i, &e)| (e, n + i)).collect();
    let middle_of = |p: usize, q: usize| number[&(p.min(q), p.max(q))];
    let mut masks: Vec<_> = (0..n).map(vertex).collect();
    masks.extend(edges.iter().map(|&(p, q)| edge(p, q)));
    let mut faces = Vec::new();
    for face in &surface.faces {
        let k = face.len();
        let middles: Vec<_> = (0..k).map(|i| middle_of(face[i], face[(i + 1) % k])).collect();
        if k == 3 && !triangles_too {
            faces.extend((0..3).map(|i| vec![face[i], middles[i], middles[(i + 2) % 3]]));
            faces.push(middles);
            continue;
        }
        let c = masks.len();
        masks.push(middle(n, face));
        faces.extend((0..k).map(|i| vec![face[i], middles[i], c, middles[(i + k - 1) % k]]));
    }
    Refined::of(masks, faces)
}

/// Catmull and Clark 1978, with boundary and creases as [`loop_`].
pub fn catmull_clark(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let beside = |p: usize, q: usize| middle(n, &surface.faces[surface.corner(p, q).unwrap().0]);
    let edge = |p: usize, q: usize| {
        creased_edge(surface, p, q, || {
            blend([(0.25, &one(n, p)), (0.25, &one(n, q)), (0.25, &beside(p, q)), (0.25, &beside(q, p))])
        })
    };
    // (Q + 2R + (k - 3)S)/k: the means of the face points and of the middles of the edges, and the vertex.
    let vertex = |v: usize| {
        creased_vertex(surface, v, || {
            let ring = surface.neighbours(v);
            let k = ring.len() as f64;
            let mut parts = vec![((k - 3.0) / k, one(n, v))];
            for q in ring {
                parts.push((1.0 / (k * k), beside(v, q)));
                parts.push((2.0 / (k * k), mask(n, [(v, 0.5), (q, 0.5)])));
            }
            blend(parts.iter().map(|(w, m)| (*w, m)))
        })
    };
    split(surface, vertex, edge, true)
}

/// Doo and Sabin 1978. What touches the boundary makes no face, or, with `chaikin`, the boundary is cut as a curve.
pub fn doo_sabin(surface: &Surface, chaikin: bool) -> Refined {
    let n = surface.points.len();
    let mut masks = Vec::new();
    let mut corner = Numbers::new(); // by p→q the one at p of the face on the left, or the boundary's point near p
    let mut faces = Vec::new();
    for face in &surface.faces {
        let k = face.len();
        faces.push((masks.len()..masks.len() + k).collect());
        for i in 0..k {
            corner.insert((face[i], face[(i + 1) % k]), masks.len());
            let weight = |j: usize| match j {
                0 => (k as f64 + 5.0) / (4.0 * k as f64),
                _ => (3.0 + 2.0 * (TAU * j as f64 / k as f64).cos()) / (4.0 * k as f64),
            };
            masks.push(mask(n, (0..k).map(|j| (face[(i + j) % k], weight(j)))));
        }
    }
    // The corner at q of the face left of p→q.
    let next = |corner: &Numbers, p: usize, q: usize| corner[&(q, surface.across(p, q).unwrap())];
    let mut border = Numbers::new(); // by (p, q) the boundary's point near p
    for (p, q) in surface.edges() {
        let (p, q) = if surface.corner(p, q).is_none() { (q, p) } else { (p, q) };
        if surface.corner(q, p).is_some() {
            let right = [next(&corner, q, p), corner[&(q, p)]];
            faces.push(vec![right[0], right[1], next(&corner, p, q), corner[&(p, q)]]);
        } else if chaikin {
            for (p, q) in [(p, q), (q, p)] {
                border.insert((p, q), masks.len());
                masks.push(mask(n, [(p, 0.75), (q, 0.25)]));
            }
            faces.push(vec![border[&(p, q)], border[&(q, p)], next(&corner, p, q), corner[&(p, q)]]);
        }
    }
    for v in 0..n {
        let mut ring = surface.neighbours(v);
        match surface.boundary(v) {
            None => faces.push(ring.into_iter().map(|q| corner[&(v, q)]).collect()),
            Some([first, last]) if chaikin => {
                ring.pop();
                let inner = ring.into_iter().map(|q| corner[&(v, q)]);
                faces.push([border[&(v, first)]].into_iter().chain(inner).chain([border[&(v, last)]]).collect());
            }
            Some(_) => {}
        }
    }
    Refined::of(masks, faces)
}

/// Stam and Loop 2003 with the weights η of Shiue, Alliez, Ursu and Kettner's tutorial; the boundary becomes cubic
/// B-splines, or stays.
pub fn quad_triangle(surface: &Surface, smooth_boundary: bool) -> Refined {
    let flat = |surface: &Surface| {
        let n = surface.points.len();
        split(surface, |v| one(n, v), |p, q| mask(n, [(p, 0.5), (q, 0.5)]), false)
    };
    compose(surface, &[&|surface| average(surface, smooth_boundary), &flat])
}

/// The smoothing half of [`quad_triangle`].
fn average(surface: &Surface, smooth_boundary: bool) -> Refined {
    let n = surface.points.len();
    let vertex = |v: usize| {
        match surface.boundary(v) {
            Some([a, b]) if smooth_boundary => return mask(n, [(a, 0.25), (v, 0.5), (b, 0.25)]),
            Some(_) => return one(n, v),
            None => {}
        }
        let ring = surface.neighbours(v);
        let quads: Vec<_> = ring
            .iter()
            .filter(|&&q| surface.faces[surface.corner(v, q).unwrap().0].len() == 4)
            .map(|&q| surface.across(v, q).unwrap())
            .collect();
        let alpha = 1.0 / (1.0 + ring.len() as f64 / 2.0 + quads.len() as f64 / 4.0);
        let weights = ring.iter().map(|&q| (q, alpha / 2.0)).chain(quads.iter().map(|&q| (q, alpha / 4.0)));
        let mean = mask(n, weights.chain([(v, alpha)]));
        let eta = match (ring.len(), quads.len()) {
            (2, 1) => -0.20505,
            (3, 1) => 0.80597,
            (3, 2) => 0.61539,
            (4, 1) => 0.34792,
            (4, 2) => 0.21380,
            (4, 3) => 0.10550,
            _ => 0.0,
        };
        blend([(1.0 + eta, &mean), (-eta, &one(n, v))])
    };
    Refined::of((0..n).map(vertex).collect(), surface.faces.clone())
}
