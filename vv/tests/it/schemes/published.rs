//! Published rules as closed forms on polygons, written without a look at the programs that are compared with them.

mod curves;
mod operators;
mod polygons;

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::surface::Surface;

pub use curves::*;
pub use operators::*;
pub use polygons::*;

/// A refined mesh: its vertices as weights of the old ones, and how they hang together.
#[derive(Debug, Default, Clone)]
pub struct Refined {
    pub masks: Vec<Vec<f64>>,
    pub edges: BTreeSet<(usize, usize)>,
    pub faces: Vec<Vec<usize>>,
}

/// Weights of some vertices out of `n`; one may be named several times.
fn mask(n: usize, weights: impl IntoIterator<Item = (usize, f64)>) -> Vec<f64> {
    let mut mask = vec![0.0; n];
    weights.into_iter().for_each(|(v, w)| mask[v] += w);
    mask
}

/// A vertex itself.
fn one(n: usize, v: usize) -> Vec<f64> {
    mask(n, [(v, 1.0)])
}

/// The middle of some vertices.
fn middle(n: usize, face: &[usize]) -> Vec<f64> {
    mask(n, face.iter().map(|&v| (v, 1.0 / face.len() as f64)))
}

/// The sum of masks, each times a factor.
fn blend<'a>(parts: impl IntoIterator<Item = (f64, &'a Vec<f64>)>) -> Vec<f64> {
    let mut sum = Vec::new();
    for (factor, part) in parts {
        sum.resize(part.len(), 0.0);
        sum.iter_mut().zip(part).for_each(|(s, w)| *s += factor * w);
    }
    sum
}

/// Numbers by directed edge.
type Numbers = BTreeMap<(usize, usize), usize>;

impl Refined {
    fn of(masks: Vec<Vec<f64>>, faces: Vec<Vec<usize>>) -> Self {
        let pairs = |f: &Vec<usize>| (0..f.len()).map(|i| (f[i], f[(i + 1) % f.len()])).collect::<Vec<_>>();
        let edges = faces.iter().flat_map(pairs).map(|(p, q)| (p.min(q), p.max(q))).collect();
        Self { masks, edges, faces }
    }
}

/// One operator after the other, the last one written first.
pub fn compose(surface: &Surface, operators: &[&dyn Fn(&Surface) -> Refined]) -> Refined {
    let n = surface.points.len();
    let mut all =
        Refined { masks: (0..n).map(|v| one(n, v)).collect(), faces: surface.faces.clone(), ..Refined::default() };
    for operator in operators.iter().rev() {
        let next = operator(&Surface::new(vec![DVec3::ZERO; all.masks.len()], all.faces));
        let masks = next.masks.iter().map(|m| blend(m.iter().copied().zip(&all.masks))).collect();
        all = Refined { masks, ..next };
    }
    all
}

/// Each triangle becomes four: old vertices keep their numbers, those of edges follow.
fn quadrisect(
    surface: &Surface,
    vertex: impl Fn(usize) -> Vec<f64>,
    edge: impl Fn(usize, usize) -> Vec<f64>,
) -> Refined {
    let n = surface.points.len();
    let edges = surface.edges();
    let number: BTreeMap<_, _> = edges.iter().enumerate().map(|(i, &e)| (e, n + i)).collect();
    let middle = |p: usize, q: usize| number[&(p.min(q), p.max(q))];
    let mut masks: Vec<_> = (0..n).map(vertex).collect();
    masks.extend(edges.iter().map(|&(p, q)| edge(p, q)));
    let mut faces = Vec::new();
    for face in &surface.faces {
        let [a, b, c] = face[..] else { panic!("a triangle has three corners") };
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        faces.extend([vec![a, ab, ca], vec![ab, b, bc], vec![ca, bc, c], vec![ab, bc, ca]]);
    }
    Refined::of(masks, faces)
}

/// Semi-sharp creases and corners (DeRose, Kass and Truong 1998) in the form OpenSubdiv gives them ("uniform"): from the
/// masks of a smooth scheme to those of vertices and of edges. A boundary is a crease for ever, of cubic B-splines.
fn creased_vertex(surface: &Surface, v: usize, smooth: impl Fn() -> Vec<f64>) -> Vec<f64> {
    let n = surface.points.len();
    let ring = surface.neighbours(v);
    let corner = surface.sharp_vertices.get(&v).copied().unwrap_or(0.0);
    let rule = |age: f64| {
        let sharp: Vec<_> = ring.iter().copied().filter(|&q| sharpness(surface, v, q) > age).collect();
        match sharp[..] {
            _ if corner > age => one(n, v),
            [] | [_] => smooth(),
            [a, b] => mask(n, [(v, 6.0 / 8.0), (a, 1.0 / 8.0), (b, 1.0 / 8.0)]),
            _ => one(n, v),
        }
    };
    let all = ring.iter().map(|&q| sharpness(surface, v, q)).chain([corner]);
    let ending: Vec<_> = all.filter(|&s| s > 0.0 && s <= 1.0).collect();
    let t = if ending.is_empty() { 1.0 } else { ending.iter().sum::<f64>() / ending.len() as f64 };
    blend([(t, &rule(0.0)), (1.0 - t, &rule(1.0))])
}

