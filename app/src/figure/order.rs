//! Faces from back to front, exactly.
//!
//! Faces that overlap in the picture are compared where they do: the overlap of two triangles is a convex polygon, and the
//! difference of their depths is linear on it, so its corners tell which one is nearer, or that they pierce each other.
//! That gives a graph of who has to be painted before whom. Its strongly connected components (R. Tarjan, "Depth-first
//! search and linear graph algorithms", 1972) are painted in order. Most are single faces, painted as one polygon; the
//! others, where faces pierce or hide each other in a circle, are cut along the planes of their triangles (H. Fuchs,
//! Z. Kedem, B. Naylor, "On visible surface generation by a priori tree structures", 1980).

use glam::{DVec2, DVec3, Vec3Swizzles};
use rayon::prelude::*;

use vv::stop::{Stop, Stopped};

use super::boxes::Boxes;
use super::surface::Triangle;

/// Depths nearer than this are the same.
const SAME: f64 = 1e-7;

/// Overlaps of less are none: a square a thousandth of a millimetre wide on a large page.
pub(super) const AREA: f64 = 1e-10;

/// Most pairs that are kept, and most pieces that faces are cut into.
const MOST_PAIRS: usize = 20_000_000;
const MOST_PIECES: usize = 400_000;

/// How many planes are tried before one is chosen to cut along.
const TRIES: usize = 6;

/// What is painted at once.
#[derive(Debug)]
pub(super) enum Painted {
    /// A face.
    Whole(u32),
    /// A piece of the triangle with this place in the list.
    Piece(Vec<DVec2>, u32),
}

/// The order, and whether some of it is only by distance, because an exact one would have too many pieces.
pub(super) struct Order {
    pub painted: Vec<Painted>,
    pub is_exact: bool,
}

/// Orders the faces of triangles; `faces` is how many there are. Faces that are not all in the list, or that hide parts of
/// themselves, are painted in pieces.
pub(super) fn order(triangles: &[Triangle], face_of: &[u32], broken: &[bool], stop: &Stop) -> Result<Order, Stopped> {
    let flat: Vec<bool> = triangles.iter().map(|t| area(&t.corners.map(DVec3::xy)).abs() > AREA).collect();
    let mut of_face: Vec<Vec<u32>> = vec![Vec::new(); broken.len()];
    for (number, &face) in (0..).zip(face_of) {
        if flat[number as usize] {
            of_face[face as usize].push(number);
        }
    }
    let Some(pairs) = pairs(triangles, face_of, &flat, stop)? else {
        return Ok(Order { painted: by_distance(triangles, &flat), is_exact: false });
    };
    let mut in_pieces = broken.to_vec();
    pairs.iter().filter(|(a, b)| a == b).for_each(|&(a, _)| in_pieces[a as usize] = true);
    let mut order = Order { painted: Vec::new(), is_exact: true };
    for component in components(broken.len(), &pairs).iter().rev() {
        stop.check()?;
        if let &[face] = &component[..]
            && (!in_pieces[face as usize] || of_face[face as usize].is_empty())
        {
            if !of_face[face as usize].is_empty() {
                order.painted.push(Painted::Whole(face));
            }
            continue;
        }
        let numbers = component.iter().flat_map(|&face| &of_face[face as usize]);
        let pieces = numbers.map(|&number| Piece { corners: triangles[number as usize].corners.to_vec(), number });
        cut(pieces.collect(), triangles, &mut order, stop)?;
    }
    Ok(order)
}

/// Which face has to be painted before which, in order and each pair once; a face and itself if it hides a part of
/// itself. `None` if there are too many.
fn pairs(
    triangles: &[Triangle],
    face_of: &[u32],
    flat: &[bool],
    stop: &Stop,
) -> Result<Option<Vec<(u32, u32)>>, Stopped> {
    const CHUNK: usize = 4096;
    let boxes = Boxes::new(&triangles.iter().map(|t| t.corners).collect::<Vec<_>>());
    let of_triangle = |a: usize| {
        let mut found = Vec::new();
        let t = &triangles[a].corners;
        let (low, high) = (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]));
        boxes.meeting(low.xy(), high.xy(), |b| {
            let b = b as usize;
            if a < b && flat[a] && flat[b] {
                let (nearer, farther) = compare(&triangles[a].corners, &triangles[b].corners);
                let (a, b) = (face_of[a], face_of[b]);
                found.extend(nearer.then_some((b, a)));
                found.extend(farther.then_some((a, b)));
            }
            found.len() <= MOST_PAIRS
        });
        found
    };
    let mut pairs: Vec<(u32, u32)> = Vec::new();
    for start in (0..triangles.len()).step_by(CHUNK) {
        stop.check()?;
        let end = (start + CHUNK).min(triangles.len());
        let found: Vec<_> = (start..end).into_par_iter().map(of_triangle).collect();
        pairs.extend(found.into_iter().flatten());
        if pairs.len() > MOST_PAIRS {
            return Ok(None);
        }
    }
    pairs.par_sort_unstable();
    pairs.dedup();
    Ok(Some(pairs))
}

