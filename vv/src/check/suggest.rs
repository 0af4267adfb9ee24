//! Names that may have been meant.

use crate::builtins::{Builtin, NUMBERS};
use crate::diagnostic::Diagnostic;
use crate::ir::{LocalId, Type};
use crate::mesh;
use crate::source::Span;
use crate::syntax::tree::Element;

use super::Checker;
use super::body::Role;

/// Searching costs as much as there are names; after so many unknown ones the cause lies elsewhere.
pub(super) const MAX_SEARCHES: u32 = 50;

/// What the files that come with vv define and others may want: those made to be included, and the schemes.
pub(super) const SHIPPED: [(&str, &[&str]); 17] = [
    ("insert.vv", &["insert"]),
    ("split.vv", &["split"]),
    ("edits.vv", &["halve", "can_flip", "flip", "can_contract", "contract", "split_vertex", "pyramid", "triangulate"]),
    ("geometry.vv", &["middle", "area", "area_round", "normal", "angle", "cotangent", "bend", "edge_weight"]),
    ("build.vv", &["polygon", "triangle", "quad", "grid"]),
    ("inherit.vv", &["inherit"]),
    ("fine.vv", &["make_fine"]),
    ("creases.vv", &["faded", "sharp", "fade"]),
    ("solids.vv", &["is_empty", "count", "tetrahedron", "cube", "octahedron", "icosahedron", "solid"]),
    ("ptq.vv", &["ptq"]),
    ("ptt.vv", &["ptt"]),
    ("pqq.vv", &["pqq"]),
    ("dqq.vv", &["dqq"]),
    ("loop.vv", &["loop"]),
    ("butterfly.vv", &["butterfly"]),
    ("catmull-clark.vv", &["catmull_clark"]),
    ("doo-sabin.vv", &["doo_sabin"]),
];

/// Where an unknown name stands.
#[derive(Clone, Copy)]
pub(super) enum Wanted<'a> {
    /// Anywhere.
    Any,
    /// Where a vertex is needed, which is not `except` (the item looked for in its ring).
    Vertex { except: Option<&'a str> },
}

impl<'a> Checker<'a> {
    /// Reports a name that means nothing, once for each function.
    pub(super) fn unknown_name(&mut self, name: &'a str, span: Span, wanted: Wanted<'a>) {
        if !self.body.unknown.insert(name) {
            return;
        }
        let error = Diagnostic::error(span, format!("`{name}` is not declared"));
        let error = if let Some(f) = self.function_names.get(name).and_then(|f| self.signatures.get(f.0 as usize)) {
            error.label(f.span, "a function has this name").hint(format!("call it: `{name}(…)`"))
        } else if Builtin::named(name).next().is_some() {
            error.hint(format!("call the function: `{name}(…)`"))
        } else {
            match name {
                "faces" => error.hint("say of which mesh: `forall f in faces S`"),
                "edges" => error.hint("each edge once: `forall p in S forall q in p { if (p < q) continue; … }`"),
                "M_PI" => error.fix("write `pi`", span, "pi"),
                "infinity" | "INFINITY" | "inf" | "INF" | "DBL_MAX" | "Infinity" => {
                    error.hint("write `1.0 / 0.0`, a `double`; ints have none")
                }
                _ => self.suggest_variable(error, name, span, wanted),
            }
        };
        self.report(error);
    }

