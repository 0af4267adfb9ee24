//! What a file cannot hold of a mesh: said when it is written.

use super::{Format, color, gltf, obj, ply};
use crate::diagnostic::{Diagnostic, Severity};
use crate::mesh::{Mesh, Property, Type, Value, Values};

/// Most names that are said of one kind.
const MOST_NAMED: usize = 8;

/// What a property is of.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Of {
    Vertices,
    Edges,
    Whole,
}

impl Of {
    fn name(self) -> &'static str {
        match self {
            Self::Vertices => "the vertices",
            Self::Edges => "the edges",
            Self::Whole => "the mesh",
        }
    }
}

/// Why a property is left out.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Why {
    /// It holds vertices, which no format does.
    Vertices,
    /// The format has no place for it.
    Format,
    /// In the format its name stands for something else.
    Name,
}

/// One for each kind of thing and reason: a warning, or a note of what a program keeps in the mesh. What has nothing but its
/// default is no loss.
pub(super) fn losses(mesh: &Mesh, format: Format) -> Vec<Diagnostic> {
    let mut diagnostics = Vec::new();
    for of in [Of::Vertices, Of::Edges, Of::Whole] {
        let lost = lost(mesh, format, of);
        for why in [Why::Format, Why::Name, Why::Vertices] {
            let names: Vec<_> = lost.iter().filter(|lost| lost.why == why).map(|lost| lost.name).collect();
            if !names.is_empty() {
                let mut same = lost.iter().filter(|lost| lost.why == why);
                let in_gltf = same.all(|lost| gltf::holds(of, lost.name, lost.ty));
                diagnostics.push(warning(of, why, &names, format, in_gltf));
            }
        }
        let rounded = rounded(mesh, format, of);
        if !rounded.is_empty() {
            diagnostics.push(rounding(of, &rounded, format));
        }
        if let Some(v) = joined(mesh, of).filter(|_| is_ply(format)) {
            let (of, files) = (of.name(), files(format));
            let message = format!("`{v}_x`, `{v}_y` and `{v}_z` of {of} are the vector `{v}` to who reads {files}");
            diagnostics.push(super::warning(message).hint("other names would stay apart"));
        }
    }
    let wires = if format == Format::Obj { 0 } else { obj::wires(mesh) };
    if wires > 0 {
        let (edges, are) = if wires == 1 { ("edge", "is") } else { ("edges", "are") };
        let message = format!("{wires} {edges} without faces {are} not written: {} have faces alone", files(format));
        diagnostics.push(super::warning(message).hint("`.obj` files have room for lines"));
    }
    diagnostics
}

/// A property that is left out.
struct Lost<'a> {
    name: &'a str,
    ty: Type,
    why: Why,
}

fn lost(mesh: &Mesh, format: Format, of: Of) -> Vec<Lost<'_>> {
    let in_ply = if is_ply(format) { ply::kept(mesh, of) } else { Vec::new() };
    let holds = |i: usize, name: &str, ty: Type| match format {
        Format::Obj => obj::holds(of, name, ty),
        Format::Off => of == Of::Vertices && color::is_color(name, ty),
        Format::Ply | Format::PlyText | Format::PlyBigEndian => in_ply.contains(&i),
        Format::Stl | Format::StlText => false,
        Format::Glb | Format::Gltf => gltf::holds(of, name, ty),
    };
    let left_out = properties(mesh, of).into_iter().enumerate().filter(|&(i, (name, ty))| !holds(i, name, ty));
    let told = left_out.filter(|&(i, _)| tells(mesh, of, i));
    told.map(|(_, (name, ty))| {
        let why = if ty == Type::Vertex {
            Why::Vertices
        } else if is_ply(format) {
            Why::Name
        } else {
            Why::Format
        };
        Lost { name, ty, why }
    })
    .collect()
}

/// The names of what is written, but of which not every int is kept.
fn rounded(mesh: &Mesh, format: Format, of: Of) -> Vec<&str> {
    let kept = |x: i64| match format {
        Format::Glb | Format::Gltf => whole(f64::from(x as f32)) == Some(x),
        _ => whole(x as f64) == Some(x),
    };
    let written: Vec<usize> = match format {
        Format::Ply | Format::PlyText | Format::PlyBigEndian => ply::kept(mesh, of),
        Format::Glb | Format::Gltf if of == Of::Vertices => (0..mesh.vertex_properties().len()).collect(),
        _ => Vec::new(),
    };
    let column = |properties: &'_ [Property], i: usize| match properties.get(i).map(|p| &p.values) {
        Some(Values::Int(column)) => column.iter().all(|&x| kept(x)),
        _ => true,
    };
    let is_kept = |i: usize| match of {
        Of::Vertices => column(mesh.vertex_properties(), i),
        Of::Edges => column(mesh.edge_properties(), i),
        Of::Whole => !matches!(mesh.mesh_properties().get(i), Some(&(_, Value::Int(x))) if !kept(x)),
    };
    let names = properties(mesh, of);
    written.into_iter().filter(|&i| !is_kept(i)).filter_map(|i| names.get(i).map(|(name, _)| *name)).collect()
}

