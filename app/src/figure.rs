//! Figures for papers: lines and areas in SVG, EPS or PDF, sharp in any size. No GPU.
//!
//! ```text
//!   Scene + Mesh ─ space ─► surface     triangles and classified edges in the space of the picture
//!                             ├─ hidden   which parts of edges are seen
//!                             ├─ covered, order    faces that are seen, from back to front
//!                             └─ notes    labels and rings, set in letters
//!                                  └─ page ─ chain ─► svg, eps, pdf, raster
//! ```
//!
//! What is hidden is computed in double precision, not looked up in pixels: edges end exactly where a face covers them or
//! where they pierce one. Approximated is only this: a face with more than three corners that is not flat is the triangles
//! that the window shows too.

mod boxes;
mod build;
mod chain;
mod covered;
mod crossing;
mod eps;
mod fill;
mod hidden;
mod letters;
mod light;
mod mask;
mod notes;
mod order;
mod page;
pub mod paper;
mod pdf;
mod raster;
mod space;
mod surface;
mod svg;
#[cfg(test)]
mod tests;
mod text;

use std::collections::BTreeMap;

use glam::{DVec2, Vec3Swizzles};
use image::RgbaImage;
use rayon::prelude::*;

use vv::mesh::Mesh;
use vv::mesh::faces::Faces;
use vv::stop::{Stop, Stopped};

use crate::annotate::Tint;
use crate::camera::Camera;
use crate::scene::{Scene, Style};

pub use letters::Glyph;
pub use mask::{mask, mask_on};
pub use notes::{Missing, Notes};
pub use page::{At, Drawing, Layer, Path, Sketch, Tile, Words, sheet};
pub use raster::image;

use hidden::{Hider, Interval};
use notes::Inks;
use page::Dots;
use space::Space;
use surface::{Edge, Surface};

/// A kind of file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Format {
    /// Scalable Vector Graphics.
    Svg,
    /// Encapsulated PostScript.
    Eps,
    /// Portable Document Format.
    Pdf,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Eps, Self::Pdf];

    /// What the names of files end in.
    #[must_use]
    pub fn extension(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Eps => "eps",
            Self::Pdf => "pdf",
        }
    }

    /// That of an extension, large or small.
    #[must_use]
    pub fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| extension.eq_ignore_ascii_case(format.extension()))
    }
}

/// A kind of lines, in the order in which they are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Class {
    /// What faces hide of any line.
    Hidden,
    /// Between two faces that are seen from the same side.
    Inner,
    /// Of the control mesh.
    Control,
    /// Between a face seen from outside and one seen from inside.
    Outline,
    /// Where faces pierce each other.
    Intersection,
    /// With a face on one side only, or none; or where the mesh is cut.
    Boundary,
    /// Whose property `sharpness` is more than 0.
    Crease,
}

impl Class {
    /// All of them, in the order in which they are drawn.
    pub const ALL: [Self; 7] =
        [Self::Hidden, Self::Inner, Self::Control, Self::Outline, Self::Intersection, Self::Boundary, Self::Crease];

    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Hidden => "hidden",
            Self::Inner => "inner",
            Self::Control => "control",
            Self::Outline => "outline",
            Self::Intersection => "intersection",
            Self::Boundary => "boundary",
            Self::Crease => "crease",
        }
    }
}

/// How a line is interrupted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Not.
    Solid,
    /// Into short strokes.
    Dashed,
    /// Into dots.
    Dotted,
}

impl Dash {
    /// Lengths of strokes and gaps for a line of this width, in hundredths of a point.
    fn lengths(self, width: f64) -> [i32; 2] {
        let unit = (width * 100.0).max(40.0);
        let lengths = match self {
            Self::Solid => [1.0, 0.0],
            Self::Dashed => [5.0, 3.5],
            Self::Dotted => [1.0, 2.0],
        };
        lengths.map(|length| (length * unit).round() as i32)
    }
}

/// How lines of a class look.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// In points.
    pub width: f64,
    /// Red, green, blue.
    pub color: [u8; 3],
    /// Whether it is interrupted.
    pub dash: Dash,
}

/// How large a figure is, in millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Page {
    /// As wide as this, unless it would be too high.
    pub width: f64,
    /// At most as high as this.
    pub height: Option<f64>,
}

/// How a figure is drawn, beside the style of all pictures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// Its size.
    pub page: Page,
    /// The lines of each [`Class`]; `None` leaves them out.
    pub lines: [Option<Line>; Class::ALL.len()],
    /// Height of letters, in points.
    pub letters: f64,
    /// How much lighter lines are that lie farthest away, from 0, not at all, to 1, white.
    pub fade: f64,
}

impl Default for Settings {
    /// For a column of text, black, hidden lines left out.
    fn default() -> Self {
        let line = |class| match class {
            Class::Hidden => None,
            _ => Some(Self::line(class)),
        };
        Self { page: Page { width: 120.0, height: Some(160.0) }, lines: Class::ALL.map(line), letters: 7.0, fade: 0.0 }
    }
}

