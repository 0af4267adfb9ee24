//! File scope: signatures of functions, constants, parameters, properties.

use crate::diagnostic::Diagnostic;
use crate::ir::{self, FunctionId, Global, GlobalId, Param as IrParam, Passing, PropertyDeclaration, Type};
use crate::mesh::{self, Value};
use crate::source::{FileId, Span};
use crate::syntax::tree::{
    Ast, Block, Declaration, Declarator, Element, Expr, Function, Item, Param, TypeKind, TypeName,
};

use super::operator::{type_of, value_type};
use super::{Checker, GlobalName, GlobalValue};

/// A function as its calls and its body see it.
pub(super) struct Signature<'a> {
    pub(super) name: &'a str,
    pub(super) span: Span,
    pub(super) returns: Type,
    pub(super) return_span: Span,
    pub(super) parameters: Vec<Parameter<'a>>,
    /// `None` where there is only a declaration.
    pub(super) body: Option<&'a Block>,
}

pub(super) struct Parameter<'a> {
    pub(super) name: &'a str,
    pub(super) span: Span,
    pub(super) type_span: Span,
    /// `None` for a faulty one.
    pub(super) ty: Option<Type>,
    pub(super) passing: Passing,
    pub(super) is_const: bool,
}

impl Signature<'_> {
    /// Whether calls cannot tell one from the other.
    fn promises(&self, other: &Self) -> bool {
        let passed = |s: &Self| s.parameters.iter().map(|p| (p.ty, p.passing)).collect::<Vec<_>>();
        self.returns == other.returns && passed(self) == passed(other)
    }

    fn is_step(&self) -> bool {
        let [parameter] = &self.parameters[..] else { return false };
        self.returns == Type::Void && parameter.ty == Some(Type::Mesh) && parameter.passing == Passing::Reference
    }
}

impl<'a> Checker<'a> {
    /// Learns the names of file scope and the signatures of all functions.
    pub(super) fn declare_functions(&mut self, files: &'a [(FileId, Ast)]) {
        let mut declared = Vec::new();
        for (file, ast) in files {
            for item in &ast.items {
                match item {
                    Item::Function(f) => {
                        let signature = self.signature(f);
                        if f.body.is_some() {
                            self.add_function(*file, signature, f.is_static);
                        } else {
                            declared.push((f.span, signature));
                        }
                    }
                    Item::Phase { name, body } => {
                        let s = Parameter {
                            name: "S",
                            span: name.span,
                            type_span: name.span,
                            ty: Some(Type::Mesh),
                            passing: Passing::Reference,
                            is_const: false,
                        };
                        let signature = Signature {
                            name: &name.text,
                            span: name.span,
                            returns: Type::Void,
                            return_span: name.span,
                            parameters: vec![s],
                            body: Some(body),
                        };
                        self.add_function(*file, signature, false);
                    }
                    Item::Constant(declaration) => {
                        for d in &declaration.declarators {
                            self.announce_global(&d.name.text, d.name.span);
                        }
                    }
                    Item::Param(p) => self.announce_global(&p.name.text, p.name.span),
                    Item::Include { .. } | Item::Properties { .. } => {}
                }
            }
        }
        let main = files.iter().filter(|(file, _)| *file == FileId::MAIN).flat_map(|(_, ast)| &ast.items);
        let includes: Vec<(&str, Span)> = main
            .filter_map(|item| match item {
                Item::Include { path, span } => Some((path.as_str(), *span)),
                _ => None,
            })
            .collect();
        for (span, signature) in declared {
            self.keep_promise(span, signature, &includes);
        }
    }

