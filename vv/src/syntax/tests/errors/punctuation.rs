//! Signs and braces that are missing, too many or in the wrong place.

use super::{check, check_file};
use crate::source::FileId;
use crate::syntax::parse;

#[test]
fn missing_semicolon() {
    check(
        r#"
        a = b
        //  ^ error: expected `;` after this | write `;`
        c = d;
        add x to S
        //       ^ error: expected `;` after this | write `;`
    "#,
    );
}

#[test]
fn missing_parenthesis() {
    check(
        r#"
        a = (b + c;
        //       ^ error: expected `)` after this | write `)`
        d = f(a, b;
        //       ^ error: expected `)` after this | write `)`
        if (a == b { c; }
        //       ^ error: expected `)` after this | write `)`
    "#,
    );
}

#[test]
fn missing_operand() {
    check(
        r#"
        a = b + ;
        //      ^ error: expected a value, found `;`
        a = * b;
        //  ^ error: expected a value, found `*`
        a = f(, b);
        //    ^ error: expected a value, found `,`
        a = f(a b);
        //      ^ error: expected `,` or `)`, found `b`
    "#,
    );
}

#[test]
fn something_in_between() {
    check(
        r#"
        a = b c;
        //    ^ error: expected `;`, found `c`
        a = b) + c;
        //   ^ error: expected `;`, found `)`
        return a b;
        //       ^ error: expected `;`, found `b`
    "#,
    );
}

#[test]
fn conditions_need_parentheses() {
    check(
        r#"
        if a == b { c; }
        // ^ error: expected `(`, found `a` | write `if (p < q) …`
        while a { }
        //    ^ error: expected `(`, found `a` | write `while (p != q) …`
        else { }
      //^^^^ error: this `else` belongs to no `if` | an `if` with several statements needs braces: `if (…) { … } else { … }`
    "#,
    );
}

#[test]
fn broken_lists_of_make() {
    check(
        r#"
        make {a, b c} nb_of x;
        //         ^ error: expected `,` or `}` in the list of `make`, found `c`
        make {a, , b} nb_of x;
        //       ^ error: expected a value, found `,`
        make {a, b} x;
        //          ^ error: expected `nb_of`, found `x` | write `make {a, b, c} nb_of v`
        make a, b nb_of x;
        //   ^ error: expected `{` after `make`, found `a` | write `make {a, b, c} nb_of v`
        make {a, b nb_of x;
        //       ^ error: expected `}` after this | write `}`
    "#,
    );
}

#[test]
fn unfinished_conditional_and_do() {
    check(
        r#"
        a = b ? c;
        //       ^ error: expected `:` of the `? :`, found `;`
        do { } until (a);
        //     ^^^^^ error: expected `while` after the body of the `do`, found `until`
    "#,
    );
}

#[test]
fn unfinished_selectors() {
    check(
        r#"
        a$ = 3;
        // ^ error: expected the name of a property after `$`, found `=`
        a. = 3;
        // ^ error: expected `x`, `y` or `z`, found `=`
        a = `;
        //   ^ error: expected a name or `(` after the old-value mark, found `;` | write `` `v$pos `` or `` `(nextto q in `p)$pos ``
        a = `3;
        //   ^ error: expected a name or `(` after the old-value mark, found the number `3` | write `` `v$pos `` or `` `(nextto q in `p)$pos ``
    "#,
    );
}

#[test]
fn missing_brace_at_the_end() {
    check(
        r#"
    //              ^ error: this `{` is never closed
        forall p in S {
    "#,
    );
}

#[test]
fn semicolon_before_the_block() {
    check(
        r#"
        if (a); { b; }
        //    ^ warning: this `;` is all that the `if` applies to, the block behind it stands alone | leave out the `;`
        forall p in S; { b; }
        //           ^ warning: this `;` is all that the loop applies to, the block behind it stands alone | leave out the `;`
    "#,
    );
}

#[test]
fn brace_too_many() {
    check_file(
        r#"
    void f() { a; }
    }
  //^ error: this `}` closes nothing
    void g() { b; }
"#,
    );
}

#[test]
fn brace_too_few() {
    check_file(
        r#"
    void f(mesh& S) {
    //              ^ error: this `{` is never closed
      forall p in S {
        a;
    }
    void g() { b; }
"#,
    );
}

#[test]
fn a_missing_brace_before_a_static_function() {
    let text =
        "void step(mesh& S) {\n  forall p in S {\n}\nstatic int g(int a) { return a; }\nvoid f(mesh& S) { g(1); }\n";
    let (ast, diagnostics) = parse(FileId::MAIN, text);
    let messages: Vec<_> = diagnostics.iter().map(|d| d.message.as_str()).collect();
    assert_eq!(messages, ["this `{` is never closed"]);
    assert_eq!(ast.items.len(), 3);
}

#[test]
fn nothing_but_the_mistake() {
    check(
        r#"
        vec a = [1, 2, 3], b = 4 5, c;
        //      ^ error: expected a value, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
        //                       ^ error: expected `;`, found the number `5`
        vertex x = insert(p q);
        //                  ^ error: expected `,` or `)`, found `q`
        x$pos = `x$pos;
        add x to S;
    "#,
    );
}

#[test]
fn an_include_has_a_line_of_its_own() {
    check_file(
        r#"
    #include "a.vv" param double w = 0.5;
  //                ^^^^^ error: expected the end of the line after `#include` | begin another line
    #include "a.vv"; #include "b.vv"
  //                 ^ error: expected the end of the line after `#include` | begin another line
    #include "c.vv" // of another kind
    void f() { }
"#,
    );
}