    fn suggest_variable(&self, error: Diagnostic, name: &str, span: Span, wanted: Wanted<'a>) -> Diagnostic {
        if !self.may_search() {
            return error;
        }
        let visible: Vec<LocalId> = self.body.visible().collect();
        let usable = |&id: &LocalId| match wanted {
            Wanted::Any => true,
            Wanted::Vertex { except } => {
                let ty = self.body.local(id).map(|l| l.ty);
                let vertex = Type::Value(mesh::Type::Vertex);
                (ty == Some(vertex) || ty == Some(Type::Mesh) || ty == Some(Type::Ring))
                    && self.body.name(id) != except.unwrap_or("")
            }
        };
        let locals = visible.iter().copied().filter(usable).filter_map(|id| Some(self.body.local(id)?.name.clone()));
        let mut candidates: Vec<String> = locals.collect();
        if matches!(wanted, Wanted::Any) {
            candidates.extend(self.globals.iter().map(|g| g.name.clone()));
            candidates.extend(NUMBERS.iter().map(|n| n.name.to_owned()));
        }
        if let Some(near) = nearest(name, candidates.iter().map(String::as_str)) {
            return error.fix(format!("did you mean `{near}`?"), span, near);
        }
        let Wanted::Vertex { .. } = wanted else { return error };
        let vertex = |id: &LocalId| self.body.local(*id).is_some_and(|l| l.ty == Type::Value(mesh::Type::Vertex));
        let vertices: Vec<LocalId> = visible.iter().copied().filter(usable).filter(vertex).collect();
        let walked = vertices.iter().copied().find(|&id| self.body.role(id) == Some(Role::Forall));
        let Some(&first) = vertices.first() else { return error };
        let chosen = walked.unwrap_or(first);
        let chosen_name = self.body.name(chosen).to_owned();
        let others: Vec<String> = vertices
            .iter()
            .filter(|&&id| id != chosen)
            .take(4)
            .map(|&id| format!("`{}`", self.body.name(id)))
            .collect();
        let message = match walked {
            Some(_) => format!("did you mean `{chosen_name}`, the vertex of this `forall`?"),
            None => format!("a vertex known here is `{chosen_name}`"),
        };
        let error = error.fix(message, span, chosen_name);
        if others.is_empty() { error } else { error.evidence(format!("other vertices here: {}", others.join(", "))) }
    }

    /// Reports a call of a function that there is not.
    pub(super) fn unknown_function(&mut self, name: &'a str, span: Span) {
        let error = Diagnostic::error(span, format!("there is no function `{name}`"));
        if let Some(id) = self.body.find(name) {
            let error = match self.body.local(id).map(|l| l.span) {
                Some(declared) => error.label(declared, format!("`{name}` is a variable")),
                None => error,
            };
            self.report(error);
            return;
        }
        if !self.body.unknown.insert(name) {
            return;
        }
        if !self.may_search() {
            self.report(error);
            return;
        }
        if let Some(instead) = written(name) {
            self.report(error.hint(instead));
            return;
        }
        let own: Vec<&str> = self.signatures.iter().map(|s| s.name).collect();
        let builtins = Builtin::all().map(|b| -> &str { b.name() });
        let names = own.into_iter().chain(builtins);
        let error = match nearest(name, names) {
            Some(near) => error.fix(format!("did you mean `{near}`?"), span, near),
            None => match name {
                _ if shipped(name).is_some() => {
                    error.hint(format!("one comes with vv: `#include \"{}\"`", shipped(name).unwrap_or_default()))
                }
                "vertex" => error.hint("`vertex v;` creates a vertex"),
                "neighbours" | "neighbors" | "adjacent" | "ring" => {
                    error.hint("`forall q in p` walks the neighbours of p")
                }
                "infinity" => error.hint("write `1.0 / 0.0`"),
                "size" | "count" | "len" => error.hint("count in a loop: `int n = 0; forall v in S n += 1;`"),
                _ => error,
            },
        };
        self.report(error);
    }

    /// Reports a property that was not declared.
    pub(super) fn unknown_property(&mut self, element: Element, name: &str, span: Span) {
        let (of, block) = match element {
            Element::Vertex => ("vertices have", "vertex"),
            Element::Edge => ("edges have", "edge"),
            Element::Mesh => ("meshes have", "mesh"),
        };
        let error = Diagnostic::error(span, format!("{of} no property `{name}`"));
        if !self.may_search() {
            self.report(error);
            return;
        }
        let mut names: Vec<&str> = self.properties(element).declarations.iter().map(|p| p.name.as_str()).collect();
        if element == Element::Vertex {
            names.push("pos");
        }
        if let Some(near) = nearest(name, names.into_iter()) {
            let error = error.fix(format!("did you mean `{near}`?"), span, near);
            self.report(error);
            return;
        }
        let others =
            [Element::Vertex, Element::Edge, Element::Mesh].map(|other| self.properties(other).names.get(name));
        let error = match others.into_iter().flatten().next() {
            _ if name == "pos" => error.hint("positions belong to vertices"),
            _ if element == Element::Vertex && matches!(name, "ring" | "neighbours" | "neighbors") => {
                error.hint("`forall q in v` walks the ring of v, `make r nb_of v;` makes r its ring")
            }
            _ if element == Element::Vertex && matches!(name, "position" | "point") => {
                error.fix("the position is `pos`", span, "pos")
            }
            Some(&(declared, _)) => error.label(declared, "a property of something else has this name"),
            None if matches!(name, "color" | "normal" | "velocity") => {
                error.hint(format!("declare it at file scope: `{block} {{ vec {name}; }};`"))
            }
            None => error.hint(format!("declare it at file scope: `{block} {{ double {name} = 0; }};`")),
        };
        self.report(error);
    }

