//! What meshes a rule is for, as its comment says: `triangle meshes`, `quad meshes`, `closed …`.
//!
//! A rule for triangles may make something of other faces, too, all of it valid and nothing of it meant. The language has
//! no words for what a rule takes for granted, comments have; so vv reads them there.

use vv::assist::comment_before;
use vv::diagnostic::{Diagnostic, Severity};
use vv::ir::{FunctionId, Program};
use vv::mesh::Mesh;
use vv::mesh::faces::degrees;
use vv::source::FileId;
use vv::stop::{Stop, Stopped};

use crate::gallery::headline;

/// What meshes a rule is for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Claim {
    /// Who says so: the program, or the rule, by its name.
    pub by: String,
    /// How many corners each face has; `None` for any.
    pub corners: Option<usize>,
    /// No boundary.
    pub closed: bool,
}

impl Claim {
    /// What the comment right before the rule says, else the first comment of the program; `None` if neither names a kind of
    /// mesh, or all do.
    #[must_use]
    pub fn of(program: &Program, rule: FunctionId) -> Option<Self> {
        let function = program.function(rule)?;
        let text = &program.sources.file(FileId::MAIN)?.text;
        let (head, own) = (headline(text), comment_before(text, function.span.start as usize));
        match read(&own).filter(|_| own != head) {
            Some(claim) => Some(Self { by: format!("`{}`", function.name), ..claim }),
            None => read(&head),
        }
    }

    /// What of a mesh is not as claimed, as a warning. Cost: finding its faces, in no memory of their own.
    ///
    /// # Errors
    /// When stopped.
    pub fn breach(&self, mesh: &Mesh, stop: &Stop) -> Result<Option<Diagnostic>, Stopped> {
        let mut broken = Vec::new();
        if let Some(corners) = self.corners {
            let degrees = degrees(mesh, stop)?.into_pairs();
            let all: usize = degrees.iter().map(|&(_, faces)| faces).sum();
            let others: usize = degrees.iter().filter(|&&(n, _)| n != corners).map(|&(_, faces)| faces).sum();
            if others > 0 {
                let are = if others == 1 { "is" } else { "are" };
                broken.push(format!("{others} of the {all} faces {are} none"));
            }
        }
        let others = !broken.is_empty();
        if self.closed && mesh.set.iter().any(|v| mesh.ring(v).gaps() > 0) {
            broken.push("the mesh is open".to_owned());
        }
        if broken.is_empty() {
            return Ok(None);
        }
        let kind = match self.corners {
            Some(3) => "triangle ",
            Some(_) => "quad ",
            None => "",
        };
        let closed = if self.closed { "closed " } else { "" };
        let message = format!("{} is for {closed}{kind}meshes, and {}", self.by, broken.join(", and "));
        let warning = Diagnostic::new(Severity::Warning, None, message);
        Ok(Some(match self.corners {
            Some(3) if others => warning.hint("`triangulate(S)` of edits.vv makes triangles of other faces"),
            Some(_) if others => warning.hint("a step of catmull-clark.vv makes quads of all faces"),
            _ => warning,
        }))
    }
}

/// Words before a kind of mesh that say it is what the rule is given; before what it makes others stand.
const GIVEN: [&str; 20] = [
    "of",
    "for",
    "from",
    "on",
    "any",
    "all",
    "take",
    "takes",
    "need",
    "needs",
    "want",
    "wants",
    "expect",
    "expects",
    "require",
    "requires",
    "assume",
    "assumes",
    "refines",
    "subdivides",
];
/// Words that may stand between.
const ARTICLES: [&str; 5] = ["a", "an", "the", "each", "every"];
/// Words after a kind of mesh that say the rule is given more than that.
const MORE: [&str; 4] = ["and", "or", "as", "but"];
/// Words that deny what comes after them in a sentence.
const DENIAL: [&str; 5] = ["not", "no", "never", "cannot", "nor"];

/// How many corners the faces of a mesh have that is called so.
fn corners_of(word: &str) -> Option<usize> {
    match word {
        "triangle" | "triangular" | "triangulated" => Some(3),
        "quad" | "quadrilateral" | "quadrangular" => Some(4),
        _ => None,
    }
}

