//! Rings: those of vertices, and variables of type ring.

use std::rc::Rc;

use super::fault::{Fault, Run};
use super::{FailureKind, Flow, Machine, Slot};
use crate::engine::text;
use crate::ir::{Expr, ExprKind, From, LocalId, Ring, Stmt};
use crate::mesh::faces::faces_of;
use crate::mesh::{self, Mesh, Vertex};
use crate::source::Span;

/// The value of a ring variable. A clone shares its vertices until one is edited.
pub(super) type List = Rc<Vec<Option<Vertex>>>;

/// A ring whose owner is computed.
#[derive(Debug, Clone, Copy)]
pub(super) enum Source {
    Of {
        v: Vertex,
        old: bool,
    },
    /// `index` into the machine's rings.
    Variable {
        index: usize,
        local: LocalId,
    },
}

impl<'a> Machine<'a> {
    /// The ring that is meant.
    #[inline]
    pub(super) fn source(&mut self, ring: &'a Ring) -> Run<Source> {
        match ring {
            Ring::Of { vertex, old } => {
                let v = self.not_null(vertex, "null has no neighbours")?;
                if *old && !self.old.holds(v) {
                    return Err(self.fail_on_old(v, vertex.span));
                }
                Ok(Source::Of { v, old: *old })
            }
            Ring::Variable { local, .. } => Ok(Source::Variable { index: self.ring_index(*local), local: *local }),
        }
    }