fn creased_edge(surface: &Surface, p: usize, q: usize, smooth: impl Fn() -> Vec<f64>) -> Vec<f64> {
    let s = sharpness(surface, p, q).min(1.0);
    let crease = mask(surface.points.len(), [(p, 1.0 / 2.0), (q, 1.0 / 2.0)]);
    if s == 1.0 { crease } else { blend([(s, &crease), (1.0 - s, &smooth())]) }
}

fn sharpness(surface: &Surface, p: usize, q: usize) -> f64 {
    if surface.is_boundary_edge(p, q) {
        return f64::INFINITY;
    }
    surface.sharpness.get(&(p.min(q), p.max(q))).copied().unwrap_or(0.0)
}

/// Loop 1987. With `c1` boundary vertices of k triangles get Biermann, Levin and Zorin's 3/4 - γ and
/// γ = 1/2 - cos(π/k)/4 on their inner edges.
pub fn loop_(surface: &Surface, c1: bool) -> Refined {
    let n = surface.points.len();
    let vertex = |v: usize| {
        creased_vertex(surface, v, || {
            let ring = surface.neighbours(v);
            let valence = ring.len() as f64;
            let c = 3.0 / 8.0 + (TAU / valence).cos() / 4.0;
            let w = (5.0 / 8.0 - c * c) / valence;
            mask(n, ring.iter().map(|&q| (q, w)).chain([(v, 1.0 - valence * w)]))
        })
    };
    let excess = |v: usize| match surface.boundary(v) {
        Some(_) if c1 => 1.0 / 8.0 - (PI / (surface.neighbours(v).len() - 1) as f64).cos() / 4.0,
        _ => 0.0,
    };
    let edge = |p: usize, q: usize| {
        creased_edge(surface, p, q, || {
            let (a, b) = (surface.across(p, q).unwrap(), surface.across(q, p).unwrap());
            let (i, j) = (excess(p), excess(q));
            mask(n, [(p, 3.0 / 8.0 - i + j), (q, 3.0 / 8.0 + i - j), (a, 1.0 / 8.0), (b, 1.0 / 8.0)])
        })
    };
    quadrisect(surface, vertex, edge)
}

/// The butterfly of Dyn, Levin and Gregory 1990, on irregular meshes as modified by Zorin, Schröder and Sweldens 1996,
/// at boundaries as OpenMesh does.
pub fn butterfly(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let irregular = |v: usize| surface.boundary(v).is_none() && surface.neighbours(v).len() != 6;
    let fan = |p: usize, q: usize| {
        let mut ring = surface.neighbours(p);
        let first = ring.iter().position(|&x| x == q).unwrap();
        ring.rotate_left(first);
        let k = ring.len();
        let weights: Vec<f64> = match k {
            3 => vec![5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0],
            4 => vec![3.0 / 8.0, 0.0, -1.0 / 8.0, 0.0],
            _ => {
                let angle = |j: usize| TAU * j as f64 / k as f64;
                (0..k).map(|j| (0.25 + angle(j).cos() + 0.5 * (2.0 * angle(j)).cos()) / k as f64).collect()
            }
        };
        mask(n, ring.into_iter().zip(weights).chain([(p, 0.75)]))
    };
    let edge = |p: usize, q: usize| match (surface.across(p, q), surface.across(q, p)) {
        (Some(a), Some(b)) if !irregular(p) && !irregular(q) => {
            let mut weights = vec![(p, 0.5), (q, 0.5), (a, 0.125), (b, 0.125)];
            // The edge from x to y of a triangle whose third corner is z.
            for (x, y, z) in [(a, p, q), (q, a, p), (p, b, q), (b, q, p)] {
                match surface.across(y, x) {
                    Some(wing) => weights.push((wing, -0.0625)),
                    None => weights.extend([(x, -0.0625), (y, -0.0625), (z, 0.0625)]),
                }
            }
            mask(n, weights)
        }
        (Some(_), Some(_)) => {
            let fans: Vec<_> = [(p, q), (q, p)].into_iter().filter(|&(p, _)| irregular(p)).collect();
            let masks: Vec<_> = fans.iter().map(|&(p, q)| fan(p, q)).collect();
            blend(masks.iter().map(|m| (1.0 / masks.len() as f64, m)))
        }
        _ => {
            let beyond = |p: usize, q: usize| surface.boundary(p).unwrap().into_iter().find(|&x| x != q).unwrap();
            let outer = [(beyond(p, q), -1.0 / 16.0), (beyond(q, p), -1.0 / 16.0)];
            mask(n, [(p, 9.0 / 16.0), (q, 9.0 / 16.0)].into_iter().chain(outer))
        }
    };
    quadrisect(surface, |v| mask(n, [(v, 1.0)]), edge)
}

