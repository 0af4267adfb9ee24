//! Expressions.

use super::fault::{Fault, Run};
use super::origin::Reason;
use super::place::{Target, coordinate};
use super::{Machine, Set, Slot, VERTEX_BYTES};
use crate::builtins::Builtin;
use crate::engine::{FailureKind, text};
use crate::ir::arithmetic::{ArithmeticError, binary, convert, unary};
use crate::ir::{Argument, Compound, Expr, ExprKind, FunctionId, Item, LocalId, Place, Ring, Step, StepPosition, Type};
use crate::mesh::{Value, Vertex};
use crate::source::Span;

impl<'a> Machine<'a> {
    pub(super) fn eval(&mut self, e: &'a Expr) -> Run<Value> {
        match &e.kind {
            ExprKind::Constant(Value::Vertex(None)) => Ok(self.null(e.span, |_| Reason::Written)),
            ExprKind::Constant(value) => Ok(*value),
            ExprKind::Local(local) => Ok(self.eval_local(*local, e.span)),
            ExprKind::Global(id) => {
                let value = self.globals.get(id.0 as usize).copied().unwrap_or(Value::Bool(false));
                Ok(if value == Value::Vertex(None) { self.null(e.span, |_| Reason::Written) } else { value })
            }
            ExprKind::Load(place) => self.load(place, e.span),
            ExprKind::Convert(conversion, a) => {
                let a = self.eval(a)?;
                convert(*conversion, a).map_err(|why| self.fail_to_convert(why, a, e.span))
            }
            ExprKind::Unary(op, a) => {
                let a = self.eval(a)?;
                unary(*op, a).map_err(|why| self.fail_to_compute(why, &[a], e.span))
            }
            ExprKind::Binary(op, a, b) => {
                let a = self.eval(a)?;
                let b = self.eval(b)?;
                binary(*op, a, b).map_err(|why| self.fail_to_compute(why, &[a, b], e.span))
            }
            ExprKind::And(a, b) => Ok(Value::Bool(self.holds(a)? && self.holds(b)?)),
            ExprKind::Or(a, b) => Ok(Value::Bool(self.holds(a)? || self.holds(b)?)),
            ExprKind::Conditional(condition, a, b) => {
                if self.holds(condition)? {
                    self.eval(a)
                } else {
                    self.eval(b)
                }
            }
            ExprKind::Coordinate(a, axis) => Ok(coordinate(self.eval(a)?, Some(*axis))),
            ExprKind::Call(function, arguments) => self.call(*function, arguments, e.span),
            ExprKind::Builtin(builtin, arguments) => self.builtin(*builtin, arguments, e.span),
            ExprKind::Assign { place, op, value } => self.assign(place, op.as_ref(), value, e.span),
            ExprKind::Step(place, step, position) => self.step(place, *step, *position, e.span),
            ExprKind::AssignSet(local, value) => {
                let members = self.members(value)?;
                self.account(members.bytes(), e.span)?;
                let index = self.set_index(*local);
                self.sets[index].members = members;
                Ok(Value::Bool(false))
            }
            ExprKind::Create => self.create(e.span),
            ExprKind::AssignRing(local, value) => {
                let list = self.list(value)?;
                self.set_ring(*local, list, e.span)?;
                Ok(Value::Bool(false))
            }
            ExprKind::Any(ring) => {
                let source = self.source(ring)?;
                match self.ring(source).any() {
                    None => Ok(self.null(e.span, |machine| Reason::Empty { ring: machine.whose(source) })),
                    x => Ok(Value::Vertex(x)),
                }
            }
            ExprKind::Next(item, ring) => self.look_up(item, ring, true, e.span),
            ExprKind::Previous(item, ring) => self.look_up(item, ring, false, e.span),
            ExprKind::IsInRing(item, ring) => {
                let x = self.sought(item)?;
                let source = self.source(ring)?;
                Ok(Value::Bool(self.ring(source).contains(x)))
            }
            ExprKind::IsInSet(vertex, set) => {
                let v = self.vertex(vertex)?;
                let members = self.members(set)?;
                Ok(Value::Bool(v.is_some_and(|v| members.contains(v))))
            }
            ExprKind::Valence(ring) => {
                let source = self.source(ring)?;
                Ok(Value::Int(self.ring(source).valence() as i64))
            }
            ExprKind::Gaps(ring) => {
                let source = self.source(ring)?;
                Ok(Value::Int(self.ring(source).gaps() as i64))
            }
        }
    }