/// Whether some of the first triangle is nearer to the eye than the second, where both are seen, and farther.
pub(super) fn compare(a: &[DVec3; 3], b: &[DVec3; 3]) -> (bool, bool) {
    let normal = (b[1] - b[0]).cross(b[2] - b[0]);
    let turn = normal.z.signum();
    let mut overlap = a.to_vec();
    let mut scratch = Vec::with_capacity(8);
    for i in 0..3 {
        let (p, q) = (b[i].xy(), b[(i + 1) % 3].xy());
        clip(&mut overlap, &mut scratch, |x: DVec3| (q - p).perp_dot(x.xy() - p) * turn);
    }
    let flat: Vec<DVec2> = overlap.iter().map(|p| p.xy()).collect();
    if area(&flat).abs() <= AREA {
        return (false, false);
    }
    let above = overlap.iter().map(|&p| normal.dot(p - b[0]) / normal.z);
    let (low, high) = above.fold((0.0f64, 0.0f64), |(low, high), d| (low.min(d), high.max(d)));
    (high > SAME, low < -SAME)
}

/// Leaves of a convex polygon what is positive.
fn clip(polygon: &mut Vec<DVec3>, scratch: &mut Vec<DVec3>, side: impl Fn(DVec3) -> f64) {
    scratch.clear();
    for (i, &p) in polygon.iter().enumerate() {
        let q = polygon[(i + 1) % polygon.len()];
        let (f, g) = (side(p), side(q));
        if f >= 0.0 {
            scratch.push(p);
        }
        if (f >= 0.0) != (g >= 0.0) {
            scratch.push(p + (q - p) * (f / (f - g)));
        }
    }
    std::mem::swap(polygon, scratch);
}

/// Twice the area of a polygon.
pub(super) fn area(points: &[DVec2]) -> f64 {
    let n = points.len();
    (2..n).map(|i| (points[i - 1] - points[0]).perp_dot(points[i] - points[0])).sum()
}

/// The strongly connected components, each after those that its edges lead to.
fn components(count: usize, edges: &[(u32, u32)]) -> Vec<Vec<u32>> {
    const NEW: u32 = u32::MAX;
    let first = |node: u32| edges.partition_point(|edge| edge.0 < node);
    let (mut index, mut low) = (vec![NEW; count], vec![0; count]);
    let mut on_stack = vec![false; count];
    let (mut stack, mut components) = (Vec::new(), Vec::new());
    let mut next = 0;
    let mut walk: Vec<(u32, usize)> = Vec::new();
    for root in (0..).take(count) {
        if index[root as usize] != NEW {
            continue;
        }
        walk.push((root, first(root)));
        while let Some(&mut (node, ref mut edge)) = walk.last_mut() {
            let i = node as usize;
            if index[i] == NEW {
                (index[i], low[i], on_stack[i]) = (next, next, true);
                next += 1;
                stack.push(node);
            }
            if let Some(&(_, to)) = edges.get(*edge).filter(|edge| edge.0 == node) {
                *edge += 1;
                if index[to as usize] == NEW {
                    walk.push((to, first(to)));
                } else if on_stack[to as usize] {
                    low[i] = low[i].min(index[to as usize]);
                }
                continue;
            }
            walk.pop();
            if let Some(&(before, _)) = walk.last() {
                low[before as usize] = low[before as usize].min(low[i]);
            }
            if low[i] == index[i] {
                let from = stack.iter().rposition(|&n| n == node).unwrap_or(0);
                let mut component = stack.split_off(from);
                component.iter().for_each(|&n| on_stack[n as usize] = false);
                component.sort_unstable();
                components.push(component);
            }
        }
    }
    components
}

/// A convex piece of a triangle.
#[derive(Debug, Clone)]
struct Piece {
    corners: Vec<DVec3>,
    number: u32,
}

enum Task {
    Cut(Vec<Piece>),
    Paint(Vec<Piece>),
}

