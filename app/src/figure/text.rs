//! Where text stands, and which of it can be read.

use std::collections::BTreeMap;

use glam::DVec2;

use super::letters::{self, CAPITAL};
use super::page::Note;

/// A line of text with the room it takes.
#[derive(Debug, Clone)]
pub(super) struct Block {
    pub name: &'static str,
    /// The place that it belongs to, in picture coordinates.
    pub at: DVec2,
    /// From there to its middle, in points, y up.
    pub offset: DVec2,
    /// Half its width and height, in points.
    pub half: DVec2,
    pub text: String,
    pub size: f64,
    pub color: [u8; 3],
}

impl Block {
    pub fn new(note: &Note) -> Self {
        let half = DVec2::new(letters::set(&note.text, note.size).width, CAPITAL * note.size) / 2.0;
        // So far off that it just clears a square around the place.
        let reach = ((half + note.clearance) / note.toward.abs()).min_element();
        let free = apart_from_lines(half + note.size * 0.1, note.toward, note.gap.0);
        let reach = if free <= reach + note.gap.1 { reach.max(free) } else { reach };
        let offset = if note.toward == DVec2::ZERO { DVec2::ZERO } else { reach * note.toward };
        let Note { name, at, size, color, .. } = *note;
        Self { name, at, offset, half, text: note.text.clone(), size, color }
    }

    /// Its lower left and upper right corner in points, y up, with so many of them for each unit of the picture.
    pub fn bounds(&self, scale: f64) -> [DVec2; 2] {
        let center = self.at * scale + self.offset;
        [center - self.half, center + self.half]
    }
}

/// How far off a block lies in an angle of twice `gap` around a direction.
fn apart_from_lines(half: DVec2, toward: DVec2, gap: f64) -> f64 {
    if gap >= std::f64::consts::FRAC_PI_2 || gap <= 0.0 {
        return 0.0;
    }
    let corners = [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|signs| half * DVec2::from(signs));
    let far = |corner: DVec2| toward.perp_dot(corner).abs() / gap.tan() - toward.dot(corner);
    corners.into_iter().map(far).fold(0.0, f64::max)
}

/// Of blocks the first that do not overlap; `place` is in points.
pub(super) fn apart(blocks: impl Iterator<Item = Block>, place: impl Fn(DVec2) -> DVec2) -> Vec<Block> {
    /// Around each, over the height of letters.
    const AIR: f64 = 0.12;
    /// Side of the squares in which others are looked for, in points.
    const SQUARE: f64 = 24.0;
    let mut taken: BTreeMap<(i64, i64), Vec<[DVec2; 2]>> = BTreeMap::new();
    let mut kept = Vec::new();
    for block in blocks {
        let (center, half) = (place(block.at) + block.offset, block.half + AIR * block.size);
        let (low, high) = (center - half, center + half);
        let [first, last] = [low, high].map(|p| ((p.x / SQUARE).floor() as i64, (p.y / SQUARE).floor() as i64));
        let squares = || (first.0..=last.0).flat_map(|x| (first.1..=last.1).map(move |y| (x, y)));
        let overlaps = |other: &[DVec2; 2]| low.cmplt(other[1]).all() && other[0].cmplt(high).all();
        if squares().any(|square| taken.get(&square).is_some_and(|others| others.iter().any(overlaps))) {
            continue;
        }
        for square in squares() {
            taken.entry(square).or_default().push([low, high]);
        }
        kept.push(block);
    }
    kept
}

/// The begin of a text that is no wider than so many points, with an ellipsis if something is missing.
pub(super) fn shortened(text: &str, size: f64, width: f64) -> String {
    let fits = |text: &str| letters::set(text, size).width <= width;
    if fits(text) {
        return text.to_owned();
    }
    let ends: Vec<usize> = text.char_indices().map(|(at, _)| at).collect();
    let begin = |end: usize| format!("{}…", &text[..end]);
    let count = ends.partition_point(|&end| fits(&begin(end)));
    count.checked_sub(1).map_or(String::new(), |last| begin(ends[last]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(at: (f64, f64), text: &str) -> Block {
        let (toward, clearance, gap) = (DVec2::X, 1.0, (0.0, 0.0));
        let (at, text) = (at.into(), text.to_owned());
        Block::new(&Note { name: "labels", at, toward, clearance, gap, text, size: 7.0, color: [0; 3] })
    }

    #[test]
    fn of_texts_that_overlap_the_first_stays() {
        let blocks = [block((0.0, 0.0), "v1"), block((0.3, 0.1), "v2"), block((2.0, 0.0), "v3")];
        let kept: Vec<String> = apart(blocks.into_iter(), |p| p * 10.0).into_iter().map(|block| block.text).collect();
        assert_eq!(kept, ["v1", "v3"]);
    }

    #[test]
    fn text_stands_beside_its_place() {
        let [low, high] = block((2.0, 3.0), "v1").bounds(10.0);
        assert!((low.x - 21.0).abs() < 1e-9 && ((low.y + high.y) / 2.0 - 30.0).abs() < 1e-9, "{low} {high}");
        let toward = DVec2::new(0.6, -0.8);
        let gap = (0.0, 0.0);
        let (text, size, color) = ("12345".to_owned(), 7.0, [0; 3]);
        let note = Note { name: "labels", at: DVec2::ZERO, toward, clearance: 2.0, gap, text, size, color };
        let [low, high] = Block::new(&note).bounds(1.0);
        assert!((high.y + 2.0).abs() < 1e-9 && low.x < 0.0 && high.x > 0.0, "{low} {high}");
        // Farther off where that keeps it clear of lines: here, of those at 45 degrees from its direction.
        let note = Note { gap: (std::f64::consts::FRAC_PI_4, 30.0), ..note };
        let [low, high] = Block::new(&note).bounds(1.0);
        let angles =
            [low, DVec2::new(low.x, high.y), DVec2::new(high.x, low.y), high].map(|p| p.angle_to(toward).abs());
        assert!(angles.iter().all(|angle| *angle < std::f64::consts::FRAC_PI_4), "{low} {high} {angles:?}");
    }

    #[test]
    fn text_that_is_too_wide_ends_early() {
        assert_eq!(shortened("generation 1", 8.0, 100.0), "generation 1");
        let short = shortened("generation 1", 8.0, 30.0);
        assert!(short.starts_with("gen") && short.ends_with('…'), "{short}");
        assert_eq!(shortened("generation", 8.0, 0.0), "");
        // Whatever it says is set some twenty times.
        assert!(shortened(&"ä".repeat(200_000), 8.0, 100.0).chars().count() < 40);
    }
}