    /// A condition.
    #[inline]
    pub(super) fn holds(&mut self, e: &'a Expr) -> Run<bool> {
        Ok(self.eval(e)? == Value::Bool(true))
    }

    /// An expression of type vertex.
    #[inline]
    pub(super) fn vertex(&mut self, e: &'a Expr) -> Run<Option<Vertex>> {
        match self.eval(e)? {
            Value::Vertex(v) => Ok(v),
            _ => Ok(None),
        }
    }

    /// An expression of type mesh, as a value of its own.
    pub(super) fn set(&mut self, e: &'a Expr) -> Run<Set> {
        match &e.kind {
            ExprKind::Local(local) => Ok(self.sets[self.set_index(*local)].clone()),
            ExprKind::Conditional(condition, a, b) => {
                if self.holds(condition)? {
                    self.set(a)
                } else {
                    self.set(b)
                }
            }
            ExprKind::Call(function, arguments) => {
                self.call(*function, arguments, e.span)?;
                Ok(self.returned_set.take().unwrap_or_default())
            }
            _ => Ok(Set::default()),
        }
    }

    fn eval_local(&mut self, local: LocalId, span: Span) -> Value {
        let value = self.local(local);
        if value == Value::Vertex(None) {
            let target = Target::Local(self.address(local));
            self.trace_load(value, target, span);
        }
        value
    }

    pub(super) fn call(&mut self, id: FunctionId, arguments: &'a [Argument], span: Span) -> Run<Value> {
        let Some(function) = self.program.function(id) else { return Ok(Value::Bool(false)) };
        self.poll(span)?;
        let max = self.settings.limits.max_call_depth;
        // The rule itself is the first.
        if self.frames.len() >= max as usize {
            let message = format!("more than {max} calls are open at once");
            let hint = format!("does `{}` ever end without calling itself again?", function.name);
            return Err(self.fail_with(FailureKind::Budget, span, message).hint(hint));
        }
        let before = self.heights();
        for argument in arguments {
            let slot = match argument {
                Argument::Value(e) if e.ty == Type::Mesh => {
                    let set = self.set(e)?;
                    self.account(set.members.bytes(), span)?;
                    self.sets.push(set);
                    Slot::Set(self.sets.len() - 1)
                }
                Argument::Value(e) if e.ty == Type::Ring => {
                    let list = self.list(e)?;
                    self.account(size_of::<Vertex>() * list.len(), span)?;
                    self.new_ring(list)
                }
                Argument::Value(e) => Slot::Value(self.eval(e)?),
                Argument::Reference(local) => {
                    let address = self.address(*local);
                    match self.stack[address] {
                        whole @ (Slot::Set(_) | Slot::Ring(_)) => whole,
                        _ => Slot::Reference(address),
                    }
                }
            };
            if let Slot::Value(value) = slot {
                self.trace_store(value, Target::Local(self.stack.len()));
            }
            self.stack.push(slot);
        }
        self.account(function.locals.len() * size_of::<Slot>(), span)?;
        self.open(function, Some(span), before)
    }

    fn builtin(&mut self, builtin: Builtin, arguments: &'a [Expr], span: Span) -> Run<Value> {
        let mut values = [Value::Bool(false); 4];
        let n = arguments.len().min(values.len());
        for (value, argument) in values.iter_mut().zip(arguments) {
            *value = self.eval(argument)?;
        }
        builtin
            .apply(&values[..n], &mut self.random)
            .ok_or_else(|| self.fail_to_compute(ArithmeticError::Overflow, &values[..n], span))
    }

