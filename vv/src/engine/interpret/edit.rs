//! Edits of rings.

use std::rc::Rc;

use super::fault::{Fault, Run};
use super::ring::Source;
use super::{FailureKind, Machine};
use crate::ir::{Expr, Item, LocalId, Ring, Side};
use crate::mesh::{EditError, Vertex};
use crate::source::Span;

const NO_RING: &str = "null has no neighbours";

impl<'a> Machine<'a> {
    pub(super) fn make(&mut self, items: &'a [Item], of: &'a Expr, span: Span) -> Run<()> {
        // An item may call a function that makes.
        let mut list = std::mem::take(&mut self.items);
        list.clear();
        for item in items {
            list.push(self.put(item)?);
        }
        let v = self.not_null(of, NO_RING)?;
        self.account(8 * list.len(), span)?;
        if let Err(error) = self.mesh.make(v, &list) {
            return Err(self.fail_to_make(error, v, items, &list, span));
        }
        self.items = list;
        Ok(())
    }

    pub(super) fn make_ring(&mut self, ring: LocalId, of: &'a Expr, span: Span) -> Run<()> {
        let v = self.not_null(of, NO_RING)?;
        let list = Rc::clone(&self.rings[self.ring_index(ring)]);
        self.account(8 * list.len(), span)?;
        self.mesh.make(v, &list).map_err(|error| self.fail_to_make(error, v, &[], &list, span))
    }

    pub(super) fn erase(&mut self, item: &'a Item, from: &'a Ring) -> Run<()> {
        let x = self.sought(item)?;
        match self.source(from)? {
            Source::Of { v, .. } => self.mesh.erase(x, v),
            source @ Source::Variable { index, .. } => {
                if let Some(at) = self.ring(source).find(x) {
                    self.edit_list(index, from.span())?.remove(at);
                }
            }
        }
        Ok(())
    }

    pub(super) fn replace(&mut self, item: &'a Item, with: &'a Item, ring: &'a Ring, span: Span) -> Run<()> {
        let a = self.sought(item)?;
        let x = self.put_in(with, ring)?;
        match self.source(ring)? {
            Source::Of { v, .. } => {
                self.mesh.replace(a, x, v).map_err(|error| self.fail_to_edit(error, v, x, item_span(with, span)))
            }
            source @ Source::Variable { index, .. } => {
                if let Some(at) = self.ring(source).find(a) {
                    self.edit_list(index, span)?[at] = x;
                }
                Ok(())
            }
        }
    }

    pub(super) fn splice(
        &mut self,
        item: &'a Item,
        side: Side,
        anchor: &'a Item,
        ring: &'a Ring,
        span: Span,
    ) -> Run<()> {
        let x = self.put_in(item, ring)?;
        let a = self.sought(anchor)?;
        match self.source(ring)? {
            Source::Of { v, .. } => {
                // A ring that outgrows its room moves to one of twice the size.
                self.account(16, span)?;
                let result = match side {
                    Side::After => self.mesh.splice_after(x, a, v),
                    Side::Before => self.mesh.splice_before(x, a, v),
                };
                result.map_err(|error| self.fail_to_edit(error, v, x, item_span(item, span)))
            }
            source @ Source::Variable { index, .. } => {
                if let Some(at) = self.ring(source).find(a) {
                    let list = self.edit_list(index, span)?;
                    let at = match side {
                        Side::After => at + 1,
                        Side::Before if at == 0 => list.len(),
                        Side::Before => at,
                    };
                    list.insert(at, x);
                }
                Ok(())
            }
        }
    }

    /// What is put into a ring; only that of a vertex takes a gap.
    fn put_in(&mut self, item: &'a Item, ring: &'a Ring) -> Run<Option<Vertex>> {
        match (item, ring) {
            (Item::Vertex(e), Ring::Variable { .. }) => self.not_null(e, "null cannot be put into a ring").map(Some),
            _ => self.put(item),
        }
    }

    #[cold]
    fn fail_to_make(
        &self,
        error: EditError,
        v: Vertex,
        items: &[Item],
        list: &[Option<Vertex>],
        span: Span,
    ) -> Box<Fault> {
        let (culprit, message) = match error {
            EditError::OwnNeighbour(v) => (v, error.to_string()),
            EditError::Twice(x) => (x, format!("{x} is listed twice")),
            EditError::Full(_) => return self.fail_with(FailureKind::Budget, span, error.to_string()),
        };
        let mut places =
            items.iter().zip(list).filter(|(_, x)| **x == Some(culprit)).map(|(item, _)| item_span(item, span));
        let first = places.next();
        let second = places.next();
        let mut fault = self.fail(second.or(first).unwrap_or(span), message);
        if let (Some(first), Some(_)) = (first, second) {
            fault = fault.label(first, format!("{culprit} here too"));
        }
        let listed: Vec<_> = list.iter().map(|x| x.map_or("∅".to_owned(), |x| x.to_string())).collect();
        fault
            .evidence(format!("to be made the ring of {v}: {}", listed.join(" ")))
            .evidence(self.ring_evidence(v, Some(culprit)))
            .about([v, culprit])
    }

    #[cold]
    fn fail_to_edit(&self, error: EditError, v: Vertex, x: Option<Vertex>, span: Span) -> Box<Fault> {
        let message = match error {
            EditError::OwnNeighbour(_) => error.to_string(),
            EditError::Twice(x) => format!("{x} stands in the ring of {v} already"),
            EditError::Full(_) => return self.fail_with(FailureKind::Budget, span, error.to_string()),
        };
        let fault = self.fail(span, message).evidence(self.ring_evidence(v, x)).about(std::iter::once(v).chain(x));
        match error {
            EditError::Twice(_) => fault.hint("ask first whether they are neighbours: `is x in v`"),
            _ => fault,
        }
    }
}

fn item_span(item: &Item, otherwise: Span) -> Span {
    match item {
        Item::Gap(_) => otherwise,
        Item::Vertex(e) => e.span,
    }
}
