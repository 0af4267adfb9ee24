//! A mesh to rows.

use std::collections::BTreeSet;
use std::io::Write;

use super::super::losses::Of;
use super::super::{color, is_name, numbering, polygons, push_number};
use super::{Encoding, Scalar};
use crate::mesh::faces::Faces;
use crate::mesh::{Mesh, Property, Type, Value, Values, Vertex};

/// Names that mean something else where vertices have them, where edges have them, and anywhere: normals are not read.
const OF_VERTICES: [&str; 9] = ["x", "y", "z", "red", "green", "blue", "nx", "ny", "nz"];
const OF_EDGES: [&str; 5] = ["vertex1", "vertex2", "nx", "ny", "nz"];
const OF_ANYTHING: [&str; 3] = ["nx", "ny", "nz"];

pub(in super::super) fn write(mesh: &Mesh, faces: &Faces, encoding: Encoding) -> Vec<u8> {
    let (numbers, members) = numbering(mesh);
    let [vertices, edges, whole] = [Of::Vertices, Of::Edges, Of::Whole].map(|of| columns(mesh, of));
    let edge_rows = if edges.is_empty() { Vec::new() } else { edge_rows(mesh, &members, &edges) };
    let longest = polygons(faces).map(<[Vertex]>::len).max().unwrap_or(0);
    let length = if longest > usize::from(u8::MAX) { Scalar::Uint32 } else { Scalar::Uint8 };
    let index = if members.len() > i32::MAX as usize { Scalar::Uint32 } else { Scalar::Int32 };

    let mut out = Vec::new();
    let format = match encoding {
        Encoding::Text => "ascii",
        Encoding::LittleEndian => "binary_little_endian",
        Encoding::BigEndian => "binary_big_endian",
    };
    // Writing to a vector does not fail.
    let _ = writeln!(out, "ply\nformat {format} 1.0\nelement vertex {}", members.len());
    let _ = writeln!(out, "property double x\nproperty double y\nproperty double z");
    vertices.iter().for_each(|column| column.announce(&mut out));
    let _ = writeln!(out, "element face {}", polygons(faces).count());
    let _ = writeln!(out, "property list {} {} vertex_indices", length.name(), index.name());
    if !edge_rows.is_empty() {
        let _ = writeln!(out, "element edge {}", edge_rows.len());
        let _ = writeln!(out, "property {0} vertex1\nproperty {0} vertex2", index.name());
        edges.iter().for_each(|column| column.announce(&mut out));
    }
    if !whole.is_empty() {
        let _ = writeln!(out, "element mesh 1");
        whole.iter().for_each(|column| column.announce(&mut out));
    }
    let _ = writeln!(out, "end_header");

    let mut row = Row { out, encoding, first: true };
    for &v in &members {
        mesh.position(v).to_array().into_iter().for_each(|x| row.put(Scalar::Float64, x));
        for column in &vertices {
            row.put_value(column, mesh.vertex_value(column.index, v));
        }
        row.end();
    }
    for face in polygons(faces) {
        row.put(length, face.len() as f64);
        face.iter().for_each(|&corner| row.put(index, numbers[corner.index()] as f64));
        row.end();
    }
    for (ends, values) in &edge_rows {
        ends.iter().for_each(|&end| row.put(index, numbers[end.index()] as f64));
        edges.iter().zip(values).for_each(|(column, &value)| row.put_value(column, value));
        row.end();
    }
    if !whole.is_empty() {
        let value = |column: &Column| mesh.mesh_properties().get(column.index).map(|(_, value)| *value);
        whole.iter().for_each(|column| row.put_value(column, value(column)));
        row.end();
    }
    row.out
}

/// The properties that are written.
pub(in super::super) fn kept(mesh: &Mesh, of: Of) -> Vec<usize> {
    columns(mesh, of).into_iter().map(|column| column.index).collect()
}

/// How properties are written. Of two that would have a column of the same name the second is left out, as no reader
/// could tell them apart.
fn columns(mesh: &Mesh, of: Of) -> Vec<Column> {
    let named = |p: &Property| (p.name.clone(), p.values.clone());
    let (properties, taken): (Vec<_>, &[&str]) = match of {
        Of::Vertices => (mesh.vertex_properties().iter().map(named).collect(), &OF_VERTICES),
        Of::Edges => (mesh.edge_properties().iter().map(named).collect(), &OF_EDGES),
        Of::Whole => {
            let values = |(name, value): &(String, Value)| (name.clone(), Values::filled(*value, 1));
            (mesh.mesh_properties().iter().map(values).collect(), &OF_ANYTHING)
        }
    };
    let mut used = BTreeSet::new();
    let mut columns = Vec::new();
    for (index, (name, values)) in properties.into_iter().enumerate() {
        let is_color = of == Of::Vertices && color::is_color(&name, values.ty());
        let is_free = |name: &String| !used.contains(name) && (is_color || !taken.contains(&name.as_str()));
        let column = Column::new(&name, &values, index, is_color);
        if let Some(column) = column.filter(|column| column.names.iter().all(is_free)) {
            used.extend(column.names.iter().cloned());
            columns.push(column);
        }
    }
    columns
}

