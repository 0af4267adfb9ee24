//! Conway's operators on polyhedra.

use super::{Numbers, Refined, mask, middle, one};
use crate::schemes::surface::Surface;

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
