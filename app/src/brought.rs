//! What a mesh file brings and a program declares to be of another type.

use vv::builtins::type_name;
use vv::diagnostic::{Diagnostic, Severity};
use vv::ir::{Program, PropertyDeclaration};
use vv::mesh::{Mesh, Values};

/// A warning for each property of a program that cannot hold what the mesh has by its name, so that it begins as declared.
#[must_use]
pub fn lost(program: &Program, mesh: &Mesh) -> Vec<Diagnostic> {
    let vertices = mesh.vertex_properties().iter().map(|p| (p.name.as_str(), p.values.clone()));
    let edges = mesh.edge_properties().iter().map(|p| (p.name.as_str(), p.values.clone()));
    let whole = mesh.mesh_properties().iter().map(|(name, value)| (name.as_str(), Values::filled(*value, 1)));
    let of_vertices = among(&program.vertex_properties, vertices, "vertices");
    let of_edges = among(&program.edge_properties, edges, "edges");
    of_vertices.into_iter().chain(of_edges).chain(among(&program.mesh_properties, whole, "the mesh")).collect()
}

fn among<'a>(
    declared: &[PropertyDeclaration],
    brought: impl Iterator<Item = (&'a str, Values)>,
    of: &str,
) -> Vec<Diagnostic> {
    let lost = |(name, values): (&str, Values)| {
        let declared = declared.iter().find(|declared| declared.name == name)?;
        let (ty, wanted) = (values.ty(), declared.default.ty());
        if ty == wanted || values.converted(wanted).is_some() {
            return None;
        }
        let (ty, wanted) = (type_name(ty), type_name(wanted));
        let message =
            format!("`{name}` of {of} is `{ty}` in the mesh file and `{wanted}` in the program, which cannot hold it");
        let warning = Diagnostic::new(Severity::Warning, Some(declared.span), message);
        Some(warning.hint(format!("`{ty} {name};` keeps what the mesh says")))
    };
    brought.filter_map(lost).collect()
}
