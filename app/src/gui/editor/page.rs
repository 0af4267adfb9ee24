//! The text as it stands on the screen: where things are, and what is drawn over and beside it.

use std::ops::Range;

use eframe::egui::text::{CCursor, LayoutJob, TextWrapping};
use eframe::egui::{
    Align2, Color32, FontId, Galley, Painter, Pos2, Rect, Shape, Stroke, StrokeKind, TextStyle, Ui, pos2,
};
use vv::assist::number_at;
use vv::diagnostic::Severity;

use super::super::{messages, theme};
use crate::session::{Place, Problem};

/// The text as it stands on the screen.
pub struct Page<'a> {
    /// Its lines.
    pub galley: &'a Galley,
    /// Where they begin.
    pub origin: Pos2,
    /// What they say.
    pub text: &'a str,
    /// What is seen of it.
    pub clip: Rect,
}

impl Page<'_> {
    /// Rows are lines: nothing wraps.
    pub fn row_rect(&self, row: usize) -> Option<Rect> {
        self.galley.rows.get(row).map(|r| r.rect().translate(self.origin.to_vec2()))
    }

    /// The row of a cursor.
    pub fn row_of(&self, cursor: CCursor) -> usize {
        self.galley.layout_from_cursor(cursor).row
    }

    /// What a stretch covers on its first line; at least a character wide.
    pub fn rect_of(&self, range: &Range<usize>) -> Rect {
        let start = floor_char_boundary(self.text, range.start);
        let end = floor_char_boundary(self.text, range.end).max(start);
        let line_end = self.text[start..].find('\n').map_or(self.text.len(), |i| start + i);
        let at = |byte| self.galley.pos_from_cursor(CCursor::new(char_of(self.text, byte)));
        let (from, to) = (at(start), at(end.min(line_end)));
        let right = to.right().max(from.left() + 7.0);
        Rect::from_min_max(from.min, pos2(right, from.max.y)).translate(self.origin.to_vec2())
    }

    /// Bytes of the lines that are seen.
    pub fn visible(&self) -> Range<usize> {
        let seen = |row: usize| {
            self.row_rect(row).is_some_and(|r| r.bottom() >= self.clip.top() && r.top() <= self.clip.bottom())
        };
        let rows = self.galley.rows.len();
        let first = (0..rows).find(|&row| seen(row)).unwrap_or(0);
        let last = (first..rows).take_while(|&row| seen(row)).last().unwrap_or(first);
        let mut ends = self.text.match_indices('\n').map(|(i, _)| i + 1);
        let start = if first == 0 { 0 } else { ends.nth(first - 1).unwrap_or(self.text.len()) };
        let end = ends.nth(last - first).unwrap_or(self.text.len());
        start..end
    }

    /// The letter under a point.
    pub fn byte_at(&self, pos: Pos2) -> Option<usize> {
        if !self.clip.contains(pos) {
            return None;
        }
        let row = (0..self.galley.rows.len()).find_map(|row| self.row_rect(row).filter(|r| r.contains(pos)))?;
        let cursor = self.galley.cursor_from_pos(pos2(pos.x, row.center().y) - self.origin);
        let byte = byte_of(self.text, cursor.index.0);
        // A cursor is between two letters; the one under the pointer may be the one before.
        let before = self.galley.pos_from_cursor(cursor).left() + self.origin.x > pos.x;
        let back = self.text[..byte].chars().next_back().map_or(0, char::len_utf8);
        Some(if before { byte - back } else { byte })
    }

    /// The number or the name under a point.
    pub fn word_at(&self, pos: Pos2) -> Option<Range<usize>> {
        word_at(self.text, self.byte_at(pos)?)
    }

    /// Frames round brackets that belong together; red round one that stands alone.
    pub fn brackets(&self, ui: &Ui, pair: &[Range<usize>; 2]) {
        let painter = ui.painter().with_clip_rect(self.clip);
        let alone = pair[0] == pair[1];
        let color = if alone { ui.visuals().error_fg_color } else { ui.visuals().hyperlink_color };
        for range in pair {
            let rect = self.rect_of(range).expand2(eframe::egui::vec2(0.5, 0.0));
            painter.rect(
                rect,
                2.0,
                color.gamma_multiply(0.16),
                Stroke::new(1.0, color.gamma_multiply(0.7)),
                StrokeKind::Inside,
            );
        }
    }

    /// Shapes behind places that were found; the one that is selected stands out.
    pub fn found(&self, ui: &Ui, places: &[Range<usize>], selected: &Range<usize>) -> Shape {
        let visible = self.visible();
        let color = ui.visuals().warn_fg_color.gamma_multiply(0.30);
        let first = places.partition_point(|p| p.end <= visible.start);
        let seen = places[first..].iter().take_while(|p| p.start < visible.end);
        let shape = |place: &Range<usize>| {
            let rect = self.rect_of(place);
            if place != selected {
                return Shape::rect_filled(rect, 2.0, color);
            }
            let edge = Stroke::new(1.2, ui.visuals().warn_fg_color);
            Shape::Vec(vec![
                Shape::rect_filled(rect, 2.0, color),
                Shape::rect_stroke(rect.expand(1.0), 2.0, edge, StrokeKind::Outside),
            ])
        };
        Shape::Vec(seen.map(shape).collect())
    }

    /// Marks a problem.
    pub fn underline(&self, ui: &Ui, problem: &Problem, place: &Place) {
        let rect = self.rect_of(&place.range);
        let color = theme::severity(ui.visuals(), problem.diagnostic.severity);
        wave(&ui.painter().with_clip_rect(self.clip), rect, color);
    }

    /// Where the cursor will be when the text has the keys again.
    pub fn resting_cursor(&self, ui: &Ui, byte: usize) {
        let rect = self.rect_of(&(byte..byte));
        let stroke = Stroke::new(1.0, ui.visuals().weak_text_color());
        ui.painter().with_clip_rect(self.clip).vline(rect.left(), rect.y_range(), stroke);
    }

    /// The worst message of each line, after its end, as far as there is room. Pointing at it shows all of it.
    pub fn line_messages(&self, ui: &Ui, problems: &[(&Problem, &Place)]) {
        let painter = ui.painter().with_clip_rect(self.clip);
        let font = TextStyle::Small.resolve(ui.style());
        for row in rows_with_problems(problems) {
            let Some((problem, _)) = worst(problems, row) else { continue };
            let Some(rect) = self.message_rect(row) else { continue };
            if problem.diagnostic.severity < Severity::Warning {
                continue;
            }
            let color = theme::severity(ui.visuals(), problem.diagnostic.severity).gamma_multiply(0.85);
            let said = messages::in_short(&problem.diagnostic.message);
            let mut job = LayoutJob::simple(said, font.clone(), color, rect.width());
            job.wrap = TextWrapping::truncate_at_width(rect.width());
            let galley = painter.layout_job(job);
            painter.galley(pos2(rect.left(), rect.center().y - galley.size().y / 2.0), galley, color);
        }
    }

    /// The room behind a line; `None` if there is none that is worth it.
    fn message_rect(&self, line: u32) -> Option<Rect> {
        const LEAST: f32 = 48.0;
        let row = self.row_rect((line as usize).checked_sub(1)?)?;
        let rect = Rect::from_min_max(pos2(row.right() + 22.0, row.top()), pos2(self.clip.right() - 8.0, row.bottom()));
        (rect.width() >= LEAST && self.clip.y_range().contains(rect.center().y)).then_some(rect)
    }

    /// The numbers of the lines, those with problems marked.
    pub fn gutter(&self, ui: &Ui, gutter: Rect, problems: &[(&Problem, &Place)], cursor_line: Option<usize>) {
        let painter = ui.painter().with_clip_rect(gutter.intersect(ui.clip_rect()));
        let font = FontId::monospace(TextStyle::Monospace.resolve(ui.style()).size - 1.5);
        for row in 0..self.galley.rows.len() {
            let Some(rect) = self.row_rect(row) else { break };
            if rect.bottom() < gutter.top() {
                continue;
            }
            if rect.top() > gutter.bottom() {
                break;
            }
            let problem = worst(problems, row as u32 + 1);
            let color = match problem {
                Some((problem, _)) => theme::severity(ui.visuals(), problem.diagnostic.severity),
                None if cursor_line == Some(row) => ui.visuals().text_color(),
                None => ui.visuals().weak_text_color(),
            };
            if problem.is_some() {
                painter.circle_filled(pos2(gutter.left() + 9.0, rect.center().y), 3.5, color);
            }
            // The smaller letters stand on the line of the larger ones.
            let at = pos2(gutter.right() - 8.0, rect.center().y + 0.5);
            painter.text(at, Align2::RIGHT_CENTER, (row + 1).to_string(), font.clone(), color);
        }
    }

    /// The problem under a point.
    pub fn problem_at<'p>(&self, pos: Pos2, gutter: Rect, problems: &[(&'p Problem, &Place)]) -> Option<&'p Problem> {
        if gutter.contains(pos) {
            let row = (0..self.galley.rows.len())
                .find(|&row| self.row_rect(row).is_some_and(|r| r.y_range().contains(pos.y)))?;
            return worst(problems, row as u32 + 1).map(|(problem, _)| problem);
        }
        let near = |place: &Place| self.clip.contains(pos) && self.rect_of(&place.range).expand(1.0).contains(pos);
        let under = problems.iter().find(|(_, place)| near(place));
        under.map(|(problem, _)| *problem).or_else(|| {
            let mut lines = rows_with_problems(problems).into_iter();
            let line = lines.find(|&line| self.message_rect(line).is_some_and(|rect| rect.contains(pos)))?;
            worst(problems, line).map(|(problem, _)| problem)
        })
    }
}

