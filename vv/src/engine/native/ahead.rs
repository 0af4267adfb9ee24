//! What the rounds of a loop over vertices or faces will touch, beside what follows one another in memory.
//!
//! In a large mesh the neighbours of a vertex lie far from it, and each is met by two accesses that depend on one another:
//! of its head, then of its ring. A round is too long for the machine to begin with the next ones meanwhile. But what a loop
//! goes through is known before it begins, so compiled code can ask for what later rounds will touch. Positions of neighbours
//! are asked for in meshes of any size where a loop over a ring meets them, as that takes three instructions.
//!
//! What is said here decides only what is asked for early: nothing that is computed rests on it.

use crate::ir::visit::{Node, each};
use crate::ir::{Argument, Expr, ExprKind, FunctionId, LocalId, Place, Program, Ring, Stmt, StmtKind};

/// So many parts of a program are looked at for one loop, and calls in calls.
const BUDGET: usize = 4096;
const DEPTH: usize = 8;

/// What is touched of a vertex, as it is and as it was.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Touched {
    pub(super) rings: [bool; 2],
    pub(super) positions: [bool; 2],
}

impl Touched {
    pub(super) fn any(self) -> bool {
        self != Self::default()
    }
}

/// What the rounds of a loop touch.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Ahead {
    /// Of the vertices of its faces.
    pub(super) corners: Touched,
    /// Of the vertices in the ring of its vertex, the ring as it is and as it was.
    pub(super) around: [Touched; 2],
}

/// Where a variable or an expression comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Origin {
    Elsewhere,
    /// The loop's vertex.
    Vertex,
    /// The loop's face.
    Face,
    /// A vertex of the loop's face.
    Corner,
    /// A vertex in the ring of the loop's vertex, perhaps the old one.
    Beside {
        old: bool,
    },
}

impl Ahead {
    /// Of a loop over a set, with the vertex `local`.
    pub(super) fn of_set(program: &Program, local: LocalId, body: &[Stmt]) -> Self {
        Self::of(program, [(local, Origin::Vertex)], body)
    }

    /// Of a loop over faces.
    pub(super) fn of_faces(program: &Program, local: LocalId, body: &[Stmt]) -> Self {
        Self::of(program, [(local, Origin::Face)], body)
    }

    /// Of a loop over the ring, perhaps the old one, of a vertex: of what is in it.
    pub(super) fn of_ring(program: &Program, vertex: LocalId, old: bool, locals: &[LocalId], body: &[Stmt]) -> Touched {
        let beside = locals.iter().map(|&local| (local, Origin::Beside { old }));
        Self::of(program, beside.chain([(vertex, Origin::Vertex)]), body).around[usize::from(old)]
    }

    fn of(program: &Program, origins: impl IntoIterator<Item = (LocalId, Origin)>, body: &[Stmt]) -> Self {
        let mut ahead = Self::default();
        let mut budget = BUDGET;
        let mut reader = Reader { program, origins: Vec::new(), ahead: &mut ahead, budget: &mut budget, depth: DEPTH };
        for (local, origin) in origins {
            reader.define(local, origin);
        }
        reader.read(body);
        ahead
    }
}

/// Reads statements of one function.
struct Reader<'a> {
    program: &'a Program,
    /// Of the variables.
    origins: Vec<Origin>,
    ahead: &'a mut Ahead,
    budget: &'a mut usize,
    depth: usize,
}

