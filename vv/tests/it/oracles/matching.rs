//! Whether two meshes are the same but for the names of their vertices and the order of their faces.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use glam::DVec3;

/// A mesh as lists: points, and the corners of each face, counter-clockwise.
#[derive(Debug, Clone, Default)]
pub struct Lists {
    pub points: Vec<DVec3>,
    pub faces: Vec<Vec<usize>>,
}

/// Why two meshes are not the same; vertices are counted from 0.
#[derive(Debug, Clone, PartialEq)]
pub enum Difference {
    /// How many vertices or faces there are.
    Count(&'static str, usize, usize),
    /// Two faces of one mesh go from this vertex to that.
    NoSurface(usize, usize),
    /// No vertex of the second mesh lies where this one of the first does; how far away the nearest one is.
    Position(usize, f64),
    /// Positions agree, but not the faces, as seen first at this vertex of the first mesh.
    Faces(usize),
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Count(what, a, b) => write!(f, "{a} {what} instead of {b}"),
            Self::NoSurface(p, q) => write!(f, "two faces go from vertex {p} to {q}"),
            Self::Position(v, distance) => write!(f, "what is nearest to vertex {v} is {distance:.1e} away"),
            Self::Faces(v) => write!(f, "the faces around vertex {v} are others"),
        }
    }
}

/// Maps the vertices of `a` one to one to those of `b`, so that positions differ by at most `tolerance` in each
/// coordinate and faces go to faces, as cyclic lists. Returns the images.
///
/// Where several vertices lie in one place, the faces tell them apart: a part of a surface that hangs together by edges
/// has one map at most once the image of one directed edge is known, as walking round faces and across edges on both
/// sides at once gives the rest. Parts are mapped one after the other, the first map of each is kept.
///
/// # Errors
/// The first difference, positions before faces.
pub fn same(a: &Lists, b: &Lists, tolerance: f64) -> Result<Vec<usize>, Difference> {
    for (what, a, b) in [("vertices", a.points.len(), b.points.len()), ("faces", a.faces.len(), b.faces.len())] {
        if a != b {
            return Err(Difference::Count(what, a, b));
        }
    }
    let distance = |v: usize, w: usize| (a.points[v] - b.points[w]).abs().max_element();
    for v in 0..a.points.len() {
        let nearest = (0..b.points.len()).map(|w| distance(v, w)).fold(f64::INFINITY, f64::min);
        if nearest > tolerance {
            return Err(Difference::Position(v, nearest));
        }
    }
    let (first, second) = (following(a)?, following(b)?);
    let mut map = Map { images: vec![None; a.points.len()], used: vec![false; b.points.len()], edges: BTreeSet::new() };
    for &edge in first.keys() {
        if !map.edges.contains(&edge) {
            let fits = |v, w| distance(v, w) <= tolerance;
            let maps = second.keys().filter(|image| fits(edge.0, image.0) && fits(edge.1, image.1));
            let mut at = edge.0;
            let mut maps =
                maps.filter_map(|&image| map.with(edge, image, &first, &second, fits).map_err(|v| at = v).ok());
            map = maps.next().ok_or(Difference::Faces(at))?;
        }
    }
    for v in 0..a.points.len() {
        if map.images[v].is_none() {
            let free = (0..b.points.len()).find(|&w| !map.used[w] && distance(v, w) <= tolerance);
            map.set(v, free.ok_or(Difference::Faces(v))?);
        }
    }
    Ok(map.images.into_iter().flatten().collect())
}

/// From one vertex to the next one in the face at the left.
type Edge = (usize, usize);

/// What follows each directed edge in its face.
fn following(lists: &Lists) -> Result<BTreeMap<Edge, Edge>, Difference> {
    let mut following = BTreeMap::new();
    for face in &lists.faces {
        let corner = |i: usize| face[i % face.len()];
        for i in 0..face.len() {
            if following.insert((corner(i), corner(i + 1)), (corner(i + 1), corner(i + 2))).is_some() {
                return Err(Difference::NoSurface(corner(i), corner(i + 1)));
            }
        }
    }
    Ok(following)
}

/// A one-to-one map of some of the vertices, and the directed edges that are known to go to directed edges.
#[derive(Clone)]
struct Map {
    images: Vec<Option<usize>>,
    used: Vec<bool>,
    edges: BTreeSet<Edge>,
}

impl Map {
    fn set(&mut self, v: usize, w: usize) {
        self.images[v] = Some(w);
        self.used[w] = true;
    }

    /// Also maps `edge` to `image`, and with it all of its part of the surface; if that cannot be, the vertex where it
    /// cannot.
    fn with(
        &self,
        edge: Edge,
        image: Edge,
        first: &BTreeMap<Edge, Edge>,
        second: &BTreeMap<Edge, Edge>,
        fits: impl Fn(usize, usize) -> bool,
    ) -> Result<Self, usize> {
        let mut map = self.clone();
        let mut open = vec![(edge, image)];
        while let Some((edge, image)) = open.pop() {
            for (v, w) in [(edge.0, image.0), (edge.1, image.1)] {
                match map.images[v] {
                    Some(known) if known != w => return Err(v),
                    None if map.used[w] || !fits(v, w) => return Err(v),
                    None => map.set(v, w),
                    Some(_) => {}
                }
            }
            if map.edges.insert(edge) {
                open.push((first[&edge], *second.get(&image).ok_or(edge.0)?));
                let (back, image_back) = ((edge.1, edge.0), (image.1, image.0));
                match (first.contains_key(&back), second.contains_key(&image_back)) {
                    (true, true) => open.push((back, image_back)),
                    (false, false) => {}
                    _ => return Err(edge.0),
                }
            }
        }
        Ok(map)
    }
}

