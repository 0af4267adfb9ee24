//! Mistakes and what is said about them. Below a line stands what is reported there:
//! `// ^^^ error: message | hint | hint`. What is not announced must not come, what is announced must.

use super::mended;
use crate::diagnostic::{Diagnostic, Severity};
use crate::source::{FileId, Sources};
use crate::syntax::parse;

/// One message: line and column (from 0), length in characters (on its first line), and what is said.
type Said = (usize, usize, usize, String);

fn announced(text: &str) -> Vec<Said> {
    let mut said = Vec::new();
    let mut target = 0;
    for (number, line) in text.lines().enumerate() {
        let marks = line.trim_start().strip_prefix("//").map(str::trim_start).filter(|rest| rest.starts_with('^'));
        let Some(marks) = marks else {
            target = number;
            continue;
        };
        let message = marks.trim_start_matches('^');
        let column = line.chars().count() - marks.chars().count();
        said.push((target, column, marks.len() - message.len(), message.trim().to_owned()));
    }
    said.sort();
    said
}

fn reported(text: &str, diagnostics: &[Diagnostic]) -> Vec<Said> {
    let mut sources = Sources::default();
    sources.add("test.vv", text);
    let lines: Vec<&str> = text.lines().collect();
    let said = diagnostics.iter().map(|d| {
        let (_, start, end) = d.span.and_then(|span| sources.locate(span)).expect("a place");
        let (line, column) = (start.line as usize - 1, start.column as usize - 1);
        let last = if end.line == start.line { end.column as usize - 1 } else { lines[line].chars().count() };
        let severity = match d.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        let hints = d.hints.iter().map(|hint| format!(" | {}", hint.message)).collect::<String>();
        (line, column, (last - column).max(1), format!("{severity}: {}{hints}", d.message))
    });
    let mut said: Vec<_> = said.collect();
    said.sort();
    said
}

/// The text with what is reported, as it would have to be announced.
fn annotated(text: &str, said: &[Said]) -> String {
    let is_mark = |line: &str| line.trim_start().strip_prefix("//").is_some_and(|l| l.trim_start().starts_with('^'));
    let mut result = String::new();
    for (number, line) in text.lines().enumerate().filter(|(_, line)| !is_mark(line)) {
        result.push_str(line);
        result.push('\n');
        for (_, column, length, message) in said.iter().filter(|s| s.0 == number) {
            let indent = line.len() - line.trim_start().len();
            let indent = indent.min(column.saturating_sub(2));
            result.push_str(&format!(
                "{}//{}{} {message}\n",
                " ".repeat(indent),
                " ".repeat(column.saturating_sub(indent + 2)),
                "^".repeat(*length)
            ));
        }
    }
    result
}

/// The statements of a function.
#[track_caller]
fn check(text: &str) {
    check_file(&format!("    void f(mesh& S) {{{text}}}"));
}

#[track_caller]
fn check_file(text: &str) {
    let (_, diagnostics) = parse(FileId::MAIN, text);
    let said = reported(text, &diagnostics);
    assert!(announced(text) == said, "what is reported:\n{}", annotated(text, &said));
}

/// What the hints make of a mistaken text, which must then be free of errors.
#[track_caller]
fn check_fix(text: &str, expected: &str) {
    let whole = format!("void f(mesh& S) {{ {text} }}");
    let (_, diagnostics) = parse(FileId::MAIN, &whole);
    assert!(!diagnostics.is_empty(), "nothing is wrong with {text:?}");
    let mended = mended(&whole, &diagnostics);
    assert_eq!(mended, format!("void f(mesh& S) {{ {expected} }}"));
    super::statements(expected);
}

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
fn mistyped_queries() {
    check(
        r#"
        x = nextot q in p;
        //  ^^^^^^ error: unknown word `nextot` | did you mean `nextto`?
        x = nexto q in p == null;
        //  ^^^^^ error: unknown word `nexto` | did you mean `nextto`?
        x = valance p;
        //  ^^^^^^^ error: unknown word `valance` | did you mean `valence`?
        if (si q in p) x;
        //     ^ error: expected `)`, found `q`
    "#,
    );
}

