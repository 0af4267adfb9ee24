//! The reference interpreter: the definition of what programs mean.
//!
//! It walks the checked program. All variables of all open calls lie on one stack; a `&` parameter is the place of the
//! caller's variable on it. A run that fails on a null is repeated with the origin of every null recorded
//! ([`origin`]), so that the message can say where the null came from and runs that succeed pay nothing for it.

mod edit;
mod expression;
mod fault;
mod old;
mod origin;
mod place;
mod ring;
mod statement;

use std::rc::Rc;

use super::{Failure, FailureKind, Output, OutputClosed, Settings};
use crate::builtins::Random;
use crate::ir::arithmetic::convert;
use crate::ir::{Conversion, Expr, ExprKind, Function, FunctionId, LocalId, Program, PropertyDeclaration, Stmt, Type};
use crate::mesh::{self, Mesh, Value, Vertex, VertexSet};
use crate::source::Span;

pub(super) use fault::with_calls;
use fault::{Fault, Run};
use old::Old;
use origin::Trace;
use ring::List;

/// Native stack that a call may need before it calls again: the parser lets statements and expressions nest 200 deep
/// each, and a level takes up to 5 KB without optimization.
const RED_ZONE: usize = 2 << 20;

/// What the native stack grows by.
const STACK_SEGMENT: usize = 16 << 20;

/// Work on large sets is polled for a stop this often.
const POLL_STRIDE: usize = 4096;

/// Bytes a vertex needs beside its properties: head, position, six neighbours.
const VERTEX_BYTES: usize = 12 + 24 + 6 * 4;

pub(super) fn run(
    program: &Program,
    function: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
    output: &mut dyn Output,
) -> Result<Mesh, Failure> {
    let fault = match attempt(program, function, mesh, generation, settings, output, None) {
        Ok(mesh) => return Ok(mesh),
        Err(fault) => fault,
    };
    if fault.of_null {
        // The same again, silently, to learn where the null came from. It may be stopped; then the message goes without.
        let again = attempt(program, function, mesh, generation, settings, &mut Muted, Some(Trace::default()));
        if let Err(traced) = again
            && traced.of_null
        {
            return Err(traced.failure);
        }
    }
    Err(fault.failure)
}

struct Muted;

impl Output for Muted {
    fn print(&mut self, _line: &str) -> Result<(), OutputClosed> {
        Ok(())
    }
}

fn attempt(
    program: &Program,
    function: FunctionId,
    mesh: &Mesh,
    generation: u64,
    settings: &Settings,
    output: &mut dyn Output,
    trace: Option<Trace>,
) -> Run<Mesh> {
    let before = mesh;
    let mut mesh = mesh.clone();
    let columns = Columns::declare(program, &mut mesh);
    let members = std::mem::take(&mut mesh.set);
    let value_of = |i: &usize| mesh.mesh_properties().get(*i).map_or(Value::Bool(false), |(_, value)| *value);
    let properties = columns.mesh.iter().map(value_of).collect();
    let machine = Machine {
        program,
        settings,
        output,
        old: Old::default(),
        mesh,
        columns,
        globals: Vec::new(),
        stack: Vec::new(),
        base: 0,
        sets: vec![Set { members, properties }],
        walked: Vec::new(),
        rings: Vec::new(),
        walked_faces: 0,
        neighbours: Vec::new(),
        items: Vec::new(),
        frames: Vec::new(),
        returned: Value::Bool(false),
        returned_set: None,
        returned_ring: None,
        random: Random::new(settings.seed, generation),
        line: String::new(),
        printed: 0,
        unaccounted: 0,
        trace,
    };
    machine.run(function, before)
}

/// Where the program's properties lie in the mesh.
struct Columns {
    vertex: Vec<usize>,
    edge: Vec<usize>,
    mesh: Vec<usize>,
}

impl Columns {
    fn declare(program: &Program, mesh: &mut Mesh) -> Self {
        fn each(all: &[PropertyDeclaration], mut declare: impl FnMut(&str, Value) -> usize) -> Vec<usize> {
            all.iter().map(|p| declare(&p.name, p.default)).collect()
        }
        Self {
            vertex: each(&program.vertex_properties, |name, value| mesh.declare_vertex_property(name, value)),
            edge: each(&program.edge_properties, |name, value| mesh.declare_edge_property(name, value)),
            mesh: each(&program.mesh_properties, |name, value| mesh.declare_mesh_property(name, value)),
        }
    }
}

/// What lies on the stack of variables.
#[derive(Debug, Clone, Copy)]
enum Slot {
    Value(Value),
    /// A `&` parameter: where the variable itself lies.
    Reference(usize),
    /// Index into `sets`.
    Set(usize),
    /// Index into `rings`.
    Ring(usize),
}