    #[inline]
    pub(super) fn ring(&self, source: Source) -> mesh::Ring<'_> {
        read(&self.mesh, &self.old.mesh, &self.rings, source)
    }

    /// What messages call it: `ring of v2`, ``old ring of v2``, `r`.
    pub(super) fn ring_name(&self, source: Source) -> String {
        match source {
            Source::Of { v, old } => format!("{}ring of {v}", if old { "old " } else { "" }),
            Source::Variable { local, .. } => {
                let variable = self.frames.last().and_then(|f| f.function.locals.get(local.0 as usize));
                variable.map_or_else(String::new, |l| l.name.clone())
            }
        }
    }

    /// Index into `rings` of a variable of type ring.
    pub(super) fn ring_index(&self, local: LocalId) -> usize {
        match self.stack[self.address(local)] {
            Slot::Ring(index) => index,
            _ => 0,
        }
    }

    pub(super) fn new_ring(&mut self, list: List) -> Slot {
        self.rings.push(list);
        Slot::Ring(self.rings.len() - 1)
    }

    /// An expression of type ring.
    pub(super) fn list(&mut self, e: &'a Expr) -> Run<List> {
        match &e.kind {
            ExprKind::Local(local) => Ok(Rc::clone(&self.rings[self.ring_index(*local)])),
            ExprKind::Conditional(condition, a, b) => {
                if self.holds(condition)? {
                    self.list(a)
                } else {
                    self.list(b)
                }
            }
            ExprKind::Call(function, arguments) => {
                self.call(*function, arguments, e.span)?;
                Ok(self.returned_ring.take().unwrap_or_default())
            }
            _ => Ok(List::default()),
        }
    }

    pub(super) fn set_ring(&mut self, local: LocalId, list: List, span: Span) -> Run<()> {
        // An edit of one of the two copies it.
        self.account(size_of::<Vertex>() * list.len(), span)?;
        let index = self.ring_index(local);
        self.rings[index] = list;
        Ok(())
    }

    pub(super) fn append(&mut self, vertex: &'a Expr, ring: LocalId, span: Span) -> Run<()> {
        let v = self.not_null(vertex, "null cannot be added to a ring")?;
        self.edit_list(self.ring_index(ring), span)?.push(Some(v));
        Ok(())
    }

    /// A ring variable's vertices, of which one at most is added; those that were shared until now are copied.
    pub(super) fn edit_list(&mut self, index: usize, span: Span) -> Run<&mut Vec<Option<Vertex>>> {
        let shared = Rc::strong_count(&self.rings[index]) > 1;
        let bytes = if shared { self.rings[index].len() + 1 } else { 1 };
        self.account(size_of::<Vertex>() * bytes, span)?;
        Ok(Rc::make_mut(&mut self.rings[index]))
    }

    /// `forall f in faces S`
    pub(super) fn for_faces(&mut self, local: LocalId, set: &'a Expr, body: &'a [Stmt]) -> Run<Flow> {
        let members = self.members(set)?;
        let faces = match faces_of(&self.mesh, &members, &self.settings.stop) {
            Ok(faces) => faces,
            Err(stopped) => return Err(self.fail_with(FailureKind::Stopped(stopped), set.span, stopped.to_string())),
        };
        self.walked_faces += faces.bytes();
        self.account(faces.bytes(), set.span)?;
        let index = self.ring_index(local);
        let mut flow = Flow::Next;
        for face in faces.iter() {
            self.poll(set.span)?;
            // The last face may be kept in another variable.
            if Rc::get_mut(&mut self.rings[index]).is_none() {
                self.rings[index] = List::default();
            }
            if let Some(list) = Rc::get_mut(&mut self.rings[index]) {
                list.clear();
                list.extend(face.iter().copied().map(Some));
            }
            match self.block(body)? {
                Flow::Break => break,
                Flow::Return => {
                    flow = Flow::Return;
                    break;
                }
                Flow::Next | Flow::Continue => {}
            }
        }
        self.walked_faces -= faces.bytes();
        Ok(flow)
    }

    /// `forall q in p`, `forall p, q in f`, each also `from` somewhere.
    pub(super) fn for_ring(
        &mut self,
        local: LocalId,
        follower: Option<LocalId>,
        ring: &'a Ring,
        from: Option<&'a From>,
        body: &'a [Stmt],
    ) -> Run<Flow> {
        let span = ring.span();
        let source = self.source(ring)?;
        let first = match from {
            Some(from) => self.begin(source, from)?,
            None => 0,
        };
        let start = self.neighbours.len();
        let slots = read(&self.mesh, &self.old.mesh, &self.rings, source).slots();
        let (before, after) = slots.split_at(first);
        self.neighbours.extend_from_slice(after);
        self.neighbours.extend_from_slice(before);
        let end = self.neighbours.len();
        self.account(size_of::<Vertex>() * (end - start), span)?;
        let mut flow = Flow::Next;
        for i in start..end {
            let Some(v) = self.neighbours[i] else { continue };
            if let Some(follower) = follower {
                let next = if i + 1 == end { start } else { i + 1 };
                let Some(next) = self.neighbours[next] else { continue };
                self.set_local(follower, mesh::Value::Vertex(Some(next)));
            }
            self.poll(span)?;
            self.set_local(local, mesh::Value::Vertex(Some(v)));
            match self.block(body)? {
                Flow::Break => break,
                Flow::Return => {
                    flow = Flow::Return;
                    break;
                }
                Flow::Next | Flow::Continue => {}
            }
        }
        self.neighbours.truncate(start);
        Ok(flow)
    }

    /// Where a loop begins.
    fn begin(&mut self, source: Source, from: &'a From) -> Run<usize> {
        const NULL: &str = "a loop cannot begin at null";
        let corner = self.not_null(&from.corner, NULL)?;
        let next = match &from.next {
            Some(next) => Some(self.not_null(next, NULL)?),
            None => None,
        };
        let slots = self.ring(source).slots();
        let follows = |i: usize| next.is_none() || slots[if i + 1 == slots.len() { 0 } else { i + 1 }] == next;
        let found = (0..slots.len()).find(|&i| slots[i] == Some(corner) && follows(i));
        found.ok_or_else(|| self.fail_to_begin(source, corner, next, from))
    }

    #[cold]
    fn fail_to_begin(&self, source: Source, corner: Vertex, next: Option<Vertex>, from: &From) -> Box<Fault> {
        let (name, ring) = (self.ring_name(source), self.ring(source));
        let name = if matches!(source, Source::Of { .. }) { format!("the {name}") } else { format!("`{name}`") };
        let (span, message) = match (next, &from.next) {
            (Some(q), Some(e)) if ring.contains(Some(corner)) => {
                (from.corner.span.to(e.span), format!("{q} does not follow {corner} in {name}"))
            }
            _ => (from.corner.span, format!("{corner} is not in {name}")),
        };
        let owner = match source {
            Source::Of { v, .. } => Some(v),
            Source::Variable { .. } => None,
        };
        self.fail(span, message)
            .evidence(format!("{}: {}", self.ring_name(source), text::ring(ring, Some(corner))))
            .about(owner.into_iter().chain([corner]).chain(next))
    }
}

fn read<'m>(mesh: &'m Mesh, old: &'m Mesh, rings: &'m [List], source: Source) -> mesh::Ring<'m> {
    match source {
        Source::Of { v, old: false } => mesh.ring(v),
        Source::Of { v, old: true } => old.ring(v),
        Source::Variable { index, .. } => mesh::Ring::new(&rings[index]),
    }
}
