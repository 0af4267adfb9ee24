//! Lines of a text file that may be anything: any line ends, comments, bytes that are no UTF-8.

/// The lines of a text with their numbers, from 1, without line ends and comments (from `#`). LF, CR LF and CR end
/// lines.
#[derive(Clone)]
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u32,
}

impl<'a> Lines<'a> {
    pub(super) fn new(text: &'a [u8]) -> Self {
        let rest = text.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(text); // a byte order mark
        Self { rest, number: 0 }
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
        let comment = line.iter().position(|&b| b == b'#').unwrap_or(line.len());
        Some((self.number, &line[..comment]))
    }
}

/// The words of a line.
pub(super) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> + Clone {
    line.split(|b| b.is_ascii_whitespace() || *b == 0x0B).filter(|word| !word.is_empty())
}

/// A word for a message: cut, and with everything that is no printable ASCII escaped.
pub(super) fn show(word: &[u8]) -> String {
    const SHOWN: usize = 24;
    let cut = &word[..word.len().min(SHOWN)];
    format!("`{}{}`", cut.escape_ascii(), if word.len() > SHOWN { "…" } else { "" })
}

/// A finite number; what is wrong with it otherwise.
pub(super) fn number(word: &[u8]) -> Result<f64, String> {
    let text = std::str::from_utf8(word).ok();
    match text.and_then(|text| text.parse::<f64>().ok()) {
        Some(x) if x.is_finite() => Ok(x),
        Some(_) if word.iter().any(u8::is_ascii_digit) => Err(format!("{} is too large for a double", show(word))),
        Some(_) => Err(format!("{} is not finite", show(word))),
        None => Err(format!("{} is not a number", show(word))),
    }
}