    /// A function that is declared somewhere must be defined as it is declared, and must be if a step needs it.
    /// `includes` are those of the program's own file.
    fn keep_promise(&mut self, span: Span, promised: Signature<'a>, includes: &[(&str, Span)]) {
        let name = promised.name;
        let form = self.text(span).split_whitespace().collect::<Vec<_>>().join(" ");
        let Some(found) = self.function_names.get(name).and_then(|f| self.signatures.get(f.0 as usize)) else {
            let asker = self.sources.file(span.file).filter(|_| span.file != FileId::MAIN);
            let asked = asker.and_then(|asker| includes.iter().find(|(path, _)| asker.name.ends_with(path)));
            let error = match asked {
                Some(&(file, at)) => {
                    let error = Diagnostic::error(at, format!("`{file}` needs a function `{name}`, and there is none"));
                    error.label(span, "asked for here")
                }
                None => Diagnostic::error(span, format!("`{name}` is declared, but nowhere defined")),
            };
            let error = error.hint(format!("write `{form} {{ … }}`"));
            // Calls shall find it all the same.
            let id = FunctionId(self.signatures.len() as u32);
            self.undefined.push((id, error));
            self.function_names.insert(name, id);
            self.signatures.push(promised);
            return;
        };
        if found.promises(&promised) {
            return;
        }
        let error = Diagnostic::error(found.span, format!("`{name}` is declared otherwise: `{form}`"));
        self.report(error.label(span, "declared here"));
    }

    fn announce_global(&mut self, name: &'a str, span: Span) {
        self.global_names.entry(name).or_insert(GlobalName { span, id: None, declared: false });
    }

