//! Whole programs: rules, files, sizes.

use vv::mesh::Value;
use vv::{Compilation, Included, compile};

use super::compiled;

fn names_of_rules(c: &Compilation) -> Vec<String> {
    let program = c.program.as_ref().expect("a program");
    program.rules.iter().filter_map(|&r| Some(program.function(r)?.name.clone())).collect()
}

#[test]
fn rules_are_the_steps_of_the_programs_own_file() {
    let c = compile(
        "main.vv",
        "#include \"library.vv\"
         void first(mesh& S) {}
         static void helper(mesh& S) {}
         void two(mesh& S, int i) {}
         int value(mesh& S) { return 1; }
         void kept(const mesh& S) {}
         void last(mesh& T) {}",
        &mut |_, path| Ok(Included { name: path.to_owned(), text: "void library(mesh& S) {} start {}".to_owned() }),
    );
    assert_eq!(names_of_rules(&c), ["first", "last"]);
    let program = c.program.expect("a program");
    assert_eq!(program.start.and_then(|s| program.function(s)).map(|f| f.name.as_str()), Some("start"));
}

#[test]
fn blocks_are_functions_of_s() {
    let c = compiled("start { vertex v; add v to S; } step { remove any in any in null to S; }");
    assert!(c.program.is_none());
    let c = compiled("start { vertex v; add v to S; } step { synchronize S; } void other(mesh& S) {}");
    assert_eq!(names_of_rules(&c), ["step", "other"]);
}

#[test]
fn parameters_have_defaults_and_ranges_of_their_type() {
    let c = compiled(
        "const int n = 3;
         param double w = 1 / 4.0 in [0, n];
         param int k = 2 * n in [n, 10];
         param bool on = k > 5;
         param vec up = vec(0, 0, 2) / 2;",
    );
    let program = c.program.expect("a program");
    let found: Vec<String> =
        program.params().map(|(_, g, p)| format!("{} {:?} {:?}", g.name, p.default, p.range)).collect();
    assert_eq!(
        found,
        [
            "w Double(0.25) Some((Double(0.0), Double(3.0)))",
            "k Int(6) Some((Int(3), Int(10)))",
            "on Bool(true) None",
            "up Vec(DVec3(0.0, 0.0, 1.0)) None",
        ]
    );
}

#[test]
fn properties_have_defaults() {
    let c = compiled("const int n = 3; vertex { double age = n; vertex mate; vec up = vec(1, 0, 0) * n; };");
    let program = c.program.expect("a program");
    let defaults: Vec<Value> = program.vertex_properties.iter().map(|p| p.default).collect();
    let up = Value::Vec(glam::DVec3::new(3.0, 0.0, 0.0));
    assert_eq!(defaults, [Value::Double(3.0), Value::Vertex(None), up]);
}

/// Compiles `main.vv` among files given by name and text.
fn with_files(main: &str, files: &[(&str, &str)]) -> Compilation {
    compile("main.vv", main, &mut |from, path| {
        let all = files.iter().copied().chain([("main.vv", main)]);
        let found = all.into_iter().find(|(name, _)| *name == path);
        let (name, text) = found.ok_or_else(|| format!("there is no file `{path}` beside `{from}`"))?;
        Ok(Included { name: name.to_owned(), text: text.to_owned() })
    })
}

#[test]
fn files_are_included_once_before_those_that_need_them() {
    let c = with_files(
        "#include \"a.vv\"\n#include \"b.vv\"\nconst int m = a + b;\nvoid f(mesh& S) { print m; }",
        &[("a.vv", "#include \"b.vv\"\nconst int a = b + 1;"), ("b.vv", "#include \"main.vv\"\nconst int b = 2;")],
    );
    assert!(c.diagnostics.is_empty(), "{:?}", c.diagnostics);
    let program = c.program.expect("a program");
    let order: Vec<&str> = program.globals.iter().map(|g| g.name.as_str()).collect();
    assert_eq!(order, ["b", "a", "m"]);
}

