//! One irregular vertex in regular surroundings, where a mask shows what it is.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use glam::{DVec3, dvec3};

use super::{Fault, Masks, TOLERANCE, measure, step};
use crate::engine::{Failure, Machine, Settings};
use crate::ir::FunctionId;
use crate::mesh::build::{Polygons, build};
use crate::mesh::faces::faces;
use crate::mesh::{Mesh, Vertex};
use crate::stop::Stop;

/// How far the regular surroundings reach, in edges: the masks of two steps' neighbours do not meet their end.
const REACH: usize = 3;

/// Regular surroundings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Around {
    /// Valence 6, at a boundary 4.
    Triangles,
    /// Valence 4, at a boundary 3.
    Quads,
}

/// A mesh around a vertex `p`, with neighbours q1, q2, … anticlockwise; all others are `i qk + j ql`, i steps in the
/// direction of one neighbour and j in that of the next.
///
/// Inside, the sectors go all round, and a second star closes the mesh from below, so that rules without boundary work;
/// at the boundary they go half round, from boundary to boundary.
#[derive(Debug, Clone)]
pub struct Star {
    /// The mesh.
    pub mesh: Mesh,
    /// Where each vertex is, by its index.
    pub places: Vec<Place>,
    /// Sectors around p.
    pub sectors: usize,
    /// Whether p lies on the boundary.
    pub boundary: bool,
    p: usize,
}

/// Where a vertex of a [`Star`] is: in a sector, counted from 0, so far along its first and its second neighbour.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// On the side that closes the mesh.
    pub below: bool,
    /// The steps, first and second; p has (0, 0) and no others the first 0.
    pub steps: (usize, usize),
    /// The sector.
    pub sector: usize,
}

impl Star {
    /// `sectors` of them, 2 or more, at the boundary 1 or more. `None` if there cannot be such a mesh.
    #[must_use]
    pub fn new(sectors: usize, around: Around, boundary: bool) -> Option<Self> {
        let rays = if boundary { sectors + 1 } else { sectors };
        let direction = |ray: usize| {
            let angle = ray as f64 / sectors as f64 * if boundary { PI } else { TAU };
            dvec3(angle.cos(), angle.sin(), 0.0)
        };
        let mut numbers: BTreeMap<Place, usize> = BTreeMap::new();
        let (mut places, mut points) = (Vec::new(), Vec::new());
        let mut number = |below: bool, sector: usize, i: usize, j: usize| {
            let rim = match around {
                Around::Triangles => i + j == REACH,
                Around::Quads => i.max(j) == REACH,
            };
            let steps = if i == 0 { (j, 0) } else { (i, j) };
            let sector = match (i, j) {
                (0, 0) => 0,
                (0, _) => (sector + 1) % rays,
                _ => sector,
            };
            // Triangles share the rim; of quads two would share two edges, so a band of them goes round.
            let place = Place { below: below && !(rim && around == Around::Triangles), steps, sector };
            *numbers.entry(place).or_insert_with(|| {
                let flat = steps.0 as f64 * direction(sector) + steps.1 as f64 * direction(sector + 1);
                places.push(place);
                points.push(flat - if place.below { DVec3::Z } else { DVec3::ZERO });
                places.len() - 1
            })
        };
        let mut faces: Vec<Vec<usize>> = Vec::new();
        for below in [false, true].into_iter().take(if boundary { 1 } else { 2 }) {
            for (s, i, j) in cells(sectors) {
                let mut push = |corners: &[(usize, usize)]| {
                    let mut face: Vec<usize> =
                        corners.iter().map(|&(di, dj)| number(below, s, i + di, j + dj)).collect();
                    if below {
                        face.reverse();
                    }
                    faces.push(face);
                };
                match around {
                    Around::Quads => push(&[(0, 0), (1, 0), (1, 1), (0, 1)]),
                    Around::Triangles if i + j < REACH => {
                        push(&[(0, 0), (1, 0), (0, 1)]);
                        if i + j + 1 < REACH {
                            push(&[(1, 0), (1, 1), (0, 1)]);
                        }
                    }
                    Around::Triangles => {}
                }
            }
        }
        if around == Around::Quads && !boundary {
            for s in 0..sectors {
                let out = (0..REACH).map(|k| [(REACH, k), (REACH, k + 1)]);
                let back = (0..REACH).rev().map(|k| [(k + 1, REACH), (k, REACH)]);
                for [a, b] in out.chain(back) {
                    let corners = [(true, a), (true, b), (false, b), (false, a)];
                    faces.push(corners.map(|(below, (i, j))| number(below, s, i, j)).into());
                }
            }
        }
        let mesh = mesh_of(points, &faces)?;
        Some(Self { mesh, places, sectors, boundary, p: 0 })
    }