#[test]
fn mistyped_statements() {
    check(
        r#"
        forll q in p { a; }
      //^^^^^ error: unknown word `forll` | did you mean `forall`?
        slice x after a in v;
      //^^^^^ error: unknown word `slice` | did you mean `splice`?
        synchronise S;
        synchronyze S;
      //^^^^^^^^^^^ error: unknown word `synchronyze` | did you mean `synchronize`?
        ersae x from v;
      //^^^^^ error: unknown word `ersae` | did you mean `erase`?
        mrege S with T;
      //^^^^^ error: unknown word `mrege` | did you mean `merge`?
        foreach p in S { a; }
      //^^^^^^^ error: unknown word `foreach` | did you mean `forall`?
    "#,
    );
}

#[test]
fn lost_spaces() {
    check(
        r#"
        merge Swith NV;
        //    ^^^^^ error: expected `with`: a space is missing in `Swith` | write `S with`
        add xto NV;
        //  ^^^ error: expected `to`: a space is missing in `xto` | write `x to`
        splice x aftera in v;
        //       ^^^^^^ error: expected `after`: a space is missing in `aftera` | write `after a`
        x = nextto qin p;
        //         ^^^ error: expected `in`: a space is missing in `qin` | write `q in`
        replace a withx in v;
        //        ^^^^^ error: expected `with`: a space is missing in `withx` | write `with x`
        erase x fromv;
        //      ^^^^^ error: expected `from`: a space is missing in `fromv` | write `from v`
        add p toS;
        //    ^^^ error: expected `to`: a space is missing in `toS` | write `to S`
    "#,
    );
}

#[test]
fn lost_space_after_the_first_word() {
    check(
        r#"
        addx to NV;
      //^^^^ error: unknown word `addx` | write `add x`
        forallp in S { }
      //^^^^^^^ error: unknown word `forallp` | write `forall p`
    "#,
    );
}

#[test]
fn other_words_in_between() {
    check(
        r#"
        merge S and T;
        //      ^^^ error: expected `with`, found `and` | write `merge S with T`
        add x in S;
        //    ^^ error: expected `to`, found `in` | write `add v to S`
        erase x in v;
        //      ^^ error: expected `from`, found `in` | write `erase x from v`
        remove x of S;
        //       ^^ error: expected `from`, found `of` | write `remove v from S`
        make {a} of v;
        //       ^^ error: expected `nb_of`, found `of` | write `make {a, b, c} nb_of v`
        replace a by x in v;
        //        ^^ error: expected `with`, found `by` | write `replace a with x in v`
        forall p of S { }
        //       ^^ error: expected `in`, found `of` | write `forall p in S { … }`
    "#,
    );
}

#[test]
fn missing_parts() {
    check(
        r#"
        add x;
        //   ^ error: expected `to`, found `;` | write `add v to S`
        merge S;
        //     ^ error: expected `with`, found `;` | write `merge S with T`
        add to S;
        //  ^^ error: expected a value before `to`
        splice x in v;
        //       ^^ error: expected `after`, found `in` | write `splice x after a in v`
        replace a in v;
        //        ^^ error: expected `with`, found `in` | write `replace a with x in v`
        x = nextto in p;
        //         ^^ error: expected `;`, found `in` | name a vertex between `nextto` and `in`
        x = nextto q;
        //          ^ error: expected `in`, found `;` | write `nextto x in v`
        x = prevto q p;
        //           ^ error: expected `in`, found `p` | write `prevto x in v`
        is;
    "#,
    );
}

#[test]
fn membership_without_is() {
    check(
        r#"
        if (q in p) x;
        //    ^^ error: expected `)`, found `in` | membership is asked with `is x in v`
        x = q in p;
        //    ^^ error: expected `;`, found `in` | membership is asked with `is x in v`
        x = any p;
        //  ^^^ error: expected `in` after `any` | write `any in v`
    "#,
    );
}

