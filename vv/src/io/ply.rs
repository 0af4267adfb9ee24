//! Stanford's polygon format (G. Turk), as text and binary of either byte order.
//!
//! A header names elements – vertices, faces, edges – and the properties of each; then come their values, row by row.
//!
//! | element | read and written |
//! |---|---|
//! | `vertex` | `x` `y` `z`; `red` `green` `blue` are [`super::COLOR`]; all else by name |
//! | `face` | the list `vertex_indices` (also `vertex_index`) |
//! | `edge` | `vertex1` `vertex2`; all else by name |
//! | `mesh` | the values of the whole by name, in one row |
//!
//! Integers are ints, floating-point numbers doubles; `v_x` `v_y` `v_z` are together the vector `v`. Normals are not
//! read, as steps would leave them behind.

mod header;
mod read;
mod write;

pub(super) use read::read;
pub(super) use write::{kept, write};

/// How values follow each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// Whether bytes begin as the format does.
pub(super) fn is_ply(bytes: &[u8]) -> bool {
    matches!(bytes, [b'p', b'l', b'y', b'\n' | b'\r' | b' ' | b'\t', ..])
}

/// The types of values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Scalar {
    Int8,
    Uint8,
    Int16,
    Uint16,
    Int32,
    Uint32,
    Float32,
    Float64,
}

impl Scalar {
    fn of_name(name: &[u8]) -> Option<Self> {
        Some(match name {
            b"char" | b"int8" => Self::Int8,
            b"uchar" | b"uint8" => Self::Uint8,
            b"short" | b"int16" => Self::Int16,
            b"ushort" | b"uint16" => Self::Uint16,
            b"int" | b"int32" => Self::Int32,
            b"uint" | b"uint32" => Self::Uint32,
            b"float" | b"float32" => Self::Float32,
            b"double" | b"float64" => Self::Float64,
            _ => return None,
        })
    }

    /// The name that every program knows.
    fn name(self) -> &'static str {
        match self {
            Self::Int8 => "char",
            Self::Uint8 => "uchar",
            Self::Int16 => "short",
            Self::Uint16 => "ushort",
            Self::Int32 => "int",
            Self::Uint32 => "uint",
            Self::Float32 => "float",
            Self::Float64 => "double",
        }
    }

    fn is_integer(self) -> bool {
        !matches!(self, Self::Float32 | Self::Float64)
    }
}