    fn assign(&mut self, place: &'a Place, op: Option<&'a Compound>, value: &'a Expr, span: Span) -> Run<Value> {
        let (target, axis) = self.target(place, None)?;
        let mut value = self.eval(value)?;
        if let Some(compound) = op {
            let mut was = coordinate(self.read(target, span)?, axis);
            if let Some(widen) = compound.widen {
                was = convert(widen, was).map_err(|why| self.fail_to_convert(why, was, span))?;
            }
            let result = binary(compound.op, was, value);
            value = result.map_err(|why| self.fail_to_compute(why, &[was, value], span))?;
            if let Some(narrow) = compound.narrow {
                value = convert(narrow, value).map_err(|why| self.fail_to_convert(why, value, span))?;
            }
        }
        self.store(target, axis, value, span)?;
        Ok(value)
    }

    fn step(&mut self, place: &'a Place, step: Step, position: StepPosition, span: Span) -> Run<Value> {
        let (target, axis) = self.target(place, None)?;
        let before = coordinate(self.read(target, span)?, axis);
        let after = match (before, step) {
            (Value::Int(i), Step::Up) => i.checked_add(1).map(Value::Int),
            (Value::Int(i), Step::Down) => i.checked_sub(1).map(Value::Int),
            (Value::Double(x), Step::Up) => Some(Value::Double(x + 1.0)),
            (Value::Double(x), Step::Down) => Some(Value::Double(x - 1.0)),
            (other, _) => Some(other),
        };
        let after = after.ok_or_else(|| self.fail_to_compute(ArithmeticError::Overflow, &[before], span))?;
        self.store(target, axis, after, span)?;
        Ok(if position == StepPosition::Before { after } else { before })
    }

    fn create(&mut self, span: Span) -> Run<Value> {
        let max = self.settings.limits.max_vertices;
        if self.mesh.vertex_count() >= max {
            let message = format!("the step needs more than {max} vertices");
            return Err(self.fail_with(FailureKind::Budget, span, message));
        }
        self.account(VERTEX_BYTES + 8 * self.columns.vertex.len(), span)?;
        match self.mesh.create() {
            Ok(v) => Ok(Value::Vertex(Some(v))),
            Err(full) => Err(self.fail_with(FailureKind::Budget, span, full.to_string())),
        }
    }

    fn look_up(&mut self, item: &'a Item, ring: &'a Ring, forward: bool, span: Span) -> Run<Value> {
        let x = self.sought(item)?;
        let source = self.source(ring)?;
        let slots = self.ring(source);
        let found = if forward { slots.next(x) } else { slots.previous(x) };
        if let Some(Some(y)) = found {
            return Ok(Value::Vertex(Some(y)));
        }
        Ok(self.null(span, |machine| {
            let shown = text::ring(machine.ring(source), x);
            Reason::Lookup { x, ring: machine.whose(source), found: found.is_some(), forward, shown }
        }))
    }

    /// An expression of type vertex that may not be null.
    #[inline]
    pub(super) fn not_null(&mut self, e: &'a Expr, otherwise: &str) -> Run<Vertex> {
        match self.eval(e)? {
            Value::Vertex(Some(v)) => Ok(v),
            _ => Err(self.fail_on_null(e.span, otherwise)),
        }
    }

    /// What is looked for in a ring.
    #[inline]
    pub(super) fn sought(&mut self, item: &'a Item) -> Run<Option<Vertex>> {
        match item {
            Item::Gap(_) => Ok(None),
            Item::Vertex(e) => match self.eval(e)? {
                Value::Vertex(Some(v)) => Ok(Some(v)),
                _ => Err(self.fail_on_null(
                    e.span,
                    "this is null, and a ring is searched for a gap only where `null` is written",
                )),
            },
        }
    }

    /// What is put into a ring.
    pub(super) fn put(&mut self, item: &'a Item) -> Run<Option<Vertex>> {
        match item {
            Item::Gap(_) => Ok(None),
            Item::Vertex(e) => self.vertex(e),
        }
    }

    #[cold]
    fn fail_to_convert(&self, why: ArithmeticError, value: Value, span: Span) -> Box<Fault> {
        self.fail(span, format!("{} is no int: {why}", text::value(value)))
    }

    #[cold]
    fn fail_to_compute(&self, why: ArithmeticError, operands: &[Value], span: Span) -> Box<Fault> {
        let operands: Vec<_> = operands.iter().map(|&v| text::value(v)).collect();
        self.fail(span, why.to_string()).evidence(format!("operands: {}", operands.join(", ")))
    }
}
