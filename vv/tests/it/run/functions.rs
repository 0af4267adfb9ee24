//! Functions, parameters, constants, and the order of computation.

use vv::engine::Settings;
use vv::mesh::Value;

use super::{check, check_with, compile, run_with};

#[test]
fn values_are_copied_and_references_are_not() {
    check(
        "static void f(int a, int& b, vec& c, vertex& d) { a = 1; b = 2; c.y = 3; d = null; f2(b); }
         static void f2(int& b) { b += 10; }
         void step(mesh& S) { int a, b; vec c; vertex d; f(a, b, c, d); print a, b, c, d; }",
        "012(0, 3, 0)null",
    );
}

#[test]
fn functions_recur() {
    check(
        "int fib(int n) { return n < 2 ? n : fib(n - 1) + fib(n - 2); }
         static void down(int& n) { if (n > 0) { n--; down(n); } }
         void step(mesh& S) { print fib(15); int n = 100; down(n); print n; }",
        "610\n0",
    );
}

#[test]
fn operands_are_computed_from_left_to_right() {
    check(
        "int say(int i) { print i; return i; }
         vertex tell(vertex v) { print v; return v; }
         int bump(int& i) { i += 1; return i; }
         void step(mesh& S) {
           vertex a, b;
           int i = say(1) + say(2) * say(3); print vec(say(4), say(5), say(6)).x;
           tell(a)$pos = tell(b)$pos + vec(say(7), 0, 0);
           i = 10; i += bump(i); print i;
           i = 10; print i + bump(i) * 100;
         }",
        "1\n2\n3\n4\n5\n6\n4\nv1\nv2\n7\n22\n1110",
    );
}

#[test]
fn constants_and_parameters_are_computed_before_each_run() {
    let text =
        "const double half = 1.0 / 2; param double w = half / 2 in [0, 1]; param int n = 3; const double v = w * n;
                void step(mesh& S) { print half, \" \", w, \" \", n, \" \", v; }";
    check(text, "0.5 0.25 3 0.75");
    let program = compile(text);
    let params: Vec<_> = program.params().map(|(id, ..)| id).collect();
    let settings =
        Settings { params: vec![(params[0], Value::Int(1)), (params[1], Value::Double(2.9))], ..Settings::default() };
    check_with(text, &settings, "0.5 1 2 2");
    let settings = Settings { params: vec![(params[1], Value::Double(f64::NAN))], ..Settings::default() };
    check_with(text, &settings, "error 1:77 `n`: the value given for this parameter does not fit its type");
}

#[test]
fn an_error_names_the_open_calls() {
    check(
        "int inner(int n) { return 1 / n; }
         int outer(int n) { return inner(n); }
         void step(mesh& S) {
           print outer(0);
         }",
        "error 1:27 `1 / n`: this divides by zero
         = operands: 1, 0
         in inner at 2:36 `inner(n)`
         in outer at 4:18 `outer(0)`",
    );
}

#[test]
fn random_is_a_function_of_seed_and_step() {
    let text = "void step(mesh& S) { print random(), \" \", random(2, 3); }";
    let at = |seed, steps| run_with(text, steps, &Settings { seed, ..Settings::default() }).0;
    let twice = at(0, 2);
    assert_eq!(twice, at(0, 2));
    assert_ne!(twice[0], twice[1]);
    assert_ne!(at(0, 1), at(1, 1));
    for line in twice {
        let numbers: Vec<f64> = line.split(' ').map(|n| n.parse().unwrap()).collect();
        assert!((0.0..1.0).contains(&numbers[0]) && (2.0..3.0).contains(&numbers[1]));
    }
}
