//! What a text declares.

use std::ops::Range;

use crate::source::Span;
use crate::syntax::tree::{Ast, Block, Declaration, Element, Function, Item, Stmt, StmtKind, TypeKind};

/// Something that has a name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symbol {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: SymbolKind,
    /// Its declaration, in one line.
    pub usage: String,
    /// The comment right before it.
    pub doc: String,
    /// Its name in the declaration; `None` if that is in another file.
    pub place: Option<Range<usize>>,
    /// Where it is known; `None` for everywhere.
    pub scope: Option<Range<usize>>,
    /// Whether it is a set of vertices.
    pub is_mesh: bool,
}

/// Kinds of symbols.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SymbolKind {
    /// A function, a rule among them.
    Function,
    /// A constant or parameter of the program.
    Global,
    /// A variable or a parameter of a function.
    Local,
    /// A property of what the word says.
    Property(Element),
}

impl Symbol {
    pub(super) fn is_visible(&self, at: usize) -> bool {
        self.scope.as_ref().is_none_or(|scope| scope.start <= at && at <= scope.end)
    }

    /// Whether both are declarations of the same thing. Functions and properties have no others of their name.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        self.name == other.name
            && self.kind == other.kind
            && self.scope == other.scope
            && (self.scope.is_none() || self.place == other.place)
    }

    pub(super) fn is_property(&self) -> bool {
        matches!(self.kind, SymbolKind::Property(_))
    }
}

/// All that a text declares, in its order.
pub(super) fn of(ast: &Ast, text: &str) -> Vec<Symbol> {
    let mut walk = Walk { text, symbols: Vec::new() };
    for item in &ast.items {
        walk.item(item);
    }
    walk.symbols
}

struct Walk<'t> {
    text: &'t str,
    symbols: Vec<Symbol>,
}

