//! Lines and areas on paper, and how large the paper is.

use glam::DVec2;

use super::chain::chain;
use super::{Class, Line, Page, Settings};

/// A place on the page in hundredths of a point (1/72 inch), from its upper left corner, y down.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct At {
    /// To the right.
    pub x: i32,
    /// Downwards.
    pub y: i32,
}

impl At {
    pub(super) fn minus(self, other: Self) -> DVec2 {
        let difference = |a: i32, b: i32| f64::from(a) - f64::from(b);
        DVec2::new(difference(self.x, other.x), difference(self.y, other.y))
    }
}

/// A line through points.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Path {
    /// Two or more.
    pub points: Vec<At>,
    /// Whether it goes back to the first point.
    pub closed: bool,
}

/// What is drawn at once.
#[derive(Debug, Clone, PartialEq)]
pub enum Layer {
    /// Filled polygons, from back to front.
    Faces(Vec<(Vec<At>, [u8; 3])>),
    /// Lines of one class.
    Lines {
        /// Which.
        class: Class,
        /// How they look.
        line: Line,
        /// Where they are.
        paths: Vec<Path>,
    },
    /// Vertices.
    Dots {
        /// In hundredths of a point.
        diameter: i32,
        /// Red, green, blue.
        color: [u8; 3],
        /// Where they are.
        places: Vec<At>,
    },
}

/// A page with everything on it.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawing {
    /// Width and height.
    pub size: At,
    /// From below to above.
    pub layers: Vec<Layer>,
    /// Whether all faces are in their right order: not if that would take too many pieces.
    pub is_exact: bool,
}

/// What is to be drawn, in picture coordinates.
#[derive(Debug, Default)]
pub(super) struct Sketch {
    pub faces: Vec<(Vec<DVec2>, [u8; 3])>,
    pub lines: [Vec<[DVec2; 2]>; Class::ALL.len()],
    pub dots: Vec<DVec2>,
    /// Whether some faces are ordered by distance only.
    pub is_rough: bool,
}

const DOT: [u8; 3] = [0; 3];

/// Puts a sketch on the page, as large as it gets; `None` if there is nothing to see.
pub(super) fn lay_out(sketch: Sketch, settings: &Settings, dot_size: f64) -> Option<Drawing> {
    let line = |class: Class| settings.lines[class as usize].filter(|_| !sketch.lines[class as usize].is_empty());
    let widest = Class::ALL.into_iter().filter_map(line).map(|line| line.width).fold(0.0, f64::max);
    let margin = if sketch.dots.is_empty() { widest } else { widest.max(dot_size) } / 2.0;

    let drawn = Class::ALL.into_iter().filter(|&class| line(class).is_some());
    let ends = drawn.flat_map(|class| &sketch.lines[class as usize]).flatten();
    let corners = sketch.faces.iter().flat_map(|(corners, _)| corners);
    let points = ends.chain(corners).chain(&sketch.dots);
    let nowhere = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) = points.fold(nowhere, |(low, high), &p| (low.min(p), high.max(p)));
    if !low.is_finite() {
        return None;
    }
    let scale = scale(settings.page, high - low, margin);
    let hundredths = |x: f64| (x * 100.0).round() as i32;
    let at = |p: &DVec2| At {
        x: hundredths((p.x - low.x) * scale + margin),
        y: hundredths((high.y - p.y) * scale + margin),
    };
    let corner = at(&DVec2::new(high.x, low.y));
    let margin = hundredths(margin);

    let mut layers = Vec::new();
    if !sketch.faces.is_empty() {
        let faces = sketch.faces.iter().map(|(corners, color)| (corners.iter().map(at).collect(), *color));
        layers.push(Layer::Faces(faces.collect()));
    }
    for class in Class::ALL {
        if let Some(line) = line(class) {
            let pieces = sketch.lines[class as usize].iter().map(|ends| [at(&ends[0]), at(&ends[1])]);
            layers.push(Layer::Lines { class, line, paths: chain(pieces.collect()) });
        }
    }
    if !sketch.dots.is_empty() {
        let places = sketch.dots.iter().map(at).collect();
        layers.push(Layer::Dots { diameter: hundredths(dot_size), color: DOT, places });
    }
    Some(Drawing { size: At { x: corner.x + margin, y: corner.y + margin }, layers, is_exact: !sketch.is_rough })
}

/// Points for each unit of the picture.
fn scale(page: Page, size: DVec2, margin: f64) -> f64 {
    const POINTS_PER_MM: f64 = 72.0 / 25.4;
    // In whole hundredths, so that nothing is rounded up beyond it.
    let room = |mm: f64| ((mm * POINTS_PER_MM * 100.0).floor() / 100.0 - 2.0 * margin).max(1.0);
    let across = room(page.width) / size.x;
    let down = page.height.map_or(f64::INFINITY, room) / size.y;
    // What is no wider than a line, or no wider and no higher.
    let sizes = [across, down, room(page.width) / size.y];
    let scale = if size.x > 1e-9 { across.min(down) } else { sizes[1].min(sizes[2]) };
    if scale.is_finite() { scale } else { 1.0 }
}