/// A cube whose top is two triangles, without its front, moved about so that nothing is symmetric.
fn box_with_a_hole() -> Lists {
    let at = |i: usize, axis: usize| f64::from((i >> axis & 1) as u32) + 0.01 * ((i * 3 + axis * i * i) % 7) as f64;
    let faces: [&[usize]; 6] = [&[0, 2, 3, 1], &[4, 5, 7], &[4, 7, 6], &[0, 4, 6, 2], &[1, 3, 7, 5], &[2, 6, 7, 3]];
    Lists {
        points: (0..8).map(|i| DVec3::new(at(i, 0), at(i, 1), at(i, 2))).collect(),
        faces: faces.iter().map(|f| f.to_vec()).collect(),
    }
}

/// The mesh with vertex v called `name(v)`.
fn renamed(lists: &Lists, name: impl Fn(usize) -> usize) -> Lists {
    let mut points = lists.points.clone();
    lists.points.iter().enumerate().for_each(|(v, p)| points[name(v)] = *p);
    Lists { points, faces: lists.faces.iter().map(|f| f.iter().map(|&v| name(v)).collect()).collect() }
}

#[test]
fn names_and_order_do_not_matter() {
    let a = box_with_a_hole();
    let mut b = renamed(&a, |v| (v * 3 + 5) % 8);
    b.faces.reverse();
    b.faces.iter_mut().enumerate().for_each(|(i, face)| face.rotate_left(i % 3));
    assert_eq!(same(&a, &b, 0.0), Ok((0..8).map(|v| (v * 3 + 5) % 8).collect()));
}

#[test]
fn positions_may_be_off_by_the_tolerance() {
    let a = box_with_a_hole();
    let mut b = a.clone();
    b.points[6].y += 1e-9;
    assert!(same(&a, &b, 1.1e-9).is_ok());
    assert!(matches!(same(&a, &b, 0.9e-9), Err(Difference::Position(6, distance)) if (distance - 1e-9).abs() < 1e-12));
}

/// Changes a mesh and looks for the difference; where the walk round the faces meets one, is not asked.
#[track_caller]
fn check_fault(plant: impl FnOnce(&mut Lists), expected: Difference) {
    let a = box_with_a_hole();
    let mut b = a.clone();
    plant(&mut b);
    let found =
        same(&a, &b, 1e-9).map_err(|found| if let Difference::Faces(_) = found { Difference::Faces(0) } else { found });
    assert_eq!(found, Err(expected));
}

#[test]
fn planted_faults_are_found() {
    check_fault(|b| b.points.push(DVec3::ZERO), Difference::Count("vertices", 8, 9));
    check_fault(|b| drop(b.faces.pop()), Difference::Count("faces", 6, 5));
    check_fault(|b| b.points[3] = b.points[2], Difference::Position(3, 0.94));
    check_fault(|b| b.points.swap(0, 7), Difference::Faces(0));
    check_fault(|b| b.faces.iter_mut().for_each(|face| face.reverse()), Difference::Faces(0));
    check_fault(|b| b.faces[5].reverse(), Difference::NoSurface(3, 7));
    // The other diagonal of the top; the same hole elsewhere.
    check_fault(|b| (b.faces[1], b.faces[2]) = (vec![4, 5, 6], vec![5, 7, 6]), Difference::Faces(0));
    check_fault(|b| b.faces[5] = vec![0, 1, 5, 4], Difference::Faces(0));
}

#[test]
fn faces_tell_vertices_in_one_place_apart() {
    let mut a = box_with_a_hole();
    a.points[0] = a.points[5];
    a.points[6] = a.points[5];
    let exchange = |v| [6, 1, 2, 3, 4, 0, 5, 7][v];
    assert_eq!(same(&a, &renamed(&a, exchange), 0.0), Ok((0..8).map(exchange).collect()));
    let mut b = a.clone();
    (b.faces[1], b.faces[2]) = (vec![4, 5, 6], vec![5, 7, 6]);
    assert!(matches!(same(&a, &b, 0.0), Err(Difference::Faces(_))));
}

/// Two triangles back to back and a lone vertex, all in one place.
#[test]
fn parts_and_lone_vertices_are_each_used_once() {
    let a = Lists { points: vec![DVec3::ONE; 7], faces: vec![vec![0, 1, 2], vec![3, 4, 5]] };
    let b = Lists { points: vec![DVec3::ONE; 7], faces: vec![vec![6, 4, 2], vec![1, 5, 3]] };
    let mut images = same(&a, &b, 0.0).unwrap();
    assert_eq!(images[6], 0);
    images.sort_unstable();
    assert_eq!(images, (0..7).collect::<Vec<_>>());
    let c = Lists { points: vec![DVec3::ONE; 7], faces: vec![vec![6, 4, 2], vec![1, 5, 2]] };
    assert!(matches!(same(&a, &c, 0.0), Err(Difference::Faces(_))));
}