/// A variable of type mesh.
#[derive(Debug, Clone, Default)]
struct Set {
    members: VertexSet,
    /// Values of the program's mesh properties.
    properties: Vec<Value>,
}

/// How many variables lie where.
#[derive(Debug, Clone, Copy)]
struct Heights {
    stack: usize,
    sets: usize,
    rings: usize,
}

/// An open call.
struct Frame<'a> {
    function: &'a Function,
    /// Where it was called; `None` for the rule.
    call: Option<Span>,
}

/// How a statement ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Flow {
    Next,
    Break,
    Continue,
    Return,
}

struct Machine<'a> {
    program: &'a Program,
    settings: &'a Settings,
    output: &'a mut dyn Output,
    mesh: Mesh,
    columns: Columns,
    old: Old,
    globals: Vec<Value>,
    /// Variables of all open calls.
    stack: Vec<Slot>,
    /// Where those of the innermost call begin.
    base: usize,
    /// Mesh variables of all open calls; the first is the rule's.
    sets: Vec<Set>,
    /// Sets that `forall`s walk, for the account of memory.
    walked: Vec<VertexSet>,
    /// Ring variables of all open calls.
    rings: Vec<List>,
    /// Bytes of the faces that `forall`s walk.
    walked_faces: usize,
    /// Rings that `forall`s walk, one after the other.
    neighbours: Vec<Option<Vertex>>,
    /// Items of a `make`.
    items: Vec<Option<Vertex>>,
    frames: Vec<Frame<'a>>,
    /// What a `return` carries to its call.
    returned: Value,
    returned_set: Option<Set>,
    returned_ring: Option<List>,
    random: Random,
    /// What `print` writes to.
    line: String,
    printed: usize,
    /// Bytes asked for since memory was last counted.
    unaccounted: usize,
    trace: Option<Trace>,
}

impl<'a> Machine<'a> {
    fn run(mut self, function: FunctionId, before: &Mesh) -> Run<Mesh> {
        self.compute_globals()?;
        if let Some(function) = self.program.function(function) {
            self.stack.push(Slot::Set(0));
            if let Err(fault) = self.open(function, None, Heights { stack: 0, sets: 1, rings: 0 }) {
                return Err(self.tell_what_was(fault, before));
            }
        }
        let mut mesh = self.mesh;
        if let Some(set) = self.sets.into_iter().next() {
            mesh.set = set.members;
            for (index, value) in self.columns.mesh.into_iter().zip(set.properties) {
                mesh.set_mesh_value(index, value);
            }
        }
        Ok(mesh)
    }

    fn compute_globals(&mut self) -> Run<()> {
        let program = self.program;
        for (i, global) in program.globals.iter().enumerate() {
            let given = self.settings.params.iter().rev().find(|(id, _)| id.0 as usize == i);
            let value = match given {
                Some((_, value)) if global.param.is_some() => convert_to(*value, global.ty).ok_or_else(|| {
                    self.fail(global.span, "the value given for this parameter does not fit its type")
                })?,
                _ => self.eval(&global.init)?,
            };
            self.globals.push(value);
        }
        Ok(())
    }

    /// How much there is of everything.
    fn heights(&self) -> Heights {
        Heights { stack: self.stack.len(), sets: self.sets.len(), rings: self.rings.len() }
    }

    /// Runs a function whose arguments lie on the stack; takes them and all variables off again, down to what there was
    /// before the arguments.
    fn open(&mut self, function: &'a Function, call: Option<Span>, before: Heights) -> Run<Value> {
        let base = before.stack;
        let caller = std::mem::replace(&mut self.base, base);
        self.frames.push(Frame { function, call });
        for local in function.locals.iter().skip(self.stack.len() - base) {
            let slot = match local.ty {
                Type::Mesh => self.new_set(VertexSet::default()),
                Type::Ring => self.new_ring(List::default()),
                Type::Value(ty) => Slot::Value(Value::zero(ty)),
                Type::Void => Slot::Value(Value::Bool(false)),
            };
            self.stack.push(slot);
        }
        self.returned = Value::Bool(false);
        stacker::maybe_grow(RED_ZONE, STACK_SEGMENT, || self.block(&function.body))?;
        self.frames.pop();
        self.stack.truncate(base);
        self.sets.truncate(before.sets);
        self.rings.truncate(before.rings);
        self.base = caller;
        Ok(self.returned)
    }

    /// A mesh variable with mesh properties at their defaults.
    fn new_set(&mut self, members: VertexSet) -> Slot {
        let properties = self.program.mesh_properties.iter().map(|p| p.default).collect();
        self.sets.push(Set { members, properties });
        Slot::Set(self.sets.len() - 1)
    }

    fn block(&mut self, statements: &'a [Stmt]) -> Run<Flow> {
        for statement in statements {
            match self.statement(statement)? {
                Flow::Next => {}
                other => return Ok(other),
            }
        }
        Ok(Flow::Next)
    }

