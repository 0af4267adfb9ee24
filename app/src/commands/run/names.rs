//! Names of outputs with places for what differs between them: `out_{n:4}.obj`.

use std::path::{Path, PathBuf};

/// The place of the generation.
pub const GENERATION: &str = "n";
/// The place of the input's name.
pub const INPUT: &str = "name";

/// The place of the number of a picture of those that go around a mesh.
pub const FRAME: &str = "frame";

/// Widest place: names of files end somewhere.
const WIDEST: usize = 64;

/// The name of a file, or of many.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Name {
    pieces: Vec<Piece>,
    /// As it was given.
    path: PathBuf,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Piece {
    Text(String),
    /// What stands there, and in how many characters at least.
    Place(String, usize),
}

impl Name {
    /// Reads a name: `{what}` is a place, `{what:4}` one that numbers fill with zeros to four characters, `{{` and `}}`
    /// are braces. A path that is no Unicode has no places.
    ///
    /// # Errors
    /// What is wrong with it, as one sentence.
    pub fn parse(path: &Path) -> Result<Self, String> {
        let Some(mut rest) = path.to_str() else { return Ok(Self::literal(path)) };
        let (mut pieces, mut text) = (Vec::new(), String::new());
        while let Some(at) = rest.find(['{', '}']) {
            text.push_str(&rest[..at]);
            let brace = &rest[at..=at];
            rest = &rest[at + 1..];
            if let Some(after) = rest.strip_prefix(brace) {
                text.push_str(brace);
                rest = after;
                continue;
            }
            let end = rest.find('}').filter(|_| brace == "{");
            let Some(end) = end else {
                return Err(format!("a `{brace}` has no partner in `{}`; `{brace}{brace}` is a brace", path.display()));
            };
            pieces.push(Piece::Text(std::mem::take(&mut text)));
            pieces.push(place(&rest[..end])?);
            rest = &rest[end + 1..];
        }
        text.push_str(rest);
        pieces.push(Piece::Text(text));
        Ok(Self { pieces, path: path.to_owned() })
    }

    /// A name without places, whatever stands in it.
    pub fn literal(path: &Path) -> Self {
        Self { pieces: Vec::new(), path: path.to_owned() }
    }

    /// As it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// What stands in its places.
    pub fn places(&self) -> impl Iterator<Item = &str> {
        self.pieces.iter().filter_map(|piece| match piece {
            Piece::Text(_) => None,
            Piece::Place(what, _) => Some(what.as_str()),
        })
    }

    /// Whether it has a place for this.
    pub fn has(&self, what: &str) -> bool {
        self.places().any(|place| place == what)
    }

    /// With these values in its places; those without a value stay empty.
    pub fn fill(&self, value: impl Fn(&str) -> Option<String>) -> PathBuf {
        if self.pieces.is_empty() {
            return self.path.clone();
        }
        let piece = |piece: &Piece| match piece {
            Piece::Text(text) => text.clone(),
            Piece::Place(what, width) => padded(&value(what).unwrap_or_default(), *width),
        };
        self.pieces.iter().map(piece).collect::<String>().into()
    }
}

fn place(inner: &str) -> Result<Piece, String> {
    let (what, width) = inner.split_once(':').unwrap_or((inner, "0"));
    let width = width.parse().ok().filter(|width| *width <= WIDEST);
    match width {
        Some(width) if !what.is_empty() => Ok(Piece::Place(what.to_owned(), width)),
        _ => Err(format!("`{{{inner}}}` is no place for a value; places look like `{{n}}` and `{{n:4}}`")),
    }
}

/// A number with zeros in front, behind its sign; of what is no number, the text. No separator of folders remains.
fn padded(text: &str, width: usize) -> String {
    let text = text.replace(['/', '\\'], "_");
    if text.parse::<f64>().is_err() {
        return text;
    }
    let (sign, digits) = text.strip_prefix('-').map_or(("", text.as_str()), |digits| ("-", digits));
    format!("{sign}{digits:0>width$}", width = width.saturating_sub(sign.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn check(name: &str, expected: &str) {
        let value = |what: &str| match what {
            "n" => Some("7".to_owned()),
            "w" => Some("-0.5".to_owned()),
            "name" => Some("a/b".to_owned()),
            _ => None,
        };
        assert_eq!(Name::parse(Path::new(name)).unwrap().fill(value), Path::new(expected));
    }

    #[test]
    fn places_are_filled() {
        check("out.obj", "out.obj");
        check("out_{n}.obj", "out_7.obj");
        check("{n:4}{n}", "00077");
        check("{w:6}", "-000.5");
        check("{name:9}.obj", "a_b.obj");
        check("{{n}}", "{n}");
    }

    #[test]
    fn what_is_no_place_is_refused() {
        for wrong in ["{", "a}b", "{}", "{n:x}", "{:4}", "{n:-1}", "{n:999}", "{n}}"] {
            assert!(Name::parse(Path::new(wrong)).is_err(), "{wrong}");
        }
    }
}
