//! Signs, numbers, texts and comments that cannot be read.

use super::{check, reported};
use crate::source::FileId;
use crate::syntax::parse;

#[test]
fn numbers_and_escapes() {
    check(
        r#"
        a = 1.0f;
        //     ^ error: numbers have no suffix in vv | leave it out
        a = 0x10;
        //  ^^^^ error: `0x10` is not a number | numbers are decimal: `42`, `0.125`, `1.5e-3`
        a = 3abc;
        //  ^^^^ error: `3abc` is not a number | numbers are decimal: `42`, `0.125`, `1.5e-3`
        a = 99999999999999999999;
        //  ^^^^^^^^^^^^^^^^^^^^ error: this number is too large for `int`, which ends at 9223372036854775807 | write a `double`
        a = 1e999;
        //  ^^^^^ error: this number is too large for `double`
        a = "x\q";
        //  ^^^^^ error: unknown escape `\q` in a string | known are `\n`, `\t`, `\"` and `\\`
    "#,
    );
}

#[test]
fn unknown_signs() {
    check(
        r#"
        a = b @ c;
        //    ^ error: vv does not know the sign `@`
        a = b ≤ c;
        //    ^ error: vv does not know the sign `≤` | write `<=`
        a = b × c;
        //    ^ error: vv does not know the sign `×` | write `*`
    "#,
    );
}

#[test]
fn unclosed_string() {
    check(
        r#"
        print "text;
        //    ^^^^^ error: this string is not closed on its line | close it with `"`
        a = b;
    "#,
    );
}

/// (An announcement below would be part of the comment.)
#[test]
fn unclosed_comment() {
    let text = "void f() { }\n/* never closed\nvoid g() { }";
    let (ast, diagnostics) = parse(FileId::MAIN, text);
    assert_eq!(ast.items.len(), 1);
    assert_eq!(
        reported(text, &diagnostics),
        [(1, 0, 2, "error: this comment is never closed | close it with `*/`".to_owned())]
    );
}