    /// Where a variable itself lies on the stack.
    fn address(&self, local: LocalId) -> usize {
        let address = self.base + local.0 as usize;
        match self.stack[address] {
            Slot::Reference(address) => address,
            _ => address,
        }
    }

    fn local(&self, local: LocalId) -> Value {
        match self.stack[self.address(local)] {
            Slot::Value(value) => value,
            _ => Value::Bool(false),
        }
    }

    fn set_local(&mut self, local: LocalId, value: Value) {
        let address = self.address(local);
        self.stack[address] = Slot::Value(value);
    }

    /// Index into `sets` of a variable of type mesh.
    fn set_index(&self, local: LocalId) -> usize {
        match self.stack[self.address(local)] {
            Slot::Set(index) => index,
            _ => 0,
        }
    }

    /// Asks whether the run shall stop.
    #[inline]
    fn poll(&self, span: Span) -> Run<()> {
        match self.settings.stop.check() {
            Ok(()) => Ok(()),
            Err(stopped) => Err(self.fail_with(FailureKind::Stopped(stopped), span, stopped.to_string())),
        }
    }

    /// Takes note of bytes that may be used from now on, and counts all memory now and then.
    #[inline]
    fn account(&mut self, bytes: usize, span: Span) -> Run<()> {
        self.unaccounted += bytes;
        let max = self.settings.limits.max_bytes;
        if self.unaccounted < (max / 16).min(16 << 20) {
            return Ok(());
        }
        self.unaccounted = 0;
        let used = self.bytes();
        if used <= max {
            return Ok(());
        }
        let fault = self.fail_with(FailureKind::Budget, span, format!("the step needs more than {}", megabytes(max)));
        Err(fault.evidence(format!(
            "{} vertices, {} in rings and properties, {} in old values, {} in sets, {} printed",
            self.mesh.vertex_count(),
            megabytes(self.mesh.bytes()),
            megabytes(self.old.bytes()),
            megabytes(self.set_bytes()),
            megabytes(self.printed),
        )))
    }

    fn bytes(&self) -> usize {
        self.mesh.bytes()
            + self.old.bytes()
            + self.set_bytes()
            + self.stack.capacity() * size_of::<Slot>()
            + self.ring_bytes()
            + self.walked_faces
            + self.neighbours.capacity() * size_of::<Vertex>()
            + self.printed
    }

    /// Bytes of all sets, those that share their members counted once.
    fn set_bytes(&self) -> usize {
        let mut sets: Vec<_> = self.sets.iter().map(|s| &s.members).chain(&self.walked).collect();
        sets.sort_unstable_by_key(|s| s.identity());
        sets.dedup_by_key(|s| s.identity());
        sets.iter().map(|s| s.bytes()).sum::<usize>() + self.sets.len() * size_of::<Set>()
    }

    /// Bytes of all ring variables, those that share their vertices counted once.
    fn ring_bytes(&self) -> usize {
        let mut rings: Vec<_> = self.rings.iter().map(|r| (Rc::as_ptr(r), r.capacity())).collect();
        rings.sort_unstable();
        rings.dedup();
        rings.iter().map(|(_, n)| n * size_of::<Vertex>()).sum::<usize>() + self.rings.len() * size_of::<List>()
    }

    fn fail(&self, span: Span, message: impl Into<String>) -> Box<Fault> {
        self.fail_with(FailureKind::Program, span, message)
    }

    /// Members of an expression of type mesh.
    fn members(&mut self, e: &'a Expr) -> Run<VertexSet> {
        match &e.kind {
            ExprKind::Local(local) => Ok(self.sets[self.set_index(*local)].members.clone()),
            _ => Ok(self.set(e)?.members),
        }
    }
}

fn megabytes(bytes: usize) -> String {
    match bytes >> 20 {
        0 => format!("{} KiB", bytes.div_ceil(1 << 10)),
        n @ 1..10_000 => format!("{n} MiB"),
        n => format!("{} GiB", n >> 10),
    }
}

/// Converts as an assignment does; `None` if it does not fit or types have nothing to do with each other.
pub(super) fn convert_to(value: Value, ty: mesh::Type) -> Option<Value> {
    use mesh::Type::{Bool, Double, Int};
    let conversion = match (value.ty(), ty) {
        (from, to) if from == to => return Some(value),
        (Bool, Int) => Conversion::BoolToInt,
        (Bool, Double) => Conversion::BoolToDouble,
        (Int, Double) => Conversion::IntToDouble,
        (Double, Int) => Conversion::DoubleToInt,
        (Int, Bool) => Conversion::IntToBool,
        (Double, Bool) => Conversion::DoubleToBool,
        _ => return None,
    };
    convert(conversion, value).ok()
}
