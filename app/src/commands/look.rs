//! How pictures look.

use std::path::PathBuf;

use app::annotate::{Annotations, Arrows, Label, Quantity};
use app::figure::{Class, Line, Notes, Page, Settings, paper};
use app::inspect::lineage::Lineage;
use app::scene::{Axis, Cut, Style, Surface, Theme};
use clap::Args;
use vv::diagnostic::{Diagnostic, Severity};
use vv::mesh::faces::Faces;
use vv::mesh::{Mesh, Vertex};
use vv::source::Sources;

use super::report::Reporter;
use super::{Exit, error, fail, style};

/// Options of everything that draws pictures.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Pictures")]
pub struct LookArguments {
    /// Colour pictures by valence, gauss, birth, a property …
    ///
    /// One of valence, degree (of faces), gauss, mean (curvature), birth (generation), change (in the last step),
    /// change:N (since generation N), x, y, z, or a vertex property; `NAME:color` takes a vec as red, green, blue.
    #[arg(long, value_name = "WHAT", value_parser = quantity)]
    color_by: Option<Quantity>,
    /// The numbers at both ends of the colours.
    ///
    /// Default: what most of the numbers lie between, of all that is side by side in one picture, or in one film.
    #[arg(long, value_name = "LOW,HIGH", allow_hyphen_values = true, value_parser = range)]
    color_range: Option<[f64; 2]>,
    /// Draw vertex-normals, face-normals, or a property of type vec.
    #[arg(long, value_name = "WHAT", value_parser = arrows)]
    arrows: Option<Arrows>,
    /// Write vertices, degrees, numbers, or a property.
    ///
    /// At what is seen: vertices (what they are called), degrees (in faces, how many corners they have), numbers (of
    /// the colours), or the value of a vertex property.
    #[arg(long, value_name = "WHAT", value_parser = labels)]
    labels: Option<Label>,
    /// Number the neighbours of this vertex in the order of its ring.
    ///
    /// With arrows from each to the next; vertices are counted from 1. May be repeated.
    #[arg(long, value_name = "NUMBER", value_parser = vertex)]
    ring: Vec<Vertex>,
    /// How pictures are drawn: words, or a style file.
    ///
    /// Words with commas between: faces, edges, vertices, control (the mesh of generation 0 over it), smooth, colors,
    /// occlusion, grid, axes, dark, transparent, lights, reflection-lines, isophotes; with `no-` in front to leave it
    /// out. Or a file such as the window saves as style: words and all other options go before what it says.
    #[arg(long, value_name = "WORDS|FILE", value_delimiter = ',', value_parser = style::given)]
    style: Vec<style::Given>,
    /// The colour behind pictures in place of paper.
    ///
    /// White, black, or such as #1c293b. Figures have nothing behind them.
    #[arg(long, value_name = "COLOR", value_parser = paper::background)]
    background: Option<[u8; 3]>,
    /// How finely pictures are drawn.
    ///
    /// In samples for each pixel: 1, 4, 16 or 64. Default: 4.
    #[arg(long, value_name = "N", value_parser = samples)]
    samples: Option<u32>,
    /// Cut the mesh open across an axis: x, y, z or view.
    ///
    /// `-x` keeps the other side, `x:0.5` cuts elsewhere than in the middle, from -1 to 1.
    #[arg(long, value_name = "AXIS[:PLACE]", allow_hyphen_values = true, value_parser = cut)]
    cut: Option<Cut>,
    /// Size of figures, such as 85mm or 85x60mm.
    ///
    /// A width, or a width and a height that they fit into. Default: 120x160mm, of several side by side 160mm.
    #[arg(long, help_heading = "Figures", value_name = "W[xH]mm", value_parser = paper::page)]
    page: Option<Page>,
    /// How figures draw a class of lines, such as inner=0.3,#888.
    ///
    /// The classes are outline, boundary, crease, intersection (of faces that pierce each other), inner, control and
    /// hidden; the look is width in points, colour, and solid, dashed or dotted, in any order; `hidden` draws them,
    /// `inner=none` does not. May be repeated.
    #[arg(long, help_heading = "Figures", value_name = "CLASS[=LOOK]", value_parser = paper::line)]
    line: Vec<(Class, Option<Line>)>,
    /// Make lines of figures lighter the farther away they are.
    ///
    /// Up to this much: from 0 to 1, which is white. Default, without a number: 0.75.
    #[arg(long, help_heading = "Figures", value_name = "AMOUNT", num_args = 0..=1, require_equals = true, default_missing_value = "0.75", value_parser = paper::fade)]
    fade: Option<f64>,
    /// Height of letters in figures, in points.
    ///
    /// Default: 7.
    #[arg(long, help_heading = "Figures", value_name = "POINTS", value_parser = paper::letters)]
    font_size: Option<f64>,
}

