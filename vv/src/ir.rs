//! The checked program. This documentation is the semantics; every engine follows it to the bit.
//!
//! A [`Program`] comes only from [`crate::check`] without an error, and no engine panics on one, whatever mesh it
//! meets. Names are resolved, conversions explicit, every expression has one type.
//!
//! **Order.** Left to right; operands before the operation; in an assignment first the operands of the target, then the
//! right side, then (for `op=`) the old value is read, then the store.
//!
//! **Numbers.** `int` is `i64`, overflow and division by zero are errors. `double` is IEEE 754 binary64, no fused
//! operations; functions come from one library on every machine ([`crate::builtins`]). `double` to `int` truncates; NaN
//! and what does not fit are errors. `vec` operations work on x, y, z in that order; `dot` is `(x·x + y·y) + z·z`.
//! [`arithmetic`] is the definition.
//!
//! **Null.** `null` compares with vertices (it comes first) and converts to `bool`. As the vertex whose ring, position
//! or property is meant, or that is added or removed, it is an error; as an operand that a ring is searched for it is
//! an error unless *written* ([`Item::Gap`]); as something put into a ring it is a gap. A null where none may be is an
//! error as soon as it is computed, before anything that follows in order; likewise a vertex without an old value where
//! its old value is meant.
//!
//! **Sets and loops.** `forall` walks a set, a ring or the faces of a set as they stood when the loop began. A set
//! iterates in order of addition.
//!
//! **Parallel rounds.** The rounds of a [`StmtKind::ForallSet`] that says so do not depend on one another: they may run in
//! any order, or at once, and the result is that of running them in turn. A round assigns variables that are declared in
//! it, and position and properties of its own vertex, that of the loop's variable, which nothing assigns. It makes no
//! vertices, edits no rings, sets, values of edges and of meshes, makes no old values, prints nothing, draws no random
//! numbers, and leaves neither the loop nor the function. What rounds assign it reads of another vertex only as it was. All
//! this holds with the functions that it calls. An error in one round is that of the first in turn that has one.
//!
//! **Rings.** The ring of a vertex is asked and edited as [`crate::mesh::Ring`] and [`crate::mesh::Mesh`] tell. A
//! variable of type `ring` holds a cyclic list of vertices by value, with a start, without gaps; a vertex may stand in
//! it more than once, then what looks for it finds the first. Its edits follow those of a vertex' ring, except that
//! nothing is refused: erasing the start moves it on, `replace` keeps the place, splicing before the start appends at
//! the end.
//!
//! **Faces.** The faces of a set are those of [`crate::mesh::faces::faces_of`], in its order, each beginning at its
//! corner. A face is a ring of its own: edits of the mesh and of other variables do not change it, and no statement
//! edits, assigns or passes by reference the variable of a [`StmtKind::ForallFaces`]. So all faces may be computed at
//! once, flat, as the loop begins, and the variable be a slice of them.
//!
//! **Old values.** [`StmtKind::Synchronize`] gives every vertex of the set a copy of its ring, position, vertex
//! properties and edge values. The copy belongs to the vertex: the last `synchronize` that covered it wins. None
//! outlives the step. Reading an old value that is not there is an error. The old value of an edge is there if both
//! ends have old values; then it is [`crate::mesh::Mesh::edge_value`] of the old copies.
//!
//! **Runs.** Before a rule runs the globals are computed in order; the rule's `S` has the members of
//! [`crate::mesh::Mesh::set`] and the mesh's own properties, and gives both back when it ends. A stop is asked for at
//! every round of a loop and at every call.

pub mod arithmetic;
mod expr;
pub(crate) mod visit;

use std::sync::Arc;

use crate::mesh::Value;
use crate::source::{Sources, Span};
pub use crate::syntax::tree::{Side, Step, StepPosition};
pub use expr::{Argument, Binary, Comparison, Compound, Conversion, Expr, ExprKind, Place, Unary};

/// A checked program.
#[derive(Debug, Clone)]
pub struct Program {
    /// The texts it was made of.
    pub sources: Arc<Sources>,
    /// All functions; [`FunctionId`] indexes.
    pub functions: Vec<Function>,
    /// Steps of the modeler: each `void f(mesh& S)` of the program's own file that is neither `start` nor `static`, in
    /// the order of the text. The block `step { … }` is one named `step`.
    pub rules: Vec<FunctionId>,
    /// `void start(mesh& S)` or the block `start { … }`.
    pub start: Option<FunctionId>,
    /// Constants and parameters in the order in which they are computed; [`GlobalId`] indexes.
    pub globals: Vec<Global>,
    /// `vertex { … }`
    pub vertex_properties: Vec<PropertyDeclaration>,
    /// `edge { … }`
    pub edge_properties: Vec<PropertyDeclaration>,
    /// `mesh { … }`
    pub mesh_properties: Vec<PropertyDeclaration>,
}

impl Program {
    /// The rule a modeler steps when none is named: `step`, else the last one.
    #[must_use]
    pub fn default_rule(&self) -> Option<FunctionId> {
        self.rules
            .iter()
            .copied()
            .find(|&r| self.function(r).is_some_and(|f| f.name == "step"))
            .or(self.rules.last().copied())
    }

