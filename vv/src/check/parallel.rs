//! Rounds of `parallel forall` that would depend on one another: what [`crate::ir`] says of *Parallel rounds* is held here.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::builtins::Code;
use crate::diagnostic::Diagnostic;
use crate::ir::visit::{Node, each};
use crate::ir::{Argument, Expr, ExprKind, Function, FunctionId, LocalId, Place, Ring, Stmt, StmtKind};
use crate::source::Span;

use super::Checker;
use super::leaving::leaving;

/// What a round may assign: the position, or a property.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Part {
    Position,
    Property(u32),
}

/// Why rounds are not parallel.
struct Fault {
    span: Span,
    message: String,
    hint: String,
    /// Asks for the old value instead.
    edit: Option<(Span, String)>,
}

const IN_TURN: &str = "leave `parallel` out: then rounds run in turn";

impl Checker<'_> {
    /// Reports the first fault of each parallel loop.
    pub(super) fn look_at_parallel_loops(&mut self, functions: &[Function]) {
        let mut found = Vec::new();
        for function in functions {
            each(&function.body, &mut |node| {
                if let Node::Stmt(Stmt { kind: StmtKind::ForallSet { parallel: true, local, body, .. }, .. }) = node {
                    found.extend(self.fault(functions, function, *local, body));
                }
            });
        }
        found.into_iter().for_each(|d| self.report(d));
    }

    fn fault(&self, functions: &[Function], function: &Function, own: LocalId, body: &[Stmt]) -> Option<Diagnostic> {
        let own_name = function.locals.get(own.0 as usize).map_or("", |l| l.name.as_str());
        let mut rounds = Rounds {
            checker: self,
            functions,
            own_name,
            written: None,
            parts: FxHashMap::default(),
            seen: FxHashSet::default(),
            fault: None,
        };
        let scope = Scope { function, own: vec![own], inner: Some(declared(body)), called: None };
        if let Some(leaving) = leaving(body) {
            rounds.fail(&scope, leaving.span, "a parallel round leaves neither the loop nor the function", IN_TURN);
        }
        rounds.read(&scope, body);
        if rounds.fault.is_none() {
            rounds.written = Some(std::mem::take(&mut rounds.parts));
            rounds.seen.clear();
            rounds.read(&scope, body);
        }
        rounds.fault
    }
}

/// A function whose statements are read, or the loop.
struct Scope<'a> {
    function: &'a Function,
    /// Variables that hold the vertex of the round.
    own: Vec<LocalId>,
    /// Variables that each round has for itself: all if `None`.
    inner: Option<FxHashSet<LocalId>>,
    /// Where the loop calls the function, perhaps through others.
    called: Option<Span>,
}

impl Scope<'_> {
    fn is_inner(&self, local: LocalId) -> bool {
        self.inner.as_ref().is_none_or(|inner| inner.contains(&local))
    }

    fn is_own(&self, e: &Expr) -> bool {
        matches!(e.kind, ExprKind::Local(local) if self.own.contains(&local))
    }
}

/// The rounds of a loop, first read for what they do, then for whether they read what others write.
struct Rounds<'a, 'c> {
    checker: &'c Checker<'a>,
    functions: &'c [Function],
    own_name: &'c str,
    /// What they assign; `None` while that is gathered.
    written: Option<FxHashMap<Part, Span>>,
    parts: FxHashMap<Part, Span>,
    /// Functions that were read, with the parameters that are the vertex of the round.
    seen: FxHashSet<(FunctionId, Vec<LocalId>)>,
    fault: Option<Diagnostic>,
}

impl Rounds<'_, '_> {
    fn read(&mut self, scope: &Scope<'_>, body: &[Stmt]) {
        each(body, &mut |node| {
            if self.fault.is_some() {
                return;
            }
            match node {
                Node::Stmt(s) if self.written.is_none() => self.note_statement(scope, s),
                Node::Expr(e) => self.note_expression(scope, e),
                _ => {}
            }
        });
    }

