//! The functions of the language: one table of name, signature, documentation and the Rust function that every engine
//! calls.

/// A function of the language: index into the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Builtin(pub u16);
