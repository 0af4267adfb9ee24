//! Which faces meet along which edge, and on which side.
//!
//! The half-edge `h` runs from corner `h` to the next corner of its face.

use super::super::Vertex;
use super::super::validate::count;
use super::{BuildError, DRAWN, Polygons, Report, full, quote, vertex_name, warning};
use crate::diagnostic::{Diagnostic, Severity};
use crate::stop::{Stop, Stopped};

/// No half-edge, no face.
pub(super) const NONE: u32 = u32::MAX;

/// How many faces of a cycle are quoted.
const CYCLE_SHOWN: usize = 40;

/// The half-edges of polygons, grouped by edge.
pub(super) struct Edges {
    /// Face of each half-edge.
    pub(super) face: Vec<u32>,
    /// Half-edges sorted by edge; within an edge in order of the faces.
    sorted: Vec<u32>,
    /// End of each edge in `sorted`.
    ends: Vec<u32>,
    /// Component of each face, the largest first; faces are connected by edges with two faces.
    component: Vec<u32>,
}

impl Edges {
    pub(super) fn new(polygons: &Polygons, stop: &Stop) -> Result<Self, BuildError> {
        let corners = &polygons.corners;
        if corners.len() >= NONE as usize || polygons.positions.len() >= NONE as usize {
            return Err(full());
        }
        let mut face = vec![0; corners.len()];
        for f in 0..polygons.len() {
            face[polygons.range(f)].fill(f as u32);
        }
        stop.check()?;
        // Bucket by the lower end, then sort each bucket by the higher.
        let next = |h: usize| next(polygons, &face, h as u32) as usize;
        let ends_of = |h: usize| {
            let (u, v) = (corners[h], corners[next(h)]);
            (u.min(v), u.max(v))
        };
        let mut starts = vec![0u32; polygons.positions.len() + 1];
        for h in 0..corners.len() {
            starts[ends_of(h).0 as usize + 1] += 1;
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        stop.check()?;
        let mut buckets = vec![(0u32, 0u32); corners.len()];
        let mut fill = starts.clone();
        for h in 0..corners.len() {
            let (low, high) = ends_of(h);
            buckets[fill[low as usize] as usize] = (high, h as u32);
            fill[low as usize] += 1;
        }
        let mut ends = Vec::with_capacity(corners.len() / 2);
        for v in 1..starts.len() {
            stop.check()?;
            let range = starts[v - 1] as usize..starts[v] as usize;
            buckets[range.clone()].sort_unstable();
            let last = |i: &usize| i + 1 == range.end || buckets[*i].0 != buckets[i + 1].0;
            ends.extend(range.clone().filter(last).map(|i| i as u32 + 1));
        }
        let sorted = buckets.into_iter().map(|(_, h)| h).collect();
        Ok(Self { face, sorted, ends, component: Vec::new() })
    }

    /// The half-edges of each edge.
    fn groups(&self) -> impl Iterator<Item = &[u32]> {
        let start = |i: usize| if i == 0 { 0 } else { self.ends[i - 1] as usize };
        (0..self.ends.len()).map(move |i| &self.sorted[start(i)..self.ends[i] as usize])
    }

    /// Turns faces over so that neighbours run along their edge in opposite directions, the fewer of each component.
    pub(super) fn orient(
        &mut self,
        polygons: &mut Polygons,
        report: &mut Report,
        stop: &Stop,
    ) -> Result<(), BuildError> {
        let mut partner = vec![NONE; self.face.len()];
        for group in self.groups() {
            if let &[g, h] = group {
                partner[g as usize] = h;
                partner[h as usize] = g;
            }
        }
        stop.check()?;
        let n = polygons.len();
        self.component = vec![NONE; n];
        let mut parent = vec![NONE; n];
        let mut turned = vec![false; n];
        let mut pillows = Vec::new();
        let mut queue = Vec::new();
        for root in 0..n {
            if self.component[root] != NONE {
                continue;
            }
            queue.clear();
            queue.push(root);
            self.component[root] = root as u32;
            let mut done = 0;
            let mut closed = true;
            while let Some(&f) = queue.get(done) {
                stop.check()?;
                done += 1;
                for h in polygons.range(f) {
                    let twin = partner[h];
                    if twin == NONE {
                        closed = false;
                        continue;
                    }
                    let g = self.face[twin as usize] as usize;
                    let turn = turned[f] ^ (polygons.corners[h] == polygons.corners[twin as usize]);
                    if self.component[g] == NONE {
                        self.component[g] = root as u32;
                        parent[g] = f as u32;
                        turned[g] = turn;
                        queue.push(g);
                    } else if turned[g] != turn {
                        return Err(not_orientable(polygons, &parent, f, g));
                    }
                }
            }
            if let &[f, g] = &queue[..]
                && closed
            {
                pillows.push((f, g));
            }
            if queue.iter().filter(|&&f| turned[f]).count() * 2 > queue.len() {
                queue.iter().for_each(|&f| turned[f] = !turned[f]);
            }
        }
        self.rank_components();
        if !pillows.is_empty() {
            let message = match pillows.len() {
                1 => "two faces lie back to back and make a closed pillow without thickness".to_owned(),
                n => format!("{n} pairs of faces lie back to back and make closed pillows without thickness"),
            };
            report.remarks.push(quote(warning(message), pillows.len(), |i| {
                format!("{} and {}", polygons.quote(pillows[i].0), polygons.name(pillows[i].1))
            }));
        }
        Ok(self.turn(polygons, &turned, report, stop)?)
    }

    /// Numbers components, which are named by their first face, by size.
    fn rank_components(&mut self) {
        let mut sizes = vec![0u32; self.component.len()];
        self.component.iter().for_each(|&root| sizes[root as usize] += 1);
        let mut roots: Vec<u32> = (0..sizes.len() as u32).filter(|&f| sizes[f as usize] > 0).collect();
        roots.sort_by_key(|&root| std::cmp::Reverse(sizes[root as usize])); // stable
        let mut rank = sizes;
        for (i, &root) in roots.iter().enumerate() {
            rank[root as usize] = i as u32;
        }
        self.component.iter_mut().for_each(|component| *component = rank[*component as usize]);
    }

    fn turn(
        &mut self,
        polygons: &mut Polygons,
        turned: &[bool],
        report: &mut Report,
        stop: &Stop,
    ) -> Result<(), Stopped> {
        let faces: Vec<usize> = (0..turned.len()).filter(|&f| turned[f]).collect();
        if faces.is_empty() {
            return Ok(());
        }
        let message = match faces.len() {
            1 => "1 face ran round the other way than its neighbours and was turned over".to_owned(),
            n => format!("{n} faces ran round the other way than their neighbours and were turned over"),
        };
        report.repairs.push(quote(warning(message), faces.len(), |i| polygons.quote(faces[i])));
        stop.check()?;
        for &f in &faces {
            let range = polygons.range(f);
            polygons.corners[range.start + 1..range.end].reverse(); // the first corner stays
        }
        for h in &mut self.sorted {
            let f = self.face[*h as usize] as usize;
            if turned[f] {
                let range = polygons.range(f);
                *h = (range.start + range.end - 1) as u32 - *h;
            }
        }
        Ok(())
    }

    /// Which half-edge lies on the other side of each, [`NONE`] at a border; faces that are `apart` have borders only.
    /// Also the edges with more than two faces. Expects oriented polygons.
    pub(super) fn pairs(
        &self,
        polygons: &Polygons,
        apart: &[bool],
        stop: &Stop,
    ) -> Result<(Vec<u32>, Vec<&[u32]>), Stopped> {
        let mut pairs = vec![NONE; self.face.len()];
        let mut crowded = Vec::new();
        let mut join = |g: u32, h: u32| {
            if !apart[self.face[g as usize] as usize] && !apart[self.face[h as usize] as usize] {
                pairs[g as usize] = h;
                pairs[h as usize] = g;
            }
        };
        for group in self.groups() {
            match *group {
                [_] => {}
                [g, h] => join(g, h),
                _ => {
                    stop.check()?;
                    self.pair_crowded(polygons, group, &mut join);
                    crowded.push(group);
                }
            }
        }
        Ok((pairs, crowded))
    }

    /// Pairs half-edges of opposite directions: those of one component first, then what is left, in order of the
    /// components. As that order is the same at all edges, a face laid into a closed surface does not tear it. What is
    /// left over runs in one direction, so that no fan can begin and end with the same edge.
    fn pair_crowded(&self, polygons: &Polygons, group: &[u32], join: &mut impl FnMut(u32, u32)) {
        let component = |h: u32| self.component[self.face[h as usize] as usize];
        let forward = |h: u32| {
            let to = polygons.corners[next(polygons, &self.face, h) as usize];
            polygons.corners[h as usize] < to
        };
        let mut by_component = group.to_vec();
        by_component.sort_by_key(|&h| (component(h), h));
        let mut left: [Vec<u32>; 2] = [Vec::new(), Vec::new()];
        for run in by_component.chunk_by(|&g, &h| component(g) == component(h)) {
            let (there, back): (Vec<u32>, Vec<u32>) = run.iter().partition(|&&h| forward(h));
            there.iter().zip(&back).for_each(|(&g, &h)| join(g, h));
            let paired = there.len().min(back.len());
            left[0].extend(&there[paired..]);
            left[1].extend(&back[paired..]);
        }
        left[0].iter().zip(&left[1]).for_each(|(&g, &h)| join(g, h));
    }

    /// Warns of edges with more than two faces.
    pub(super) fn report_crowded(
        &self,
        polygons: &Polygons,
        crowded: &[&[u32]],
        duplicates: usize,
        report: &mut Report,
    ) {
        if crowded.is_empty() {
            return;
        }
        let n = crowded.len();
        let message = format!(
            "{} {} more than two faces; {} duplicated so that every face is kept",
            count(n, "edge"),
            if n == 1 { "has" } else { "have" },
            match duplicates {
                1 => "1 vertex was".to_owned(),
                n => format!("{n} vertices were"),
            }
        );
        let diagnostic = quote(warning(message), n, |i| {
            let h = crowded[i][0];
            let (u, v) = (polygons.corners[h as usize], polygons.corners[next(polygons, &self.face, h) as usize]);
            let mut faces: Vec<String> =
                crowded[i].iter().take(6).map(|&h| polygons.name(self.face[h as usize] as usize)).collect();
            if crowded[i].len() > 6 {
                faces.push(format!("and {} more", crowded[i].len() - 6));
            }
            format!("edge {}–{}: {}", vertex_name(u.min(v)), vertex_name(u.max(v)), faces.join(", "))
        });
        let hint = "if two parallel edges between the same two vertices are meant: a rotation system has none, put a \
            vertex on one of them";
        let ends = crowded.iter().flat_map(|group| {
            let h = group[0];
            [h, next(polygons, &self.face, h)].map(|h| polygons.corners[h as usize] as usize)
        });
        report.repairs.push(diagnostic.hint(hint).about(ends.filter_map(Vertex::from_index).take(DRAWN)));
    }
}

/// The corner after `h` in its face.
pub(super) fn next(polygons: &Polygons, face: &[u32], h: u32) -> u32 {
    let range = polygons.range(face[h as usize] as usize);
    if h as usize + 1 == range.end { range.start as u32 } else { h + 1 }
}

/// The corner before `h` in its face.
pub(super) fn previous(polygons: &Polygons, face: &[u32], h: u32) -> u32 {
    let range = polygons.range(face[h as usize] as usize);
    if h as usize == range.start { range.end as u32 - 1 } else { h - 1 }
}

/// Faces `f` and `g` meet, but the ways to them in the search tree want one of them turned over: these ways and that
/// edge make the cycle.
fn not_orientable(polygons: &Polygons, parent: &[u32], f: usize, g: usize) -> BuildError {
    let way = |mut f: usize| {
        let mut way = vec![f];
        while parent[f] != NONE {
            f = parent[f] as usize;
            way.push(f);
        }
        way
    };
    let (mut from, mut to) = (way(f), way(g));
    while from.len() > 1 && to.len() > 1 && from[from.len() - 2] == to[to.len() - 2] {
        from.pop();
        to.pop();
    }
    to.pop(); // the common ancestor is in both
    let cycle: Vec<usize> = from.into_iter().chain(to.into_iter().rev()).collect();
    let message = match cycle.len() {
        1 => format!("the surface is not orientable: {} meets itself the wrong way round", polygons.name(f)),
        n => format!("the surface is not orientable: a band of {n} faces comes back the other way round"),
    };
    let mut error = Diagnostic::new(Severity::Error, None, message);
    error = error.evidence(match cycle.len() {
        1 => "it runs along one of its edges twice in the same direction".to_owned(),
        _ => "each of these meets the next, the last the first; however they are turned, two run along an edge in the \
            same direction"
            .to_owned(),
    });
    for &f in cycle.iter().take(CYCLE_SHOWN) {
        error = error.evidence(polygons.quote(f));
    }
    if cycle.len() > CYCLE_SHOWN {
        error = error.evidence(format!("and {} more", cycle.len() - CYCLE_SHOWN));
    }
    error = error.hint("rotation systems are orientable: cut the band, or take out one of its faces");
    BuildError::refused(cycle.first().and_then(|&f| polygons.line(f)), error)
}
