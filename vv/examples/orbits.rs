//! Edmonds' walk: the faces of a graph rotation system are the orbits of (p, q) → (q, what follows p around q).

use std::collections::BTreeSet;
use std::error::Error;
use std::io::{self, Write};

use vv::mesh::{Mesh, Vertex};

fn main() -> Result<(), Box<dyn Error>> {
    orbits(&mut io::stdout().lock())
}

/// Four vertices, each a neighbour of all others. How the neighbours are ordered decides what surface that is.
pub fn orbits(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    tell("tetrahedron", &[[2, 3, 4], [1, 4, 3], [1, 2, 4], [1, 3, 2]], out)?;
    tell("the first ring turned over", &[[4, 3, 2], [1, 4, 3], [1, 2, 4], [1, 3, 2]], out)
}

fn tell(name: &str, rings: &[[usize; 3]; 4], out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mut mesh = Mesh::new();
    let vertices = [mesh.create()?, mesh.create()?, mesh.create()?, mesh.create()?];
    for (&v, ring) in vertices.iter().zip(rings) {
        mesh.make(v, &ring.map(|number| Some(vertices[number - 1])))?;
        mesh.set.add(v);
    }
    let faces = walk_all(&mesh);
    let arrows: usize = faces.iter().map(Vec::len).sum();
    let euler = vertices.len() as i64 - arrows as i64 / 2 + faces.len() as i64;
    writeln!(out, "{name}: Euler characteristic {euler}, genus {}", (2 - euler) / 2)?;
    for face in faces {
        writeln!(out, "  {face:?}")?;
    }
    Ok(())
}

/// Each arrow from a vertex to a neighbour belongs to one orbit.
fn walk_all(mesh: &Mesh) -> Vec<Vec<Vertex>> {
    let mut seen: BTreeSet<[Vertex; 2]> = BTreeSet::new();
    let mut faces = Vec::new();
    for p in mesh.set.iter() {
        for q in mesh.ring(p).vertices() {
            let (mut face, mut arrow) = (Vec::new(), [p, q]);
            while seen.insert(arrow) {
                let [from, to] = arrow;
                face.push(to);
                // Always there, as each names the other; a gap would be the boundary.
                let Some(Some(next)) = mesh.ring(to).next(Some(from)) else { break };
                arrow = [to, next];
            }
            if !face.is_empty() {
                faces.push(face);
            }
        }
    }
    faces
}
