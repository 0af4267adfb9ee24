//! Expressions, and the places that are read and assigned.

use super::{FunctionId, GlobalId, Item, LocalId, Ring, Step, StepPosition, Type};
use crate::builtins::Builtin;
use crate::mesh::Value;
use crate::source::Span;

/// An expression.
#[derive(Debug, Clone)]
pub struct Expr {
    /// Which.
    pub kind: ExprKind,
    /// The type of its value.
    pub ty: Type,
    /// Where.
    pub span: Span,
}

/// The expressions.
#[derive(Debug, Clone)]
pub enum ExprKind {
    /// A literal; `Value::Vertex(None)` is the word `null`.
    Constant(Value),
    /// A variable, of any type.
    Local(LocalId),
    /// A constant or parameter.
    Global(GlobalId),
    /// A property, a position, or one coordinate of a variable or property.
    Load(Box<Place>),
    /// Converts between value types.
    Convert(Conversion, Box<Expr>),
    /// One operand.
    Unary(Unary, Box<Expr>),
    /// Two operands, both computed.
    Binary(Binary, Box<Expr>, Box<Expr>),
    /// `a && b`: b only if a. Both bool.
    And(Box<Expr>, Box<Expr>),
    /// `a || b`: b only if not a. Both bool.
    Or(Box<Expr>, Box<Expr>),
    /// `condition ? then : otherwise`, the condition bool, the others of one type, a mesh or ring too; one of them is
    /// computed.
    Conditional(Box<Expr>, Box<Expr>, Box<Expr>),
    /// A coordinate (0, 1, 2) of a vec that is no place.
    Coordinate(Box<Expr>, u8),
    /// Calls a function of the program.
    Call(FunctionId, Vec<Argument>),
    /// Calls a function of the language.
    Builtin(Builtin, Vec<Expr>),
    /// Stores a value in a place, `op` combines it with what was there: `place = place op value`. The result is what
    /// was stored. `int i; i *= 1.5;` computes in double and narrows the result before the store.
    Assign {
        /// Where to.
        place: Box<Place>,
        /// For `+=` and its like; the place's value is widened first by `widen`.
        op: Option<Compound>,
        /// The right side.
        value: Box<Expr>,
    },
    /// `++` and `--` on a place of type int or double; the result is the value before or after.
    Step(Box<Place>, Step, StepPosition),
    /// `S = T`: S takes over T's members, its properties stay. Of type void.
    AssignSet(LocalId, Box<Expr>),
    /// `r = s` for rings. Of type void.
    AssignRing(LocalId, Box<Expr>),
    /// `vertex v;`: a new vertex with an empty ring, at the origin, its properties at their defaults, in no set.
    Create,
    /// `any in v`: the start of the ring, null if the ring is empty.
    Any(Ring),
    /// `nextto x in v`: what follows counter-clockwise; null for a gap, or if x is not there.
    Next(Box<Item>, Ring),
    /// `prevto x in v`: what precedes; null for a gap, or if x is not there.
    Previous(Box<Item>, Ring),
    /// `is x in v`
    IsInRing(Box<Item>, Ring),
    /// `is v in S`; a null is in no set.
    IsInSet(Box<Expr>, Box<Expr>),
    /// `valence v`: neighbours without gaps, an int.
    Valence(Ring),
    /// `gaps v`, an int; not of a ring variable.
    Gaps(Ring),
}

/// An argument of a call.
#[derive(Debug, Clone)]
pub enum Argument {
    /// For [`super::Passing::Value`].
    Value(Expr),
    /// For [`super::Passing::Reference`]: a variable of the caller, of exactly the parameter's type.
    Reference(LocalId),
}

/// `op` of `op=` with the conversions around it.
#[derive(Debug, Clone)]
pub struct Compound {
    /// Applied to the place's value and the right side.
    pub op: Binary,
    /// Applied to the place's value first.
    pub widen: Option<Conversion>,
    /// Applied to the result before it is stored.
    pub narrow: Option<Conversion>,
}

/// Something that can be read and stored to.
#[derive(Debug, Clone)]
pub enum Place {
    /// A variable of a value type.
    Local(LocalId),
    /// `v$pos`. Only [`ExprKind::Load`] reads old ones.
    Position {
        /// Of type vertex; null is an error.
        vertex: Expr,
        /// Whether the old one is meant.
        old: bool,
    },
    /// `v$name`
    VertexProperty {
        /// Index into [`super::Program::vertex_properties`].
        property: u32,
        /// Of type vertex; null is an error.
        vertex: Expr,
        /// Whether the old one is meant.
        old: bool,
    },
    /// `(p|q)$name`: see [`crate::mesh::Mesh::edge_value`]; no edge there is an error.
    EdgeProperty {
        /// Index into [`super::Program::edge_properties`].
        property: u32,
        /// Both of type vertex; null is an error.
        ends: [Expr; 2],
        /// Whether the old one is meant.
        old: bool,
    },
    /// `S$name`
    MeshProperty {
        /// Index into [`super::Program::mesh_properties`].
        property: u32,
        /// A variable of type mesh.
        set: LocalId,
    },
    /// A coordinate (0, 1, 2) of a place of type vec. `base` is no `Coordinate`.
    Coordinate(Box<Place>, u8),
}

/// Conversions between value types.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Conversion {
    /// false is 0, true is 1.
    BoolToInt,
    /// 0.0 or 1.0
    BoolToDouble,
    /// The nearest double.
    IntToDouble,
    /// Truncates towards zero; NaN or out of range is an error.
    DoubleToInt,
    /// Not zero.
    IntToBool,
    /// Not zero; NaN is true.
    DoubleToBool,
    /// Not null.
    VertexToBool,
}

/// One-operand operations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "each is the operation of its name on the type of its name")]
pub enum Unary {
    NegateInt,
    NegateDouble,
    NegateVec,
    Not,
}

/// Two-operand operations; comparisons give a bool.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "each is the operation of its name on the type of its name")]
pub enum Binary {
    AddInt,
    SubtractInt,
    MultiplyInt,
    /// Truncates towards zero.
    DivideInt,
    /// The sign of the left operand.
    RemainderInt,
    AddDouble,
    SubtractDouble,
    MultiplyDouble,
    DivideDouble,
    AddVec,
    SubtractVec,
    /// vec · double; `double * vec` arrives as [`Binary::ScaleByDouble`].
    MultiplyVec,
    /// double · vec, operands in the order of the text.
    ScaleByDouble,
    /// vec / double, a division of each coordinate.
    DivideVec,
    CompareInt(Comparison),
    /// As IEEE 754: NaN is unequal to everything and neither less nor greater.
    CompareDouble(Comparison),
    /// Order of creation, null first.
    CompareVertex(Comparison),
    /// `==` and `!=` only.
    CompareBool(Comparison),
    /// `==` and `!=` only: all three coordinates.
    CompareVec(Comparison),
}

/// The six comparisons.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[expect(missing_docs, reason = "each is the operator of its name")]
pub enum Comparison {
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
    Equal,
    NotEqual,
}
