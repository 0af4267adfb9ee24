//! Budgets and stops: no program hangs or grows without bound.

use std::thread;
use std::time::Duration;

use vv::engine::{Failure, FailureKind, Limits, Settings};
use vv::mesh::Mesh;
use vv::stop::{Stop, Stopped};

use super::{check, compile};
use crate::engines::run;

#[track_caller]
fn fail(text: &str, settings: &Settings) -> Failure {
    let program = compile(text);
    run(&program, program.default_rule().unwrap(), &Mesh::new(), 1, settings, &mut Vec::new()).unwrap_err()
}

#[track_caller]
fn check_limit(limits: Limits, body: &str, message: &str) {
    let text = format!(
        "static void f(mesh T) {{ vertex x; add x to T; f(T); }}
         static void g(ring r) {{ add any in r to r; g(r); }}
         void step(mesh& S) {{\n{body}\n}}"
    );
    let failure = fail(&text, &Settings { limits, ..Settings::default() });
    assert_eq!(failure.kind, FailureKind::Budget, "{}", failure.diagnostic.message);
    assert_eq!(failure.diagnostic.message, message);
    assert!(failure.diagnostic.span.is_some());
}

#[test]
fn vertices() {
    let limits = Limits { max_vertices: 10, ..Limits::default() };
    check_limit(limits, "while (true) vertex x;", "the step needs more than 10 vertices");
}

#[test]
fn memory() {
    let limits = Limits { max_bytes: 256 << 10, ..Limits::default() };
    let message = "the step needs more than 256 KiB";
    let check = |body: &str| check_limit(limits, body, message);
    check("while (true) vertex x;");
    check("while (true) { vertex x; add x to S; }");
    check("while (true) { print \"more and more\"; }");
    check("vertex v; while (true) { vertex x; make {x} nb_of v; make {v} nb_of x; }");
    check("vertex v, w; make {w} nb_of v; while (true) { vertex x; splice x after w in v; }");
    check("while (true) { vertex x; add x to S; synchronize S; }");
    check("vertex x; ring r; while (true) add x to r;");
    check("vertex x; ring r; add x to r; while (true) splice x after x in r;");
    check("vertex x; ring r; add x to r; while (true) forall y in r add y to r;");
    check("vertex x; ring r; for (int i = 0; i < 300; i++) add x to r; g(r);");
    // Each call has a set of its own.
    check("for (int i = 0; i < 3000; i++) { vertex x; add x to S; } f(S);");
}

#[test]
fn sets_that_share_their_members_cost_nothing() {
    let text = "static void f(mesh T, int n) { if (n > 0) f(T, n - 1); }
                void step(mesh& S) { for (int i = 0; i < 20000; i++) { vertex x; add x to S; } f(S, 500); }";
    let program = compile(text);
    let settings = Settings { limits: Limits { max_bytes: 8 << 20, ..Limits::default() }, ..Settings::default() };
    run(&program, program.default_rule().unwrap(), &Mesh::new(), 1, &settings, &mut Vec::new()).unwrap();
}

#[test]
fn rings_that_share_their_vertices_cost_nothing() {
    let text = "static void f(ring r, int n) { if (n > 0) f(r, n - 1); }
                void step(mesh& S) { vertex v; ring r; for (int i = 0; i < 20000; i++) add v to r; f(r, 500); }";
    let program = compile(text);
    let settings = Settings { limits: Limits { max_bytes: 8 << 20, ..Limits::default() }, ..Settings::default() };
    run(&program, program.default_rule().unwrap(), &Mesh::new(), 1, &settings, &mut Vec::new()).unwrap();
}

#[test]
fn calls() {
    let text = "int f(int n) { return n == 0 ? 0 : 1 + f(n - 1); }
                void step(mesh& S) { print f(9998); print f(9999); }";
    let program = compile(text);
    let mut output = Vec::new();
    let failure =
        run(&program, program.default_rule().unwrap(), &Mesh::new(), 1, &Settings::default(), &mut output).unwrap_err();
    assert_eq!(output, ["9998"]);
    assert_eq!(failure.kind, FailureKind::Budget);
    let d = failure.diagnostic;
    assert_eq!(d.message, "more than 10000 calls are open at once");
    assert_eq!(d.evidence, ["9999 calls are open; 9983 in the middle are not listed"]);
    assert_eq!(d.calls.len(), 16);
}

#[test]
fn deep_nesting_within_deep_recursion() {
    // Near the 200 levels that the parser lets through.
    let deep = |n: usize, before: &str, after: &str| format!("{}next(n){}", before.repeat(n), after.repeat(n));
    for body in [
        format!("return {};", deep(95, "(a == b ? a : ", ")")),
        format!("return {};", deep(95, "(a = ", ")")),
        format!("return {};", deep(95, "same(", ")")),
        format!("return {};", deep(94, "(nextto ", " in a)")),
        format!("return {};", deep(95, "(", "$mate)")),
        format!("{} return next(n); {} return a;", "{ while (true) ".repeat(95), "}".repeat(95)),
        format!("{} return next(n); {} return a;", "forall x in a { if (x == a) break; ".repeat(95), "}".repeat(95)),
    ] {
        let text = format!(
            "vertex {{ vertex mate; }};
             vertex same(vertex v) {{ return v; }}
             vertex f(int n, vertex a, vertex b) {{ {body} }}
             vertex g(int n, vertex a, vertex b) {{
               vertex c; b$mate = b; make {{b, c}} nb_of a;
               return n == 0 ? b : f(n - 1, a, b);
             }}
             void step(mesh& S) {{ vertex a, b; vertex c = g(1000, a, b); print c == null; }}"
        )
        .replace("next(n)", "g(n, a, b)");
        check(&text, "false");
    }
}

#[test]
fn every_loop_can_be_stopped() {
    for body in [
        "while (true) {}",
        "for (;;) {}",
        "do {} while (true);",
        "while (true) ;",
        "int n = 0; while (true) { n++; n--; }",
        "for (int i = 0; i < 3; i++) for (;;) {}",
        "int n = 0; for (;;) { n++; if (n > 3) break; } for (;;) {}",
        "vertex a; for (int i = 0; i < 3; i++) while (true) a$pos.x += 1.0;",
        "vertex a; mesh T; add a to T; forall v in T for (;;) { if (v$pos.x > 1.0) break; for (;;) {} }",
        "f();",
        "vertex a; mesh T; add a to T; while (true) forall v in T ;",
        "vertex a, b; make {b} nb_of a; make {a} nb_of b; add a to S; add b to S; while (true) forall f in faces S ;",
        "vertex a; ring r; add a to r; while (true) forall p, q in r from a ;",
        "for (int i = 0; i < 100000; i++) { vertex x; add x to S; } while (true) { mesh T = S; merge T with S; }",
    ] {
        let stop = Stop::new();
        let request = stop.clone();
        let text = format!(
            "static void f() {{ g(); }} static void g() {{ }} void step(mesh& S) {{ {body} while (true) f(); }}"
        );
        let timer = thread::spawn(move || {
            thread::sleep(Duration::from_millis(30));
            request.request(Stopped::ByTime);
        });
        let failure = fail(&text, &Settings { stop, ..Settings::default() });
        timer.join().unwrap();
        assert_eq!(failure.kind, FailureKind::Stopped(Stopped::ByTime), "{body}");
        assert_eq!(failure.diagnostic.message, "the time allowed for a step is over");
        assert!(failure.diagnostic.span.is_some());
    }
}