impl Walk<'_> {
    fn item(&mut self, item: &Item) {
        match item {
            Item::Include { .. } => {}
            Item::Function(function) => self.function(function),
            Item::Phase { name, body } => {
                if let Some(span) = body.span {
                    let usage = "mesh S".to_owned();
                    let doc = format!("the mesh that `{}` works on", name.text);
                    self.local("S".to_owned(), None, usage, doc, range(span), true);
                }
                self.block(body);
            }
            Item::Properties { element, fields, .. } => {
                let of = match element {
                    Element::Vertex => "vertex",
                    Element::Edge => "edge",
                    Element::Mesh => "mesh",
                };
                for field in fields {
                    self.declaration(field, SymbolKind::Property(*element), None, &format!(" of every {of}"));
                }
            }
            Item::Constant(declaration) => self.declaration(declaration, SymbolKind::Global, None, ""),
            Item::Param(param) => {
                let symbol = Symbol {
                    name: param.name.text.clone(),
                    kind: SymbolKind::Global,
                    usage: self.line(param.span),
                    doc: self.doc(param.span.start as usize),
                    place: Some(range(param.name.span)),
                    scope: None,
                    is_mesh: false,
                };
                self.symbols.push(symbol);
            }
        }
    }

    fn function(&mut self, function: &Function) {
        self.symbols.push(Symbol {
            name: function.name.text.clone(),
            kind: SymbolKind::Function,
            usage: self.line(function.span),
            doc: self.doc(function.span.start as usize),
            place: Some(range(function.name.span)),
            scope: None,
            is_mesh: false,
        });
        let Some((block, body)) = function.body.as_ref().and_then(|block| Some((block, block.span?))) else { return };
        for parameter in &function.parameters {
            let usage = self.line(parameter.span);
            let (name, place) = (parameter.name.text.clone(), Some(range(parameter.name.span)));
            let scope = parameter.span.start as usize..body.end as usize;
            self.local(name, place, usage, String::new(), scope, parameter.ty.kind == TypeKind::Mesh);
        }
        self.block(block);
    }

    fn local(
        &mut self,
        name: String,
        place: Option<Range<usize>>,
        usage: String,
        doc: String,
        scope: Range<usize>,
        is_mesh: bool,
    ) {
        self.symbols.push(Symbol { name, kind: SymbolKind::Local, usage, doc, place, scope: Some(scope), is_mesh });
    }

    fn declaration(&mut self, declaration: &Declaration, kind: SymbolKind, end: Option<usize>, behind: &str) {
        let doc = match kind {
            SymbolKind::Local => String::new(),
            _ => self.doc(declaration.span.start as usize),
        };
        let is_const = if declaration.is_const { "const " } else { "" };
        let ty = self.line(declaration.ty.span);
        for declarator in &declaration.declarators {
            let name = &declarator.name;
            let value = match (&declarator.init, kind) {
                (Some(init), SymbolKind::Global | SymbolKind::Property(_)) => format!(" = {}", self.line(init.span)),
                _ => String::new(),
            };
            self.symbols.push(Symbol {
                name: name.text.clone(),
                kind,
                usage: format!("{is_const}{ty} {}{value}{behind}", name.text),
                doc: doc.clone(),
                place: Some(range(name.span)),
                scope: end.map(|end| name.span.start as usize..end),
                is_mesh: declaration.ty.kind == TypeKind::Mesh,
            });
        }
    }

    fn block(&mut self, block: &Block) {
        let end = block.span.map_or(self.text.len(), |span| span.end as usize);
        for statement in &block.statements {
            self.statement(statement, end);
        }
    }

    fn statement(&mut self, statement: &Stmt, end: usize) {
        let own = range(statement.span);
        match &statement.kind {
            StmtKind::Block(block) => self.block(block),
            StmtKind::Declare(declaration) => self.declaration(declaration, SymbolKind::Local, Some(end), ""),
            StmtKind::If { then, otherwise, .. } => {
                self.statement(then, end);
                if let Some(otherwise) = otherwise {
                    self.statement(otherwise, end);
                }
            }
            StmtKind::While { body, .. } | StmtKind::DoWhile { body, .. } => self.statement(body, end),
            StmtKind::For { init, body, .. } => {
                if let Some(init) = init {
                    self.statement(init, own.end);
                }
                self.statement(body, own.end);
            }
            StmtKind::Forall(forall) => {
                let (ty, is) = match forall.faces {
                    Some(_) => ("ring", "the face that the loop is at, as the ring of its corners"),
                    None => ("vertex", "the vertex that the loop is at"),
                };
                let followers = forall.follower.iter().map(|f| (f, "vertex", "the vertex after it in the ring"));
                for (name, ty, is) in std::iter::once((&forall.variable, ty, is)).chain(followers) {
                    let usage = format!("{ty} {}", name.text);
                    self.local(name.text.clone(), Some(range(name.span)), usage, is.to_owned(), own.clone(), false);
                }
                self.statement(&forall.body, own.end);
            }
            _ => {}
        }
    }

    /// A stretch of the text in one line.
    fn line(&self, span: Span) -> String {
        let text = self.text.get(range(span)).unwrap_or_default();
        text.trim_end_matches(';').split_whitespace().collect::<Vec<_>>().join(" ")
    }

    fn doc(&self, start: usize) -> String {
        comment_before(self.text, start)
    }
}

/// The comment that ends right before the line at `start`, that of a declaration, in one line.
#[must_use]
pub fn comment_before(text: &str, start: usize) -> String {
    let before = text.get(..start).unwrap_or_default();
    let line = before.rfind('\n').map_or(0, |i| i + 1);
    let above = before[..line].lines().rev().map(str::trim);
    if above.clone().next().is_some_and(|last| last.ends_with("*/") && !last.starts_with("//")) {
        let block = before[..line].trim_end().strip_suffix("*/").unwrap_or_default();
        let opening = block.rfind("/*").unwrap_or_default();
        // One that ends a line of code is about that line.
        let is_alone = block[..opening].rsplit('\n').next().is_none_or(|before| before.trim().is_empty());
        return if is_alone { block_comment(block[opening..].trim_start_matches("/*")) } else { String::new() };
    }
    let mut lines: Vec<&str> =
        above.take_while(|line| line.starts_with("//")).map(|line| line.trim_start_matches('/').trim()).collect();
    lines.reverse();
    lines.join(" ")
}

/// What stands between `/*` and `*/` in one line, without the stars that lines begin with.
#[must_use]
pub fn block_comment(inside: &str) -> String {
    let lines = inside.lines().map(|line| line.trim().trim_start_matches('*').trim());
    lines.filter(|line| !line.is_empty()).collect::<Vec<_>>().join(" ")
}

fn range(span: Span) -> Range<usize> {
    span.start as usize..span.end as usize
}
