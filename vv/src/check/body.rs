//! A function's body: its variables, what is visible where, and what it does.

use rustc_hash::{FxHashMap, FxHashSet};

use crate::diagnostic::{Diagnostic, Severity};
use crate::ir::{Function, FunctionId, Local, LocalId, Passing, Type};
use crate::mesh;
use crate::source::Span;

use super::Checker;
use super::effects::Effects;
use super::operator::a;

/// The function being checked, or file scope.
#[derive(Default)]
pub(super) struct Body<'a> {
    /// Constants, ranges and defaults are being read: there are no variables, and few calls.
    pub(super) file_scope: bool,
    pub(super) function: Option<FunctionId>,
    /// Loops around the current place.
    pub(super) loops: u32,
    pub(super) effects: Effects,
    /// Unknown names already reported.
    pub(super) unknown: FxHashSet<&'a str>,
    locals: Vec<Local>,
    variables: Vec<Variable<'a>>,
    bindings: FxHashMap<&'a str, Vec<LocalId>>,
    /// What each open scope has declared, outermost first.
    scopes: Vec<Vec<LocalId>>,
}

/// What the checker knows of a variable beside its [`Local`].
struct Variable<'a> {
    name: &'a str,
    role: Role,
    is_const: bool,
    /// Faulty ones are used without a word.
    faulty: bool,
    mentions: u32,
    /// How often it is changed, which is among the mentions.
    changes: u32,
    /// How many scopes were open where it was declared, this one included.
    depth: usize,
    /// Declared as `vertex v;`.
    created: bool,
    /// Nobody misses it if it is not used.
    droppable: bool,
}

/// How a variable came to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    Parameter,
    Local,
    Forall,
    /// The face of a `forall`, which nothing changes.
    Face,
}

/// What is known of a variable where it is declared.
pub(super) struct NewLocal<'a> {
    pub(super) name: &'a str,
    pub(super) span: Span,
    /// `None` for a faulty one.
    pub(super) ty: Option<Type>,
    pub(super) role: Role,
    pub(super) is_const: bool,
}

impl<'a> Body<'a> {
    /// The variable a name means here.
    pub(super) fn find(&self, name: &str) -> Option<LocalId> {
        self.bindings.get(name)?.last().copied()
    }

    /// What engines know of it.
    pub(super) fn local(&self, id: LocalId) -> Option<&Local> {
        self.locals.get(id.0 as usize)
    }

    fn variable(&self, id: LocalId) -> Option<&Variable<'a>> {
        self.variables.get(id.0 as usize)
    }

    pub(super) fn name(&self, id: LocalId) -> &'a str {
        self.variable(id).map_or("", |v| v.name)
    }

    pub(super) fn role(&self, id: LocalId) -> Option<Role> {
        self.variable(id).map(|v| v.role)
    }

    pub(super) fn is_const(&self, id: LocalId) -> bool {
        self.variable(id).is_some_and(|v| v.is_const)
    }

    /// Its type; `None` if it is faulty.
    pub(super) fn type_of(&self, id: LocalId) -> Option<Type> {
        self.variable(id).filter(|v| !v.faulty)?;
        self.local(id).map(|l| l.ty)
    }

    /// The program uses it, for reading or writing.
    pub(super) fn mention(&mut self, id: LocalId) {
        if let Some(v) = self.variables.get_mut(id.0 as usize) {
            v.mentions += 1;
        }
    }

    /// The program changes it, with what has been mentioned just now.
    pub(super) fn change(&mut self, id: LocalId) {
        if let Some(v) = self.variables.get_mut(id.0 as usize) {
            v.changes += 1;
        }
    }

    /// How often it has been changed so far.
    pub(super) fn changes(&self, id: LocalId) -> u32 {
        self.variable(id).map_or(0, |v| v.changes)
    }

    /// It is `vertex v;`, declared in the innermost open scope, and has been mentioned once, just now.
    pub(super) fn is_created_and_first_mentioned(&self, id: LocalId) -> bool {
        self.variable(id).is_some_and(|v| v.created && v.mentions == 1 && v.depth == self.scopes.len())
    }

    pub(super) fn set_created(&mut self, id: LocalId) {
        if let Some(v) = self.variables.get_mut(id.0 as usize) {
            v.created = true;
        }
    }

    /// Its first value costs nothing and does nothing.
    pub(super) fn set_droppable(&mut self, id: LocalId) {
        if let Some(v) = self.variables.get_mut(id.0 as usize) {
            v.droppable = true;
        }
    }

    /// What is visible here, the newest first.
    pub(super) fn visible(&self) -> impl Iterator<Item = LocalId> {
        let all = self.scopes.iter().rev().flat_map(|s| s.iter().rev().copied());
        all.filter(|&id| self.find(self.name(id)) == Some(id))
    }
}

