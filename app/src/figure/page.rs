//! Lines, areas and text on paper, and how large the paper is.

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::build::Builder;
use super::letters::Glyph;
use super::notes::{Inks, Missing};
use super::text::{self, Block};
use super::{Class, Line, ON_SCREEN, Page, Settings};

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

/// A line of text in its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Words {
    /// What it says.
    pub text: String,
    /// Its letters, and where on its line each stands.
    pub glyphs: Vec<(Glyph, At)>,
}

/// What is drawn at once.
#[derive(Debug, Clone, PartialEq)]
pub enum Layer {
    /// Filled polygons, from back to front.
    Faces(Vec<(Vec<At>, [u8; 3])>),
    /// Lines of one kind.
    Lines {
        /// Which.
        name: &'static str,
        /// Which of [`DEPTHS`] parts of the scene they lie in, 0 for the nearest, if lines fade.
        depth: usize,
        /// How they look.
        line: Line,
        /// Where they are.
        paths: Vec<Path>,
    },
    /// Points of one kind.
    Dots {
        /// Which.
        name: &'static str,
        /// In hundredths of a point.
        diameter: i32,
        /// Red, green, blue.
        color: [u8; 3],
        /// Where they are.
        places: Vec<At>,
    },
    /// Text of one kind.
    Text {
        /// Which.
        name: &'static str,
        /// Height of letters in hundredths of a point.
        size: i32,
        /// Red, green, blue.
        color: [u8; 3],
        /// Colour and width of the lines around letters that keep them apart from what is below.
        halo: ([u8; 3], i32),
        /// What is written.
        words: Vec<Words>,
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
    /// How many texts were left out because others take their room.
    pub crowded_out: usize,
    /// What is missing of the notes in all its parts.
    pub missing: Vec<Missing>,
}

impl Drawing {
    /// All letters in their sizes, each once and in order.
    pub(super) fn letters(&self) -> Vec<(Glyph, i32)> {
        let of = |layer: &Layer| match layer {
            Layer::Text { size, words, .. } => {
                words.iter().flat_map(|line| &line.glyphs).map(|(glyph, _)| (*glyph, *size)).collect()
            }
            _ => Vec::new(),
        };
        let mut all: Vec<_> = self.layers.iter().flat_map(of).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}

/// What is to be drawn, in picture coordinates.
#[derive(Debug, Clone, Default)]
pub struct Sketch {
    pub(super) faces: Vec<(Vec<DVec2>, [u8; 3])>,
    pub(super) lines: [Vec<[DVec3; 2]>; Class::ALL.len()],
    pub(super) strokes: Vec<Strokes>,
    pub(super) dots: Vec<Dots>,
    /// What matters most first.
    pub(super) notes: Vec<Note>,
    /// Where the axes point, if they are drawn.
    pub(super) axes: Option<[DVec3; 3]>,
    /// What of the notes is not among them.
    pub(super) missing: Vec<Missing>,
    /// Whether some faces are ordered by distance only.
    pub(super) is_rough: bool,
}

/// Lines beside those of the mesh.
#[derive(Debug, Clone)]
pub(super) struct Strokes {
    pub name: &'static str,
    pub line: Line,
    pub pieces: Vec<[DVec2; 2]>,
    /// Places before tips, and tips, of arrows.
    pub heads: Vec<[DVec2; 2]>,
}

/// Points of one kind.
#[derive(Debug, Clone)]
pub(super) struct Dots {
    pub name: &'static str,
    /// In points.
    pub diameter: f64,
    pub color: [u8; 3],
    pub places: Vec<DVec2>,
}

/// Text at a place.
#[derive(Debug, Clone)]
pub(super) struct Note {
    pub name: &'static str,
    pub at: DVec2,
    /// On which side it stands, a unit vector; zero for in the middle.
    pub toward: DVec2,
    /// How far off, in points.
    pub clearance: f64,
    /// Half the angle around that side which is free of lines, and how much farther off it may stand to lie in there.
    pub gap: (f64, f64),
    pub text: String,
    /// Height of letters in points.
    pub size: f64,
    pub color: [u8; 3],
}

/// A part of a page.
#[derive(Debug, Clone)]
pub struct Tile {
    /// `None` if there is none: its place says so.
    pub sketch: Option<Sketch>,
    /// What stands below it.
    pub caption: String,
}

/// In so many steps lines fade with their depth.
pub const DEPTHS: usize = 8;

/// The room around a drawing in points, beyond its places.
type Extent = [DVec2; 2];

/// Between tiles, in points.
const GAP: f64 = 9.0;

/// Tiles stand side by side as long as they are no narrower than this, in points: an inch.
const LEAST: f64 = 72.0;

/// Puts sketches on a page, all in the same measure, as large as they get; `None` if there is nothing to see. In so many
/// columns; else in those that leave them largest, or, on a page of any height, in as few rows as can be.
#[must_use]
pub fn sheet(tiles: Vec<Tile>, columns: Option<usize>, settings: &Settings) -> Option<Drawing> {
    let sketches = || tiles.iter().filter_map(|tile| tile.sketch.as_ref());
    let margin = sketches().map(|sketch| sketch.margin(settings)).fold(0.0, f64::max);
    let nowhere = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    let (low, high) =
        sketches().flat_map(|sketch| sketch.points(settings)).fold(nowhere, |(low, high), p| (low.min(p), high.max(p)));
    let has_dots = || sketches().any(|sketch| sketch.dots.iter().any(|dots| !dots.places.is_empty()));
    if !low.is_finite() || low == high && !has_dots() {
        return None; // a line that is a point is not seen
    }
    let captioned = tiles.iter().any(|tile| !tile.caption.is_empty());
    let caption = settings.letters * 8.0 / 7.0;
    let below = if captioned { 2.1 * caption } else { 0.0 };
    let room = |columns: usize| {
        let rows = tiles.len().div_ceil(columns);
        let part = |mm: f64, parts: usize, less: f64| {
            const POINTS_PER_MM: f64 = 72.0 / 25.4;
            // In whole hundredths, so that nothing is rounded up beyond it.
            let points = (mm * POINTS_PER_MM * 100.0).floor() / 100.0;
            ((points - GAP * (parts - 1) as f64) / parts as f64 - less).max(1.0)
        };
        let width = part(settings.page.width, columns, 0.0);
        DVec2::new(width, settings.page.height.map_or(f64::INFINITY, |height| part(height, rows, below)))
    };
    let frame = Frame { low, high, margin };
    let blocks: Vec<Vec<Block>> = sketches().map(|sketch| sketch.notes.iter().map(Block::new).collect()).collect();
    let scale_in = |columns: usize, shown: &[Block]| frame.scale(room(columns), settings.page, shown);
    let columns = columns.map_or_else(
        || best_columns(tiles.len(), settings.page, |n| (room(n), scale_in(n, &[]))),
        |n| n.clamp(1, tiles.len()),
    );

    // Labels that hide each other depend on the measure, and it on the labels.
    let shown = |scale: f64| -> Vec<Vec<Block>> {
        blocks.iter().map(|blocks| text::apart(blocks.iter().cloned(), |p| p * scale)).collect()
    };
    let scale = scale_in(columns, &shown(scale_in(columns, &[])).concat());
    let kept = shown(scale);
    let crowded_out = blocks.iter().flatten().count() - kept.iter().flatten().count();
    let [left_below, right_above] = frame.extent(scale, &kept.concat());
    let cell = right_above - left_below;

    let missing = Missing::in_all(sketches().map(|sketch| sketch.missing.clone()));
    let mut drawing = Builder::new(settings, Inks::PAPER);
    let mut kept = kept.into_iter();
    let step = cell + DVec2::new(GAP, GAP + below);
    for (index, tile) in tiles.into_iter().enumerate() {
        let corner = DVec2::new((index % columns) as f64, (index / columns) as f64) * step;
        if captioned {
            let at = corner + DVec2::new(cell.x / 2.0, cell.y + 1.3 * caption);
            drawing.caption(&tile.caption, at, caption, cell.x + GAP / 2.0);
        }
        match tile.sketch {
            Some(sketch) => {
                let at = |p: DVec2| corner + DVec2::new(p.x * scale - left_below.x, right_above.y - p.y * scale);
                drawing.add(sketch, kept.next().unwrap_or_default(), at, corner + DVec2::new(0.0, cell.y));
            }
            None => drawing.caption("failed", corner + cell / 2.0, caption, cell.x),
        }
    }
    let rows = drawing.tiles.div_ceil(columns).max(1);
    let across = columns.min(drawing.tiles.max(1)) as f64;
    let size = DVec2::new(across * step.x - GAP, rows as f64 * step.y - GAP);
    Some(Drawing { crowded_out, missing, ..drawing.finish(size) })
}

/// Notes and axes for a picture of this size in points.
pub(super) fn overlay(sketch: Sketch, size: DVec2, inks: Inks) -> Drawing {
    let settings = Settings { letters: ON_SCREEN, ..Settings::default() };
    let at = |p: DVec2| DVec2::new(p.x, -p.y) * (size.y / 2.0) + size / 2.0;
    let inside = |block: &Block| {
        let [low, high] = block.bounds(size.y / 2.0);
        low.x > -size.x / 2.0 && high.x < size.x / 2.0 && low.y > -size.y / 2.0 && high.y < size.y / 2.0
    };
    let kept = text::apart(sketch.notes.iter().map(Block::new).filter(inside), |p| p * (size.y / 2.0));
    let mut drawing = Builder::new(&settings, inks);
    drawing.add(sketch, kept, at, DVec2::new(14.0, size.y - 14.0));
    drawing.finish(size)
}

/// In how many columns so many tiles stand; `room` is what one has, and its measure.
fn best_columns(count: usize, page: Page, room: impl Fn(usize) -> (DVec2, f64)) -> usize {
    if page.height.is_none() {
        return (1..=count).rev().find(|&columns| room(columns).0.x >= LEAST).unwrap_or(1);
    }
    // The first of equals has the fewest columns; an empty place costs as much as a tenth of the measure.
    let worth = |columns: &usize| {
        let empty = columns * count.div_ceil(*columns) - count;
        room(*columns).1 * 10.0 / (10.0 + empty as f64 / count as f64 * 10.0)
    };
    (1..=count).rev().max_by(|a, b| worth(a).total_cmp(&worth(b))).unwrap_or(1)
}

/// What a page has to hold.
struct Frame {
    low: DVec2,
    high: DVec2,
    /// In points.
    margin: f64,
}

impl Frame {
    /// The lower left and the upper right corner in points, y up.
    fn extent(&self, scale: f64, blocks: &[Block]) -> Extent {
        let own = [self.low * scale - self.margin, self.high * scale + self.margin];
        blocks.iter().fold(own, |[low, high], block| {
            let [l, h] = block.bounds(scale);
            [low.min(l), high.max(h)]
        })
    }

