//! What functions and statements do, as far as it decides how they are compiled.

use rustc_hash::FxHashSet;

use super::pristine;
use crate::ir::visit::{Node, each, each_in};
use crate::ir::{
    Argument, Binary, Comparison, Expr, ExprKind, Function, FunctionId, Item, Local, LocalId, Passing, Place, Program,
    Ring, Stmt, StmtKind, Type,
};
use crate::mesh::{FRESH_CAPACITY, Value};

/// Functions up to this size stand in for their calls.
const INLINE_SIZE: usize = 100;

/// As [`INLINE_SIZE`], for functions that are called at one place: the rules that refinements ask for are such.
const INLINE_ONCE_SIZE: usize = 1000;

/// What a piece of a program may do, called functions included.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Effects {
    /// Edits a ring as it is.
    pub(super) edits: bool,
    /// Makes old values.
    pub(super) synchronizes: bool,
    /// Creates vertices.
    pub(super) creates: bool,
    /// Changes a variable of type ring.
    pub(super) lists: bool,
}

impl Effects {
    fn join(self, other: Self) -> Self {
        Self {
            edits: self.edits || other.edits,
            synchronizes: self.synchronizes || other.synchronizes,
            creates: self.creates || other.creates,
            lists: self.lists || other.lists,
        }
    }
}

/// Which old values any expression of the program reads.
#[derive(Debug, Clone, Default)]
pub(super) struct OldReads {
    pub(super) rings: bool,
    pub(super) positions: bool,
    pub(super) vertex_properties: Vec<bool>,
    pub(super) edges: bool,
}

/// How a variable is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Keeping {
    /// It has one value from its declaration on.
    Fixed,
    /// It is assigned.
    Variable,
    /// Its address is taken.
    Memory,
    /// It is a face that a loop walks, or a parameter of type ring while no list changes.
    Face,
}

/// Facts of a function.
#[derive(Debug, Clone)]
pub(super) struct FunctionFacts {
    pub(super) effects: Effects,
    /// Stands in for its calls.
    pub(super) inline: bool,
    /// How many calls may be open within it that are not calls of compiled functions.
    pub(super) inline_depth: u32,
    /// Can be reached from a rule, `start` or a global.
    pub(super) reached: bool,
    /// Begins with the mesh as the run found it.
    pub(super) pristine: bool,
    /// Is called from rounds of a parallel loop, or from a function that is.
    pub(super) in_parallel: bool,
    pub(super) keeping: Vec<Keeping>,
}

/// Facts of a program.
pub(super) struct Facts {
    pub(super) functions: Vec<FunctionFacts>,
    pub(super) old_reads: OldReads,
    /// Room for a ring when it is first made: as much as a known list makes it need later, and more where rings grow.
    pub(super) fresh_capacity: u32,
    /// Whether vertices are spliced into rings, and not only beside gaps.
    pub(super) grows: bool,
    /// Whether sets are assigned: what was in them may lie beside what is new.
    pub(super) replaces: bool,
}

impl Facts {
    pub(super) fn of(program: &Program) -> Self {
        let n = program.functions.len();
        let own: Vec<Own> = program.functions.iter().map(|f| Own::of(&f.body)).collect();
        let mut effects: Vec<Effects> = own.iter().map(|o| o.effects).collect();
        let mut changed = true;
        while changed {
            changed = false;
            for i in 0..n {
                let joined = own[i].calls.iter().fold(effects[i], |e, &c| e.join(effects[c]));
                changed |= joined != effects[i];
                effects[i] = joined;
            }
        }
        let order = callees_first(&own);
        let mut calls = vec![0_u32; n];
        for &c in own.iter().chain([&own_of_globals(program)]).flat_map(|o| &o.calls) {
            calls[c] += 1;
        }
        let pristine = pristine::functions(program, &order, &calls);
        let mut inline = vec![false; n];
        let mut inline_depth = vec![0; n];
        let mut size: Vec<usize> = own.iter().map(|o| o.size).collect();
        for &i in &order.sorted {
            for &c in &own[i].calls {
                if inline[c] {
                    size[i] = size[i].saturating_add(size[c]);
                    inline_depth[i] = inline_depth[i].max(inline_depth[c] + 1);
                }
            }
            let function = &program.functions[i];
            let faces = faces(function, effects[i]);
            let sets = function.locals.iter().enumerate().any(|(l, local)| {
                matches!(local.ty, Type::Mesh | Type::Ring)
                    && function.parameters.get(l) != Some(&Passing::Reference)
                    && !faces[l]
            });
            inline[i] = !order.cyclic[i]
                && size[i] <= if calls[i] == 1 { INLINE_ONCE_SIZE } else { INLINE_SIZE }
                && !sets
                && !matches!(function.returns, Type::Mesh | Type::Ring);
        }
        let roots = program.rules.iter().chain(&program.start).map(|f| f.0 as usize);
        let reached = reached_from(roots.chain(own_of_globals(program).calls).collect(), &own);
        let in_parallel = reached_from(calls_in_parallel(program), &own);
        let functions = (0..n)
            .map(|i| FunctionFacts {
                effects: effects[i],
                inline: inline[i],
                inline_depth: inline_depth[i],
                reached: reached[i],
                pristine: pristine[i],
                in_parallel: in_parallel[i],
                keeping: keeping(&program.functions[i], &inline, effects[i]),
            })
            .collect();
        let (fresh_capacity, grows) = growth(program);
        let replaces = own.iter().any(|o| o.assigns_sets);
        Self { functions, old_reads: old_reads(program), fresh_capacity, grows, replaces }
    }