impl Settings {
    /// What lines of a class look like, if they are drawn.
    #[must_use]
    pub fn line(class: Class) -> Line {
        let line = |width, color| Line { width, color, dash: Dash::Solid };
        match class {
            Class::Hidden => Line { dash: Dash::Dashed, ..line(0.3, [0x77; 3]) },
            Class::Inner => line(0.35, [0; 3]),
            Class::Control => line(0.5, [0xc8, 0x1e, 0x5a]),
            Class::Outline | Class::Intersection | Class::Boundary => line(0.8, [0; 3]),
            Class::Crease => line(1.2, [0; 3]),
        }
    }
}

/// Height of letters in pictures, in points: as in the window.
const ON_SCREEN: f64 = 11.0;

/// How far along an edge it is looked whether it is seen at its end.
const NEAR: f64 = 1e-3;

/// What to say of a drawing that is not exact.
pub const ROUGH: &str =
    "so many faces hide each other that some were ordered by distance only, so parts of them may be covered wrongly";

/// What is drawn.
#[derive(Debug, Clone, Copy)]
pub struct Subject<'a> {
    /// Its triangles, edges and control mesh.
    pub scene: &'a Scene,
    /// The mesh that the scene was made of.
    pub mesh: &'a Mesh,
    /// Its faces.
    pub faces: &'a Faces,
    /// Their colours, made for the scene.
    pub tint: Option<&'a Tint>,
    /// What is written and marked on it.
    pub notes: &'a Notes,
}

/// Draws what `camera` sees in a picture of this width over height. `None` if that is nothing.
///
/// Of the style it takes whether edges, vertices and the control mesh are drawn, whether faces are filled (else they are
/// white, and hide what is behind), their colours, and the cut. Edges left out leave those that delimit the surface.
///
/// Cost: O(n log n) and what lies before each edge, on all threads.
///
/// # Errors
/// When `stop` is requested.
pub fn draw(
    subject: Subject<'_>,
    camera: &Camera,
    aspect: f64,
    style: &Style,
    settings: &Settings,
    stop: &Stop,
) -> Result<Option<Drawing>, Stopped> {
    let tile = Tile { sketch: Some(sketch(subject, camera, aspect, style, settings, stop)?), caption: String::new() };
    stop.check()?;
    Ok(sheet(vec![tile], None, settings))
}

/// What `camera` sees, without a place on a page; for [`sheet`].
///
/// # Errors
/// When `stop` is requested.
pub fn sketch(
    subject: Subject<'_>,
    camera: &Camera,
    aspect: f64,
    style: &Style,
    settings: &Settings,
    stop: &Stop,
) -> Result<Sketch, Stopped> {
    let Subject { scene, mesh, .. } = subject;
    let bounds = scene.bounds(&Style { control: false, ..*style });
    let space = Space::new(camera, aspect, &style.cut, bounds);
    let mut surface = Surface::new(scene, mesh, &space, style.control);
    stop.check()?;
    let hider = Hider::new(&surface.triangles);
    let settings = &effective(settings, style);
    let wanted = |class: Class| settings.lines[class as usize].is_some();
    if wanted(Class::Intersection) || wanted(Class::Hidden) {
        surface.edges.extend(crossing::crossings(&surface.triangles, stop)?);
    }
    let edges: Vec<&Edge> = surface.edges.iter().filter(|edge| wanted(edge.class) || wanted(Class::Hidden)).collect();
    let hidden: Vec<Vec<Interval>> =
        edges.par_iter().map(|edge| if stop.check().is_ok() { hider.hidden(edge) } else { Vec::new() }).collect();
    stop.check()?;
    let mut sketch = Sketch::default();
    if style.faces {
        (sketch.faces, sketch.is_rough) = fill::fill(subject, &surface, &space, style, stop)?;
    }
    for (edge, hidden) in edges.iter().zip(&hidden) {
        let [a, b] = edge.ends;
        let piece = |&(low, high): &Interval| [a.lerp(b, low), a.lerp(b, high)];
        sketch.lines[edge.class as usize].extend(hidden::rest(hidden).iter().map(piece));
        sketch.lines[Class::Hidden as usize].extend(hidden.iter().map(piece));
    }
    let lonely = scene.mesh.lonely_count;
    let dots: Vec<_> = surface.vertices.iter().filter(|(vertex, _)| style.vertices || *vertex < lonely).collect();
    let seen = dots.par_iter().filter(|(vertex, at)| !hider.hides_vertex(*vertex, *at));
    let places: Vec<DVec2> = seen.map(|(_, at)| at.xy()).collect();
    if !places.is_empty() {
        let diameter = f64::from(style.vertex_size) / 2.0;
        sketch.dots.push(Dots { name: "vertices", diameter, color: [0; 3], places });
    }
    stop.check()?;
    if !subject.notes.is_empty() {
        let mut lines: BTreeMap<u32, Vec<DVec2>> = BTreeMap::new();
        for (edge, hidden) in edges.iter().zip(&hidden).filter(|(edge, _)| wanted(edge.class)) {
            let along = (edge.ends[1] - edge.ends[0]).xy();
            let is_seen = |t: f64| !hidden.iter().any(|&(low, high)| (low..=high).contains(&t));
            for (vertex, toward, t) in [(edge.vertices[0], along, NEAR), (edge.vertices[1], -along, 1.0 - NEAR)] {
                if is_seen(t) {
                    lines.entry(vertex).or_default().push(toward);
                }
            }
        }
        let dot = if style.vertices { f64::from(style.vertex_size) / 4.0 } else { 0.4 };
        let found = notes::find(&subject, &surface, &space, Some(&hider), &lines, (dot, settings.letters, Inks::PAPER));
        sketch.notes = found.notes;
        sketch.strokes = found.strokes;
        sketch.dots.extend(found.dots);
        sketch.missing = found.missing;
    }
    if style.axes {
        sketch.axes = Some(space.axes());
    }
    Ok(sketch)
}