/// How a property is written.
struct Column {
    /// What the columns are called: three for a vector.
    names: Vec<String>,
    scalar: Scalar,
    /// Of the property.
    index: usize,
}

impl Column {
    /// `None` for what cannot be written: vertices, and names that are none.
    fn new(name: &str, values: &Values, index: usize, is_color: bool) -> Option<Self> {
        if !is_name(name.as_bytes()) {
            return None;
        }
        let scalar = match values {
            Values::Bool(_) => Scalar::Uint8,
            Values::Int(column) => {
                let fits = |low: i64, high: i64| column.iter().all(|x| (low..=high).contains(x));
                if fits(0, u8::MAX.into()) {
                    Scalar::Uint8
                } else if fits(i32::MIN.into(), i32::MAX.into()) {
                    Scalar::Int32
                } else if fits(0, u32::MAX.into()) {
                    Scalar::Uint32
                } else {
                    Scalar::Float64 // the largest that there is
                }
            }
            Values::Vec(_) if is_color => Scalar::Uint8,
            Values::Double(_) | Values::Vec(_) => Scalar::Float64,
            Values::Vertex(_) => return None,
        };
        let names = match values.ty() {
            Type::Vec if is_color => ["red", "green", "blue"].map(str::to_owned).to_vec(),
            Type::Vec => ["x", "y", "z"].map(|axis| format!("{name}_{axis}")).to_vec(),
            _ => vec![name.to_owned()],
        };
        Some(Self { names, scalar, index })
    }

    fn announce(&self, out: &mut Vec<u8>) {
        for name in &self.names {
            let _ = writeln!(out, "property {} {name}", self.scalar.name());
        }
    }
}

/// The edges that have a value other than zero, from the older end, and their values.
fn edge_rows(mesh: &Mesh, members: &[Vertex], columns: &[Column]) -> Vec<([Vertex; 2], Vec<Option<Value>>)> {
    let mut rows = Vec::new();
    for &p in members {
        let mut of_columns: Vec<_> = columns.iter().map(|column| mesh.edge_values(column.index, p)).collect();
        loop {
            let next: Vec<Option<(Vertex, Value)>> = of_columns.iter_mut().map(Iterator::next).collect();
            let Some(&Some((q, _))) = next.first() else { break };
            let values: Vec<Option<Value>> = next.into_iter().map(|next| next.map(|(_, value)| value)).collect();
            let is_zero = |value: &Value| *value == Value::zero(value.ty());
            if p < q && mesh.set.contains(q) && !values.iter().flatten().all(is_zero) {
                rows.push(([p, q], values));
            }
        }
    }
    rows
}

struct Row {
    out: Vec<u8>,
    encoding: Encoding,
    first: bool,
}

impl Row {
    fn put_value(&mut self, column: &Column, value: Option<Value>) {
        let scalar = column.scalar;
        match value {
            Some(Value::Bool(x)) => self.put(scalar, f64::from(u8::from(x))),
            Some(Value::Int(x)) => self.put(scalar, x as f64),
            Some(Value::Double(x)) => self.put(scalar, x),
            Some(Value::Vec(v)) if scalar == Scalar::Uint8 => {
                // A conversion to an integer saturates, and takes what is not a number for 0.
                v.to_array().into_iter().for_each(|x| self.put(scalar, f64::from((x * 255.0).round() as u8)));
            }
            Some(Value::Vec(v)) => v.to_array().into_iter().for_each(|x| self.put(scalar, x)),
            Some(Value::Vertex(_)) | None => {}
        }
    }

    /// A number, which is an integer where the type is.
    fn put(&mut self, scalar: Scalar, x: f64) {
        fn push<const N: usize>(out: &mut Vec<u8>, big: bool, little: [u8; N], other: [u8; N]) {
            out.extend_from_slice(if big { &other } else { &little });
        }
        let big = match self.encoding {
            Encoding::Text => {
                if !std::mem::take(&mut self.first) {
                    self.out.push(b' ');
                }
                return push_number(&mut self.out, x);
            }
            Encoding::LittleEndian => false,
            Encoding::BigEndian => true,
        };
        let out = &mut self.out;
        match scalar {
            Scalar::Int8 => push(out, big, (x as i8).to_le_bytes(), (x as i8).to_be_bytes()),
            Scalar::Uint8 => push(out, big, (x as u8).to_le_bytes(), (x as u8).to_be_bytes()),
            Scalar::Int16 => push(out, big, (x as i16).to_le_bytes(), (x as i16).to_be_bytes()),
            Scalar::Uint16 => push(out, big, (x as u16).to_le_bytes(), (x as u16).to_be_bytes()),
            Scalar::Int32 => push(out, big, (x as i32).to_le_bytes(), (x as i32).to_be_bytes()),
            Scalar::Uint32 => push(out, big, (x as u32).to_le_bytes(), (x as u32).to_be_bytes()),
            Scalar::Float32 => push(out, big, (x as f32).to_le_bytes(), (x as f32).to_be_bytes()),
            Scalar::Float64 => push(out, big, x.to_le_bytes(), x.to_be_bytes()),
        }
    }

    fn end(&mut self) {
        if self.encoding == Encoding::Text {
            self.out.push(b'\n');
        }
        self.first = true;
    }
}
