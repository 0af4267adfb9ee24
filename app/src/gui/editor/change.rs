//! What editing does to a text: text and selection in, text and selection out. Places are bytes.

use std::ops::Range;

/// A text with what is selected in it; an empty range is the cursor.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// All of it.
    pub text: String,
    /// What is selected.
    pub selection: Range<usize>,
}

/// Puts something in the place of a stretch; the cursor stands behind it.
pub fn replace(text: &str, range: Range<usize>, with: &str) -> Change {
    let cursor = range.start + with.len();
    let text = format!("{}{with}{}", &text[..range.start], &text[range.end..]);
    Change { text, selection: cursor..cursor }
}

/// Makes comments of the lines that are selected; if all of them are, code again.
pub fn toggle_comment(text: &str, selection: &Range<usize>) -> Change {
    let lines = lines(text, selection);
    let block = &text[lines.clone()];
    let blank = |line: &str| line.trim().is_empty();
    let code = block.lines().filter(|line| !blank(line));
    let depth = code.clone().map(|line| line.len() - line.trim_start().len()).min().unwrap_or(0);
    let off = block.lines().any(|line| !blank(line)) && code.clone().all(|line| line.trim_start().starts_with("//"));
    change_lines(text, selection, lines, |line| {
        if blank(line) && block.lines().count() > 1 {
            return line.to_owned();
        }
        if off {
            let (space, comment) = line.split_at(line.len() - line.trim_start().len());
            let rest = comment.strip_prefix("//").unwrap_or(comment);
            return format!("{space}{}", rest.strip_prefix(' ').unwrap_or(rest));
        }
        let depth = depth.min(line.len());
        format!("{}// {}", &line[..depth], &line[depth..])
    })
}

/// Moves the lines that are selected a level of `width` spaces in, or out.
pub fn indent(text: &str, selection: &Range<usize>, width: usize, inwards: bool) -> Change {
    change_lines(text, selection, lines(text, selection), |line| {
        if inwards {
            return if line.is_empty() { String::new() } else { format!("{}{line}", " ".repeat(width)) };
        }
        let spaces = line.bytes().take(width).take_while(|b| *b == b' ').count();
        let one_tab = usize::from(line.starts_with('\t'));
        line[spaces.max(one_tab)..].to_owned()
    })
}

/// Where a cursor stands that stood at `at` before `old` became `new` by somebody else's hand: beside the same things.
pub fn kept(old: &str, new: &str, at: usize) -> usize {
    let (gone, come) = (crate::session::changed(new, old), crate::session::changed(old, new));
    if at <= gone.start {
        return at;
    }
    if at >= gone.end {
        return come.end + (at - gone.end);
    }
    // Within: as many letters after the beginning, white space aside.
    let letters = old[gone.start..at].chars().filter(|c| !c.is_whitespace()).count();
    let inside = new[come.clone()].char_indices().filter(|(_, c)| !c.is_whitespace());
    let last = letters.checked_sub(1).and_then(|n| inside.clone().nth(n));
    match (letters, last) {
        (0, _) => come.start,
        (_, Some((i, c))) => come.start + i + c.len_utf8(),
        (_, None) => come.end,
    }
}

/// The whole lines that a selection touches, without the last line break.
fn lines(text: &str, selection: &Range<usize>) -> Range<usize> {
    let start = text[..selection.start].rfind('\n').map_or(0, |i| i + 1);
    // A selection that ends at the beginning of a line does not mean that line.
    let last = if selection.end > selection.start && text[..selection.end].ends_with('\n') { 1 } else { 0 };
    let from = selection.end - last;
    let end = text[from..].find('\n').map_or(text.len(), |i| from + i);
    start..end.max(start)
}

fn change_lines(text: &str, selection: &Range<usize>, lines: Range<usize>, change: impl Fn(&str) -> String) -> Change {
    let block = &text[lines.clone()];
    let changed: Vec<String> = block.split('\n').map(change).collect();
    let with = changed.join("\n");
    let result = format!("{}{with}{}", &text[..lines.start], &text[lines.end..]);
    let selection = if selection.is_empty() {
        // The cursor stays before the same letter.
        let behind = lines.end.saturating_sub(selection.start);
        let cursor = (lines.start + with.len()).saturating_sub(behind).max(lines.start);
        cursor..cursor
    } else {
        lines.start..lines.start + with.len()
    };
    Change { text: result, selection }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Selections are marked by `[` and `]`, cursors by `|`.
    fn read(marked: &str) -> (String, Range<usize>) {
        let text = marked.replace(['[', ']', '|'], "");
        match (marked.find('['), marked.find(']')) {
            (Some(start), Some(end)) => (text, start..end - 1),
            _ => (text, marked.find('|').map(|at| at..at).unwrap_or(0..0)),
        }
    }

    fn shown(change: &Change) -> String {
        let Range { start, end } = change.selection.clone();
        let t = &change.text;
        if start == end {
            return format!("{}|{}", &t[..start], &t[start..]);
        }
        format!("{}[{}]{}", &t[..start], &t[start..end], &t[end..])
    }

    #[track_caller]
    fn check(change: impl Fn(&str, &Range<usize>) -> Change, before: &str, after: &str) {
        let (text, selection) = read(before);
        assert_eq!(shown(&change(&text, &selection)), after);
    }

    #[test]
    fn comments_come_and_go() {
        check(toggle_comment, "  a|b;\nc;", "  // a|b;\nc;");
        check(toggle_comment, "  // a|b;\nc;", "  a|b;\nc;");
        check(toggle_comment, "f {\n[  a;\n\n    b;\n]}", "f {\n[  // a;\n\n  //   b;]\n}");
        check(toggle_comment, "[//a;\n  // b;]", "[a;\n  b;]");
        check(toggle_comment, "[// a;\nb;]", "[// // a;\n// b;]");
    }

    #[test]
    fn lines_move_in_and_out() {
        let (inwards, out) =
            (|t: &str, s: &Range<usize>| indent(t, s, 2, true), |t: &str, s: &Range<usize>| indent(t, s, 2, false));
        check(inwards, "[a;\n\n b;]", "[  a;\n\n   b;]");
        check(out, "[   a;\n b;\n\tc;\nd;]", "[ a;\nb;\nc;\nd;]");
        check(out, "  a|b", "a|b");
    }

    #[test]
    fn a_cursor_stays_beside_the_same_things() {
        assert_eq!(kept("a  b c", "a b c", 6), 5);
        assert_eq!(kept("a  b c", "a b c", 1), 1);
        assert_eq!(kept("x=1;  y=2;", "x = 1; y = 2;", 8), 11);
        assert_eq!(kept("x=1;  y=2;", "x = 1; y = 2;", 4), 6);
        assert_eq!(kept("abc", "", 2), 0);
    }
}
