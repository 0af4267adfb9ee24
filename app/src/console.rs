//! What programs print, bounded: an endless `print` costs no more memory than a page of it.

use std::collections::{BTreeMap, VecDeque};

/// Lines that are kept.
pub const MAX_LINES: usize = 10_000;
/// Bytes that are kept.
pub const MAX_BYTES: usize = 1 << 20;
/// Bytes of one line that are kept.
pub const MAX_LINE: usize = 10_000;

/// The last lines printed, by the generation that printed them, so that going back takes them back.
#[derive(Debug, Default)]
pub struct Console {
    generations: BTreeMap<u64, VecDeque<String>>,
    lines: usize,
    bytes: usize,
    dropped: u64,
}

impl Console {
    /// Forgets everything.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// Forgets what `generation` and later ones printed: they are about to be computed anew.
    pub fn begin(&mut self, generation: u64) {
        for lines in self.generations.split_off(&generation).into_values() {
            self.lines -= lines.len();
            self.bytes -= lines.iter().map(String::len).sum::<usize>();
        }
    }

    /// Appends lines of `generation`, forgetting the oldest ones past the limits. `dropped` lines before them were
    /// never handed over.
    pub fn append(&mut self, generation: u64, lines: impl IntoIterator<Item = String>, dropped: u64) {
        if dropped > 0 {
            // What is left would stand before a hole.
            let earlier = self.lines as u64;
            self.generations.clear();
            (self.lines, self.bytes) = (0, 0);
            self.dropped += earlier + dropped;
        }
        for line in lines {
            self.lines += 1;
            self.bytes += line.len();
            self.generations.entry(generation).or_default().push_back(line);
            while self.lines > MAX_LINES || self.bytes > MAX_BYTES {
                let Some(mut oldest) = self.generations.first_entry() else { break };
                match oldest.get_mut().pop_front() {
                    Some(line) => {
                        self.lines -= 1;
                        self.bytes -= line.len();
                        self.dropped += 1;
                    }
                    None => {
                        oldest.remove();
                    }
                }
            }
        }
    }

    /// How many lines the generations up to `generation` have printed, of those that are kept.
    #[must_use]
    pub fn len(&self, generation: u64) -> usize {
        self.generations.range(..=generation).map(|(_, lines)| lines.len()).sum()
    }

    /// Lines `rows` of the generations up to `generation`.
    #[must_use]
    pub fn lines(&self, generation: u64, rows: std::ops::Range<usize>) -> Vec<String> {
        let mut skip = rows.start;
        let mut wanted = rows.len();
        let mut result = Vec::with_capacity(wanted.min(MAX_LINES));
        for lines in self.generations.range(..=generation).map(|(_, lines)| lines) {
            if skip >= lines.len() {
                skip -= lines.len();
                continue;
            }
            result.extend(lines.iter().skip(skip).take(wanted).cloned());
            wanted = rows.len() - result.len();
            skip = 0;
            if wanted == 0 {
                break;
            }
        }
        result
    }

    /// The generation that printed line `row` of those up to `generation`.
    #[must_use]
    pub fn generation_of(&self, generation: u64, row: usize) -> Option<u64> {
        let mut before = 0;
        self.generations.range(..=generation).find_map(|(&printed_in, lines)| {
            before += lines.len();
            (row < before).then_some(printed_in)
        })
    }

    /// How many lines were forgotten because there were too many.
    #[must_use]
    pub fn dropped(&self) -> u64 {
        self.dropped
    }
}

/// A line cut to [`MAX_LINE`] bytes.
#[must_use]
pub fn shortened(line: &str) -> String {
    if line.len() <= MAX_LINE {
        return line.to_owned();
    }
    let end = (0..=MAX_LINE).rev().find(|&i| line.is_char_boundary(i)).unwrap_or(0);
    format!("{}…", &line[..end])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(console: &Console, generation: u64) -> Vec<String> {
        console.lines(generation, 0..console.len(generation))
    }

    #[test]
    fn lines_belong_to_their_generation() {
        let mut console = Console::default();
        console.append(0, ["start".to_owned()], 0);
        console.append(1, ["one".to_owned(), "uno".to_owned()], 0);
        console.append(2, ["two".to_owned()], 0);
        assert_eq!(all(&console, 1), ["start", "one", "uno"]);
        assert_eq!(console.lines(2, 1..3), ["one", "uno"]);
        assert_eq!(
            [0, 1, 2, 3, 4].map(|row| console.generation_of(2, row)),
            [Some(0), Some(1), Some(1), Some(2), None]
        );
        console.begin(1);
        assert_eq!(all(&console, 9), ["start"]);
    }

    #[test]
    fn keeps_the_last_lines_within_its_limits() {
        let mut console = Console::default();
        console.append(0, (0..MAX_LINES + 5).map(|i| i.to_string()), 0);
        assert_eq!(console.len(0), MAX_LINES);
        assert_eq!(console.dropped(), 5);
        assert_eq!(console.lines(0, 0..1), ["5"]);
        console.append(1, std::iter::repeat_n("x".repeat(MAX_LINE), 500), 0);
        assert!(console.bytes <= MAX_BYTES);
        assert_eq!(console.len(1), MAX_BYTES / MAX_LINE);
    }

    #[test]
    fn a_long_line_is_cut_at_a_character() {
        let line = shortened(&"é".repeat(MAX_LINE));
        assert!(line.len() <= MAX_LINE + '…'.len_utf8() && line.ends_with('…'));
    }
}
