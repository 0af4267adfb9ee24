//! Edits rings by hand: a vertex comes between two others, as by `insert` in Fig. 3 of Smith, Prusinkiewicz and
//! Samavati, and is joined to the corners on either side.

use std::error::Error;
use std::io::{self, Write};

use vv::glam::dvec3;
use vv::mesh::faces::faces;
use vv::mesh::validate::validate;
use vv::mesh::{Mesh, Vertex};
use vv::stop::Stop;

fn main() -> Result<(), Box<dyn Error>> {
    rings(&mut io::stdout().lock())
}

/// Prints the rings after each edit.
pub fn rings(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    // Two triangles abc and cda; where the surface is missing, the ring has a gap.
    let mut mesh = Mesh::new();
    let [a, b, c, d] = [mesh.create()?, mesh.create()?, mesh.create()?, mesh.create()?];
    for (v, x, y) in [(a, 0.0, 0.0), (b, 1.0, 0.0), (c, 1.0, 1.0), (d, 0.0, 1.0)] {
        mesh.set_position(v, dvec3(x, y, 0.0));
        mesh.set.add(v);
    }
    mesh.make(a, &[Some(b), Some(c), Some(d), None])?;
    mesh.make(b, &[Some(c), Some(a), None])?;
    mesh.make(c, &[Some(d), Some(a), Some(b), None])?;
    mesh.make(d, &[Some(a), Some(c), None])?;
    show("two triangles", &mesh, out)?;

    // x takes the place of each end in the ring of the other.
    let x = mesh.create()?;
    mesh.set_position(x, (mesh.position(a) + mesh.position(c)) / 2.0);
    mesh.set.add(x);
    mesh.make(x, &[Some(a), Some(c)])?;
    mesh.replace(Some(c), Some(x), a)?;
    mesh.replace(Some(a), Some(x), c)?;
    show("x between a and c", &mesh, out)?;

    // An edge takes an entry in both rings; with one of them the mesh is no surface.
    mesh.splice_after(Some(b), Some(a), x)?;
    show("x names b", &mesh, out)?;
    mesh.splice_after(Some(x), Some(c), b)?;
    mesh.splice_after(Some(d), Some(c), x)?;
    mesh.splice_after(Some(x), Some(a), d)?;
    show("four triangles", &mesh, out)
}

fn show(title: &str, mesh: &Mesh, out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let findings = validate(mesh, &Stop::new())?;
    let faces = faces(mesh, &Stop::new())?;
    writeln!(out, "{title}: {} faces, {} findings {findings:?}", faces.len(), findings.len())?;
    let ring = |v: Vertex| mesh.ring(v).slots().iter().map(|slot| slot.map_or("_".to_owned(), |q| q.to_string()));
    for v in mesh.set.iter() {
        writeln!(out, "  {v}: {{{}}}", ring(v).collect::<Vec<_>>().join(", "))?;
    }
    Ok(())
}