    /// Whether to look for what may have been meant, which is not for ever.
    fn may_search(&self) -> bool {
        let left = self.searches_left.get();
        self.searches_left.set(left.saturating_sub(1));
        left > 0
    }
}

/// How vv writes what is a function elsewhere.
fn written(name: &str) -> Option<&'static str> {
    Some(match name {
        "lerp" | "mix" => "write `a + t * (b - a)`",
        "radians" => "write `x * pi / 180.0`",
        "degrees" => "write `x * 180.0 / pi`",
        "sign" | "sgn" => "write `x < 0.0 ? -1.0 : 1.0`",
        "rand" | "drand48" => "write `random()`, in [0, 1), or `random(low, high)`",
        "norm" | "mag" | "magnitude" => "write `length(v)`",
        "dist" => "write `distance(a, b)`",
        "normalized" | "unit" => "write `normalize(v)`",
        "merge" => "it is a statement: `merge S with T;`",
        "add" => "it is a statement: `add v to S;`",
        "remove" => "it is a statement: `remove v from S;`",
        "erase" => "it is a statement: `erase x from v;`",
        "replace" => "it is a statement: `replace a with x in v;`",
        "splice" => "it is a statement: `splice x after a in v;`",
        "make" => "it is a statement: `make {a, b, c} nb_of v;`",
        "foreach" => "write `forall p in S`",
        "assert" => "write `if (!condition) print \"…\";`",
        _ => return None,
    })
}

/// The file that comes with vv and has a function of this name.
fn shipped(name: &str) -> Option<&'static str> {
    SHIPPED.iter().find(|(_, functions)| functions.contains(&name)).map(|&(file, _)| file)
}

/// The name next to `name`, if one is near; of equally near ones the first.
fn nearest<'n>(name: &str, candidates: impl Iterator<Item = &'n str>) -> Option<String> {
    let allowed = match name.chars().count() {
        0..=2 => 0,
        3..=5 => 1,
        6..=64 => 2,
        _ => return None,
    };
    let name = name.to_lowercase();
    candidates
        .filter(|c| c.len() <= 128)
        .map(|c| (distance(&name, &c.to_lowercase()), c))
        .filter(|&(d, _)| d <= allowed)
        .min_by_key(|&(d, _)| d)
        .map(|(_, c)| c.to_owned())
}

/// How many characters to insert, delete, change or swap with their neighbour (optimal string alignment).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut before: Vec<usize> = Vec::new();
    let mut last: Vec<usize> = (0..=b.len()).collect();
    for i in 0..a.len() {
        let mut row = vec![i + 1];
        for j in 0..b.len() {
            let change = last[j] + usize::from(a[i] != b[j]);
            let mut cost = change.min(last[j + 1] + 1).min(row[j] + 1);
            if i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j] {
                cost = cost.min(before[j - 1] + 1);
            }
            row.push(cost);
        }
        before = std::mem::replace(&mut last, row);
    }
    last[b.len()]
}

#[cfg(test)]
mod tests {
    use super::distance;

    #[test]
    fn distances_count_insertions_deletions_changes_and_swaps() {
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("center", "centre"), 1);
        assert_eq!(distance("normalise", "normalize"), 1);
        assert_eq!(distance("vertx", "vertex"), 1);
        assert_eq!(distance("pos", "age"), 3);
    }
}
