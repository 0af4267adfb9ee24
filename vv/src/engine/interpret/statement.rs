//! Statements.

use super::fault::Run;
use super::origin::Reason;
use super::place::Target;
use super::ring::List;
use super::{Flow, Machine, POLL_STRIDE};
use crate::engine::{FailureKind, text};
use crate::ir::{Expr, LocalId, PrintItem, Stmt, StmtKind, Type};
use crate::mesh::{Value, Vertex, VertexSet};
use crate::source::Span;

impl<'a> Machine<'a> {
    pub(super) fn statement(&mut self, s: &'a Stmt) -> Run<Flow> {
        match &s.kind {
            StmtKind::Declare { local, init } => self.declare(*local, init.as_ref())?,
            StmtKind::Expr(e) => {
                self.eval(e)?;
            }
            StmtKind::Block(body) => return self.block(body),
            StmtKind::If { condition, then, otherwise } => {
                let chosen = if self.holds(condition)? { then } else { otherwise };
                return self.block(chosen);
            }
            StmtKind::Loop { condition, body, update, body_first } => {
                return self.repeat(condition.as_ref(), body, update, *body_first, s.span);
            }
            StmtKind::ForallSet { local, set, body, .. } => return self.for_set(*local, set, body),
            StmtKind::ForallRing { local, follower, ring, from, body } => {
                return self.for_ring(*local, *follower, ring, from.as_ref(), body);
            }
            StmtKind::ForallFaces { local, set, body } => return self.for_faces(*local, set, body),
            StmtKind::Break => return Ok(Flow::Break),
            StmtKind::Continue => return Ok(Flow::Continue),
            StmtKind::Return(value) => {
                match value {
                    Some(e) if e.ty == Type::Mesh => self.returned_set = Some(self.set(e)?),
                    Some(e) if e.ty == Type::Ring => self.returned_ring = Some(self.list(e)?),
                    Some(e) => self.returned = self.eval(e)?,
                    None => {}
                }
                return Ok(Flow::Return);
            }
            StmtKind::Make { items, of } => self.make(items, of, s.span)?,
            StmtKind::MakeRing { ring, of } => self.make_ring(*ring, of, s.span)?,
            StmtKind::Erase { item, from } => self.erase(item, from)?,
            StmtKind::Replace { item, with, ring } => self.replace(item, with, ring, s.span)?,
            StmtKind::Splice { item, side, anchor, ring } => self.splice(item, *side, anchor, ring, s.span)?,
            StmtKind::Synchronize(set) => {
                let members = self.members(set)?;
                self.synchronize(&members, s.span)?;
            }
            StmtKind::Add { vertex, set } => {
                let v = self.not_null(vertex, "null cannot be added to a set")?;
                self.account(16, s.span)?;
                let index = self.set_index(*set);
                self.sets[index].members.add(v);
            }
            StmtKind::Append { vertex, ring } => self.append(vertex, *ring, s.span)?,
            StmtKind::Remove { vertex, set } => {
                let v = self.not_null(vertex, "null cannot be removed from a set")?;
                let index = self.set_index(*set);
                self.sets[index].members.remove(v);
            }
            StmtKind::Merge { set, other } => {
                let other = self.members(other)?;
                self.merge(*set, &other, s.span)?;
            }
            StmtKind::Print(items) => self.print(items, s.span)?,
        }
        Ok(Flow::Next)
    }

    fn declare(&mut self, local: LocalId, init: Option<&'a Expr>) -> Run<()> {
        let Some(variable) = self.frames.last().and_then(|f| f.function.locals.get(local.0 as usize)) else {
            return Ok(());
        };
        match (variable.ty, init) {
            (Type::Mesh, _) => {
                let members = match init {
                    Some(e) => self.members(e)?,
                    None => VertexSet::default(),
                };
                self.account(members.bytes(), variable.span)?;
                let index = self.set_index(local);
                self.sets[index].members = members;
                for (value, property) in self.sets[index].properties.iter_mut().zip(&self.program.mesh_properties) {
                    *value = property.default;
                }
            }
            (Type::Ring, init) => {
                let list = match init {
                    Some(e) => self.list(e)?,
                    None => List::default(),
                };
                self.set_ring(local, list, variable.span)?;
            }
            (Type::Value(ty), init) => {
                let value = match init {
                    Some(e) => self.eval(e)?,
                    None if ty == crate::mesh::Type::Vertex => self.null(variable.span, |_| Reason::Declared),
                    None => Value::zero(ty),
                };
                self.set_local(local, value);
                self.trace_store(value, Target::Local(self.address(local)));
            }
            (Type::Void, _) => {}
        }
        Ok(())
    }