impl Reader<'_> {
    fn read(&mut self, body: &[Stmt]) {
        each(body, &mut |node| {
            if *self.budget > 0 {
                *self.budget -= 1;
                self.note(node);
            }
        });
    }

    fn note(&mut self, node: Node<'_>) {
        match node {
            Node::Stmt(s) => match &s.kind {
                StmtKind::Declare { local, init: Some(init) } => self.define(*local, self.origin(init)),
                StmtKind::ForallRing { local, follower, ring, .. } => {
                    let origin = self.member(ring);
                    for local in std::iter::once(local).chain(follower) {
                        self.define(*local, origin);
                    }
                }
                StmtKind::Make { of, .. } | StmtKind::MakeRing { of, .. } => self.touch(of, |t| &mut t.rings[0]),
                _ => {}
            },
            Node::Expr(e) => match &e.kind {
                ExprKind::Assign { place, op: None, value } => {
                    if let Place::Local(local) = **place {
                        let origin = self.origin(value);
                        if origin != Origin::Elsewhere {
                            self.define(local, origin);
                        }
                    }
                }
                ExprKind::Call(function, arguments) => self.call(*function, arguments),
                _ => {}
            },
            Node::Place(Place::Position { vertex, old }) => {
                self.touch(vertex, |t| &mut t.positions[usize::from(*old)]);
            }
            Node::Ring(Ring::Of { vertex, old }) => self.touch(vertex, |t| &mut t.rings[usize::from(*old)]),
            Node::Place(_) | Node::Ring(_) => {}
        }
    }

    fn call(&mut self, function: FunctionId, arguments: &[Argument]) {
        let Some(callee) = self.program.function(function) else { return };
        if self.depth == 0 {
            return;
        }
        let origins = arguments.iter().map(|argument| match argument {
            Argument::Value(e) => self.origin(e),
            Argument::Reference(local) => self.origin_of(*local),
        });
        let origins = origins.collect();
        let depth = self.depth - 1;
        let program = self.program;
        Reader { program, origins, ahead: &mut *self.ahead, budget: &mut *self.budget, depth }.read(&callee.body);
    }

    fn define(&mut self, local: LocalId, origin: Origin) {
        let i = local.0 as usize;
        if i >= self.origins.len() {
            self.origins.resize(i + 1, Origin::Elsewhere);
        }
        self.origins[i] = origin;
    }

    fn origin_of(&self, local: LocalId) -> Origin {
        self.origins.get(local.0 as usize).copied().unwrap_or(Origin::Elsewhere)
    }

    fn origin(&self, e: &Expr) -> Origin {
        match &e.kind {
            ExprKind::Local(local) => self.origin_of(*local),
            ExprKind::Any(ring) | ExprKind::Next(_, ring) | ExprKind::Previous(_, ring) => self.member(ring),
            ExprKind::Conditional(_, a, b) => match self.origin(a) {
                Origin::Elsewhere => self.origin(b),
                origin => origin,
            },
            _ => Origin::Elsewhere,
        }
    }

    /// Of what is in a ring.
    fn member(&self, ring: &Ring) -> Origin {
        match ring {
            Ring::Of { vertex, old } if self.origin(vertex) == Origin::Vertex => Origin::Beside { old: *old },
            Ring::Variable { local, .. } if self.origin_of(*local) == Origin::Face => Origin::Corner,
            _ => Origin::Elsewhere,
        }
    }

    fn touch(&mut self, vertex: &Expr, part: impl Fn(&mut Touched) -> &mut bool) {
        let touched = match self.origin(vertex) {
            Origin::Corner => &mut self.ahead.corners,
            Origin::Beside { old } => &mut self.ahead.around[usize::from(old)],
            Origin::Elsewhere | Origin::Vertex | Origin::Face => return,
        };
        *part(touched) = true;
    }
}

#[cfg(test)]
mod tests {
    use super::{Ahead, Touched};
    use crate::ir::visit::{Node, each};
    use crate::ir::{ExprKind, Ring, StmtKind};

    /// What the first loop over a set or over faces touches.
    #[track_caller]
    fn check(text: &str, corners: &str, around: &str, around_old: &str) {
        let program = crate::compile("test.vv", text, &mut |_, _| Err(String::new())).program.unwrap();
        let function = program.function(program.default_rule().unwrap()).unwrap();
        let mut found = None;
        each(&function.body, &mut |node| {
            let Node::Stmt(s) = node else { return };
            let ahead = match &s.kind {
                StmtKind::ForallSet { local, body, .. } => Ahead::of_set(&program, *local, body),
                StmtKind::ForallFaces { local, body, .. } => Ahead::of_faces(&program, *local, body),
                _ => return,
            };
            found.get_or_insert(ahead);
        });
        let Ahead { corners: c, around: [now, old] } = found.unwrap();
        assert_eq!([c, now, old].map(said), [corners, around, around_old]);
    }

