//! Creases and corners, as the shapes of OpenSubdiv's regression tests have them.
//!
//! ```text
//!   t crease 2/1/0 3 7 2.5        two integers, one number, no string: the edge between the 4th and 8th vertex
//!   t corner 1/1/0 3 4            the 4th vertex
//! ```
//!
//! Vertices count from 0 here, other than in faces. A tag may name several edges or vertices, with one sharpness for
//! all or one for each.

use std::io::Write;

use super::super::lines::{integer, number, show};
use super::super::{Place, ReadError, invalid, push_number};
use crate::mesh::build::{EdgeValues, NamedValues};
use crate::mesh::{Mesh, Property, Type, Value, Values, Vertex};

/// Name of the edge property and of the vertex property that keep how sharp a crease or corner is: a `double`, 0 for
/// smooth, one less after each subdivision.
pub const SHARPNESS: &str = "sharpness";

/// For OpenSubdiv sharper than can be subdivided away.
const INFINITE: f64 = 10.0;

#[derive(Default)]
pub(super) struct Tags {
    vertex_count: u32,
    creases: Vec<([u32; 2], f64)>,
    corners: Vec<(u32, f64)>,
}

impl Tags {
    pub(super) fn new(vertex_count: usize) -> Self {
        Self { vertex_count: u32::try_from(vertex_count).unwrap_or(u32::MAX), ..Self::default() }
    }

    /// Reads what follows `t`; whether it was a crease or corner.
    pub(super) fn add<'a>(
        &mut self,
        mut words: impl Iterator<Item = &'a [u8]>,
        place: impl Fn(&[u8]) -> Place,
    ) -> Result<bool, ReadError> {
        let kind = words.next().unwrap_or_default();
        let (what, size) = match kind {
            b"crease" => ("crease", 2),
            b"corner" => ("corner", 1),
            _ => return Ok(false),
        };
        let Some(counts) = words.next() else {
            return Err(invalid(place(kind), format!("the {what} has no counts as `{size}/1/0`")));
        };
        let wrong = |message: String| Err(invalid(place(counts), message));
        let mut parts = counts.split(|&b| b == b'/').map(integer::<usize>);
        let (Some(Some(integers)), Some(Some(numbers)), Some(Some(_)), None) =
            (parts.next(), parts.next(), parts.next(), parts.next())
        else {
            return wrong(format!("expected counts as `{size}/1/0`, found {}", show(counts)));
        };
        let named = integers / size;
        if integers == 0 || integers % size > 0 || (numbers != 1 && numbers != named) {
            return wrong(format!("the {what} has {integers} vertices and {numbers} numbers"));
        }
        let mut vertices = Vec::new();
        for _ in 0..integers {
            let Some(word) = words.next() else {
                return wrong(format!("the {what} ends after {} vertices", vertices.len()));
            };
            match integer(word) {
                Some(v) if v < self.vertex_count => vertices.push(v),
                Some(_) | None => {
                    let range = match self.vertex_count.checked_sub(1) {
                        Some(last) => format!("in a tag they go from 0 to {last}"),
                        None => "there is none".to_owned(),
                    };
                    let message = format!("the {what} names vertex {}, but {range}", show(word));
                    return Err(invalid(place(word), message));
                }
            }
        }
        let mut sharpness = Vec::new();
        for _ in 0..numbers {
            let Some(word) = words.next() else { return wrong(format!("the {what} has no sharpness")) };
            sharpness.push(number(word).map_err(|why| invalid(place(word), why))?.max(0.0));
        }
        for (i, ends) in vertices.chunks_exact(size).enumerate() {
            let sharpness = sharpness[if numbers == 1 { 0 } else { i }];
            match *ends {
                [a, b] => self.creases.push(([a, b], sharpness)),
                [v] => self.corners.push((v, sharpness)),
                _ => {}
            }
        }
        Ok(true)
    }

    /// Makes properties of the tags, if there are any.
    pub(super) fn give(self, values: &mut NamedValues, vertex_count: usize) {
        if !self.corners.is_empty() {
            let mut column = vec![0.0; vertex_count];
            for (v, sharpness) in self.corners {
                column[v as usize] = sharpness;
            }
            let values_of = Values::Double(column.into());
            values.vertices.push(Property {
                name: SHARPNESS.to_owned(),
                default: Value::Double(0.0),
                values: values_of,
            });
        }
        if !self.creases.is_empty() {
            let (ends, sharpness): (Vec<_>, Vec<_>) = self.creases.into_iter().unzip();
            values.edges.push(EdgeValues {
                name: SHARPNESS.to_owned(),
                ends,
                values: Values::Double(sharpness.into()),
            });
        }
    }
}

/// Whether a property of this name and type, of edges or vertices, says how sharp they are.
pub(super) fn is_sharpness(name: &str, ty: Type) -> bool {
    name == SHARPNESS && matches!(ty, Type::Double | Type::Int)
}

/// The tags of a mesh: what is sharper than 0.
pub(super) fn write(mesh: &Mesh, members: &[Vertex], numbers: &[usize], text: &mut Vec<u8>) {
    let column = |properties: &[Property]| properties.iter().position(|p| is_sharpness(&p.name, p.values.ty()));
    let mut tag = |head: std::fmt::Arguments<'_>, value: Option<Value>| {
        let sharpness = match value {
            Some(Value::Double(f64::INFINITY)) => INFINITE,
            Some(Value::Double(x)) => x,
            Some(Value::Int(x)) => x as f64,
            _ => 0.0,
        };
        if sharpness > 0.0 {
            // Writing to a vector does not fail.
            let _ = text.write_fmt(head);
            push_number(text, sharpness);
            text.push(b'\n');
        }
    };
    if let Some(column) = column(mesh.edge_properties()) {
        for &p in members {
            for (q, value) in mesh.edge_values(column, p).filter(|&(q, _)| p < q && mesh.set.contains(q)) {
                let (i, j) = (numbers[p.index()], numbers[q.index()]);
                tag(format_args!("t crease 2/1/0 {i} {j} "), Some(value));
            }
        }
    }
    if let Some(column) = column(mesh.vertex_properties()) {
        for &v in members {
            tag(format_args!("t corner 1/1/0 {} ", numbers[v.index()]), mesh.vertex_value(column, v));
        }
    }
}