/// Paints pieces, cut along the planes of their triangles: first what is behind one, then it, then what is before.
fn cut(pieces: Vec<Piece>, triangles: &[Triangle], order: &mut Order, stop: &Stop) -> Result<(), Stopped> {
    let mut budget = MOST_PIECES.saturating_sub(order.painted.len());
    let mut tasks = vec![Task::Cut(pieces)];
    while let Some(task) = tasks.pop() {
        stop.check()?;
        let pieces = match task {
            Task::Cut(pieces) if pieces.len() > 1 && budget > 0 => pieces,
            Task::Cut(mut pieces) | Task::Paint(mut pieces) => {
                if pieces.len() > 1 && budget == 0 {
                    order.is_exact = false;
                    pieces.sort_by(|a, b| middle(&a.corners).total_cmp(&middle(&b.corners)));
                }
                let painted = |p: Piece| Painted::Piece(p.corners.iter().map(|p| p.xy()).collect(), p.number);
                order.painted.extend(pieces.into_iter().map(painted));
                continue;
            }
        };
        let step = pieces.len().div_ceil(TRIES);
        let planes = pieces.iter().step_by(step).map(|piece| Plane::new(&triangles[piece.number as usize].corners));
        let cost = |plane: &Plane| {
            let sides = pieces.iter().map(|piece| plane.sides(&piece.corners));
            sides.fold([0usize; 3], |[cut, behind, before], (low, high)| match (low, high) {
                (true, true) => [cut + 1, behind, before],
                (true, false) => [cut, behind + 1, before],
                (false, true) => [cut, behind, before + 1],
                (false, false) => [cut, behind, before],
            })
        };
        let rated = planes.map(|plane| (cost(&plane), plane));
        let Some((_, plane)) = rated.min_by_key(|([cut, behind, before], _)| 4 * cut + behind.abs_diff(*before)) else {
            continue;
        };
        let (mut behind, mut within, mut before) = (Vec::new(), Vec::new(), Vec::new());
        for piece in pieces {
            match plane.sides(&piece.corners) {
                (true, true) => {
                    budget = budget.saturating_sub(1);
                    let (mut low, mut high, mut scratch) = (piece.corners.clone(), piece.corners, Vec::new());
                    clip(&mut low, &mut scratch, |p| -plane.above(p));
                    clip(&mut high, &mut scratch, |p| plane.above(p));
                    behind.push(Piece { corners: low, number: piece.number });
                    before.push(Piece { corners: high, number: piece.number });
                }
                (true, false) => behind.push(piece),
                (false, true) => before.push(piece),
                (false, false) => within.push(piece),
            }
        }
        // What has no piece in it would go on for ever.
        if within.is_empty() && (behind.is_empty() || before.is_empty()) {
            behind.append(&mut before);
            tasks.push(Task::Paint(behind));
            continue;
        }
        tasks.extend([Task::Cut(before), Task::Paint(within), Task::Cut(behind)]);
    }
    Ok(())
}

/// A plane with its normal towards the eye.
struct Plane {
    normal: DVec3,
    corner: DVec3,
}

impl Plane {
    fn new(&[a, b, c]: &[DVec3; 3]) -> Self {
        let normal = (b - a).cross(c - a).normalize_or(DVec3::Z);
        Self { normal: if normal.z < 0.0 { -normal } else { normal }, corner: a }
    }

    fn above(&self, p: DVec3) -> f64 {
        self.normal.dot(p - self.corner)
    }

    /// Whether some corner lies behind it, and some before it.
    fn sides(&self, corners: &[DVec3]) -> (bool, bool) {
        let above = || corners.iter().map(|&p| self.above(p));
        (above().any(|d| d < -SAME), above().any(|d| d > SAME))
    }
}

fn middle(corners: &[DVec3]) -> f64 {
    corners.iter().map(|p| p.z).sum::<f64>() / corners.len() as f64
}

fn by_distance(triangles: &[Triangle], flat: &[bool]) -> Vec<Painted> {
    let mut numbers: Vec<u32> = (0..).take(triangles.len()).filter(|&n| flat[n as usize]).collect();
    let depth = |n: &u32| middle(&triangles[*n as usize].corners);
    numbers.par_sort_by(|a, b| depth(a).total_cmp(&depth(b)).then(a.cmp(b)));
    let corners = |n: u32| triangles[n as usize].corners.map(DVec3::xy).to_vec();
    numbers.into_iter().map(|n| Painted::Piece(corners(n), n)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cutting_is_given_up_when_nobody_waits_for_it() {
        let triangle = |corners: [[f64; 3]; 3]| Piece { corners: corners.map(DVec3::from).to_vec(), number: 0 };
        let pieces = vec![triangle([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]); 2];
        let stop = Stop::new();
        stop.request(Stopped::ByUser);
        let mut order = Order { painted: Vec::new(), is_exact: true };
        assert_eq!(cut(pieces, &[], &mut order, &stop), Err(Stopped::ByUser));
        assert!(order.painted.is_empty());
    }
}