#[test]
fn heads_of_forall() {
    check(
        r#"
        forall p, q, r in f { a; }
        //         ^ error: a `forall` has one variable, or two that follow each other | write `forall p in S { … }` or `forall p, q in f { … }`
        forall p, in f { a; }
        //           ^ error: expected `in`, found `f` | write `forall p in S { … }`
        forall f in face S { a; }
        //          ^^^^ error: unknown word `face` | did you mean `faces`?
        forall e in edges S { a; }
        //          ^^^^^ error: unknown word `edges` | each edge once is `forall p in S forall q in p { if (p < q) continue; … }`
        forall v in vertices S { a; }
        //          ^^^^^^^^ error: unknown word `vertices` | `forall p in S` walks vertices
        forall (p, q) in f { a; }
        //     ^ error: `forall` takes no parentheses | write `forall p in S { … }`
        forall x from p in f { a; }
        //       ^^^^ error: expected `in`, found `from` | where the round begins comes last: `forall x in r from p { … }`
        forall x in f from p q { a; }
        //                 ^ error: expected `,` after this | write `from p, q`
        forall x in f from p, { a; }
        //                    ^ error: expected a vertex, found `{` | write `forall x in f from p, q { … }`
        forall (p in S) { a; }
        //     ^ error: `forall` takes no parentheses | write `forall p in S { … }`
        forall vertex p in S { a; }
        //     ^^^^^^ error: the variable of a `forall` needs no type, it has that of what is walked | leave the type out
        forall p : S { a; }
        //       ^ error: expected `in`, found `:` | write `in`
        forall S { a; }
        //       ^ error: expected `in`, found `{` | write `forall p in S { … }`
        forall 3 in S { a; }
        //     ^ error: expected the name of the loop's variable, found the number `3`
    "#,
    );
}

#[test]
fn rings_are_not_lists() {
    check(
        r#"
        ring r = {a, b}, s;
        //       ^ error: a ring is not written as a list | it begins empty, `ring r;`, and grows by `add v to r;`
        rin r;
      //^^^ error: `rin` is not a type of vv | the types are `bool`, `int`, `double`, `vec`, `vertex`, `mesh` and `ring`
        rinng r;
      //^^^^^ error: `rinng` is not a type of vv | did you mean `ring`?
        add a, b to r;
        //   ^ error: expected `to`, found `,` | one at a time: `add v to S`
        r.add(a);
        //^^^ error: vv has no functions that belong to values | write `add v to r;`
        x = r.size() + 1;
        //    ^^^^ error: vv has no functions that belong to values | `valence r` counts the vertices of a ring
        make r of v;
        //     ^^ error: expected `nb_of`, found `of` | write `make r nb_of v`
        mesh F = faces S;
        //       ^^^^^ error: faces are walked, and are no value | write `forall f in faces S { … }`
        Face f;
      //^^^^ error: `Face` is not a type of vv | write `ring`
    "#,
    );
}

#[test]
fn for_in_place_of_forall() {
    check(
        r#"
        for (vertex p : S) { a; }
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
        for (p in S) { a; }
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
        for p in S { a; }
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
        for (auto p : S) a;
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
    "#,
    );
}

#[test]
fn assignment_as_condition() {
    check(
        r#"
        if (a = b) c;
        //  ^^^^^ warning: this condition stores a value, it does not compare | compare with `==`
        while (p = q) c;
        //     ^^^^^ warning: this condition stores a value, it does not compare | compare with `==`
        double x == 3;
        //       ^^ error: expected `=`, found `==` | write `=`
    "#,
    );
}

