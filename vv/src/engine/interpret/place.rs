//! Places: what can be read and stored to.

use super::Machine;
use super::Slot;
use super::fault::{Fault, Run};
use crate::ir::{Expr, Place, PropertyDeclaration};
use crate::mesh::{Value, Vertex};
use crate::source::Span;

/// A place whose operands are computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Target {
    /// Where the variable lies on the stack.
    Local(usize),
    Position {
        v: Vertex,
        old: bool,
    },
    VertexProperty {
        property: u32,
        v: Vertex,
        old: bool,
    },
    EdgeProperty {
        property: u32,
        ends: [Vertex; 2],
        old: bool,
    },
    /// `set` indexes the machine's sets.
    MeshProperty {
        property: u32,
        set: usize,
    },
}

impl<'a> Machine<'a> {
    /// Reads a place. `span` is that of the whole expression.
    #[inline]
    pub(super) fn load(&mut self, place: &'a Place, span: Span) -> Run<Value> {
        let (target, axis) = self.target(place, Some(span))?;
        let value = self.read(target, span)?;
        Ok(coordinate(value, axis))
    }

    /// Computes the operands of a place. An error points to `span`, or to the operand itself.
    pub(super) fn target(&mut self, place: &'a Place, span: Option<Span>) -> Run<(Target, Option<u8>)> {
        let target = match place {
            Place::Local(local) => Target::Local(self.address(*local)),
            Place::Position { vertex, old } => {
                let v = self.owner(vertex, *old, span, || "null has no position".to_owned())?;
                Target::Position { v, old: *old }
            }
            Place::VertexProperty { property, vertex, old } => {
                let program = self.program;
                let no = || format!("null has no property `{}`", name(&program.vertex_properties, *property));
                let v = self.owner(vertex, *old, span, no)?;
                Target::VertexProperty { property: *property, v, old: *old }
            }
            Place::EdgeProperty { property, ends: [p, q], old } => {
                let no = || "null is no end of an edge".to_owned();
                let ends = [self.owner(p, *old, span, no)?, self.owner(q, *old, span, no)?];
                Target::EdgeProperty { property: *property, ends, old: *old }
            }
            Place::MeshProperty { property, set } => {
                Target::MeshProperty { property: *property, set: self.set_index(*set) }
            }
            Place::Coordinate(base, axis) => return Ok((self.target(base, span)?.0, Some(*axis))),
        };
        Ok((target, None))
    }

    /// The vertex whose value is meant: not null, and with an old value if that is meant.
    #[inline]
    fn owner(&mut self, e: &'a Expr, old: bool, span: Option<Span>, no: impl Fn() -> String) -> Run<Vertex> {
        match self.eval(e)? {
            Value::Vertex(Some(v)) if old && !self.old.holds(v) => Err(self.fail_on_old(v, span.unwrap_or(e.span))),
            Value::Vertex(Some(v)) => Ok(v),
            _ => Err(self.fail_on_null(span.unwrap_or(e.span), no())),
        }
    }

    #[inline]
    pub(super) fn read(&mut self, target: Target, span: Span) -> Run<Value> {
        let value = match target {
            Target::Local(address) => match self.stack[address] {
                Slot::Value(value) => Some(value),
                _ => None,
            },
            Target::Position { v, old: false } => return Ok(Value::Vec(self.mesh.position(v))),
            Target::Position { v, old: true } => return Ok(Value::Vec(self.old.mesh.position(v))),
            Target::VertexProperty { property, v, old } => {
                let mesh = if old { &self.old.mesh } else { &self.mesh };
                mesh.vertex_value(self.columns.vertex[property as usize], v)
            }
            Target::EdgeProperty { property, ends: [p, q], old } => {
                let mesh = if old { &self.old.mesh } else { &self.mesh };
                let value = mesh.edge_value(self.columns.edge[property as usize], p, q);
                Some(value.ok_or_else(|| self.no_edge(p, q, old, span))?)
            }
            Target::MeshProperty { property, set } => self.sets[set].properties.get(property as usize).copied(),
        };
        let value = value.unwrap_or(Value::Bool(false));
        self.trace_load(value, target, span);
        Ok(value)
    }

    /// Stores a value, or one coordinate.
    pub(super) fn store(&mut self, target: Target, axis: Option<u8>, value: Value, span: Span) -> Run<()> {
        let value = match (axis, value) {
            (Some(axis), Value::Double(x)) => match self.read(target, span)? {
                Value::Vec(mut v) => {
                    v[usize::from(axis.min(2))] = x;
                    Value::Vec(v)
                }
                other => other,
            },
            _ => value,
        };
        match target {
            Target::Local(address) => self.stack[address] = Slot::Value(value),
            Target::Position { v, .. } => {
                if let Value::Vec(position) = value {
                    self.mesh.set_position(v, position);
                }
            }
            Target::VertexProperty { property, v, .. } => {
                self.mesh.set_vertex_value(self.columns.vertex[property as usize], v, value);
            }
            Target::EdgeProperty { property, ends: [p, q], .. } => {
                if !self.mesh.set_edge_value(self.columns.edge[property as usize], p, q, value) {
                    return Err(self.no_edge(p, q, false, span));
                }
            }
            Target::MeshProperty { property, set } => {
                if let Some(slot) = self.sets[set].properties.get_mut(property as usize) {
                    *slot = value;
                }
            }
        }
        self.trace_store(value, target);
        Ok(())
    }

    #[cold]
    fn no_edge(&self, p: Vertex, q: Vertex, old: bool, span: Span) -> Box<Fault> {
        let (mesh, was) = if old { (&self.old.mesh, "was") } else { (&self.mesh, "is") };
        let mut fault = self.fail(span, format!("there {was} no edge between {p} and {q}")).about([p, q]);
        for (v, x) in [(p, q), (q, p)] {
            let ring = crate::engine::text::ring(mesh.ring(v), Some(x));
            fault = fault.evidence(format!("{}ring of {v}: {ring}", if old { "old " } else { "" }));
        }
        fault
    }
}

fn name(properties: &[PropertyDeclaration], property: u32) -> &str {
    properties.get(property as usize).map_or("", |p| &p.name)
}

/// A coordinate of a vec, or the value itself.
#[inline]
pub(super) fn coordinate(value: Value, axis: Option<u8>) -> Value {
    match (value, axis) {
        (Value::Vec(v), Some(axis)) => Value::Double(v[usize::from(axis.min(2))]),
        _ => value,
    }
}
