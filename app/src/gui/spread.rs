//! Where labels go so that they hide neither each other nor marks nor arrows. No window: rectangles in, rectangles out.
//!
//! Each label has eight places around its point, the one that is asked for first. The place that costs least is taken:
//!
//! ```text
//!   on another label  >  outside of the picture  >  on a mark  >  over a line  >  far from the place asked for
//! ```

use eframe::egui::{Color32, Pos2, Rect, Vec2, vec2};

/// Lines that labels keep off; there are more only where nothing could be read anyway.
const LINES: usize = 400;
/// Labels that say the same so near are one.
const SAME: f32 = 4.0;

/// A label that is asked for.
pub struct Wanted {
    /// The point it belongs to.
    pub at: Pos2,
    /// From there to its middle.
    pub aside: Vec2,
    /// What it says.
    pub text: String,
    /// In which colour.
    pub color: Color32,
    /// Whether faces are before the point.
    pub hidden: bool,
    /// Whether it belongs just there.
    pub is_fixed: bool,
}

/// What is in the picture so far.
#[derive(Default)]
pub struct Spread {
    /// What is to be written.
    pub wanted: Vec<Wanted>,
    /// And at the lower edge.
    pub caption: Option<(String, Color32)>,
    marks: Vec<Rect>,
    lines: Vec<[Pos2; 2]>,
    /// What is written: where, at which point, and what.
    written: Vec<(Rect, Pos2, String)>,
}

impl Spread {
    /// A mark of this radius.
    pub fn mark(&mut self, at: Pos2, radius: f32) {
        self.marks.push(Rect::from_center_size(at, Vec2::splat(2.0 * radius)));
    }

    /// A line through points; a curve of many is simplified.
    pub fn line(&mut self, points: &[Pos2]) {
        const PIECES: usize = 3;
        let step = (points.len().saturating_sub(1)).div_ceil(PIECES).max(1);
        let mut from = 0;
        while from + 1 < points.len() && self.lines.len() < LINES {
            let to = (from + step).min(points.len() - 1);
            self.lines.push([points[from], points[to]]);
            from = to;
        }
    }

    /// Where no label may stand.
    pub fn keep_free(&mut self, rect: Rect) {
        self.written.push((rect, rect.center(), String::new()));
    }

    /// The place for a label of a size in a picture; `None` if it is written there already.
    pub fn place(
        &mut self,
        picture: Rect,
        at: Pos2,
        aside: Vec2,
        size: Vec2,
        text: String,
        is_fixed: bool,
    ) -> Option<Rect> {
        if self.written.iter().any(|(_, point, other)| *other == text && point.distance(at) < SAME) {
            return None;
        }
        let asked = Rect::from_center_size(at + aside, size);
        let others = (0..8).map(|i| {
            let angle = aside.angle() + std::f32::consts::TAU / 8.0 * i as f32;
            // At the edge of the label and a little off.
            let (x, y) = (angle.cos(), angle.sin());
            Rect::from_center_size(at + vec2(x * (size.x / 2.0 + 8.0), y * (size.y / 2.0 + 8.0)), size)
        });
        let mut best = (self.cost(picture, asked), asked);
        if !is_fixed && best.0 > 0.0 {
            for (i, rect) in others.enumerate() {
                // Turned by 0, 45°, … 180° … 315°.
                let turned = 0.1 * (4.0 - (4.0 - i as f32).abs()) + 0.05;
                let cost = self.cost(picture, rect) + turned;
                if cost < best.0 {
                    best = (cost, rect);
                }
            }
        }
        self.written.push((best.1, at, text));
        Some(best.1)
    }

    /// Whether a label here would hide another or say the same as one.
    pub fn is_taken(&self, at: Pos2, rect: Rect, text: &str) -> bool {
        self.written
            .iter()
            .any(|(other, point, said)| other.intersects(rect) || *said == text && point.distance(at) < SAME)
    }