/// What a picture shows beside mesh and faces.
#[derive(Debug, Clone, Default)]
pub struct Look {
    /// How it is drawn.
    pub style: Style,
    /// What is shown on it.
    pub annotations: Annotations,
    /// What is written and marked on it.
    pub notes: Notes,
    /// How a figure is drawn.
    pub figure: Settings,
    /// Whether its page was asked for.
    pub has_page: bool,
    /// The colour behind pictures, in place of what the style has.
    pub background: Option<[u8; 3]>,
    /// Samples for each pixel of a picture; `None` is for as many as there are usually.
    pub samples: Option<u32>,
}

/// A mesh and where it comes from.
#[derive(Debug, Clone, Copy)]
pub struct Result<'a> {
    /// The mesh.
    pub mesh: &'a Mesh,
    /// Its faces.
    pub faces: &'a Faces,
    /// The meshes before it.
    pub past: &'a Past,
}

/// What is known of the generations before.
#[derive(Debug, Clone, Default)]
pub struct Past {
    /// How many there are.
    pub generation: u64,
    /// The last one.
    pub before: Option<Mesh>,
    /// Generation 0, if this is another one.
    pub first: Option<Mesh>,
    /// Which vertex of a generation is which of another.
    pub lineage: Lineage,
}

impl Look {
    /// Says what of it figures leave out.
    pub fn warn_of_figures(&self, reporter: &Reporter) {
        let asked = [
            (self.annotations.arrows != Arrows::Nothing, "arrows"),
            (self.style.grid, "the grid"),
            (self.style.occlusion, "occlusion"),
            (self.style.surface != Surface::default(), "lines of reflection"),
        ];
        let missing: Vec<&str> = asked.into_iter().filter_map(|(is_asked, what)| is_asked.then_some(what)).collect();
        if !missing.is_empty() {
            let message = format!("figures leave out {}", missing.join(", "));
            let warning = Diagnostic::new(Severity::Warning, None, message);
            reporter.report(&[warning.hint("a picture, .png, shows all")], &Sources::default());
        }
    }
}

impl LookArguments {
    /// What they say.
    ///
    /// # Errors
    /// [`Exit::File`] if a style file cannot be read or is wrong; reported.
    pub fn look(&self, reporter: &Reporter) -> std::result::Result<Look, Exit> {
        let mut look = style::look(&self.style, reporter)?;
        look.style.cut = self.cut.unwrap_or(look.style.cut);
        look.figure.page = self.page.unwrap_or(look.figure.page);
        look.has_page |= self.page.is_some();
        look.figure.fade = self.fade.unwrap_or(look.figure.fade);
        look.figure.letters = self.font_size.unwrap_or(look.figure.letters);
        for &(class, line) in &self.line {
            look.figure.lines[class as usize] = line;
        }
        if let Some(color_by) = &self.color_by {
            // The range of other numbers is none for these.
            (look.annotations.color_by, look.annotations.range) = (color_by.clone(), None);
        }
        if self.color_range.is_some() && look.annotations.color_by == Quantity::Plain {
            return fail(
                reporter,
                Exit::Usage,
                error("`--color-range` needs something to colour by: `--color-by WHAT`"),
            );
        }
        look.annotations.range = self.color_range.or(look.annotations.range);
        look.annotations.arrows = self.arrows.clone().unwrap_or(look.annotations.arrows);
        look.notes.labels = self.labels.clone().unwrap_or(look.notes.labels);
        look.notes.rings.clone_from(&self.ring);
        look.background = self.background.or(look.background);
        look.samples = self.samples;
        Ok(look)
    }

    /// The files that say how pictures look.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        style::files(&self.style)
    }
}

