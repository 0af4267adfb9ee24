//! `vv mesh info`

use std::collections::BTreeMap;
use std::path::PathBuf;

use clap::Args;
use serde::Serialize;
use vv::builtins::type_name;
use vv::mesh::faces::degrees;
use vv::mesh::statistics::{Statistics, statistics};
use vv::mesh::{Mesh, Property, Type};

use app::evaluation::within;

use super::report::{Reporter, write_stdout};
use super::{EXIT_CODES, Exit, Importing, Reporting, error, fail, input, warnings_of};

/// What `vv mesh info` takes.
#[derive(Debug, Args)]
#[command(after_help = EXIT_CODES)]
pub struct Arguments {
    /// The mesh; `-` is stdin, in any format.
    mesh: PathBuf,
    /// Write one JSON object.
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    importing: Importing,
    #[command(flatten)]
    reporting: Reporting,
}

#[derive(Serialize)]
struct Properties {
    vertex: BTreeMap<String, Type>,
    edge: BTreeMap<String, Type>,
    mesh: BTreeMap<String, Type>,
}

impl Properties {
    fn of(mesh: &Mesh) -> Self {
        let types = |properties: &[Property]| properties.iter().map(|p| (p.name.clone(), p.values.ty())).collect();
        Self {
            vertex: types(mesh.vertex_properties()),
            edge: types(mesh.edge_properties()),
            mesh: mesh.mesh_properties().iter().map(|(name, value)| (name.clone(), value.ty())).collect(),
        }
    }

    /// As programs declare them: `vertex { vec color; };`.
    fn rows(&self) -> impl Iterator<Item = (&'static str, String)> {
        let rows = [("vertex", &self.vertex), ("edge", &self.edge), ("mesh", &self.mesh)];
        rows.into_iter().filter(|(_, types)| !types.is_empty()).map(|(what, types)| {
            let declared: Vec<_> = types.iter().map(|(name, ty)| format!("{} {name};", type_name(*ty))).collect();
            (what, format!("{{ {} }};", declared.join(" ")))
        })
    }
}

#[derive(Serialize)]
struct Info {
    #[serde(flatten)]
    statistics: Statistics,
    /// Least and greatest coordinates; absent without vertices.
    bounds: Option<[[f64; 3]; 2]>,
    /// Names and types of the values that the file gives to vertices, edges and the whole.
    properties: Properties,
    warnings: Vec<String>,
}

/// Prints a table or a JSON object.
pub fn info(arguments: &Arguments) -> Result<(), Exit> {
    let reporter = Reporter::new(arguments.reporting.diagnostic_format);
    let (mesh, warnings) = input::mesh(&arguments.mesh, &arguments.importing, &reporter)?;
    let counted = within(arguments.importing.timeout.0, |stop| statistics(&mesh, degrees(&mesh, stop)?, stop));
    let statistics = match counted {
        Ok(statistics) => statistics,
        Err(stopped) => return fail(&reporter, Exit::Budget, error(stopped.to_string())),
    };
    let mut positions = mesh.set.iter().map(|v| mesh.position(v));
    let bounds = positions.next().map(|first| {
        positions.fold([first, first], |[least, greatest], p| [least.min(p), greatest.max(p)]).map(|p| p.to_array())
    });
    let warnings = warnings_of(&warnings);
    let info = Info { statistics, bounds, properties: Properties::of(&mesh), warnings };
    let text = if arguments.json { json(&info) } else { table(&info) };
    write_stdout(text.as_bytes(), &reporter)
}

/// The object on lines of its own.
pub fn json(object: &impl Serialize) -> String {
    // Only maps with keys that are no strings and failing `Serialize` implementations can fail; there are none.
    serde_json::to_string_pretty(object).unwrap_or_default() + "\n"
}

/// What is counted, each with its name.
pub fn counts(statistics: &Statistics) -> [(&'static str, String); 7] {
    let pairs = |pairs: &[(usize, usize)]| {
        let list = pairs.iter().map(|(what, count)| format!("{what}: {count}")).collect::<Vec<_>>().join(", ");
        if list.is_empty() { "none".to_owned() } else { list }
    };
    [
        ("vertices", statistics.vertices.to_string()),
        ("edges", statistics.edges.to_string()),
        ("faces", statistics.faces.to_string()),
        ("face degrees", pairs(&statistics.face_degrees)),
        ("valences", pairs(&statistics.valences)),
        ("components", statistics.components.to_string()),
        ("boundary loops", statistics.boundary_loops.to_string()),
    ]
}

fn table(Info { statistics, bounds, properties, .. }: &Info) -> String {
    let yes = |yes| if yes { "yes" } else { "no" }.to_owned();
    let mut rows = counts(statistics).to_vec();
    rows.extend([
        ("Euler characteristic", statistics.euler_characteristic.to_string()),
        ("genus", statistics.genus.map_or_else(|| "undefined".to_owned(), |genus| genus.to_string())),
        ("closed", yes(statistics.closed)),
        ("valid", yes(statistics.valid)),
    ]);
    if let Some(bounds) = bounds {
        let [least, greatest] = bounds.map(|[x, y, z]| format!("({x}, {y}, {z})"));
        rows.push(("bounds", format!("{least} to {greatest}")));
    }
    rows.extend(properties.rows());
    let width = rows.iter().map(|(name, _)| name.len()).max().unwrap_or_default();
    rows.iter().map(|(name, value)| format!("{name:width$}  {value}\n")).collect()
}