fn read(comment: &str) -> Option<Claim> {
    let text = comment.to_lowercase();
    let words: Vec<&str> = text.split_whitespace().collect();
    let ends_sentence = |word: &&str| word.ends_with(['.', ':', ';']);
    let (mut faces, mut closed) = (Vec::new(), false);
    for (i, word) in words.iter().enumerate().filter(|(_, word)| word.starts_with("mesh")) {
        let corners = i.checked_sub(1).and_then(|before| corners_of(words[before]));
        let before = &words[..i - usize::from(corners.is_some())];
        let is_closed = before.last() == Some(&"closed");
        let before = &before[..before.len() - usize::from(is_closed)];
        let given = match before {
            [] => true,
            [.., word, article] if ARTICLES.contains(article) => GIVEN.contains(word),
            [.., word] => GIVEN.contains(word) || ends_sentence(word),
        };
        if !given || before.iter().rev().take_while(|word| !ends_sentence(word)).any(|word| DENIAL.contains(word)) {
            continue;
        }
        let next = words.get(i + 1).unwrap_or(&"");
        let more = !word.ends_with(|c: char| c.is_ascii_punctuation()) && MORE.contains(next);
        let list = word.ends_with(',') && corners_of(next).is_some();
        let any = corners.is_none() && !is_closed && matches!(before.last(), Some(&("any" | "all")));
        if more || list || any {
            return None;
        }
        if corners.is_some() || is_closed {
            faces.push(corners);
            closed |= is_closed;
        }
    }
    let corners = *faces.first()?;
    let corners = corners.filter(|_| faces.iter().all(|&other| other == corners));
    (corners.is_some() || closed).then(|| Claim { by: "the program".to_owned(), corners, closed })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(text: &str, rule: &str, expected: Option<(&str, Option<usize>, bool)>) {
        let program = crate::files::compile(std::path::Path::new("p.vv"), text).0.program.unwrap();
        let found = Claim::of(&program, program.rule(rule).unwrap());
        let expected = expected.map(|(by, corners, closed)| Claim { by: by.to_owned(), corners, closed });
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn a_rule_is_for_what_the_comment_before_it_says_else_for_what_the_program_says() {
        let rules = "void a(mesh& S) { }\n\n// For closed quad meshes.\nvoid b(mesh& S) { }\n";
        let of = |headline: &str| format!("// {headline}\n\n{rules}");
        let program = Some(("the program", Some(3), false));
        check(&of("Smooth surfaces from triangle meshes, closed or open."), "a", program);
        check(&of("Loop 1987. Triangle meshes, closed or open."), "a", program);
        check(&of("Any Triangle\n// mesh."), "a", program);
        check(&of("From triangle meshes."), "b", Some(("`b`", Some(4), true)));
        check(&of("Any closed mesh."), "a", Some(("the program", None, true)));
        check(&of("Any polygons, closed or open."), "a", None);
        check(&of("Makes any polygons triangle meshes."), "a", None);
        check(&of("Cuts polygons into a closed triangle mesh."), "a", None);
        check(&of("A triangle mesh of each. Quad meshes."), "a", Some(("the program", Some(4), false)));
        check(&of("One is for triangle meshes, the other for quad meshes."), "a", None);
        check(&of("For triangle meshes and quad meshes."), "a", None);
        check(&of("For triangle meshes, quad meshes and others."), "a", None);
        check(&of("For triangle meshes or any polygons."), "a", None);
        check(&of("For any mesh, best on triangle meshes."), "a", None);
        check(&of("Not for triangle meshes."), "a", None);
        check(&of("Does not stop on closed meshes: for triangle meshes."), "a", program);
        check(&of("Smooth triangular meshes."), "a", None);
        check(&of("Triangular meshes, open or closed."), "a", program);
        check(&of("Takes a triangle mesh."), "a", program);
        check(&of("It needs triangulated meshes."), "a", program);
        check(&of("Makes a quad mesh from a triangle mesh."), "a", program);
        check(&of("Does not need a triangle mesh."), "a", None);
        check(&of("Subdivides every quadrilateral mesh."), "a", Some(("the program", Some(4), false)));
        check("/* Loop 1987.\n * Of triangle meshes. */\n\nvoid a(mesh& S) { }\n", "a", program);
        let own = "/* Any polygons. */\nvoid a(mesh& S) { }\n\n  /* For quad\n     meshes. */\nvoid b(mesh& S) { }\n";
        check(own, "b", Some(("`b`", Some(4), false)));
        check(own, "a", None);
        let code = "param int k = 2; /* of triangle meshes */\nvoid a(mesh& S) { print k; }\n";
        check(code, "a", None);
        check("// For quad meshes. */\nvoid a(mesh& S) { }\n", "a", Some(("the program", Some(4), false)));
        check(
            "/* For quad meshes. */\n\nint f() { return 1; } // */\n\nvoid a(mesh& S) { }\n",
            "a",
            Some(("the program", Some(4), false)),
        );
        check("// Of triangle meshes.\nstep { }\n", "step", Some(("the program", Some(3), false)));
    }

    #[test]
    fn conway_operators_that_make_a_dual_are_for_closed_meshes() {
        let text = crate::library::program("conway.vv").unwrap().text;
        for rule in ["dual", "join", "ortho", "meta", "zip", "needle", "snub"] {
            check(text, rule, Some((&format!("`{rule}`"), None, true)));
        }
        for rule in ["kis", "gyro", "truncate", "ambo", "expand", "bevel"] {
            check(text, rule, None);
        }
    }
}