/// A word of `--style`, and whether it stands without `no-`.
#[derive(Debug, Clone, Copy)]
pub struct Word(&'static str, bool);

const WORDS: [&str; 14] = [
    "faces",
    "edges",
    "vertices",
    "control",
    "smooth",
    "colors",
    "occlusion",
    "grid",
    "axes",
    "dark",
    "transparent",
    "lights",
    "reflection-lines",
    "isophotes",
];

/// Reads a word.
pub fn word(text: &str) -> std::result::Result<Word, String> {
    let (text, on) = text.strip_prefix("no-").map_or((text, true), |text| (text, false));
    let known = WORDS.into_iter().find(|word| *word == text).map(|word| Word(word, on));
    known.ok_or_else(|| {
        let nearest = super::closest(text, WORDS).map_or(String::new(), |word| format!("; did you mean `{word}`?"));
        format!("the words are {}{nearest}", WORDS.join(", "))
    })
}

impl Word {
    /// Changes a style so.
    pub fn apply(self, style: &mut Style) {
        let Self(word, on) = self;
        let surface = |surface| if on { surface } else { Surface::Lights };
        match word {
            "faces" => style.faces = on,
            "edges" => style.edges = on,
            "vertices" => style.vertices = on,
            "control" => style.control = on,
            "smooth" => style.smooth = on,
            "colors" => style.colors = on,
            "occlusion" => style.occlusion = on,
            "grid" => style.grid = on,
            "axes" => style.axes = on,
            "dark" => style.theme = if on { Theme::Dark } else { Theme::Light },
            "transparent" => style.transparent = on,
            "reflection-lines" => style.surface = surface(Surface::ReflectionLines),
            "isophotes" => style.surface = surface(Surface::Isophotes),
            _ => style.surface = Surface::Lights,
        }
    }
}

fn samples(text: &str) -> std::result::Result<u32, String> {
    text.parse().ok().filter(|n| [1, 4, 16, 64].contains(n)).ok_or_else(|| "samples are 1, 4, 16 or 64".to_owned())
}

fn quantity(text: &str) -> std::result::Result<Quantity, String> {
    match text.parse() {
        Ok(_) if text.is_empty() => Err("it is colours by something".to_owned()),
        Ok(quantity) => Ok(quantity),
        Err(never) => match never {},
    }
}

fn arrows(text: &str) -> std::result::Result<Arrows, String> {
    match text {
        "" => Err("they are arrows of something".to_owned()),
        "vertex-normals" => Ok(Arrows::VertexNormals),
        "face-normals" => Ok(Arrows::FaceNormals),
        name => Ok(Arrows::Property(name.to_owned())),
    }
}

fn labels(text: &str) -> std::result::Result<Label, String> {
    match text {
        "" => Err("it is labels of something".to_owned()),
        "vertices" => Ok(Label::Vertices),
        "degrees" => Ok(Label::Degrees),
        "numbers" => Ok(Label::Numbers),
        name => Ok(Label::Property(name.to_owned())),
    }
}

fn vertex(text: &str) -> std::result::Result<Vertex, String> {
    let number = text.strip_prefix('v').unwrap_or(text).parse().ok();
    let vertex = number.and_then(|n: usize| Vertex::from_index(n.checked_sub(1)?));
    vertex.ok_or_else(|| "vertices are counted from 1, such as 7".to_owned())
}

fn range(text: &str) -> std::result::Result<[f64; 2], String> {
    let numbers = text.split_once(',').and_then(|(a, b)| Some([a.trim().parse().ok()?, b.trim().parse().ok()?]));
    let valid = numbers.filter(|[low, high]: &[f64; 2]| low < high && low.is_finite() && high.is_finite());
    valid.ok_or_else(|| "a range is two numbers, the smaller one first, such as 0,1.5".to_owned())
}

fn cut(text: &str) -> std::result::Result<Cut, String> {
    let wrong = || "a cut is x, y, z or view, perhaps with a place from -1 to 1, such as x or -y:0.5".to_owned();
    let (axis, place) = text.split_once(':').unwrap_or((text, "0"));
    let position: f32 = place.parse().ok().filter(|p| (-1.0..=1.0).contains(p)).ok_or_else(wrong)?;
    let (axis, flipped) = axis.strip_prefix('-').map_or((axis, false), |axis| (axis, true));
    let across = match axis {
        "x" => Axis::X,
        "y" => Axis::Y,
        "z" => Axis::Z,
        "view" => Axis::View,
        _ => return Err(wrong()),
    };
    Ok(Cut { on: true, across, position, flipped })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_is_an_axis_with_a_side_and_a_place() {
        let plane = |across, position, flipped| Ok(Cut { on: true, across, position, flipped });
        assert_eq!(cut("x"), plane(Axis::X, 0.0, false));
        assert_eq!(cut("-view:-0.25"), plane(Axis::View, -0.25, true));
        for wrong in ["", "w", "x:2", "x:", "x:nan", "--x"] {
            assert!(cut(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_range_is_two_numbers_in_order() {
        assert_eq!(range("-1, 2.5"), Ok([-1.0, 2.5]));
        for wrong in ["", "1", "2,1", "1,1", "0,inf", "a,b", "1,2,3"] {
            assert!(range(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn each_word_of_a_style_changes_it_and_with_no_in_front_takes_it_back() {
        for name in WORDS.into_iter().filter(|name| *name != "lights") {
            let (mut on, mut off) = (Style::default(), Style::default());
            word(name).unwrap().apply(&mut on);
            word(&format!("no-{name}")).unwrap().apply(&mut off);
            assert_ne!(on, off, "{name}");
        }
        assert!(word("smoth").unwrap_err().ends_with("did you mean `smooth`?"));
    }
}