    /// Generation 0 of a run on the star: what the program's `start` leaves, which may set properties and add vertices of its
    /// own; the star itself for a program without `start`. `None` if the star is not what it was: a vertex left the set or
    /// has other neighbours.
    ///
    /// # Errors
    /// As [`Machine::run`].
    pub fn started(&self, machine: &Machine, settings: &Settings) -> Result<Option<Self>, Failure> {
        let Some(start) = machine.program().start else { return Ok(Some(self.clone())) };
        let (mesh, _) = step(machine, start, &self.mesh, 0, settings)?;
        let is_same = |v: Vertex| mesh.set.contains(v) && mesh.ring(v).slots() == self.mesh.ring(v).slots();
        let still_there = mesh.vertex_count() >= self.mesh.vertex_count() && self.mesh.vertices().all(is_same);
        Ok(still_there.then(|| Self { mesh, ..self.clone() }))
    }

    /// The same with the vertices and the faces in the opposite order, to see whether a rule depends on it.
    #[must_use]
    pub fn reversed(&self) -> Option<Self> {
        let last = self.places.len() - 1;
        let found = faces(&self.mesh, &Stop::new()).ok()?;
        let turned: Vec<Vec<usize>> =
            found.iter().map(|f| f.iter().map(|v| last - v.index()).collect()).collect::<Vec<_>>();
        let points = self.mesh.positions().iter().rev().copied().collect();
        let mesh = mesh_of(points, &turned.into_iter().rev().collect::<Vec<_>>())?;
        let places = self.places.iter().rev().copied().collect();
        Some(Self { mesh, places, p: last - self.p, ..*self })
    }

    /// `p`, `q3`, `q1+q2`, `2q4`, …; with a prime on the side that closes the mesh.
    #[must_use]
    pub fn name(&self, v: Vertex) -> String {
        let Some(Place { below, steps: (i, j), sector }) = self.places.get(v.index()).copied() else {
            return v.to_string();
        };
        let along = |steps: usize, ray: usize| {
            let times = if steps == 1 { String::new() } else { steps.to_string() };
            let rays = self.sectors + usize::from(self.boundary);
            format!("{times}q{}", ray % rays + 1)
        };
        let name = match (i, j) {
            (0, 0) => "p".to_owned(),
            (_, 0) => along(i, sector),
            _ => format!("{}+{}", along(i, sector), along(j, sector + 1)),
        };
        if below { name + "′" } else { name }
    }

    /// The weight of p.
    #[must_use]
    pub fn part_of_p(&self, mask: &[(Vertex, f64)]) -> f64 {
        mask.iter().find(|(v, _)| v.index() == self.p).map_or(0.0, |(_, w)| *w)
    }

    /// Where each vertex comes to lie when the star is turned by so many sectors, or, for the reflection, when it is
    /// turned over.
    fn turned(&self, by: usize, reflected: bool) -> Vec<Place> {
        let n = self.sectors;
        let image = |&Place { below, steps: (i, j), sector }: &Place| {
            match (i, j) {
                (0, 0) => Place { below, steps: (0, 0), sector: 0 },
                // On a ray, of which a boundary has one more.
                (_, 0) if self.boundary => {
                    Place { below, steps: (i, j), sector: if reflected { n - sector } else { sector } }
                }
                (_, 0) => {
                    let sector = if reflected { (n - sector) % n } else { sector };
                    Place { below, steps: (i, j), sector: (sector + by) % n }
                }
                // In a sector: over to the one that begins where it ended.
                _ if reflected => Place { below, steps: (j, i), sector: (n - 1 - sector + by) % n },
                _ => Place { below, steps: (i, j), sector: (sector + by) % n },
            }
        };
        self.places.iter().map(image).collect()
    }
}

fn mesh_of(points: Vec<DVec3>, faces: &[Vec<usize>]) -> Option<Mesh> {
    let mut polygons = Polygons::new(points);
    for face in faces {
        polygons.push(face.iter().map(|&v| v as u32), None).ok()?;
    }
    let (mesh, warnings) = build(polygons, true, &Stop::new()).ok()?;
    warnings.is_empty().then_some(mesh)
}

fn cells(sectors: usize) -> impl Iterator<Item = (usize, usize, usize)> {
    (0..sectors).flat_map(|s| (0..REACH).flat_map(move |i| (0..REACH).map(move |j| (s, i, j))))
}