    /// What the first loop over a ring touches of what is in it.
    #[track_caller]
    fn check_ring(text: &str, expected: &str) {
        let program = crate::compile("test.vv", text, &mut |_, _| Err(String::new())).program.unwrap();
        let function = program.function(program.default_rule().unwrap()).unwrap();
        let mut found = None;
        each(&function.body, &mut |node| {
            let Node::Stmt(s) = node else { return };
            let StmtKind::ForallRing { local, follower, ring: Ring::Of { vertex, old }, body, .. } = &s.kind else {
                return;
            };
            let ExprKind::Local(vertex) = vertex.kind else { return };
            let locals: Vec<_> = std::iter::once(*local).chain(*follower).collect();
            found.get_or_insert_with(|| Ahead::of_ring(&program, vertex, *old, &locals, body));
        });
        assert_eq!(said(found.unwrap()), expected);
    }

    fn said(touched: Touched) -> String {
        let parts = [
            (touched.rings[0], "rings"),
            (touched.rings[1], "old rings"),
            (touched.positions[0], "positions"),
            (touched.positions[1], "old positions"),
        ];
        parts.iter().filter(|(touched, _)| *touched).map(|(_, name)| *name).collect::<Vec<_>>().join(", ")
    }

    #[test]
    fn a_loop_that_keeps_to_its_vertex_touches_nothing_else() {
        check("void step(mesh& S) { forall p in S { p$pos *= 2.0; vertex x; x$pos = p$pos; } }", "", "", "");
        check("void step(mesh& S) { forall p in S if (valence p > 3) print any in p; }", "", "", "");
    }

    #[test]
    fn neighbours_are_known_by_the_ring_they_stand_in() {
        check("void step(mesh& S) { forall p in S forall q in p p$pos += q$pos; }", "", "positions", "");
        check(
            "void step(mesh& S) { synchronize S; forall p in S forall q in `p p$pos += `q$pos; }",
            "",
            "",
            "old positions",
        );
        check("void step(mesh& S) { synchronize S; forall p in S forall q in `p print valence q; }", "", "", "rings");
        check(
            "void step(mesh& S) { forall p in S { vertex q = nextto null in p, r = any in q; r$pos.x = 1.0; } }",
            "",
            "rings",
            "",
        );
        check(
            "void step(mesh& S) { forall p in S { vertex q; q = prevto null in p; erase p from q; } }",
            "",
            "rings",
            "",
        );
    }

    #[test]
    fn a_loop_over_a_ring_touches_what_is_in_it() {
        let check = |body: &str, expected| {
            check_ring(&format!("void step(mesh& S) {{ synchronize S; forall p in S {body} }}"), expected);
        };
        check("forall q in p p$pos += q$pos;", "positions");
        check("forall q in `p p$pos += `q$pos;", "old positions");
        check("forall q, r in `p p$pos += `r$pos;", "old positions");
        check("forall q in `p p$pos += `(nextto q in `p)$pos;", "old positions");
        check("forall q in p p$pos += p$pos;", "");
        check("forall q in p p$pos += (any in q)$pos;", "rings");
    }

    #[test]
    fn functions_touch_what_they_are_given() {
        let move_it = "void move(vertex v) { v$pos.x += 1.0; } ";
        check(&format!("{move_it}void step(mesh& S) {{ forall p in S move(any in p); }}"), "", "positions", "");
        check(&format!("{move_it}void step(mesh& S) {{ forall p in S move(p); }}"), "", "", "");
        check("void f(vertex v) { f(v); } void step(mesh& S) { forall p in S f(any in p); }", "", "", "");
    }

    #[test]
    fn corners_of_faces_are_met_in_turn() {
        check("void step(mesh& S) { forall f in faces S forall p, q in f replace q with null in p; }", "rings", "", "");
        check("void step(mesh& S) { forall f in faces S forall p in f print p$pos; }", "positions", "", "");
    }
}