    fn repeat(
        &mut self,
        condition: Option<&'a Expr>,
        body: &'a [Stmt],
        update: &'a [Expr],
        body_first: bool,
        span: Span,
    ) -> Run<Flow> {
        let span = condition.map_or(span, |c| c.span);
        let mut ask = !body_first;
        loop {
            self.poll(span)?;
            if ask
                && let Some(condition) = condition
                && !self.holds(condition)?
            {
                return Ok(Flow::Next);
            }
            ask = true;
            match self.block(body)? {
                Flow::Break => return Ok(Flow::Next),
                Flow::Return => return Ok(Flow::Return),
                Flow::Next | Flow::Continue => {}
            }
            for e in update {
                self.eval(e)?;
            }
        }
    }

    fn for_set(&mut self, local: LocalId, set: &'a Expr, body: &'a [Stmt]) -> Run<Flow> {
        let members = self.members(set)?;
        // An edit of the set within the loop copies it.
        self.account(members.bytes(), set.span)?;
        self.walked.push(members.clone());
        let mut flow = Flow::Next;
        for v in members.iter() {
            self.poll(set.span)?;
            self.set_local(local, Value::Vertex(Some(v)));
            match self.block(body)? {
                Flow::Break => break,
                Flow::Return => {
                    flow = Flow::Return;
                    break;
                }
                Flow::Next | Flow::Continue => {}
            }
        }
        self.walked.pop();
        Ok(flow)
    }

    fn merge(&mut self, set: LocalId, other: &VertexSet, span: Span) -> Run<()> {
        let index = self.set_index(set);
        if self.sets[index].members.is_empty() {
            self.account(other.bytes(), span)?;
            self.sets[index].members = other.clone();
            return Ok(());
        }
        for (i, v) in other.iter().enumerate() {
            if i % POLL_STRIDE == 0 {
                self.poll(span)?;
                self.account(16 * POLL_STRIDE.min(other.len()), span)?;
            }
            self.sets[index].members.add(v);
        }
        Ok(())
    }

    fn print(&mut self, items: &'a [PrintItem], span: Span) -> Run<()> {
        // An item may call a function that prints.
        let mut line = std::mem::take(&mut self.line);
        line.clear();
        for item in items {
            match item {
                PrintItem::Text(text) => line.push_str(text),
                PrintItem::Value(e) if e.ty == Type::Mesh => {
                    let members = self.members(e)?;
                    self.print_members(&mut line, members.iter(), span)?;
                }
                PrintItem::Value(e) if e.ty == Type::Ring => {
                    let list = self.list(e)?;
                    self.print_members(&mut line, list.iter().copied().flatten(), span)?;
                }
                PrintItem::Value(e) => {
                    let value = self.eval(e)?;
                    text::push_value(&mut line, value);
                }
            }
        }
        self.printed += line.len() + size_of::<String>();
        self.account(line.len() + size_of::<String>(), span)?;
        if let Err(closed) = self.output.print(&line) {
            return Err(self.fail_with(FailureKind::OutputClosed, span, closed.to_string()));
        }
        self.line = line;
        Ok(())
    }

    fn print_members(&self, line: &mut String, members: impl Iterator<Item = Vertex>, span: Span) -> Run<()> {
        line.push('{');
        for (i, v) in members.enumerate() {
            if i % POLL_STRIDE == 0 {
                self.poll(span)?;
            }
            line.push_str(if i > 0 { ", " } else { "" });
            text::push_value(line, Value::Vertex(Some(v)));
        }
        line.push('}');
        Ok(())
    }
}
