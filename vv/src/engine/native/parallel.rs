//! Which parallel loops may be run by many threads at once, each some rounds.
//!
//! The checker sees to it that rounds do not depend on one another. What is asked here is what threads need beside that, and
//! that rounds keep to what they are told to, for else threads would store to the same memory: of functions that stand in
//! for their calls, the stores are looked at when they are translated, see [`Seen`]; others may store to variables only.

use rustc_hash::FxHashSet;

use super::effects::Facts;
use crate::builtins::Code;
use crate::ir::visit::{Node, each};
use crate::ir::{Argument, Expr, ExprKind, Function, FunctionId, LocalId, Place, Program, Ring, Stmt, StmtKind, Type};

/// A column of values of vertices, as they are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Column {
    Position,
    Property(u32),
}

/// What rounds take from outside.
#[derive(Debug, Default)]
pub(super) struct Outside {
    /// Variables that are declared outside, each once.
    pub(super) captured: Vec<LocalId>,
    /// What functions read that do not stand in for their calls, of whatever vertex.
    pub(super) read: FxHashSet<Column>,
}

impl Outside {
    /// Of the rounds of a loop in a function, if they can be translated as a function of their own.
    pub(super) fn of(
        program: &Program,
        facts: &Facts,
        function: &Function,
        local: LocalId,
        body: &[Stmt],
    ) -> Option<Self> {
        if leaves(body) {
            return None;
        }
        let mut declared = FxHashSet::default();
        each(body, &mut |node| {
            if let Node::Stmt(s) = node {
                match &s.kind {
                    StmtKind::Declare { local, .. } => {
                        declared.insert(*local);
                    }
                    StmtKind::ForallRing { local, follower, .. } => declared.extend([*local].iter().chain(follower)),
                    _ => {}
                }
            }
        });
        let mut named_before: FxHashSet<LocalId> = std::iter::once(local).collect();
        let mut reader =
            Reader { program, facts, outside: Self::default(), called: Vec::new(), met: FxHashSet::default() };
        let mut fits = true;
        each(body, &mut |node| {
            fits &= !matches!(node, Node::Stmt(Stmt { kind: StmtKind::Return(_), .. }))
                && reader.fits(&node, function, false)
                && changes(&node).all(|l| {
                    declared.contains(&l) || function.locals.get(l.0 as usize).is_some_and(|l| l.ty == Type::Mesh)
                });
            for l in named(&node) {
                if !declared.contains(&l) && named_before.insert(l) {
                    reader.outside.captured.push(l);
                }
            }
        });
        let mut next = 0;
        while let Some(&(id, apart)) = reader.called.get(next).filter(|_| fits) {
            next += 1;
            let function = program.function(id)?;
            each(&function.body, &mut |node| fits &= reader.fits(&node, function, apart));
        }
        fits.then_some(reader.outside)
    }
}

/// Whether a `break` ends the loop whose body this is.
fn leaves(body: &[Stmt]) -> bool {
    body.iter().any(|s| match &s.kind {
        StmtKind::Break => true,
        StmtKind::Block(body) => leaves(body),
        StmtKind::If { then, otherwise, .. } => leaves(then) || leaves(otherwise),
        _ => false,
    })
}

/// Variables that it may change.
fn changes<'a>(node: &Node<'a>) -> impl Iterator<Item = LocalId> + use<'a> {
    let (mut one, mut arguments): (_, &[Argument]) = (None, &[]);
    if let Node::Expr(e) = node {
        match &e.kind {
            ExprKind::Assign { place, .. } | ExprKind::Step(place, ..) => {
                if let Place::Local(local) = whole(place) {
                    one = Some(*local);
                }
            }
            ExprKind::Call(_, all) => arguments = all,
            _ => {}
        }
    }
    let passed = arguments.iter().filter_map(|a| if let Argument::Reference(local) = a { Some(*local) } else { None });
    one.into_iter().chain(passed)
}

/// Variables that stand in it, what is within apart.
fn named<'a>(node: &Node<'a>) -> impl Iterator<Item = LocalId> + use<'a> {
    let one = match node {
        Node::Expr(Expr { kind: ExprKind::Local(local), .. })
        | Node::Place(Place::Local(local) | Place::MeshProperty { set: local, .. }) => Some(*local),
        _ => None,
    };
    one.into_iter().chain(changes(node))
}

/// The place that a place is part of.
fn whole(place: &Place) -> &Place {
    if let Place::Coordinate(base, _) = place { base } else { place }
}

struct Reader<'a> {
    program: &'a Program,
    facts: &'a Facts,
    outside: Outside,
    /// Functions that are called, each once, and whether they or their callers are compiled by themselves.
    called: Vec<(FunctionId, bool)>,
    met: FxHashSet<(FunctionId, bool)>,
}

