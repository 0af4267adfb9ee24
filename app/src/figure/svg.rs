//! SVG 1.1.

use std::fmt::Write as _;

use super::page::{At, Drawing, Layer};
use super::{Dash, hundredths, millimetres};

/// The drawing as a text: a group for each class of lines, named after it. Lengths are in points; the size is in
/// millimetres.
pub(super) fn write(drawing: &Drawing) -> String {
    let At { x, y } = drawing.size;
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}mm\" height=\"{}mm\" viewBox=\"0 0 {} {}\">\n",
        millimetres(x),
        millimetres(y),
        hundredths(x),
        hundredths(y)
    );
    for layer in &drawing.layers {
        // What is written into a string is written.
        let _ = write_layer(&mut text, layer);
    }
    text.push_str("</svg>\n");
    text
}

fn write_layer(text: &mut String, layer: &Layer) -> std::fmt::Result {
    match layer {
        Layer::Faces(areas) => {
            // The hairline of the same colour covers the seams that smoothed edges leave.
            writeln!(text, "<g id=\"faces\" stroke-width=\".3\" stroke-linejoin=\"round\">")?;
            for (corners, color) in areas {
                let color = hex(*color);
                writeln!(text, "<path fill=\"{color}\" stroke=\"{color}\" d=\"{}z\"/>", path(corners))?;
            }
        }
        Layer::Lines { class, line, paths } => {
            let (color, width) = (hex(line.color), hundredths((line.width * 100.0).round() as i32));
            write!(text, "<g id=\"{}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\"", class.name())?;
            match line.dash {
                Dash::Solid => write!(text, " stroke-linecap=\"round\"")?,
                dash => write!(text, " stroke-dasharray=\"{}\"", dash.lengths(line.width).map(hundredths).join(" "))?,
            }
            writeln!(text, " stroke-linejoin=\"round\">")?;
            for line in paths {
                writeln!(text, "<path d=\"{}{}\"/>", path(&line.points), if line.closed { "z" } else { "" })?;
            }
        }
        Layer::Dots { diameter, color, places } => {
            writeln!(text, "<g id=\"vertices\" fill=\"{}\">", hex(*color))?;
            let radius = hundredths(diameter / 2);
            for At { x, y } in places {
                writeln!(text, "<circle cx=\"{}\" cy=\"{}\" r=\"{radius}\"/>", hundredths(*x), hundredths(*y))?;
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

fn hex([r, g, b]: [u8; 3]) -> String {
    let short = [r, g, b].iter().all(|c| c >> 4 == c & 15);
    if short { format!("#{:x}{:x}{:x}", r & 15, g & 15, b & 15) } else { format!("#{r:02x}{g:02x}{b:02x}") }
}