/// Kobbelt's √3 (2000); `odd` steps trisect the boundary.
pub fn sqrt3(surface: &Surface, odd: bool) -> Refined {
    let n = surface.points.len();
    let vertex = |v: usize| match surface.boundary(v) {
        None => {
            let ring = surface.neighbours(v);
            let alpha = (4.0 - 2.0 * (TAU / ring.len() as f64).cos()) / 9.0;
            let w = alpha / ring.len() as f64;
            mask(n, ring.into_iter().map(|q| (q, w)).chain([(v, 1.0 - alpha)]))
        }
        Some([a, b]) if odd => mask(n, [(a, 4.0 / 27.0), (v, 19.0 / 27.0), (b, 4.0 / 27.0)]),
        Some(_) => mask(n, [(v, 1.0)]),
    };
    let mut masks: Vec<_> = (0..n).map(vertex).collect();
    let mut faces = Vec::new();
    // What lies left of p→q once its triangle is divided: one vertex, or on a trisected edge the one next to p.
    let mut inner = BTreeMap::new();
    for face in &surface.faces {
        let boundary = (0..3).find(|&i| surface.is_boundary_edge(face[i], face[(i + 1) % 3]));
        match boundary {
            Some(i) if odd => {
                let [p, q, c] = [0, 1, 2].map(|j| face[(i + j) % 3]);
                let [before, after] =
                    [(p, q), (q, p)].map(|(p, q)| surface.boundary(p).unwrap().into_iter().find(|&x| x != q).unwrap());
                let [x, y] = [masks.len(), masks.len() + 1];
                masks.push(mask(n, [(before, 1.0 / 27.0), (p, 16.0 / 27.0), (q, 10.0 / 27.0)]));
                masks.push(mask(n, [(after, 1.0 / 27.0), (q, 16.0 / 27.0), (p, 10.0 / 27.0)]));
                faces.push(vec![x, y, c]);
                inner.insert((q, c), y);
                inner.insert((c, p), x);
            }
            _ => {
                let c = masks.len();
                masks.push(mask(n, face.iter().map(|&v| (v, 1.0 / 3.0))));
                for i in 0..3 {
                    inner.insert((face[i], face[(i + 1) % 3]), c);
                }
            }
        }
    }
    for (&(p, q), &c) in &inner {
        match inner.get(&(q, p)) {
            Some(&d) => faces.push(vec![p, d, c]), // the edge was flipped: p, q became c, d
            None => faces.push(vec![p, q, c]),
        }
    }
    Refined::of(masks, faces)
}

/// Limit positions of Loop's scheme; the boundary's of the cubic B-spline.
pub fn loop_limit(surface: &Surface) -> Refined {
    limit(surface, |ring| {
        let n = ring.len() as f64;
        let c = 3.0 / 8.0 + (TAU / n).cos() / 4.0;
        let beta = (5.0 / 8.0 - c * c) / n;
        let w = 1.0 / (n + 3.0 / (8.0 * beta));
        ring.iter().map(|&(q, _)| (q, w)).collect()
    })
}

/// Limit positions of Catmull and Clark's scheme on quads.
pub fn catmull_clark_limit(surface: &Surface) -> Refined {
    limit(surface, |ring| {
        let n = ring.len() as f64;
        let w = 1.0 / (n * (n + 5.0));
        ring.iter().flat_map(|&(q, across)| [(q, 4.0 * w), (across, w)]).collect()
    })
}

/// `inner` gives the weights around an inner vertex from its neighbours, each with what follows it in the face left of
/// the edge there.
fn limit(surface: &Surface, inner: impl Fn(&[(usize, usize)]) -> Vec<(usize, f64)>) -> Refined {
    let n = surface.points.len();
    let vertex = |v: usize| match surface.boundary(v) {
        Some([a, b]) => mask(n, [(a, 1.0 / 6.0), (v, 4.0 / 6.0), (b, 1.0 / 6.0)]),
        None => {
            let ring: Vec<_> = surface.neighbours(v).into_iter().map(|q| (q, surface.across(v, q).unwrap())).collect();
            let weights = inner(&ring);
            let rest = 1.0 - weights.iter().map(|(_, w)| w).sum::<f64>();
            mask(n, weights.into_iter().chain([(v, rest)]))
        }
    };
    Refined::of((0..n).map(vertex).collect(), surface.faces.clone())
}

/// One step of smoothing by the umbrella operator, along the boundary where there is one.
pub fn laplace(surface: &Surface, lambda: f64) -> Refined {
    let n = surface.points.len();
    let vertex = |v: usize| {
        let ring = surface.boundary(v).map_or_else(|| surface.neighbours(v), Vec::from);
        let w = lambda / ring.len() as f64;
        mask(n, ring.into_iter().map(|q| (q, w)).chain([(v, 1.0 - lambda)]))
    };
    Refined::of((0..n).map(vertex).collect(), surface.faces.clone())
}
