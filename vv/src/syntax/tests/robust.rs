//! Any text whatever: no panic, no endless loop, every span inside the text.

use proptest::prelude::*;

use super::listings::ALL;
use crate::diagnostic::{Diagnostic, Form, render};
use crate::source::{FileId, Sources, Span};
use crate::syntax::{highlight, parse};

fn holds(text: &str) -> Result<(), TestCaseError> {
    let inside = |span: Span| {
        let (start, end) = (span.start as usize, span.end as usize);
        start <= end && end <= text.len() && text.is_char_boundary(start) && text.is_char_boundary(end)
    };
    let spans = |d: &Diagnostic| {
        let edits = d.hints.iter().filter_map(|h| h.edit.as_ref()).map(|e| e.0);
        d.span.into_iter().chain(d.labels.iter().map(|l| l.0)).chain(edits).collect::<Vec<_>>()
    };
    let (_, diagnostics) = parse(FileId::MAIN, text);
    for diagnostic in &diagnostics {
        prop_assert!(spans(diagnostic).into_iter().all(inside), "{diagnostic:?} lies outside {text:?}");
    }
    let mut sources = Sources::default();
    sources.add("any.vv", text);
    for form in [Form::Human { color: true }, Form::Short, Form::Json] {
        let _ = render(&diagnostics, &sources, form);
    }
    let mut end = 0;
    for (range, _) in highlight(text) {
        prop_assert!(end <= range.start && range.start < range.end, "{range:?} out of order in {text:?}");
        prop_assert!(text.get(range.clone()).is_some(), "{range:?} splits a character of {text:?}");
        end = range.end;
    }
    Ok(())
}

/// Words and signs of the language in any order: far more of it parses than of random characters.
pub(super) fn soup() -> impl Strategy<Value = String> {
    let words = [
        "vertex",
        "mesh",
        "ring",
        "faces",
        "double",
        "vec",
        "point",
        "void",
        "if",
        "else",
        "for",
        "while",
        "do",
        "return",
        "const",
        "static",
        "forall",
        "in",
        "nextto",
        "prevto",
        "is",
        "any",
        "valence",
        "gaps",
        "make",
        "nb_of",
        "nb of",
        "erase",
        "from",
        "replace",
        "with",
        "splice",
        "after",
        "before",
        "add",
        "to",
        "merge",
        "print",
        "synchronize",
        "param",
        "start",
        "step",
        "edge",
        "null",
        "std::",
        "auto",
        "switch",
        "p",
        "q",
        "S",
        "Swith",
        "x",
        "1",
        "2.5",
        "\"text\"",
        "`",
        "‘",
        "(",
        ")",
        "{",
        "}",
        "[",
        "]",
        ",",
        ";",
        "$",
        ".",
        "|",
        "=",
        "==",
        "<",
        "+",
        "−",
        "!",
        "?",
        ":",
        "++",
        "->",
        "#include",
        "\n",
        "\n1 ",
        "/*",
        "*/",
        "//",
        "\"",
        "é",
        "\u{0}",
    ];
    prop::collection::vec(prop::sample::select(words.to_vec()), 0..80).prop_map(|words| words.join(" "))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    #[test]
    fn any_characters(text in "\\PC*|(.|\n)*") {
        holds(&text)?;
    }

    #[test]
    fn any_words(text in soup()) {
        holds(&text)?;
    }

    /// A listing with a stretch cut out, something else put in.
    #[test]
    fn any_mutation_of_a_listing(which in 0..ALL.len(), at in 0_usize..1000, length in 0_usize..20, inserted in soup(), insert: bool) {
        let characters: Vec<char> = ALL[which].chars().collect();
        let at = at % characters.len();
        let end = (at + length).min(characters.len());
        let inserted = if insert { inserted.as_str() } else { "" };
        let text: String = characters[..at].iter().copied().chain(inserted.chars()).chain(characters[end..].iter().copied()).collect();
        holds(&text)?;
    }
}

/// Every beginning of a listing, as it is while it is being typed.
#[test]
fn half_written() {
    for (end, _) in ALL[2].char_indices() {
        assert!(holds(&ALL[2][..end]).is_ok());
    }
}

/// One message, not one for each level; and no stack overflow here or in whoever walks the tree.
#[test]
fn nesting_is_bounded() {
    let n = 30_000;
    for (open, middle, close) in [
        ("(", "1", ")"),
        ("-", "1", ""),
        ("!", "1", ""),
        ("(a|", "b", ")"),
        ("f(", "1", ")"),
        ("`(", "p", ")"),
        ("a = ", "1", ""),
        ("a ? b : ", "1", ""),
        ("a ? ", "1", " : b"),
        ("1 + ", "1", ""),
        ("1 + (", "1", ")"),
        ("a", "", "$x"),
        ("nextto ", "p", " in q"),
        ("nextto p in ", "p", ""),
        ("any in ", "p", ""),
        ("valence ", "p", ""),
    ] {
        let text = format!("void f() {{ x = {}{middle}{}; }}", open.repeat(n), close.repeat(n));
        one_error(&text);
    }
    for (open, close) in
        [("{", "}"), ("if (a) ", ""), ("while (a) {", "}"), ("forall p in S ", ""), ("do ", ""), ("if (a) ; else ", "")]
    {
        let text = format!("void f() {{ {};{} }}", open.repeat(n), close.repeat(n));
        one_error(&text);
        let text = format!("void f() {{ {}", open.repeat(n));
        let (_, diagnostics) = parse(FileId::MAIN, &text);
        assert!(diagnostics.len() <= 3, "{open:?}: {} messages", diagnostics.len());
    }
    let (_, diagnostics) = parse(FileId::MAIN, &"(".repeat(n));
    assert_eq!(diagnostics.len(), 1);
}

#[track_caller]
fn one_error(text: &str) {
    let (_, diagnostics) = parse(FileId::MAIN, text);
    let messages: Vec<_> = diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(messages, ["nested too deeply, more than 200 levels"], "{}…", text.chars().take(60).collect::<String>());
}

/// What people write stays far below the bound.
#[test]
fn moderate_nesting_is_fine() {
    let sum = vec!["x$pos"; 150].join(" + ");
    let nested = format!("{}1{}", "(".repeat(150), ")".repeat(150));
    let branches = "if (a) ; else ".repeat(150);
    super::statements(&format!("x = {sum}; y = {nested}; {branches};"));
}

/// A reader that is not linear would be at these for minutes.
#[test]
fn hostile_texts_come_to_an_end() {
    let n = 40_000;
    let repeated = [
        "forall p in q (\n",
        "print (a\n",
        "f(a, ",
        "{ (",
        "vertex x(",
        "1 ",
        "\n1 x",
        "make { ",
        "a and ",
        "nextto ",
        "void f() {\n",
        "int f(\n",
        "std::",
        "‘",
        "'a'",
        "\"\n",
        "/*",
        "a + ",
        "}",
        ");",
        "@ ",
        "x = ;\n",
        "else ",
        "case 1: ",
        "switch (x) {",
    ];
    for text in repeated {
        let _ = parse(FileId::MAIN, &text.repeat(n));
    }
}