/// The int that a double is; 2^63, which is none, is what the greatest ints are rounded to.
fn whole(x: f64) -> Option<i64> {
    (x < -(i64::MIN as f64)).then_some(x as i64)
}

/// Names and types.
fn properties(mesh: &Mesh, of: Of) -> Vec<(&str, Type)> {
    let all = |properties| <[Property]>::iter(properties).map(|p| (p.name.as_str(), p.values.ty())).collect();
    match of {
        Of::Vertices => all(mesh.vertex_properties()),
        Of::Edges => all(mesh.edge_properties()),
        Of::Whole => mesh.mesh_properties().iter().map(|(name, value)| (name.as_str(), value.ty())).collect(),
    }
}

fn is_ply(format: Format) -> bool {
    matches!(format, Format::Ply | Format::PlyText | Format::PlyBigEndian)
}

/// Of three numbers `v_x`, `v_y` and `v_z`, which PLY cannot tell from a vector, its name.
fn joined(mesh: &Mesh, of: Of) -> Option<String> {
    let all = properties(mesh, of);
    let is_number = |name: String| all.contains(&(name.as_str(), Type::Double));
    let vectors = all.iter().filter(|(_, ty)| *ty == Type::Double).filter_map(|(name, _)| name.strip_suffix("_x"));
    let mut joined = vectors.filter(|v| ["_y", "_z"].into_iter().all(|axis| is_number(format!("{v}{axis}"))));
    joined.next().map(str::to_owned)
}

/// Whether a property has another value than its default, somewhere.
fn tells(mesh: &Mesh, of: Of, i: usize) -> bool {
    match of {
        Of::Vertices => {
            let default = mesh.vertex_properties().get(i).map(|p| p.default);
            mesh.set.iter().any(|v| mesh.vertex_value(i, v) != default)
        }
        Of::Edges => {
            let default = mesh.edge_properties().get(i).map(|p| p.default);
            mesh.set.iter().any(|p| mesh.edge_values(i, p).any(|(q, x)| Some(x) != default && mesh.set.contains(q)))
        }
        Of::Whole => mesh.mesh_properties().get(i).is_some_and(|(_, value)| *value != Value::zero(value.ty())),
    }
}

fn warning(of: Of, why: Why, names: &[&str], format: Format, in_gltf: bool) -> Diagnostic {
    let what = listed(names);
    let of = of.name();
    let (is, it, names) =
        if names.len() == 1 { ("is", "it", "its name stands") } else { ("are", "them", "their names stand") };
    let files = files(format);
    let because = match why {
        Why::Format => format!("{files} have no place for {it}"),
        Why::Name => format!("{names} for something else in {files}"),
        Why::Vertices => "no format holds vertices as values".to_owned(),
    };
    // What a program keeps in the mesh is for its own next steps; seldom is the file stepped.
    let severity = if of == Of::Whole.name() { Severity::Note } else { Severity::Warning };
    let warning = Diagnostic::new(severity, None, format!("{what} of {of} {is} not written: {because}"));
    match why {
        Why::Format if severity == Severity::Note => {
            warning.hint(format!("who goes on from the file begins without; `.ply` files keep {it}"))
        }
        Why::Format if in_gltf => warning.hint(format!("`.ply` and `.glb` files keep {it}")),
        Why::Format => warning.hint(format!("`.ply` files keep {it}")),
        Why::Name => warning.hint("another name would be kept"),
        Why::Vertices => warning,
    }
}

fn rounding(of: Of, names: &[&str], format: Format) -> Diagnostic {
    let (what, of, are) = (listed(names), of.name(), if names.len() == 1 { "is" } else { "are" });
    let in_gltf = matches!(format, Format::Glb | Format::Gltf);
    let bits = if in_gltf { 24 } else { 53 };
    let message = format!("{what} of {of} {are} rounded: {} keep whole numbers up to 2^{bits}", files(format));
    let warning = super::warning(message);
    if in_gltf { warning.hint("`.ply` files keep them up to 2^53") } else { warning }
}

/// `a`, `b` and `c`.
fn listed(names: &[&str]) -> String {
    let shown: Vec<_> = names.iter().take(MOST_NAMED).map(|name| format!("`{name}`")).collect();
    match (shown.split_last(), names.len().saturating_sub(MOST_NAMED)) {
        (Some((last, [])), 0) => last.clone(),
        (Some((last, before)), 0) => format!("{} and {last}", before.join(", ")),
        (_, more) => format!("{} and {more} more", shown.join(", ")),
    }
}

/// `.obj` files.
fn files(format: Format) -> String {
    format!("`.{}` files", format.extension())
}