    fn cost(&self, picture: Rect, rect: Rect) -> f32 {
        let count = |n: usize, weight: f32| n as f32 * weight;
        let labels = self.written.iter().filter(|(other, ..)| other.intersects(rect)).count();
        let marks = self.marks.iter().filter(|mark| mark.intersects(rect)).count();
        let lines = self.lines.iter().filter(|line| crosses(rect, **line)).count();
        let outside = if picture.contains_rect(rect) { 0.0 } else { 8.0 };
        count(labels, 10.0) + outside + count(marks, 3.0) + count(lines, 1.0)
    }
}

/// Whether a line passes through a rectangle (Liang and Barsky, "A new concept and method for line clipping", 1984).
fn crosses(rect: Rect, [a, b]: [Pos2; 2]) -> bool {
    let d = b - a;
    let (mut enter, mut leave) = (0.0_f32, 1.0_f32);
    for (along, from, low, high) in [(d.x, a.x, rect.left(), rect.right()), (d.y, a.y, rect.top(), rect.bottom())] {
        if along == 0.0 {
            if from < low || from > high {
                return false;
            }
            continue;
        }
        let (s, t) = ((low - from) / along, (high - from) / along);
        enter = enter.max(s.min(t));
        leave = leave.min(s.max(t));
    }
    enter <= leave
}

#[cfg(test)]
mod tests {
    use super::*;
    use eframe::egui::pos2;

    const PICTURE: Rect = Rect { min: pos2(0.0, 0.0), max: pos2(400.0, 300.0) };
    const SIZE: Vec2 = vec2(30.0, 14.0);
    const ABOVE: Vec2 = vec2(0.0, -17.0);

    fn place(spread: &mut Spread, at: Pos2, text: &str) -> Option<Rect> {
        spread.place(PICTURE, at, ABOVE, SIZE, text.to_owned(), false)
    }

    #[test]
    fn a_label_stands_where_it_is_asked_for_if_nothing_is_there() {
        let at = pos2(200.0, 150.0);
        assert_eq!(place(&mut Spread::default(), at, "v1"), Some(Rect::from_center_size(at + ABOVE, SIZE)));
    }

    #[test]
    fn labels_keep_off_each_other_arrows_marks_and_the_edge() {
        let at = pos2(200.0, 150.0);
        let mut spread = Spread::default();
        spread.line(&[pos2(200.0, 148.0), pos2(200.0, 20.0)]);
        spread.mark(pos2(226.0, 150.0), 5.0);
        let first = place(&mut spread, at, "v1").unwrap();
        assert!(!crosses(first, [pos2(200.0, 148.0), pos2(200.0, 20.0)]), "{first}");
        assert!(!first.contains(pos2(226.0, 150.0)));
        let second = place(&mut spread, at + vec2(4.5, 0.0), "v2").unwrap();
        assert!(!second.intersects(first), "{second} {first}");
        let high = place(&mut spread, pos2(100.0, 4.0), "v3").unwrap();
        assert!(PICTURE.contains_rect(high), "{high}");
    }

    #[test]
    fn what_is_written_already_is_not_written_again() {
        let mut spread = Spread::default();
        let at = pos2(200.0, 150.0);
        assert!(place(&mut spread, at, "v1").is_some());
        assert!(place(&mut spread, at + vec2(1.0, 0.0), "v1").is_none());
        assert!(place(&mut spread, pos2(50.0, 50.0), "v1").is_some(), "elsewhere it is another one");
        assert!(spread.is_taken(at, Rect::from_center_size(at, SIZE), "v1"));
        assert!(!spread.is_taken(pos2(300.0, 200.0), Rect::from_center_size(pos2(300.0, 200.0), SIZE), "v9"));
    }

    #[test]
    fn lines_cross_rectangles_also_with_both_ends_outside() {
        let rect = Rect::from_min_max(pos2(10.0, 10.0), pos2(20.0, 20.0));
        let check = |a: (f32, f32), b: (f32, f32)| crosses(rect, [pos2(a.0, a.1), pos2(b.0, b.1)]);
        assert!(
            check((0.0, 15.0), (30.0, 15.0)) && check((0.0, 0.0), (30.0, 30.0)) && check((15.0, 15.0), (16.0, 15.0))
        );
        assert!(!check((0.0, 5.0), (30.0, 5.0)) && !check((0.0, 15.0), (5.0, 15.0)) && !check((0.0, 25.0), (5.0, 0.0)));
    }
}
