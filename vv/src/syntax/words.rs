//! The words of the language, and those that people write for them.

use super::tree::TypeKind;

/// Words that can never be names.
pub(super) const RESERVED: &[&str] = &[
    "void", "bool", "int", "double", "vertex", "mesh", "if", "else", "while", "for", "do", "break", "continue",
    "return", "const", "static", "true", "false", "null",
];

/// Words of the algebra with which statements begin. They are names where no operand follows.
pub(super) const STATEMENTS: &[&str] = &[
    "forall",
    "parallel",
    "make",
    "erase",
    "replace",
    "splice",
    "synchronize",
    "synchronise",
    "add",
    "remove",
    "merge",
    "print",
];

/// Words of the algebra that stand before an operand. They are names where none follows.
pub(super) const PREFIXES: &[&str] = &["nextto", "prevto", "is", "valence", "gaps", "any"];

/// Words of the algebra between operands.
pub(super) const INFIXES: &[&str] = &["in", "to", "from", "with", "after", "before", "nb_of"];

/// Stands before a `forall` whose rounds do not depend on one another.
pub(super) const PARALLEL: &str = "parallel";

/// Stands before the set whose faces a `forall` walks.
pub(super) const FACES: &str = "faces";

/// Words that begin a statement wherever they begin a line.
const LEADING: &[&str] =
    &["if", "else", "while", "for", "do", "break", "continue", "return", "const", "static", "forall"];

/// The type of a name that is always one.
pub(super) fn reserved_type(word: &str) -> Option<TypeKind> {
    Some(match word {
        "void" => TypeKind::Void,
        "bool" => TypeKind::Bool,
        "int" => TypeKind::Int,
        "double" => TypeKind::Double,
        "vertex" => TypeKind::Vertex,
        "mesh" => TypeKind::Mesh,
        _ => return None,
    })
}

/// The type of a name, also of those that may be variables.
pub(super) fn any_type(word: &str) -> Option<TypeKind> {
    match word {
        "vec" | "point" | "vector" => Some(TypeKind::Vec),
        "ring" => Some(TypeKind::Ring),
        _ => reserved_type(word),
    }
}

/// How a type is written.
pub(super) fn name(ty: TypeKind) -> &'static str {
    match ty {
        TypeKind::Void => "void",
        TypeKind::Bool => "bool",
        TypeKind::Int => "int",
        TypeKind::Double => "double",
        TypeKind::Vec => "vec",
        TypeKind::Vertex => "vertex",
        TypeKind::Mesh => "mesh",
        TypeKind::Ring => "ring",
    }
}

pub(super) fn is_reserved(word: &str) -> bool {
    RESERVED.contains(&word)
}

pub(super) fn is_infix(word: &str) -> bool {
    INFIXES.contains(&word) || word == "nb"
}

/// Whether a statement begins with this word, if it is the first of its line.
pub(super) fn leads(word: &str) -> bool {
    LEADING.contains(&word) || STATEMENTS.contains(&word) || reserved_type(word).is_some()
}

/// The word of `list` that was probably meant by `word`.
pub(super) fn similar<'w>(word: &str, list: impl IntoIterator<Item = &'w str>) -> Option<&'w str> {
    let tolerance = match word.chars().count() {
        0..=3 => 0, // `If`; more would find `for` in every `foo`
        4 => 1,
        _ => 2,
    };
    list.into_iter()
        .filter(|meant| *meant != word)
        .map(|meant| (edits(word, meant), meant))
        .filter(|&(distance, _)| distance <= tolerance)
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, meant)| meant)
}

/// Letters to insert, drop, change or swap with their neighbour to get from `a` to `b` (optimal string alignment).
/// Words much longer than any of ours count as far away.
fn edits(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.to_lowercase().chars().take(32).collect(), b.chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let change = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                let mut least = change.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    least = least.min(rows[i - 2][j - 2] + 1);
                }
                least
            };
        }
    }
    rows[a.len()][b.len()]
}

/// What is said about a type of other languages, and the type that stands for it.
pub(super) fn foreign_type(word: &str) -> Option<(&'static str, Option<TypeKind>)> {
    Some(match word {
        "float" | "real" | "f64" | "f32" => ("double", Some(TypeKind::Double)),
        "long" | "short" | "unsigned" | "signed" | "size_t" | "uint" | "int64_t" | "integer" => {
            ("int", Some(TypeKind::Int))
        }
        "boolean" | "Bool" => ("bool", Some(TypeKind::Bool)),
        "vec3" | "Vec3" | "dvec3" | "Vector3d" | "Point" | "Vector" | "Vec" => ("vec", Some(TypeKind::Vec)),
        "Vertex" | "node" => ("vertex", Some(TypeKind::Vertex)),
        "Mesh" | "set" => ("mesh", Some(TypeKind::Mesh)),
        "Ring" | "face" | "Face" | "polygon" | "Polygon" => ("ring", Some(TypeKind::Ring)),
        "auto" | "var" | "let" => ("the type itself", None),
        _ => return None,
    })
}

/// What vv has instead of a construct of C++ that a statement or item begins with.
pub(super) fn foreign_construct(word: &str) -> Option<(&'static str, &'static str)> {
    Some(match word {
        "switch" | "case" => ("vv has no `switch`", "write `if … else if … else …`"),
        "goto" => ("vv has no `goto`", "leave loops with `break` or `return`"),
        "try" | "catch" | "throw" => {
            ("vv has no exceptions", "every error ends the step and leaves the mesh as it was before")
        }
        "template" | "typename" => ("vv has no templates", "write one function for each type"),
        "class" | "struct" | "union" | "enum" => {
            ("vv has no types of one's own", "values are kept as properties: `vertex { double age = 0; };` and `v$age`")
        }
        "face" | "faces" | "halfedge" => (
            "only vertices, edges and meshes have properties",
            "what belongs to a face can stand at a vertex in its middle, or be computed from its corners",
        ),
        "typedef" | "using" | "namespace" | "extern" => {
            ("vv has neither namespaces nor type names of one's own", "leave this line out")
        }
        "public" | "private" | "protected" | "virtual" | "operator" | "friend" => {
            ("vv has no classes", "values are kept as properties: `vertex { double age = 0; };` and `v$age`")
        }
        "new" | "delete" => (
            "vv has neither `new` nor `delete`",
            "`vertex v;` creates a vertex; a vertex that no mesh holds is forgotten",
        ),
        "char" | "string" => ("vv has no variables for text", "strings stand in `print` only"),
        "cout" | "cerr" | "printf" => ("vv writes with `print`", "write `print \"n = \", n;`"),
        "assert" => ("vv has no `assert`", "write `if (!condition) print \"…\";`"),
        "inline" | "constexpr" | "register" | "volatile" | "mutable" | "noexcept" => {
            ("vv has no such specifier", "leave it out")
        }
        "function" | "def" | "fn" | "func" => {
            ("functions begin with the type that they return", "write `vertex insert(vertex p, vertex q) { … }`")
        }
        "foreach" => ("vv loops over sets and rings with `forall`", "write `forall p in S`"),
        _ => return None,
    })
}
