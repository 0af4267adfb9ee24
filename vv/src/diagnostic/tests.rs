//! Diagnostics in, text out.

use super::{Diagnostic, Form, Severity, render};
use crate::mesh::Vertex;
use crate::source::{FileId, Sources, Span};

const INSERT: FileId = FileId(1);

fn sources() -> Sources {
    let mut sources = Sources::default();
    sources.add("loop.vv", "#include \"insert.vv\"\r\nvoid loop(mesh& S) {\n\tmerge Swith ‘NV;\n}\n");
    sources.add("insert.vv", "vertex insert(vertex p) {\n  x = insert(p);\n}\n");
    sources
}

/// The first `part` of the text of a file.
fn span(file: FileId, part: &str) -> Span {
    let sources = sources();
    let start = sources.file(file).and_then(|f| f.text.find(part)).expect("a part of the text") as u32;
    Span::new(file, start, start + part.len() as u32)
}

fn vertices(numbers: impl IntoIterator<Item = usize>) -> Vec<Vertex> {
    numbers.into_iter().filter_map(|n| Vertex::from_index(n - 1)).collect()
}

fn everything() -> Diagnostic {
    Diagnostic::error(span(FileId::MAIN, "Swith"), "a space is missing")
        .label(span(FileId::MAIN, "merge"), "after this")
        .evidence("the ring of v3 is {v1, v2}")
        .fix("write `S with`", span(FileId::MAIN, "Swith"), "S with")
        .about(vertices([3, 7]))
}

#[track_caller]
fn check(diagnostic: &Diagnostic, form: Form, expected: &str) {
    let rendered = render(std::slice::from_ref(diagnostic), &sources(), form);
    let rendered = rendered.lines().map(str::trim_end).collect::<Vec<_>>().join("\n");
    assert_eq!(rendered.trim_end(), expected.trim_matches('\n'), "\n{rendered}");
}

#[track_caller]
fn human(diagnostic: &Diagnostic, expected: &str) {
    check(diagnostic, Form::Human { color: false }, expected);
}

#[test]
fn people_see_the_line() {
    human(
        &everything(),
        r"
error: a space is missing
  ┌─ loop.vv:3:8
  │
3 │     merge Swith ‘NV;
  │     ----- ^^^^^
  │     │
  │     after this
  │
  = the ring of v3 is {v1, v2}
  = at v7
  = help: write `S with`
",
    );
}

#[test]
fn people_see_who_called() {
    let mut diagnostic = Diagnostic::error(span(INSERT, "x ="), "a null was used");
    diagnostic.calls =
        vec![("insert".into(), span(INSERT, "insert(p);")), ("insert".into(), span(FileId::MAIN, "Swith"))];
    human(
        &diagnostic,
        r"
error: a null was used
  ┌─ insert.vv:2:3
  │
2 │   x = insert(p);
  │   ^^^ ---------- `insert` is called from here
  │
  ┌─ loop.vv:3:8
  │
3 │     merge Swith ‘NV;
  │           ----- `insert` is called from here
",
    );
}

#[test]
fn deep_recursion_stays_short() {
    let mut diagnostic = Diagnostic::error(span(INSERT, "x"), "too many calls");
    diagnostic.calls = vec![("insert".into(), span(INSERT, "insert(p)")); 10_000];
    let rendered = render(&[diagnostic], &sources(), Form::Human { color: false });
    assert!(rendered.contains("calls between these are not shown"), "{rendered}");
    assert!(rendered.lines().count() < 30, "{rendered}");
}

#[test]
fn about_a_mesh_there_is_no_line() {
    let about = vertices(1..=12);
    let diagnostic = Diagnostic::new(Severity::Warning, None, "12 vertices lie in no face").about(about);
    human(&diagnostic, "warning: 12 vertices lie in no face\n = at v1, v2, v3, v4, v5, v6, v7, v8, v9, v10 and 2 more");
    check(&diagnostic, Form::Short, "warning: 12 vertices lie in no face");
    human(&Diagnostic::new(Severity::Note, None, "nothing to do"), "note: nothing to do");
}

#[test]
fn short_is_one_line() {
    check(&everything(), Form::Short, "loop.vv:3:8: error: a space is missing");
    let diagnostic = Diagnostic::warning(span(INSERT, "insert"), "two\nlines");
    check(&diagnostic, Form::Short, "insert.vv:1:8: warning: two lines");
}