/// Writes notes, and the axes if the style has them, on a picture of the same subject from the same place; `scale` is
/// pixels per point. Returns what is missing of the notes.
pub fn write_on(
    picture: &mut RgbaImage,
    subject: Subject<'_>,
    camera: &Camera,
    style: &Style,
    scale: f32,
) -> Vec<Missing> {
    if subject.notes.is_empty() && !style.axes {
        return Vec::new();
    }
    let size = DVec2::new(picture.width().into(), picture.height().into()) / f64::from(scale);
    let bounds = subject.scene.bounds(&Style { control: false, ..*style });
    let space = Space::new(camera, size.x / size.y, &style.cut, bounds);
    let inks = Inks::of(style.theme);
    let (mut sketch, mut missing) = (Sketch::default(), Vec::new());
    if !subject.notes.is_empty() {
        let surface = Surface::new(subject.scene, subject.mesh, &space, false);
        let hider = style.faces.then(|| Hider::new(&surface.triangles));
        let mut lines: BTreeMap<u32, Vec<DVec2>> = BTreeMap::new();
        for edge in &surface.edges {
            let along = (edge.ends[1] - edge.ends[0]).xy();
            lines.entry(edge.vertices[0]).or_default().push(along);
            lines.entry(edge.vertices[1]).or_default().push(-along);
        }
        // Dots of pictures are as large as on the screen.
        let dot = if style.vertices { f64::from(style.vertex_size) / 2.0 } else { 0.5 };
        let found = notes::find(&subject, &surface, &space, hider.as_ref(), &lines, (dot, ON_SCREEN, inks));
        (sketch.notes, sketch.strokes, sketch.dots) = (found.notes, found.strokes, found.dots);
        missing = found.missing;
    }
    sketch.axes = style.axes.then(|| space.axes());
    raster::over(picture, &page::overlay(sketch, size, inks), f64::from(scale));
    missing
}

/// Without the lines that the style leaves out.
fn effective(settings: &Settings, style: &Style) -> Settings {
    let mut settings = *settings;
    if !style.edges {
        settings.lines[Class::Inner as usize] = None;
    }
    settings
}

/// The drawing in a file.
#[must_use]
pub fn write(drawing: &Drawing, format: Format) -> Vec<u8> {
    match format {
        Format::Svg => svg::write(drawing).into_bytes(),
        Format::Eps => eps::write(drawing).into_bytes(),
        Format::Pdf => pdf::write(drawing),
    }
}

/// Hundredths as a number, as short as can be.
fn hundredths(x: i32) -> String {
    let (sign, whole, part) = (if x < 0 { "-" } else { "" }, x.unsigned_abs() / 100, x.unsigned_abs() % 100);
    let whole = if whole == 0 && part > 0 { String::new() } else { whole.to_string() };
    match part {
        0 => format!("{sign}{whole}"),
        _ if part.is_multiple_of(10) => format!("{sign}{whole}.{}", part / 10),
        _ => format!("{sign}{whole}.{part:02}"),
    }
}

/// A colour as three numbers from 0 to 1.
fn thousandths(color: [u8; 3]) -> String {
    let part = |c: u8| {
        let text = format!("{:.3}", f64::from(c) / 255.0);
        let text = text.trim_end_matches('0').trim_end_matches('.');
        if text.len() > 1 { text.trim_start_matches('0').to_owned() } else { text.to_owned() }
    };
    color.map(part).join(" ")
}

/// Hundredths of a point in millimetres.
fn millimetres(x: i32) -> String {
    let text = format!("{:.2}", f64::from(x) / 7200.0 * 25.4);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
