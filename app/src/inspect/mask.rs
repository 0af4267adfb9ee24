//! The mask of a vertex: of which vertices of the generation before the step made it, and with which weights.

use vv::engine::{Failure, Settings};
use vv::masks::{Around, Fault, Star, fraction, judge, measure_vertex};
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

use super::measure::short;
use super::walk::face_left_of;
use crate::evaluation::machine_limits;
use crate::worker::Frame;

/// Weights closer than this are the same.
const SAME: f64 = 1e-10;
/// Valences up to which it is asked what the rule does around such a vertex.
const JUDGED: usize = 24;

/// The mask of a vertex.
#[derive(Debug, Clone, PartialEq)]
pub struct Mask {
    /// The vertex, in the generation that is shown.
    pub of: Vertex,
    /// The old vertices by their weights, the greatest first.
    pub groups: Vec<Group>,
    /// Whether weights are all there is to it; else it is only known which vertices it depends on, if at all.
    pub is_affine: bool,
    /// What keeps this from being a mask, in words.
    pub faults: Vec<String>,
}

/// Old vertices of one weight.
#[derive(Debug, Clone, PartialEq)]
pub struct Group {
    /// Their weight.
    pub weight: f64,
    /// Which, in the order of their numbers.
    pub vertices: Vec<Vertex>,
}

impl Group {
    /// The weight as the fraction that it is, else in some digits.
    #[must_use]
    pub fn text(&self) -> String {
        fraction(self.weight).unwrap_or_else(|| short(self.weight)).replace('-', "−")
    }
}

impl Mask {
    /// The old vertices and their groups.
    pub fn weights(&self) -> impl Iterator<Item = (Vertex, &Group)> {
        self.groups.iter().flat_map(|group| group.vertices.iter().map(move |&v| (v, group)))
    }

    /// Of a vertex of a frame, by running its step again and again. `None` where no step made the mesh, or the mesh before
    /// it is not kept. Cost: that of [`measure_vertex`], for another thread than the window's.
    ///
    /// # Errors
    /// As [`measure_vertex`].
    pub fn measure(frame: &Frame, v: Vertex, stop: &Stop) -> Option<Result<Self, Failure>> {
        let (made, old) = (frame.made.as_ref()?, frame.before.as_ref()?);
        let settings = Settings {
            params: made.params.clone(),
            limits: machine_limits(),
            stop: stop.clone(),
            ..Settings::default()
        };
        let generation = frame.request.generation;
        let found = measure_vertex(&made.machine, made.rule, old, generation, v, &settings);
        Some(found.map(|found| {
            let not_affine = |fault: &Fault| !matches!(fault, Fault::Sum { .. });
            let is_affine = !found.faults.iter().any(not_affine);
            let mut faults: Vec<String> = found.faults.iter().map(ToString::to_string).collect();
            let groups = groups(found.weights);
            let middle = groups.first().and_then(|group| group.vertices.first()).filter(|_| is_affine);
            if let Some((star, around)) = middle.and_then(|&p| surroundings(old, p))
                && let Ok(judged) = judge(&made.machine, made.rule, &star, &settings)
            {
                // The others are told of this vertex itself.
                let told = judged
                    .faults
                    .iter()
                    .filter(|fault| matches!(fault, Fault::Asymmetric | Fault::Order | Fault::Start));
                faults.extend(told.map(|fault| format!("{around}: {fault}")));
            }
            Self { of: v, groups, is_affine, faults }
        }))
    }
}

fn groups(mut weights: Vec<(Vertex, f64)>) -> Vec<Group> {
    weights.sort_by(|a, b| b.1.total_cmp(&a.1));
    let mut groups: Vec<Group> = Vec::new();
    for (v, weight) in weights {
        match groups.last_mut().filter(|group| (group.weight - weight).abs() <= SAME) {
            Some(group) => group.vertices.push(v),
            None => groups.push(Group { weight, vertices: vec![v] }),
        }
    }
    groups.iter_mut().for_each(|group| group.vertices.sort_unstable());
    groups
}

/// A vertex as this one among regular ones, and what is around it; `None` where faces of several kinds meet.
fn surroundings(mesh: &Mesh, p: Vertex) -> Option<(Star, String)> {
    let ring = mesh.ring(p);
    if ring.valence() > JUDGED || ring.gaps() > 1 {
        return None;
    }
    let sides: Vec<usize> = ring.vertices().filter_map(|q| Some(face_left_of(mesh, [p, q])?.len())).collect();
    let boundary = ring.gaps() == 1;
    let sectors = ring.valence().checked_sub(usize::from(boundary))?;
    let (around, name) = match *sides.first()? {
        3 => (Around::Triangles, "triangles"),
        4 => (Around::Quads, "quads"),
        _ => return None,
    };
    if sides.len() != sectors || sides.iter().any(|n| *n != sides[0]) || sectors < if boundary { 1 } else { 3 } {
        return None;
    }
    let place = if boundary { "at a boundary vertex" } else { "around a vertex" };
    let words = format!("{place} of valence {} among {name}", ring.valence());
    Some((Star::new(sectors, around, boundary)?, words))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vertices_of_one_weight_stand_together() {
        let v = |number: usize| Vertex::from_index(number - 1).unwrap();
        let weights = vec![(v(4), 0.125), (v(9), 0.375), (v(2), 0.375 + 1e-14), (v(3), 0.125), (v(1), -1.0 / 16.0)];
        let found: Vec<(String, Vec<Vertex>)> =
            groups(weights).into_iter().map(|group| (group.text(), group.vertices)).collect();
        let expected = [("3/8", vec![v(2), v(9)]), ("1/8", vec![v(3), v(4)]), ("−1/16", vec![v(1)])];
        assert_eq!(found, expected.map(|(text, vertices)| (text.to_owned(), vertices)));
    }
}
