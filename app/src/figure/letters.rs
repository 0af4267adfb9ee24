//! Letters as outlines, those of the window: the same in every format, and no file needs a font.

use std::sync::{Arc, OnceLock};

use eframe::egui::{FontData, FontDefinitions, FontFamily};
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider};

use super::page::At;

/// A letter's shape in one of the fonts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Glyph {
    font: usize,
    id: u32,
}

/// A part of an outline, in hundredths of a point from where the letter stands on its line, y down.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Step {
    /// Begins a contour.
    Move(At),
    /// A straight line.
    Line(At),
    /// A parabola: its control point and its end.
    Quad(At, At),
    /// Back to where the contour began.
    Close,
}

/// A line of text as its letters.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Row {
    /// Each with its distance from the begin, in points.
    pub glyphs: Vec<(Glyph, f64)>,
    /// In points.
    pub width: f64,
}

/// Height of capitals and digits over the size of letters.
pub(super) const CAPITAL: f64 = 0.69;

/// Stands for letters that no font has.
const UNKNOWN: char = '?';

/// Sets a line of text in letters of so many points.
pub(super) fn set(text: &str, size: f64) -> Row {
    let fonts: Vec<Face> = fonts().iter().filter_map(|font| Face::new(font)).collect();
    let find = |letter: char| {
        (0..).zip(&fonts).find_map(|(font, face)| Some((font, face.font.charmap().map(letter)?, face.units)))
    };
    let mut row = Row { glyphs: Vec::new(), width: 0.0 };
    for letter in text.chars() {
        let Some((font, id, units)) = find(letter).or_else(|| find(UNKNOWN)) else { continue };
        row.glyphs.push((Glyph { font, id: id.to_u32() }, row.width));
        let metrics = fonts[font].font.glyph_metrics(Size::unscaled(), LocationRef::default());
        row.width += f64::from(metrics.advance_width(id).unwrap_or_default()) / units * size;
    }
    row
}

/// What a letter looks like in so many hundredths of a point.
pub(super) fn outline(glyph: Glyph, size: i32) -> Vec<Step> {
    let Some(face) = fonts().get(glyph.font).and_then(|font| Face::new(font)) else { return Vec::new() };
    let mut pen = Pen { scale: f64::from(size) / face.units, steps: Vec::new() };
    if let Some(outline) = face.font.outline_glyphs().get(GlyphId::new(glyph.id)) {
        // What is drawn into memory is drawn; a damaged outline would end early.
        let _ = outline.draw(DrawSettings::unhinted(Size::unscaled(), LocationRef::default()), &mut pen);
    }
    pen.steps
}

/// The control points of the cubic that is the same curve as a parabola.
pub(super) fn cubic(from: At, control: At, to: At) -> [At; 2] {
    let part = |end: i32, control: i32| (f64::from(end + 2 * control) / 3.0).round() as i32;
    [from, to].map(|end| At { x: part(end.x, control.x), y: part(end.y, control.y) })
}

/// The fonts, the first that has a letter counts.
fn fonts() -> &'static [Arc<FontData>] {
    static FONTS: OnceLock<Vec<Arc<FontData>>> = OnceLock::new();
    FONTS.get_or_init(|| {
        let all = FontDefinitions::default();
        let names = all.families.get(&FontFamily::Proportional).into_iter().flatten();
        names.filter_map(|name| all.font_data.get(name).cloned()).collect()
    })
}

struct Face<'a> {
    font: FontRef<'a>,
    /// Of the em.
    units: f64,
}

impl<'a> Face<'a> {
    fn new(data: &'a FontData) -> Option<Self> {
        let font = FontRef::from_index(data.bytes(), data.index).ok()?;
        let units = f64::from(font.metrics(Size::unscaled(), LocationRef::default()).units_per_em);
        (units > 0.0).then_some(Self { font, units })
    }
}

struct Pen {
    scale: f64,
    steps: Vec<Step>,
}

impl Pen {
    fn at(&self, x: f32, y: f32) -> At {
        let hundredths = |x: f32| (f64::from(x) * self.scale).round() as i32;
        At { x: hundredths(x), y: hundredths(-y) }
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.steps.push(Step::Move(self.at(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.steps.push(Step::Line(self.at(x, y)));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.steps.push(Step::Quad(self.at(cx, cy), self.at(x, y)));
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        // The parabola with the nearest middle; the fonts that ship have no cubics.
        let middle = |a: f32, b: f32, end: f32| 0.75 * (a + b) - 0.25 * 2.0 * end;
        let (cx, cy) = (middle(ax, bx, x), middle(ay, by, y));
        self.steps.push(Step::Quad(self.at(cx, cy), self.at(x, y)));
    }

    fn close(&mut self) {
        self.steps.push(Step::Close);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_have_outlines_as_high_as_capitals() {
        let row = set("1H", 10.0);
        assert!(row.width > 8.0 && row.width < 14.0 && row.glyphs[1].1 > 4.0, "{row:?}");
        for (glyph, _) in row.glyphs {
            let steps = outline(glyph, 1000);
            let top =
                steps.iter().filter_map(|s| if let Step::Line(at) | Step::Move(at) = s { Some(at.y) } else { None });
            assert_eq!(top.min(), Some((-1000.0 * CAPITAL) as i32 - 3), "{steps:?}");
            assert_eq!(steps.last(), Some(&Step::Close));
        }
    }

    #[test]
    fn a_letter_that_no_font_has_is_a_question_mark() {
        assert_eq!(set("\u{10ffff}", 7.0), set("?", 7.0));
        assert_eq!(set("", 7.0).width, 0.0);
    }
}
