//! Fans of faces around vertices, and the rings they make.

use super::super::validate::vertices;
use super::super::{EditError, Mesh, Vertex};
use super::edges::{Edges, NONE, next, previous};
use super::{BuildError, DRAWN, Polygons, Report, full, quote, vertex_name, warning};
use crate::diagnostic::{Diagnostic, Severity};
use crate::stop::{Stop, Stopped};

/// How often single faces are set apart before all faces along crowded edges are.
const ROUNDS: usize = 5;

/// Corners around a vertex that follow each other across edges.
struct Fan {
    /// The corner to start from: the first in the order of faces, where the fan is open the clockwise end.
    start: u32,
    /// The vertex in the polygons.
    vertex: u32,
    closed: bool,
    len: u32,
}

/// The fans at all vertices, ordered by the first face of each, and which vertex of the mesh each becomes.
struct Fans {
    fans: Vec<Fan>,
    /// The fan of each corner.
    of_corner: Vec<u32>,
    /// For each fan the vertex of the mesh: those of the polygons, then duplicates.
    home: Vec<u32>,
    /// For each duplicate the vertex it duplicates, and whether that is because of a crowded edge.
    duplicates: Vec<(u32, bool)>,
}

/// Makes the mesh from oriented polygons, and says which vertex each duplicate at its end duplicates.
pub(super) fn mesh(
    polygons: &Polygons,
    edges: &Edges,
    report: &mut Report,
    stop: &Stop,
) -> Result<(Mesh, Vec<u32>), BuildError> {
    let mut apart = vec![false; polygons.len()];
    for round in 0..ROUNDS + 2 {
        let (pairs, crowded) = edges.pairs(polygons, &apart, stop)?;
        let mut tangled = vec![false; polygons.positions.len()];
        for &h in crowded.iter().copied().flatten() {
            tangled[polygons.corners[h as usize] as usize] = true;
            tangled[polygons.corners[next(polygons, &edges.face, h) as usize] as usize] = true;
        }
        let fans = Fans::new(polygons, edges, &pairs, &tangled, &apart, stop)?;
        match fans.mesh(polygons, edges, &pairs, stop)? {
            Rings::Mesh(mesh) => {
                fans.report(polygons, edges, &crowded, report);
                return Ok((mesh, fans.duplicates.iter().map(|&(v, _)| v).collect()));
            }
            Rings::Parallel(faces) if round < ROUNDS => faces.into_iter().for_each(|f| apart[f as usize] = true),
            // Then no face that touches a crowded edge has a neighbour, so no ring can name a vertex twice any more.
            Rings::Parallel(_) => {
                for (f, apart) in apart.iter_mut().enumerate() {
                    *apart |= polygons.face(f).iter().any(|&v| tangled[v as usize]);
                }
            }
        }
    }
    // Not reached, see above; an error is better than trying for ever.
    let message = "some faces run along an edge so often that they cannot be told apart";
    Err(BuildError::refused(None, Diagnostic::new(Severity::Error, None, message)))
}

enum Rings {
    Mesh(Mesh),
    /// Some ring would name a vertex twice: the faces along those two edges.
    Parallel(Vec<u32>),
}

impl Fans {
    fn new(
        polygons: &Polygons,
        edges: &Edges,
        pairs: &[u32],
        tangled: &[bool],
        apart: &[bool],
        stop: &Stop,
    ) -> Result<Self, Stopped> {
        let face = &edges.face;
        let mut fans: Vec<Fan> = Vec::with_capacity(polygons.positions.len());
        let mut of_corner = vec![NONE; face.len()];
        for first in 0..face.len() as u32 {
            if of_corner[first as usize] != NONE {
                continue;
            }
            stop.check()?;
            // Clockwise to the end, if there is one …
            let mut start = first;
            let closed = loop {
                match pairs[start as usize] {
                    NONE => break false,
                    twin => start = next(polygons, face, twin),
                }
                if start == first {
                    break true;
                }
            };
            // … then counter-clockwise over all.
            let id = fans.len() as u32;
            let mut fan = Fan { start, vertex: polygons.corners[first as usize], closed, len: 0 };
            let mut corner = start;
            loop {
                of_corner[corner as usize] = id;
                fan.len += 1;
                corner = pairs[previous(polygons, face, corner) as usize];
                if corner == NONE || corner == start {
                    break;
                }
            }
            fans.push(fan);
        }
        let mut fans =
            Self { fans, of_corner, home: Vec::with_capacity(polygons.positions.len()), duplicates: Vec::new() };
        fans.settle(edges, polygons.positions.len(), tangled, apart, stop)?;
        Ok(fans)
    }

    /// Decides which fans share a vertex: the open ones do, unless a crowded edge ends there. The first fan keeps the
    /// vertex it had.
    fn settle(
        &mut self,
        edges: &Edges,
        vertices: usize,
        tangled: &[bool],
        apart: &[bool],
        stop: &Stop,
    ) -> Result<(), Stopped> {
        stop.check()?;
        let mut taken = vec![false; vertices];
        let mut open_home = vec![NONE; vertices];
        for fan in &self.fans {
            let v = fan.vertex as usize;
            let crowded = tangled[v] || apart[edges.face[fan.start as usize] as usize];
            let shares = !fan.closed && !crowded;
            if shares && open_home[v] != NONE {
                self.home.push(open_home[v]);
                continue;
            }
            let home = if taken[v] {
                self.duplicates.push((fan.vertex, crowded));
                (vertices + self.duplicates.len() - 1) as u32
            } else {
                fan.vertex
            };
            taken[v] = true;
            if shares {
                open_home[v] = home;
            }
            self.home.push(home);
        }
        Ok(())
    }

