//! Published rules as closed forms on polygons, written without a look at the programs that are compared with them.

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::surface::Surface;

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

/// The sum of masks, each times a factor.
fn blend<'a>(parts: impl IntoIterator<Item = (f64, &'a Vec<f64>)>) -> Vec<f64> {
    let mut sum = Vec::new();
    for (factor, part) in parts {
        sum.resize(part.len(), 0.0);
        sum.iter_mut().zip(part).for_each(|(s, w)| *s += factor * w);
    }
    sum
}

impl Refined {
    fn of(masks: Vec<Vec<f64>>, faces: Vec<Vec<usize>>) -> Self {
        let pairs = |f: &Vec<usize>| (0..f.len()).map(|i| (f[i], f[(i + 1) % f.len()])).collect::<Vec<_>>();
        let edges = faces.iter().flat_map(pairs).map(|(p, q)| (p.min(q), p.max(q))).collect();
        Self { masks, edges, faces }
    }
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

/// Midedge (Peters and Reif 1997): the ambo of the mesh, without faces of boundary vertices.
pub fn midedge(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let edges = surface.edges();
    let number: BTreeMap<_, _> = edges.iter().enumerate().map(|(i, &e)| (e, i)).collect();
    let middle = |p: usize, q: usize| number[&(p.min(q), p.max(q))];
    let masks = edges.iter().map(|&(p, q)| mask(n, [(p, 0.5), (q, 0.5)])).collect();
    let around = |f: &Vec<usize>| (0..f.len()).map(|i| middle(f[i], f[(i + 1) % f.len()])).collect();
    let mut faces: Vec<Vec<usize>> = surface.faces.iter().map(around).collect();
    let inner = (0..n).filter(|&v| surface.boundary(v).is_none());
    faces.extend(inner.map(|v| surface.neighbours(v).into_iter().map(|q| middle(v, q)).collect()));
    Refined::of(masks, faces)
}

/// Each n-gon becomes n quads: old vertices keep their numbers, those of edges and of faces follow. `edge` and `vertex`
/// get the masks of the faces.
fn quadrangulate(
    surface: &Surface,
    vertex: impl Fn(usize, &[Vec<f64>]) -> Vec<f64>,
    edge: impl Fn(usize, usize, &[Vec<f64>]) -> Vec<f64>,
) -> Refined {
    let n = surface.points.len();
    let centers: Vec<_> = surface.faces.iter().map(|f| mean(n, f)).collect();
    let edges = surface.edges();
    let number: BTreeMap<_, _> = edges.iter().enumerate().map(|(i, &e)| (e, n + i)).collect();
    let middle = |p: usize, q: usize| number[&(p.min(q), p.max(q))];
    let mut masks: Vec<_> = (0..n).map(|v| vertex(v, &centers)).collect();
    masks.extend(edges.iter().map(|&(p, q)| edge(p, q, &centers)));
    let mut faces = Vec::new();
    for (f, face) in surface.faces.iter().enumerate() {
        for i in 0..face.len() {
            let [before, p, after] = [face.len() - 1, 0, 1].map(|k| face[(i + k) % face.len()]);
            faces.push(vec![p, middle(p, after), masks.len() + f, middle(p, before)]);
        }
    }
    masks.extend(centers);
    Refined::of(masks, faces)
}

fn mean(n: usize, of: &[usize]) -> Vec<f64> {
    mask(n, of.iter().map(|&v| (v, 1.0 / of.len() as f64)))
}

/// Catmull and Clark 1978, with the boundary of the cubic B-spline and semi-sharp creases and corners as for
/// [`loop_`]; vertices of `corners` are infinitely sharp.
pub fn catmull_clark(surface: &Surface, corners: &[usize]) -> Refined {
    let n = surface.points.len();
    let sharpness = |p: usize, q: usize| {
        if surface.is_boundary_edge(p, q) {
            return f64::INFINITY;
        }
        surface.sharpness.get(&(p.min(q), p.max(q))).copied().unwrap_or(0.0)
    };
    let around = |v: usize| surface.neighbours(v).into_iter().filter_map(move |q| surface.corner(v, q)).map(|(f, _)| f);
    let rule = |v: usize, age: f64, centers: &[Vec<f64>]| {
        let ring = surface.neighbours(v);
        let sharp: Vec<_> = ring.iter().copied().filter(|&q| sharpness(v, q) > age).collect();
        match sharp[..] {
            _ if corners.contains(&v) => mask(n, [(v, 1.0)]),
            [] | [_] => {
                let valence = ring.len() as f64;
                let middles: Vec<_> = ring.iter().map(|&q| mask(n, [(v, 0.5), (q, 0.5)])).collect();
                let q = blend(around(v).map(|f| (1.0 / valence, &centers[f])));
                let r = blend(middles.iter().map(|m| (1.0 / valence, m)));
                let s = mask(n, [(v, 1.0)]);
                blend([(1.0 / valence, &q), (2.0 / valence, &r), ((valence - 3.0) / valence, &s)])
            }
            [a, b] => mask(n, [(v, 6.0 / 8.0), (a, 1.0 / 8.0), (b, 1.0 / 8.0)]),
            _ => mask(n, [(v, 1.0)]),
        }
    };
    let vertex = |v: usize, centers: &[Vec<f64>]| {
        let ring = surface.neighbours(v);
        let ending: Vec<_> = ring.iter().map(|&q| sharpness(v, q)).filter(|&s| s > 0.0 && s <= 1.0).collect();
        let t = if ending.is_empty() { 1.0 } else { ending.iter().sum::<f64>() / ending.len() as f64 };
        blend([(t, &rule(v, 0.0, centers)), (1.0 - t, &rule(v, 1.0, centers))])
    };
    let edge = |p: usize, q: usize, centers: &[Vec<f64>]| {
        let s = sharpness(p, q).min(1.0);
        let crease = mask(n, [(p, 1.0 / 2.0), (q, 1.0 / 2.0)]);
        if s == 1.0 {
            return crease;
        }
        let [(f, _), (g, _)] = [surface.corner(p, q).unwrap(), surface.corner(q, p).unwrap()];
        let smooth = blend([(0.5, &crease), (0.25, &centers[f]), (0.25, &centers[g])]);
        blend([(s, &crease), (1.0 - s, &smooth)])
    };
    quadrangulate(surface, vertex, edge)
}

/// Doo and Sabin 1978; the border is left out, or cut as Chaikin does it.
pub fn doo_sabin(surface: &Surface, chaikin: bool) -> Refined {
    let n = surface.points.len();
    let mut masks = Vec::new();
    let mut faces = Vec::new();
    let mut number = BTreeMap::new(); // of the corner at p of the face left of p→q
    let next = |face: &[usize], i: usize| face[(i + 1) % face.len()];
    for face in &surface.faces {
        let size = face.len() as f64;
        let weight = |k: usize| match k {
            0 => (size + 5.0) / (4.0 * size),
            _ => (3.0 + 2.0 * (TAU * k as f64 / size).cos()) / (4.0 * size),
        };
        for (i, &p) in face.iter().enumerate() {
            number.insert((p, next(face, i)), masks.len());
            masks.push(mask(n, (0..face.len()).map(|k| (face[(i + k) % face.len()], weight(k)))));
        }
        faces.push((0..face.len()).map(|i| number[&(face[i], next(face, i))]).collect());
    }
    // The corner at q of the face left of p→q.
    let behind = |p: usize, q: usize| Some((q, surface.across(p, q)?));
    let mut cut = BTreeMap::new(); // of the new vertex near p on the border edge p–q
    for (p, q) in surface.edges().into_iter().flat_map(|(p, q)| [(p, q), (q, p)]) {
        let hole = surface.corner(p, q).is_none();
        if p > q && !hole && surface.corner(q, p).is_some() {
            continue; // an inner edge, done the other way
        }
        let Some(right) = behind(q, p).map(|c| [number[&c], number[&(q, p)]]) else { continue };
        let left = if hole {
            if !chaikin {
                continue;
            }
            for (p, q) in [(q, p), (p, q)] {
                cut.insert((p, q), masks.len());
                masks.push(mask(n, [(p, 0.75), (q, 0.25)]));
            }
            [cut[&(q, p)], cut[&(p, q)]]
        } else {
            [number[&behind(p, q).unwrap()], number[&(p, q)]]
        };
        faces.push(right.into_iter().chain(left).collect());
    }
    for v in 0..n {
        let ring = surface.neighbours(v);
        let corners = ring.iter().filter_map(|&q| number.get(&(v, q)).copied());
        match surface.boundary(v) {
            None => faces.push(corners.collect()),
            Some([first, last]) if chaikin => {
                let [first, last] = [first, last].map(|q| cut[&(v, q)]);
                faces.push(std::iter::once(first).chain(corners).chain([last]).collect());
            }
            Some(_) => {}
        }
    }
    Refined::of(masks, faces)
}

/// Stam and Loop 2003, with the weights η of Shiue, Alliez, Ursu and Kettner's tutorial.
pub fn quad_triangle(surface: &Surface, smooth_boundary: bool) -> Refined {
    let n = surface.points.len();
    let corner = |v: usize| mask(n, [(v, 1.0)]);
    let mut split = quadrangulate(surface, |v, _| corner(v), |p, q, _| mask(n, [(p, 0.5), (q, 0.5)]));
    // Middles of triangles go, and their three quads become four triangles.
    let first = n + surface.edges().len();
    let mut kept = (0..first).collect::<Vec<_>>();
    let mut faces = Vec::new();
    let mut at = 0;
    for (f, face) in surface.faces.iter().enumerate() {
        let quads = &split.faces[at..at + face.len()];
        at += face.len();
        if face.len() == 3 {
            faces.extend(quads.iter().map(|q| vec![q[0], q[1], q[3]]));
            faces.push(quads.iter().map(|q| q[1]).collect());
        } else {
            faces.extend(quads.iter().map(|q| vec![q[0], q[1], kept.len(), q[3]]));
            kept.push(first + f);
        }
    }
    split.masks = kept.into_iter().map(|v| split.masks[v].clone()).collect();
    let flat = Surface::new(vec![DVec3::ZERO; split.masks.len()], faces.clone());
    let mean = |weights: Vec<(usize, f64)>| {
        let sum: f64 = weights.iter().map(|(_, w)| w).sum();
        blend(weights.iter().map(|&(v, w)| (w / sum, &split.masks[v])))
    };
    let vertex = |v: usize| match flat.boundary(v) {
        Some([a, b]) if smooth_boundary => mean(vec![(a, 1.0), (v, 2.0), (b, 1.0)]),
        Some(_) => split.masks[v].clone(),
        None => {
            let ring = flat.neighbours(v);
            let quads: Vec<_> = ring.iter().filter(|&&q| flat.faces[flat.corner(v, q).unwrap().0].len() == 4).collect();
            let across = quads.iter().map(|&&q| (flat.across(v, q).unwrap(), 0.25));
            let smooth = mean(ring.iter().map(|&q| (q, 0.5)).chain([(v, 1.0)]).chain(across).collect());
            let eta = match (ring.len(), quads.len()) {
                (2, 1) => -0.20505,
                (3, 1) => 0.80597,
                (3, 2) => 0.61539,
                (4, 1) => 0.34792,
                (4, 2) => 0.21380,
                (4, 3) => 0.10550,
                _ => 0.0,
            };
            blend([(1.0 + eta, &smooth), (-eta, &split.masks[v])])
        }
    };
    Refined::of((0..split.masks.len()).map(vertex).collect(), faces)
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

/// The middles of the faces as vertices, a face for each inner vertex, and for each inner edge an edge.
pub fn dual(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let masks = surface.faces.iter().map(|f| middle(n, f)).collect();
    let around = |v: usize| surface.neighbours(v).into_iter().map(|q| surface.corner(v, q).unwrap().0).collect();
    let faces = (0..n).filter(|&v| surface.boundary(v).is_none()).map(around).collect();
    let mut refined = Refined::of(masks, faces);
    for (p, q) in surface.edges() {
        if let (Some((f, _)), Some((g, _))) = (surface.corner(p, q), surface.corner(q, p)) {
            refined.edges.insert((f.min(g), f.max(g)));
        }
    }
    refined
}

fn middle(n: usize, face: &[usize]) -> Vec<f64> {
    mask(n, face.iter().map(|&v| (v, 1.0 / face.len() as f64)))
}

fn one(n: usize, v: usize) -> Vec<f64> {
    mask(n, [(v, 1.0)])
}

/// A pyramid on each face.
pub fn kis(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let mut masks: Vec<_> = (0..n).map(|v| one(n, v)).collect();
    let mut faces = Vec::new();
    for face in &surface.faces {
        let c = masks.len();
        masks.push(middle(n, face));
        faces.extend((0..face.len()).map(|i| vec![face[i], face[(i + 1) % face.len()], c]));
    }
    Refined::of(masks, faces)
}

/// Numbers by directed edge.
type Numbers = BTreeMap<(usize, usize), usize>;

/// Two points on each edge, by (p, q) the one near p; numbers begin at `first`.
fn thirds(surface: &Surface, first: usize) -> (Numbers, Vec<Vec<f64>>) {
    let n = surface.points.len();
    let both = surface.edges().into_iter().flat_map(|(p, q)| [(p, q), (q, p)]);
    let number: Numbers = both.enumerate().map(|(i, e)| (e, first + i)).collect();
    let mut masks = vec![Vec::new(); number.len()];
    for (&(p, q), &x) in &number {
        masks[x - first] = mask(n, [(p, 2.0 / 3.0), (q, 1.0 / 3.0)]);
    }
    (number, masks)
}

/// Corners cut off at the thirds of the edges; the cut makes no face at the boundary.
pub fn truncate(surface: &Surface) -> Refined {
    let (number, masks) = thirds(surface, 0);
    let pair = |f: &[usize], i: usize| (f[i], f[(i + 1) % f.len()]);
    let cut = |f: &Vec<usize>| {
        (0..f.len()).map(|i| pair(f, i)).flat_map(|(p, q)| [number[&(p, q)], number[&(q, p)]]).collect()
    };
    let mut faces: Vec<Vec<usize>> = surface.faces.iter().map(cut).collect();
    let inner = (0..surface.points.len()).filter(|&v| surface.boundary(v).is_none());
    faces.extend(inner.map(|v| surface.neighbours(v).into_iter().map(|q| number[&(v, q)]).collect()));
    Refined::of(masks, faces)
}

/// A pentagon for each corner, between the middle of the face and the first thirds of the edges as one walks round it
/// counter-clockwise.
pub fn gyro(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let (number, edge_masks) = thirds(surface, n);
    let mut masks: Vec<_> = (0..n).map(|v| one(n, v)).chain(edge_masks).collect();
    let mut faces = Vec::new();
    for face in &surface.faces {
        let c = masks.len();
        masks.push(middle(n, face));
        for i in 0..face.len() {
            let [p, q, r] = [0, 1, 2].map(|j| face[(i + j) % face.len()]);
            faces.push(vec![c, number[&(p, q)], number[&(q, p)], q, number[&(q, r)]]);
        }
    }
    Refined::of(masks, faces)
}

/// One operator after the other, the last one written first.
pub fn compose(surface: &Surface, operators: &[fn(&Surface) -> Refined]) -> Refined {
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

/// Stam and Loop 2003 with the second averaging of Shiue, Alliez, Ursu and Kettner's tutorial; at the boundary cubic
/// B-splines.
pub fn quad_triangle(surface: &Surface) -> Refined {
    compose(
        surface,
        &[quad_triangle_average, |surface| {
            let n = surface.points.len();
            split(surface, |v| one(n, v), |p, q| mask(n, [(p, 0.5), (q, 0.5)]), false)
        }],
    )
}

fn quad_triangle_average(surface: &Surface) -> Refined {
    let n = surface.points.len();
    let vertex = |v: usize| {
        if let Some([a, b]) = surface.boundary(v) {
            return mask(n, [(a, 0.25), (v, 0.5), (b, 0.25)]);
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
