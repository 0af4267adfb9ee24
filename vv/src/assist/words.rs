//! The words of the language and what they mean.

use crate::syntax::TokenClass;

/// A word, or a sign, of the language.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Word {
    /// As written.
    pub word: &'static str,
    /// How it is used.
    pub usage: &'static str,
    /// What it means.
    pub doc: &'static str,
    /// How it is coloured.
    pub class: TokenClass,
    /// Whether a statement or a declaration begins with it.
    pub begins_statement: bool,
}

pub(super) fn find(word: &str) -> Option<&'static Word> {
    WORDS.iter().find(|w| w.word == word)
}

const fn statement(word: &'static str, usage: &'static str, doc: &'static str) -> Word {
    Word { word, usage, doc, class: TokenClass::Algebra, begins_statement: true }
}

const fn operation(word: &'static str, usage: &'static str, doc: &'static str) -> Word {
    Word { word, usage, doc, class: TokenClass::Algebra, begins_statement: false }
}

const fn control(word: &'static str, usage: &'static str, doc: &'static str) -> Word {
    Word { word, usage, doc, class: TokenClass::Keyword, begins_statement: true }
}

const fn ty(word: &'static str, usage: &'static str, doc: &'static str) -> Word {
    Word { word, usage, doc, class: TokenClass::Type, begins_statement: true }
}

const fn literal(word: &'static str, usage: &'static str, doc: &'static str) -> Word {
    Word { word, usage, doc, class: TokenClass::Literal, begins_statement: false }
}

/// All of them: first those of the algebra, then those of C++.
pub const WORDS: &[Word] = &[
    operation(
        "nextto",
        "nextto x in v",
        "the neighbour after x in the ring of v, counter-clockwise; null if x is not there",
    ),
    operation(
        "prevto",
        "prevto x in v",
        "the neighbour before x in the ring of v, counter-clockwise; null if x is not there",
    ),
    operation("any", "any in v", "the start of the ring of v; null if it is empty"),
    operation(
        "is",
        "is x in v    is v in S    is null in v",
        "whether x is a neighbour of v, v a member of S, v on a boundary",
    ),
    operation("valence", "valence v", "how many neighbours v has"),
    operation("gaps", "gaps v", "how many gaps the ring of v has: how many holes meet there"),
    statement(
        "forall",
        "forall v in S    forall x in v",
        "for each member of a set, each neighbour in a ring, as they stand when the loop begins",
    ),
    statement(
        "parallel",
        "parallel forall v in S",
        "rounds that do not depend on one another: each changes values of its own v, and reads of others what no round \
         changes, or what it was; they may run at once",
    ),
    statement("make", "make {a, b, c} nb_of v;", "gives v this ring, counter-clockwise; null in it is a gap"),
    statement("erase", "erase x from v;", "takes x out of the ring of v; x keeps v"),
    statement("replace", "replace a with x in v;", "puts x in the place of a in the ring of v"),
    statement("splice", "splice x after a in v;    splice x before a in v;", "puts x into the ring of v, next to a"),
    statement(
        "synchronize",
        "synchronize S;",
        "gives every v in S an old copy `v: its ring and its properties as they are now",
    ),
    statement("synchronise", "synchronise S;", "the same as synchronize"),
    statement("add", "add v to S;", "makes v a member of the set S"),
    statement("remove", "remove v from S;", "takes v out of the set S"),
    statement("merge", "merge S with T;", "adds the members of T to S"),
    statement("print", "print \"text\", e, …;", "writes one line to the console"),
    operation("in", "nextto x in v    forall v in S    param … in [low, high]", "which ring, set or range is meant"),
    operation("to", "add v to S;", "which set is meant"),
    operation("from", "erase x from v;    remove v from S;", "which ring or set is meant"),
    operation("with", "replace a with x in v;    merge S with T;", "what comes in the place, what is added"),
    operation("after", "splice x after a in v;", "counter-clockwise behind a"),
    operation("before", "splice x before a in v;", "counter-clockwise before a"),
    operation("nb_of", "make {a, b, c} nb_of v;", "whose ring is made"),
    Word {
        word: "`",
        usage: "`v$pos    nextto q in `v    `(nextto q in `p)$pos",
        doc: "as it was at the last synchronize; can only be read",
        class: TokenClass::Old,
        begins_statement: false,
    },
    Word { word: "$pos", usage: "vec v$pos", doc: "where v is", class: TokenClass::Property, begins_statement: false },
    operation("faces", "forall f in faces S", "each face of a set once, as the ring of its corners"),
    literal("null", "x == null    is null in v", "no vertex; in a ring a gap, where the surface is missing"),
    ty(
        "vertex",
        "vertex v;    vertex v = e;    vertex { double age = 0; };",
        "declaring a vertex without a value creates it; with braces declares properties of vertices",
    ),
    ty(
        "mesh",
        "mesh S;    mesh& S    mesh { int n = 0; };",
        "a set of vertices, in the order in which they were added; with braces declares properties of meshes",
    ),
    ty(
        "vec",
        "vec(x, y, z)    vec v;",
        "a position or vector, with v.x, v.y, v.z, + - * /, dot, cross, length, normalize, distance",
    ),
    ty(
        "ring",
        "ring r;    add x to r;    make r nb_of v;    forall x in r",
        "a cyclic list of vertices as a value, with all that can be asked of the ring of a vertex",
    ),
    ty("point", "point p;", "another name of vec"),
    ty("vector", "vector v;", "another name of vec"),
    ty("double", "double x;    double(i)", "a number of 64 bits with fraction"),
    ty("int", "int n;    int(x)", "a whole number of 64 bits; overflow is an error"),
    ty("bool", "bool b;", "true or false"),
    ty("void", "void f(mesh& S) { … }", "no value; a void f(mesh& S) is a rule that can be stepped"),
    control("edge", "edge { double sharpness = 0; };", "declares properties of edges: (p|q)$sharpness"),
    control("param", "param double w = 0.5 in [0, 1];", "a constant to the program, a slider in the modeler"),
    control("start", "start { … }    void start(mesh& S) { … }", "makes or prepares the first mesh, S"),
    control("step", "step { … }    void step(mesh& S) { … }", "what a step does to the mesh S"),
    control("include", "#include \"file.vv\"", "reads a file beside this one, or one that comes with vv; each once"),
    control("if", "if (condition) … else …", "one or the other"),
    control("else", "if (condition) … else …", "what is done if the condition does not hold"),
    control("while", "while (condition) …", "as long as the condition holds"),
    control("for", "for (int i = 0; i < n; ++i) …", "a loop that counts"),
    control("do", "do … while (condition);", "once, and again as long as the condition holds"),
    control("break", "break;", "leaves the loop"),
    control("continue", "continue;", "goes on with the next round of the loop"),
    control("return", "return e;", "leaves the function"),
    control("const", "const double k = 1.0/16.0;", "a name for a value that does not change"),
    control("static", "static void f(mesh& S) { … }", "a function that is no rule"),
    literal("true", "true", "it holds"),
    literal("false", "false", "it does not hold"),
];
