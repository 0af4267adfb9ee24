//! Encapsulated PostScript, level 2.

use std::fmt::Write as _;

use super::letters::{Glyph, Step, cubic, outline};
use super::page::{At, Drawing, Layer};
use super::{Dash, hundredths, thousandths};

/// Short names for what comes often; paths go from point to point.
const PROLOGUE: &str = "\
%%BeginProlog
99 dict begin
/m{moveto}bind def
/l{rlineto}bind def
/s{stroke}bind def
/z{closepath stroke}bind def
/f{setrgbcolor closepath gsave fill grestore stroke}bind def
/d{moveto 0 0 rlineto stroke}bind def
/r{rmoveto}bind def
/c{rcurveto}bind def
/h{closepath}bind def
%%EndProlog
";

/// The drawing as a text.
pub(super) fn write(drawing: &Drawing) -> String {
    let At { x, y } = drawing.size;
    let whole = |x: i32| (f64::from(x) / 100.0).ceil();
    let mut text = format!(
        "%!PS-Adobe-3.0 EPSF-3.0\n%%BoundingBox: 0 0 {} {}\n%%HiResBoundingBox: 0 0 {} {}\n%%LanguageLevel: 2\n\
         %%EndComments\n{PROLOGUE}gsave\n0 {} translate 1 -1 scale\n1 setlinejoin\n",
        whole(x),
        whole(y),
        hundredths(x),
        hundredths(y),
        hundredths(y)
    );
    let letters = drawing.letters();
    // What is written into a string is written.
    let _ = write_letters(&mut text, &letters);
    for layer in &drawing.layers {
        let _ = write_layer(&mut text, layer, &letters);
    }
    text.push_str("grestore\nend\nshowpage\n%%EOF\n");
    text
}

/// The shapes of letters as procedures that add one to the path, from where the pen stands.
fn write_letters(text: &mut String, letters: &[(Glyph, i32)]) -> std::fmt::Result {
    for (number, &(glyph, size)) in letters.iter().enumerate() {
        write!(text, "/l{number}{{")?;
        let (mut pen, mut begin) = (At { x: 0, y: 0 }, At { x: 0, y: 0 });
        let from = |pen: At, p: At| format!("{} {}", hundredths(p.x - pen.x), hundredths(p.y - pen.y));
        for (i, step) in outline(glyph, size).into_iter().enumerate() {
            match step {
                Step::Move(p) => {
                    write!(text, "{} r", from(pen, p))?;
                    (pen, begin) = (p, p);
                }
                Step::Line(p) => {
                    write!(text, "{} l", from(pen, p))?;
                    pen = p;
                }
                Step::Quad(c, p) => {
                    let [a, b] = cubic(pen, c, p);
                    write!(text, "{} {} {} c", from(pen, a), from(pen, b), from(pen, p))?;
                    pen = p;
                }
                Step::Close => {
                    write!(text, "h")?;
                    pen = begin;
                }
            }
            // Lines of a file have at most 255 characters.
            text.push(if i % 6 == 5 { '\n' } else { ' ' });
        }
        writeln!(text, "}}bind def")?;
    }
    Ok(())
}

fn write_layer(text: &mut String, layer: &Layer, letters: &[(Glyph, i32)]) -> std::fmt::Result {
    match layer {
        Layer::Faces(areas) => {
            writeln!(text, "% faces\n.3 setlinewidth")?;
            for (corners, color) in areas {
                writeln!(text, "{}{} f", path(corners), thousandths(*color))?;
            }
        }
        Layer::Lines { name, line, paths, .. } => {
            let width = hundredths((line.width * 100.0).round() as i32);
            writeln!(text, "% {name}\n{width} setlinewidth {} setrgbcolor", thousandths(line.color))?;
            match line.dash {
                Dash::Solid => writeln!(text, "1 setlinecap [] 0 setdash")?,
                dash => {
                    let lengths = dash.lengths(line.width).map(hundredths).join(" ");
                    writeln!(text, "0 setlinecap [{lengths}] 0 setdash")?;
                }
            }
            for line in paths {
                writeln!(text, "{}{}", path(&line.points), if line.closed { "z" } else { "s" })?;
            }
        }
        Layer::Dots { name, diameter, color, places } => {
            let (width, color) = (hundredths(*diameter), thousandths(*color));
            writeln!(text, "% {name}\n{width} setlinewidth {color} setrgbcolor 1 setlinecap [] 0 setdash")?;
            for At { x, y } in places {
                writeln!(text, "{} {} d", hundredths(*x), hundredths(*y))?;
            }
        }
        Layer::Text { name, size, color, halo: (paper, width), words } => {
            let (width, paper, color) = (hundredths(*width), thousandths(*paper), thousandths(*color));
            writeln!(text, "% {name}\n{width} setlinewidth 1 setlinecap [] 0 setdash")?;
            for (color, draw) in [(paper, "stroke"), (color, "fill")] {
                writeln!(text, "{color} setrgbcolor")?;
                for line in words {
                    for (glyph, at) in &line.glyphs {
                        let number = letters.binary_search(&(*glyph, *size)).unwrap_or_default();
                        writeln!(text, "{} {} m l{number}", hundredths(at.x), hundredths(at.y))?;
                    }
                    writeln!(text, "{draw}")?;
                }
            }
        }
    }
    Ok(())
}

fn path(points: &[At]) -> String {
    let mut text = String::new();
    let mut before = At { x: 0, y: 0 };
    for (i, &p) in points.iter().enumerate() {
        let (x, y) = (hundredths(p.x - before.x), hundredths(p.y - before.y));
        // Lines of a file have at most 255 characters.
        let end = if i % 12 == 11 { '\n' } else { ' ' };
        let _ = write!(text, "{x} {y} {}{end}", if i == 0 { 'm' } else { 'l' });
        before = p;
    }
    text
}
