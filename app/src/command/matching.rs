//! Finds a command by a few of its letters.

/// How well a text fits what was typed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Match {
    /// The more the better.
    pub score: i32,
    /// Which characters of the text were meant, ascending.
    pub at: Vec<usize>,
}

/// What a letter is worth: at the beginning of a word, right after the letter before, anywhere else.
const WORD_START: i32 = 8;
const CONSECUTIVE: i32 = 9;
const ANYWHERE: i32 = 1;

/// Matches a text against what was typed: the letters of each typed word must occur in it in this order, words in any
/// order, large or small. `None` if they do not. Nothing typed fits everything.
#[must_use]
pub fn find(typed: &str, text: &str) -> Option<Match> {
    let letters: Vec<char> = text.chars().map(lower).collect();
    let mut result = Match { score: 0, at: Vec::new() };
    for word in typed.split_whitespace() {
        let (score, at) = find_word(&word.chars().map(lower).collect::<Vec<_>>(), &letters)?;
        result.score += score;
        result.at.extend(at);
    }
    result.at.sort_unstable();
    result.at.dedup();
    // Of two that fit the shorter one.
    result.score = result.score * 64 - letters.len() as i32;
    Some(result)
}

/// Matches what was typed against other words for a text: each typed word must begin one of them, or one of the text itself.
/// Worth less than the same letters in the text, and more than letters scattered over it.
#[must_use]
pub fn find_also(typed: &str, text: &str, also: &str) -> Option<Match> {
    const LESS: i32 = 4 * 64;
    let known = |words: &str, word: &str| words.to_lowercase().split_whitespace().any(|known| known.starts_with(word));
    let typed = typed.to_lowercase();
    let mut words = typed.split_whitespace().peekable();
    words.peek()?;
    let fits = words.all(|word| known(also, word) || known(text, word));
    // Letters at the beginning of words.
    let begun = |word: &str| WORD_START + CONSECUTIVE * (word.chars().count() as i32 - 1);
    let score = typed.split_whitespace().map(begun).sum::<i32>() * 64 - LESS;
    fits.then_some(Match { score, at: Vec::new() })
}

fn lower(c: char) -> char {
    c.to_lowercase().next().unwrap_or(c)
}

/// The best way to find `word` in `text` as a subsequence, by dynamic programming: `best[i]` is the best score with the
/// letters so far, the last of them at `text[i]`.
fn find_word(word: &[char], text: &[char]) -> Option<(i32, Vec<usize>)> {
    let mut rows: Vec<Vec<Option<(i32, usize)>>> = Vec::with_capacity(word.len());
    for (n, &letter) in word.iter().enumerate() {
        let mut row = vec![None; text.len()];
        let mut before: Option<(i32, usize)> = None; // the best of the row before, left of i
        for i in 0..text.len() {
            if n > 0 && i > 0 {
                before = before.max(rows[n - 1][i - 1].map(|(score, _)| (score, i - 1)));
            }
            if text[i] != letter {
                continue;
            }
            let starts = i == 0 || !text[i - 1].is_alphanumeric();
            let here = if starts { WORD_START } else { ANYWHERE };
            row[i] = match n {
                0 => Some((here, i)),
                _ => {
                    let next_to =
                        i.checked_sub(1).and_then(|j| rows[n - 1][j].map(|(s, _)| (s + here.max(CONSECUTIVE), j)));
                    next_to.max(before.map(|(score, j)| (score + here, j)))
                }
            };
        }
        rows.push(row);
    }
    let last = rows.last()?;
    let (mut i, score) =
        last.iter().enumerate().filter_map(|(i, b)| Some((i, (*b)?.0))).max_by_key(|&(i, s)| (s, usize::MAX - i))?;
    let mut at = Vec::with_capacity(word.len());
    for row in rows.iter().rev() {
        at.push(i);
        i = row[i]?.1;
    }
    at.reverse();
    Some((score, at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn best(typed: &str, expected: &str) {
        let texts = [
            "System theme",
            "Open program…",
            "Open mesh…",
            "Save mesh as…",
            "Step",
            "Stop",
            "Smooth",
            "Command palette…",
        ];
        // Of equals the first, as in the palette.
        let found = texts.iter().rev().filter_map(|t| Some((find(typed, t)?.score, *t))).max_by_key(|(s, _)| *s);
        assert_eq!(found.map(|(_, t)| t), Some(expected), "{typed}");
    }

    #[test]
    fn a_few_letters_find_a_command() {
        best("st", "Step");
        best("sto", "Stop");
        best("om", "Open mesh…");
        best("OPEN", "Open mesh…"); // the shorter one
        best("mesh save", "Save mesh as…");
        best("palt", "Command palette…");
    }

    #[test]
    fn letters_that_are_not_there_find_nothing() {
        assert_eq!(find("stx", "Step"), None);
        assert_eq!(find("pets", "Step"), None);
        assert_eq!(find("", "Step").map(|m| m.at), Some(vec![]));
    }

    #[test]
    fn other_words_are_known_by_their_beginnings_and_are_worth_less() {
        let score = |typed| find_also(typed, "Reflection lines", "zebra stripes").map(|m| m.score);
        assert_eq!([score("ebra"), score(""), score("zebra x")], [None; 3]);
        assert!(score("zeb").is_some() && score("Zebra lines").is_some());
        let scattered = find("zebra", "sizes of embroidery pads").unwrap().score;
        let direct = find("zebra", "Zebra of some other kind").unwrap().score;
        assert!(scattered < score("zebra").unwrap() && score("zebra").unwrap() < direct);
    }

    #[test]
    fn what_was_meant_is_told() {
        assert_eq!(find("om", "Open mesh").map(|m| m.at), Some(vec![0, 5]));
        assert_eq!(find("pen", "open pen").map(|m| m.at), Some(vec![5, 6, 7]));
    }
}