    /// Points for each unit of the picture, so that everything fits.
    fn scale(&self, room: DVec2, page: Page, blocks: &[Block]) -> f64 {
        let size = self.high - self.low;
        let bare = room - 2.0 * self.margin;
        let bare = bare.max(DVec2::ONE);
        let (across, down) = (bare.x / size.x, bare.y / size.y);
        // What is no wider than a line, or no wider and no higher.
        let tall = if page.height.is_some() { down.min(bare.x / size.y) } else { bare.x / size.y };
        let scale = if size.x > 1e-9 { across.min(down) } else { tall };
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let fits = |scale: f64| {
            let [low, high] = self.extent(scale, blocks);
            (high - low).cmple(room + 1e-9).all()
        };
        if blocks.is_empty() || fits(scale) {
            return scale;
        }
        // The width is convex in the measure: what fits lies below what does not. Something has to be left of the mesh.
        let (mut low, mut high) = (scale * 0.1, scale);
        for _ in 0..40 {
            let middle = (low + high) / 2.0;
            *if fits(middle) { &mut low } else { &mut high } = middle;
        }
        low
    }
}

impl Sketch {
    /// The same around the origin.
    pub(super) fn centered(mut self) -> Self {
        let nowhere = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let settings = Settings::default();
        let (low, high) = self.points(&settings).fold(nowhere, |(low, high), p| (low.min(p), high.max(p)));
        let middle = (low + high) / 2.0;
        if middle.is_finite() {
            let faces = self.faces.iter_mut().flat_map(|(corners, _)| corners);
            let strokes = self.strokes.iter_mut().flat_map(|s| s.pieces.iter_mut().chain(&mut s.heads)).flatten();
            let dots = self.dots.iter_mut().flat_map(|dots| &mut dots.places);
            let notes = self.notes.iter_mut().map(|note| &mut note.at);
            faces.chain(strokes).chain(dots).chain(notes).for_each(|p| *p -= middle);
            self.lines.iter_mut().flatten().flatten().for_each(|p| *p -= middle.extend(0.0));
        }
        self
    }

