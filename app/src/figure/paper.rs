//! What figures are like, as options of the command line and style files say it: `85x60mm`, `inner=0.3,#888`.

use super::{Class, Dash, Line, Page, Settings};
use crate::alike::closest;

/// Millimetres that a figure may be wide or high: some metres.
const MOST: f64 = 5000.0;

/// Reads a width, perhaps with a height.
///
/// # Errors
/// What such a text looks like.
pub fn page(text: &str) -> Result<Page, String> {
    let wrong = || "a page is a width in millimetres such as 85mm, or width and height such as 85x60mm".to_owned();
    let number = |text: &str| text.trim().trim_end_matches("mm").trim_end().parse().ok();
    let length = |text: &str| number(text).filter(|x| (1.0..=MOST).contains(x));
    let (width, height) = match text.split_once(['x', 'X', '×']) {
        Some((width, height)) => (width, Some(length(height).ok_or_else(wrong)?)),
        None => (text, None),
    };
    Ok(Page { width: length(width).ok_or_else(wrong)?, height })
}

/// Reads how much lighter lines far away are.
///
/// # Errors
/// What such a text looks like.
pub fn fade(text: &str) -> Result<f64, String> {
    let amount = text.parse().ok().filter(|x| (0.0..=1.0).contains(x));
    amount.ok_or_else(|| "lines fade by a number from 0 to 1".to_owned())
}

/// Reads a height of letters in points.
///
/// # Errors
/// What such a text looks like.
pub fn letters(text: &str) -> Result<f64, String> {
    let points = text.strip_suffix("pt").unwrap_or(text).parse().ok().filter(|x| (1.0..=200.0).contains(x));
    points.ok_or_else(|| "the height of letters is in points, from 1 to 200".to_owned())
}

/// Reads a class of lines and how they look; `None` leaves them out.
///
/// # Errors
/// What such a text looks like.
pub fn line(text: &str) -> Result<(Class, Option<Line>), String> {
    let (name, look) = text.split_once('=').unwrap_or((text, ""));
    let names = Class::ALL.map(Class::name);
    let Some(class) = Class::ALL.into_iter().find(|class| class.name() == name) else {
        let nearest = closest(name, names).map_or(String::new(), |name| format!("; did you mean `{name}`?"));
        return Err(format!("lines are {}{nearest}", names.join(", ")));
    };
    if look == "none" {
        return Ok((class, None));
    }
    let mut line = Settings::line(class);
    for word in look.split(',').map(str::trim).filter(|word| !word.is_empty()) {
        match word {
            "solid" => line.dash = Dash::Solid,
            "dashed" => line.dash = Dash::Dashed,
            "dotted" => line.dash = Dash::Dotted,
            _ if word.starts_with('#') => {
                line.color = color(word).ok_or_else(|| format!("`{word}` is no colour such as #888 or #1c293b"))?;
            }
            _ => {
                let width = word.strip_suffix("pt").unwrap_or(word).parse().ok().filter(|w| (0.01..=100.0).contains(w));
                line.width = width.ok_or_else(|| {
                    format!("`{word}` is no width in points such as 0.5, no colour such as #888, and none of solid, dashed, dotted and none")
                })?;
            }
        }
    }
    Ok((class, Some(line)))
}

/// Reads the colour behind pictures.
///
/// # Errors
/// What such a text looks like.
pub fn background(text: &str) -> Result<[u8; 3], String> {
    match text {
        "white" => Ok([255; 3]),
        "black" => Ok([0; 3]),
        "transparent" => Err("nothing at all is behind pictures with `--style transparent`".to_owned()),
        _ => color(text).ok_or_else(|| format!("`{text}` is no colour such as white, black, #888 or #1c293b")),
    }
}

/// `#rgb` or `#rrggbb`.
fn color(text: &str) -> Option<[u8; 3]> {
    let digits = text.strip_prefix('#')?;
    let digits: Option<Vec<u8>> = digits.chars().map(|c| Some(c.to_digit(16)? as u8)).collect();
    match digits?[..] {
        [r, g, b] => Some([r, g, b].map(|c| c * 17)),
        [r, s, g, h, b, c] => Some([r * 16 + s, g * 16 + h, b * 16 + c]),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_is_a_width_perhaps_with_a_height() {
        assert_eq!(page("85mm"), Ok(Page { width: 85.0, height: None }));
        assert_eq!(page("85"), page("85mm"));
        assert_eq!(page("85x60.5mm"), Ok(Page { width: 85.0, height: Some(60.5) }));
        assert_eq!(page("85mm x 60mm"), page("85x60"));
        for wrong in ["", "mm", "0mm", "-5mm", "85cm", "1x2x3", "nan", "85x", "1e9mm"] {
            assert!(page(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_background_is_a_colour() {
        assert_eq!((background("white"), background("#1c2")), (Ok([255; 3]), Ok([0x11, 0xcc, 0x22])));
        for wrong in ["", "grey?", "#12", "888"] {
            assert!(background(wrong).is_err(), "{wrong}");
        }
        assert!(background("transparent").unwrap_err().contains("--style transparent"));
    }

    #[test]
    fn a_line_is_a_class_with_width_colour_and_dash() {
        let outline = Settings::line(Class::Outline);
        assert_eq!(line("outline"), Ok((Class::Outline, Some(outline))));
        assert_eq!(line("outline=none"), Ok((Class::Outline, None)));
        let all = Line { width: 0.25, color: [0xff, 0, 0x88], dash: Dash::Dotted };
        assert_eq!(line("outline=0.25pt,#f08,dotted"), Ok((Class::Outline, Some(all))));
        assert_eq!(line("outline=dotted, #ff0088, 0.25"), Ok((Class::Outline, Some(all))));
        for wrong in ["", "line", "inner=0", "inner=wide", "inner=#12", "inner=#12345g", "inner=-1", "inner=none,1"] {
            assert!(line(wrong).is_err(), "{wrong}");
        }
        assert!(line("bondary").unwrap_err().ends_with("did you mean `boundary`?"));
    }
}
