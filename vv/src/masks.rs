//! The masks of a rule: with which weights a step makes new positions of old ones, found by running it.
//!
//! Where positions are affine in the old ones,
//!
//! ```text
//!   new = Σ w · old      Σ w = 1
//! ```
//!
//! moving one old vertex by a unit moves each new one by its weight there. Three vertices are moved in one run, along three
//! axes, and one more run with all of them elsewhere shows whether the rule is affine at all. (Smith, Prusinkiewicz and
//! Samavati draw masks as the right-hand sides of their Figures 7, 8 and 10.)

mod star;
mod vertex;

use glam::DVec3;

use crate::engine::{Failure, FailureKind, Machine, Settings};
use crate::ir::FunctionId;
use crate::mesh::close::close;
use crate::mesh::{Mesh, Vertex};

pub use star::{Around, Class, Judgement, Place, Star, classes, judge, same_classes};
pub use vertex::{VertexMask, measure_vertex};

/// Weights below this are none, and positions closer than this are the same.
pub const TOLERANCE: f64 = 1e-11;

/// What a step makes of a mesh, as weights of its vertices.
#[derive(Debug, Clone)]
pub struct Masks {
    /// The mesh after the step, closed.
    pub result: Mesh,
    /// So many vertices of the result are old ones, the first: those that the step has left in the set.
    pub survivors: usize,
    /// For each vertex of the result, by its index, the old vertices that it is made of and their weights, in the order
    /// of their numbers.
    pub weights: Vec<Vec<(Vertex, f64)>>,
    /// What keeps these from being masks.
    pub faults: Vec<Fault>,
}

/// What keeps weights from being a mask.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Fault {
    /// Moving the mesh would not move it along.
    #[error("the weights of {vertex} sum to {}, not to 1", shown(*.sum, DECIMALS))]
    Sum {
        /// The new vertex.
        vertex: Vertex,
        /// The sum.
        sum: f64,
    },
    /// Something else than weighted sums.
    #[error("{vertex} is not affine in the old positions: off by {distance:.1e} from the sum of its weights")]
    NotAffine {
        /// The new vertex.
        vertex: Vertex,
        /// How far it is from where the weights put it.
        distance: f64,
    },
    /// Other neighbours when vertices lie elsewhere.
    #[error("the connectivity depends on the positions")]
    Connectivity,
    /// Too many vertices have a part in it.
    #[error("{vertex} depends on more than {most} old vertices")]
    Wide {
        /// The new vertex.
        vertex: Vertex,
        /// As many as were looked at.
        most: usize,
    },
    /// There is a left and a right in the rule.
    #[error("the masks are not symmetric: a mirror image has others")]
    Asymmetric,
    /// `start` takes the surroundings apart.
    #[error("`start` changes what is around the vertex, so these are the masks of the rule without it")]
    Start,
    /// What comes first comes out otherwise.
    #[error("the masks depend on the order of the vertices")]
    Order,
}

/// Measures the masks of `rule` on `mesh`, as generation 1. Output is thrown away. Cost: a step for every three vertices.
///
/// # Errors
/// As [`Machine::run`].
pub fn measure(machine: &Machine, rule: FunctionId, mesh: &Mesh, settings: &Settings) -> Result<Masks, Failure> {
    let step = |mesh: &Mesh| step(machine, rule, mesh, 1, settings);
    let (result, survivors) = step(mesh)?;
    let mut weights = vec![Vec::new(); result.vertex_count()];
    let mut faults = Vec::new();
    let old: Vec<Vertex> = mesh.vertices().collect();
    for three in old.chunks(3) {
        let mut moved = mesh.clone();
        for (&v, axis) in three.iter().zip(DVec3::AXES) {
            moved.set_position(v, mesh.position(v) + axis);
        }
        let (moved, _) = step(&moved)?;
        if !same_rings(&result, &moved) {
            return Ok(Masks { result, survivors, weights, faults: vec![Fault::Connectivity] });
        }
        for (mask, (to, from)) in weights.iter_mut().zip(moved.positions().iter().zip(result.positions())) {
            let by = (*to - *from).to_array();
            mask.extend(three.iter().copied().zip(by).filter(|(_, w)| w.is_nan() || w.abs() > TOLERANCE));
        }
    }
    // Somewhere quite else: no two vertices along a line with the origin.
    let mut elsewhere = mesh.clone();
    for &v in &old {
        elsewhere.set_position(v, scattered(v));
    }
    let (there, _) = step(&elsewhere)?;
    if !same_rings(&result, &there) {
        faults.push(Fault::Connectivity);
    }
    for (vertex, mask) in result.vertices().zip(&weights).filter(|(v, _)| result.set.contains(*v)) {
        let sum: f64 = mask.iter().map(|(_, w)| w).sum();
        // Each weight has its own error.
        let some = TOLERANCE * (1.0 + mask.len() as f64);
        if sum.is_nan() || (sum - 1.0).abs() > some {
            faults.push(Fault::Sum { vertex, sum });
        } else if there.vertex_count() == result.vertex_count() {
            let expected: DVec3 = mask.iter().map(|&(v, w)| w * elsewhere.position(v)).sum();
            let distance = there.position(vertex).distance(expected);
            if distance.is_nan() || distance > 10.0 * some {
                faults.push(Fault::NotAffine { vertex, distance });
            }
        }
    }
    Ok(Masks { result, survivors, weights, faults })
}