    pub(super) fn function(&self, id: FunctionId) -> Option<&FunctionFacts> {
        self.functions.get(id.0 as usize)
    }

    /// Whether any function that can be reached creates vertices.
    pub(super) fn creates(&self) -> bool {
        self.functions.iter().any(|f| f.reached && f.effects.creates)
    }

    /// Whether any function that can be reached edits rings.
    pub(super) fn edits(&self) -> bool {
        self.functions.iter().any(|f| f.reached && f.effects.edits)
    }

    /// What statements do.
    pub(super) fn effects_of(&self, body: &[Stmt], update: &[Expr], condition: Option<&Expr>) -> Effects {
        let mut own = Own::default();
        each(body, &mut |node| own.note(node));
        for e in update.iter().chain(condition) {
            each_in(e, &mut |node| own.note(node));
        }
        let called = own.calls.iter().filter_map(|&c| self.functions.get(c));
        called.fold(own.effects, |e, f| e.join(f.effects))
    }
}

/// These functions, and those that they call.
fn reached_from(mut open: Vec<usize>, own: &[Own]) -> Vec<bool> {
    let mut reached = vec![false; own.len()];
    while let Some(i) = open.pop() {
        if i < own.len() && !std::mem::replace(&mut reached[i], true) {
            open.extend(&own[i].calls);
        }
    }
    reached
}

/// Functions that rounds of parallel loops call.
fn calls_in_parallel(program: &Program) -> Vec<usize> {
    let mut calls = Vec::new();
    for function in &program.functions {
        each(&function.body, &mut |node| {
            if let Node::Stmt(Stmt { kind: StmtKind::ForallSet { parallel: true, body, .. }, .. }) = node {
                calls.extend(Own::of(body).calls);
            }
        });
    }
    calls
}

/// Size and effects of a function without those it calls.
#[derive(Default)]
struct Own {
    effects: Effects,
    assigns_sets: bool,
    calls: Vec<usize>,
    size: usize,
}

impl Own {
    fn of(body: &[Stmt]) -> Self {
        let mut own = Self::default();
        each(body, &mut |node| own.note(node));
        own
    }

    fn note(&mut self, node: Node<'_>) {
        self.size += 1;
        match node {
            Node::Stmt(s) => match s.kind {
                StmtKind::Erase { from: Ring::Variable { .. }, .. }
                | StmtKind::Replace { ring: Ring::Variable { .. }, .. }
                | StmtKind::Splice { ring: Ring::Variable { .. }, .. }
                | StmtKind::Append { .. } => {
                    self.effects.lists = true;
                    self.size += 4;
                }
                StmtKind::Make { .. }
                | StmtKind::MakeRing { .. }
                | StmtKind::Erase { .. }
                | StmtKind::Replace { .. }
                | StmtKind::Splice { .. } => {
                    self.effects.edits = true;
                    self.size += 8;
                }
                StmtKind::Synchronize(_) => {
                    // The arrays themselves move too.
                    self.effects.edits = true;
                    self.effects.synchronizes = true;
                }
                _ => {}
            },
            Node::Expr(e) => {
                if let ExprKind::Call(f, _) = e.kind {
                    self.calls.push(f.0 as usize);
                }
                self.effects.creates |= matches!(e.kind, ExprKind::Create);
                self.effects.lists |= matches!(e.kind, ExprKind::AssignRing(..));
                self.assigns_sets |= matches!(e.kind, ExprKind::AssignSet(..));
            }
            Node::Place(_) | Node::Ring(_) => {}
        }
    }
}