    fn mesh(&self, polygons: &Polygons, edges: &Edges, pairs: &[u32], stop: &Stop) -> Result<Rings, BuildError> {
        let face = &edges.face;
        let vertex = |corner: u32| Vertex::from_index(self.home[self.of_corner[corner as usize] as usize] as usize);
        let mut positions = Vec::with_capacity(polygons.positions.len() + self.duplicates.len());
        positions.extend_from_slice(&polygons.positions);
        positions.extend(self.duplicates.iter().map(|&(v, _)| polygons.positions[v as usize]));
        // An open fan has a neighbour more than faces, and a gap.
        let mut lens = vec![0; positions.len()];
        for (fan, &home) in self.fans.iter().zip(&self.home) {
            lens[home as usize] += fan.len + if fan.closed { 0 } else { 2 };
        }
        let mut mesh = Mesh::with_room(positions, &lens).map_err(|_| full())?;
        drop(lens);
        // The fans of each vertex, in order.
        let mut by_home: Vec<u32> = (0..self.fans.len() as u32).collect();
        by_home.sort_by_key(|&f| self.home[f as usize]); // stable
        let mut parallel = Vec::new();
        let mut items = Vec::new();
        for group in by_home.chunk_by(|&f, &g| self.home[f as usize] == self.home[g as usize]) {
            stop.check()?;
            let Some(v) = Vertex::from_index(self.home[group[0] as usize] as usize) else { return Err(full()) };
            items.clear();
            for fan in group.iter().map(|&f| &self.fans[f as usize]) {
                let mut corner = fan.start;
                loop {
                    items.push(vertex(next(polygons, face, corner)));
                    let before = previous(polygons, face, corner);
                    if pairs[before as usize] == NONE {
                        items.extend([vertex(before), None]);
                        break;
                    }
                    corner = pairs[before as usize];
                    if corner == fan.start {
                        break;
                    }
                }
            }
            match mesh.make(v, &items) {
                Ok(()) => {}
                Err(EditError::Full(_)) => return Err(full()),
                Err(EditError::Twice(x) | EditError::OwnNeighbour(x)) => {
                    self.faces_between(polygons, edges, pairs, group, x, &mut parallel);
                }
            }
        }
        Ok(if parallel.is_empty() { Rings::Mesh(mesh) } else { Rings::Parallel(parallel) })
    }

    /// The faces of fans that have an edge to `x`.
    fn faces_between(
        &self,
        polygons: &Polygons,
        edges: &Edges,
        pairs: &[u32],
        fans: &[u32],
        x: Vertex,
        faces: &mut Vec<u32>,
    ) {
        let is_x = |corner: u32| self.home[self.of_corner[corner as usize] as usize] as usize == x.index();
        for fan in fans.iter().map(|&f| &self.fans[f as usize]) {
            let mut corner = fan.start;
            for _ in 0..fan.len {
                let before = previous(polygons, &edges.face, corner);
                if is_x(next(polygons, &edges.face, corner)) || is_x(before) {
                    faces.push(edges.face[corner as usize]);
                }
                corner = pairs[before as usize];
                if corner == NONE {
                    break;
                }
            }
        }
    }

    fn report(&self, polygons: &Polygons, edges: &Edges, crowded: &[&[u32]], report: &mut Report) {
        let n = polygons.positions.len();
        let name = |home: usize| Vertex::from_index(home).map_or_else(String::new, |v| v.to_string());
        let (doubled, pinched): (Vec<usize>, Vec<usize>) =
            (0..self.duplicates.len()).partition(|&i| self.duplicates[i].1);
        edges.report_crowded(polygons, crowded, doubled.len(), report);
        if !pinched.is_empty() {
            let message = format!(
                "several fans of faces met in one vertex; {} split off so that each has its own",
                if pinched.len() == 1 {
                    "1 vertex was".to_owned()
                } else {
                    format!("{} were", vertices(pinched.len()))
                }
            );
            let diagnostic = quote(warning(message), pinched.len(), |i| {
                format!("{} splits off {}", name(n + pinched[i]), vertex_name(self.duplicates[pinched[i]].0))
            });
            report
                .repairs
                .push(diagnostic.about(pinched.iter().filter_map(|&i| Vertex::from_index(n + i)).take(DRAWN)));
        }
        let mut open = vec![0u32; n + self.duplicates.len()];
        for (fan, &home) in self.fans.iter().zip(&self.home) {
            open[home as usize] += u32::from(!fan.closed);
        }
        let ambiguous: Vec<usize> = (0..open.len()).filter(|&v| open[v] > 2).collect();
        if !ambiguous.is_empty() {
            let message = format!(
                "three or more open fans of faces meet in {}; their cyclic order is not known, they stand in the order \
                of their first faces",
                vertices(ambiguous.len())
            );
            let diagnostic = quote(warning(message), ambiguous.len(), |i| {
                format!("{}: {} fans", name(ambiguous[i]), open[ambiguous[i]])
            });
            report.remarks.push(diagnostic.about(ambiguous.iter().filter_map(|&v| Vertex::from_index(v)).take(DRAWN)));
        }
    }
}