    /// The room that the widest line takes beyond its places, in points.
    fn margin(&self, settings: &Settings) -> f64 {
        let lines = Class::ALL.into_iter().filter_map(|class| self.line(class, settings)).map(|line| line.width);
        let strokes = self.strokes.iter().map(|strokes| strokes.line.width);
        let dots = self.dots.iter().filter(|dots| !dots.places.is_empty()).map(|dots| dots.diameter);
        lines.chain(strokes).chain(dots).fold(0.0, f64::max) / 2.0
    }

    /// How lines of a class look, if there are any.
    pub(super) fn line(&self, class: Class, settings: &Settings) -> Option<Line> {
        settings.lines[class as usize].filter(|_| !self.lines[class as usize].is_empty())
    }

    /// Lines of a class by their depth, cut where one step ends and the next begins.
    pub(super) fn by_depth(&self, class: Class, fade: f64) -> Vec<Vec<[DVec3; 2]>> {
        let pieces = &self.lines[class as usize];
        let ends = self.lines.iter().flatten().flatten();
        let nowhere = (f64::INFINITY, f64::NEG_INFINITY);
        let (far, near) = ends.fold(nowhere, |(far, near), p| (far.min(p.z), near.max(p.z)));
        if fade <= 0.0 || near - far < 1e-9 {
            return vec![pieces.clone()];
        }
        let depth = |p: DVec3| (near - p.z) / (near - far) * DEPTHS as f64;
        let mut all = vec![Vec::new(); DEPTHS];
        for &[a, b] in pieces {
            let (from, to) = (depth(a), depth(b));
            let mut cuts: Vec<f64> = (1..DEPTHS).map(|step| (step as f64 - from) / (to - from)).collect();
            cuts.retain(|t| *t > 0.0 && *t < 1.0);
            cuts.extend([0.0, 1.0]);
            cuts.sort_by(f64::total_cmp);
            for w in cuts.windows(2) {
                let middle = depth(a.lerp(b, (w[0] + w[1]) / 2.0));
                all[(middle as usize).min(DEPTHS - 1)].push([a.lerp(b, w[0]), a.lerp(b, w[1])]);
            }
        }
        all
    }

    fn points<'a>(&'a self, settings: &'a Settings) -> impl Iterator<Item = DVec2> + 'a {
        let drawn = Class::ALL.into_iter().filter(|&class| self.line(class, settings).is_some());
        let ends = drawn.flat_map(|class| &self.lines[class as usize]).flatten().map(|p| p.xy());
        let corners = self.faces.iter().flat_map(|(corners, _)| corners).copied();
        let strokes = self.strokes.iter().flat_map(|strokes| &strokes.pieces).flatten().copied();
        let dots = self.dots.iter().flat_map(|dots| &dots.places).copied();
        ends.chain(corners).chain(strokes).chain(dots)
    }
}