#[test]
fn messages_come_in_the_order_of_files_and_places() {
    let c = with_files(
        "#include \"a.vv\"\nvoid f(mesh& S) { print x; print y; }\n#include \"none.vv\"",
        &[("a.vv", "void g() { print z; }\n#include \"none.vv\"")],
    );
    let found: Vec<String> = c
        .diagnostics
        .iter()
        .map(|d| {
            let (file, start, _) = c.sources.locate(d.span.expect("a place")).expect("a place");
            format!("{file}:{}:{}: {}", start.line, start.column, d.message)
        })
        .collect();
    assert_eq!(
        found,
        [
            "main.vv:2:25: `x` is not declared",
            "main.vv:2:34: `y` is not declared",
            "main.vv:3:10: there is no file `none.vv` beside `main.vv`",
            "a.vv:1:18: `z` is not declared",
            "a.vv:2:10: there is no file `none.vv` beside `a.vv`",
        ]
    );
}

#[test]
fn files_without_end_are_cut() {
    let mut n = 0;
    let c = compile("main.vv", "#include \"next.vv\"", &mut |_, path| {
        n += 1;
        Ok(Included { name: format!("{n}"), text: format!("#include \"{path}\"") })
    });
    let messages: Vec<&str> = c.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(messages, ["files include each other deeper than 64 levels"]);
}

#[test]
fn a_library_without_a_step_is_a_program() {
    let c = compiled(super::INSERT);
    assert_eq!(names_of_rules(&c), Vec::<String>::new());
}

#[test]
fn the_deepest_nesting_is_checked() {
    let deep = |n: usize| format!("void f(mesh& S) {{ double x = {}1{}; print x; }}", "-(".repeat(n), ")".repeat(n));
    assert!(compiled(&deep(90)).program.is_some());
    assert!(compiled(&deep(100_000)).program.is_none());
    let blocks = |n: usize| format!("void f(mesh& S) {}{}", "{ if (true) ".repeat(n), "}".repeat(n));
    assert!(compiled(&blocks(90)).diagnostics.iter().all(|d| !d.message.contains("deep")));
    assert!(compiled(&blocks(100_000)).program.is_none());
    let chain = |n: usize| format!("void f(mesh& S) {{ print 1{}; }}", " + 1".repeat(n));
    assert!(compiled(&chain(150)).program.is_some());
    let _ = compiled(&chain(100_000));
}

#[test]
fn of_ten_thousand_functions_with_mistakes_the_first_are_shown() {
    let mut text = String::new();
    for i in 0..10_000 {
        let called = i / 2;
        text += &format!("const int c{i} = {i};\n");
        text += &format!("int f{i}(int a) {{ int b = a + c{i}; return b + unknown{i} + f{called}(b); }}\n");
    }
    let diagnostics = compiled(&text).diagnostics;
    let messages: Vec<_> = diagnostics.iter().map(|d| d.message.clone()).collect();
    let expected: Vec<_> = (0..100).map(|i| format!("`unknown{i}` is not declared")).collect();
    assert_eq!(messages[..100], expected);
    assert_eq!(messages[100..], ["there are more errors or warnings than are shown here"]);
}

#[test]
fn of_very_many_mistakes_the_first_are_shown_and_errors_before_warnings() {
    let declare = |i| format!("int unused{i} = 1;\n");
    let text =
        format!("void f(mesh& S) {{\n{}}}\nvoid g(mesh& S) {{ wrong; }}", (0..1000).map(declare).collect::<String>());
    let c = compiled(&text);
    let messages: Vec<&str> = c.diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert!(messages.contains(&"`wrong` is not declared") && messages.contains(&"`unused0` is never used"));
    assert!(messages.contains(&"there are more errors or warnings than are shown here"));
    assert!(messages.len() < 200, "{}", messages.len());
}

#[test]
fn functions_that_people_expect_have_a_hint() {
    for (call, hint) in [
        ("catmull_clark(S);", "one comes with vv: `#include \"catmull-clark.vv\"`"),
        ("vertex x = insert(p, p);", "one comes with vv: `#include \"insert.vv\"`"),
        ("vertex x = vertex();", "`vertex v;` creates a vertex"),
        ("int n = size(S);", "count in a loop: `int n = 0; forall v in S n += 1;`"),
    ] {
        let c = compiled(&format!("void f(mesh& S) {{ forall p in S {{ {call} }} }}"));
        let hints: Vec<&str> = c.diagnostics.iter().flat_map(|d| &d.hints).map(|h| h.message.as_str()).collect();
        assert!(hints.contains(&hint), "{call}: {hints:?}");
    }
}