    /// The rule of a name.
    #[must_use]
    pub fn rule(&self, name: &str) -> Option<FunctionId> {
        self.rules.iter().copied().find(|&r| self.function(r).is_some_and(|f| f.name == name))
    }

    /// The function behind a handle.
    #[must_use]
    pub fn function(&self, id: FunctionId) -> Option<&Function> {
        self.functions.get(id.0 as usize)
    }

    /// The parameters, in the order of the text.
    pub fn params(&self) -> impl Iterator<Item = (GlobalId, &Global, &Param)> {
        self.globals.iter().enumerate().filter_map(|(i, g)| Some((GlobalId(i as u32), g, g.param.as_ref()?)))
    }
}

/// Index into [`Program::functions`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct FunctionId(pub u32);

/// Index into [`Program::globals`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct GlobalId(pub u32);

/// Index into [`Function::locals`]; parameters come first, in order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct LocalId(pub u32);

/// The type of an expression or variable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Type {
    /// No value: calls of `void` functions.
    Void,
    /// A value of a type that properties can have too.
    Value(crate::mesh::Type),
    /// A vertex set with mesh properties.
    Mesh,
    /// A cyclic list of vertices.
    Ring,
}

/// A constant or a parameter.
#[derive(Debug, Clone)]
pub struct Global {
    /// Its name.
    pub name: String,
    /// Its type.
    pub ty: crate::mesh::Type,
    /// Computed once before each start and each step, in order; uses only globals before it and no mesh.
    pub init: Expr,
    /// For `param`: the value given from outside, if any, stands in for `init`.
    pub param: Option<Param>,
    /// Where it is declared.
    pub span: Span,
}

/// What a modeler needs to know of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Param {
    /// The default, of the parameter's type.
    pub default: Value,
    /// Range of the slider, both of the parameter's type (`int` or `double`), low ≤ high. Values given from outside
    /// must lie in it.
    pub range: Option<(Value, Value)>,
}

/// A property that the program declares.
#[derive(Debug, Clone, PartialEq)]
pub struct PropertyDeclaration {
    /// What stands after `$`.
    pub name: String,
    /// What new elements get; its type is the property's.
    pub default: Value,
    /// Where it is declared.
    pub span: Span,
}

/// A function.
#[derive(Debug, Clone)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// What it returns.
    pub returns: Type,
    /// How each parameter is passed; parameter `i` is local `i`.
    pub parameters: Vec<Passing>,
    /// All variables, parameters first.
    pub locals: Vec<Local>,
    /// Its statements. A function that returns a value returns on every path, but for one that is only declared: it has
    /// no statements, and no rule and no `start` leads to it.
    pub body: Vec<Stmt>,
    /// Where its name stands.
    pub span: Span,
}

/// How an argument is passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Passing {
    /// A copy. A copied mesh has its own members and mesh properties.
    Value,
    /// The caller's variable itself.
    Reference,
}

/// A variable.
#[derive(Debug, Clone)]
pub struct Local {
    /// Its name.
    pub name: String,
    /// Its type, not `void`.
    pub ty: Type,
    /// Where it is declared.
    pub span: Span,
}

/// A statement.
#[derive(Debug, Clone)]
pub struct Stmt {
    /// Which.
    pub kind: StmtKind,
    /// Where.
    pub span: Span,
}