fn own_of_globals(program: &Program) -> Own {
    let mut own = Own::default();
    for global in &program.globals {
        each_in(&global.init, &mut |node| own.note(node));
    }
    own
}

pub(super) struct Order {
    /// Functions after those they call, cycles cut.
    pub(super) sorted: Vec<usize>,
    /// Whether a function can come to be called from itself.
    pub(super) cyclic: Vec<bool>,
}

fn callees_first(own: &[Own]) -> Order {
    let n = own.len();
    let mut order = Order { sorted: Vec::with_capacity(n), cyclic: vec![false; n] };
    let mut seen = vec![false; n];
    for root in 0..n {
        let mut open = vec![(root, 0)];
        if std::mem::replace(&mut seen[root], true) {
            continue;
        }
        while let Some((i, next)) = open.pop() {
            match own[i].calls.get(next) {
                Some(&c) => {
                    open.push((i, next + 1));
                    if c < n && !std::mem::replace(&mut seen[c], true) {
                        open.push((c, 0));
                    }
                }
                None => order.sorted.push(i),
            }
        }
    }
    for start in 0..n {
        let mut reached = vec![false; n];
        let mut open = own[start].calls.clone();
        while let Some(i) = open.pop() {
            if i < n && !std::mem::replace(&mut reached[i], true) {
                open.extend(&own[i].calls);
            }
        }
        order.cyclic[start] = reached[start];
    }
    order
}

/// Which variables are vertices that lie somewhere and stay as they are: faces that a loop walks, and rings passed by
/// value to a function that changes no list, not even the caller's.
fn faces(function: &Function, effects: Effects) -> Vec<bool> {
    let by_value = |(i, local): (usize, &Local)| {
        local.ty == Type::Ring && function.parameters.get(i) == Some(&Passing::Value) && !effects.lists
    };
    let mut faces: Vec<bool> = function.locals.iter().enumerate().map(by_value).collect();
    each(&function.body, &mut |node| {
        if let Node::Stmt(Stmt { kind: StmtKind::ForallFaces { local, .. }, .. }) = node
            && let Some(face) = faces.get_mut(local.0 as usize)
        {
            *face = true;
        }
    });
    faces
}

fn keeping(function: &Function, inline: &[bool], effects: Effects) -> Vec<Keeping> {
    let mut definitions = vec![0_u32; function.locals.len()];
    let mut addressed = vec![false; function.locals.len()];
    let mut passed = vec![false; function.locals.len()];
    for n in definitions.iter_mut().take(function.parameters.len()) {
        *n = 1;
    }
    let mut define = |local: LocalId| {
        if let Some(n) = definitions.get_mut(local.0 as usize) {
            *n += 1;
        }
    };
    each(&function.body, &mut |node| match node {
        Node::Stmt(s) => match &s.kind {
            StmtKind::Declare { local, .. }
            | StmtKind::ForallSet { local, .. }
            | StmtKind::ForallFaces { local, .. } => define(*local),
            StmtKind::ForallRing { local, follower, .. } => {
                define(*local);
                if let Some(follower) = follower {
                    define(*follower);
                }
            }
            _ => {}
        },
        Node::Expr(e) => match &e.kind {
            ExprKind::Assign { place, .. } | ExprKind::Step(place, ..) => {
                if let Some(local) = variable_of(place) {
                    define(local);
                }
            }
            ExprKind::Call(f, arguments) => {
                for argument in arguments {
                    if let Argument::Reference(local) = argument {
                        let i = local.0 as usize;
                        if let (Some(a), Some(p)) = (addressed.get_mut(i), passed.get_mut(i)) {
                            *p = true;
                            *a |= !inline.get(f.0 as usize).copied().unwrap_or(false);
                        }
                    }
                }
            }
            _ => {}
        },
        Node::Place(_) | Node::Ring(_) => {}
    });
    let faces = faces(function, effects);
    (0..function.locals.len())
        .map(|i| {
            let reference = function.parameters.get(i) == Some(&Passing::Reference);
            if faces[i] {
                Keeping::Face
            } else if addressed[i] || reference {
                Keeping::Memory
            } else if definitions[i] > 1 || passed[i] {
                Keeping::Variable
            } else {
                Keeping::Fixed
            }
        })
        .collect()
}

