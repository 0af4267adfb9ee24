//! The programs that ship with vv, as exhibits: in which group, on which mesh and how far they are worth looking at.

use crate::document::MeshSource;
use crate::library;

/// What belongs together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Group {
    /// Smooth surfaces from coarse ones.
    Subdivision,
    /// What else can be done with a mesh.
    Beyond,
    /// What is the same at every scale.
    Fractals,
    /// What becomes of itself.
    Growth,
    /// The listings of Smith, Prusinkiewicz and Samavati, as printed.
    Paper,
}

impl Group {
    /// In this order.
    pub const ALL: [Self; 5] = [Self::Subdivision, Self::Beyond, Self::Fractals, Self::Growth, Self::Paper];

    /// Above its programs.
    #[must_use]
    pub fn title(self) -> &'static str {
        match self {
            Self::Subdivision => "Subdivision",
            Self::Beyond => "Beyond subdivision",
            Self::Fractals => "Fractals and tilings",
            Self::Growth => "Growth and patterns",
            Self::Paper => "The paper",
        }
    }
}

/// A program that is worth looking at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Exhibit {
    /// Its name among [`library::PROGRAMS`].
    pub program: &'static str,
    /// What to call it.
    pub title: &'static str,
    /// Where it belongs.
    pub group: Group,
    /// A mesh that suits it, among [`library::MESHES`]; `None` for its own.
    mesh: Option<&'static str>,
    /// The rule, unless it is the program's default.
    pub rule: Option<&'static str>,
    /// The generation to open it with: worth looking at, and soon there.
    pub generation: u64,
    /// A picture of it, a square in PNG format.
    pub picture: &'static [u8],
}

impl Exhibit {
    /// Whether it is shown on a mesh, and not on its own.
    #[must_use]
    pub fn is_of_a_mesh(&self) -> bool {
        self.mesh.is_some()
    }

    /// A mesh that suits it.
    #[must_use]
    pub fn mesh(&self) -> MeshSource {
        self.mesh.map_or(MeshSource::Empty, |name| MeshSource::BuiltIn(name.to_owned()))
    }

    /// What its first comment says.
    #[must_use]
    pub fn headline(&self) -> String {
        library::program(self.program).map_or_else(String::new, |program| headline(program.text))
    }
}

macro_rules! exhibits {
    ($($program:literal $title:literal $group:ident $mesh:expr, $rule:expr, $generation:literal;)*) => {
        &[$(Exhibit {
            program: concat!($program, ".vv"),
            title: $title,
            group: Group::$group,
            mesh: $mesh,
            rule: $rule,
            generation: $generation,
            picture: include_bytes!(concat!("../../assets/pictures/programs/", $program, ".png")),
        }),*]
    };
}

/// All of them, by group.
pub const EXHIBITS: &[Exhibit] = exhibits! {
    "loop" "Loop" Subdivision Some("tetrapod.obj"), None, 2;
    "loop-creases" "Loop with creases" Subdivision Some("cube-open.obj"), None, 3;
    "butterfly" "Modified butterfly" Subdivision Some("tetrapod.obj"), None, 2;
    "sqrt3" "√3" Subdivision Some("genus-2.obj"), None, 2;
    "catmull-clark" "Catmull–Clark" Subdivision Some("elephant.obj"), None, 2;
    "catmull-clark-creases" "Catmull–Clark creases" Subdivision Some("cube-creased.obj"), None, 3;
    "colors" "Colours, too" Subdivision None, None, 3;
    "doo-sabin" "Doo–Sabin" Subdivision Some("cube-frame.obj"), None, 1;
    "quad-triangle" "Triangles and quads" Subdivision Some("rhombicuboctahedron.obj"), None, 2;
    "midedge" "Midedge" Subdivision Some("pawn.obj"), None, 2;
    "four-eight" "4–8" Subdivision Some("cube.obj"), None, 5;
    "curves" "Curves" Subdivision None, None, 4;
    "conway" "Conway's operators" Beyond Some("dodecahedron.obj"), Some("snub"), 1;
    "limit" "Limit positions" Beyond Some("tetrapod.obj"), Some("loop_limit"), 1;
    "smooth" "Smoothing" Beyond Some("elephant.obj"), Some("taubin"), 4;
    "delaunay" "Delaunay flips" Beyond Some("torus.obj"), None, 1;
    "remesh" "Remeshing" Beyond None, None, 8;
    "distance" "Distance" Beyond None, None, 30;
    "mountain" "Mountain" Fractals None, None, 5;
    "koch" "Koch's snowflake" Fractals None, None, 3;
    "sierpinski" "Sierpiński's triangle" Fractals None, None, 4;
    "sierpinski-tetrahedron" "Sierpiński's tetrahedron" Fractals None, None, 4;
    "penrose" "Penrose's tiling" Fractals None, None, 4;
    "tissue" "A growing shoot" Growth None, None, 60;
    "coral" "A coral" Growth None, None, 5;
    "reaction-diffusion" "Spots and stripes" Growth None, None, 100;
    "paper-polyhedral" "Polyhedral, as printed" Paper Some("icosahedron.obj"), None, 2;
    "paper-loop" "Loop, as printed" Paper Some("octahedron.obj"), None, 3;
    "paper-butterfly" "Butterfly, as printed" Paper Some("torus.obj"), None, 1;
    "paper-sqrt3" "√3, as printed" Paper Some("tetrapod.obj"), None, 2;
};

