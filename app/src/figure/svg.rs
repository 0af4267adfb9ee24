//! SVG 1.1.

use std::fmt::Write as _;

use super::letters::{Glyph, Step, outline};
use super::page::{At, Drawing, Layer};
use super::{Dash, hundredths, millimetres};

/// The drawing as a text: a group for each class of lines, named after it. Lengths are in points; the size is in
/// millimetres.
pub(super) fn write(drawing: &Drawing) -> String {
    let At { x, y } = drawing.size;
    let letters = drawing.letters();
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\"{} width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\">\n",
        if letters.is_empty() { "" } else { " xmlns:xlink=\"http://www.w3.org/1999/xlink\"" },
        millimetres(x),
        millimetres(y),
        hundredths(x),
        hundredths(y)
    );
    // What is written into a string is written.
    let _ = write_letters(&mut text, &letters);
    for (i, layer) in drawing.layers.iter().enumerate() {
        // Lines of one kind may have several widths; every name stands once.
        let same = |other: &&Layer| match (layer, *other) {
            (Layer::Lines { name, depth, .. }, Layer::Lines { name: n, depth: d, .. }) => (name, depth) == (n, d),
            _ => false,
        };
        let before = drawing.layers[..i].iter().filter(same).count();
        let _ = write_layer(&mut text, layer, before, &letters);
    }
    text.push_str("</svg>\n");
    text
}

/// The shapes of letters, each once.
fn write_letters(text: &mut String, letters: &[(Glyph, i32)]) -> std::fmt::Result {
    if letters.is_empty() {
        return Ok(());
    }
    writeln!(text, "<defs>")?;
    for (number, &(glyph, size)) in letters.iter().enumerate() {
        let mut shape = String::new();
        for step in outline(glyph, size) {
            match step {
                Step::Move(p) => write!(shape, "M{}", pair(p))?,
                Step::Line(p) => write!(shape, "L{}", pair(p))?,
                Step::Quad(c, p) => write!(shape, "Q{} {}", pair(c), pair(p))?,
                Step::Close => shape.push('z'),
            }
        }
        writeln!(text, "<path id=\"l{number}\" d=\"{shape}\"/>")?;
    }
    writeln!(text, "</defs>")
}

fn pair(p: At) -> String {
    format!("{} {}", hundredths(p.x), hundredths(p.y))
}

fn write_layer(text: &mut String, layer: &Layer, before: usize, letters: &[(Glyph, i32)]) -> std::fmt::Result {
    match layer {
        Layer::Faces(areas) => {
            // The hairline of the same colour covers the seams that smoothed edges leave.
            writeln!(text, "<g id=\"faces\" stroke-width=\".3\" stroke-linejoin=\"round\">")?;
            for (corners, color) in areas {
                let color = hex(*color);
                writeln!(text, "<path fill=\"{color}\" stroke=\"{color}\" d=\"{}z\"/>", path(corners))?;
            }
        }
        Layer::Lines { name, depth, line, paths } => {
            let mut name = if *depth == 0 { (*name).to_owned() } else { format!("{name}-{depth}") };
            if before > 0 {
                name = format!("{name}.{}", before + 1);
            }
            let (color, width) = (hex(line.color), hundredths((line.width * 100.0).round() as i32));
            write!(text, "<g id=\"{name}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"")?;
            match line.dash {
                Dash::Solid => write!(text, " stroke-linecap=\"round\"")?,
                dash => write!(text, " stroke-dasharray=\"{}\"", dash.lengths(line.width).map(hundredths).join(" "))?,
            }
            writeln!(text, " stroke-linejoin=\"round\">")?;
            for line in paths {
                writeln!(text, "<path d=\"{}{}\"/>", path(&line.points), if line.closed { "z" } else { "" })?;
            }
        }
        Layer::Dots { name, diameter, color, places } => {
            writeln!(text, "<g id=\"{name}\" fill=\"{}\">", hex(*color))?;
            let radius = hundredths(diameter / 2);
            for At { x, y } in places {
                writeln!(text, "<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\"/>", hundredths(*x), hundredths(*y))?;
            }
        }
        Layer::Text { name, size, color, halo: (paper, width), words } => {
            let shape = |glyph: &Glyph| letters.binary_search(&(*glyph, *size)).unwrap_or_default();
            let uses = |glyphs: &[(Glyph, At)]| -> String {
                let one = |(glyph, at): &(Glyph, At)| {
                    format!(
                        "<use xlink:href=\"#l{}\" x=\"{}\" y=\"{}\"/>",
                        shape(glyph),
                        hundredths(at.x),
                        hundredths(at.y)
                    )
                };
                glyphs.iter().map(one).collect()
            };
            let (paper, width) = (hex(*paper), hundredths(*width));
            writeln!(text, "<g stroke=\"{paper}\" stroke-width=\"{width}\" stroke-linejoin=\"round\">")?;
            for line in words {
                writeln!(text, "{}", uses(&line.glyphs))?;
            }
            writeln!(text, "</g>\n<g id=\"{name}\" fill=\"{}\">", hex(*color))?;
            for line in words {
                writeln!(text, "<g aria-label=\"{}\">{}</g>", escaped(&line.text), uses(&line.glyphs))?;
            }
        }
    }
    writeln!(text, "</g>")
}

/// From point to point, each counted from the one before: the shortest.
fn path(points: &[At]) -> String {
    let mut text = String::new();
    let mut before = At { x: 0, y: 0 };
    for (i, &p) in points.iter().enumerate() {
        let (x, y) = (hundredths(p.x - before.x), hundredths(p.y - before.y));
        text.push_str(match i {
            0 => "M",
            1 => "l",
            _ if x.starts_with('-') => "",
            _ => " ",
        });
        text.push_str(&x);
        if !y.starts_with('-') {
            text.push(' ');
        }
        text.push_str(&y);
        before = p;
    }
    text
}

/// As the value of an attribute.
fn escaped(text: &str) -> String {
    let of = |c: char| match c {
        '&' => "&amp;".to_owned(),
        '<' => "&lt;".to_owned(),
        '"' => "&quot;".to_owned(),
        c if c.is_control() => " ".to_owned(),
        c => c.to_string(),
    };
    text.chars().map(of).collect()
}

fn hex([r, g, b]: [u8; 3]) -> String {
    let short = [r, g, b].iter().all(|c| c >> 4 == c & 15);
    if short { format!("#{:x}{:x}{:x}", r & 15, g & 15, b & 15) } else { format!("#{r:02x}{g:02x}{b:02x}") }
}
