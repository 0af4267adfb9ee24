//! `synchronize` and the old values.

use super::fault::{Fault, Run};
use super::{Machine, POLL_STRIDE, VERTEX_BYTES};
use crate::mesh::{Mesh, Vertex, VertexSet};
use crate::source::Span;

/// Old copies of vertices.
#[derive(Default)]
pub(super) struct Old {
    /// Rings, positions and properties; meaningful for vertices that have an old value.
    pub(super) mesh: Mesh,
    /// Which do.
    held: Vec<bool>,
    count: usize,
    /// Where `synchronize` last ran, and how many vertices there were.
    last: Option<(Span, usize)>,
}

impl Old {
    #[inline]
    pub(super) fn holds(&self, v: Vertex) -> bool {
        self.held.get(v.index()).copied().unwrap_or(false)
    }

    pub(super) fn bytes(&self) -> usize {
        self.mesh.bytes() + self.held.capacity()
    }
}

impl Machine<'_> {
    pub(super) fn synchronize(&mut self, set: &VertexSet, span: Span) -> Run<()> {
        let universe = self.mesh.vertex_count();
        let mut covered = 0;
        for (i, v) in set.iter().enumerate() {
            if i % POLL_STRIDE == 0 {
                self.poll(span)?;
            }
            covered += usize::from(self.old.holds(v));
        }
        if covered == self.old.count && 2 * set.len() >= universe {
            self.old.mesh = self.mesh.clone();
            self.account(self.mesh.bytes(), span)?;
        } else {
            if self.old.count == 0 {
                self.old.mesh = self.blank();
            }
            for (i, v) in set.iter().enumerate() {
                if i % POLL_STRIDE == 0 {
                    self.poll(span)?;
                    self.account(POLL_STRIDE.min(set.len()) * VERTEX_BYTES, span)?;
                }
                if let Err(full) = self.mesh.copy_vertex_into(v, &mut self.old.mesh) {
                    return Err(self.fail_with(super::FailureKind::Budget, span, full.to_string()));
                }
            }
        }
        if self.old.held.len() < universe {
            self.old.held.resize(universe, false);
        }
        for v in set.iter() {
            if let Some(held) = self.old.held.get_mut(v.index()) {
                *held = true;
            }
        }
        self.old.count += set.len() - covered;
        self.old.last = Some((span, universe));
        Ok(())
    }

    /// An empty universe with the properties of the mesh.
    fn blank(&self) -> Mesh {
        let mut blank = Mesh::new();
        for property in self.mesh.vertex_properties() {
            blank.declare_vertex_property(&property.name, property.default);
        }
        for property in self.mesh.edge_properties() {
            blank.declare_edge_property(&property.name, property.default);
        }
        blank
    }

    #[cold]
    pub(super) fn fail_on_old(&self, v: Vertex, span: Span) -> Box<Fault> {
        let fault = self.fail(span, format!("{v} has no old value")).about([v]);
        match self.old.last {
            None => fault.evidence("nothing has been synchronized in this step").hint("`synchronize` its set first"),
            Some((at, count)) if v.index() >= count => fault
                .label(at, format!("{v} was created after this"))
                .hint("`synchronize` again after it was created, or leave it out here"),
            Some((at, _)) => fault
                .label(at, format!("{v} was not in this set, nor in one synchronized before"))
                .hint("`synchronize` a set that holds it"),
        }
    }
}