/// The exhibit of a program.
#[must_use]
pub fn exhibit(program: &str) -> Option<&'static Exhibit> {
    EXHIBITS.iter().find(|exhibit| exhibit.program == program)
}

/// The first comment of a program, in one line.
#[must_use]
pub fn headline(text: &str) -> String {
    let text = text.trim_start();
    if let Some((inside, _)) = text.strip_prefix("/*").and_then(|text| text.split_once("*/")) {
        return vv::assist::block_comment(inside);
    }
    let lines = text.lines().map(str::trim).take_while(|line| line.starts_with("//"));
    lines.map(|line| line.trim_start_matches('/').trim()).collect::<Vec<_>>().join(" ")
}

/// What a headline says in short: its first sentence, up to a full stop before a large letter, without who and when.
#[must_use]
pub fn line(headline: &str) -> &str {
    let ends = headline.match_indices(". ").find(|(at, _)| headline[at + 2..].starts_with(char::is_uppercase));
    let sentence = ends.map_or(headline, |(at, _)| &headline[..at]).trim_end_matches('.');
    match sentence.split_once(": ") {
        Some((source, said)) if source.contains(|c: char| c.is_ascii_digit()) => said,
        _ => sentence,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::NOWHERE;
    use crate::files;
    use std::path::Path;

    #[test]
    fn every_program_that_does_something_is_shown_on_what_it_needs() {
        for program in library::PROGRAMS {
            let (compilation, _) = files::compile(&Path::new(NOWHERE).join(program.name), program.text);
            let compiled = compilation.program.unwrap();
            let does_something = !compiled.rules.is_empty() || compiled.start.is_some();
            let exhibit = exhibit(program.name);
            assert_eq!(exhibit.is_some(), does_something, "{}", program.name);
            let Some(exhibit) = exhibit else { continue };
            assert_eq!(exhibit.mesh.is_none(), compiled.start.is_some(), "{}", program.name);
            assert!(exhibit.rule.is_none_or(|rule| compiled.rule(rule).is_some()), "{}", program.name);
        }
        for exhibit in EXHIBITS {
            assert!(library::program(exhibit.program).is_some(), "{}", exhibit.program);
            let mesh = |name: &str| library::MESHES.iter().any(|m| m.name == name);
            assert!(exhibit.mesh.is_none_or(mesh), "{}", exhibit.program);
        }
    }

    #[test]
    fn exhibits_stand_in_the_order_of_their_groups() {
        let groups: Vec<Group> = EXHIBITS.iter().map(|e| e.group).collect();
        let ordered = groups.chunk_by(|a, b| a == b).map(|chunk| chunk[0]);
        assert_eq!(ordered.collect::<Vec<_>>(), Group::ALL);
    }

    #[test]
    fn a_program_is_told_of_in_a_sentence() {
        assert_eq!(line("Kobbelt 2000, Figs. 3 and 7: it is. And more."), "it is");
        assert_eq!(line("A shoot: it grows. It does."), "A shoot: it grows");
        assert_eq!(headline("// One\n//  two.\nvoid f(mesh& S) { } // three"), "One two.");
        assert_eq!(headline("\n/* One\n * two.\n */\nvoid f(mesh& S) { }"), "One two.");
        for exhibit in EXHIBITS {
            assert!(line(&exhibit.headline()).len() > 15, "{}", exhibit.program);
        }
    }
}
