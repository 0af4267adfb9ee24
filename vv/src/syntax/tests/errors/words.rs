//! Words of the language that are mistyped, forgotten or run together.

use super::check;

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
        //    ^^^^ error: vv has no functions that belong to values | `valence r` counts the vertices of a ring, `forall v in r n += 1;` those of a mesh
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
