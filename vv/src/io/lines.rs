//! Lines and words of a text file that may be anything: any line ends, comments, bytes that are no UTF-8.

use super::Place;

/// Begins a comment in the formats that have comments.
pub(super) const COMMENT: Option<u8> = Some(b'#');

/// The lines of a text with their numbers, from 1, without line ends and comments. LF, CR LF and CR end lines.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u32,
    comment: Option<u8>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8], comment: Option<u8>) -> Self {
        let rest = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text); // a byte order mark
        Self { rest, number: 0, comment }
    }

    /// What follows the lines that were read.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }
}

impl<'a> Iterator for Lines<'a> {
    type Item = (u32, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let end = self.rest.iter().position(|b| matches!(b, b'\n' | b'\r')).unwrap_or(self.rest.len());
        let line = &self.rest[..end];
        let end_len = if self.rest[end..].starts_with(b"\r\n") { 2 } else { 1 };
        self.rest = self.rest.get(end + end_len..).unwrap_or(&[]);
        self.number = self.number.saturating_add(1);
        let end = self.comment.and_then(|comment| line.iter().position(|&b| b == comment)).unwrap_or(line.len());
        Some((self.number, &line[..end]))
    }
}

/// The words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(|b| b.is_ascii_whitespace() || *b == 0x0B).filter(|word| !word.is_empty())
}

/// Column of a word in its line, from 1, in characters; `None` if it is no part of the line.
pub(super) fn column(line: &[u8], word: &[u8]) -> Option<u32> {
    let before = (word.as_ptr() as usize).checked_sub(line.as_ptr() as usize)?;
    let before = line.get(..before)?;
    // Bytes that continue a character of UTF-8 are none of their own.
    let characters = before.iter().filter(|&&b| b & 0xC0 != 0x80).count();
    u32::try_from(characters).ok()?.checked_add(1)
}

/// The words of a text, and where the last stood.
#[derive(Clone)]
pub(super) struct Words<'a> {
    lines: Lines<'a>,
    whole: &'a [u8],
    rest: &'a [u8],
    word: &'a [u8],
    /// Number of the line, from 1.
    pub(super) line: u32,
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a [u8], comment: Option<u8>) -> Self {
        Self::after(Lines::new(text, comment))
    }

    /// The words of the lines that are left.
    pub(super) fn after(lines: Lines<'a>) -> Self {
        let line = lines.number.max(1);
        Self { lines, whole: &[], rest: &[], word: &[], line }
    }

    /// The next word on this line.
    pub(super) fn next_on_line(&mut self) -> Option<&'a [u8]> {
        let rest: &'a [u8] = self.rest;
        let word = words(rest).next()?;
        let end = word.as_ptr() as usize - rest.as_ptr() as usize + word.len();
        self.rest = &rest[end..];
        self.word = word;
        Some(word)
    }

    /// The next word, on this line or a later one.
    pub(super) fn next(&mut self) -> Option<&'a [u8]> {
        loop {
            if let Some(word) = self.next_on_line() {
                return Some(word);
            }
            (self.line, self.rest) = self.lines.next()?;
            self.whole = self.rest;
        }
    }

    /// Passes over the rest of the line: how many words that was.
    pub(super) fn finish_line(&mut self) -> usize {
        words(std::mem::take(&mut self.rest)).count()
    }

    /// How many lines with words follow this one.
    pub(super) fn lines_left(&self) -> u64 {
        self.lines.clone().filter(|(_, line)| words(line).next().is_some()).count() as u64
    }

    /// How many words stand on the next line that has some.
    pub(super) fn words_on_next_line(&self) -> usize {
        self.lines.clone().map(|(_, line)| words(line).count()).find(|&n| n > 0).unwrap_or(0)
    }

    /// Where the last word stands.
    pub(super) fn place(&self) -> Place {
        Place::Text { line: self.line, column: column(self.whole, self.word).filter(|_| !self.word.is_empty()) }
    }

    /// The line that was read last.
    pub(super) fn line(&self) -> Place {
        Place::line(self.line)
    }
}

/// A word for a message: cut, and with everything that is no printable ASCII escaped.
pub(super) fn show(word: &[u8]) -> String {
    const SHOWN: usize = 24;
    let cut = &word[..word.len().min(SHOWN)];
    format!("`{}{}`", cut.escape_ascii(), if word.len() > SHOWN { "…" } else { "" })
}

/// A finite number; what is wrong with it otherwise.
pub(super) fn number(word: &[u8]) -> Result<f64, String> {
    match any_number(word)? {
        x if x.is_finite() => Ok(x),
        _ if word.iter().any(u8::is_ascii_digit) => Err(format!("{} is too large for a double", show(word))),
        _ => Err(format!("{} is not finite", show(word))),
    }
}

/// A number, also one that is not finite; what is wrong with it otherwise.
pub(super) fn any_number(word: &[u8]) -> Result<f64, String> {
    let text = std::str::from_utf8(word).ok();
    text.and_then(|text| text.parse::<f64>().ok()).ok_or_else(|| {
        let with_comma = text.is_some_and(|text| text.replacen(',', ".", 1).parse::<f64>().is_ok());
        let why = if with_comma { ": a point stands before decimals, not a comma" } else { "" };
        format!("{} is not a number{why}", show(word))
    })
}

/// An integer of any size that fits; `None` if it is none.
pub(super) fn integer<T: std::str::FromStr>(word: &[u8]) -> Option<T> {
    std::str::from_utf8(word).ok().and_then(|text| text.parse().ok())
}
