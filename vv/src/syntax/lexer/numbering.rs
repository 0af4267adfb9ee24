//! Line numbers of printed listings.

use std::iter::Peekable;
use std::ops::Range;

/// Where the numbers stand that were pasted along with a listing, in order.
///
/// They count up by one from line to line, with or without code behind them; lines without a number may lie between.
/// A listing begins where a statement can begin, and there no program has any use for a number. So `2 * x` that
/// goes on with the line before stays what it is.
pub(super) fn find(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let mut lines = numbered_lines(text).peekable();
    while let Some(first) = lines.next() {
        if first.may_begin {
            take_listing(first, &mut lines, &mut found);
        }
    }
    found
}

/// A line that begins with a whole number and a space, or holds nothing else.
struct Numbered {
    digits: Range<usize>,
    number: u64,
    /// It stands where a statement can begin.
    may_begin: bool,
    /// There is no code before it at all.
    is_first: bool,
}

fn take_listing(first: Numbered, lines: &mut Peekable<impl Iterator<Item = Numbered>>, found: &mut Vec<Range<usize>>) {
    let is_first = first.is_first;
    let mut number = first.number;
    let mut listing = vec![first.digits];
    while let Some(line) = lines.next_if(|line| line.number == number + 1 || !line.may_begin) {
        if line.number == number + 1 {
            number += 1;
            listing.push(line.digits);
        }
    }
    if is_first || listing.len() > 1 {
        found.append(&mut listing);
    }
}

fn numbered_lines(text: &str) -> impl Iterator<Item = Numbered> {
    let mut offset = 0;
    let mut may_begin = true;
    let mut is_first = true;
    text.split_inclusive('\n').filter_map(move |line| {
        let start = offset;
        offset += line.len();
        let code = line.trim_start_matches(super::is_space);
        if code.is_empty() {
            return None;
        }
        let indent = line.len() - code.len();
        let length = code.bytes().take_while(u8::is_ascii_digit).count();
        let behind = &code[length..];
        let (began, was_first) = (may_begin, is_first);
        is_first = false;
        let is_number = (1..=6).contains(&length) && (behind.is_empty() || behind.starts_with(super::is_space));
        let rest = if is_number { behind.trim_matches(super::is_space) } else { code.trim_end() };
        if !(is_number && rest.is_empty()) {
            may_begin = rest.ends_with([';', '{', '}', ':'])
                || rest.ends_with("*/")
                || rest.starts_with('#')
                || rest.contains("//");
        }
        let number = code[..length].parse().ok().filter(|_| is_number)?;
        let digits = start + indent..start + indent + length;
        Some(Numbered { digits, number, may_begin: began, is_first: was_first })
    })
}