fn rows_with_problems(problems: &[(&Problem, &Place)]) -> std::collections::BTreeSet<u32> {
    problems.iter().map(|(_, place)| place.start.line).collect()
}

fn worst<'p, 'q>(problems: &[(&'p Problem, &'q Place)], line: u32) -> Option<(&'p Problem, &'q Place)> {
    let here = problems.iter().filter(|(_, place)| place.start.line == line);
    // The first of the worst.
    here.rev().max_by_key(|(problem, _)| problem.diagnostic.severity).copied()
}

fn wave(painter: &Painter, rect: Rect, color: Color32) {
    const STEP: f32 = 2.0;
    let y = rect.bottom() - 1.0;
    let count = (rect.width() / STEP).ceil() as usize;
    let points =
        (0..=count).map(|i| pos2(rect.left() + i as f32 * STEP, y + if i % 2 == 0 { 1.0 } else { -1.0 })).collect();
    painter.add(Shape::line(points, Stroke::new(1.2, color)));
}

/// The beginning of the character at a byte.
pub fn floor_char_boundary(text: &str, byte: usize) -> usize {
    let byte = byte.min(text.len());
    (0..=byte).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0)
}

/// How many characters come before a byte.
pub fn char_of(text: &str, byte: usize) -> usize {
    text[..floor_char_boundary(text, byte)].chars().count()
}