/// The variable that a place is or is part of.
fn variable_of(place: &Place) -> Option<LocalId> {
    match place {
        Place::Local(local) => Some(*local),
        Place::Coordinate(base, _) => variable_of(base),
        _ => None,
    }
}

fn old_reads(program: &Program) -> OldReads {
    let mut reads = OldReads { vertex_properties: vec![false; program.vertex_properties.len()], ..OldReads::default() };
    let mut note = |node: Node<'_>| match node {
        Node::Ring(ring) => reads.rings |= ring.is_old(),
        Node::Place(Place::Position { old, .. }) => reads.positions |= old,
        Node::Place(Place::VertexProperty { property, old, .. }) => {
            if let Some(read) = reads.vertex_properties.get_mut(*property as usize) {
                *read |= old;
            }
        }
        Node::Place(Place::EdgeProperty { old, .. }) => reads.edges |= old,
        _ => {}
    };
    for function in &program.functions {
        each(&function.body, &mut note);
    }
    for global in &program.globals {
        each_in(&global.init, &mut note);
    }
    reads
}

/// [`Facts::fresh_capacity`] and [`Facts::grows`]. What is done only beside gaps is rare: rings at boundaries.
fn growth(program: &Program) -> (u32, bool) {
    let (mut made, mut least, mut grows) = (0, 4, false);
    for function in &program.functions {
        let mut rare = FxHashSet::default();
        each(&function.body, &mut |node| {
            let Node::Stmt(s) = node else { return };
            match &s.kind {
                StmtKind::If { condition, then, .. } if asks_for_gap(condition) => {
                    each(then, &mut |node| {
                        if let Node::Stmt(s) = node {
                            rare.insert(std::ptr::from_ref(s));
                        }
                    });
                }
                StmtKind::Make { items, .. } => made = made.max(items.len() as u32),
                StmtKind::Splice { item, anchor: Item::Vertex(_), ring: Ring::Of { .. }, .. }
                    if !rare.contains(&std::ptr::from_ref(s)) =>
                {
                    least = FRESH_CAPACITY;
                    grows |= matches!(item, Item::Vertex(_));
                }
                _ => {}
            }
        });
    }
    let made = made.min(FRESH_CAPACITY);
    // What is spliced into a ring in a refinement is as much again at most.
    (least.max(if grows { 2 * made } else { made }), grows)
}

/// Whether it holds only beside gaps: `v == null`, `is null in v`, or one of them and more.
fn asks_for_gap(condition: &Expr) -> bool {
    let null = |e: &Expr| matches!(e.kind, ExprKind::Constant(Value::Vertex(None)));
    match &condition.kind {
        ExprKind::Binary(Binary::CompareVertex(Comparison::Equal), a, b) => null(a) || null(b),
        ExprKind::IsInRing(item, _) => matches!(**item, Item::Gap(_)),
        ExprKind::And(a, b) => asks_for_gap(a) || asks_for_gap(b),
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    #[track_caller]
    fn check(statement: &str, grows: bool) {
        let text =
            format!("void step(mesh& S) {{ forall p in S forall q in p {{ vertex r = nextto q in p; {statement} }} }}");
        let program = crate::compile("test.vv", &text, &mut |_, _| Err(String::new())).program.unwrap();
        assert_eq!(super::growth(&program).1, grows, "{statement}");
    }

    #[test]
    fn rings_grow_where_vertices_are_spliced_and_not_only_beside_gaps() {
        check("splice r after q in p;", true);
        check("erase q from p;", false);
        check("splice null after q in p;", false);
        check("splice r after null in p;", false);
        check("if (r == null) splice q before p in q;", false);
        check("if (is null in p) forall x in q splice p after x in q;", false);
        check("if (q < p && null == r) { splice q before p in q; }", false);
        check("if (r != null) splice r after q in p;", true);
        check("if (r == null) ; else splice r after q in p;", true);
        check("if (r == null) splice q before p in q; splice r after q in p;", true);
    }
}
