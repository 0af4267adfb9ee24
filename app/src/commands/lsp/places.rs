//! Places and files as editors name them.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr as _;

use lsp_types::{Position, Uri};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};

/// What stays as it is in the path of a URI.
const ESCAPED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'/').remove(b'-').remove(b'.').remove(b'_').remove(b'~');

/// What an editor counts along a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes.
    Utf8,
    /// Units of two bytes.
    Utf16,
}

impl Encoding {
    /// The place in bytes; what lies behind the end of a line or of the text counts as that end.
    pub fn offset(self, text: &str, place: Position) -> usize {
        let mut start = 0;
        for _ in 0..place.line {
            match text[start..].find('\n') {
                Some(end) => start += end + 1,
                None => return text.len(),
            }
        }
        let line = text[start..].split(['\n', '\r']).next().unwrap_or_default();
        let mut left = place.character as usize;
        for (at, c) in line.char_indices() {
            if left == 0 {
                return start + at;
            }
            left = left.saturating_sub(self.width(c));
        }
        start + line.len()
    }

    /// The place of a byte.
    pub fn position(self, text: &str, offset: usize) -> Position {
        let before = text.get(..offset).unwrap_or(text);
        let start = before.rfind('\n').map_or(0, |end| end + 1);
        Position {
            line: before.bytes().filter(|&b| b == b'\n').count() as u32,
            character: self.length(&before[start..]),
        }
    }

    /// The place of a stretch of bytes.
    pub fn range(self, text: &str, range: Range<usize>) -> lsp_types::Range {
        lsp_types::Range { start: self.position(text, range.start), end: self.position(text, range.end) }
    }

    /// How long a text is.
    pub fn length(self, text: &str) -> u32 {
        text.chars().map(|c| self.width(c)).sum::<usize>() as u32
    }

    fn width(self, c: char) -> usize {
        match self {
            Self::Utf8 => c.len_utf8(),
            Self::Utf16 => c.len_utf16(),
        }
    }
}

/// The file behind a URI. What is in no file has the last part of its URI as name.
pub fn path_of(uri: &Uri) -> PathBuf {
    let path = percent_decode_str(uri.path().as_str()).decode_utf8_lossy().into_owned();
    let in_file = uri.scheme().is_some_and(|scheme| scheme.as_str() == "file");
    if in_file { PathBuf::from(path) } else { PathBuf::from(path.rsplit('/').next().unwrap_or_default()) }
}

/// The URI of a file; `None` if it has no absolute path that can be written as text.
pub fn uri_of(path: &Path) -> Option<Uri> {
    let path = std::path::absolute(path).ok()?;
    Uri::from_str(&format!("file://{}", utf8_percent_encode(path.to_str()?, ESCAPED))).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn editors_count_as_they_like() {
        let text = "ab\r\nτ𝄞x\n";
        for (encoding, character) in [(Encoding::Utf8, 6), (Encoding::Utf16, 3)] {
            let place = Position { line: 1, character };
            assert_eq!(&text[encoding.offset(text, place)..], "x\n");
            assert_eq!(encoding.position(text, text.find('x').unwrap()), place);
            let beyond = |line, character| encoding.offset(text, Position { line, character });
            assert_eq!((beyond(0, 9), beyond(9, 0), beyond(2, 3)), (2, text.len(), text.len()));
        }
    }

    #[test]
    fn files_have_uris() {
        let path = Path::new("/some where/τ+x.vv");
        let uri = uri_of(path).unwrap();
        assert_eq!(uri.as_str(), "file:///some%20where/%CF%84%2Bx.vv");
        assert_eq!(path_of(&uri), path);
        assert_eq!(path_of(&Uri::from_str("untitled:Untitled-1").unwrap()), Path::new("Untitled-1"));
    }
}