#[test]
fn operators_of_mathematics() {
    check(
        r#"
        if (a < b < c) d;
        //        ^ error: comparisons cannot be chained | write `a < b && b < c`
        a =< b;
        // ^ error: expected a value, found `<` | write `<=`
        a => b;
        // ^ error: expected a value, found `>` | write `>=`
        a = b === c;
        //      ^ error: expected a value, found `=` | write `==` or `!=`
        if (a and b or c && not d) e;
        //    ^^^ error: expected an operator, found `and` | write `&&`
        //          ^^ error: expected an operator, found `or` | write `||`
        //                  ^^^ error: unknown word `not` | write `!`
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

#[test]
fn reserved_words_as_names() {
    check(
        r#"
        int double = 3;
        //  ^^^^^^ error: `double` is a word of the language and cannot be the name of a variable | choose another name
        double if = 3;
        //     ^^ error: `if` is a word of the language and cannot be the name of a variable | choose another name
        vertex mesh;
        //     ^^^^ error: `mesh` is a word of the language and cannot be the name of a variable | choose another name
        forall vertex in S { }
        //     ^^^^^^ error: `vertex` is a word of the language and cannot be the name of the loop's variable | choose another name
    "#,
    );
}

#[test]
fn casts() {
    check(
        r#"
        double x = (double)n / (int)(a + b);
        //         ^^^^^^^^^ error: vv converts as a call does, not by a cast | write `double(n)`
        //                     ^^^^^^^^^^^^ error: vv converts as a call does, not by a cast | write `int(a + b)`
    "#,
    );
}

#[test]
fn foreign_types() {
    check(
        r#"
        float x = 1.0;
      //^^^^^ error: `float` is not a type of vv | write `double`
        auto p = any in v;
      //^^^^ error: vv has no `auto`, a variable is declared with its type | probably `vertex`
        size_t i = 0;
      //^^^^^^ error: `size_t` is not a type of vv | write `int`
        unsigned n;
      //^^^^^^^^ error: `unsigned` is not a type of vv | write `int`
        Foo y = 3;
      //^^^ error: `Foo` is not a type of vv | the types are `bool`, `int`, `double`, `vec`, `vertex`, `mesh` and `ring`
        foo z;
      //^^^ error: `foo` is not a type of vv | the types are `bool`, `int`, `double`, `vec`, `vertex`, `mesh` and `ring`
    "#,
    );
}

#[test]
fn arrays() {
    check(
        r#"
        double a[3];
        //      ^ error: vv has no arrays | keep values as properties: `vertex { double age = 0; };` and `v$age`
        a[0] = 1;
       //^ error: expected an operator, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
        x = a[i] + b;
        //   ^ error: expected an operator, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
        vec v = {1, 2, 3};
        //      ^ error: expected a value, found `{` | a vector is written `vec(x, y, z)`
    "#,
    );
}

#[test]
fn pointers_and_references() {
    check(
        r#"
        vertex& q = p;
        //    ^ error: vv has no variables that refer to others | leave it out: a vertex is a handle already
        vertex* r = p;
        //    ^ error: vv has no pointers | leave it out: a vertex is a handle already
        q->pos = p$pos;
       //^^ error: vv has no pointers, so no `->` | properties are written `v$name`
        x = &p;
        //  ^ error: expected a value, found `&` | write `&&` for and; vv has no bit operations and no addresses
    "#,
    );
}

#[test]
fn standard_library() {
    check(
        r#"
        x = std::sqrt(2.0);
        //  ^^^^^ error: vv has no namespaces: its functions are there without a prefix | leave it out
        std::cout << x << y;
      //^^^ error: vv writes with `print` | write `print "n = ", n;`
        std::vector<vertex> v;
      //^^^ error: vv has no containers | sets of vertices are of type `mesh`; values are kept as properties: `v$name`
        cout << x;
      //^^^^ error: vv writes with `print` | write `print "n = ", n;`
        printf("%d", n);
      //^^^^^^ error: vv writes with `print` | write `print "n = ", n;`
    "#,
    );
}

#[test]
fn foreign_statements() {
    check(
        r#"
        switch (x) { case 1: a; break; default: b; }
      //^^^^^^ error: vv has no `switch` | write `if … else if … else …`
        b;
        try { a; } catch (e) { b; }
      //^^^ error: vv has no exceptions | every error ends the step and leaves the mesh as it was before
        throw x;
      //^^^^^ error: vv has no exceptions | every error ends the step and leaves the mesh as it was before
        goto end;
      //^^^^ error: vv has no `goto` | leave loops with `break` or `return`
        assert(x);
      //^^^^^^ error: vv has no `assert` | write `if (!condition) print "…";`
    "#,
    );
}

#[test]
fn bit_operations() {
    check(
        r#"
        x = a & b;
        //    ^ error: expected `;`, found `&` | write `&&` for and; vv has no bit operations and no addresses
        x = a | b;
        //    ^ error: expected `;`, found `|` | an edge is written `(p|q)`, with parentheses; vv has no bit operations
        x = a << 2;
        //    ^^ error: expected `;`, found `<<` | write `print a, b;`; vv has no bit operations
        x = a ^ b;
        //    ^ error: expected `;`, found `^` | vv has no bit operations; powers are written `pow(x, 2.0)`
        x = ~a;
        //  ^ error: expected a value, found `~` | vv has no bit operations; powers are written `pow(x, 2.0)`
    "#,
    );
}

#[test]
fn further_cpp() {
    check(
        r#"
        string s = "a";
      //^^^^^^ error: vv has no variables for text | strings stand in `print` only
        char c = 'a';
      //^^^^ error: vv has no variables for text | strings stand in `print` only
        x = nullptr;
        //  ^^^^^^^ error: `nullptr` is `null` in vv | write `null`
        static int n = 0;
      //^^^^^^ error: vv has no static variables, they would survive an undo | keep state as a property of the mesh: `mesh { int generation = 0; };`
        new p;
      //^^^ error: vv has neither `new` nor `delete` | `vertex v;` creates a vertex; a vertex that no mesh holds is forgotten
        x = new p;
        //  ^^^ error: vv has neither `new` nor `delete` | `vertex v;` creates a vertex; a vertex that no mesh holds is forgotten
        int i = 0, double y;
        //         ^^^^^^ error: the type stands once, before the first of several variables | leave it out
    "#,
    );
}

#[test]
fn constructors_and_lambdas() {
    check(
        r#"
        int n(1, 2);
        //   ^^^^^^ error: `n` takes one value, not 2 | write `type name = value;`
        auto f = [](vertex v) { return v; };
        //       ^ error: expected a value, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
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
fn preprocessor() {
    check_file(
        r#"
    #include <cmath>
  //^^^^^^^^^^^^^^^^ error: vv has no header files, its functions are built in | leave this line out
    #include insert.vv
  //^^^^^^^^^^^^^^^^^^ error: expected a file name in quotes after `#include` | write `#include "insert.vv"`
    #define K 3
  //^^^^^^^^^^^ error: vv has no macros | write `const double k = 0.5;`, or `param` for a slider
    #pragma once
  //^^^^^^^^^^^^ error: vv has no preprocessor but `#include "file.vv"` | leave this line out
    void f() { }
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
fn types_of_ones_own() {
    check_file(
        r#"
    struct A { int x; };
  //^^^^^^ error: vv has no types of one's own | values are kept as properties: `vertex { double age = 0; };` and `v$age`
    template <class T> void f(T x) { }
  //^^^^^^^^ error: vv has no templates | write one function for each type
    using namespace std;
  //^^^^^ error: vv has neither namespaces nor type names of one's own | leave this line out
    class B;
  //^^^^^ error: vv has no types of one's own | values are kept as properties: `vertex { double age = 0; };` and `v$age`
    void g() { }
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
fn mistyped_first_words() {
    check(
        r#"
        vertx v;
      //^^^^^ error: `vertx` is not a type of vv | did you mean `vertex`?
        duoble x = 1;
      //^^^^^^ error: `duoble` is not a type of vv | did you mean `double`?
        retrun x;
      //^^^^^^ error: unknown word `retrun` | did you mean `return`?
        whlie (a) { b; }
      //^^^^^ error: `whlie (…) {` begins no statement | did you mean `while`?
        Vertex w;
      //^^^^^^ error: `Vertex` is not a type of vv | write `vertex`
        Forall p in S { a; }
      //^^^^^^ error: unknown word `Forall` | did you mean `forall`?
        If (a) { b; }
      //^^ error: `If (…) {` begins no statement | did you mean `if`?
    "#,
    );
}

#[test]
fn more_heads() {
    check(
        r#"
        for (auto p : S) { a; }
      //^^^ error: vv loops over sets and rings with `forall` | write `forall p in S`
        for (int i = 0, i < n, i++) { a; }
        //                ^ error: expected `;`, found `<`
        for (int i = 0; i < n) { a; }
        //                   ^ error: expected `;`, found `)` | write `for (int i = 0; i < n; i++)`
        while (a b) { c; }
        //       ^ error: expected `)`, found `b`
        if () { a; }
        //  ^ error: expected a value, found `)`
    "#,
    );
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
fn automatic_types() {
    check_file(
        r#"
    void f() {
      auto n = valence p;
    //^^^^ error: vv has no `auto`, a variable is declared with its type | probably `int`
      auto v = p$pos + q$pos;
    //^^^^ error: vv has no `auto`, a variable is declared with its type | probably `vec`
      auto f = [](vertex v) { return v; };
      //       ^ error: expected a value, found `[` | vv has neither arrays nor lambdas; keep values as properties of vertices: `v$name`
      auto g;
    //^^^^ error: vv has no `auto`, a variable is declared with its type | write `double x = …`, `vertex v = …`
      let x = 3;
    //^^^ error: vv has no `let`, a variable is declared with its type | probably `int`
    }
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
fn hints_carry_the_edit_that_mends() {
    check_fix("a = b\n c = d;", "a = b;\n c = d;");
    check_fix("a = (b + c;", "a = (b + c);");
    check_fix("make {a, b nb_of x;", "make {a, b} nb_of x;");
    check_fix("merge Swith T;", "merge S with T;");
    check_fix("merge S withT;", "merge S with T;");
    check_fix("merge S and T;", "merge S with T;");
    check_fix("addx to S;", "add x to S;");
    check_fix("x = nextot q in p;", "x = nextto q in p;");
    check_fix("forll p in S { }", "forall p in S { }");
    check_fix("forall vertex p in S { }", "forall p in S { }");
    check_fix("if (a = b) c;", "if (a == b) c;");
    check_fix("if (a); { b; }", "if (a) { b; }");
    check_fix("double x == 3;", "double x = 3;");
    check_fix("a = b and not c;", "a = b && ! c;");
    check_fix("a = 1.0f ≤ 2;", "a = 1.0 <= 2;");
    check_fix("a = (double)n / (int)(b + c);", "a = double(n) / int(b + c);");
    check_fix("float x; auto v = any in p;", "double x; vertex v = any in p;");
    check_fix("a = p->pos;", "a = p$pos;");
    check_fix("a = std::sqrt(2.0);", "a = sqrt(2.0);");
    check_fix("vertex& q = NULL;", "vertex q = null;");
    check_fix("vec v = (1, 2, 3), w;", "vec v = vec(1, 2, 3), w;");
    check_fix("vertex v = any p;", "vertex v = any in p;");
    check_fix("print \"text;\n", "print \"text\";\n");
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

/// The tree of a mended text is that of what was meant.
#[test]
fn mended_mistakes_are_read_as_meant() {
    for (mistaken, meant) in [
        ("a = b\n c = d;", "a = b;\n c = d;"),
        ("merge Swith T;", "merge S with T;"),
        ("x = nextot q in p;", "x = nextto q in p;"),
        ("for (vertex p : S) { a; }", "forall p in S { a; }"),
        ("float x = (double)n;", "double x = double(n);"),
        ("make {a, b nb_of x;", "make {a, b} nb_of x;"),
    ] {
        let (ast, diagnostics) = parse(FileId::MAIN, &format!("void f() {{ {mistaken} }}"));
        assert!(!diagnostics.is_empty(), "{mistaken}");
        assert_eq!(super::sexpr::ast(&ast), super::tree(&format!("void f() {{ {meant} }}")));
    }
}

/// Later parts of a program stay readable, so that names declared in a broken statement are not unknown.
#[test]
fn what_was_read_before_a_mistake_stays() {
    let (ast, diagnostics) =
        parse(FileId::MAIN, "void f(mesh S&) { vertex x = insert(p q), y; forall p in ) { a; } b; }");
    assert_eq!(diagnostics.len(), 3);
    assert_eq!(super::sexpr::ast(&ast), "(fn void f (mesh S) (vertex (= x <error>) y) (forall p <error> (block a)) b)");
}

#[test]
fn other_words_of_cpp_inside_values() {
    check(
        r#"
        vertex a = new vertex;
        //         ^^^ error: vv has neither `new` nor `delete` | `vertex v;` creates a vertex; a vertex that no mesh holds is forgotten
        int i = static_cast<int>(2.5);
        //      ^^^^^^^^^^^ error: vv converts as a call does, not by a cast | write `int(x)` or `double(n)`
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
