//! The tree of a program as written, one node per construct, each with its span.
//!
//! The parser makes a tree of any text. Where it could not read something it has reported an error and left
//! [`ExprKind::Error`], or nothing.

use crate::source::Span;

/// A file: its items in order.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ast {
    /// In the order of the text.
    pub items: Vec<Item>,
}

/// An identifier with its place.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Name {
    /// As written.
    pub text: String,
    /// Where.
    pub span: Span,
}

/// What stands at file scope.
#[derive(Debug, Clone, PartialEq)]
pub enum Item {
    /// `#include "file.vv"`; `span` covers the quoted path.
    Include {
        /// Between the quotes.
        path: String,
        /// The quoted path.
        span: Span,
    },
    /// A function, a rule among them.
    Function(Function),
    /// The original's `start { … }` and `step { … }`, in which `S` is predeclared.
    Phase {
        /// `start` or `step`.
        name: Name,
        /// Its statements.
        body: Block,
    },
    /// `vertex { double age = 0; int kind; };`, likewise `edge` and `mesh`.
    Properties {
        /// Whose.
        element: Element,
        /// One declaration per line of the block.
        fields: Vec<Declaration>,
        /// The whole block.
        span: Span,
    },
    /// `const double k = 1.0/16.0;`; also a declaration without `const`, which the checker refuses.
    Constant(Declaration),
    /// `param double w = 1.0/16.0 in [0, 0.125];`
    Param(Param),
}

/// What carries a property.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Element {
    /// `v$age`
    Vertex,
    /// `(p|q)$sharpness`
    Edge,
    /// `S$generation`
    Mesh,
}

/// A type as written; `point` and `vector` have become [`TypeKind::Vec`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TypeName {
    /// Which.
    pub kind: TypeKind,
    /// Where.
    pub span: Span,
}

/// The types that have names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the type of its name")]
pub enum TypeKind {
    Void,
    Bool,
    Int,
    Double,
    Vec,
    Vertex,
    Mesh,
    Ring,
}

/// `[static] type name(parameters) { … }`, or `;` in place of the body
#[derive(Debug, Clone, PartialEq)]
pub struct Function {
    /// `static`: a function that is no rule.
    pub is_static: bool,
    /// Before the name.
    pub return_type: TypeName,
    /// What calls use.
    pub name: Name,
    /// In order.
    pub parameters: Vec<Parameter>,
    /// Its statements; `None` where it is only declared, for the program to define elsewhere.
    pub body: Option<Block>,
    /// From the return type to the closing parenthesis.
    pub span: Span,
}

/// `[const] type [&] name`
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// `const`
    pub is_const: bool,
    /// Its type.
    pub ty: TypeName,
    /// `&`
    pub by_reference: bool,
    /// Its name.
    pub name: Name,
    /// All of it.
    pub span: Span,
}

/// `[const] type a = e, b;`
#[derive(Debug, Clone, PartialEq)]
pub struct Declaration {
    /// `const`
    pub is_const: bool,
    /// The type of all declarators.
    pub ty: TypeName,
    /// At least one, unless an error was reported.
    pub declarators: Vec<Declarator>,
    /// All of it.
    pub span: Span,
}

/// `name [= init]`; `name(args)` arrives as `name = type(args)` for `vec`.
#[derive(Debug, Clone, PartialEq)]
pub struct Declarator {
    /// Its name.
    pub name: Name,
    /// After `=`.
    pub init: Option<Expr>,
}

/// `param type name = value [in [low, high]];`
#[derive(Debug, Clone, PartialEq)]
pub struct Param {
    /// Its type.
    pub ty: TypeName,
    /// Its name.
    pub name: Name,
    /// Its default.
    pub value: Expr,
    /// Range of the slider.
    pub range: Option<(Expr, Expr)>,
    /// All of it.
    pub span: Span,
}

/// `{ … }`
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    /// In order.
    pub statements: Vec<Stmt>,
    /// The braces and all between; `None` only for a block that is missing.
    pub span: Option<Span>,
}

/// A statement.
#[derive(Debug, Clone, PartialEq)]
pub struct Stmt {
    /// Which.
    pub kind: StmtKind,
    /// All of it.
    pub span: Span,
}

