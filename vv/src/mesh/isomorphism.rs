//! Whether two meshes are the same but for the numbers of their vertices.
//!
//! An isomorphism of rotation systems takes neighbours to neighbours and rings to rings, each up to where it begins, gaps
//! included, and so faces to faces. In a connected mesh it is known as soon as one vertex and one of its neighbours are:
//! the rest follows from ring to ring. What remains is to try where one vertex goes. Positions say it at once if they
//! agree; if they do not, every vertex that looks alike is tried.

use std::collections::HashMap;
use std::collections::VecDeque;

use super::{Mesh, Vertex};
use crate::stop::{Stop, Stopped};

/// How often a component is laid upon others in all its ways, when positions do not tell where it belongs.
const MOST_LAID: usize = 256;

/// Which vertex is which.
#[derive(Debug, Clone, PartialEq)]
pub struct Isomorphism {
    /// By the index of a vertex of the first mesh, that of the second; `None` for those outside its set.
    pub images: Vec<Option<Vertex>>,
    /// The vertex of the first mesh that is farthest from its image, and how far; `None` without vertices. NaN counts as
    /// farthest of all, but as where it should be if its image has the same bits.
    pub farthest: Option<(Vertex, f64)>,
}

/// Finds an isomorphism of the sets of two valid meshes (a neighbour has one back): one that takes every vertex no
/// farther than `tolerance`, if there is one, else, of those that were tried, the nearest for each component. `mirrored`
/// takes rings to rings walked the other way round, as a mirror does.
///
/// `None` if there is none. Of a component that does not lie where its image does, with very many symmetries, only some
/// are tried, the nearest first.
///
/// Cost: O(n log n) where positions agree and few vertices share a place; else up to O(n²) for each component.
///
/// # Errors
/// When stopped.
pub fn isomorphism(
    a: &Mesh,
    b: &Mesh,
    tolerance: f64,
    mirrored: bool,
    stop: &Stop,
) -> Result<Option<Isomorphism>, Stopped> {
    if a.set.len() != b.set.len() {
        return Ok(None);
    }
    let mut search = Search {
        a,
        b,
        tolerance,
        mirrored,
        stop,
        images: vec![None; a.vertex_count()],
        taken: vec![false; b.vertex_count()],
        offsets: vec![0; a.vertex_count()],
        farthest: None,
    };
    let components = Components::new(a);
    // First those that lie where they belong, so that no other takes their place.
    // What is no number is at home nowhere; where it stood in this order would depend on its sign.
    let mut by_x: Vec<Vertex> = b.set.iter().filter(|v| !b.position(*v).x.is_nan()).collect();
    by_x.sort_by(|p, q| b.position(*p).x.total_cmp(&b.position(*q).x));
    let mut homeless = Vec::new();
    for (i, members) in components.members.iter().enumerate() {
        if !search.place_at_home(members, &by_x)? {
            homeless.push(i);
        }
    }
    if homeless.is_empty() {
        return Ok(Some(search.finish()));
    }
    let others = Components::new(b);
    for i in homeless {
        if !search.place_anywhere(&components.members[i], &others)? {
            return Ok(None);
        }
    }
    Ok(Some(search.finish()))
}

struct Search<'m> {
    a: &'m Mesh,
    b: &'m Mesh,
    tolerance: f64,
    mirrored: bool,
    stop: &'m Stop,
    images: Vec<Option<Vertex>>,
    /// Vertices of `b` that are images.
    taken: Vec<bool>,
    /// Where in the ring of its image the first slot of each vertex lies.
    offsets: Vec<usize>,
    farthest: Option<(Vertex, f64)>,
}