/// A step, closed; and how many of the old vertices are left, which are its first.
fn step(
    machine: &Machine,
    rule: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
) -> Result<(Mesh, usize), Failure> {
    let mut result = machine.run(rule, mesh, generation, settings, &mut Vec::new())?;
    let survivors = mesh.vertices().filter(|&v| result.set.contains(v)).count();
    close(&mut result, &settings.stop).map_err(|stopped| Failure {
        kind: FailureKind::Stopped(stopped),
        diagnostic: Box::new(crate::diagnostic::Diagnostic::new(
            crate::diagnostic::Severity::Error,
            None,
            stopped.to_string(),
        )),
    })?;
    Ok((result, survivors))
}

/// A place of its own for each vertex; no two of them lie along a line with the origin.
fn scattered(v: Vertex) -> DVec3 {
    let i = v.index() as f64 + 1.0;
    4.0 * DVec3::new((i * 0.754_877_666).fract(), (i * 0.569_840_291).fract(), (i * 0.362_3).fract()) - 1.5
}

fn same_rings(a: &Mesh, b: &Mesh) -> bool {
    a.vertex_count() == b.vertex_count() && a.vertices().all(|v| a.ring(v).slots() == b.ring(v).slots())
}

/// A number as the fraction that it is, to 1e-12, if it is one with a denominator up to 10,000: `3/8`, `-1/16`, `1`.
#[must_use]
pub fn fraction(x: f64) -> Option<String> {
    const MOST: f64 = 10_000.0;
    if !x.is_finite() || x.abs() > MOST {
        return None;
    }
    // The convergents of its continued fraction.
    let (mut p, mut q, mut rest) = ([1.0, x.floor()], [0.0, 1.0], x - x.floor());
    loop {
        if (x - p[1] / q[1]).abs() <= 1e-12 {
            return Some(if q[1] == 1.0 { format!("{}", p[1]) } else { format!("{}/{}", p[1], q[1]) });
        }
        let whole = (1.0 / rest).floor();
        rest = 1.0 / rest - whole;
        (p, q) = ([p[1], whole * p[1] + p[0]], [q[1], whole * q[1] + q[0]]);
        if q[1].is_nan() || q[1] > MOST {
            return None;
        }
    }
}

/// Decimals that a measurement is good for.
pub const DECIMALS: usize = 12;

/// A weight as people write it: as a [`fraction`] if it is one, else with so many decimals, without zeros at their end.
#[must_use]
pub fn shown(weight: f64, decimals: usize) -> String {
    let weight = weight + 0.0; // -0 is 0 to a reader
    fraction(weight).unwrap_or_else(|| {
        let text = format!("{weight:.decimals$}");
        if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fractions_are_found() {
        let cases = [
            (0.375, Some("3/8")),
            (-0.0625, Some("-1/16")),
            (1.0, Some("1")),
            (0.0, Some("0")),
            (1.0 / 3.0, Some("1/3")),
            (2.0 / 3.0 + 1e-14, Some("2/3")),
            (-7.0 / 36.0, Some("-7/36")),
            (9.0 / 1024.0, Some("9/1024")),
            (std::f64::consts::FRAC_1_SQRT_2, None),
            (1e300, None),
            (f64::NAN, None),
        ];
        for (x, expected) in cases {
            assert_eq!(fraction(x).as_deref(), expected, "{x}");
        }
    }

    #[test]
    fn weights_are_shown_to_what_was_measured() {
        let cases = [
            (0.749_999_999_999_999_9, "3/4"),
            (0.1 + 0.2, "3/10"),
            (-0.0, "0"),
            (std::f64::consts::FRAC_1_SQRT_2, "0.707106781187"),
            (1.0 + 1e-10, "1.0000000001"),
            (12_345.5, "12345.5"),
            (1e20, "100000000000000000000"),
            (f64::NAN, "NaN"),
            (f64::NEG_INFINITY, "-inf"),
        ];
        for (x, expected) in cases {
            assert_eq!(shown(x, DECIMALS), expected);
        }
    }
}