impl<'a> Checker<'a> {
    pub(super) fn define_function(&mut self, id: FunctionId) -> Function {
        let index = id.0 as usize;
        self.body = Body { function: Some(id), scopes: vec![Vec::new()], ..Body::default() };
        let (name, span, returns, body) = {
            let s = &self.signatures[index];
            (s.name, s.span, s.returns, s.body)
        };
        let new: Vec<NewLocal<'a>> = self.signatures[index]
            .parameters
            .iter()
            .map(|p| NewLocal { name: p.name, span: p.span, ty: p.ty, role: Role::Parameter, is_const: p.is_const })
            .collect();
        for parameter in new {
            self.declare(parameter);
        }
        let reported = self.diagnostics.len();
        let mut statements = Vec::new();
        let falls_through = body.is_some_and(|body| self.statements(&body.statements, &mut statements));
        if falls_through && returns != Type::Void {
            self.missing_return(id);
        }
        self.close_scope();
        // What is faulty may have been the use.
        if !self.diagnostics.iter().skip(reported).any(|d| d.severity == Severity::Error) {
            self.warn_of_unused_variables();
            self.warn_of_unused_changes(id);
        }
        let done = std::mem::take(&mut self.body);
        self.effects.push(done.effects);
        let parameters = self.signatures[index].parameters.iter().map(|p| p.passing).collect();
        Function { name: name.to_owned(), returns, parameters, locals: done.locals, body: statements, span }
    }

    fn missing_return(&mut self, id: FunctionId) {
        let Some(s) = self.signatures.get(id.0 as usize) else { return };
        let (name, returned, span, at) = (s.name, s.return_span, s.span, s.body.and_then(|b| b.span));
        let end = at.map_or(span, |b| Span { start: b.end.saturating_sub(1).max(b.start), ..b });
        let returned_type = a(s.returns);
        self.report(
            Diagnostic::error(end, format!("`{name}` may end here without returning {returned_type}"))
                .label(returned, "promised here"),
        );
    }

    fn warn_of_unused_variables(&mut self) {
        let unused: Vec<(Span, &str)> = self
            .body
            .locals
            .iter()
            .zip(&self.body.variables)
            .filter(|(_, v)| v.mentions == 0 && v.droppable && !v.faulty && !v.name.starts_with('_'))
            .map(|(local, v)| (local.span, v.name))
            .collect();
        for (span, name) in unused {
            self.report(Diagnostic::warning(span, format!("`{name}` is never used")));
        }
    }

    /// Meshes and rings that are filled for nothing: copies, and those that a `merge` was forgotten for.
    fn warn_of_unused_changes(&mut self, function: FunctionId) {
        let Some(signature) = self.signatures.get(function.0 as usize) else { return };
        let mut warnings = Vec::new();
        for (i, (local, v)) in self.body.locals.iter().zip(&self.body.variables).enumerate() {
            let (name, span) = (v.name, local.span);
            let what = match local.ty {
                Type::Mesh => "mesh",
                Type::Ring => "ring",
                Type::Value(_) | Type::Void => continue,
            };
            if v.changes == 0 || v.changes < v.mentions || v.faulty || name.starts_with('_') {
                continue;
            }
            match (v.role, signature.parameters.get(i)) {
                (Role::Parameter, Some(p)) if p.passing == Passing::Value => {
                    let at = Span { start: p.type_span.end, ..p.type_span };
                    let message = format!("`{name}` is a copy, and nobody sees what is done to it");
                    let warning = Diagnostic::warning(p.type_span, message);
                    warnings.push(warning.fix(format!("take the {what} itself, `{what}& {name}`"), at, "&"));
                }
                (Role::Local, _) => {
                    let warning = Diagnostic::warning(span, format!("`{name}` is filled, but not used"));
                    warnings.push(match local.ty {
                        Type::Mesh => warning.hint(format!("is a `merge` missing, as in `merge S with {name};`?")),
                        _ => warning,
                    });
                }
                _ => {}
            }
        }
        for warning in warnings {
            self.report(warning);
        }
    }

    pub(super) fn open_scope(&mut self) {
        self.body.scopes.push(Vec::new());
    }

    pub(super) fn close_scope(&mut self) {
        for id in self.body.scopes.pop().unwrap_or_default() {
            let name = self.body.name(id);
            if let Some(ids) = self.body.bindings.get_mut(name) {
                ids.pop();
            }
        }
    }

    /// Makes a variable visible from here to the end of the innermost scope.
    pub(super) fn declare(&mut self, new: NewLocal<'a>) -> LocalId {
        let depth = self.body.scopes.len();
        if let Some(first) = self.body.find(new.name)
            && self.body.variable(first).is_some_and(|v| v.depth == depth)
            && let Some(span) = self.body.local(first).map(|l| l.span)
        {
            self.report(
                Diagnostic::error(new.span, format!("there is a variable `{}` already", new.name))
                    .label(span, "the first one"),
            );
        }
        let id = LocalId(self.body.locals.len() as u32);
        // Programs with a faulty variable do not run, so its type does not matter.
        let ty = new.ty.unwrap_or(Type::Value(mesh::Type::Int));
        self.body.locals.push(Local { name: new.name.to_owned(), ty, span: new.span });
        self.body.variables.push(Variable {
            name: new.name,
            role: new.role,
            is_const: new.is_const,
            faulty: new.ty.is_none(),
            mentions: 0,
            changes: 0,
            depth,
            created: false,
            droppable: false,
        });
        self.body.bindings.entry(new.name).or_default().push(id);
        if let Some(scope) = self.body.scopes.last_mut() {
            scope.push(id);
        }
        id
    }
}