    fn note_statement(&mut self, scope: &Scope<'_>, s: &Stmt) {
        let mut fail = |message: &str| self.fail(scope, s.span, message, IN_TURN);
        match &s.kind {
            StmtKind::Make { .. } | StmtKind::MakeRing { .. } => fail("a parallel round edits no rings of vertices"),
            StmtKind::Erase { from: ring, .. } | StmtKind::Replace { ring, .. } | StmtKind::Splice { ring, .. } => {
                match ring {
                    Ring::Of { .. } => fail("a parallel round edits no rings of vertices"),
                    Ring::Variable { local, span } => self.assign(scope, *local, *span),
                }
            }
            StmtKind::Append { ring, .. } => self.assign(scope, *ring, s.span),
            StmtKind::Add { .. } | StmtKind::Remove { .. } | StmtKind::Merge { .. } => {
                fail("a parallel round adds to no mesh and takes from none");
            }
            StmtKind::Synchronize(_) => fail("a parallel round makes no old values: they are those before the loop"),
            StmtKind::Print(_) => fail("a parallel round prints nothing, for rounds have no order"),
            _ => {}
        }
    }

    fn note_expression(&mut self, scope: &Scope<'_>, e: &Expr) {
        let first = self.written.is_none();
        match &e.kind {
            ExprKind::Create if first => {
                let hint = "a variable for one that is there begins as `null`, as in `vertex q = null;`; \
                            for new ones leave `parallel` out: then rounds run in turn";
                self.fail(scope, e.span, "a parallel round makes no vertices", hint);
            }
            ExprKind::Builtin(builtin, _) if first && matches!(builtin.code(), Code::Random | Code::RandomBetween) => {
                let hint = "draw before the loop, into a property, or leave `parallel` out";
                self.fail(scope, e.span, "random numbers come in an order, and parallel rounds have none", hint);
            }
            ExprKind::Assign { place, .. } | ExprKind::Step(place, ..) if first => self.store(scope, place, e.span),
            ExprKind::AssignSet(local, _) | ExprKind::AssignRing(local, _) if first => {
                self.assign(scope, *local, e.span);
            }
            ExprKind::Load(place) if !first => self.load(scope, place),
            ExprKind::Call(id, arguments) => self.call(scope, *id, arguments, e.span),
            _ => {}
        }
    }

    fn store(&mut self, scope: &Scope<'_>, place: &Place, span: Span) {
        let (part, vertex) = match place {
            Place::Local(local) => return self.assign(scope, *local, span),
            Place::Coordinate(base, _) => return self.store(scope, base, span),
            Place::EdgeProperty { .. } => {
                let message = "a parallel round changes no values of edges, for two rounds meet at each";
                return self.fail(scope, span, message, IN_TURN);
            }
            Place::MeshProperty { .. } => {
                return self.fail(
                    scope,
                    span,
                    "a parallel round changes no values of a mesh, which all share",
                    IN_TURN,
                );
            }
            Place::Position { vertex, .. } => (Part::Position, vertex),
            Place::VertexProperty { property, vertex, .. } => (Part::Property(*property), vertex),
        };
        if !scope.is_own(vertex) {
            let own = self.own_name;
            let message = format!("a parallel round changes values of its own vertex, `{own}`, and of no other");
            let hint = "let each vertex gather what it needs from its neighbours, or leave `parallel` out";
            return self.fail(scope, vertex.span, &message, hint);
        }
        self.parts.entry(part).or_insert(span);
    }

    /// Assigns a variable.
    fn assign(&mut self, scope: &Scope<'_>, local: LocalId, span: Span) {
        let name = scope.function.locals.get(local.0 as usize).map_or("", |l| l.name.as_str());
        if scope.called.is_none() && scope.own.contains(&local) {
            let message = format!("`{name}` is the vertex of the parallel round, and stays so");
            return self.fail(scope, span, &message, "give the other vertex a name of its own");
        }
        if !scope.is_inner(local) {
            let message = format!("`{name}` is one for all parallel rounds, so none may change it");
            let hint = "declare it in the loop, or leave `parallel` out: what adds up over rounds needs them in turn";
            self.fail(scope, span, &message, hint);
        }
    }

    fn load(&mut self, scope: &Scope<'_>, place: &Place) {
        let (part, vertex, name) = match place {
            Place::Coordinate(base, _) => return self.load(scope, base),
            Place::Position { vertex, old: false } => (Part::Position, vertex, "pos"),
            Place::VertexProperty { property, vertex, old: false } => {
                let declared = self.checker.vertex_properties.declarations.get(*property as usize);
                (Part::Property(*property), vertex, declared.map_or("", |d| d.name.as_str()))
            }
            _ => return,
        };
        let Some(&written) = self.written.as_ref().and_then(|w| w.get(&part)) else { return };
        if scope.is_own(vertex) {
            return;
        }
        let (text, span) = (self.checker.text(vertex.span), vertex.span);
        // The mark takes what stands right behind it: of `q$mate$pos` it would make the mate that q had.
        let one = matches!(vertex.kind, ExprKind::Local(_)) || text.starts_with('(') && text.ends_with(')');
        let old = if one { text.to_owned() } else { format!("({text})") };
        let edit = if one { (Span { end: span.start, ..span }, "`".to_owned()) } else { (span, format!("`{old}")) };
        let fault = Fault {
            span,
            message: format!("another round may be changing `{text}${name}`"),
            hint: format!("ask for what it was: `` `{old}${name} ``, after `synchronize` before the loop"),
            edit: Some(edit),
        };
        self.report(scope, fault, Some((written, format!("here rounds change `${name}`"))));
    }