impl Search<'_> {
    fn finish(self) -> Isomorphism {
        Isomorphism { images: self.images, farthest: self.farthest }
    }

    /// Places a component where its vertices lie already.
    fn place_at_home(&mut self, members: &[Vertex], by_x: &[Vertex]) -> Result<bool, Stopped> {
        let root = rarest(self.a, members);
        let x = self.a.position(root).x;
        // A little more than the tolerance, which is exact.
        let reach = self.tolerance * (1.0 + 1e-9);
        let first = by_x.partition_point(|v| self.b.position(*v).x < x - reach);
        let last = by_x.partition_point(|v| self.b.position(*v).x <= x + reach);
        for &image in by_x.get(first..last).unwrap_or_default() {
            let is_near = self.distance(root, image) <= self.tolerance;
            if !is_near || !self.looks_alike(root, image) {
                continue;
            }
            for offset in 0..self.a.ring(root).slots().len().max(1) {
                if let Some((placed, farthest)) = self.lay(root, image, offset, self.tolerance)? {
                    self.keep(&placed, farthest);
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Places a component wherever it fits best.
    fn place_anywhere(&mut self, members: &[Vertex], others: &Components) -> Result<bool, Stopped> {
        let root = rarest(self.a, members);
        let mut candidates: Vec<Vertex> = Vec::new();
        for other in &others.members {
            let free = other.first().is_some_and(|v| !self.taken[v.index()]);
            if free && other.len() == members.len() {
                candidates.extend(other.iter().filter(|v| self.looks_alike(root, **v)));
            }
        }
        candidates.sort_by(|p, q| self.distance(root, *p).total_cmp(&self.distance(root, *q)));
        let mut best: Option<Laid> = None;
        let mut laid = 0;
        'tries: for image in candidates {
            for offset in 0..self.a.ring(root).slots().len().max(1) {
                let limit = best.as_ref().map_or(f64::INFINITY, |(_, (_, distance))| *distance);
                if let Some((placed, farthest)) = self.lay(root, image, offset, limit)? {
                    if best.is_none() || farthest.1 < limit {
                        best = Some((placed, farthest));
                    }
                    laid += 1;
                    if laid >= MOST_LAID {
                        break 'tries;
                    }
                }
            }
        }
        let Some((placed, farthest)) = best else { return Ok(false) };
        self.keep(&placed, farthest);
        Ok(true)
    }

    fn keep(&mut self, placed: &[(Vertex, Vertex)], farthest: (Vertex, f64)) {
        for &(p, image) in placed {
            self.images[p.index()] = Some(image);
            self.taken[image.index()] = true;
        }
        if self.farthest.is_none_or(|(_, distance)| farthest.1.total_cmp(&distance).is_gt()) {
            self.farthest = Some(farthest);
        }
    }

    /// Lays the component of `root` on the other mesh, `root` on `image` and its first slot on that at `offset`. Returns
    /// which vertex came to lie where and the farthest of them, if rings are rings and none is farther than `limit`.
    /// Leaves nothing behind.
    fn lay(&mut self, root: Vertex, image: Vertex, offset: usize, limit: f64) -> Result<Option<Laid>, Stopped> {
        self.stop.check()?;
        let mut placed = vec![(root, image)];
        let mut queue = VecDeque::from([root]);
        self.put(root, image, offset);
        let mut fits = true;
        let mut farthest = (root, self.distance(root, image));
        'walk: while let Some(p) = queue.pop_front() {
            let (from, to) = (self.a.ring(p).slots(), self.images[p.index()].map(|v| self.b.ring(v).slots()));
            let Some(to) = to.filter(|to| to.len() == from.len()) else {
                fits = false;
                break;
            };
            for (i, q) in from.iter().enumerate() {
                let there = to[self.slot(self.offsets[p.index()], i, from.len())];
                match (*q, there) {
                    (None, None) => {}
                    (Some(q), Some(there)) => match self.images[q.index()] {
                        Some(known) if known == there => {}
                        None if !self.taken[there.index()] => {
                            let back = self.a.ring(q).find(Some(p));
                            let back_there = self.b.ring(there).find(self.images[p.index()]);
                            let lengths = (self.a.ring(q).slots().len(), self.b.ring(there).slots().len());
                            let distance = self.distance(q, there);
                            // NaN is beyond every limit but infinity, which asks for no distance at all.
                            let near = distance <= limit || limit == f64::INFINITY;
                            let (Some(back), Some(back_there), true, true) =
                                (back, back_there, lengths.0 == lengths.1, near)
                            else {
                                fits = false;
                                break 'walk;
                            };
                            if distance.total_cmp(&farthest.1).is_gt() {
                                farthest = (q, distance);
                            }
                            let n = lengths.0;
                            let offset = if self.mirrored { back_there + back } else { back_there + n - back } % n;
                            self.put(q, there, offset);
                            placed.push((q, there));
                            queue.push_back(q);
                        }
                        _ => {
                            fits = false;
                            break 'walk;
                        }
                    },
                    _ => {
                        fits = false;
                        break 'walk;
                    }
                }
            }
        }
        for &(p, image) in &placed {
            self.images[p.index()] = None;
            self.taken[image.index()] = false;
        }
        Ok(fits.then_some((placed, farthest)))
    }

    fn put(&mut self, p: Vertex, image: Vertex, offset: usize) {
        self.images[p.index()] = Some(image);
        self.taken[image.index()] = true;
        self.offsets[p.index()] = offset;
    }

    /// The slot of the image on which slot `i` lies.
    fn slot(&self, offset: usize, i: usize, n: usize) -> usize {
        if self.mirrored { (offset + n - i) % n } else { (offset + i) % n }
    }

    fn looks_alike(&self, p: Vertex, image: Vertex) -> bool {
        !self.taken[image.index()] && kind(self.a, p) == kind(self.b, image)
    }

    fn distance(&self, p: Vertex, image: Vertex) -> f64 {
        let (p, q) = (self.a.position(p), self.b.position(image));
        let same_bits = p.to_array().map(f64::to_bits) == q.to_array().map(f64::to_bits);
        if same_bits { 0.0 } else { p.distance(q) }
    }
}

/// Which vertex lies where, and the farthest with its distance.
type Laid = (Vec<(Vertex, Vertex)>, (Vertex, f64));

/// Slots and gaps of a ring.
fn kind(mesh: &Mesh, v: Vertex) -> (usize, usize) {
    let ring = mesh.ring(v);
    (ring.slots().len(), ring.gaps())
}

/// A vertex of a kind that there are fewest of; the first of them.
fn rarest(mesh: &Mesh, members: &[Vertex]) -> Vertex {
    let mut counts: HashMap<(usize, usize), usize> = HashMap::new();
    for &v in members {
        *counts.entry(kind(mesh, v)).or_default() += 1;
    }
    let rarity = |v: &Vertex| (counts.get(&kind(mesh, *v)).copied(), *v);
    members.iter().copied().min_by_key(rarity).unwrap_or(members[0])
}

/// The vertices of a set by the component that they are in; in the order of their numbers.
struct Components {
    members: Vec<Vec<Vertex>>,
}

impl Components {
    fn new(mesh: &Mesh) -> Self {
        let mut seen = vec![false; mesh.vertex_count()];
        let mut members = Vec::new();
        let mut all: Vec<Vertex> = mesh.set.iter().collect();
        all.sort_unstable();
        for start in all {
            if std::mem::replace(&mut seen[start.index()], true) {
                continue;
            }
            let mut component = vec![start];
            let mut next = 0;
            while let Some(&v) = component.get(next) {
                next += 1;
                for q in mesh.ring(v).vertices() {
                    if !std::mem::replace(&mut seen[q.index()], true) {
                        component.push(q);
                    }
                }
            }
            component.sort_unstable();
            members.push(component);
        }
        Self { members }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io::{Format, ReadOptions, read};

    const TETRAHEDRON: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    /// A pyramid without floor, whose corners lie at different heights.
    const ROOF: &str = "v 0 0 0\nv 2 0 1\nv 2 2 2\nv 0 2 4\nv 1 1 9\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

    fn mesh(obj: &str) -> Mesh {
        read(obj.as_bytes(), Format::Obj, &ReadOptions::default()).unwrap().0
    }

    /// How far the farthest vertex is off, or that there is no isomorphism.
    #[track_caller]
    fn check(a: &str, b: &str, mirrored: bool, expected: Option<f64>) {
        let found = isomorphism(&mesh(a), &mesh(b), 1e-9, mirrored, &Stop::new()).unwrap();
        assert_eq!(found.and_then(|found| found.farthest).map(|(_, distance)| distance), expected);
    }

    /// The same with vertices in the order of `numbers`, the faces turned and in another order.
    fn renumbered(obj: &str, numbers: &[usize]) -> String {
        let vertices: Vec<&str> = obj.lines().filter(|l| l.starts_with('v')).collect();
        let mut text: String = numbers.iter().map(|&n| vertices[n - 1].to_owned() + "\n").collect();
        let faces: Vec<&str> = obj.lines().filter(|l| l.starts_with('f')).collect();
        for face in faces.iter().rev() {
            let mut corners: Vec<usize> = face.split_whitespace().skip(1).map(|c| c.parse().unwrap()).collect();
            corners.rotate_left(1);
            let new = |old: &usize| numbers.iter().position(|n| n == old).unwrap() + 1;
            text += &format!("f {}\n", corners.iter().map(|c| new(c).to_string()).collect::<Vec<_>>().join(" "));
        }
        text
    }

    #[test]
    fn numbers_do_not_matter() {
        check(TETRAHEDRON, &renumbered(TETRAHEDRON, &[3, 1, 4, 2]), false, Some(0.0));
        check(ROOF, &renumbered(ROOF, &[5, 3, 1, 2, 4]), false, Some(0.0));
    }

    #[test]
    fn of_all_ways_to_lay_it_the_nearest_is_taken() {
        check(ROOF, &renumbered(&ROOF.replace("1 1 9", "1 1 8"), &[2, 3, 4, 5, 1]), false, Some(1.0));
        check(TETRAHEDRON, &TETRAHEDRON.replace("v 1 0 0", "v 1.5 0 0"), false, Some(0.5));
    }

    #[test]
    fn another_connectivity_is_none() {
        check(TETRAHEDRON, ROOF, false, None);
        let cut = ROOF.replace("f 1 2 5\nf 2 3 5\n", "f 1 2 3 5\n");
        check(ROOF, &cut, false, None);
        // As many vertices, edges and faces: a strip with its diagonals one way and the other.
        let strip = |diagonals: &str| {
            let points: String = (0..4).map(|i| format!("v {i} 0 0\nv {i} 1 0\n")).collect();
            points + diagonals
        };
        let zig = "f 1 3 4\nf 1 4 2\nf 3 5 6\nf 3 6 4\nf 5 7 8\nf 5 8 6\n";
        let zag = "f 1 3 4\nf 1 4 2\nf 3 5 4\nf 5 6 4\nf 5 7 8\nf 5 8 6\n";
        check(&strip(zig), &strip(zag), false, None);
    }

    #[test]
    fn a_mirror_image_is_one_only_in_the_mirror() {
        // Legs of 1, 2 and 3 edges at a triangle: nothing turns it round.
        let legs = "v 0 0 0\nv 4 0 0\nv 2 4 0\nv -1 -1 0\nv 5 -1 0\nv 6 -2 0\nv 3 5 0\nv 3 6 0\nv 3 7 0\n\
                    f 1 2 3\nf 1 4 2\nf 2 5 6 3\nf 3 7 8 9 1\n";
        let mirrored: String = legs
            .lines()
            .map(|line| match line.strip_prefix("f ") {
                Some(corners) => {
                    let turned: Vec<&str> = corners.split(' ').rev().collect();
                    format!("f {}\n", turned.join(" "))
                }
                None => format!("{line}\n"),
            })
            .collect();
        check(legs, legs, false, Some(0.0));
        check(legs, legs, true, None);
        check(legs, &mirrored, false, None);
        check(legs, &mirrored, true, Some(0.0));
    }

    #[test]
    fn components_may_change_places() {
        let two = |first: f64, second: f64| {
            let at = |x: f64| format!("v {x} 0 0\nv {} 0 0\nv {x} 1 0\n", x + 1.0);
            format!("{}{}f 1 2 3\nf 4 5 6\n", at(first), at(second))
        };
        check(&two(0.0, 5.0), &two(5.0, 0.0), false, Some(0.0));
        check(&two(0.0, 5.0), &two(5.25, 0.0), false, Some(0.25));
    }

    #[test]
    fn what_is_no_number_is_only_itself() {
        // Laid upon itself, and upon another: a mesh file cannot hold NaN, a program can make it.
        let mut strange = mesh(TETRAHEDRON);
        let v = strange.set.iter().next().unwrap();
        strange.set_position(v, glam::DVec3::NAN);
        let found = isomorphism(&strange, &strange, 1e-9, false, &Stop::new()).unwrap().unwrap();
        assert_eq!(found.farthest.map(|f| f.1), Some(0.0));
        let found = isomorphism(&strange, &mesh(TETRAHEDRON), 1e-9, false, &Stop::new()).unwrap().unwrap();
        assert!(found.farthest.unwrap().1.is_nan());
    }

    #[test]
    fn what_is_no_number_takes_no_ones_place() {
        // Two points apart from each other; dividing zero by zero gives a NaN with its sign set on some machines.
        let mut points = Mesh::new();
        for place in [-f64::NAN, f64::NAN, 0.0, 1.0] {
            for y in [0.0, f64::NAN] {
                let v = points.create().unwrap();
                points.set.add(v);
                points.set_position(v, glam::DVec3::new(place, y, 0.0));
            }
        }
        let found = isomorphism(&points, &points, 0.0, false, &Stop::new()).unwrap().unwrap();
        assert_eq!(found.farthest.map(|f| f.1), Some(0.0));
    }

    #[test]
    fn it_can_be_stopped() {
        let stop = Stop::new();
        stop.request(Stopped::ByUser);
        assert!(isomorphism(&mesh(ROOF), &mesh(ROOF), 0.0, false, &stop).is_err());
    }
}
