//! What the checker says of a text, and what it makes of it.

mod conversions;
mod fixes;
mod limits;
mod listings;
mod messages;
mod mutations;
mod names;
mod newcomers;
mod parallel;
mod rings;
mod vain;

use vv::diagnostic::{Diagnostic, Severity};
use vv::{Compilation, Included, compile};

/// The paper's Fig. 3.
const INSERT: &str = "
vertex insert(vertex p, vertex q) {
  vertex x;
  make {p, q} nb_of x;
  replace p with x in q;
  replace q with x in p;
  return x;
}
";

/// A refinement that asks the program for its rule.
const HOST: &str = "
vec vertex_point(vertex p);
void refine(mesh& S) { synchronize S; forall p in S p$pos = vertex_point(p); }
";

/// Compiles a program that may include `insert.vv`, `host.vv` and what ships.
fn compiled(text: &str) -> Compilation {
    compile("main.vv", text, &mut |_, path| match path {
        "insert.vv" => Ok(Included { name: path.to_owned(), text: INSERT.to_owned() }),
        "host.vv" => Ok(Included { name: "<vv>/host.vv".to_owned(), text: HOST.to_owned() }),
        "marks.vv" => Ok(Included { name: path.to_owned(), text: "vertex { double mark = 1; };".to_owned() }),
        _ => {
            let shipped = format!("{}/../assets/programs/{path}", env!("CARGO_MANIFEST_DIR"));
            let text = std::fs::read_to_string(shipped).map_err(|_| format!("there is no file `{path}`"))?;
            Ok(Included { name: path.to_owned(), text })
        }
    })
}

/// Checks a program that is annotated below its lines: `//  ^^^ error: message` marks the columns above the carets. A
/// message without annotation fails, and so does an annotation without message.
#[track_caller]
fn check(annotated: &str) {
    let text: String = annotated.lines().filter(|l| !is_annotation(l)).map(|l| format!("{l}\n")).collect();
    let c = compiled(&text);
    let found = annotate(&text, &c);
    assert!(found.trim() == annotated.trim(), "expected:\n{annotated}\n\nfound:\n{found}");
    assert_eq!(c.program.is_none(), c.diagnostics.iter().any(|d| d.severity == Severity::Error));
}

fn is_annotation(line: &str) -> bool {
    line.starts_with("//") && line.trim_start_matches(['/', ' ']).starts_with('^')
}

fn annotate(text: &str, c: &Compilation) -> String {
    let annotations: Vec<(u32, String)> = c.diagnostics.iter().map(|d| annotation(c, d)).collect();
    let mut lines = Vec::new();
    for (i, line) in text.lines().enumerate() {
        lines.push(line.to_owned());
        lines.extend(annotations.iter().filter(|(at, _)| *at as usize == i + 1).map(|(_, a)| a.clone()));
    }
    lines.join("\n")
}

/// The annotation that a diagnostic asks for, with its line (from 1).
fn annotation(c: &Compilation, d: &Diagnostic) -> (u32, String) {
    let severity = format!("{:?}", d.severity).to_lowercase();
    let span = d.span.expect("checks are located");
    let (file, start, end) = c.sources.locate(span).expect("a place");
    assert_eq!(file, "main.vv", "{}", d.message);
    let width = c.sources.file(span.file).and_then(|f| f.line(start.line)).map_or(0, |l| l.chars().count() as u32);
    let end = if end.line == start.line { end.column } else { width + 1 };
    let carets = "^".repeat((end - start.column).max(1) as usize);
    let mut line = format!("{}{carets} {severity}: {}", " ".repeat(start.column as usize - 1), d.message);
    assert!(line.starts_with("  "), "indent what is annotated: {line}");
    line.replace_range(..2, "//");
    (start.line, line)
}