    fn call(&mut self, scope: &Scope<'_>, id: FunctionId, arguments: &[Argument], span: Span) {
        let Some(function) = self.functions.get(id.0 as usize) else { return };
        let mut own = Vec::new();
        for (i, argument) in (0..).zip(arguments) {
            match argument {
                Argument::Value(e) if scope.is_own(e) && !is_assigned(function, LocalId(i)) => own.push(LocalId(i)),
                Argument::Reference(local) if self.written.is_none() && is_assigned(function, LocalId(i)) => {
                    self.assign(scope, *local, span);
                }
                Argument::Reference(local) if scope.own.contains(local) && !is_assigned(function, LocalId(i)) => {
                    own.push(LocalId(i));
                }
                _ => {}
            }
        }
        if self.fault.is_none() && self.seen.insert((id, own.clone())) {
            let called = Some(scope.called.unwrap_or(span));
            super::with_stack(|| self.read(&Scope { function, own, inner: None, called }, &function.body));
        }
    }

    fn fail(&mut self, scope: &Scope<'_>, span: Span, message: &str, hint: &str) {
        let fault = Fault { span, message: message.to_owned(), hint: hint.to_owned(), edit: None };
        self.report(scope, fault, None);
    }

    /// What a function does is said where the loop calls it.
    fn report(&mut self, scope: &Scope<'_>, fault: Fault, label: Option<(Span, String)>) {
        let Fault { span, message, hint, edit } = fault;
        let mut d = Diagnostic::error(scope.called.unwrap_or(span), message);
        if scope.called.is_some() {
            d = d.label(span, "by this");
        }
        if let Some((span, text)) = label {
            d = d.label(span, text);
        }
        self.fault.get_or_insert(match edit {
            Some((place, text)) => d.fix(hint, place, text),
            None => d.hint(hint),
        });
    }
}

/// The variables that are declared in statements.
fn declared(body: &[Stmt]) -> FxHashSet<LocalId> {
    let mut declared = FxHashSet::default();
    each(body, &mut |node| {
        let Node::Stmt(s) = node else { return };
        match &s.kind {
            StmtKind::Declare { local, .. }
            | StmtKind::ForallSet { local, .. }
            | StmtKind::ForallFaces { local, .. } => declared.extend([*local]),
            StmtKind::ForallRing { local, follower, .. } => declared.extend(std::iter::once(*local).chain(*follower)),
            _ => {}
        }
    });
    declared
}

/// Whether a function changes a parameter, or hands it on to be changed.
fn is_assigned(function: &Function, parameter: LocalId) -> bool {
    let mut assigned = false;
    each(&function.body, &mut |node| {
        assigned |= match node {
            Node::Expr(e) => match &e.kind {
                ExprKind::Assign { place, .. } | ExprKind::Step(place, ..) => {
                    let place = if let Place::Coordinate(base, _) = &**place { base } else { place };
                    matches!(**place, Place::Local(local) if local == parameter)
                }
                ExprKind::AssignSet(local, _) | ExprKind::AssignRing(local, _) => *local == parameter,
                ExprKind::Call(_, arguments) => {
                    arguments.iter().any(|a| matches!(a, Argument::Reference(local) if *local == parameter))
                }
                _ => false,
            },
            Node::Stmt(s) => match &s.kind {
                StmtKind::Append { ring, .. } => *ring == parameter,
                StmtKind::Erase { from: Ring::Variable { local, .. }, .. }
                | StmtKind::Replace { ring: Ring::Variable { local, .. }, .. }
                | StmtKind::Splice { ring: Ring::Variable { local, .. }, .. } => *local == parameter,
                _ => false,
            },
            Node::Place(_) | Node::Ring(_) => false,
        };
    });
    assigned
}