/// New vertices that are made in the same way, up to a turn of the star.
#[derive(Debug, Clone)]
pub struct Class {
    /// One of them.
    pub vertex: Vertex,
    /// Whether it is an old vertex, perhaps elsewhere.
    pub is_old: bool,
    /// How many there are.
    pub count: usize,
    /// Its weights, in the order of the old vertices.
    pub mask: Vec<(Vertex, f64)>,
    /// Whether the star has its mirror image, too.
    pub symmetric: bool,
    key: Key,
}

/// A mask in the turn of the star that comes first.
type Key = Vec<(Place, i64)>;

/// Whether two runs found the same classes: rules that do not depend on the order of vertices do.
#[must_use]
pub fn same_classes(a: &[Class], b: &[Class]) -> bool {
    let keys = |classes: &[Class]| {
        let mut keys: Vec<(Key, usize)> = classes.iter().map(|class| (class.key.clone(), class.count)).collect();
        keys.sort_unstable();
        keys
    };
    keys(a) == keys(b)
}

/// The new vertices in whose making p has no less part than any other, by their classes: those first in which it has
/// the greatest part.
#[must_use]
pub fn classes(star: &Star, masks: &Masks) -> Vec<Class> {
    let turns = if star.boundary { 1 } else { star.sectors };
    let [turned, over] = [false, true].map(|over| (0..turns).map(|by| star.turned(by, over)).collect::<Vec<_>>());
    // Weights as whole numbers, in a unit in which no fraction lies between two of them.
    let whole = |w: f64| (w * 1e9 * std::f64::consts::FRAC_PI_3).round() as i64;
    let least = |mask: &[(Vertex, f64)], images: &[Vec<Place>]| -> Key {
        let key = |image: &Vec<Place>| {
            // What `start` has added is elsewhere.
            let mut key: Key = mask.iter().filter_map(|(v, w)| Some((*image.get(v.index())?, whole(*w)))).collect();
            key.sort_unstable();
            key
        };
        images.iter().map(key).min().unwrap_or_default()
    };
    let mut found: BTreeMap<Key, Class> = BTreeMap::new();
    for (vertex, mask) in masks.result.vertices().zip(&masks.weights) {
        let at_p = star.part_of_p(mask);
        let most = mask.iter().map(|(_, w)| *w).fold(0.0, f64::max);
        if at_p <= TOLERANCE || at_p < most - 1e-9 || !masks.result.set.contains(vertex) {
            continue;
        }
        let key = least(mask, &turned);
        let is_old = vertex.index() < masks.survivors;
        let class = Class { vertex, is_old, count: 0, mask: mask.clone(), symmetric: false, key: key.clone() };
        found.entry(key).or_insert(class).count += 1;
    }
    let keys: Vec<Key> = found.keys().cloned().collect();
    let mut all: Vec<Class> = found.into_values().collect();
    for class in &mut all {
        class.symmetric = keys.binary_search(&least(&class.mask, &over)).is_ok();
    }
    all.sort_by(|a, b| star.part_of_p(&b.mask).total_cmp(&star.part_of_p(&a.mask)));
    all
}

/// What the masks around a vertex are like.
#[derive(Debug, Clone)]
pub struct Judgement {
    /// The new vertices that have part in it.
    pub classes: Vec<Class>,
    /// What keeps them from being masks that a drawing could tell: of each kind the first.
    pub faults: Vec<Fault>,
}

/// Measures the masks around the middle of a star that the program's `start` was run on, once more with its vertices in
/// another order.
///
/// # Errors
/// As [`measure`].
pub fn judge(machine: &Machine, rule: FunctionId, star: &Star, settings: &Settings) -> Result<Judgement, Failure> {
    let measured = |star: &Star| -> Result<(Vec<Class>, Masks, bool), Failure> {
        let started = star.started(machine, settings)?;
        let (star, is_started) = (started.as_ref().unwrap_or(star), started.is_some());
        let masks = measure(machine, rule, &star.mesh, settings)?;
        Ok((classes(star, &masks), masks, is_started))
    };
    let (classes, masks, is_started) = measured(star)?;
    let mut faults: Vec<Fault> = (!is_started).then_some(Fault::Start).into_iter().collect();
    faults.extend(masks.faults.first());
    if classes.iter().any(|class| !class.symmetric) {
        faults.push(Fault::Asymmetric);
    }
    let again = star.reversed().and_then(|other| measured(&other).ok());
    if again.is_none_or(|(others, ..)| !same_classes(&classes, &others)) {
        faults.push(Fault::Order);
    }
    Ok(Judgement { classes, faults })
}