/// The statements of C++ that vv keeps, and those of the algebra.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the code shown at each variant names its parts")]
pub enum StmtKind {
    /// `;`
    Empty,
    /// `{ … }`
    Block(Block),
    /// `double x = 0, y;`
    Declare(Declaration),
    /// `x += 1;`
    Expr(Expr),
    /// `if (condition) then else otherwise`
    If { condition: Expr, then: Box<Stmt>, otherwise: Option<Box<Stmt>> },
    /// `while (condition) body`
    While { condition: Expr, body: Box<Stmt> },
    /// `do body while (condition);`
    DoWhile { body: Box<Stmt>, condition: Expr },
    /// `for (init; condition; update) body`; `init` is a declaration, an expression or empty.
    For { init: Option<Box<Stmt>>, condition: Option<Expr>, update: Vec<Expr>, body: Box<Stmt> },
    /// `forall …`
    Forall(Box<Forall>),
    /// `break;`
    Break,
    /// `continue;`
    Continue,
    /// `return value;`
    Return(Option<Expr>),
    /// `make {items} nb_of of;`
    Make { items: Vec<Expr>, of: Expr },
    /// `make ring nb_of of;`
    MakeRing { ring: Expr, of: Expr },
    /// `erase item from from;`
    Erase { item: Expr, from: Expr },
    /// `replace item with with in ring;`
    Replace { item: Expr, with: Expr, ring: Expr },
    /// `splice item after anchor in ring;`
    Splice { item: Expr, side: Side, anchor: Expr, ring: Expr },
    /// `synchronize set;`
    Synchronize(Expr),
    /// `add vertex to set;`; to a set or to the end of a ring
    Add { vertex: Expr, set: Expr },
    /// `remove vertex from set;`
    Remove { vertex: Expr, set: Expr },
    /// `merge set with other;`
    Merge { set: Expr, other: Expr },
    /// `print a, "b", c;` and `print(a, "b", c);`
    Print(Vec<Expr>),
}

/// ``parallel forall variable, follower in faces over from corner, next body``; which of these parts go together the checker
/// says.
#[derive(Debug, Clone, PartialEq)]
pub struct Forall {
    /// The word `parallel`.
    pub parallel: Option<Span>,
    /// The loop's variable.
    pub variable: Name,
    /// Follows the variable round a ring.
    pub follower: Option<Name>,
    /// The word `faces`.
    pub faces: Option<Span>,
    /// A set, a ring `v` or `r`, or an old ring `` `v ``.
    pub over: Expr,
    /// Where the round begins.
    pub from: Option<From>,
    /// Each time round.
    pub body: Stmt,
}

/// `from corner, next`
#[derive(Debug, Clone, PartialEq)]
pub struct From {
    /// Where to begin.
    pub corner: Expr,
    /// What must follow it.
    pub next: Option<Expr>,
}

/// Where `splice` puts its vertex.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "each is the word of its name")]
pub enum Side {
    After,
    Before,
}

/// An expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Expr {
    /// Which.
    pub kind: ExprKind,
    /// All of it.
    pub span: Span,
}

/// The expressions of C++ that vv keeps, and those of the algebra.
#[derive(Debug, Clone, PartialEq)]
#[expect(missing_docs, reason = "the code shown at each variant names its parts")]
pub enum ExprKind {
    /// `true`
    Bool(bool),
    /// `42`; a literal above `i64::MAX` was reported and is 0.
    Int(i64),
    /// `1.5e-3`
    Double(f64),
    /// `"text"`, escapes resolved
    Text(String),
    /// `null`
    Null,
    /// `p`
    Name(String),
    /// `` `v ``, `` `(nextto q in `p) ``, `` `(p|q) ``
    Old(Box<Expr>),
    /// `(p|q)`: the edge between two vertices, meant before `$`
    Edge(Box<Expr>, Box<Expr>),
    /// `of$name`
    Property { of: Box<Expr>, name: Name },
    /// `of.name`
    Field { of: Box<Expr>, name: Name },
    /// `callee(arguments)`; also `vec(x, y, z)` and conversions `double(i)`
    Call { callee: Name, arguments: Vec<Expr> },
    /// `-a`, `!a`
    Unary { op: UnaryOp, operand: Box<Expr> },
    /// `a + b`
    Binary { op: BinaryOp, left: Box<Expr>, right: Box<Expr> },
    /// `condition ? then : otherwise`
    Conditional { condition: Box<Expr>, then: Box<Expr>, otherwise: Box<Expr> },
    /// `target = value`, `target op= value`
    Assign { op: Option<BinaryOp>, target: Box<Expr>, value: Box<Expr> },
    /// `++a`, `a++`, `--a`, `a--`
    Step { target: Box<Expr>, by: Step, position: StepPosition },
    /// `any in ring`
    Any { ring: Box<Expr> },
    /// `nextto item in ring`
    Next { item: Box<Expr>, ring: Box<Expr> },
    /// `prevto item in ring`
    Previous { item: Box<Expr>, ring: Box<Expr> },
    /// `is item in of`: of a ring or of a set
    Is { item: Box<Expr>, of: Box<Expr> },
    /// `valence v`
    Valence { ring: Box<Expr> },
    /// `gaps v`
    Gaps { ring: Box<Expr> },
    /// `(inner)`
    Paren(Box<Expr>),
    /// Could not be read; reported.
    Error,
}

/// Operators before an operand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the operator of its name")]
pub enum UnaryOp {
    Minus,
    Plus,
    Not,
}

/// Operators between operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "each is the operator of its name")]
pub enum BinaryOp {
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
    And,
    Or,
}

/// `++` or `--`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "each is the operator of its name")]
pub enum Step {
    Up,
    Down,
}

/// Whether the value is that before or after the step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "`++a` and `a++`")]
pub enum StepPosition {
    Before,
    After,
}
