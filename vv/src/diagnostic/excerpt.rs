//! The lines of a text that a message shows, of long ones only the part around the mark.

use std::collections::BTreeMap;
use std::ops::Range;

use codespan_reporting::files::{Error, Files};

use super::human::printable;
use crate::source::{SourceFile, Sources, Span};

/// Lines above and below a mark that may be shown with it.
const CONTEXT: usize = 4;

/// Bytes of a line that are shown at most: so many before the mark, so many after its beginning.
const BEFORE: usize = 80;
const AFTER: usize = 160;

/// Stands for what is left out of a line.
const LEFT_OUT: &str = "…";

/// The parts of all texts that one message needs.
pub(super) struct Excerpts<'s> {
    files: Vec<Excerpt<'s>>,
}

struct Excerpt<'s> {
    source: &'s SourceFile,
    name: String,
    text: String,
    lines: Vec<Line>,
}

/// A line that is shown.
struct Line {
    /// Its number, from 0.
    index: usize,
    /// Where it stands in the excerpt, with its end.
    range: Range<usize>,
    /// Where the part that is shown stands in the excerpt.
    shown: Range<usize>,
    /// Where that part begins in the whole text.
    from: usize,
}

impl<'s> Excerpts<'s> {
    /// What is needed to mark `spans`; where a line is too long for two of them, the first is shown.
    pub(super) fn new(sources: &'s Sources, spans: &[Span]) -> Self {
        let excerpt = |(id, source): (usize, &'s SourceFile)| {
            let here: Vec<Span> = spans.iter().filter(|s| s.file.0 as usize == id).copied().collect();
            Excerpt::new(source, &here)
        };
        Self { files: sources.files().iter().enumerate().map(excerpt).collect() }
    }

    /// Where a span lies in the excerpt of its text.
    pub(super) fn range(&self, span: Span) -> Option<Range<usize>> {
        let excerpt = self.files.get(span.file.0 as usize)?;
        let (start, end) = (excerpt.place(span.start as usize)?, excerpt.place(span.end as usize)?);
        Some(start..end.max(start))
    }

    fn file(&self, id: usize) -> Result<&Excerpt<'s>, Error> {
        self.files.get(id).ok_or(Error::FileMissing)
    }
}

impl<'s> Excerpt<'s> {
    fn new(source: &'s SourceFile, spans: &[Span]) -> Self {
        // Which lines, and for those with a mark where it begins.
        let mut wanted: BTreeMap<usize, Option<usize>> = BTreeMap::new();
        for span in spans {
            for offset in [span.start as usize, span.end as usize] {
                let index = source.line_index(offset);
                for near in index.saturating_sub(CONTEXT)..=index + CONTEXT {
                    wanted.entry(near).or_default();
                }
                wanted.entry(index).and_modify(|mark| *mark = mark.or(Some(offset)));
            }
        }
        let mut excerpt =
            Self { source, name: printable(&source.name).into_owned(), text: String::new(), lines: vec![] };
        for (index, mark) in wanted {
            let Some(range) = source.line_range(index) else { break };
            excerpt.push(index, range, mark);
        }
        excerpt
    }

    fn push(&mut self, index: usize, whole: Range<usize>, mark: Option<usize>) {
        let text = &self.source.text;
        let mut part = whole.clone();
        if whole.len() > BEFORE + AFTER {
            let mark = mark.unwrap_or(whole.start).clamp(whole.start, whole.end);
            part.start = floor(text, mark.saturating_sub(BEFORE).max(whole.start));
            part.end = floor(text, (part.start + BEFORE + AFTER).min(whole.end));
        }
        let start = self.text.len();
        if part.start > whole.start {
            self.text.push_str(LEFT_OUT);
        }
        let shown = self.text.len();
        self.text.push_str(&printable(&text[part.clone()]));
        let shown = shown..self.text.len();
        if part.end < whole.end {
            self.text.push_str(LEFT_OUT);
        }
        self.text.push('\n');
        self.lines.push(Line { index, range: start..self.text.len(), shown, from: part.start });
    }

    /// Where a byte of the text stands in the excerpt; in a part left out, at its edge.
    fn place(&self, offset: usize) -> Option<usize> {
        let offset = floor(&self.source.text, offset);
        let line = self.line(self.source.line_index(offset))?;
        Some((line.shown.start + offset.saturating_sub(line.from)).min(line.shown.end))
    }

    fn line(&self, index: usize) -> Option<&Line> {
        let at = self.lines.binary_search_by_key(&index, |line| line.index).ok()?;
        self.lines.get(at)
    }
}

impl<'a> Files<'a> for Excerpts<'_> {
    type FileId = usize;
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, id: usize) -> Result<&'a str, Error> {
        Ok(&self.file(id)?.name)
    }

    fn source(&'a self, id: usize) -> Result<&'a str, Error> {
        Ok(&self.file(id)?.text)
    }

    fn line_index(&'a self, id: usize, byte_index: usize) -> Result<usize, Error> {
        let lines = &self.file(id)?.lines;
        let after = lines.partition_point(|line| line.range.start <= byte_index);
        let line = after.checked_sub(1).and_then(|at| lines.get(at));
        Ok(line.map_or(0, |line| line.index))
    }

    fn column_number(&'a self, id: usize, line_index: usize, byte_index: usize) -> Result<usize, Error> {
        let excerpt = self.file(id)?;
        let line = excerpt.line(line_index).ok_or(Error::LineTooLarge { given: line_index, max: 0 })?;
        let offset = line.from + byte_index.saturating_sub(line.shown.start);
        Ok(excerpt.source.position(offset as u32).column as usize)
    }

    /// Nothing for lines that are not shown: those inside a long span.
    fn line_range(&'a self, id: usize, line_index: usize) -> Result<Range<usize>, Error> {
        Ok(self.file(id)?.line(line_index).map_or(0..0, |line| line.range.clone()))
    }
}

/// The beginning of the character that holds this byte.
fn floor(text: &str, offset: usize) -> usize {
    let offset = offset.min(text.len());
    (0..=offset).rev().find(|&o| text.is_char_boundary(o)).unwrap_or(0)
}
