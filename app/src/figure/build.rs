//! Sketches in their places, as layers: each kind one, in the order in which they are drawn.

use std::cmp::Reverse;

use glam::{DVec2, DVec3, Vec3Swizzles};

use super::chain::chain;
use super::letters;
use super::notes::Inks;
use super::page::{At, DEPTHS, Dots, Drawing, Layer, Sketch, Strokes, Words};
use super::text::{self, Block};
use super::{Class, Dash, Line, Settings};

/// Lines of a kind and a depth, and how they look.
type Strands = ((&'static str, usize), Line, Vec<[At; 2]>);

/// Layers in the order in which they are drawn, each kind one.
pub(super) struct Builder<'a> {
    settings: &'a Settings,
    inks: Inks,
    faces: Vec<(Vec<At>, [u8; 3])>,
    lines: Vec<Strands>,
    dots: Vec<Layer>,
    texts: Vec<Layer>,
    is_exact: bool,
    /// How many sketches were added.
    pub tiles: usize,
}

impl<'a> Builder<'a> {
    pub fn new(settings: &'a Settings, inks: Inks) -> Self {
        let (faces, lines, dots, texts) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Self { settings, inks, faces, lines, dots, texts, is_exact: true, tiles: 0 }
    }

    /// Adds a sketch with those of its notes that are shown; `at` says where its places are in points, y down, and
    /// `corner` is its lower left corner there.
    pub fn add(&mut self, sketch: Sketch, notes: Vec<Block>, at: impl Fn(DVec2) -> DVec2, corner: DVec2) {
        self.tiles += 1;
        self.is_exact &= !sketch.is_rough;
        let place = |p: &DVec2| rounded(at(*p));
        let faces = sketch.faces.iter().map(|(corners, color)| (corners.iter().map(place).collect(), *color));
        self.faces.extend(faces);
        for class in Class::ALL {
            if let Some(line) = sketch.line(class, self.settings) {
                let line = Line { width: light(class, line, &sketch.lines[class as usize], &at), ..line };
                for (depth, pieces) in sketch.by_depth(class, self.settings.fade).into_iter().enumerate() {
                    let line = Line { color: faded(line.color, self.settings.fade, depth), ..line };
                    let pieces = pieces.iter().map(|ends| ends.map(|p| place(&p.xy()))).collect();
                    self.stroke((class.name(), depth), line, pieces);
                }
            }
        }
        for Strokes { name, line, pieces, heads } in &sketch.strokes {
            self.stroke((name, 0), *line, pieces.iter().map(|ends| ends.each_ref().map(place)).collect());
            for [before, tip] in heads.iter().map(|ends| ends.map(&at)) {
                let back = (before - tip).normalize_or_zero() * line.width * 4.5;
                let sides = [0.45, -0.45].map(|angle| tip + DVec2::from_angle(angle).rotate(back));
                self.stroke(
                    (name, 0),
                    *line,
                    vec![[rounded(sides[0]), rounded(tip)], [rounded(tip), rounded(sides[1])]],
                );
            }
        }
        for Dots { name, diameter, color, places } in &sketch.dots {
            self.dot(name, *diameter, *color, places.iter().map(place).collect());
        }
        for block in notes {
            let center = at(block.at) + DVec2::new(block.offset.x, -block.offset.y);
            self.write(block.name, &block.text, center, block.size, block.color);
        }
        if let Some(axes) = sketch.axes {
            self.axes(axes, corner);
        }
    }

    fn stroke(&mut self, name: (&'static str, usize), line: Line, pieces: Vec<[At; 2]>) {
        if pieces.is_empty() {
            return;
        }
        match self.lines.iter_mut().find(|(other, look, _)| *other == name && *look == line) {
            Some((.., all)) => all.extend(pieces),
            None => self.lines.push((name, line, pieces)),
        }
    }

    fn dot(&mut self, name: &'static str, diameter: f64, color: [u8; 3], mut places: Vec<At>) {
        let (of, size) = (name, hundredths(diameter));
        let same = |layer: &&mut Layer| matches!(layer, Layer::Dots { name, diameter, .. } if *name == of && *diameter == size);
        match self.dots.iter_mut().find(same) {
            Some(Layer::Dots { places: all, .. }) => all.append(&mut places),
            _ => self.dots.push(Layer::Dots { name, diameter: size, color, places }),
        }
    }

    /// A line of text around a point.
    fn write(&mut self, name: &'static str, text: &str, center: DVec2, size: f64, color: [u8; 3]) {
        let row = letters::set(text, size);
        let start = center + DVec2::new(-row.width / 2.0, letters::CAPITAL * size / 2.0);
        let glyphs = row.glyphs.iter().map(|&(glyph, x)| (glyph, rounded(start + DVec2::new(x, 0.0)))).collect();
        let words = Words { text: text.to_owned(), glyphs };
        let (of, ink, height) = (name, color, hundredths(size));
        let same = |layer: &&mut Layer| matches!(layer, Layer::Text { name, color, size, .. } if (*name, *color, *size) == (of, ink, height));
        match self.texts.iter_mut().find(same) {
            Some(Layer::Text { words: all, .. }) => all.push(words),
            _ => {
                let halo = (self.inks.paper, hundredths(0.28 * size));
                self.texts.push(Layer::Text { name, size: height, color, halo, words: vec![words] });
            }
        }
    }

    /// A line of text that is no wider than so many points.
    pub fn caption(&mut self, text: &str, center: DVec2, size: f64, width: f64) {
        self.write("captions", &text::shortened(text, size, width), center, size, self.inks.text);
    }

    /// The directions of the axes, in a corner.
    fn axes(&mut self, directions: [DVec3; 3], corner: DVec2) {
        const NAMES: [[&str; 2]; 3] = [["x-axis", "x"], ["y-axis", "y"], ["z-axis", "z"]];
        let size = self.settings.letters;
        let length = 2.4 * size;
        let center = corner + DVec2::new(1.5, -1.5) * length;
        for ((direction, color), [name, letter]) in directions.into_iter().zip(self.inks.axes).zip(NAMES) {
            let along = DVec2::new(direction.x, -direction.y);
            let tip = center + along * length;
            let line = Line { width: 0.12 * size, color, dash: Dash::Solid };
            self.stroke((name, 0), line, vec![[rounded(center), rounded(tip)]]);
            let aside = if along.length() > 0.15 { along.normalize() } else { DVec2::new(0.7, -0.7) };
            self.write(name, letter, tip + aside * 0.7 * size, size, color);
        }
    }

    pub fn finish(mut self, size: DVec2) -> Drawing {
        let rank = |name: &str| Class::ALL.iter().position(|class| class.name() == name).unwrap_or(Class::ALL.len());
        self.lines.sort_by_key(|((name, depth), ..)| (rank(name), Reverse(*depth)));
        let mut layers = Vec::new();
        if !self.faces.is_empty() {
            layers.push(Layer::Faces(self.faces));
        }
        let lines = self.lines.into_iter().map(|((name, depth), line, pieces)| {
            let paths = chain(pieces);
            Layer::Lines { name, depth, line, paths }
        });
        layers.extend(lines);
        layers.extend(self.dots);
        layers.extend(self.texts);
        Drawing { size: rounded(size), layers, is_exact: self.is_exact, crowded_out: 0, missing: Vec::new() }
    }
}

/// The width of the lines of a class, thinner than by default where they would black out what they lie on: inner lines
/// and the control mesh by how short they are, outlines by how much of the picture they cover. In steps, so that figures side by
/// side share theirs.
fn light(class: Class, line: Line, pieces: &[[DVec3; 2]], at: impl Fn(DVec2) -> DVec2) -> f64 {
    const STEP: f64 = 0.05;
    // Who has chosen a width means it.
    if line.width != Settings::line(class).width || pieces.is_empty() {
        return line.width;
    }
    let ends = || pieces.iter().map(|[a, b]| [at(a.xy()), at(b.xy())]);
    let mut lengths: Vec<f64> = ends().map(|[a, b]| a.distance(b)).collect();
    let most = match class {
        Class::Inner | Class::Hidden | Class::Control => {
            let middle = lengths.len() / 2;
            0.07 * *lengths.select_nth_unstable_by(middle, f64::total_cmp).1
        }
        Class::Outline | Class::Boundary | Class::Crease | Class::Intersection => {
            let nowhere = (DVec2::INFINITY, DVec2::NEG_INFINITY);
            let (low, high) = ends().flatten().fold(nowhere, |(low, high), p| (low.min(p), high.max(p)));
            0.12 * (high - low).element_product() / lengths.iter().sum::<f64>()
        }
    };
    // What lies in a line covers nothing.
    if most > 0.0 { ((most / STEP).ceil() * STEP).clamp(STEP, line.width) } else { line.width }
}

/// A colour as it is at a depth: nearer to white.
fn faded(color: [u8; 3], fade: f64, depth: usize) -> [u8; 3] {
    let part = fade * depth as f64 / (DEPTHS - 1) as f64;
    color.map(|c| (f64::from(c) + (255.0 - f64::from(c)) * part).round() as u8)
}

fn rounded(points: DVec2) -> At {
    At { x: hundredths(points.x), y: hundredths(points.y) }
}

fn hundredths(points: f64) -> i32 {
    (points * 100.0).round() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_lines_are_thinner_unless_somebody_chose_their_width() {
        let pieces = |length: f64| vec![[DVec3::ZERO, DVec3::X * length]; 9];
        let width = |class, line: Line, length| light(class, line, &pieces(length), |at| at);
        for class in [Class::Inner, Class::Control] {
            let line = Settings::line(class);
            assert_eq!(width(class, line, 30.0), line.width, "{}", class.name());
            assert!((width(class, line, 2.0) - 0.15).abs() < 1e-9, "{}", class.name());
            assert_eq!(width(class, Line { width: 0.6, ..line }, 2.0), 0.6, "{}", class.name());
        }
    }
}