/// Where a character begins.
pub fn byte_of(text: &str, index: usize) -> usize {
    text.char_indices().nth(index).map_or(text.len(), |(byte, _)| byte)
}

/// The number, or the name, that a letter belongs to.
fn word_at(text: &str, byte: usize) -> Option<Range<usize>> {
    let number = number_at(text, byte).map(|number| number.range).filter(|range| range.contains(&byte));
    number.or_else(|| {
        let in_name = |c: char| c.is_alphanumeric() || c == '_';
        let (before, after) = (text.get(..byte)?, text.get(byte..)?);
        let start = before.trim_end_matches(in_name).len();
        let end = byte + after.len() - after.trim_start_matches(in_name).len();
        text[byte..].starts_with(in_name).then_some(start..end)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_a_number_or_a_name() {
        let text = "return 3.0/-8.5 * `p$pos;";
        let word = |byte| word_at(text, byte).map(|range| &text[range]);
        assert_eq!(word(2), Some("return"));
        assert_eq!(word(6), None);
        assert_eq!([word(7), word(8), word(9)], [Some("3.0"); 3]);
        assert_eq!(word(10), None);
        assert_eq!(word(13), Some("-8.5"));
        assert_eq!(word(19), Some("p"));
        assert_eq!(word(22), Some("pos"));
    }
}