/// The statements.
#[derive(Debug, Clone)]
pub enum StmtKind {
    /// Gives a variable its first value, anew each time it is reached: `init`, or false, 0, the origin, an empty ring, an
    /// empty set with mesh properties at their defaults. `vertex v;` arrives with [`ExprKind::Create`] as its `init`, a vertex
    /// variable without one is null.
    Declare {
        /// The variable.
        local: LocalId,
        /// Of the variable's type. A mesh takes over the members only.
        init: Option<Expr>,
    },
    /// Computes and forgets.
    Expr(Expr),
    /// A block, an empty statement or several declarators.
    Block(Vec<Stmt>),
    /// `if`
    If {
        /// Of type bool.
        condition: Expr,
        /// If it holds.
        then: Vec<Stmt>,
        /// If not.
        otherwise: Vec<Stmt>,
    },
    /// `while` and `for`; a `continue` in the body goes on with `update`.
    Loop {
        /// Of type bool; `None` is true.
        condition: Option<Expr>,
        /// Each time round.
        body: Vec<Stmt>,
        /// After the body.
        update: Vec<Expr>,
        /// `do … while`: the first round asks nothing.
        body_first: bool,
    },
    /// `forall v in S`, over the members as they stand now.
    ForallSet {
        /// The word `parallel`: rounds do not depend on one another, see *Parallel rounds* above.
        parallel: bool,
        /// The loop's variable, of type vertex.
        local: LocalId,
        /// Of type mesh.
        set: Expr,
        /// Each time round.
        body: Vec<Stmt>,
    },
    /// ``forall q in p``, ``forall q in `p``, `forall q in r`: once round a ring, gaps left out, as it stands now.
    ForallRing {
        /// The loop's variable, of type vertex.
        local: LocalId,
        /// In `forall p, q in r` the variable for what follows `local`: the rounds are those p whose follower is no
        /// gap. The last is followed by the first, also where it is the only one.
        follower: Option<LocalId>,
        /// Of what.
        ring: Ring,
        /// Where the round begins; at the start of the ring if there is none.
        from: Option<From>,
        /// Each time round.
        body: Vec<Stmt>,
    },
    /// `forall f in faces S`, see *Faces* above.
    ForallFaces {
        /// The loop's variable, of type ring; only read.
        local: LocalId,
        /// Of type mesh.
        set: Expr,
        /// Each time round.
        body: Vec<Stmt>,
    },
    /// Leaves the innermost loop.
    Break,
    /// Goes on with the innermost loop's next round.
    Continue,
    /// Leaves the function with its value. A mesh is returned with its members and mesh properties.
    Return(Option<Expr>),
    /// `make {…} nb_of v`. First the items, then `v`.
    Make {
        /// What the ring shall hold.
        items: Vec<Item>,
        /// Whose ring.
        of: Expr,
    },
    /// `make r nb_of v`: gives v the vertices of a ring, in order, as [`StmtKind::Make`] does.
    MakeRing {
        /// A variable of type ring.
        ring: LocalId,
        /// Whose ring.
        of: Expr,
    },
    /// `erase x from v`. No effect if x is not there.
    Erase {
        /// A computed null is an error.
        item: Item,
        /// Not an old one.
        from: Ring,
    },
    /// `replace a with x in v`. No effect if a is not there or x = a.
    Replace {
        /// A computed null is an error.
        item: Item,
        /// A computed null is a gap, and an error for a ring variable.
        with: Item,
        /// Not an old one.
        ring: Ring,
    },
    /// `splice x after a in v`. No effect if a is not there.
    Splice {
        /// A computed null is a gap, and an error for a ring variable.
        item: Item,
        /// After or before.
        side: Side,
        /// A computed null is an error.
        anchor: Item,
        /// Not an old one.
        ring: Ring,
    },
    /// `synchronize S`
    Synchronize(Expr),
    /// `add v to S`; adding a member again keeps its place, adding null is an error.
    Add {
        /// Which vertex.
        vertex: Expr,
        /// A variable of type mesh.
        set: LocalId,
    },
    /// `add v to r`: at the end; adding null is an error.
    Append {
        /// Which vertex.
        vertex: Expr,
        /// A variable of type ring.
        ring: LocalId,
    },
    /// `remove v from S`; removing null is an error.
    Remove {
        /// Which vertex.
        vertex: Expr,
        /// A variable of type mesh.
        set: LocalId,
    },
    /// `merge S with T`: adds T's members that S lacks, in T's order.
    Merge {
        /// A variable of type mesh.
        set: LocalId,
        /// Of type mesh.
        other: Expr,
    },
    /// Writes the items one after the other, without spaces between, and ends the line. The line is written when all
    /// items are computed.
    Print(Vec<PrintItem>),
}

/// What `print` writes.
#[derive(Debug, Clone)]
pub enum PrintItem {
    /// A string literal.
    Text(String),
    /// A value: `true`, `42`, `(x, y, z)`, `v7`, `null`; a mesh prints as its members, `{v1, v2}`, a ring
    /// likewise from its start. A double is the shortest decimal that reads back as the same double: `1`, `0.1`, `-0`,
    /// with an exponent below 1e-5 and from 1e16 on (`1e-7`), `inf`, `-inf`, `nan`.
    Value(Expr),
}

/// What is looked for in a ring or put there.
#[derive(Debug, Clone)]
pub enum Item {
    /// The word `null` itself: the first gap, or a gap to put in. Never with a ring variable, which has none.
    Gap(Span),
    /// Of type vertex.
    Vertex(Expr),
}

/// A ring that is read or edited.
#[derive(Debug, Clone)]
pub enum Ring {
    /// Of a vertex, as it is, or as it was at the last `synchronize`.
    Of {
        /// Of type vertex; null is an error.
        vertex: Box<Expr>,
        /// Whether the old ring is meant.
        old: bool,
    },
    /// A variable of type ring.
    Variable {
        /// Which.
        local: LocalId,
        /// Where it is named.
        span: Span,
    },
}

impl Ring {
    /// Whether an old ring is meant.
    #[must_use]
    pub fn is_old(&self) -> bool {
        matches!(self, Self::Of { old: true, .. })
    }

    /// Where the vertex or variable stands.
    #[must_use]
    pub fn span(&self) -> Span {
        match self {
            Self::Of { vertex, .. } => vertex.span,
            Self::Variable { span, .. } => *span,
        }
    }
}

/// Where a `forall` round a ring begins: `from p` at the first p, `from p, q` at the first p that is followed by q. It
/// is computed after the ring. An error if there is no such place, or where one of them is null.
#[derive(Debug, Clone)]
pub struct From {
    /// Of type vertex.
    pub corner: Expr,
    /// Of type vertex.
    pub next: Option<Expr>,
}
