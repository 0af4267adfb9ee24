//! `vv mesh diff`

use std::path::PathBuf;

use app::evaluation::within;
use clap::Args;
use serde::Serialize;
use vv::mesh::Mesh;
use vv::mesh::faces::degrees;
use vv::mesh::isomorphism::isomorphism;
use vv::mesh::statistics::{Statistics, statistics};
use vv::stop::{Stop, Stopped};

use super::info::{counts, json};
use super::report::{Reporter, write_stdout};
use super::{EXIT_CODES, Exit, Importing, Reporting, error, fail, input, tolerance};

/// What `vv mesh diff` takes.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Arguments {
    /// A mesh; `-` is stdin, in any format.
    a: PathBuf,
    /// Another one.
    b: PathBuf,
    /// How far a vertex may be from where it should be.
    #[arg(long, value_name = "DISTANCE", default_value_t = 1e-9, allow_negative_numbers = true, value_parser = tolerance)]
    tolerance: f64,
    /// Write one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    importing: Importing,
    #[command(flatten)]
    reporting: Reporting,
}

/// What was found.
#[derive(Serialize)]
struct Comparison {
    /// The same rings, and no vertex too far off.
    same: bool,
    /// The same rings up to the numbers of vertices.
    same_connectivity: bool,
    /// The same if one is turned inside out.
    same_inside_out: bool,
    /// Of the vertex that is farthest off where the connectivity is the same.
    distance: Option<f64>,
    /// That vertex, in either mesh, counted from 1.
    vertices: Option<[usize; 2]>,
    /// Counts that are not the same: of the one, of the other.
    counts: Vec<Count>,
}

#[derive(Serialize)]
struct Count {
    of: &'static str,
    a: String,
    b: String,
}

/// Says how they differ, if they do.
pub fn diff(arguments: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let (a, _) = input::mesh(&arguments.a, &arguments.importing, &reporter)?;
    let (b, _) = input::mesh(&arguments.b, &arguments.importing, &reporter)?;
    let compared = within(arguments.importing.timeout.0, |stop| compare(&a, &b, arguments.tolerance, stop));
    let comparison = match compared {
        Ok(comparison) => comparison,
        Err(stopped) => return fail(&reporter, Exit::Budget, error(stopped.to_string())),
    };
    let text = if arguments.json { json(&comparison) } else { sentences(&comparison) };
    write_stdout(text.as_bytes(), &reporter)?;
    if comparison.same { Ok(()) } else { Err(Exit::Different) }
}

fn compare(a: &Mesh, b: &Mesh, tolerance: f64, stop: &Stop) -> Result<Comparison, Stopped> {
    let of = |mesh: &Mesh| statistics(mesh, degrees(mesh, stop)?, stop);
    let differing = differing(&of(a)?, &of(b)?);
    let found = if differing.is_empty() { isomorphism(a, b, tolerance, false, stop)? } else { None };
    let farthest = found.as_ref().and_then(|found| found.farthest);
    let image = farthest.and_then(|(v, _)| found.as_ref()?.images[v.index()]);
    let same = found.is_some() && farthest.is_none_or(|(_, distance)| distance <= tolerance);
    let turned = found.is_none() && differing.is_empty() && isomorphism(a, b, tolerance, true, stop)?.is_some();
    Ok(Comparison {
        same,
        same_connectivity: found.is_some(),
        same_inside_out: turned,
        distance: farthest.map(|(_, distance)| distance),
        vertices: farthest.zip(image).map(|((v, _), image)| [v.index() + 1, image.index() + 1]),
        counts: differing,
    })
}

fn differing(a: &Statistics, b: &Statistics) -> Vec<Count> {
    let both = counts(a).into_iter().zip(counts(b));
    both.filter(|(a, b)| a.1 != b.1).map(|((of, a), (_, b))| Count { of, a, b }).collect()
}

fn sentences(c: &Comparison) -> String {
    let place = |[a, b]: [usize; 2]| format!("v{a} of the one and v{b} of the other");
    match (c.distance, c.vertices) {
        _ if !c.counts.is_empty() => {
            let width = c.counts.iter().map(|count| count.of.len()).max().unwrap_or_default();
            let row = |Count { of, a, b }: &Count| format!("{of:width$}  {a}  ≠  {b}\n");
            c.counts.iter().map(row).collect()
        }
        _ if c.same_inside_out => "the same connectivity, but one is the other turned inside out\n".to_owned(),
        _ if !c.same_connectivity => "as many of everything, but another connectivity\n".to_owned(),
        (Some(distance), Some(vertices)) if !c.same => {
            format!("the same connectivity, but {} are {distance:e} apart\n", place(vertices))
        }
        (Some(distance), Some(vertices)) if distance > 0.0 => {
            format!("the same: {} are farthest apart, by {distance:e}\n", place(vertices))
        }
        _ => "the same\n".to_owned(),
    }
}