    fn signature(&mut self, f: &'a Function) -> Signature<'a> {
        let parameters = f
            .parameters
            .iter()
            .map(|p| {
                let ty = Some(type_of(p.ty.kind)).filter(|&t| t != Type::Void);
                if ty.is_none() {
                    self.report(Diagnostic::error(p.ty.span, "a parameter cannot be `void`"));
                }
                // What is not changed may as well be a copy, and a copy takes any expression.
                let passing = if p.by_reference && !p.is_const { Passing::Reference } else { Passing::Value };
                Parameter {
                    name: &p.name.text,
                    span: p.name.span,
                    type_span: p.ty.span,
                    ty,
                    passing,
                    is_const: p.is_const,
                }
            })
            .collect();
        Signature {
            name: &f.name.text,
            span: f.name.span,
            returns: type_of(f.return_type.kind),
            return_span: f.return_type.span,
            parameters,
            body: f.body.as_ref(),
        }
    }

    fn add_function(&mut self, file: FileId, signature: Signature<'a>, is_static: bool) {
        let id = FunctionId(self.signatures.len() as u32);
        let name = signature.name;
        if let Some(first) = self.function_names.get(name).and_then(|f| self.signatures.get(f.0 as usize)) {
            self.report(
                Diagnostic::error(signature.span, format!("there is a function `{name}` already"))
                    .label(first.span, "the first one")
                    .hint("functions differ in their names, types do not tell them apart"),
            );
        } else {
            self.function_names.insert(name, id);
            if name == "start" {
                self.start = Some(id);
                if !signature.is_step() {
                    self.report(
                        Diagnostic::error(signature.span, "`start` must be `void start(mesh& S)`")
                            .hint("it prepares the mesh before the first step; call other functions otherwise"),
                    );
                }
            } else if file == FileId::MAIN && !is_static && signature.is_step() {
                self.rules.push(id);
            }
        }
        self.signatures.push(signature);
    }

    /// Where there is no step at all, `void f(mesh S)` was hardly meant to be none.
    pub(super) fn warn_of_copied_mesh(&mut self) {
        if !self.rules.is_empty() {
            return;
        }
        let copied = self.signatures.iter().find(|s| {
            let [p] = &s.parameters[..] else { return false };
            let copies = p.ty == Some(Type::Mesh) && p.passing == Passing::Value && !p.is_const;
            s.span.file == FileId::MAIN && s.returns == Type::Void && copies
        });
        if let Some((name, span)) = copied.and_then(|s| Some((s.name, s.parameters.first()?.type_span))) {
            let at = Span { start: span.end, ..span };
            // One mistake, one message.
            self.diagnostics.retain(|d| d.span != Some(span));
            self.report(
                Diagnostic::warning(span, format!("`{name}` gets a copy of the mesh, so it is no step of the modeler"))
                    .fix("take the mesh itself, `mesh& S`", at, "&"),
            );
        }
    }

    /// Constants, parameters and properties, in the order of the text.
    pub(super) fn declare_globals(&mut self, files: &'a [(FileId, Ast)]) {
        self.body.file_scope = true;
        for item in files.iter().flat_map(|(_, ast)| &ast.items) {
            match item {
                Item::Constant(declaration) => self.declare_constants(declaration),
                Item::Param(param) => self.declare_param(param),
                Item::Properties { element, fields, .. } => {
                    for field in fields {
                        self.declare_properties(*element, field);
                    }
                }
                Item::Include { .. } | Item::Function(_) | Item::Phase { .. } => {}
            }
        }
        self.body.file_scope = false;
    }

    fn declare_constants(&mut self, declaration: &'a Declaration) {
        if !declaration.is_const {
            let mut error = Diagnostic::error(
                declaration.span,
                "a program keeps nothing at file scope but constants and parameters",
            );
            let names: Vec<&str> = declaration.declarators.iter().map(|d| d.name.text.as_str()).collect();
            let (first, kind) = (names.first().copied().unwrap_or("x"), self.text(declaration.ty.span));
            error = if declaration.ty.kind == TypeKind::Mesh {
                error.hint("declare the mesh in a function, or take it as a parameter")
            } else {
                error.hint(format!(
                    "what changes from step to step belongs to the mesh: `mesh {{ {kind} {first}; }};`, used as `S${first}`"
                ))
            };
            if declaration.ty.kind != TypeKind::Mesh && declaration.declarators.iter().all(|d| d.init.is_some()) {
                let at = Span { end: declaration.span.start, ..declaration.span };
                error = error.fix("if it never changes, declare it `const`", at, "const ");
            }
            self.report(error);
        }
        let ty = if declaration.is_const { self.global_type(declaration.ty) } else { value_type(declaration.ty.kind) };
        for d in &declaration.declarators {
            let init = match &d.init {
                Some(init) => self.global_init(init, ty),
                None if declaration.is_const => {
                    self.fail(Diagnostic::error(d.name.span, format!("the constant `{}` needs a value", d.name.text)))
                }
                None => None,
            };
            let init = init.filter(|_| declaration.is_const);
            self.add_global(&d.name.text, d.name.span, init.map(|(init, value)| (init, value, None)));
        }
    }

    /// The type of a constant or parameter.
    fn global_type(&mut self, ty: TypeName) -> Option<mesh::Type> {
        match value_type(ty.kind) {
            Some(mesh::Type::Vertex) | None => {
                let text = self.text(ty.span);
                self.fail(Diagnostic::error(ty.span, format!("a constant cannot be of type `{text}`")))
            }
            value => value,
        }
    }

    fn global_init(&mut self, init: &'a Expr, ty: Option<mesh::Type>) -> Option<(ir::Expr, GlobalValue)> {
        let init = self.value(init);
        let init = self.implicitly(init?, ty?)?;
        let value = self.constant(&init);
        Some((init, value))
    }

    fn add_global(&mut self, name: &'a str, span: Span, global: Option<(ir::Expr, GlobalValue, Option<IrParam>)>) {
        let entry = self.global_names.entry(name).or_insert(GlobalName { span, id: None, declared: false });
        if entry.declared {
            let first = entry.span;
            self.report(
                Diagnostic::error(span, format!("there is a constant or parameter `{name}` already"))
                    .label(first, "the first one"),
            );
            return;
        }
        *entry = GlobalName { span, id: None, declared: true };
        let Some((init, value, param)) = global else { return };
        let Type::Value(ty) = init.ty else { return };
        entry.id = Some(GlobalId(self.globals.len() as u32));
        self.globals.push(Global { name: name.to_owned(), ty, init, param, span });
        self.defaults.push(value);
    }

    fn declare_param(&mut self, param: &'a Param) {
        let ty = self.global_type(param.ty);
        let init = self.global_init(&param.value, ty);
        let range = param.range.as_ref().and_then(|(low, high)| self.range(low, high, ty));
        let global = init.map(|(init, value)| {
            let default = value.value;
            if let (Some(default), Some((low, high))) = (default, range)
                && !(number(low) <= number(default) && number(default) <= number(high))
            {
                let places = self.text(param.value.span);
                self.report(
                    Diagnostic::error(
                        param.value.span,
                        format!("the default `{places}` of `{}` is outside its range", param.name.text),
                    )
                    .evidence(format!(
                        "{} is not in [{}, {}]",
                        shown(default),
                        shown(low),
                        shown(high)
                    )),
                );
            }
            let default = default.unwrap_or(Value::zero(default_type(ty)));
            (init, GlobalValue { varies: true, ..value }, Some(IrParam { default, range }))
        });
        self.add_global(&param.name.text, param.name.span, global);
    }

    fn range(&mut self, low: &'a Expr, high: &'a Expr, ty: Option<mesh::Type>) -> Option<(Value, Value)> {
        let span = low.span.to(high.span);
        if !matches!(ty, None | Some(mesh::Type::Int | mesh::Type::Double)) {
            return self.fail(Diagnostic::error(span, "only parameters of type `int` or `double` have a range"));
        }
        let (low, high) = (self.fixed(low, ty, "a range"), self.fixed(high, ty, "a range"));
        let (low, high) = (low?, high?);
        if number(low) <= number(high) {
            return Some((low, high));
        }
        self.fail(Diagnostic::error(span, "the range is empty: it goes from low to high"))
    }

    /// A value that does not depend on parameters.
    fn fixed(&mut self, e: &'a Expr, ty: Option<mesh::Type>, what: &str) -> Option<Value> {
        let (init, value) = self.global_init(e, ty)?;
        if value.varies {
            return self.fail(
                Diagnostic::error(init.span, format!("{what} cannot depend on a parameter"))
                    .hint("it is fixed before parameters get their values"),
            );
        }
        value.value
    }

    fn declare_properties(&mut self, element: Element, declaration: &'a Declaration) {
        let ty = value_type(declaration.ty.kind);
        if ty.is_none() {
            let text = self.text(declaration.ty.span);
            self.report(Diagnostic::error(declaration.ty.span, format!("a property cannot be of type `{text}`")));
        }
        for d in &declaration.declarators {
            self.declare_property(element, d, ty);
        }
    }

    fn declare_property(&mut self, element: Element, d: &'a Declarator, ty: Option<mesh::Type>) {
        let (name, span) = (d.name.text.as_str(), d.name.span);
        let default = match &d.init {
            Some(init) => self.fixed(init, ty, "the default of a property"),
            None => ty.map(Value::zero),
        };
        if name == "pos" {
            self.report(Diagnostic::error(span, "`pos` is the position, which every vertex has"));
            return;
        }
        if let Some(&(first, index)) = self.properties(element).names.get(name) {
            // Files that know nothing of each other may need the same.
            let known = index.and_then(|i| self.properties(element).declarations.get(i as usize)).map(|p| p.default);
            if first.file != span.file && (known.is_none() || default.is_none() || known == default) {
                return;
            }
            let error = Diagnostic::error(span, format!("there is a property `{name}` already"));
            let error = error.label(first, "the first one");
            self.report(if first.file == span.file {
                error
            } else {
                error.hint("files may declare the same property, if its type and default are the same")
            });
            return;
        }
        let properties = self.properties_mut(element);
        let index = default.map(|_| properties.declarations.len() as u32);
        properties.names.insert(name, (span, index));
        if let Some(default) = default {
            properties.declarations.push(PropertyDeclaration { name: name.to_owned(), default, span });
        }
    }
}

fn default_type(ty: Option<mesh::Type>) -> mesh::Type {
    ty.unwrap_or(mesh::Type::Double)
}

/// For comparison with the ends of a range; ints beyond 2⁵³ are compared as the nearest doubles.
fn number(value: Value) -> f64 {
    match value {
        Value::Int(i) => i as f64,
        Value::Double(x) => x,
        Value::Bool(_) | Value::Vec(_) | Value::Vertex(_) => f64::NAN,
    }
}

fn shown(value: Value) -> String {
    match value {
        Value::Int(i) => i.to_string(),
        Value::Double(x) => x.to_string(),
        other => format!("{other:?}"),
    }
}