#[test]
fn json_has_everything() {
    let mut diagnostic = everything();
    diagnostic.calls.push(("insert".into(), span(INSERT, "insert")));
    let rendered = render(&[diagnostic, Diagnostic::new(Severity::Note, None, "b")], &sources(), Form::Json);
    let objects: Vec<serde_json::Value> =
        rendered.lines().map(|line| serde_json::from_str(line).expect("an object per line")).collect();
    assert_eq!(
        objects,
        [
            serde_json::json!({
                "severity": "error", "message": "a space is missing",
                "file": "loop.vv", "line": 3, "column": 8, "end_line": 3, "end_column": 13,
                "labels": [{
                    "message": "after this",
                    "file": "loop.vv", "line": 3, "column": 2, "end_line": 3, "end_column": 7,
                }],
                "evidence": ["the ring of v3 is {v1, v2}"],
                "hints": [{
                    "message": "write `S with`",
                    "edit": {
                        "replacement": "S with",
                        "file": "loop.vv", "line": 3, "column": 8, "end_line": 3, "end_column": 13,
                    },
                }],
                "vertices": ["v3", "v7"],
                "calls": [{
                    "function": "insert",
                    "file": "insert.vv", "line": 1, "column": 8, "end_line": 1, "end_column": 14,
                }],
            }),
            serde_json::json!({
                "severity": "note", "message": "b",
                "file": null, "line": null, "column": null, "end_line": null, "end_column": null,
                "labels": [], "evidence": [], "hints": [], "vertices": [], "calls": [],
            }),
        ]
    );
}

#[test]
fn colour_is_ansi_and_only_on_request() {
    let plain = render(&[everything()], &sources(), Form::Human { color: false });
    let colored = render(&[everything()], &sources(), Form::Human { color: true });
    assert!(!plain.contains('\x1b'));
    assert!(colored.contains("\x1b["));
}

/// What a program's text or a file's name holds must not act on the terminal.
#[test]
fn the_terminal_is_safe() {
    let mut sources = Sources::default();
    let file = sources.add("\x1b[2J.vv", "x = \x1b[31m\u{202e}\u{9b}1;\u{7}");
    let diagnostic = Diagnostic::error(Span::new(file, 0, 3), "unknown \x1b[0m").evidence("\x07").hint("\x1b");
    for form in [Form::Human { color: false }, Form::Short] {
        let rendered = render(std::slice::from_ref(&diagnostic), &sources, form);
        assert!(!rendered.contains(|c: char| c.is_control() && c != '\n'), "{rendered:?}");
        assert!(!rendered.contains('\u{202e}'));
    }
}

/// Places outside the text, inside characters, the wrong way round, or of no known file.
#[test]
fn any_span_is_survived() {
    let sources = sources();
    let length = sources.file(FileId::MAIN).map_or(0, |f| f.text.len() as u32);
    let offsets: Vec<u32> = (0..length + 3).chain([u32::MAX]).collect();
    for file in [FileId::MAIN, FileId(9)] {
        for &start in &offsets {
            for end in [0, start.saturating_sub(1), start, start.saturating_add(1), u32::MAX] {
                let odd = Span::new(file, start, end);
                let mut diagnostic = Diagnostic::error(odd, "odd").label(odd, "odd").fix("odd", odd, "");
                diagnostic.calls.push(("f".into(), odd));
                for form in [Form::Human { color: false }, Form::Short, Form::Json] {
                    let rendered = render(std::slice::from_ref(&diagnostic), &sources, form);
                    assert!(rendered.contains("odd") && rendered.ends_with('\n'), "{rendered:?}");
                }
            }
        }
    }
}

#[test]
fn of_a_long_line_the_part_around_the_mark_is_shown() {
    let mut sources = Sources::default();
    let text = format!("{}wrong{}\nnext\n", "é; ".repeat(1_000_000), " ;".repeat(1_000_000));
    let start = text.find("wrong").expect("it is there") as u32;
    let file = sources.add("long.vv", text);
    let diagnostic = Diagnostic::error(Span::new(file, start, start + 5), "what is this")
        .label(Span::new(file, 0, 2), "far to the left")
        .label(Span::new(file, start + 6, start + 1_000_000), "and on to the right");
    let text = render(&[diagnostic], &sources, Form::Human { color: false });
    assert!(text.contains("long.vv:1:3000001\n"), "{text}");
    assert!(text.contains("│ …é; é;") && text.contains("é; wrong ; ;") && text.contains(" ; …\n"), "{text}");
    assert!(text.contains("^^^^^ ------"), "{text}");
    assert!(text.contains("far to the left") && text.contains("and on to the right"), "{text}");
    assert!(text.len() < 3000, "{text}");
}

#[test]
fn long_facts_are_cut_for_people_but_not_for_programs() {
    let ring = format!("ring of v1: {}", "v2 ".repeat(10_000));
    let diagnostic = Diagnostic::new(Severity::Error, None, "too many neighbours").evidence(ring.clone());
    let people = render(std::slice::from_ref(&diagnostic), &sources(), Form::Human { color: false });
    assert!(people.contains("ring of v1: v2 v2") && people.contains("…") && people.len() < 600, "{people}");
    assert!(render(&[diagnostic], &sources(), Form::Json).contains(&ring));
}

#[test]
fn what_is_said_twice_at_a_place_is_said_once() {
    let mut diagnostic = Diagnostic::error(span(INSERT, "insert(p);"), "more than 3 calls are open at once");
    diagnostic.calls = vec![("insert".into(), span(INSERT, "insert(p);")); 3];
    human(
        &diagnostic,
        r"
error: more than 3 calls are open at once
  ┌─ insert.vv:2:7
  │
2 │   x = insert(p);
  │       ^^^^^^^^^^
  │       │
  │       `insert` is called from here, 3 times
",
    );
}