impl Reader<'_> {
    /// Whether many threads may do it at once. Notes what it calls, and what it reads if it stands `apart`, in a function
    /// that is compiled by itself.
    fn fits(&mut self, node: &Node<'_>, function: &Function, apart: bool) -> bool {
        match node {
            Node::Stmt(s) => match &s.kind {
                StmtKind::Declare { local, .. } => {
                    function.locals.get(local.0 as usize).is_some_and(|l| matches!(l.ty, Type::Value(_)))
                }
                StmtKind::Expr(_)
                | StmtKind::Block(_)
                | StmtKind::If { .. }
                | StmtKind::Loop { .. }
                | StmtKind::ForallRing { .. }
                | StmtKind::Break
                | StmtKind::Continue
                | StmtKind::Return(_) => true,
                _ => false,
            },
            Node::Expr(e) => match &e.kind {
                ExprKind::Create | ExprKind::AssignSet(..) | ExprKind::AssignRing(..) => false,
                ExprKind::Assign { place, .. } | ExprKind::Step(place, ..) => match whole(place) {
                    Place::Local(_) => true,
                    Place::Position { .. } | Place::VertexProperty { .. } => !apart,
                    _ => false,
                },
                ExprKind::Builtin(builtin, _) => !matches!(builtin.code(), Code::Random | Code::RandomBetween),
                ExprKind::Call(id, arguments) => {
                    let stands_in = self.facts.function(*id).is_some_and(|f| f.inline);
                    let call = (*id, apart || !stands_in);
                    if self.met.insert(call) {
                        self.called.push(call);
                    }
                    matches!(e.ty, Type::Value(_) | Type::Void)
                        && self.program.function(*id).is_some()
                        && !arguments.iter().any(|a| matches!(a, Argument::Value(e) if e.ty == Type::Mesh))
                }
                ExprKind::Local(_) => e.ty != Type::Ring,
                _ => matches!(e.ty, Type::Value(_) | Type::Void),
            },
            Node::Place(place) => {
                if apart && let Some(column) = column_of(place) {
                    self.outside.read.insert(column);
                }
                true
            }
            Node::Ring(ring) => matches!(ring, Ring::Of { .. }),
        }
    }
}

fn column_of(place: &Place) -> Option<Column> {
    match place {
        Place::Position { old: false, .. } => Some(Column::Position),
        Place::VertexProperty { property, old: false, .. } => Some(Column::Property(*property)),
        _ => None,
    }
}

/// What rounds were seen to do with values of vertices, as they are.
#[derive(Debug, Default)]
pub(super) struct Seen {
    /// Stored to the round's own vertex.
    pub(super) stored: FxHashSet<Column>,
    /// Read of another.
    pub(super) read: FxHashSet<Column>,
    /// Something was stored to another.
    pub(super) strays: bool,
}

impl Seen {
    /// Whether no round stores what another one stores or reads.
    pub(super) fn is_apart(&self) -> bool {
        !self.strays && self.stored.is_disjoint(&self.read)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Mutation, compile};
    use crate::ir::StmtKind;

    /// Of a parallel loop whose rounds become a function: whether many threads may do them. The word is put before the loop
    /// when it is checked, for the checker lets only loops have it that keep to what it says.
    #[track_caller]
    fn check(round: &str, expected: &[bool]) {
        let text = format!(
            "vertex {{ double u; double w; }}; mesh {{ double scale; }};
vec mean(vertex p) {{ vec m; forall q in `p m += `q$pos; return m / valence `p; }}
void raise(vertex p, double x) {{ p$u += x; }}
void twice(double& x) {{ x *= 2.0; }}
double deep(vertex p, int n) {{ return n > 0 ? deep(any in p, n - 1) : p$w; }}
void sink(vertex p, int n) {{ if (n > 0) sink(p, n - 1); else p$u = 1.0; }}
void step(mesh& S) {{ synchronize S; double x = 1.0; ring r; mesh T = S; forall p in S {{ {round} }} x = 2.0; }}"
        );
        let program = crate::compile("test.vv", &text, &mut |_, _| Err(String::new())).program.unwrap();
        let mut program = (*program).clone();
        for s in program.functions.iter_mut().flat_map(|f| &mut f.body) {
            if let StmtKind::ForallSet { parallel, .. } = &mut s.kind {
                *parallel = true;
            }
        }
        let native = compile(&program, Mutation::None).unwrap();
        let found: Vec<bool> = native.code.rounds().collect();
        assert_eq!(found, expected);
    }

    #[test]
    fn rounds_that_keep_to_their_vertex_are_done_by_many_threads() {
        check("p$u = x; if (p$u > x) continue; p$pos = mean(p);", &[true]);
        check("vertex q = p; double y = x; twice(y); q$u = y + S$scale; raise(p, y);", &[true]);
        check("double y; forall q in p { y += q$w; if (is q in T) break; } p$u = y + deep(p, 3);", &[true]);
    }

    #[test]
    fn rounds_that_stray_are_done_by_one_thread() {
        check("vertex q = any in p; q$u = x;", &[false]);
        check("p$u = (any in p)$u;", &[false]);
        check("p$w = deep(p, 3);", &[false]);
        check("raise(any in p, x);", &[false]);
    }

    #[test]
    fn what_changes_the_run_stays_in_the_loop() {
        let others =
            ["x = p$u;", "twice(x);", "r = r;", "add p to T;", "print p;", "break;", "return;", "p$u = random();"];
        let more = ["vertex q;", "erase any in p from p;", "sink(p, 2);", "forall q in S p$u += x;", "S$scale = x;"];
        others.iter().chain(&more).for_each(|round| check(round, &[]));
    }
}
