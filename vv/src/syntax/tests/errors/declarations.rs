//! What stands outside functions, and heads of functions.

use super::{check, check_file};

#[test]
fn code_behind_a_function() {
    check_file(
        r#"
    void f(mesh& S) {
      if (a) { b; } }
      c;
    //^ error: statements stand inside functions | if this belongs to the function above, there is a `}` too many before it
      forall p in S { d; }
    }
    void g() { }
"#,
    );
}

#[test]
fn statements_at_file_scope() {
    check_file(
        r#"
    forall p in S { a; }
  //^^^^^^ error: statements stand inside functions | write `void name(mesh& S) { … }` around them
    b = 3;
    void g() { }
"#,
    );
}

#[test]
fn heads_of_functions() {
    check_file(
        r#"
    void f(mesh& S)
    vertex d(mesh& S);
  //^^^^^^ error: expected `{` of the function `f`, found `vertex`
    vertex& g() { }
    //    ^ error: functions return values, not references or pointers | leave it out
    float h(float x, vertex* v, int n = 3) { }
  //^^^^^ error: `float` is not a type of vv | write `double`
    //      ^^^^^ error: `float` is not a type of vv | write `double`
    //                     ^ error: vv has no pointers | write `&` for a variable of the caller's
    //                                ^ error: parameters of functions have no default values | give the value in each call
    viod k() { }
  //^^^^ error: `viod` is not a type of vv | did you mean `void`?
    int (x) { }
  //^^^ error: statements stand inside functions | if this belongs to the function above, there is a `}` too many before it
    l() { }
"#,
    );
}

#[test]
fn parameters() {
    check_file(
        r#"
    void f(mesh S&) { a; }
    //           ^ error: the `&` stands before the name | write `&S`
    void g(x) { b; }
    //     ^ error: expected the type of a parameter, found `x`
    void h(int) { c; }
    //        ^ error: expected the name of a parameter, found `)`
    void i(int a int b) { c; }
    //           ^^^ error: expected `,` or `)`, found `int`
    void j(int a { d; }
    //         ^ error: expected `)` after this | write `)`
"#,
    );
}

#[test]
fn params() {
    check_file(
        r#"
    param w = 1;
    //    ^ error: expected a type, found `w` | write `param double w = 0.5 in [0, 1];`
    param double w;
    //            ^ error: expected `=` and a value, found `;` | write `param double w = 0.5 in [0, 1];`
    param double w = 1 in 0, 2;
    //                    ^ error: expected `[`, found the number `0` | write `param double w = 0.5 in [0, 1];`
    param double w = 1 in [0 2];
    //                       ^ error: expected `,` between the ends of the range, found the number `2`
    param double w = 1 in [0, 2;
    //                        ^ error: expected `]` after this | write `]`
    parm int x = 3;
  //^^^^ error: unknown word `parm` at file scope | did you mean `param`?
"#,
    );
}

#[test]
fn property_blocks() {
    check_file(
        r#"
    vertex { double age = 0 int kind; string s; foo; };
    //                    ^ error: expected `;` after this | write `;`
    //                                ^^^^^^ error: vv has no variables for text | strings stand in `print` only
    //                                          ^^^ error: expected a property such as `double age = 0;`, found `foo`
    mesh { float age = 0; }
    //     ^^^^^ error: `float` is not a type of vv | write `double`
    edge { double a
    //   ^ error: this `{` is never closed
    //            ^ error: expected `;` after this | write `;`
    void f() { }
"#,
    );
}

#[test]
fn constants() {
    check_file(
        r#"
    static double k = 3;
  //^^^^^^ error: only functions can be `static`
    inline int f() { }
  //^^^^^^ error: vv has no `inline` | leave it out
    const k = 3;
    //    ^ error: expected a type after `const`, found `k` | write `const double k = 0.5;`
    const float k = 3;
    //    ^^^^^ error: `float` is not a type of vv | write `double`
"#,
    );
}

#[test]
fn errors_in_constants() {
    check_file(
        r#"
    int a = 3 int b;
    //      ^ error: expected `;` after this | write `;`
    int c = ;
    //      ^ error: expected a value, found `;`
    void f() { }
"#,
    );
}

#[test]
fn nested_function() {
    check_file(
        r#"
    void f() {
    //       ^ error: this `{` is never closed
      void g() {
      }
    }
  //^ error: this `}` closes nothing
    void h(mesh& S {
    //           ^ error: expected `)` after this | write `)`
      a;
    }
    int i( {
    //   ^ error: expected `)` after this | write `)`
    }
"#,
    );
}

#[test]
fn a_function_inside_a_function() {
    check(
        r#"
        if (a) { void inner() { b = c; } int f(int a) { return a; } }
        //            ^^^^^ error: functions do not nest | write this one before or after the function it stands in
        //                                   ^ error: functions do not nest | write this one before or after the function it stands in
        d = e;
    "#,
    );
}
